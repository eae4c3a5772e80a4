// The verdict on a timer, from made-up trials: no context, no clock.
#include "bench/measure/self_test.h"

#include "renderer/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightsweep {
namespace {

using testing::HasSubstr;

// Work that takes 2 ms a unit, three times each, timed as `said` says of the true time.
template <class Said>
TimerTrial trial(const std::string& kind, Said said) {
    TimerTrial t{kind, {512, 288}, 1, {1, 2, 4}, {}, {}};
    for (const int64_t amount : t.amounts) {
        const int64_t truth = amount * 2'000'000;
        t.yardstick_ns.push_back({truth + 9'000, truth, truth + 20'000});
        t.measured_ns.push_back({said(truth), said(truth), said(truth)});
    }
    return t;
}

TEST(JudgeTimer, AcceptsTheTruthWithinTheBand) {
    for (const double share : {0.92, 0.98, 1.0, 1.04}) {
        const auto scaled =
            trial("a", [&](int64_t ns) { return static_cast<int64_t>(share * static_cast<double>(ns)); });
        EXPECT_TRUE(judge_timer("m", {scaled}).accepted) << share;
    }
}

TEST(JudgeTimer, RefusesOutsideTheBand) {
    for (const double share : {0.0, 0.001, 0.5, 0.89, 1.06, 2.0}) {
        const auto scaled =
            trial("a", [&](int64_t ns) { return static_cast<int64_t>(share * static_cast<double>(ns)); });
        EXPECT_FALSE(judge_timer("m", {scaled}).accepted) << share;
    }
}

TEST(JudgeTimer, OneKindOfWorkIsEnoughToRefuse) {
    const auto honest = trial("one_framebuffer", [](int64_t ns) { return ns; });
    const auto blind = trial("compute", [](int64_t ns) { return ns / 1000; });
    const auto report = judge_timer("m", {honest, blind, honest});
    EXPECT_FALSE(report.accepted);
    EXPECT_THAT(report.why, HasSubstr("compute"));
    EXPECT_THAT(report.why, testing::Not(HasSubstr("one_framebuffer")));
    EXPECT_EQ(report.cases.size(), 3U);
}

TEST(JudgeTimer, RefusesWhatIsRightOnlyInTheMedian) {
    auto erratic = trial("a", [](int64_t ns) { return ns; });
    erratic.measured_ns[1][0] /= 3;
    erratic.measured_ns[2][2] /= 2;
    EXPECT_THAT(judge_timer("m", {erratic}).why, HasSubstr("of the clock"));
}

TEST(JudgeTimer, RefusesAConstant) {
    // The sum over the amounts would fit: 14 ms in all.
    const auto constant = trial("a", [](int64_t) { return int64_t{14'000'000 / 3}; });
    EXPECT_FALSE(judge_timer("m", {constant}).accepted);
}

TEST(JudgeTimer, RefusesAnImpossibleTimeAmongGoodOnes) {
    auto negative = trial("a", [](int64_t ns) { return ns; });
    negative.measured_ns[1][2] = -4'290'000'000;
    EXPECT_THAT(judge_timer("m", {negative}).why, HasSubstr("said"));
    auto wrapped = trial("a", [](int64_t ns) { return ns; });
    wrapped.measured_ns[2][0] = 4'294'967'296;
    EXPECT_FALSE(judge_timer("m", {wrapped}).accepted);
}

TimerMethodReport method(const std::string& name, bool accepted) {
    TimerMethodReport report;
    report.method = name;
    report.accepted = accepted;
    report.why = "because";
    return report;
}

TEST(ChooseTimer, TakesTheFirstAccepted) {
    EXPECT_EQ(choose_timer({method("a", false), method("b", true), method("c", true)}, "").method, "b");
}

TEST(ChooseTimer, ForcedWinsAndIsSaid) {
    const auto report = choose_timer({method("a", false), method("b", true)}, "a");
    EXPECT_EQ(report.method, "a");
    EXPECT_TRUE(report.forced);
}

TEST(ChooseTimer, NoneIsARefusedEnvironment) {
    EXPECT_THROW(choose_timer({method("a", false), method("b", false)}, ""), EnvironmentError);
}

}  // namespace
}  // namespace lightsweep
