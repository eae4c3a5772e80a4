// Pictures in files: what is written is read back, foreign files are understood, damaged ones are refused in one line.
#include "renderer/image/image.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/random.h"
#include "tests/unit/image/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class ImageFile : public ::testing::Test {
  protected:
    ImageFile() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  (std::string("lightsweep_image_") + test->name() + "_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    ~ImageFile() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    std::filesystem::path file_of(const std::string& name, std::string_view bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
        return path(name);
    }

    std::filesystem::path folder_;
};

Image noise(int width, int height, ColorSpace space) {
    Random random(7);
    Image image(width, height, space);
    for (float& v : image.rgb) v = static_cast<float>(random.uniform());
    return image;
}

std::string from_hex(std::string_view hex) {
    std::string bytes;
    for (size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
    return bytes;
}

TEST(Srgb, FollowsTheStandard) {
    // IEC 61966-2-1: 0.5 encoded is 0.214041 linear; the linear piece ends at 0.04045.
    EXPECT_NEAR(srgb_to_linear(0.5F), 0.214041F, 1e-6);
    EXPECT_NEAR(linear_to_srgb(0.214041F), 0.5F, 1e-6);
    EXPECT_NEAR(srgb_to_linear(0.04045F), 0.0031308F, 1e-7);
    EXPECT_FLOAT_EQ(srgb_to_linear(1.0F), 1.0F);
    EXPECT_EQ(srgb_to_linear(0.0F), 0.0F);
    EXPECT_NEAR(srgb_to_linear(-0.5F), -0.214041F, 1e-6);
}

TEST(Srgb, IsItsOwnInverseAndMonotone) {
    float previous = -2;
    for (int i = -100; i <= 400; ++i) {
        const float v = static_cast<float>(i) / 100;
        EXPECT_NEAR(linear_to_srgb(srgb_to_linear(v)), v, 1e-5 * std::max(1.0F, std::abs(v)));
        EXPECT_GT(srgb_to_linear(v), srgb_to_linear(previous));
        previous = v;
    }
}

TEST(Converted, KeepsWhatIsOutsideZeroToOne) {
    Image image(1, 1, ColorSpace::linear);
    image.rgb = {4.0F, -0.5F, 0.214041F};
    const Image display = converted(image, ColorSpace::display);
    EXPECT_EQ(display.space, ColorSpace::display);
    EXPECT_GT(display.rgb[0], 1.0F);
    EXPECT_LT(display.rgb[1], 0.0F);
    EXPECT_NEAR(display.rgb[2], 0.5F, 1e-6);
    EXPECT_EQ(converted(image, ColorSpace::linear).rgb, image.rgb);
}

TEST_F(ImageFile, PngKeepsEightBits) {
    Image image(256, 1, ColorSpace::display);
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 3; ++c) image.pixel(i, 0)[c] = static_cast<float>((i + 80 * c) % 256) / 255.0F;
    write_image(image, path("a.png"));
    const Image read = read_image(path("a.png"));
    EXPECT_EQ(read.space, ColorSpace::display);
    EXPECT_EQ(read.width, 256);
    EXPECT_EQ(read.rgb, image.rgb);
}

TEST_F(ImageFile, PngRoundsToNearest) {
    const Image image = noise(61, 37, ColorSpace::display);
    write_image(image, path("a.png"));
    const Image read = read_image(path("a.png"));
    ASSERT_EQ(read.rgb.size(), image.rgb.size());
    for (size_t i = 0; i < read.rgb.size(); ++i) ASSERT_LE(std::abs(read.rgb[i] - image.rgb[i]), 0.5001F / 255);
}

TEST_F(ImageFile, PngEncodesAndClampsLinearValues) {
    Image image(2, 2, ColorSpace::linear);
    image.rgb = {0.2158605F, 1.0F, 0.0F, kNan, kInf, -kInf, 7.5F, -2.0F, 0.0031308F, 1, 1, 1};
    write_image(image, path("a.png"));
    Image expected = image;
    expected.rgb = {128, 255, 0,  0,   255, 0,
                    255, 0,   10, 255, 255, 255};  // 0.2158605 is ((128/255 + 0.055) / 1.055)^2.4; 255 * 0.04045 = 10.3
    Image read = read_image(path("a.png"));
    for (float& v : read.rgb) v = std::round(v * 255);
    EXPECT_EQ(read.rgb, expected.rgb);
}

