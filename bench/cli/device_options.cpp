#include "bench/cli/device_options.h"

#include "renderer/gl/state.h"

namespace lightsweep {

void DeviceOptions::add(CLI::App& command) {
    command.add_option("--device", device, "auto, egl:N, surfaceless or osmesa (lightsweep list devices)");
    command.add_option("--require-renderer", renderer_regex, "refuse (exit 3) unless GL_RENDERER matches this regex");
}

std::unique_ptr<gl::Context> DeviceOptions::make_context() const {
    auto context = gl::Context::create(device);
    if (!renderer_regex.empty()) gl::require_renderer(*context, renderer_regex);
    gl::set_context_defaults();
    return context;
}

}  // namespace lightsweep
