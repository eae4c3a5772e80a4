#include "renderer/gl/format.h"

#include "renderer/base/check.h"

#include <glad/gl.h>

#include <iterator>

namespace lightsweep::gl {
namespace {

using enum FormatKind;

constexpr FormatInfo kFormats[] = {
    {"R8", unorm, 1, {8}, 1, false, GL_R8, GL_RED, GL_UNSIGNED_BYTE},
    {"RG8", unorm, 2, {8, 8}, 2, false, GL_RG8, GL_RG, GL_UNSIGNED_BYTE},
    {"RGBA8", unorm, 4, {8, 8, 8, 8}, 4, false, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
    {"SRGB8_A8", unorm, 4, {8, 8, 8, 8}, 4, false, GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE},
    {"R8_SNORM", snorm, 1, {8}, 1, false, GL_R8_SNORM, GL_RED, GL_BYTE},
    {"RG8_SNORM", snorm, 2, {8, 8}, 2, false, GL_RG8_SNORM, GL_RG, GL_BYTE},
    {"RGBA8_SNORM", snorm, 4, {8, 8, 8, 8}, 4, false, GL_RGBA8_SNORM, GL_RGBA, GL_BYTE},
    {"R16", unorm, 1, {16}, 2, false, GL_R16, GL_RED, GL_UNSIGNED_SHORT},
    {"RG16", unorm, 2, {16, 16}, 4, false, GL_RG16, GL_RG, GL_UNSIGNED_SHORT},
    {"RGBA16", unorm, 4, {16, 16, 16, 16}, 8, false, GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT},
    {"R16_SNORM", snorm, 1, {16}, 2, false, GL_R16_SNORM, GL_RED, GL_SHORT},
    {"RG16_SNORM", snorm, 2, {16, 16}, 4, false, GL_RG16_SNORM, GL_RG, GL_SHORT},
    {"RGBA16_SNORM", snorm, 4, {16, 16, 16, 16}, 8, false, GL_RGBA16_SNORM, GL_RGBA, GL_SHORT},
    {"R16F", floating, 1, {16}, 2, false, GL_R16F, GL_RED, GL_HALF_FLOAT},
    {"RG16F", floating, 2, {16, 16}, 4, false, GL_RG16F, GL_RG, GL_HALF_FLOAT},
    {"RGBA16F", floating, 4, {16, 16, 16, 16}, 8, false, GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
    {"R32F", floating, 1, {32}, 4, false, GL_R32F, GL_RED, GL_FLOAT},
    {"RG32F", floating, 2, {32, 32}, 8, false, GL_RG32F, GL_RG, GL_FLOAT},
    {"RGBA32F", floating, 4, {32, 32, 32, 32}, 16, false, GL_RGBA32F, GL_RGBA, GL_FLOAT},
    {"RGB10A2", unorm, 4, {10, 10, 10, 2}, 4, false, GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV},
    {"R11G11B10F", floating, 3, {11, 11, 10}, 4, false, GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV},
    {"R32UI", uint, 1, {32}, 4, false, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT},
    {"RG32UI", uint, 2, {32, 32}, 8, false, GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT},
    {"RGBA32UI", uint, 4, {32, 32, 32, 32}, 16, false, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT},
    {"D16", depth, 1, {16}, 2, false, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT},
    {"D24", depth, 1, {24}, 4, false, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT},
    {"D32F", depth, 1, {32}, 4, false, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT},
    {"D24_S8", depth, 1, {24}, 4, true, GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8},
    {"D32F_S8", depth, 1, {32}, 8, true, GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV},
};

}  // namespace

const FormatInfo& info(Format format) {
    CHECK_THAT(static_cast<size_t>(format) < std::size(kFormats), "format {}", static_cast<int>(format));
    return kFormats[static_cast<size_t>(format)];
}

const std::vector<std::string>& format_names() {
    static const auto names = [] {
        std::vector<std::string> result;
        for (const auto& format : kFormats) result.emplace_back(format.name);
        return result;
    }();
    return names;
}

Format with_stencil(Format depth) {
    if (info(depth).stencil) return depth;
    return depth == Format::D32F ? Format::D32F_S8 : Format::D24_S8;
}

}  // namespace lightsweep::gl
