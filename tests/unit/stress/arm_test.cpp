#include "bench/stress/arm.h"

#include "renderer/base/error.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::string> names(const std::vector<StressArm>& arms) {
    std::vector<std::string> result;
    for (const StressArm& arm : arms) result.push_back(arm.name());
    return result;
}

template <typename Action>
std::string input_error(Action action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError";
    return {};
}

const ArmBlock kTwoByTwo{{"format", {"half", "float"}}, {"order", {"sorted", "shuffled"}}};

TEST(StressArms, are_every_combination_in_the_order_of_the_axes) {
    EXPECT_THAT(names(stress_arms({kTwoByTwo}, {})),
                ElementsAre("format=half order=sorted", "format=half order=shuffled", "format=float order=sorted",
                            "format=float order=shuffled"));
    EXPECT_THAT(names(stress_arms({{}}, {})), ElementsAre("")) << "a case with nothing to choose is tried once";
    EXPECT_THAT(stress_arms({}, {}), IsEmpty());
}

TEST(StressArms, of_several_blocks_stand_once) {
    const ArmBlock wide{{"format", {"float", "double"}}, {"order", {"sorted"}}};
    const auto arms = names(stress_arms({kTwoByTwo, wide}, {}));
    EXPECT_THAT(arms, SizeIs(5));
    EXPECT_EQ(std::ranges::count(arms, "format=float order=sorted"), 1);
    EXPECT_EQ(arms.back(), "format=double order=sorted");
}

TEST(StressArms, a_path_without_a_layout_takes_none) {
    const auto arms = stress_arms({every_path("oct32")}, {});
    EXPECT_THAT(names(arms),
                AllOf(Contains("path=forward hdr=rgba32f"), Contains("path=deferred layout=oct32 hdr=rgba32f")));
    const ArmBlock layouts{{"path", {"forward", "deferred"}}, {"layout", {"oct16", "oct32"}}};
    EXPECT_THAT(names(stress_arms({layouts}, {})),
                ElementsAre("path=forward", "path=deferred layout=oct16", "path=deferred layout=oct32"))
        << "forward is tried once, not once for each layout";
}

TEST(StressArms, a_selection_takes_the_place_of_the_values) {
    const auto select = [](const AxisValues& selection) { return names(stress_arms({kTwoByTwo}, selection)); };
    EXPECT_THAT(select({{"order", {"shuffled"}}}),
                ElementsAre("format=half order=shuffled", "format=float order=shuffled"));
    EXPECT_THAT(select({{"path", {"forward"}}}), SizeIs(4)) << "an axis of other cases";
    // Of a case's own axis nothing but its own values can be tried; path and its like may be any.
    EXPECT_THAT(select({{"format", {"double"}}}), IsEmpty());
    EXPECT_THAT(names(stress_arms({every_layout()}, {{"path", {"light_prepass"}}, {"layout", {"oct16"}}})),
                ElementsAre("path=light_prepass layout=oct16 hdr=rgba32f"));
    EXPECT_THAT(names(stress_arms({{{"depth", {"D32F-reversed"}}}}, {{"depth", {"D16-standard"}}})),
                ElementsAre("depth=D16-standard"));
}

TEST(StressArms, tell_the_value_of_an_axis) {
    const StressArm arm = stress_arms({kTwoByTwo}, {}).front();
    EXPECT_EQ(arm.get("format"), "half");
    EXPECT_EQ(arm.get("depth"), "");
    EXPECT_EQ(arm.get("depth", "D32F-reversed"), "D32F-reversed");
    EXPECT_THAT(arm.choices(), SizeIs(2));
}

TEST(StressArms, blocks_that_cases_share_hold_what_they_say) {
    const auto paths = stress_arms({every_path()}, {}), lists = stress_arms({every_listing_path()}, {});
    EXPECT_LT(lists.size(), paths.size());
    for (const StressArm& arm : lists) EXPECT_THAT(paths, Contains(arm)) << arm.name();
    for (const StressArm& arm : stress_arms({every_layout()}, {})) EXPECT_EQ(arm.get("path"), "deferred");
    EXPECT_THAT(names(paths), Each(HasSubstr("hdr=rgba32f")));
}

TEST(StressAxes, are_read_as_those_of_a_sweep) {
    const auto parse = [](const std::vector<std::string>& arguments) {
        return parse_stress_axes(arguments, {kTwoByTwo, every_path(), {{"depth", {"D32F-reversed"}}}});
    };
    EXPECT_THAT(parse({"order=sorted", "path=forward,deferred"}).at("path"), ElementsAre("forward", "deferred"));
    EXPECT_THAT(parse({"order=*"}).at("order"), ElementsAre("sorted", "shuffled"));
    EXPECT_EQ(parse({"depth=*"}).at("depth"), kStressDepths);
    EXPECT_THAT(parse({"hdr=*"}).at("hdr"), SizeIs(3));
    EXPECT_THAT(parse({}), IsEmpty());

    EXPECT_THAT(input_error([&] { parse({"order"}); }), HasSubstr("axis=value"));
    EXPECT_THAT(input_error([&] { parse({"ordre=sorted"}); }), AllOf(HasSubstr("'ordre'"), HasSubstr("'order'")));
    EXPECT_THAT(input_error([&] { parse({"order=sortd"}); }), AllOf(HasSubstr("'sortd'"), HasSubstr("'sorted'")));
    EXPECT_THAT(input_error([&] { parse({"path=deffered"}); }), HasSubstr("did you mean 'deferred'"));
    EXPECT_THAT(input_error([&] { parse({"depth=D16"}); }), HasSubstr("D16-standard"));
    EXPECT_THAT(input_error([&] { parse({"order=sorted", "order=shuffled"}); }), HasSubstr("given before"));
    EXPECT_THAT(input_error([&] { parse({"guards=off"}); }), HasSubstr("'guards'"))
        << "an axis that the cases chosen do not have";
}

}  // namespace
}  // namespace lightsweep
