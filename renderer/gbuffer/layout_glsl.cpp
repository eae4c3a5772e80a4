#include "renderer/gbuffer/layout_glsl.h"

#include "renderer/base/check.h"
#include "shaders/shared/slots.h"

#include <fmt/format.h>

#include <set>

namespace lightsweep {
namespace {

constexpr char kComponents[] = "rgba";

bool is_integer(const LayoutTarget& target) { return gl::info(target.format).kind == gl::FormatKind::uint; }

uint32_t highest(int bits) { return bits == 32 ? ~0U : (1U << bits) - 1U; }

// Channel `i` of the encoded value, a float in its own range, as GLSL.
std::string channel(const StoredField& stored, size_t i) {
    const std::string value = fmt::format("{}_channels", info(stored.field).name);
    return stored.encoding.channels.size() == 1 ? value : fmt::format("{}.{}", value, "xyzw"[i]);
}

std::string write_channel(const LayoutTarget& target, const StoredField& stored, size_t i) {
    const Slot& slot = stored.slots[i];
    const Channel kind = stored.encoding.channels[i];
    const std::string value = channel(stored, i);
    if (!is_integer(target)) {
        const bool shifted = kind == Channel::signed_unit && gl::info(target.format).kind == gl::FormatKind::unorm;
        return shifted ? fmt::format("{} * 0.5 + 0.5", value) : value;
    }
    switch (kind) {
        case Channel::bits:
            return fmt::format("({} & {}u) << {}", value, highest(slot.bit_count), slot.low_bit);
        case Channel::unsigned_unit:
            return fmt::format("uint(round(clamp({}, 0.0, 1.0) * {}.0)) << {}", value, highest(slot.bit_count),
                               slot.low_bit);
        case Channel::signed_unit: {
            const uint32_t half = highest(slot.bit_count - 1);
            return fmt::format("uint(int(round(clamp({}, -1.0, 1.0) * {}.0)) + {}) << {}", value, half, half,
                               slot.low_bit);
        }
        case Channel::real:
            break;
    }
    CHECK_THAT(false, "a float channel in an integer target: load_layout refuses it");
    return {};
}

std::string read_channel(const LayoutTarget& target, size_t target_index, const StoredField& stored, size_t i) {
    const Slot& slot = stored.slots[i];
    const Channel kind = stored.encoding.channels[i];
    const std::string texel = fmt::format("texel_{}.{}", target_index, kComponents[slot.component]);
    if (!is_integer(target)) {
        const bool shifted = kind == Channel::signed_unit && gl::info(target.format).kind == gl::FormatKind::unorm;
        return shifted ? fmt::format("({} * 2.0 - 1.0)", texel) : texel;
    }
    const std::string bits = fmt::format("(({} >> {}) & {}u)", texel, slot.low_bit, highest(slot.bit_count));
    switch (kind) {
        case Channel::bits:
            return bits;
        case Channel::unsigned_unit:
            return fmt::format("(float({}) / {}.0)", bits, highest(slot.bit_count));
        case Channel::signed_unit: {
            const uint32_t half = highest(slot.bit_count - 1);
            return fmt::format("(float(int({}) - {}) / {}.0)", bits, half, half);
        }
        case Channel::real:
            break;
    }
    CHECK_THAT(false, "a float channel in an integer target: load_layout refuses it");
    return {};
}

std::string write_function(const Layout& layout) {
    std::string out, body;
    for (size_t t = 0; t < layout.targets.size(); ++t) {
        const LayoutTarget& target = layout.targets[t];
        const char* type = is_integer(target) ? "uvec4" : "vec4";
        out += fmt::format("layout(location = {}) out {} gbuffer_{};  // {}\n", t, type, t, target.name);
        body += fmt::format("    {} texel_{} = {}(0);\n", type, t, type);
        for (const auto& stored : target.fields) {
            const std::string_view field = info(stored.field).name;
            body += fmt::format("    {} {}_channels = encode_{}(s.{});\n", stored.encoding.channel_type(), field,
                                stored.encoding.key, field);
            for (size_t i = 0; i < stored.slots.size(); ++i) {
                body += fmt::format("    texel_{}.{} {} {};\n", t, kComponents[stored.slots[i].component],
                                    is_integer(target) ? "|=" : "=", write_channel(target, stored, i));
            }
        }
        body += fmt::format("    gbuffer_{} = texel_{};\n", t, t);
    }
    return out + "\nvoid write_surface(Surface s) {\n" + body + "}\n";
}

std::string read_function(const Layout& layout) {
    std::string in, body;
    std::set<Field> stored_fields;
    for (size_t t = 0; t < layout.targets.size(); ++t) {
        const LayoutTarget& target = layout.targets[t];
        const bool integer = is_integer(target);
        in += fmt::format("layout(binding = {}) uniform {} gbuffer_{};  // {}\n",
                          shared::kTargetUnit + static_cast<int>(t), integer ? "usampler2D" : "sampler2D", t,
                          target.name);
        body += fmt::format("    {} texel_{} = texelFetch(gbuffer_{}, ivec2(frag_coord), 0);\n",
                            integer ? "uvec4" : "vec4", t, t);
        for (const auto& stored : target.fields) {
            stored_fields.insert(stored.field);
            std::string channels;
            for (size_t i = 0; i < stored.slots.size(); ++i) {
                channels += (i == 0 ? "" : ", ") + read_channel(target, t, stored, i);
            }
            body += fmt::format("    s.{} = decode_{}({}({}));\n", info(stored.field).name, stored.encoding.key,
                                stored.encoding.channel_type(), channels);
        }
    }
    for (size_t i = 0; i < field_names().size(); ++i) {
        const auto field = static_cast<Field>(i);
        if (stored_fields.contains(field)) continue;
        body += field == Field::position ? std::string("    s.position = position_from_depth(frag_coord, depth);\n")
                                         : fmt::format("    s.{} = {};\n", info(field).name, info(field).otherwise);
    }
    return in + "\nSurface read_surface(vec2 frag_coord, float depth) {\n    Surface s;\n" + body +
           "    return s;\n}\n";
}

}  // namespace

std::string layout_glsl(const Layout& layout) {
    std::string text =
        "// Made from the layout '" + layout.key + "'.\n#include \"lib/frame.glsl\"\n#include \"lib/surface.glsl\"\n";
    std::set<std::string> included;
    for (const auto& target : layout.targets) {
        for (const auto& stored : target.fields) {
            if (included.insert(stored.encoding.key).second) {
                text += fmt::format("#include \"gbuffer/encodings/{}.glsl\"\n", stored.encoding.key);
            }
        }
    }
    return text + "\n#ifdef GBUFFER_WRITE\n" + write_function(layout) + "#else\n" + read_function(layout) + "#endif\n";
}

}  // namespace lightsweep
