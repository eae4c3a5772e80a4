#include "renderer/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace lightsweep {

uint64_t hash_bytes(std::string_view bytes, uint64_t seed) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::string hash_hex(std::string_view bytes) { return fmt::format("{:016x}", hash_bytes(bytes)); }

}  // namespace lightsweep
