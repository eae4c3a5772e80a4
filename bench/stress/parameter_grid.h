// The values of a parameter that a case can try, where what it turns up is built into the scene: one copy for each, all
// in one scene, so that an arm is compiled once.
#pragma once

#include <cmath>
#include <cstddef>

namespace lightsweep {

/// Evenly by factors from `first` to `last` (both above 0, either the larger), both among them. No value in between is
/// farther than 1.3 % from the nearest of them: finer than a breakdown is told.
class ParameterGrid {
  public:
    ParameterGrid(double first, double last)
        : first_(first),
          last_(last),
          size_(static_cast<size_t>(std::ceil(std::abs(std::log(last / first)) / std::log(kFactor))) + 1) {}

    size_t size() const { return size_; }
    double operator[](size_t i) const {
        return first_ * std::pow(last_ / first_, static_cast<double>(i) / static_cast<double>(size_ - 1));
    }
    /// `value` lies between the ends.
    size_t nearest(double value) const {
        const double share = std::log(value / first_) / std::log(last_ / first_);
        return static_cast<size_t>(std::lround(share * static_cast<double>(size_ - 1)));
    }

  private:
    static constexpr double kFactor = 1.025;
    double first_, last_;
    size_t size_;
};

}  // namespace lightsweep
