// What stress cases work with: a scene on the GPU drawn by an arm's path, and what exact arithmetic makes of the same
// view; shader functions are called by shader_call.h.
#pragma once

#include "bench/measure/arm.h"
#include "bench/measure/surface_probes.h"
#include "bench/stress/arm.h"
#include "renderer/gl/context.h"
#include "renderer/gl/limits.h"
#include "renderer/reference/surfaces.h"

#include <memory>
#include <vector>

namespace lightsweep {

/// What all arms share. Needs a current context.
struct Workbench {
    explicit Workbench(const gl::Limits& device_limits) : limits(device_limits) {}

    FrameBuffers buffers;
    DrawShapes shapes;
    gl::Limits limits;
};

/// The setup that an arm stands for: its layout (float32 unless it has one) less what the scene does not need, its
/// depth, hdr (rgba32f unless it has one), light lists (built by the CPU unless it says otherwise), guards, sums.
/// Throws InputError.
PathSetup stress_setup(const StressArm& arm, const SceneNeeds& needs, SkipSet skips = SkipSet::all());

/// A scene with an arm's path compiled for it. Pictures come with the top row first. Stays where it was made (a trial
/// holds it by a shared_ptr): the arm keeps its address.
class Drawing {
  public:
    /// `arm` has a path. Lights are the scene's written ones (Scene::lights.fixed). Throws InputError and
    /// EnvironmentError as Arm does.
    Drawing(Workbench& bench, const StressArm& arm, Scene scene, int width, int height, SkipSet skips = SkipSet::all());
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    const Scene& scene() const { return *scene_; }
    int width() const { return subject_.width; }
    int height() const { return subject_.height; }
    /// For the next pictures. Kinds of light that the scene does not have (SceneNeeds) are not lit.
    void set_lights(std::vector<Light> lights) { subject_.lights = std::move(lights); }
    void set_camera(const Camera& camera) { subject_.camera = camera; }
    const Camera& camera() const { return *subject_.camera; }
    const Subject& subject() const { return subject_; }
    const Arm& arm() const { return arm_; }

    /// The linear HDR picture.
    Image draw();
    /// After tone mapping, of the last frame.
    Image display() const { return arm_.display_image(); }

    /// The surface under each pixel centre in double precision, by the rasteriser's own visibility (with a depth of
    /// D32F, reversed).
    std::vector<ReferenceSurface> surfaces() const;
    /// What those surfaces reflect, in double precision.
    std::vector<glm::dvec3> reference() const { return reference(surfaces()); }
    std::vector<glm::dvec3> reference(const std::vector<ReferenceSurface>& surfaces) const;
    /// What shading reads back from the arm's layout.
    std::vector<DecodedSurface> decoded() const;

  private:
    Workbench* bench_;
    std::unique_ptr<Scene> scene_;  // GpuScene keeps its address
    std::unique_ptr<GpuScene> gpu_scene_;
    Subject subject_;
    Arm arm_;
};

/// Of the values of a picture (three for each pixel) that are NaN or infinite.
int64_t count_non_finite(const Image& image);

/// How far a picture is from exact values: of each pixel the largest channel's difference over the exact pixel's
/// largest channel, which counts as `darkest` at least.
struct PictureErrors {
    double max = 0.0, p999 = 0.0, median = 0.0, mean = 0.0;  ///< over the pixels that are finite
    int64_t non_finite = 0;                                  ///< values
    int worst_x = 0, worst_y = 0;                            ///< from the top left
    std::string where() const;                               ///< "pixel (12, 3)"
};
PictureErrors picture_errors(const std::vector<glm::dvec3>& exact, const Image& image, double darkest);
/// Of `test` against another picture.
PictureErrors picture_errors(const Image& expected, const Image& test, double darkest);

}  // namespace lightsweep
