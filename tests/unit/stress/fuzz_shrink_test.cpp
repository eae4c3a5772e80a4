// What must hold of shrinking: what is looked for stays, what it does not need goes, and time is kept to.
#include "bench/stress/fuzz_shrink.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lightsweep {
namespace {

using Json = nlohmann::ordered_json;

bool always() { return true; }

Json large_document() {
    Json json{{"summary", "much"}, {"camera", {{"eye", {1.25, 2.5, 3.75}}, {"fov", 61.7}}}};
    for (int i = 0; i < 40; ++i) json["lights"].push_back({{"radius", 0.5 + i}, {"color", {0.1, 0.2, 0.3}}});
    return json;
}

bool has_light_of(const Json& json, double radius) {
    return json.contains("lights") &&
           std::ranges::any_of(json["lights"], [&](const Json& light) { return light.value("radius", 0.0) >= radius; });
}

TEST(Shrink, LeavesTheOneElementThatIsNeeded) {
    const Json small = shrink(
        large_document(), [](const Json& json) { return has_light_of(json, 30.0); }, always);
    ASSERT_EQ(small.size(), 1U) << small;
    ASSERT_EQ(small["lights"].size(), 1U) << small;
    EXPECT_EQ(small["lights"][0].size(), 1U) << small;
    EXPECT_GE(small["lights"][0]["radius"].get<double>(), 30.0);
}

TEST(Shrink, KeepsTwoThatAreNeededTogether) {
    const auto both = [](const Json& json) {
        int near = 0, far = 0;
        for (const Json& light : json.value("lights", Json::array())) {
            const double radius = light.value("radius", 0.0);
            near += radius > 2.0 && radius < 4.0;
            far += radius > 35.0;
        }
        return near > 0 && far > 0;
    };
    EXPECT_EQ(shrink(large_document(), both, always)["lights"].size(), 2U);
}

TEST(Shrink, RoundsNumbersAsFarAsTheyMayGo) {
    const Json small = shrink(
        {{"a", 1234.5678}, {"b", 0.25}, {"c", -7.75}},
        [](const Json& json) {
            return json.contains("a") && json["a"] > 900.0 && json.contains("b") && json.contains("c") &&
                   json["c"] < 0.0;
        },
        always);
    EXPECT_EQ(small, Json({{"a", 1000.0}, {"b", 0.0}, {"c", -8.0}}));
}

TEST(Shrink, GivesBackWhatNothingCanBeTakenFrom) {
    const Json document = large_document();
    EXPECT_EQ(shrink(
                  document, [&](const Json& json) { return json == document; }, always),
              document);
}

TEST(Shrink, StopsWhenItMay) {
    int tried = 0;
    const auto count = [&](const Json&) { return ++tried > 0; };
    shrink(large_document(), count, [&] { return tried < 3; });
    EXPECT_EQ(tried, 3);
}

}  // namespace
}  // namespace lightsweep
