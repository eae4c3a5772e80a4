// A path made ready for one size: its targets allocated, its shaders compiled. `execute` is the only place that binds,
// clears, labels and takes time stamps.
#pragma once

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texture.h"
#include "renderer/pass/pass_timer.h"
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

#include <memory>
#include <string>
#include <vector>

namespace lightsweep {

class CompiledPath {
  public:
    /// Throws EnvironmentError when the device refuses a target, std::runtime_error when a shader does not compile.
    CompiledPath(Path path, const PathSetup& setup, int width, int height);

    /// Before `execute`, part of building the frame: the light lists that need no picture.
    void prepare(const Frame& frame);
    void execute(const DrawInput& input, PassTimer& timer) const;
    /// After `execute`: true when light lists had no room and the frame must be drawn again; there is room now. Waits
    /// for the GPU.
    bool grow_light_lists();
    /// Null for paths without.
    const LightListService* light_lists() const { return light_lists_.get(); }
    /// Executes once and counts the shaded fragments times the lights that each evaluates. Never while measuring.
    uint64_t count_light_evaluations(const DrawInput& input);

    const std::vector<std::string>& pass_names() const { return pass_names_; }
    const gl::Texture& texture(TargetId id) const { return textures_[static_cast<size_t>(id.index)]; }
    const gl::Texture& hdr() const { return texture(path_.hdr); }
    const gl::Texture& display() const { return texture(path_.display); }
    const gl::Texture& depth() const { return texture(path_.depth); }
    int bytes_per_pixel() const;  ///< of all targets of the frame's size
    /// What a frame must move at least, were each pass to read its inputs and read or write its targets once: kept
    /// targets both (a depth that is only tested: read), others written. Overdraw, blending of several lights and
    /// textures come on top.
    int moved_bytes_per_pixel() const;
    size_t memory_bytes() const;  ///< of all targets and light lists

  private:
    struct CompiledPass {
        std::vector<CompiledStage> stages;
        gl::Framebuffer framebuffer;
    };
    void bind_and_load(size_t index, const Frame& frame) const;
    void bind_inputs(size_t index, const DrawInput& input) const;
    uint64_t covered_pixels() const;
    uint64_t listed_lights(const shared::FrameData& data) const;
    Recorder recorder(size_t index, const DrawInput& input) const;

    Path path_;
    float depth_clear_;
    double position_error_;
    std::vector<gl::Texture> textures_;
    std::vector<CompiledPass> compiled_;
    std::vector<std::string> pass_names_;
    std::unique_ptr<LightListService> light_lists_;
};

}  // namespace lightsweep
