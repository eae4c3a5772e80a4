// Buffers that grow, and what the device refuses.
#include "renderer/base/error.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texel_buffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace lightsweep {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<uint32_t> words_of(const gl::Buffer& buffer) {
    std::vector<uint32_t> words(buffer.size_bytes() / sizeof(uint32_t));
    buffer.read(std::as_writable_bytes(std::span(words)));
    return words;
}

TEST(Buffers, BeginAsZerosAndGrowWhenWrittenOrReserved) {
    gl::Buffer buffer(16, "test");
    EXPECT_THAT(words_of(buffer), ElementsAre(0U, 0U, 0U, 0U));
    const std::vector<uint32_t> content = {1, 2, 3, 4, 5};
    buffer.write_items<uint32_t>(content);
    EXPECT_GE(buffer.size_bytes(), 20U);
    buffer.reserve(20);  // has it
    EXPECT_EQ(words_of(buffer)[4], 5U);
    buffer.reserve(4096);
    EXPECT_EQ(buffer.size_bytes(), 4096U);
    EXPECT_THAT(words_of(buffer), Each(0U));
}

TEST(Buffers, ClearZerosTheFirstBytesAlone) {
    gl::Buffer buffer(16, "test");
    const std::vector<uint32_t> content = {1, 2, 3, 4};
    buffer.write_items<uint32_t>(content);
    buffer.clear(8);
    EXPECT_THAT(words_of(buffer), ElementsAre(0U, 0U, 3U, 4U));
}

TEST(Buffers, TexelsBeyondTheLimitAreRefusedByName) {
    gl::TexelBuffer buffer(gl::Buffer(size_t{16}, "too many"), gl::Format::RGBA32F);
    try {
        buffer.reserve(static_cast<size_t>(gl::Context::current()->limits().max_texel_buffer_texels) + 1);
        FAIL() << "not refused";
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("'too many'"));
        EXPECT_THAT(error.what(), HasSubstr("max_texel_buffer_texels"));
    }
    EXPECT_EQ(buffer.size_bytes(), 16U);
}

}  // namespace
}  // namespace lightsweep
