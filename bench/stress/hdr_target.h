// What cases about the HDR target's format ask of a drawing.
#pragma once

#include "bench/stress/rounding_law.h"
#include "bench/stress/workbench.h"
#include "renderer/base/random.h"

#include <utility>
#include <vector>

namespace lightsweep {

/// Whether the arm's path adds light after light to its HDR target, and not in registers.
bool blends_lights(const StressArm& arm, const Drawing& drawing);

/// The channel that keeps least of light.
FloatChannel hdr_channel(const Drawing& drawing);

/// The most by which a sum of `lights` positive lights is off, relative to it and to first order, when it comes out of
/// the HDR target: a step of the format for each time that it is stored there, were it to truncate (blended: as often
/// as there are lights; else twice at most, light buffers and picture), and half a step of 32 bits for each addition
/// and some more for the products.
double hdr_rounding(const StressArm& arm, const Drawing& drawing, size_t lights);

/// In an order that the seed decides (Fisher and Yates).
template <class T>
std::vector<T> shuffled(std::vector<T> items, uint64_t seed) {
    Random random(seed);
    for (size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.index(i)]);
    return items;
}

}  // namespace lightsweep