TEST_F(ImageFile, Grey16KeepsEveryValue) {
    std::vector<uint16_t> grey(256 * 256);
    for (size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<uint16_t>(i);
    write_grey16_png(128, 512, grey, path("a.png"));
    const Image read = read_image(path("a.png"));
    ASSERT_EQ(read.width, 128);
    ASSERT_EQ(read.height, 512);
    for (size_t i = 0; i < grey.size(); ++i) ASSERT_EQ(std::lround(read.rgb[3 * i] * 65535), grey[i]);
    // PNG specification, 11.2.2: bit depth and colour type follow width and height.
    EXPECT_EQ(read_file(path("a.png")).substr(24, 2), std::string("\x10\0", 2));
    EXPECT_THAT([&] { write_grey16_png(1, 1, std::vector<uint16_t>(1), path("no/such/folder/a.png")); },
                ThrowsMessage<InputError>(HasSubstr("no/such/folder/a.png")));
}

TEST_F(ImageFile, TopRowComesFirst) {
    for (const char* name : {"a.png", "a.exr"}) {
        Image image(2, 3, ColorSpace::linear);
        image.pixel(1, 0)[0] = 1;
        image.pixel(0, 2)[2] = 1;
        write_image(image, path(name));
        EXPECT_EQ(read_image(path(name)).rgb, image.rgb) << name;
    }
}

TEST_F(ImageFile, ExrKeepsEveryBit) {
    Image image = noise(67, 35, ColorSpace::linear);
    image.rgb[0] = kInf;
    image.rgb[1] = -kInf;
    image.rgb[2] = kNan;
    image.rgb[3] = std::numeric_limits<float>::denorm_min();
    image.rgb[4] = std::numeric_limits<float>::max();
    image.rgb[5] = -0.0F;
    write_image(image, path("a.EXR"));
    const Image read = read_image(path("a.EXR"));
    EXPECT_EQ(read.space, ColorSpace::linear);
    ASSERT_EQ(read.rgb.size(), image.rgb.size());
    for (size_t i = 0; i < read.rgb.size(); ++i)
        ASSERT_EQ(std::bit_cast<uint32_t>(read.rgb[i]), std::bit_cast<uint32_t>(image.rgb[i])) << i;
}

TEST_F(ImageFile, ExrHoldsLinearValuesOfADisplayImage) {
    Image image(1, 1, ColorSpace::display);
    image.rgb = {0.5F, 1.0F, 0.0F};
    write_image(image, path("a.exr"));
    const Image read = read_image(path("a.exr"));
    EXPECT_NEAR(read.rgb[0], 0.214041F, 1e-6);
    EXPECT_FLOAT_EQ(read.rgb[1], 1.0F);
    EXPECT_EQ(read.rgb[2], 0.0F);
}

TEST_F(ImageFile, ReadsSixteenBitPngWithAllOfItsBits) {
    const Image image = read_image(file_of("a.png", from_hex(kPng16)));
    ASSERT_EQ(image.rgb.size(), 6U);
    EXPECT_THAT(image.rgb,
                ElementsAre(1 / 65535.0F, 2 / 65535.0F, 257 / 65535.0F, 65534 / 65535.0F, 32768 / 65535.0F, 0));
}

TEST_F(ImageFile, ReadsPaletteGreyAndInterlacedPng) {
    EXPECT_THAT(read_image(file_of("palette.png", from_hex(kPngPalette))).rgb,
                ElementsAre(1, 0, 0, 0, 0, FloatEq(51 / 255.0F)));
    EXPECT_THAT(read_image(file_of("grey.png", from_hex(kPngGrey1))).rgb, ElementsAre(1, 1, 1, 0, 0, 0));
    const Image interlaced = read_image(file_of("interlaced.png", from_hex(kPngInterlaced)));
    ASSERT_EQ(interlaced.rgb.size(), 3U * 5 * 5);
    for (int i = 0; i < 25; ++i)
        EXPECT_FLOAT_EQ(interlaced.rgb[3 * static_cast<size_t>(i)], static_cast<float>(10 * i) / 255) << i;
}

TEST_F(ImageFile, CompositesAlphaOverBlackInLinearLight) {
    const Image image = read_image(file_of("a.png", from_hex(kPngAlpha)));
    ASSERT_EQ(image.rgb.size(), 9U);
    // White under alpha 0.2: 0.2 of the light, which sRGB encodes as 1.055 * 0.2^(1/2.4) - 0.055 = 0.484529.
    EXPECT_NEAR(image.rgb[0], 0.484529F, 1e-5);
    EXPECT_EQ(image.rgb[3], 0.0F);
    EXPECT_EQ(image.rgb[6], 1.0F);
}

TEST_F(ImageFile, ReadsHalfAndUintAndGreyExr) {
    EXPECT_THAT(read_image(file_of("half.exr", from_hex(kExrHalf))).rgb, ElementsAre(0.5F, 2, -1, 65504, 0, 0.25F));
    EXPECT_THAT(read_image(file_of("uint.exr", from_hex(kExrUintY))).rgb, ElementsAre(3, 3, 3, 70000, 70000, 70000));
}

TEST_F(ImageFile, RefusesExrWithoutColour) {
    EXPECT_THAT(
        [&] { read_image(file_of("depth.exr", from_hex(kExrZ))); },
        ThrowsMessage<InputError>(AllOf(HasSubstr("depth.exr"), HasSubstr("channels Z"), HasSubstr("R, G and B"))));
}

TEST_F(ImageFile, NamesWhatIsWrong) {
    EXPECT_THAT([&] { read_image(path("none.png")); }, ThrowsMessage<InputError>(HasSubstr("none.png")));
    EXPECT_THAT([&] { read_image(path("a.jpg")); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("a.jpg"), HasSubstr("'.jpg'"), HasSubstr(".png, .exr"))));
    EXPECT_THAT([&] { write_image(Image(1, 1, ColorSpace::linear), path("a")); },
                ThrowsMessage<InputError>(HasSubstr(".png, .exr")));
    EXPECT_THAT([&] { write_image(Image(1, 1, ColorSpace::linear), path("no/such/folder/a.exr")); },
                ThrowsMessage<InputError>(HasSubstr("a.exr")));
    for (const char* name : {"text.png", "text.exr", "empty.png"})
        EXPECT_THAT([&] { read_image(file_of(name, name[0] == 'e' ? "" : "This is a letter, not a picture.")); },
                    ThrowsMessage<InputError>(HasSubstr("is not a")))
            << name;
}

