// What several stress files ask of a vector.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace lightsweep {

/// The largest component's magnitude.
inline double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

inline bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace lightsweep
