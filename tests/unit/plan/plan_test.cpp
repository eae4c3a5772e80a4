#include "bench/plan/plan.h"

#include "test_catalog.h"

#include <gmock/gmock.h>

#include <set>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Sweep five_groups() {
    return parse_sweep(R"({"summary": "s", "blocks": [
        {"scene": "cornell", "lights": [1, 2, 4], "path": ["forward", "deferred"]},
        {"scene": "atrium", "lights": [1, 2], "path": "forward"}]})",
                       "sweep.json", test_catalog());
}

Plan plan_of(const Sweep& sweep, const std::string& filter = {}, Shard shard = {}) {
    return make_plan(sweep, {}, filter, shard, test_catalog());
}

std::vector<std::string> keys(const Plan& plan) {
    std::vector<std::string> result;
    for (const auto& group : plan.groups) result.push_back(group.key);
    return result;
}

TEST(Plan, cells_that_share_scene_lights_size_and_overlap_form_a_group) {
    const Plan plan = plan_of(five_groups());
    EXPECT_THAT(keys(plan), ElementsAre("scene=cornell lights=1 size=640x360", "scene=cornell lights=2 size=640x360",
                                        "scene=cornell lights=4 size=640x360", "scene=atrium lights=1 size=640x360",
                                        "scene=atrium lights=2 size=640x360"));
    for (const auto& group : plan.groups) {
        for (const auto& cell : group.cells) EXPECT_EQ(cell.group(), group.key);
    }
    EXPECT_EQ(plan.cell_count, 8U);
    EXPECT_EQ(plan.total_cell_count, 8U);
}

TEST(Plan, cells_of_one_group_in_two_blocks_come_together) {
    const auto sweep = parse_sweep(R"({"summary": "s", "blocks": [
        {"scene": "cornell", "lights": [1, 2], "path": "forward"},
        {"scene": "cornell", "lights": [1], "path": "deferred"}]})",
                                   "sweep.json", test_catalog());
    const Plan plan = plan_of(sweep);
    ASSERT_EQ(plan.groups.size(), 2U);
    EXPECT_EQ(plan.groups[0].cells.size(), 2U);
    EXPECT_EQ(plan.groups[1].cells.size(), 1U);
}

TEST(Plan, shards_part_the_groups_and_share_the_hash) {
    const Plan whole = plan_of(five_groups());
    for (int count = 1; count <= 5; ++count) {
        std::multiset<std::string> united;
        size_t cells = 0;
        for (int index = 1; index <= count; ++index) {
            const Plan part = plan_of(five_groups(), {}, {index, count});
            EXPECT_EQ(part.hash, whole.hash);
            EXPECT_EQ(part.total_cell_count, whole.total_cell_count);
            for (const auto& key : keys(part)) united.insert(key);
            cells += part.cell_count;
        }
        const auto expected = keys(whole);
        EXPECT_EQ(united, std::multiset<std::string>(expected.begin(), expected.end())) << count << " shards";
        EXPECT_EQ(cells, whole.cell_count);
    }
    EXPECT_THAT(input_error([] {
                    plan_of(five_groups(), {}, {6, 6});
                }),
                AllOf(HasSubstr("shard 6/6"), HasSubstr("only 5")));
}

TEST(Plan, the_filter_drops_cells_and_changes_the_hash) {
    const Plan whole = plan_of(five_groups());
    const Plan forward = plan_of(five_groups(), "path=forward .*hdr");
    EXPECT_EQ(forward.cell_count, 5U);
    EXPECT_NE(forward.hash, whole.hash);
    EXPECT_EQ(plan_of(five_groups(), "scene=").hash, whole.hash);
    const Plan one = plan_of(five_groups(), "cornell lights=2 .*deferred");
    EXPECT_THAT(keys(one), ElementsAre("scene=cornell lights=2 size=640x360"));
}

TEST(Plan, a_bad_or_empty_filter_result_says_why) {
    EXPECT_THAT(input_error([] { plan_of(five_groups(), "path=(forward"); }),
                AllOf(HasSubstr("path=(forward"), HasSubstr("regular expression")));
    EXPECT_THAT(input_error([] { plan_of(five_groups(), "layout=oct64"); }),
                AllOf(HasSubstr("none of the 8 cells"), HasSubstr("scene=cornell lights=1")));
}

TEST(Plan, shard_text) {
    EXPECT_EQ(parse_shard("2/3").index, 2);
    EXPECT_EQ(parse_shard("2/3").count, 3);
    for (const std::string bad : {"", "1", "0/2", "3/2", "a/b", "1/2/3", "-1/2", "1/", "1/2 "}) {
        EXPECT_THROW(parse_shard(bad), InputError) << bad;
    }
}

}  // namespace
}  // namespace lightsweep
