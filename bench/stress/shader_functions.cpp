#include "bench/stress/shader_functions.h"

#include "renderer/frame/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightsweep {
namespace {

using std::numbers::pi;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

ShaderInput scalar(double x) { return {.a = glm::vec4(static_cast<float>(x), 0.0F, 0.0F, 0.0F)}; }
ShaderInput vector(const glm::vec3& v) { return {.a = glm::vec4(v, 0.0F)}; }

glm::dvec4 result(double x) { return {x, 0.0, 0.0, 0.0}; }
glm::dvec4 result(const glm::dvec3& v) { return {v, 0.0}; }

double log_uniform(Random& random, double low, double high) {
    return low * std::exp(random.uniform() * std::log(high / low));
}

glm::dvec3 direction(Random& random) {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, 2.0 * pi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

// At `angle` from the unit vector `axis`, any way round.
glm::dvec3 turned(Random& random, const glm::dvec3& axis, double angle) {
    const glm::dvec3 across = glm::normalize(glm::cross(axis, direction(random)));
    return std::cos(angle) * axis + std::sin(angle) * across;
}

auto log_scalars(double low, double high) {
    return [=](Random& random) { return scalar(log_uniform(random, low, high)); };
}

auto vectors_of_length(double low, double high) {
    return [=](Random& random) {
        const double length = log_uniform(random, low, high);
        return vector(glm::vec3(direction(random) * length));
    };
}

// --- The driver's own ---

void add_driver_functions(std::vector<ShaderFunction>& functions) {
    const auto add = [&](const char* name, const char* domain, const char* body, auto input, double (*exact)(double)) {
        functions.push_back({.name = name,
                             .domain = domain,
                             .arguments = {1},
                             .includes = {},
                             .body = body,
                             .input = input,
                             .exact = [exact](const ShaderInput& in) { return result(exact(double{in.a.x})); }});
    };
    // Near 1 the logarithm is small, and GL bounds its absolute error alone (2^-21 between 1/2 and 2).
    add(
        "driver: log2", "1e-30 to 1/2, 2 to 1e30", "result.x = log2(a.x);",
        [](Random& random) {
            const double x = log_uniform(random, 2.0, 1e30);
            return scalar(random.uniform() < 0.5 ? x : 1.0 / x);
        },
        [](double x) { return std::log2(x); });
    add(
        "driver: exp2", "-100 to 100", "result.x = exp2(a.x);",
        [](Random& random) { return scalar(random.uniform(-100.0, 100.0)); }, [](double x) { return std::exp2(x); });
    add("driver: sqrt", "1e-30 to 1e30", "result.x = sqrt(a.x);", log_scalars(1e-30, 1e30),
        [](double x) { return std::sqrt(x); });
    add("driver: inversesqrt", "1e-30 to 1e30", "result.x = inversesqrt(a.x);", log_scalars(1e-30, 1e30),
        [](double x) { return 1.0 / std::sqrt(x); });
    functions.push_back({.name = "driver: normalize",
                         .domain = "length 1e-15 to 1e15",
                         .arguments = {3},
                         .components = 3,
                         .includes = {},
                         .body = "result.xyz = normalize(a.xyz);",
                         .input = vectors_of_length(1e-15, 1e15),
                         .exact = [](const ShaderInput& in) { return result(glm::normalize(glm::dvec3(in.a))); }});
}

// --- Vectors, colours, the frame ---

glm::dvec4 exact_direction(const ShaderInput& in) {
    const glm::dvec3 v(in.a);
    const double length = glm::length(v);
    return result(std::isfinite(length) && length > 0.0 ? v / length : glm::dvec3(0.0, 0.0, 1.0));
}

double srgb(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

// (2.51 x^2 + 0.03 x) / (2.43 x^2 + 0.59 x + 0.14), Narkowicz's numbers.
double filmic(double x) { return (2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14); }

constexpr double kNear = 0.1, kFar = 1000.0;
// 24 slices from kNear to kFar.
constexpr float kSliceScale = 1.806176F, kSliceOffset = 6.0F;

double slice_place(float z) { return std::log2(double{z}) * double{kSliceScale} + double{kSliceOffset}; }

// Away from where two slices meet: there either of them is right.
ShaderInput inside_a_slice(Random& random) {
    for (;;) {
        const ShaderInput input = scalar(log_uniform(random, 1e-3, 1e5));
        const double place = slice_place(input.a.x);
        if (std::abs(place - std::round(place)) > 1e-4) return input;
    }
}

void add_basics(std::vector<ShaderFunction>& functions) {
    functions.push_back({.name = "safe_normalize",
                         .domain = "length 1e-30 to 1e38; 2^-126, 0, Inf, NaN",
                         .arguments = {3},
                         .components = 3,
                         .includes = {"lib/safe_normalize.glsl"},
                         .body = "result.xyz = safe_normalize(a.xyz, vec3(0.0, 0.0, 1.0));",
                         .input = vectors_of_length(1e-30, 1e38),
                         .special = {vector({0, 0, 0}), vector({-0.0F, 0, 0}), vector({3e38F, 3e38F, -3e38F}),
                                     vector({1.2e-38F, 0, 0}), vector({kInfinity, 0, 0}), vector({kNaN, 1, 0})},
                         .exact = exact_direction});
    functions.push_back({.name = "luminance",
                         .domain = "channels 1e-4 to 1e4",
                         .arguments = {3},
                         .includes = {"lib/surface.glsl"},
                         .body = "result.x = luminance(a.xyz);",
                         .input =
                             [](Random& random) {
                                 const double r = log_uniform(random, 1e-4, 1e4), g = log_uniform(random, 1e-4, 1e4);
                                 return vector(glm::vec3(glm::dvec3(r, g, log_uniform(random, 1e-4, 1e4))));
                             },
                         .exact =
                             [](const ShaderInput& in) {
                                 return result(glm::dot(glm::dvec3(in.a), glm::dvec3(0.2126, 0.7152, 0.0722)));
                             }});
    functions.push_back({.name = "view_distance",
                         .domain = "reversed depth 1e-7 to 1, near 0.1, far 1000",
                         .arguments = {1},
                         .includes = {"lib/frame.glsl"},
                         .body = "result.x = view_distance(a.x);",
                         .input = log_scalars(1e-7, 1.0),
                         .special = {scalar(0.0), scalar(1.0)},
                         .exact = [](const ShaderInput& in) {
                             return result(kNear * kFar / (kNear + double{in.a.x} * (kFar - kNear)));
                         }});
    functions.push_back(
        {.name = "slice_of",
         .domain = "distance 1e-3 to 1e5, 24 slices from 0.1 to 1000, 1e-4 of a slice away from edges; 0",
         .arguments = {1},
         .includes = {"shared/types.h", "shared/light_cell.h"},
         .body = fmt::format("LightGridData grid;\ngrid.slices = 24u;\ngrid.slice_scale = {:.9g};\n"
                             "grid.slice_offset = {:.1f};\nresult.x = float(slice_of(grid, a.x));",
                             kSliceScale, kSliceOffset),
         .input = inside_a_slice,
         .special = {scalar(0.0), scalar(-1.0), scalar(3e38)},
         .exact = [](const ShaderInput& in) {
             return result(in.a.x > 0.0F ? std::clamp(std::floor(slice_place(in.a.x)), 0.0, 23.0) : 0.0);
         }});
    functions.push_back({.name = "srgb_encode",
                         .domain = "1e-7 to 1; 0",
                         .arguments = {1},
                         .includes = {"lib/display.glsl"},
                         .body = "result.x = srgb_encode(a.xxx).x;",
                         .input = log_scalars(1e-7, 1.0),
                         .special = {scalar(0.0), scalar(1.0)},
                         .exact = [](const ShaderInput& in) { return result(srgb(double{in.a.x})); }});
    functions.push_back({.name = "aces_fit",
                         .domain = "1e-6 to 65504; 0",
                         .arguments = {1},
                         .includes = {"lib/display.glsl"},
                         .body = "result.x = aces_fit(a.xxx).x;",
                         .input = log_scalars(1e-6, 65504.0),
                         .special = {scalar(0.0), scalar(65504.0)},
                         .exact = [](const ShaderInput& in) { return result(filmic(double{in.a.x})); }});
}

// --- Lights ---

// a: the surface's place, with the light at the origin; b.x: the light's radius.
double attenuation(const ShaderInput& in) {
    const double distance2 = glm::dot(glm::dvec3(in.a), glm::dvec3(in.a)), radius = double{in.b.x};
    const double ratio2 = distance2 / (radius * radius);
    const double window = std::max((1.0 - ratio2) * (1.0 + ratio2), 0.0);
    return window * window / std::max(distance2, 1e-4);
}

ShaderInput place_and_radius(Random& random) {
    const double radius = log_uniform(random, 0.1, 100.0), share = log_uniform(random, 1e-4, 0.99);
    ShaderInput input = vector(glm::vec3(direction(random) * (radius * share)));
    input.b.x = static_cast<float>(radius);
    return input;
}

ShaderInput with_radius(const glm::vec3& place, float radius) {
    ShaderInput input = vector(place);
    input.b.x = radius;
    return input;
}

// Full within 20 degrees from -z, nothing from 30 on.
constexpr float kSpotScale = 13.5745592F, kSpotOffset = -11.7559131F;

double spot_intensity(const ShaderInput& in) {
    const glm::dvec3 to_surface = glm::normalize(glm::dvec3(in.a));
    const double share = std::clamp(-to_surface.z * double{kSpotScale} + double{kSpotOffset}, 0.0, 1.0);
    return share * share * attenuation(in);
}

void add_lights(std::vector<ShaderFunction>& functions) {
    const std::string point =
        "LightData light = LightData(vec3(0.0), b.x, vec3(1.0), 0.0, vec3(0.0, 0.0, -1.0), 1.0);\n";
    functions.push_back({.name = "local_light: irradiance",
                         .domain = "distance 1e-4 to 0.99 of a radius of 0.1 to 100; 0, the radius, past it",
                         .arguments = {3, 1},
                         .includes = {"lib/light.glsl"},
                         .body = point + "result.x = local_light(light, a.xyz).irradiance.x;",
                         .input = place_and_radius,
                         .special = {with_radius({0, 0, 0}, 1), with_radius({1e-20F, 0, 0}, 1),
                                     with_radius({0, 2, 0}, 2), with_radius({0, 0, 1e18F}, 5)},
                         .exact = [](const ShaderInput& in) { return result(attenuation(in)); }});
    functions.push_back({.name = "local_light: direction",
                         .domain = "distance 1e-4 to 0.99 of a radius of 0.1 to 100",
                         .arguments = {3, 1},
                         .components = 3,
                         .includes = {"lib/light.glsl"},
                         .body = point + "result.xyz = local_light(light, a.xyz).direction;",
                         .input = place_and_radius,
                         .exact = [](const ShaderInput& in) { return result(-glm::normalize(glm::dvec3(in.a))); }});
    functions.push_back(
        {.name = "local_light: spot",
         .domain = "0 to 29 of the 30 degrees from the axis, distance 0.1 to 10",
         .arguments = {3, 1},
         .includes = {"lib/light.glsl"},
         .body = fmt::format("LightData light = LightData(vec3(0.0), b.x, vec3(1.0), {:.9g}, vec3(0.0, 0.0, -1.0), "
                             "{:.9g});\nresult.x = local_light(light, a.xyz).irradiance.x;",
                             kSpotScale, kSpotOffset),
         .defines = {"HAS_SPOT_LIGHTS"},
         .input =
             [](Random& random) {
                 const double angle = glm::radians(random.uniform(0.0, 29.0)),
                              distance = log_uniform(random, 0.1, 10.0);
                 return with_radius(glm::vec3(turned(random, {0.0, 0.0, -1.0}, angle) * distance), 100.0F);
             },
         .exact = [](const ShaderInput& in) { return result(spot_intensity(in)); }});
}

// --- Reflection: a normal, b.x roughness, c towards the eye, d towards the light ---

// A half vector within four times the lobe's width of the normal, so that most of the lobe's peak is seen.
ShaderInput lobe_input(Random& random, double least_roughness) {
    for (;;) {
        const double roughness = log_uniform(random, least_roughness, 1.0);
        const glm::dvec3 normal = direction(random);
        const double width = std::min(4.0 * roughness * roughness, 1.2);
        const glm::dvec3 half = turned(random, normal, width * random.uniform());
        const glm::dvec3 eye = turned(random, half, random.uniform(0.0, 1.3));
        const glm::dvec3 light = 2.0 * glm::dot(eye, half) * half - eye;
        if (glm::dot(normal, eye) < 0.05 || glm::dot(normal, light) < 0.05) continue;
        return {.a = glm::vec4(normal, 0.0),
                .b = glm::vec4(static_cast<float>(roughness), 0.0F, 0.0F, 0.0F),
                .c = glm::vec4(eye, 0.0),
                .d = glm::vec4(light, 0.0)};
    }
}

struct ExactLobes {
    double diffuse, specular, fresnel;  // fresnel: (1 - v.h)^5
};

// glTF 2.0, appendix B, from the sine between normal and half vector: vectors as given, unit or nearly so.
ExactLobes exact_ggx(const ShaderInput& in) {
    const glm::dvec3 n(in.a), v(in.c), l(in.d), h = glm::normalize(v + l);
    const double alpha = std::max(double{in.b.x} * double{in.b.x}, 0.002), square = alpha * alpha;
    const double n_l = glm::dot(n, l), n_v = glm::dot(n, v), n_h = glm::dot(n, h);
    const glm::dvec3 across = glm::cross(n, h);
    const double spread = n_h * n_h * square + glm::dot(across, across);
    const double masking =
        n_l * std::sqrt(square + (1.0 - square) * n_v * n_v) + n_v * std::sqrt(square + (1.0 - square) * n_l * n_l);
    return {n_l, square / (pi * spread * spread) * n_l / (2.0 * masking), std::pow(1.0 - glm::dot(v, h), 5.0)};
}

double exact_blinn_phong(const ShaderInput& in) {
    const glm::dvec3 n(in.a), v(in.c), l(in.d), h = glm::normalize(v + l);
    const double square = std::pow(double{in.b.x}, 4.0), exponent = 2.0 / square - 2.0;
    // A unit normal's cosine, from the sine.
    const glm::dvec3 across = glm::cross(n, h);
    const double cosine = std::sqrt(std::max(1.0 - glm::dot(across, across) / glm::dot(n, n), 0.0));
    return (exponent + 8.0) / (8.0 * pi) * std::pow(cosine, exponent) * glm::dot(n, l);
}

void add_reflection(std::vector<ShaderFunction>& functions) {
    const auto add = [&](const char* name, const char* domain, const char* model, const char* lobe, double roughness,
                         double (*exact)(const ShaderInput&)) {
        functions.push_back(
            {.name = name,
             .domain = domain,
             .arguments = {3, 1, 3, 3},
             .includes = {"lib/brdf.glsl"},
             .body = std::string("result.x = light_lobes(a.xyz, b.x, MODEL_") + model + ", c.xyz, d.xyz)." + lobe + ";",
             .defines = {std::string("HAS_") + model},
             .input = [roughness](Random& random) { return lobe_input(random, roughness); },
             .exact = [exact](const ShaderInput& in) { return result(exact(in)); }});
    };
    add("lambert: diffuse", "n.l and n.v above 0.05", "LAMBERT", "diffuse", 0.1,
        [](const ShaderInput& in) { return glm::dot(glm::dvec3(in.a), glm::dvec3(in.d)); });
    add("blinn_phong: f0", "roughness 0.15 to 1, up to four lobe widths off", "BLINN_PHONG", "f0", 0.15,
        exact_blinn_phong);
    constexpr const char* kLobes = "roughness 0.045 to 1 (alpha 0.002), up to four lobe widths off";
    add("ggx: diffuse", kLobes, "GGX", "diffuse", 0.0448, [](const ShaderInput& in) {
        const ExactLobes lobes = exact_ggx(in);
        return (1.0 - lobes.fresnel) * lobes.diffuse;
    });
    add("ggx: f0", kLobes, "GGX", "f0", 0.0448, [](const ShaderInput& in) {
        const ExactLobes lobes = exact_ggx(in);
        return (1.0 - lobes.fresnel) * lobes.specular;
    });
    // What f0 and f90 add up to: near the mirror direction f90 alone is nearly nothing, and rounding all of it.
    functions.push_back({.name = "ggx: f0 + f90",
                         .domain = kLobes,
                         .arguments = {3, 1, 3, 3},
                         .includes = {"lib/brdf.glsl"},
                         .body = "Lobes lobes = light_lobes(a.xyz, b.x, MODEL_GGX, c.xyz, d.xyz);\n"
                                 "result.x = lobes.f0 + lobes.f90;",
                         .defines = {"HAS_GGX"},
                         .input = [](Random& random) { return lobe_input(random, 0.0448); },
                         .exact = [](const ShaderInput& in) { return result(exact_ggx(in).specular); }});
}

}  // namespace

shared::FrameData call_frame() {
    shared::FrameData frame{};
    const Camera camera{
        .eye = glm::dvec3(0.0), .target = {2.0, -1.0, 3.0}, .near_distance = kNear, .far_distance = kFar};
    set_camera_constants({.camera = camera, .width = 256, .height = 256}, frame);
    return frame;
}

std::vector<ShaderFunction> shader_functions() {
    std::vector<ShaderFunction> functions;
    add_driver_functions(functions);
    add_basics(functions);
    add_lights(functions);
    add_reflection(functions);
    return functions;
}

}  // namespace lightsweep
