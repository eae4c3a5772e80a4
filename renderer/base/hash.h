// A 64-bit hash of bytes (XXH3), stable across runs, machines and builds: cell ids, scene and plan hashes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lightsweep {

uint64_t hash_bytes(std::string_view bytes, uint64_t seed = 0);

/// Sixteen lower-case hex digits.
std::string hash_hex(std::string_view bytes);

}  // namespace lightsweep
