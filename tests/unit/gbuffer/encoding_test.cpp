// What must hold for encoding files: a header says what an encoding is, and a header that is wrong says why.
#include "renderer/gbuffer/encoding.h"

#include "renderer/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightsweep {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Encoding parse(const std::string& header) {
    return parse_encoding("mine", header + "vec2 encode_mine();\n", "mine.glsl");
}

std::string error_of(const std::string& header) {
    try {
        parse(header);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(EncodingHeader, SaysFieldsChannelsAndWords) {
    const Encoding e =
        parse("// fields: normal\n// channels: signed unsigned\n// summary: two: of them\n// source: nobody\n");
    EXPECT_THAT(e.fields, ElementsAre("normal"));
    EXPECT_THAT(e.channels, ElementsAre(Channel::signed_unit, Channel::unsigned_unit));
    EXPECT_EQ(e.channel_type(), "vec2");
    EXPECT_EQ(e.summary, "two: of them");
    EXPECT_EQ(e.source, "nobody");
    EXPECT_FALSE(e.needs.grid || e.needs.pixel || e.needs.neighbours || e.hemisphere);
}

TEST(EncodingHeader, SaysNeedsAndDomain) {
    const Encoding e =
        parse("// fields: normal\n// channels: bits\n// needs: grid neighbours\n// domain: hemisphere\n");
    EXPECT_TRUE(e.needs.grid);
    EXPECT_FALSE(e.needs.pixel);
    EXPECT_TRUE(e.needs.neighbours);
    EXPECT_TRUE(e.hemisphere);
    EXPECT_EQ(e.channel_type(), "uint");
}

TEST(EncodingHeader, EndsWithItsComment) {
    EXPECT_FALSE(parse("// fields: normal\n// channels: signed\n\n// needs: grid\n").needs.grid);
}

TEST(EncodingHeader, UnknownWordsAreErrors) {
    const std::string good = "// fields: normal\n// channels: signed\n";
    EXPECT_THAT(error_of("// fields: normla\n// channels: signed\n"),
                AllOf(HasSubstr("mine.glsl"), HasSubstr("'normal'")));
    EXPECT_THAT(error_of("// fields: normal\n// channels: signde\n"),
                AllOf(HasSubstr("'signde'"), HasSubstr("'signed'")));
    EXPECT_THAT(error_of(good + "// needs: gird\n"), AllOf(HasSubstr("'gird'"), HasSubstr("did you mean 'grid'")));
    EXPECT_THAT(error_of(good + "// domain: hemispere\n"), HasSubstr("did you mean 'hemisphere'"));
    EXPECT_THAT(error_of("// channels: signed\n"), HasSubstr("// fields: ..."));
    EXPECT_THAT(error_of("// fields: normal\n// channels: bits signed\n"), HasSubstr("bits alone"));
}

TEST(Encodings, EveryShippedOneNamesItsSource) {
    ASSERT_FALSE(encoding_keys().empty());
    for (const auto& key : encoding_keys()) {
        const Encoding e = load_encoding(key);
        EXPECT_NE(e.summary, "") << key;
        EXPECT_NE(e.source, "") << key;
        EXPECT_THAT(e.glsl, AllOf(HasSubstr(" encode_" + key + "("), HasSubstr(" decode_" + key + "(")));
    }
}

}  // namespace
}  // namespace lightsweep
