#include "bench/measure/checked_main.h"

#include "renderer/base/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

namespace lightsweep {

int checked_main(const char* program, int (*body)(int argc, char** argv), int argc, char** argv) {
    const auto report = [&](const char* message, int code) {
        fmt::print(stderr, "{}: {}\n", program, message);
        return code;
    };
    try {
        return body(argc, argv);
    } catch (const InputError& error) {
        return report(error.what(), kBadInput);
    } catch (const EnvironmentError& error) {
        return report(error.what(), kRefused);
    } catch (const std::exception& error) {
        return report(fmt::format("failed: {}", error.what()).c_str(), kCellsFailed);
    }
}

}  // namespace lightsweep
