#include "bench/stress/hdr_target.h"

#include "renderer/paths/paths.h"

#include <algorithm>

namespace lightsweep {

bool blends_lights(const StressArm& arm, const Drawing& drawing) {
    const Path path = find_path(arm.get(kPathAxis)).build(drawing.arm().setup());
    return std::ranges::any_of(path.passes, [](const Pass& pass) { return pass.shades == Shades::one_light; });
}

FloatChannel hdr_channel(const Drawing& drawing) { return coarsest_channel(drawing.arm().setup().hdr); }

double hdr_rounding(const StressArm& arm, const Drawing& drawing, size_t lights) {
    constexpr double kStores = 2.0, kProducts = 16.0, kHalfStep = 0x1p-24;
    const auto count = static_cast<double>(lights);
    const double stores = blends_lights(arm, drawing) ? count : kStores;
    return stores * hdr_channel(drawing).epsilon() + (count + kProducts) * kHalfStep;
}

}  // namespace lightsweep
