// For each field: which values are sent through its encodings, and how the error of what comes back is told. No GL.
#pragma once

#include "bench/encodings/variant.h"
#include "renderer/base/random.h"
#include "renderer/scene/scene.h"
#include "shaders/shared/types.h"

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

using FieldErrors = std::array<double, 3>;

struct FieldKind {
    std::string_view field;
    std::string_view unit;    ///< of the error: "deg" (angle), "rel" (of the value), "abs" (as the value)
    std::string_view domain;  ///< of the values, in words
    int errors;               ///< how many errors one value has: each channel of a colour is one
    glm::vec4 (*sample)(Random&);
    FieldErrors (*error)(const glm::dvec4& sent, const glm::dvec4& back);
};

/// The field of a variant. Throws InputError for one that nobody sends.
const FieldKind& field_kind(const std::string& field);

/// Encodings that look at their neighbours get patches, each a bilinear blend of four random colours: independent
/// pixels are no picture. Every pixel has a colour of its own, smooth within a patch and with a hard edge between two.
inline constexpr int kPatch = 64;

/// What the encodings in view space see: an oblique camera at the origin. Depth is probed by one that looks along -z,
/// so that w is the distance, without rounding.
Camera probe_camera(const Variant& variant);
/// Its frame of width x height pixels.
shared::FrameData probe_constants(const Variant& variant, int width, int height);

/// In words: "sphere", "hemisphere", ...
std::string sample_domain(const Variant& variant);
/// One for each pixel, row by row from the bottom. Always the same ones. `width` and `height` are multiples of kPatch.
std::vector<glm::vec4> make_samples(const Variant& variant, int width, int height);

struct ErrorSummary {
    size_t compared = 0;                      ///< values whose errors are finite
    double mean = 0.0, p99 = 0.0, max = 0.0;  ///< not finite when any value came back so
};
/// On all cores.
ErrorSummary summarize_errors(const FieldKind& kind, std::span<const glm::vec4> sent, std::span<const glm::vec4> back);

}  // namespace lightsweep
