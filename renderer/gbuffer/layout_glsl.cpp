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

// One number for each channel as a GLSL constant of the channels' type.
std::string per_channel(const StoredField& stored, const std::vector<double>& values) {
    std::string list;
    for (const double value : values) list += fmt::format("{}{:.9e}", list.empty() ? "" : ", ", value);
    return fmt::format("{}({})", stored.encoding.channel_type(), list);
}

// `encode_oct(s.normal)`, with what else the encoding needs.
std::string encode_call(const LayoutTarget& target, const StoredField& stored) {
    std::string arguments = fmt::format("s.{}", info(stored.field).name);
    if (stored.encoding.needs.grid) {
        std::vector<double> steps, offsets;
        for (size_t i = 0; i < stored.slots.size(); ++i) {
            const auto grid = channel_grid(target.format, stored, i);
            CHECK(grid);  // load_layout refuses others
            steps.push_back(grid->step);
            offsets.push_back(grid->offset);
        }
        arguments += ", " + per_channel(stored, steps) + ", " + per_channel(stored, offsets);
    }
    if (stored.encoding.needs.pixel) arguments += ", ivec2(gl_FragCoord.xy)";
    return fmt::format("encode_{}({})", stored.encoding.key, arguments);
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
            body += fmt::format("    {} {}_channels = {};\n", stored.encoding.channel_type(), field,
                                encode_call(target, stored));
            for (size_t i = 0; i < stored.slots.size(); ++i) {
                body += fmt::format("    texel_{}.{} {} {};\n", t, kComponents[stored.slots[i].component],
                                    is_integer(target) ? "|=" : "=", write_channel(target, stored, i));
            }
        }
        body += fmt::format("    gbuffer_{} = texel_{};\n", t, t);
    }
    return out + "\nvoid write_surface(Surface s) {\n" + body + "}\n";
}

std::string fetch_texel(const LayoutTarget& target, size_t t, const char* pixel) {
    return fmt::format("    {} texel_{} = texelFetch(gbuffer_{}, {}, 0);\n", is_integer(target) ? "uvec4" : "vec4", t,
                       t, pixel);
}

// The channels of a field as one value of their type, from texel_<t>.
std::string read_channels(const LayoutTarget& target, size_t t, const StoredField& stored) {
    std::string channels;
    for (size_t i = 0; i < stored.slots.size(); ++i) {
        channels += (i == 0 ? "" : ", ") + read_channel(target, t, stored, i);
    }
    return fmt::format("{}({})", stored.encoding.channel_type(), channels);
}

// A function that reads the field's channels of any pixel, for encodings that look at their neighbours.
std::string channels_function(const LayoutTarget& target, size_t t, const StoredField& stored) {
    return fmt::format("\n{} {}_channels(ivec2 pixel) {{\n{}    return {};\n}}\n", stored.encoding.channel_type(),
                       info(stored.field).name, fetch_texel(target, t, "pixel"), read_channels(target, t, stored));
}

// The statements that read one field back.
std::string read_field(const LayoutTarget& target, size_t t, const StoredField& stored) {
    const std::string_view field = info(stored.field).name;
    std::string before, arguments = read_channels(target, t, stored);
    if (stored.encoding.needs.pixel) arguments += ", pixel";
    if (stored.encoding.needs.neighbours) {
        before +=
            fmt::format("    {} {}_near[4];\n    vec4 {}_present;\n", stored.encoding.channel_type(), field, field);
        before += "    for (int i = 0; i < 4; ++i) {\n";
        before += "        ivec2 at = clamp(pixel + kNeighbours[i], ivec2(0), textureSize(gbuffer_" +
                  std::to_string(t) + ", 0) - 1);\n";
        before += fmt::format("        {}_near[i] = {}_channels(at);\n", field, field);
        before += fmt::format("        {}_present[i] = at != pixel && has_surface(at) ? 1.0 : 0.0;\n    }}\n", field);
        arguments += fmt::format(", {}_near, {}_present", field, field);
    }
    return before + fmt::format("    s.{} = decode_{}({});\n", field, stored.encoding.key, arguments);
}

std::string read_function(const Layout& layout) {
    std::string in, functions, body;
    std::set<Field> stored_fields;
    for (size_t t = 0; t < layout.targets.size(); ++t) {
        const LayoutTarget& target = layout.targets[t];
        in += fmt::format("layout(binding = {}) uniform {} gbuffer_{};  // {}\n",
                          shared::kTargetUnit + static_cast<int>(t), is_integer(target) ? "usampler2D" : "sampler2D", t,
                          target.name);
        body += fetch_texel(target, t, "pixel");
        for (const auto& stored : target.fields) {
            stored_fields.insert(stored.field);
            if (stored.encoding.needs.neighbours) functions += channels_function(target, t, stored);
            body += read_field(target, t, stored);
        }
    }
    for (size_t i = 0; i < field_names().size(); ++i) {
        const auto field = static_cast<Field>(i);
        if (stored_fields.contains(field)) continue;
        body += field == Field::position ? std::string("    s.position = position_from_depth(frag_coord, depth);\n")
                                         : fmt::format("    s.{} = {};\n", info(field).name, info(field).otherwise);
    }
    if (!functions.empty()) {
        in += "\nconst ivec2 kNeighbours[4] = ivec2[](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));\n";
    }
    return in + functions +
           "\nSurface read_surface(vec2 frag_coord, float depth) {\n    Surface s;\n"
           "    ivec2 pixel = ivec2(frag_coord);\n" +
           body + "    return s;\n}\n";
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
