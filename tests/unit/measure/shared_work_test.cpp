#include "bench/measure/shared_work.h"

#include "tests/unit/report/synthetic.h"

#include <gmock/gmock.h>

namespace lightsweep {
namespace {

struct Planned {
    std::string path;
    std::string key;
    std::string skip = "all";
};

// A group as it is once its cells are drawn, and once they are sampled.
GroupResult drawn_group(int lights, const std::vector<Planned>& cells) {
    SyntheticClock clock(static_cast<uint64_t>(lights) + 1, 8, 0.02, 0.1);
    GroupResult group;
    for (const auto& planned : cells) {
        CellParams params = arm(planned.path, "", lights);
        params.skip = planned.skip;
        CellResult cell = synthetic_cell(params, 1e6, clock);
        cell.work_key = planned.key;
        cell.samples = {};
        cell.stop_reason.reset();
        cell.error.reset();
        cell.work->light_evaluations.reset();
        group.cells.push_back(std::move(cell));
    }
    group.group = group.cells.front().group;
    return group;
}

GroupResult measured_group(int lights, const std::vector<Planned>& cells) {
    GroupResult group = drawn_group(lights, cells);
    SyntheticClock clock(static_cast<uint64_t>(lights) + 100, 8, 0.02, 0.1);
    for (auto& cell : group.cells) {
        const CellResult sampled = synthetic_cell(cell.params, 1e6, clock);
        cell.samples = sampled.samples;
        cell.stop_reason = "target_ci";
        cell.error = sampled.error;
        cell.work->light_evaluations = 1000 + lights;
    }
    group.noise = NoiseTwin{group.cells.front().name, clock.rounds(), clock.wall_ns(1e6)};
    group.reference.emplace().key = "00aa";
    return group;
}

TEST(SameWork, is_of_equal_keys_where_both_share) {
    const GroupResult group = drawn_group(4, {{"forward", "k"},
                                              {"deferred", "k"},
                                              {"visibility", "other"},
                                              {"forward", "k", "none"},
                                              {"forward", "k", "none+cells"},
                                              {"forward", "k", "auto"}});
    const auto same = [&](size_t i, size_t j) { return same_work(group.cells[i], group.cells[j]); };
    EXPECT_TRUE(same(0, 1));
    EXPECT_TRUE(same(0, 4));
    EXPECT_FALSE(same(0, 2)) << "other work";
    EXPECT_FALSE(same(0, 3)) << "it wants samples of its own";
    EXPECT_FALSE(same(3, 0));
    EXPECT_FALSE(same(0, 5)) << "nothing was chosen for it";
    CellResult open = group.cells[5];
    open.auto_skip = SkipChoice{.skip = "all-sort", .why = "", .tried_ratio = {}};
    EXPECT_TRUE(same_work(group.cells[0], open));
    for (const auto change : {+[](CellParams& c) { c.scene = "atrium"; }, +[](CellParams& c) { c.width = 320; },
                              +[](CellParams& c) { c.hdr = "rgba32f"; }}) {
        CellResult other = group.cells[1];
        change(other.params);
        EXPECT_FALSE(same_work(group.cells[0], other));
    }
    CellResult failed = group.cells[1];
    failed.work_key.reset();
    EXPECT_FALSE(same_work(failed, failed));
}

TEST(Share, gives_what_was_measured_and_keeps_what_is_the_cells_own) {
    const GroupResult measured = measured_group(4, {{"forward", "k"}});
    const CellResult& like = measured.cells[0];
    CellResult cell = drawn_group(16, {{"forward", "k"}}).cells[0];
    cell.first_frame_ns = 77;
    cell.work->lights_culled = 12;
    cell.work->skipped = {{"light_frustum", 12}};
    share(like, cell);
    EXPECT_EQ(cell.shared_with, like.id);
    EXPECT_EQ(cell.samples.wall_ns, like.samples.wall_ns);
    EXPECT_EQ(cell.samples.passes, like.samples.passes);
    EXPECT_EQ(cell.stop_reason, "target_ci");
    EXPECT_EQ(cell.work->light_evaluations, 1004);
    EXPECT_TRUE(cell.error && cell.error->reference);
    EXPECT_EQ(cell.first_frame_ns, 77);
    EXPECT_EQ(cell.work->lights_culled, 12);
    EXPECT_EQ(cell.work->skipped.at("light_frustum"), 12);
    EXPECT_EQ(cell.params.lights, 16);
    EXPECT_TRUE(cell.measured());
}

TEST(SharedWork, a_group_whose_cells_are_all_known_is_not_measured_again) {
    SharedWork shared;
    const GroupResult measured = measured_group(4, {{"forward", "a"}, {"deferred", "b"}});
    shared.remember(measured);
    // Another order, and a cell that could not be drawn.
    GroupResult group = drawn_group(16, {{"deferred", "b"}, {"visibility", ""}, {"forward", "a"}});
    group.cells[1].status = CellStatus::invalid;
    group.cells[1].work_key.reset();
    group.cells[1].work.reset();
    ASSERT_TRUE(shared.share_group(group));
    EXPECT_EQ(group.cells[0].shared_with, measured.cells[1].id);
    EXPECT_FALSE(group.cells[1].shared_with);
    EXPECT_EQ(group.cells[2].shared_with, measured.cells[0].id);
    EXPECT_EQ(group.cells[2].samples.wall_ns, measured.cells[0].samples.wall_ns);
    ASSERT_TRUE(group.noise);
    EXPECT_EQ(group.noise->arm, group.cells[2].name) << "the twin of the same arm";
    EXPECT_EQ(group.noise->wall_ns, measured.noise->wall_ns);
    EXPECT_TRUE(group.reference->from_cache);

    // What was shared is no source of its own: the first one stays it.
    shared.remember(group);
    GroupResult third = drawn_group(64, {{"forward", "a"}});
    ASSERT_TRUE(shared.share_group(third));
    EXPECT_EQ(third.cells[0].shared_with, measured.cells[0].id);
}

TEST(SharedWork, a_group_that_is_not_wholly_in_one_earlier_group_stays_paired) {
    SharedWork shared;
    shared.remember(measured_group(4, {{"forward", "a"}, {"deferred", "b"}}));
    shared.remember(measured_group(8, {{"forward", "c"}, {"deferred", "d"}}));
    for (const auto& cells : std::vector<std::vector<Planned>>{
             {{"forward", "a"}, {"deferred", "x"}},
             {{"forward", "a"}, {"deferred", "d"}},              // known, but of two groups
             {{"forward", "a"}, {"deferred", "b", "all-cells"}}  // wants its own
         }) {
        GroupResult group = drawn_group(16, cells);
        EXPECT_FALSE(shared.share_group(group));
        for (const auto& cell : group.cells) EXPECT_FALSE(cell.shared_with || cell.measured());
        EXPECT_FALSE(group.noise);
    }
    GroupResult slow = drawn_group(16, {{"forward", "a"}, {"deferred", "b"}});
    time_out(slow.cells[1]);
    EXPECT_FALSE(shared.share_group(slow)) << "a frame of it was too slow this time";
    GroupResult nothing = drawn_group(16, {{"forward", "a"}});
    nothing.cells[0].work_key.reset();
    EXPECT_FALSE(shared.share_group(nothing)) << "nothing was drawn";
}

TEST(SharedWork, a_journal_read_back_gives_the_same) {
    const GroupResult measured = measured_group(4, {{"forward", "a"}});
    SharedWork shared;
    shared.remember(from_json<GroupResult>(Json::parse(line_text(to_json(measured))), "journal"));
    GroupResult group = drawn_group(16, {{"forward", "a"}});
    ASSERT_TRUE(shared.share_group(group));
    EXPECT_EQ(group.cells[0].samples.wall_ns, measured.cells[0].samples.wall_ns);
}

}  // namespace
}  // namespace lightsweep
