#include "bench/stress/judge.h"

#include "renderer/base/error.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::Field;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Pointwise;
using ::testing::SizeIs;

StressCase case_with(double bound, std::optional<StressParameter> parameter) {
    return {.id = "S0",
            .summary = "made up",
            .measures = "nothing",
            .unit = "rel",
            .bound = bound,
            .bound_source = "the test",
            .failure = "none",
            .parameter = parameter};
}

const StressParameter kDistance{.name = "distance", .unit = "units", .easy = 1.0, .hard = 1e6, .steps = 7};

StressResult judge_trial(const StressCase& stress_case, const StressTrial& trial, bool quick = false) {
    return judge(
        stress_case, StressArm(), [&] { return trial; }, quick);
}

std::vector<double> parameters(const StressResult& result) {
    std::vector<double> values;
    for (const StressPoint& point : result.curve) values.push_back(point.parameter);
    return values;
}

TEST(Judge, passes_what_stays_within_the_bound) {
    const auto result =
        judge_trial(case_with(1e-3, kDistance), [](double) { return StressMeasurement{.error = 1e-3}; });
    EXPECT_EQ(result.verdict, StressVerdict::pass) << "at the bound is within it";
    EXPECT_FALSE(result.breakdown);
    EXPECT_EQ(result.reason, "");
    const std::vector<double> factors{1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6};
    EXPECT_THAT(parameters(result), Pointwise(DoubleNear(1e-6), factors));
}

TEST(Judge, tells_of_a_pass_the_point_that_came_nearest_to_its_bound) {
    const auto result = judge_trial(case_with(1.0, kDistance), [](double p) {
        const double lg = std::round(std::log10(p));
        StressMeasurement found{.error = lg == 2.0 ? 0.5 : 0.1};
        if (lg == 4.0) found.bound = 0.11;
        return found;
    });
    EXPECT_NEAR(result.worst.parameter, 1e4, 1e-6) << "0.1 of 0.11 is nearer than 0.5 of 1";
}

TEST(Judge, bisects_the_breakdown_to_five_per_cent_from_above) {
    // The error passes 1e-3 at a distance of 12345.
    const auto law = [](double p) {
        return StressMeasurement{.error = p * (1e-3 / 12345.0), .law = p * (1e-3 / 12345.0)};
    };
    const auto result = judge_trial(case_with(1e-3, kDistance), law);
    EXPECT_EQ(result.verdict, StressVerdict::limit);
    ASSERT_TRUE(result.breakdown);
    EXPECT_GT(*result.breakdown, 12345.0);
    EXPECT_LE(*result.breakdown, 12345.0 * 1.05);
    EXPECT_EQ(result.worst.parameter, *result.breakdown);
    EXPECT_TRUE(std::ranges::is_sorted(parameters(result)));
    EXPECT_THAT(result.reason, AllOf(HasSubstr("rel, bound 0.001"), HasSubstr("predicted")));
    const auto again = judge_trial(case_with(1e-3, kDistance), law);
    EXPECT_EQ(parameters(again), parameters(result)) << "the same every time";
}

TEST(Judge, turns_a_parameter_down_as_well_as_up) {
    StressParameter roughness{.name = "roughness", .unit = "", .easy = 1.0, .hard = 1e-4, .steps = 5};
    const auto result = judge_trial(case_with(1e-3, roughness),
                                    [](double p) { return StressMeasurement{.error = 1e-5 / p, .law = 1e-5 / p}; });
    ASSERT_TRUE(result.breakdown);
    EXPECT_LT(*result.breakdown, 1e-2);
    EXPECT_GE(*result.breakdown, 1e-2 / 1.05);
    EXPECT_TRUE(std::ranges::is_sorted(parameters(result), std::greater<>())) << "from easy to hard";
}

TEST(Judge, finds_a_whole_number_exactly_where_it_is_small) {
    StressParameter lights{.name = "lights", .unit = "", .easy = 1.0, .hard = 1e4, .steps = 5, .whole = true};
    for (const double last_right : {1.0, 3.0, 7.0, 18.0}) {
        const auto result = judge_trial(case_with(1.0, lights), [&](double p) {
            EXPECT_EQ(p, std::round(p));
            return StressMeasurement{.error = p > last_right ? 2.0 : 0.0};
        });
        EXPECT_EQ(result.breakdown, last_right + 1.0);
    }
}

TEST(Judge, a_case_that_breaks_at_once_breaks_at_the_easy_end) {
    const auto result = judge_trial(case_with(1.0, kDistance), [](double) { return StressMeasurement{.error = 2.0}; });
    EXPECT_EQ(result.breakdown, 1.0);
    EXPECT_EQ(result.verdict, StressVerdict::fail);
    EXPECT_THAT(result.curve, SizeIs(7)) << "nothing to bisect";
}

