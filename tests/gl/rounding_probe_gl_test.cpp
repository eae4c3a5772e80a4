// What the rounding probe says of a format must be what long sums in it show.
#include "bench/measure/rounding_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace lightsweep {
namespace {

TEST(RoundingProbe, TellsOfEveryFormatThatHoldsNumbersToBlend) {
    std::set<std::string> names;
    for (const RoundingProbe& probe : probe_rounding()) {
        names.insert(probe.format);
        EXPECT_TRUE(!probe.ties || probe.write == Rounding::nearest) << probe.format;
        if (!probe.write) continue;
        EXPECT_NE(*probe.write, Rounding::other) << probe.format << ": neither of what the specification allows";
    }
    EXPECT_EQ(names.size(), 21U) << "7 of 8 bits, 6 of 16, 6 floats, RGB10A2 and R11G11B10F";
    EXPECT_TRUE(names.contains("srgb8_a8") && names.contains("r11g11b10f") && !names.contains("r32ui"));
}

// Adding 0.1 goes on until a step (truncated) or half a step (nearest) is more than that: with b bits steps are 2^-b of
// the power of two below, and 1/8 is the first that is.
TEST(RoundingProbe, SumsStopWhereTheModeSays) {
    const std::pair<const char*, int> formats[] = {{"rgba16f", 10}, {"r11g11b10f", 6}};
    int seen = 0;
    for (const RoundingProbe& probe : probe_rounding()) {
        if (probe.format == "rgba32f") {
            EXPECT_NEAR(probe.sum_of_tenths.value(), 400.0, 0.1);
        }
        for (const auto& [format, bits] : formats) {
            if (probe.format != format) continue;
            ++seen;
            const double truncated = std::ldexp(0.125, bits);
            EXPECT_EQ(probe.sum_of_tenths, probe.blend == Rounding::truncate ? truncated : 2.0 * truncated) << format;
        }
    }
    EXPECT_EQ(seen, 2);
}

}  // namespace
}  // namespace lightsweep
