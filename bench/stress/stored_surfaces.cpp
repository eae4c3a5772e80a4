#include "bench/stress/stored_surfaces.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {

StoredSurfaces stored_surfaces(const Drawing& drawing, const std::vector<ReferenceSurface>& exact) {
    const auto decoded = drawing.decoded();
    StoredSurfaces stored{.surfaces = exact};
    for (size_t i = 0; i < exact.size(); ++i) {
        if (!exact[i].covered) continue;
        ReferenceSurface& s = stored.surfaces[i];
        s.position = decoded[i].position;
        s.normal = decoded[i].normal;
        s.base_color = decoded[i].base_color;
        s.roughness = decoded[i].roughness;
        s.metallic = decoded[i].metallic;
        const double sine = glm::length(glm::cross(s.normal, exact[i].normal));
        const double cosine = glm::dot(s.normal, exact[i].normal);
        const double shorter = s.roughness / exact[i].roughness;
        stored.normal_deg = std::max(stored.normal_deg, glm::degrees(std::atan2(sine, cosine)));
        stored.alpha = std::max(stored.alpha, std::abs(shorter * shorter - 1.0));
    }
    return stored;
}

bool packs(const StressArm& arm) { return arm.get(kLayoutAxis, "float32") != "float32"; }

}  // namespace lightsweep
