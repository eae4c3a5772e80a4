#include "bench/measure/slow_arms.h"

#include <gmock/gmock.h>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

CellParams arm(const std::string& path, int lights) {
    return {.scene = "atrium",
            .lights = lights,
            .width = 640,
            .height = 360,
            .overlap = 16.0,
            .path = path,
            .layout = "",
            .light_lists = "",
            .hdr = "rgba16f"};
}

GroupResult timed_out(const CellParams& params, const std::string& reason) {
    CellResult cell;
    cell.params = params;
    cell.status = CellStatus::timeout;
    cell.reason = reason;
    cell.too_slow_at_lights = params.lights;
    GroupResult group;
    group.cells.push_back(cell);
    return group;
}

TEST(SlowArms, an_arm_is_not_worth_drawing_with_as_many_lights_or_more) {
    SlowArms slow;
    EXPECT_FALSE(slow.find(arm("forward", 1 << 20)));
    slow.remember(timed_out(arm("forward", 256), "a frame takes 3.2 s"));
    EXPECT_FALSE(slow.find(arm("forward", 255)));
    for (const int lights : {256, 1024}) {
        const auto found = slow.find(arm("forward", lights));
        ASSERT_TRUE(found) << lights;
        EXPECT_EQ(found->lights, 256);
        EXPECT_THAT(found->reason, AllOf(HasSubstr("256 lights"), HasSubstr("a frame takes 3.2 s")));
    }
}

TEST(SlowArms, what_else_a_cell_says_makes_it_another_arm) {
    SlowArms slow;
    slow.remember(timed_out(arm("forward", 256), "slow"));
    CellParams other = arm("forward", 1024);
    EXPECT_TRUE(slow.find(other));
    for (const auto change : {+[](CellParams& c) { c.scene = "cornell"; }, +[](CellParams& c) { c.width = 320; },
                              +[](CellParams& c) { c.overlap = 0.0; }, +[](CellParams& c) { c.path = "deferred"; },
                              +[](CellParams& c) { c.layout = "oct16"; }, +[](CellParams& c) { c.light_lists = "cpu"; },
                              +[](CellParams& c) { c.hdr = "rgba32f"; }}) {
        CellParams changed = other;
        change(changed);
        EXPECT_FALSE(slow.find(changed)) << changed.name();
    }
}

TEST(SlowArms, the_fewest_lights_count_whatever_the_order) {
    for (const bool rising : {true, false}) {
        SlowArms slow;
        slow.remember(timed_out(arm("forward", rising ? 64 : 256), "slow"));
        slow.remember(timed_out(arm("forward", rising ? 256 : 64), "slow"));
        EXPECT_EQ(slow.find(arm("forward", 1024))->lights, 64);
        EXPECT_FALSE(slow.find(arm("forward", 63)));
    }
}

TEST(SlowArms, a_cell_that_was_skipped_for_it_or_failed_otherwise_says_nothing_new) {
    SlowArms slow;
    GroupResult group = timed_out(arm("forward", 256), "not drawn");
    group.cells.front().status = CellStatus::skipped;
    slow.remember(group);
    EXPECT_FALSE(slow.find(arm("forward", 256)));
}

}  // namespace
}  // namespace lightsweep