TEST_F(ImageFile, RefusesAPngThatClaimsMoreThanItHolds) {
    EXPECT_THAT([&] { read_image(file_of("huge.png", from_hex(kPngHuge))); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("huge.png"), Not(HasSubstr("\n")))));
}

/// Cuts a good file at many lengths, and flips bytes in it: an InputError or a picture, never anything else.
class DamagedFile : public ImageFile, public ::testing::WithParamInterface<const char*> {};

TEST_P(DamagedFile, CutShortIsRefused) {
    write_image(noise(40, 30, ColorSpace::linear), path(GetParam()));
    const std::string whole = read_file(path(GetParam()));
    for (size_t size = 0; size < whole.size(); size += 1 + size / 8) {
        const auto cut = file_of(std::string("cut_") + GetParam(), std::string_view(whole).substr(0, size));
        EXPECT_THROW(read_image(cut), InputError) << size << " of " << whole.size() << " bytes";
    }
    EXPECT_THROW(read_image(file_of(std::string("cut_") + GetParam(), whole.substr(0, whole.size() - 1))), InputError);
}

TEST_P(DamagedFile, ChangedBytesNeverCrash) {
    write_image(noise(40, 30, ColorSpace::linear), path(GetParam()));
    const std::string whole = read_file(path(GetParam()));
    Random random(11);
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        std::string damaged = whole;
        // Half of the changes hit the header, where sizes and offsets stand.
        const size_t reach = i % 2 == 0 ? std::min<size_t>(400, whole.size()) : whole.size();
        for (int k = 0; k < 3; ++k) damaged[random.index(reach)] = static_cast<char>(random.bits());
        try {
            const Image image = read_image(file_of(std::string("bad_") + GetParam(), damaged));
            EXPECT_EQ(image.rgb.size(), 3 * image.pixel_count());
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFile, ::testing::Values("a.png", "a.exr"),
                         [](const auto& format) { return std::string(format.param).substr(2); });

}  // namespace
}  // namespace lightsweep
