// An arm of a group: one cell's path, ready to draw, and how one frame of it is sampled.
#pragma once

#include "bench/measure/frame_timer.h"
#include "bench/plan/cell.h"
#include "renderer/frame/frame.h"
#include "renderer/image/image.h"
#include "renderer/pass/compiled_path.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// What every arm of a group draws.
struct Subject {
    const GpuScene& scene;
    std::vector<Light> lights;
    int width = 1;
    int height = 1;
    std::optional<Camera> camera{};  ///< in place of the scene's
};

struct FrameSample {
    int64_t cpu_ns = 0;   ///< building the frame: culling, light lists, uploads
    int64_t wall_ns = 0;  ///< from the start of building to the finished picture
    FrameTimes gpu;
};

/// The HDR formats by the names of CellParams::hdr.
gl::Format hdr_format(const std::string& name);
/// The builders by the names of CellParams::light_lists, without auto.
ListBuilder list_builder(const std::string& name);

class Arm {
  public:
    /// `cell.light_lists`: none or the one to use, not auto. Throws InputError (a layout that lacks a field the scene
    /// needs), EnvironmentError (the device refuses), or std::runtime_error (a shader does not compile).
    Arm(const CellParams& cell, const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes);
    /// The same for a path and setup made by the caller (views).
    Arm(Path path, PathSetup setup, const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes);

    /// One frame, built, drawn, finished and timed. One whose light lists were cut short does not count: another is
    /// drawn.
    FrameSample sample(FrameTimer& timer);
    /// One frame, not timed.
    void draw();

    Image hdr_image() const;      ///< of the last frame, linear
    Image display_image() const;  ///< of the last frame, after tone mapping

    const CompiledPath& path() const { return *path_; }
    const Frame& frame() const { return frame_; }
    const PathSetup& setup() const { return setup_; }
    /// A hash of all that a frame asks the device to do: targets, passes, shaders, states, and the frame's data. Arms
    /// with equal keys on one machine differ in nothing that takes time. Of the last frame.
    std::string work_key() const;
    uint64_t count_light_evaluations();

  private:
    DrawInput build();

    const Subject* subject_;
    FrameBuffers* buffers_;
    const DrawShapes* shapes_;
    PathSetup setup_;
    std::unique_ptr<CompiledPath> path_;
    Frame frame_;
};

}  // namespace lightsweep