TEST(Judge, beyond_the_bound_only_theory_or_the_format_make_it_a_limit) {
    const StressCase stress_case = case_with(1.0, {});
    const auto verdict_of = [&](const StressMeasurement& found) {
        return judge_trial(stress_case,
                           [&](double parameter) {
                               EXPECT_EQ(parameter, 0.0) << "a case without parameter";
                               return found;
                           })
            .verdict;
    };
    EXPECT_EQ(verdict_of({.error = 3.0}), StressVerdict::fail);
    EXPECT_EQ(verdict_of({.error = 3.0, .law = 1.6}), StressVerdict::limit) << "within twice the law";
    EXPECT_EQ(verdict_of({.error = 3.0, .law = 1.4}), StressVerdict::fail);
    EXPECT_EQ(verdict_of({.error = 3.0, .limit = "holds nothing below 0"}), StressVerdict::limit);
    EXPECT_EQ(verdict_of({.error = 3.0, .bound = 4.0}), StressVerdict::pass);
    EXPECT_EQ(verdict_of({.error = 0.0, .law = 1e-9}), StressVerdict::pass) << "better than the law is no fault";
}

TEST(Judge, what_is_not_finite_fails_whatever_else_is_said) {
    const StressCase stress_case = case_with(1.0, {});
    const auto result = judge_trial(stress_case, [](double) {
        return StressMeasurement{
            .error = 0.0, .law = 10.0, .non_finite = 7, .where = "pixel (1, 2)", .limit = "so be it"};
    });
    EXPECT_EQ(result.verdict, StressVerdict::fail);
    EXPECT_THAT(result.reason, AllOf(HasSubstr("7 values are not finite"), HasSubstr("pixel (1, 2)")));
    for (const double error : {NAN, INFINITY}) {
        EXPECT_EQ(judge_trial(stress_case, [&](double) { return StressMeasurement{.error = error}; }).verdict,
                  StressVerdict::fail);
        EXPECT_EQ(
            judge_trial(stress_case, [&](double) { return StressMeasurement{.error = error, .law = 1.0}; }).verdict,
            StressVerdict::fail);
    }
}

TEST(Judge, a_failure_anywhere_outweighs_the_limits_before_it) {
    const auto result = judge_trial(case_with(1.0, kDistance), [](double p) {
        StressMeasurement found{.error = p > 50.0 ? 2.0 : 0.5, .law = 2.0};
        if (p > 5e5) found.error = 100.0;
        return found;
    });
    EXPECT_EQ(result.verdict, StressVerdict::fail);
    EXPECT_EQ(result.worst.parameter, 1e6);
    EXPECT_LE(*result.breakdown, 50.0 * 1.05) << "where it left the bound first";
}

TEST(Judge, a_law_that_must_hold_fails_where_it_does_not_above_its_floor) {
    StressCase stress_case = case_with(1.0, kDistance);
    stress_case.law_factor = 2.0;
    stress_case.law_floor = 1e-6;
    const auto ratio = [&](double factor) {
        return judge_trial(stress_case,
                           [=](double p) { return StressMeasurement{.error = factor * p * 1e-9, .law = p * 1e-9}; });
    };
    EXPECT_EQ(ratio(1.9).verdict, StressVerdict::pass);
    EXPECT_EQ(ratio(0.6).verdict, StressVerdict::pass);
    EXPECT_EQ(ratio(2.1).verdict, StressVerdict::fail) << "though within the bound";
    EXPECT_EQ(ratio(0.4).verdict, StressVerdict::fail) << "too good to be what is measured";
    EXPECT_GT(ratio(2.1).worst.parameter, 999.0) << "the law is not asked below its floor";
}

TEST(Judge, quick_looks_at_three_points_and_does_not_bisect) {
    const auto result = judge_trial(
        case_with(1e-3, kDistance), [](double p) { return StressMeasurement{.error = p * 1e-6, .law = p * 1e-6}; },
        true);
    EXPECT_THAT(parameters(result), Pointwise(DoubleNear(1e-6), std::vector<double>{1.0, 1e3, 1e6}));
    EXPECT_EQ(result.breakdown, 1e6);
}

TEST(Judge, an_arm_that_is_refused_is_skipped_and_one_that_throws_fails) {
    const StressCase stress_case = case_with(1.0, kDistance);
    const auto judge_throwing = [&](auto error) {
        return judge(
            stress_case, StressArm(), [&]() -> StressTrial { throw error; }, false);
    };
    const auto refused = judge_throwing(InputError("layout=oct8: stores no position"));
    EXPECT_EQ(refused.verdict, StressVerdict::skipped);
    EXPECT_THAT(refused.reason, HasSubstr("no position"));
    EXPECT_THAT(refused.curve, IsEmpty());
    EXPECT_EQ(judge_throwing(EnvironmentError("8 targets at most")).verdict, StressVerdict::skipped);
    const auto broken = judge_throwing(std::runtime_error("a shader does not compile"));
    EXPECT_EQ(broken.verdict, StressVerdict::fail);
    EXPECT_EQ(broken.reason, "a shader does not compile");
}

TEST(Judge, every_point_has_its_own_verdict) {
    const auto result = judge_trial(case_with(1.0, kDistance), [](double p) {
        return StressMeasurement{.error = p > 5e3 ? 2.0 : 0.0, .law = 2.0};
    });
    for (const StressPoint& point : result.curve) {
        EXPECT_EQ(point.verdict, point.parameter > 5e3 ? StressVerdict::limit : StressVerdict::pass) << point.parameter;
    }
    EXPECT_THAT(result.curve, Each(Field(&StressPoint::parameter, AllOf(Ge(1.0), Le(1e6)))));
}

}  // namespace
}  // namespace lightsweep
