// How much of a picture hangs on the last bits of what is interpolated over its triangles. Most paths take that from
// the rasteriser, and agree; one that rebuilds it (visibility) rounds elsewhere, and sees another texel where a texture
// is steep or its level changes, another radiance where a highlight is sharp.
#pragma once

#include "renderer/base/file.h"
#include "renderer/base/resources.h"
#include "renderer/image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace lightsweep {

using ReplacedText = std::map<std::string, std::string>;

/// `text` with one place of it said differently. Throws when it no longer says that.
inline std::string said_differently(std::string text, const std::string& right, const std::string& wrong) {
    const size_t at = text.find(right);
    if (at == std::string::npos) throw std::runtime_error("the shader no longer says: " + right);
    return text.replace(at, right.size(), wrong);
}

inline std::string shader_text(const std::string& file) { return read_file(resource("shaders/" + file)); }

/// Which way to move: -1, 0 or 1 each.
struct Movement {
    int u = 0, v = 0, level = 0, normal_x = 0, normal_y = 0;
};

/// lib/material.glsl for drawn meshes, with what it is given moved by what 32 bits may round it by: four roundings of
/// 2^-24, of the attribute itself and of the window position in a target of `size_px`, over which the attribute changes
/// by its slope per pixel. A texture's level is the logarithm of such a slope, a difference of two attributes.
inline ReplacedText moved_attributes(int size_px, const Movement& way) {
    const std::string functions = fmt::format(
                                      "const float kSizePx = {}.0;\nconst vec3 kMoveSample = vec3({}, {}, {});\n"
                                      "const vec2 kMoveNormal = vec2({}, {});\n",
                                      size_px, way.u, way.v, way.level, way.normal_x, way.normal_y) +
                                  R"(const float kRoundings = 4.0 * exp2(-24.0);
vec4 sample_material(sampler2D map, vec2 uv) {
    vec2 slope = max(abs(dFdx(uv)), abs(dFdy(uv))) + 1e-20;
    vec2 rounded = kRoundings * (abs(uv) + kSizePx * slope);
    float level_rounded = log2(1.0 + 2.0 * min(max(rounded.x / slope.x, rounded.y / slope.y), 0.5));
    return texture(map, uv + rounded * kMoveSample.xy, level_rounded * kMoveSample.z);
}
vec3 moved_normal(vec3 normal) {
    float rounded = kRoundings * (1.0 + kSizePx * max(length(dFdx(normal)), length(dFdy(normal))));
    vec3 x = normalize(cross(normal, abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    return normal + rounded * (kMoveNormal.x * x + kMoveNormal.y * cross(normal, x));
}
)";
    std::string text =
        said_differently(shader_text("lib/material.glsl"),
                         "vec4 sample_material(sampler2D map, vec2 uv) { return texture(map, uv); }", functions);
    text = said_differently(std::move(text), "s.position = position;",
                            "s.position = position;\n    normal = moved_normal(normal);");
    return {{"lib/material.glsl", std::move(text)}};
}

/// By how much each value of forward's picture moves then. `draw`: forward's picture with some of its shader text
/// replaced. All corners of what a texel may move by are tried, since drivers may filter in 8 bits: such a texel stays
/// as it is, or takes a step of 1/255, where a corner lies beyond the next step's edge.
template <class Draw>
Image attribute_movement(int size_px, Draw draw) {
    const Image picture = draw(ReplacedText{});
    const auto moved = [&](const Movement& way) {
        Image difference = draw(moved_attributes(size_px, way));
        for (size_t i = 0; i < picture.rgb.size(); ++i)
            difference.rgb[i] = std::abs(difference.rgb[i] - picture.rgb[i]);
        return difference;
    };
    Image sum = moved({.u = 1, .v = 1, .level = 1});
    for (int corner = 1; corner < 8; ++corner) {
        const Image other = moved({.u = corner & 1 ? -1 : 1, .v = corner & 2 ? -1 : 1, .level = corner & 4 ? -1 : 1});
        for (size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] = std::max(sum.rgb[i], other.rgb[i]);
    }
    for (const Movement& way : {Movement{.normal_x = 1}, Movement{.normal_y = 1}}) {
        const Image other = moved(way);
        for (size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] += 2.0F * other.rgb[i];  // either way
    }
    return sum;
}

}  // namespace lightsweep
