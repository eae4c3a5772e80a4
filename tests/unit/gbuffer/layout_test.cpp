// What must hold for layouts as data: the values a channel can have, what is refused, and what the shipped ones
// promise.
#include "renderer/gbuffer/layout.h"

#include "renderer/base/error.h"
#include "renderer/gbuffer/layout_glsl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace lightsweep {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

StoredField stored(gl::Format format, const std::string& field, const std::string& encoding, const std::string& in) {
    const std::string text =
        R"({"field": ")" + field + R"(", "encoding": ")" + encoding + R"(", "in": ")" + in + R"("})";
    return read_stored_field(JsonReader::from_text(text, "field.json"), format);
}

std::string error_of(gl::Format format, const std::string& field, const std::string& encoding, const std::string& in) {
    try {
        stored(format, field, encoding, in);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ChannelGrid, IsWhatTheFormatCanHold) {
    const auto expect_grid = [](gl::Format format, const char* field, const char* encoding, const char* in, double step,
                                double offset) {
        const auto grid = channel_grid(format, stored(format, field, encoding, in), 0);
        ASSERT_TRUE(grid) << in;
        EXPECT_DOUBLE_EQ(grid->step, step);
        EXPECT_DOUBLE_EQ(grid->offset, offset);
    };
    expect_grid(gl::Format::RG8_SNORM, "normal", "oct", "rg", 1.0 / 127, 0.0);
    expect_grid(gl::Format::RG8, "normal", "oct", "rg", 2.0 / 255, 1.0 / 255);  // -1, -253/255, ..., 1: no zero
    expect_grid(gl::Format::RGB10A2, "normal", "xyz", "rgb", 2.0 / 1023, 1.0 / 1023);
    expect_grid(gl::Format::R32UI, "normal", "oct", "r[0-11] r[12-23]", 1.0 / 2047, 0.0);
    expect_grid(gl::Format::R8, "roughness", "linear", "r", 1.0 / 255, 0.0);
    expect_grid(gl::Format::R8_SNORM, "roughness", "linear", "r", 1.0 / 127, 0.0);
    expect_grid(gl::Format::R32UI, "roughness", "linear", "r[3-8]", 1.0 / 63, 0.0);
    // The ends of every grid are values, or the map of [-1, 1] would not reach them.
    for (const auto format : {gl::Format::RG8, gl::Format::RG16, gl::Format::RG8_SNORM, gl::Format::RG16_SNORM}) {
        const auto grid = channel_grid(format, stored(format, "normal", "oct", "rg"), 0);
        const double steps_to_one = (1.0 - grid->offset) / grid->step;
        EXPECT_NEAR(steps_to_one, std::round(steps_to_one), 1e-9);
    }
}

TEST(ChannelGrid, IsNoneWhereStepsDiffer) {
    EXPECT_FALSE(channel_grid(gl::Format::RG16F, stored(gl::Format::RG16F, "normal", "oct", "rg"), 0));
    EXPECT_FALSE(channel_grid(gl::Format::SRGB8_A8, stored(gl::Format::SRGB8_A8, "base_color", "rgb", "rgb"), 0));
    EXPECT_FALSE(channel_grid(gl::Format::R32UI, stored(gl::Format::R32UI, "emissive", "rgb9e5", "r[0-31]"), 0));
}

TEST(StoredField, TakesTheBitsOfItsPlaces) {
    const auto bits = [](gl::Format format, const StoredField& s) {
        int sum = 0;
        for (size_t i = 0; i < s.slots.size(); ++i) sum += channel_bits(format, s, i);
        return sum;
    };
    EXPECT_EQ(bits(gl::Format::RGB10A2, stored(gl::Format::RGB10A2, "model", "id", "a")), 2);
    EXPECT_EQ(bits(gl::Format::R11G11B10F, stored(gl::Format::R11G11B10F, "emissive", "hdr", "rgb")), 32);
    EXPECT_EQ(bits(gl::Format::RG32UI, stored(gl::Format::RG32UI, "normal", "oct", "r[0-9] g[20-31]")), 22);
}

TEST(StoredField, ASearchWantsEvenSteps) {
    EXPECT_THAT(error_of(gl::Format::RG16F, "normal", "oct_precise", "rg"),
                AllOf(HasSubstr("'oct_precise'"), HasSubstr("RG16F")));
    EXPECT_THAT(error_of(gl::Format::SRGB8_A8, "normal", "best_fit", "rgb"), HasSubstr("SRGB8_A8"));
    EXPECT_EQ(error_of(gl::Format::RG16_SNORM, "normal", "oct_precise", "rg"), "no error");
    EXPECT_THAT(error_of(gl::Format::RGBA8, "roughness", "oct", "rg"), HasSubstr("cannot carry the field 'roughness'"));
}

// --- The shipped ones

TEST(ShippedLayouts, StoreWhatAnySceneNeeds) {
    for (const auto& key : layout_keys()) {
        const Layout layout = load_layout(key);
        for (size_t i = 0; i < field_names().size(); ++i) {
            const auto field = static_cast<Field>(i);
            EXPECT_TRUE(field == Field::position || layout.stores(field)) << key << " " << field_names()[i];
        }
    }
}

TEST(ShippedLayouts, ThinOnesAreAsThinAsTheySay) {
    for (const auto& [key, bits] : {std::pair{"thin", 64}, {"thin96", 96}, {"thin128", 128}, {"packed", 128}}) {
        const Layout layout = load_layout(key);
        EXPECT_EQ((layout.bytes_per_pixel() - gl::info(layout.depth).bytes) * 8, bits) << key;
        int used = 0;
        for (const auto& target : layout.targets) {
            for (const auto& s : target.fields) {
                for (size_t i = 0; i < s.slots.size(); ++i) used += channel_bits(target.format, s, i);
            }
        }
        EXPECT_LE(used, bits) << key;
        EXPECT_GE(used, bits - 8) << key << " wastes bits";
    }
}

// What a layout says of each field but those named: encoding, format and bits.
std::map<std::string, std::string> described(const Layout& layout, Field but) {
    std::map<std::string, std::string> result;
    for (const auto& target : layout.targets) {
        for (const auto& s : target.fields) {
            if (s.field == but) continue;
            std::string& text = result[std::string(info(s.field).name)] = s.encoding.key;
            for (size_t i = 0; i < s.slots.size(); ++i) text += " " + std::to_string(channel_bits(target.format, s, i));
        }
    }
    return result;
}

TEST(ShippedLayouts, OnesThatCompareAFieldDifferInThatFieldAlone) {
    const Layout base = load_layout("oct32");
    for (const auto& key : layout_keys()) {
        const bool normal = key.starts_with("normal_"), position = key.starts_with("position_");
        if (!normal && !position && key != "ycocg" && key != "srgb8") continue;
        const Field field = normal ? Field::normal : position ? Field::position : Field::base_color;
        const Layout layout = load_layout(key);
        EXPECT_EQ(described(layout, field), described(base, field)) << key;
        EXPECT_EQ(layout.depth, base.depth) << key;
        EXPECT_EQ(layout.convention, base.convention) << key;
    }
}

TEST(LayoutGlsl, HandsOverWhatAnEncodingNeeds) {
    const std::string thin = layout_glsl(load_layout("thin"));
    // 10 bits signed: steps of 1 / 511.
    EXPECT_THAT(thin,
                HasSubstr("encode_oct_precise(s.normal, vec2(1.956947162e-03, 1.956947162e-03), vec2(0.000000000e+00, "
                          "0.000000000e+00))"));
    EXPECT_THAT(thin, HasSubstr("encode_ycocg(s.base_color, ivec2(gl_FragCoord.xy))"));
    EXPECT_THAT(thin, HasSubstr("pixel, base_color_near, base_color_present)"));
    EXPECT_THAT(thin, HasSubstr("has_surface(at)"));
    EXPECT_THAT(layout_glsl(load_layout("oct32")),
                AllOf(Not(HasSubstr("has_surface")), HasSubstr("encode_oct(s.normal);")));
}

}  // namespace
}  // namespace lightsweep
