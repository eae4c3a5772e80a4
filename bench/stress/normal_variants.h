// The normal encodings that cases try: those of bench/encodings/variants.json, and what theory says of each.
#pragma once

#include "bench/encodings/variant.h"
#include "bench/stress/arm.h"

#include <string>

namespace lightsweep {

/// The axis `encoding`, of every shipped variant of the normal: oct_16_16, half_16_16_16, ...
StressAxis normal_encodings();
/// That of an arm.
Variant normal_variant(const StressArm& arm);

/// The largest angle, in degrees, that storing turns a unit normal by. `rounding`: by how much arithmetic may miss a
/// channel's value besides, in the channel's range [-1, 1].
double largest_angle_deg(const Variant& variant, double rounding = 0.0);

}  // namespace lightsweep
