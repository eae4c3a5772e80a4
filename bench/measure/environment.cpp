#include "bench/measure/environment.h"

#include "generated/build_info.h"
#include "renderer/gl/workarounds.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/sysinfo.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <string_view>
#include <thread>

namespace lightsweep {
namespace {

// The value of the first line `key<separator>value` of a file such as /proc/cpuinfo.
std::string value_in(const char* file, std::string_view key, char separator) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const size_t at = line.find(separator);
        if (at == std::string::npos || !line.starts_with(key)) continue;
        const size_t first = line.find_first_not_of(" \t\"", at + 1), last = line.find_last_not_of(" \t\"");
        if (first != std::string::npos) return line.substr(first, last - first + 1);
    }
    return "unknown";
}

std::map<std::string, std::string> driver_variables() {
    static constexpr std::array kPrefixes = {"LP_",   "GALLIUM_", "MESA_", "LIBGL_", "ST_",         "TGSI_",
                                             "DRAW_", "EGL_",     "__EGL", "__GL",   "vblank_mode", "CUDA_VISIBLE"};
    std::map<std::string, std::string> result;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view text(*variable);
        for (const std::string_view prefix : kPrefixes) {
            if (!text.starts_with(prefix)) continue;
            const size_t equals = text.find('=');
            result.emplace(text.substr(0, equals), text.substr(equals + 1));
        }
    }
    return result;
}

}  // namespace

Environment read_environment(const gl::Context& context) {
    struct sysinfo memory {};
    sysinfo(&memory);
    struct utsname kernel {};
    uname(&kernel);
    const auto& gl = context.info();
    Environment environment;
    environment.cpu = value_in("/proc/cpuinfo", "model name", ':');
    environment.cores = std::thread::hardware_concurrency();
    environment.memory_bytes = static_cast<int64_t>(memory.totalram) * memory.mem_unit;
    environment.os =
        fmt::format("{}, {} {}", value_in("/etc/os-release", "PRETTY_NAME", '='), kernel.sysname, kernel.release);
    environment.gl_provider = gl.provider;
    environment.gl_vendor = gl.vendor;
    environment.gl_renderer = gl.renderer;
    environment.gl_version = gl.version;
    environment.software = gl.software;
    environment.driver_variables = driver_variables();
    environment.workarounds = gl::active_workarounds(gl);
    environment.compiler = kBuildCompiler;
    environment.fingerprint = environment_fingerprint(environment);
    return environment;
}

std::string program_version() { return kBuildVersion; }

std::optional<std::string> program_git_commit() {
    const std::string commit = kBuildGitCommit;
    return commit.empty() ? std::nullopt : std::optional(commit);
}

std::string program_build_type() { return kBuildType; }

std::string utc_now() {
    const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(now)));
}

}  // namespace lightsweep
