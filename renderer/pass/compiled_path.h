// A path made ready for one size: its targets allocated, its shaders compiled. `execute` is the only place that binds,
// clears, labels and takes time stamps.
#pragma once

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texture.h"
#include "renderer/pass/pass_timer.h"
#include "renderer/pass/path.h"
#include "renderer/pass/recorder.h"

#include <string>
#include <vector>

namespace lightsweep {

class CompiledPath {
  public:
    /// Throws EnvironmentError when the device refuses a target, std::runtime_error when a shader does not compile.
    CompiledPath(Path path, const PathSetup& setup, int width, int height);

    void execute(const DrawInput& input, PassTimer& timer) const;
    /// Executes once and counts the shaded fragments times the lights that each evaluates. Never while measuring.
    uint64_t count_light_evaluations(const DrawInput& input) const;

    const std::vector<std::string>& pass_names() const { return pass_names_; }
    const gl::Texture& texture(TargetId id) const { return textures_[static_cast<size_t>(id.index)]; }
    const gl::Texture& hdr() const { return texture(path_.hdr); }
    const gl::Texture& display() const { return texture(path_.display); }
    const gl::Texture& depth() const { return texture(path_.depth); }
    int bytes_per_pixel() const;  ///< of all targets
    size_t memory_bytes() const;  ///< of all targets

  private:
    struct CompiledPass {
        std::vector<CompiledStage> stages;
        gl::Framebuffer framebuffer;
    };
    void bind_and_load(size_t index, const Frame& frame) const;
    void bind_inputs(size_t index, const DrawInput& input) const;
    uint64_t covered_pixels() const;

    Path path_;
    float depth_clear_;
    std::vector<gl::Texture> textures_;
    std::vector<CompiledPass> compiled_;
    std::vector<std::string> pass_names_;
};

}  // namespace lightsweep
