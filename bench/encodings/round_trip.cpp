#include "bench/encodings/round_trip.h"

#include "bench/encodings/field_kind.h"
#include "renderer/base/check.h"
#include "renderer/gbuffer/layout_glsl.h"
#include "shaders/shared/slots.h"
#include "shaders/shared/types.h"

#include <glm/gtc/type_ptr.hpp>

namespace lightsweep {
namespace {

constexpr unsigned kSamplesUnit = 0;  // shaders/encodings/samples.glsl

shared::FrameData frame_constants(const Variant& variant, int width, int height) {
    shared::FrameData data = probe_constants(variant, width, height);
    if (variant.clip == gl::ClipDepth::minus_one_to_one) {
        // z / w in [-1, 1] that the viewport makes the same depth: 2 z - w for z.
        glm::dmat4 projection = camera_projection(probe_camera(variant), width, height, variant.layout.convention);
        for (int column = 0; column < 4; ++column) {
            projection[column][2] = 2.0 * projection[column][2] - projection[column][3];
        }
        data.clip_from_world = glm::mat4(projection);
    }
    return data;
}

gl::Format target_format(const Variant& variant) {
    return variant.is_depth() ? variant.layout.depth : variant.layout.targets.front().format;
}

gl::Framebuffer make_framebuffer(const gl::Texture& target, const std::string& label) {
    const gl::Texture* const color = &target;
    if (gl::info(target.format()).kind == gl::FormatKind::depth) return gl::Framebuffer({}, color, label);
    return gl::Framebuffer(std::span(&color, 1), nullptr, label);
}

gl::Program make_program(const Variant& variant, const char* fragment) {
    return gl::Program({.vertex = "paths/fullscreen.vert.glsl",
                        .fragment = fragment,
                        .defines = {"FIELD " + variant.field, "ONLY_MODEL 0u"},
                        .generated = {{"generated/gbuffer.glsl", layout_glsl(variant.layout)}}});
}

gl::Program make_encoder(const Variant& variant) {
    if (!variant.is_depth()) return make_program(variant, "encodings/encode.frag.glsl");
    return gl::Program({.vertex = "encodings/depth_points.vert.glsl", .fragment = "paths/light_volume_mark.frag.glsl"});
}

gl::Program make_decoder(const Variant& variant) {
    if (!variant.is_depth()) return make_program(variant, "encodings/decode.frag.glsl");
    return gl::Program({.vertex = "paths/fullscreen.vert.glsl", .fragment = "encodings/depth_decode.frag.glsl"});
}

}  // namespace

gl::Texture make_float_texture(int width, int height, const std::string& label) {
    return gl::Texture({.width = width, .height = height, .format = gl::Format::RGBA32F, .label = label});
}

std::vector<glm::vec4> read_pixels(const gl::Texture& float_texture) {
    const auto floats = float_texture.read_floats(4);
    std::vector<glm::vec4> pixels(floats.size() / 4);
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = glm::make_vec4(&floats[4 * i]);
    return pixels;
}

RoundTrip::RoundTrip(const Variant& variant, int width, int height)
    : is_depth_(variant.is_depth()),
      clip_(variant.clip),
      pixels_(static_cast<uint32_t>(width) * static_cast<uint32_t>(height)),
      depth_clear_(variant.layout.convention == DepthConvention::reversed ? 0.0F : 1.0F),
      target_({.width = width, .height = height, .format = target_format(variant), .label = variant.name}),
      framebuffer_(make_framebuffer(target_, variant.name)),
      encode_(make_encoder(variant)),
      decode_(make_decoder(variant)),
      no_attributes_({}, {}, "no attributes") {
    const shared::FrameData constants = frame_constants(variant, width, height);
    constants_ = gl::Buffer(std::as_bytes(std::span(&constants, 1)), "frame constants");
}

void RoundTrip::draw_full_screen() const {
    gl::apply({});
    no_attributes_.bind();
    gl::draw_triangles(3);
}

void RoundTrip::encode(const gl::Texture& samples) const {
    constants_.bind_uniform(shared::kFrameBlock);
    samples.bind(kSamplesUnit);
    framebuffer_.bind();
    encode_.use();
    if (!is_depth_) return draw_full_screen();
    // Clamped: at the very planes, rounding may put a point outside.
    gl::apply({.depth_test = true, .depth_write = true, .depth_compare = gl::Compare::always, .depth_clamp = true});
    framebuffer_.clear_depth(depth_clear_);
    gl::set_clip_depth(clip_);
    no_attributes_.bind();
    gl::draw_points(pixels_);
    gl::set_clip_depth(gl::ClipDepth::zero_to_one);
}

void RoundTrip::decode(const gl::Framebuffer& output) const {
    constants_.bind_uniform(shared::kFrameBlock);
    target_.bind(static_cast<unsigned>(shared::kTargetUnit));
    output.bind();
    decode_.use();
    draw_full_screen();
}

std::vector<glm::vec4> round_trip(const Variant& variant, std::span<const glm::vec4> samples, int width, int height) {
    CHECK_THAT(samples.size() == static_cast<size_t>(width) * static_cast<size_t>(height), "{}", samples.size());
    gl::Texture input = make_float_texture(width, height, "samples");
    const gl::Texture output = make_float_texture(width, height, "decoded");
    input.upload_floats({&samples.front().x, samples.size() * 4});
    const RoundTrip trip(variant, width, height);
    trip.encode(input);
    trip.decode(make_framebuffer(output, "decoded"));
    return read_pixels(output);
}

}  // namespace lightsweep
