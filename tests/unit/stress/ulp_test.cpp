// Units in the last place, and what `stress ulp` calls functions with: no GL.
#include "bench/stress/ulp.h"

#include "bench/stress/shader_functions.h"
#include "renderer/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace lightsweep {
namespace {

TEST(Ulp, IsTheDistanceToTheNextFloat) {
    EXPECT_EQ(ulp_of(1.0), 0x1p-23);
    EXPECT_EQ(ulp_of(0x1.fffffep-1), 0x1p-24);
    EXPECT_EQ(ulp_of(0.0), 0x1p-149);
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto value = static_cast<float>(std::exp2(random.uniform(-148.0, 127.0)));
        const double next = double{std::nextafter(value, INFINITY)};
        EXPECT_EQ(ulp_of(double{value}), next - double{value}) << value;
    }
}

TEST(Ulp, CountsFloatsBetween) {
    float value = 0.3F;
    for (int steps = 0; steps < 5; ++steps) {
        const double exact = double{0.3F};
        EXPECT_EQ(ulps_off(&value, &exact, 1), steps);
        value = std::nextafter(value, 1.0F);
    }
}

TEST(Ulp, OfAVectorIsThatOfItsLargestComponent) {
    const float result[] = {1.0F, 0x1p-23F, 7.0F};
    const double exact[] = {1.0, 0.0, 0.0};
    EXPECT_EQ(ulps_off(result, exact, 2), 1.0);
    EXPECT_EQ(ulps_off(result, exact, 3), 7.0 * 0x1p23);
}

TEST(Ulp, ForgivesFlushedDenormalsAlone) {
    const float zero = 0.0F;
    const double denormal = 0x1p-130, normal = 0x1p-126;
    EXPECT_EQ(ulps_off(&zero, &denormal, 1), 0.0);
    EXPECT_EQ(ulps_off(&zero, &normal, 1), 0x1p23);
}

TEST(Ulp, NotANumberIsNotNear) {
    const float nothing = NAN;
    const double one = 1.0;
    EXPECT_EQ(ulps_off(&nothing, &one, 1), INFINITY);
}

TEST(ShaderFunctions, HaveFiniteExactValuesAndNamesOfTheirOwn) {
    std::set<std::string> names;
    for (const auto& functions : {shader_functions(), stored_codes()}) {
        for (const ShaderFunction& function : functions) {
            EXPECT_TRUE(names.insert(function.name).second) << function.name;
            auto inputs = function.special;
            Random random(2);
            for (int i = 0; function.input && i < 1000; ++i) inputs.push_back(function.input(random));
            ASSERT_FALSE(inputs.empty()) << function.name;
            for (const ShaderInput& input : inputs) {
                const glm::dvec4 exact = function.exact(input);
                for (int k = 0; k < function.components; ++k) ASSERT_TRUE(std::isfinite(exact[k])) << function.name;
            }
        }
    }
}

TEST(StoredCodes, AreAllOfThem) {
    const auto count = [](const std::string& name) {
        for (const ShaderFunction& function : stored_codes()) {
            if (function.name == name) return function.special.size();
        }
        return size_t{0};
    };
    EXPECT_EQ(count("sqrt: codes of 8 bits"), 256U);
    EXPECT_EQ(count("log2: codes of 16 bits"), 65536U);
    EXPECT_EQ(count("hemi_oct: codes of 8 bits"), 255U * 255U);
    // Of the square's sides, half and its middle; of the corners, which are one direction, one.
    EXPECT_EQ(count("oct: codes of 8 bits"), 253U * 253U + 4U * 127U + 1U);
}

}  // namespace
}  // namespace lightsweep
