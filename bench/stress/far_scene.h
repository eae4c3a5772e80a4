// The same few shapes at the origin and at every distance of a grid from it, with the camera and the lights that go
// with each: nothing but the distance differs.
#pragma once

#include "bench/stress/parameter_grid.h"
#include "renderer/scene/scene.h"

#include <vector>

namespace lightsweep {

/// Far enough apart from 1,000 units on that a camera sees one copy alone.
inline constexpr double kNearestOrigin = 1e3, kFarthestOrigin = 1e7;

class FarScene {
  public:
    /// Where a copy is, and what looks at it.
    struct Place {
        Camera camera;
        std::vector<Light> lights;
    };

    FarScene();

    const Scene& scene() const { return scene_; }
    Place at_origin() const;
    /// `distance` from kNearestOrigin to kFarthestOrigin.
    Place at(double distance) const;

  private:
    ParameterGrid distances_{kNearestOrigin, kFarthestOrigin};
    Scene scene_;
};

}  // namespace lightsweep
