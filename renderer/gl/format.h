// Texel formats by the names that layout files use, and what each can hold.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep::gl {

enum class Format : uint8_t {
    R8,
    RG8,
    RGBA8,
    SRGB8_A8,
    R8_SNORM,
    RG8_SNORM,
    RGBA8_SNORM,
    R16,
    RG16,
    RGBA16,
    R16_SNORM,
    RG16_SNORM,
    RGBA16_SNORM,
    R16F,
    RG16F,
    RGBA16F,
    R32F,
    RG32F,
    RGBA32F,
    RGB10A2,
    R11G11B10F,
    R32UI,
    RG32UI,
    RGBA32UI,
    D16,
    D24,
    D32F,
    D24_S8,
    D32F_S8,
};

enum class FormatKind : uint8_t { unorm, snorm, floating, uint, depth };

struct FormatInfo {
    std::string_view name;
    FormatKind kind;
    uint8_t components;  ///< 1 for depth
    uint8_t bits[4];     ///< of each component; for float formats the stored width
    uint8_t bytes;       ///< per texel, as a GPU stores it (D24: 4, D32F_S8: 8)
    bool stencil;
    unsigned gl_internal_format, gl_format, gl_type;
};

const FormatInfo& info(Format format);

/// Every format's name, in the order of the enumeration: `Format(index)` is the format of `names[index]`.
const std::vector<std::string>& format_names();

/// The same depth with a stencil beside it. D16 has no such twin and becomes D24_S8.
Format with_stencil(Format depth);

}  // namespace lightsweep::gl
