// A path made ready for one size: its targets allocated, its shaders compiled. `execute` is the only place that binds,
// clears, labels and takes time stamps.
#pragma once

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texture.h"
#include "renderer/pass/pass_timer.h"
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace lightsweep {

class CompiledPath {
  public:
    /// Throws EnvironmentError when the device refuses a target, std::runtime_error when a shader does not compile.
    CompiledPath(Path path, const PathSetup& setup, int width, int height);

    /// Before `execute`, part of building the frame: what of culling and light lists needs no picture. Keeps references
    /// until the frame is executed. Throws EnvironmentError when the device refuses as many lights.
    void prepare(const GpuScene& scene, const Frame& frame);
    void execute(const DrawInput& input, PassTimer& timer);
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
    // Of the last frame:
    int64_t saved_draws() const { return occlusion_ ? occlusion_->saved_draws() : 0; }
    uint64_t hidden_instances() const { return occlusion_ ? occlusion_->hidden_instances() : 0; }
    uint64_t hidden_triangles() const { return occlusion_ ? occlusion_->hidden_triangles() : 0; }
    int idle_passes() const { return idle_passes_; }  ///< those left out
    /// See path_text.
    const std::string& text() const { return text_; }

  private:
    struct CompiledPass {
        std::vector<CompiledStage> stages;
        gl::Framebuffer framebuffer;
        std::vector<size_t> last_used;  ///< targets that nothing reads after this pass
    };
    void check_loops(const Frame& frame) const;
    bool is_idle(const Pass& pass, const Frame& frame) const;
    void load(const Pass& pass, const gl::Framebuffer& framebuffer, const Frame& frame) const;
    void bind_inputs(const Pass& pass, const DrawInput& input) const;
    Recorder begin_pass(size_t index, const DrawInput& input);
    void end_pass(size_t index) const;
    void find_last_uses();
    uint64_t covered_pixels() const;
    uint64_t listed_lights(const shared::FrameData& data) const;

    Path path_;
    SkipSet skips_;
    std::string text_;
    float depth_clear_;
    double position_error_;
    std::vector<gl::Texture> textures_;
    std::vector<CompiledPass> compiled_;
    std::vector<std::string> pass_names_;
    std::unique_ptr<LightListService> light_lists_;
    std::unique_ptr<OcclusionCuller> occlusion_;
    std::array<gl::Buffer, 3> occlusion_instances_;  ///< by Instances: what the culler's lists hold
    int idle_passes_ = 0;
};

}  // namespace lightsweep
