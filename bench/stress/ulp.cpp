#include "bench/stress/ulp.h"

#include "bench/stress/shader_functions.h"
#include "renderer/gl/buffer.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr uint64_t kSeed = 754;
constexpr size_t kRandomInputs = 65536, kQuickInputs = 4096;
constexpr double kSmallestNormal = 0x1p-126;

std::string text_of(const ShaderFunction& function, const ShaderInput& input) {
    const glm::vec4 values[] = {input.a, input.b, input.c, input.d};
    std::vector<std::string> words;
    for (size_t i = 0; i < function.arguments.size(); ++i) {
        std::vector<std::string> numbers;
        for (int k = 0; k < function.arguments[i]; ++k) numbers.push_back(fmt::format("{:.9g}", values[i][k]));
        const bool is_vector = numbers.size() > 1;
        words.push_back(fmt::format("{} = {}{}{}", "abcd"[i], is_vector ? "(" : "", fmt::join(numbers, ", "),
                                    is_vector ? ")" : ""));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<ShaderInput> inputs_of(const ShaderFunction& function, size_t random_count) {
    std::vector<ShaderInput> inputs = function.special;
    if (!function.input) return inputs;
    Random random(kSeed);
    inputs.reserve(inputs.size() + random_count);
    for (size_t i = 0; i < random_count; ++i) inputs.push_back(function.input(random));
    return inputs;
}

UlpRow measure(const ShaderFunction& function, size_t random_count) {
    const std::vector<ShaderInput> inputs = inputs_of(function, random_count);
    const ShaderCall call(function.includes, function.body, function.defines);
    const std::vector<glm::vec4> results = call(inputs);
    UlpRow row{.function = function.name, .inputs = inputs.size(), .domain = function.domain};
    for (size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec4 exact = function.exact(inputs[i]);
        bool finite = true;
        for (int k = 0; k < function.components; ++k) finite &= std::isfinite(results[i][k]);
        if (!finite) {
            if (row.non_finite++ == 0) row.non_finite_input = text_of(function, inputs[i]);
            continue;
        }
        const double ulps = ulps_off(&results[i].x, &exact.x, function.components);
        row.mean_ulp += ulps;
        if (ulps > row.max_ulp) {
            row.max_ulp = ulps;
            row.worst_input = text_of(function, inputs[i]);
        }
    }
    if (row.inputs > row.non_finite) row.mean_ulp /= static_cast<double>(row.inputs - row.non_finite);
    return row;
}

}  // namespace

double ulp_of(double magnitude) {
    if (magnitude < kSmallestNormal) return 0x1p-149;
    return std::ldexp(1.0, std::ilogb(magnitude) - (std::numeric_limits<float>::digits - 1));
}

double ulps_off(const float* result, const double* exact, int components) {
    double largest = 0.0, off = 0.0;
    for (int k = 0; k < components; ++k) {
        largest = std::max(largest, std::abs(exact[k]));
        const double value = double{result[k]};
        if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
        const bool both_tiny = std::abs(value) < kSmallestNormal && std::abs(exact[k]) < kSmallestNormal;
        if (!both_tiny) off = std::max(off, std::abs(value - exact[k]));
    }
    return off / ulp_of(largest);
}

std::vector<UlpRow> measure_ulp(bool quick) {
    const shared::FrameData frame = call_frame();
    const gl::Buffer constants(std::as_bytes(std::span(&frame, 1)), "frame constants");
    constants.bind_uniform(shared::kFrameBlock);
    std::vector<UlpRow> rows;
    for (const auto& functions : {shader_functions(), stored_codes()}) {
        for (const ShaderFunction& function : functions) {
            rows.push_back(measure(function, quick ? kQuickInputs : kRandomInputs));
        }
    }
    return rows;
}

}  // namespace lightsweep
