// One frame: what the camera sees of a scene and its lights. Built on the CPU once per frame, uploaded, and then the
// same for every path.
#pragma once

#include "renderer/base/skips.h"
#include "renderer/frame/gpu_scene.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/texel_buffer.h"
#include "renderer/scene/scene.h"
#include "shaders/shared/types.h"

#include <cstdint>
#include <vector>

namespace lightsweep {

/// How depth grows: standard 0 (near) to 1 (far), reversed 1 (near) to 0 (far). Clip depth is zero to one in both.
enum class DepthConvention : uint8_t { standard, reversed };

/// A camera's axes, unit, at right angles: view space is (right, up, forward).
struct CameraBasis {
    glm::dvec3 right, up, forward;
    glm::dvec3 to_view(const glm::dvec3& v) const {
        return {glm::dot(v, right), glm::dot(v, up), glm::dot(v, forward)};
    }
};
CameraBasis camera_basis(const Camera& camera);

/// Camera-relative world to clip, zero-to-one depth, in double precision.
glm::dmat4 camera_projection(const Camera& camera, int width, int height, DepthConvention convention);

struct DrawCall {
    uint32_t batch;  ///< index into GpuScene::batches()
    uint32_t instance_count;
    uint32_t first_visible;  ///< offset into DrawList::instances
};

struct DrawList {
    std::vector<DrawCall> draws;
    std::vector<uint32_t> instances;  ///< of the scene, those of one draw in a row
    void clear();
};

/// Which of a frame's instances a pass draws; see occlusion.h.
enum class Instances : uint8_t {
    visible,      ///< all that the frame may show
    seen_before,  ///< of them, those that the frame before may have shown
    newly_seen,   ///< the rest of them
};

/// What was drawn, and what culling left out.
struct FrameWork {
    uint64_t draws = 0;
    uint64_t triangles = 0;
    uint64_t instances_drawn = 0;
    uint64_t instances_culled = 0;
    uint64_t lights_drawn = 0;
    uint64_t lights_culled = 0;
};

struct FrameSetup {
    Camera camera;
    int width = 1;
    int height = 1;
    DepthConvention convention = DepthConvention::reversed;
    SkipSet skips = SkipSet::all();  ///< frustum, light_frustum and sort are decided here
};

struct Frame {
    FrameSetup setup;
    shared::FrameData data;
    DrawList visible;
    std::vector<shared::LightData> lights;  ///< directional ones first; only those that can reach the view
    FrameWork work;

    /// What build_frame works on; kept for its memory.
    struct Scratch {
        std::vector<uint64_t> keys, sorted, draw_keys;
        std::vector<DrawCall> draws;
    } scratch;
};

/// The part of the constants that the camera alone decides; `data` keeps the rest.
void set_camera_constants(const FrameSetup& setup, shared::FrameData& data);

/// Distance along the view axis of what has this depth, as shaders/lib/frame.glsl computes it.
float view_distance(const shared::FrameData& data, float depth);

/// Makes `frame.lights` of those that can reach the view of `frame.setup`, camera-relative, and counts them. Without
/// Skip::light_frustum it keeps all, but for those whose place, radius or direction is no number: they reach nothing.
void collect_lights(const std::vector<Light>& lights, Frame& frame);

/// Culls instances and lights against the view frustum, orders the instances of each batch and the batches by view
/// distance, and makes the lights camera-relative: what `setup.skips` says of it. Reuses the memory of `frame`.
void build_frame(const GpuScene& scene, const std::vector<Light>& lights, const FrameSetup& setup, Frame& frame);

/// The frame's data on the GPU; one of these serves every path of a group, refilled each frame.
class FrameBuffers {
  public:
    FrameBuffers();
    void upload(const Frame& frame);
    void bind(const GpuScene& scene) const;
    const gl::Buffer& visible_instances() const { return visible_instances_; }

  private:
    gl::Buffer constants_, visible_instances_;
    gl::TexelBuffer lights_;
};

}  // namespace lightsweep
