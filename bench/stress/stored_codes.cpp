// Encodings on all codes of a channel. The code that comes back is compared with the one that went in: both are whole
// numbers, and anything but 0 ulps is another code.
#include "bench/stress/shader_functions.h"

#include <fmt/format.h>

#include <cmath>

namespace lightsweep {
namespace {

constexpr int kWidths[] = {8, 16};

ShaderInput codes(int x, int y = 0) {
    return {.a = glm::vec4(static_cast<float>(x), static_cast<float>(y), 0.0F, 0.0F)};
}

glm::dvec4 same_code(const ShaderInput& in) { return {in.a.x, in.a.y, 0.0, 0.0}; }

ShaderFunction scalar_codes(const std::string& encoding, const std::string& call, int bits) {
    const int highest = (1 << bits) - 1;
    ShaderFunction function{.name = fmt::format("{}: codes of {} bits", encoding, bits),
                            .domain = fmt::format("all {} codes", highest + 1),
                            .arguments = {1},
                            .includes = {"gbuffer/encodings/" + encoding + ".glsl"},
                            .body = fmt::format("float value = a.x / {0}.0;\nresult.x = round(clamp({1}, 0.0, 1.0) * "
                                                "{0}.0);",
                                                highest, call),
                            .input = {},
                            .exact = same_code};
    for (int code = 0; code <= highest; ++code) function.special.push_back(codes(code));
    return function;
}

// An encoding of normals in two signed channels.
struct NormalCodes {
    const char* encoding;
    const char* domain;
    const char* encode;  // of the vec3 n; {0} is the largest code
    const char* decode;  // of the vec2 e
    bool (*holds)(double x, double y, double step);
};

// The rim of the square's lower triangles holds each direction twice: of a pair, encoding takes the positive one.
bool once_on_the_square(double x, double y, double) {
    return (std::abs(x) < 1.0 || y >= 0.0) && (std::abs(y) < 1.0 || x >= 0.0);
}
bool anywhere(double, double, double) { return true; }
// At the rim all codes are one direction, or nearly so.
bool inside_the_disc(double x, double y, double step) { return std::hypot(x, y) <= 1.0 - 2.0 * step; }

constexpr NormalCodes kNormalCodes[] = {
    {"oct", "of the square's rim, one code of each direction", "encode_oct(n)", "decode_oct(e)", once_on_the_square},
    {"oct_precise", "of the square's rim, one code of each direction",
     "encode_oct_precise(n, vec2(1.0 / {0}.0), vec2(0.0))", "decode_oct_precise(e)", once_on_the_square},
    {"hemi_oct", "the whole square", "encode_hemi_oct(n, ivec2(40, 90))", "decode_hemi_oct(e, ivec2(40, 90))",
     anywhere},
    {"spheremap", "of the disc, but for its last two steps", "encode_spheremap(n)", "decode_spheremap(e)",
     inside_the_disc},
    {"xy_z", "of the disc, but for its last two steps", "encode_xy_z(n, ivec2(40, 90))",
     "decode_xy_z(e, ivec2(40, 90))", inside_the_disc},
};

ShaderFunction normal_codes(const NormalCodes& codes_of, int bits) {
    const int highest = (1 << (bits - 1)) - 1;
    ShaderFunction function{
        .name = fmt::format("{}: codes of {} bits", codes_of.encoding, bits),
        .domain = fmt::format("{}; {}", bits == 8 ? "all pairs" : "all codes with two others", codes_of.domain),
        .arguments = {2},
        .components = 2,
        .includes = {fmt::format("gbuffer/encodings/{}.glsl", codes_of.encoding)},
        .body = fmt::format("vec2 e = a.xy / {0}.0;\nvec3 n = {1};\nresult.xy = round(clamp({2}, -1.0, 1.0) * {0}.0);",
                            highest, codes_of.decode, fmt::format(fmt::runtime(codes_of.encode), highest)),
        .input = {},
        .exact = same_code};
    const auto add = [&](int x, int y) {
        const double step = 1.0 / highest;
        if (codes_of.holds(x * step, y * step, step)) function.special.push_back(codes(x, y));
    };
    for (int x = -highest; x <= highest; ++x) {
        if (bits == 8) {
            for (int y = -highest; y <= highest; ++y) add(x, y);
        } else {
            add(x, highest / 3);
            add(-highest / 5, x);
        }
    }
    return function;
}

// Three mantissas and an exponent in one integer: what is decoded again is the same value, to the last bit.
ShaderFunction shared_exponent_codes(const std::string& encoding, int mantissa_bits, int exponent_bits, int bias) {
    const int mantissas = 1 << mantissa_bits, exponents = 1 << exponent_bits;
    const auto code = [=](int r, int g, int b, int exponent) {
        return ShaderInput{.a = glm::vec4(glm::ivec4(r, g, b, exponent))};
    };
    ShaderFunction function{
        .name = fmt::format("{}: codes", encoding),
        .domain = "all exponents, all mantissas of one channel",
        .arguments = {4},
        .components = 3,
        .includes = {"gbuffer/encodings/" + encoding + ".glsl"},
        .body = fmt::format("uvec4 code = uvec4(a);\nresult.xyz = decode_{0}(encode_{0}(decode_{0}(code.x | (code.y << "
                            "{1}) | (code.z << {2}) | (code.w << {3}))));",
                            encoding, mantissa_bits, 2 * mantissa_bits, 3 * mantissa_bits),
        .input = {},
        .exact = [=](const ShaderInput& in) {
            return glm::dvec4(glm::dvec3(in.a) * std::exp2(double{in.a.w} - bias), 0.0);
        }};
    for (int exponent = 0; exponent < exponents; ++exponent) {
        for (int m = 0; m < mantissas; ++m) {
            function.special.push_back(code(m, mantissas - 1 - m, m / 3, exponent));
            function.special.push_back(code(m, 0, m / 7, exponent));
        }
    }
    return function;
}

}  // namespace

std::vector<ShaderFunction> stored_codes() {
    std::vector<ShaderFunction> functions;
    for (const int bits : kWidths) {
        functions.push_back(scalar_codes("linear", "encode_linear(decode_linear(value))", bits));
        functions.push_back(scalar_codes("sqrt", "encode_sqrt(decode_sqrt(value))", bits));
        functions.push_back(scalar_codes("log2", "encode_log2(decode_log2(value))", bits));
        functions.push_back(scalar_codes("gamma2", "encode_gamma2(decode_gamma2(vec3(value))).x", bits));
        for (const NormalCodes& normals : kNormalCodes) functions.push_back(normal_codes(normals, bits));
    }
    functions.push_back(shared_exponent_codes("rgb9e5", 9, 5, 24));
    functions.push_back(shared_exponent_codes("rgb4e3", 4, 3, 6));
    return functions;
}

}  // namespace lightsweep
