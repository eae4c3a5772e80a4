// Shader functions against double precision on this device, and that a wrong one shows.
#include "bench/stress/ulp.h"

#include "bench/stress/shader_call.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace lightsweep {
namespace {

const std::vector<UlpRow>& rows() {
    static const auto all = measure_ulp(true);
    return all;
}

const UlpRow& row(const std::string& function) {
    const auto found = std::ranges::find(rows(), function, &UlpRow::function);
    if (found == rows().end()) throw std::runtime_error("no row " + function);
    return *found;
}

TEST(UlpTable, NothingIsNaNOrInfinite) {
    for (const UlpRow& r : rows()) EXPECT_EQ(r.non_finite, 0U) << r.function << " at " << r.non_finite_input;
}

TEST(UlpTable, IsTheSameTwice) {
    const auto again = measure_ulp(true);
    ASSERT_EQ(again.size(), rows().size());
    for (size_t i = 0; i < again.size(); ++i) {
        EXPECT_EQ(again[i].max_ulp, rows()[i].max_ulp) << again[i].function;
        EXPECT_EQ(again[i].mean_ulp, rows()[i].mean_ulp) << again[i].function;
        EXPECT_EQ(again[i].worst_input, rows()[i].worst_input) << again[i].function;
    }
}

TEST(UlpTable, EveryCodeComesBack) {
    size_t tables = 0;
    for (const UlpRow& r : rows()) {
        if (r.function.find(": codes") == std::string::npos) continue;
        ++tables;
        EXPECT_EQ(r.max_ulp, 0.0) << r.function << " at " << r.worst_input;
    }
    EXPECT_GT(tables, 10U);
}

TEST(UlpTable, FunctionsAreAsGoodAsTheirRoundings) {
    // The sum of squares rounds by 3/2 ulp, halved by the root; the root by 2, the product by 1/2.
    EXPECT_LE(row("safe_normalize").max_ulp, 4.0);
    EXPECT_LE(row("local_light: direction").max_ulp, 4.0);
    EXPECT_LE(row("luminance").max_ulp, 3.0);
    EXPECT_EQ(row("slice_of").max_ulp, 0.0);
    // A product of three terms that cancel down to 1/20: their roundings, twenty times.
    EXPECT_LE(row("lambert: diffuse").max_ulp, 3.0 * 20.0);
}

TEST(ShaderCalls, SeeTheBitsTheyAreGiven) {
    const std::vector<ShaderInput> inputs{{.a = {0.1F, -0.0F, 1e30F, 3.0F}}, {.a = {1.0F, 2.0F, 3.0F, 4.0F}}};
    const auto back =
        ShaderCall({}, "result = vec4(a.x, intBitsToFloat(floatBitsToInt(a.y)), a.z, b.x + d.w + a.w);")(inputs);
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[0].x, 0.1F);
    EXPECT_TRUE(std::signbit(back[0].y));
    EXPECT_EQ(back[0].z, 1e30F);
    EXPECT_EQ(back[1], glm::vec4(1.0F, 2.0F, 3.0F, 4.0F));
}

}  // namespace
}  // namespace lightsweep
