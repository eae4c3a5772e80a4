// Seeded random numbers that are the same on every machine: the standard's engine, and distributions of our own, since
// the standard leaves theirs to the library.
#pragma once

#include <cstdint>
#include <random>

namespace lightsweep {

class Random {
  public:
    explicit Random(uint64_t seed) : engine_(seed) {}
    uint64_t bits() { return engine_(); }
    /// [0, 1), 53 bits.
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    /// [low, high)
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// [0, count), for counts below 2^53.
    uint64_t index(uint64_t count) { return static_cast<uint64_t>(uniform() * static_cast<double>(count)); }

  private:
    std::mt19937_64 engine_;
};

}  // namespace lightsweep
