// The front of time against error, by hand and against its definition.
#include "bench/stats/pareto.h"

#include "renderer/base/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace lightsweep {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ParetoFront, KeepsWhatNothingBeats) {
    const std::vector<TimeAndError> points{{3, 1}, {1, 5}, {2, 2}, {2, 3}, {4, 1}, {5, 0}};
    EXPECT_THAT(pareto_front(points), ElementsAre(1, 2, 0, 5));
}

TEST(ParetoFront, KeepsTiesTogether) {
    EXPECT_THAT(pareto_front(std::vector<TimeAndError>{{1, 1}, {2, 0}, {1, 1}, {2, 0}, {2, 1}}),
                ElementsAre(0, 2, 1, 3));
    EXPECT_THAT(pareto_front(std::vector<TimeAndError>{{1, 2}, {1, 1}}), ElementsAre(1));
}

TEST(ParetoFront, LeavesOutWhatIsNotFinite) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(pareto_front(std::vector<TimeAndError>{{kNan, 0}, {1, kNan}, {7, 7}}), ElementsAre(2));
    EXPECT_THAT(pareto_front({}), IsEmpty());
}

TEST(ParetoFront, IsItsDefinition) {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<TimeAndError> points(1 + random.index(12));
        for (auto& p : points) p = {static_cast<double>(random.index(6)), static_cast<double>(random.index(6))};
        const auto front = pareto_front(points);
        for (size_t i = 0; i < points.size(); ++i) {
            const bool dominated = std::ranges::any_of(points, [&](const TimeAndError& p) {
                return p.time <= points[i].time && p.error <= points[i].error &&
                       (p.time < points[i].time || p.error < points[i].error);
            });
            EXPECT_EQ(std::ranges::count(front, i), dominated ? 0 : 1);
        }
    }
}

}  // namespace
}  // namespace lightsweep
