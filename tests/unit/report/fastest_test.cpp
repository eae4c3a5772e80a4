#include "bench/report/fastest.h"

#include "bench/report/crossovers.h"
#include "synthetic.h"

#include <gmock/gmock.h>

namespace lightsweep {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// ms at lights: forward 1 + n / 10, tiled 3 + n / 100, clustered 6 + n / 1000.
// forward meets tiled at 22 lights, tiled clustered at 333; forward clustered at 50.
double three_paths(const CellParams& cell) {
    const double n = *cell.lights;
    if (cell.path == "forward") return 1e6 * (1.0 + n / 10.0);
    if (cell.path == "deferred_tiled") return 1e6 * (3.0 + n / 100.0);
    return 1e6 * (6.0 + n / 1000.0);
}

const std::vector<std::pair<std::string, std::string>> kThree{
    {"forward", ""}, {"deferred_tiled", "oct16"}, {"deferred_clustered", "oct16"}};
const std::vector<int> kLights{1, 4, 16, 64, 256, 1024};

// `forward 1-16!`: the exclamation mark stands for surely.
std::vector<std::string> ranges_text(const FastestOverLights& entry) {
    std::vector<std::string> lines;
    for (const auto& r : entry.ranges) {
        std::string line = r.arm.path + " " + std::to_string(r.from_lights) + "-" + std::to_string(r.to_lights);
        for (const auto& rival : r.rivals) line += " " + rival.path;
        lines.push_back(line + (r.surely ? "!" : ""));
    }
    return lines;
}

std::vector<std::string> pairs_text(const std::vector<ArmCrossover>& crossovers) {
    std::vector<std::string> lines;
    for (const auto& c : crossovers) {
        lines.push_back(c.a.path + "/" + c.b.path + (c.on_envelope ? " envelope" : "") +
                        (c.crossover.lights ? "" : " none"));
    }
    return lines;
}

TEST(Fastest, the_lower_envelope_is_the_planted_one) {
    const auto journal = synthetic_journal(kThree, kLights, three_paths, 60, 0.02);
    const auto fastest = find_fastest(journal.groups, {});
    ASSERT_THAT(fastest, SizeIs(1));
    EXPECT_THAT(ranges_text(fastest[0]),
                ElementsAre("forward 1-16!", "deferred_tiled 64-256!", "deferred_clustered 1024-1024!"));
    EXPECT_EQ(fastest[0].view.layout, "oct16");
    EXPECT_EQ(fastest[0].view.path, "");
}

TEST(Fastest, arms_that_cannot_be_told_apart_are_rivals) {
    const auto journal = synthetic_journal(
        {{"forward", ""}, {"deferred", "oct16"}, {"deferred_volumes", "oct16"}}, {1, 4},
        [](const CellParams& c) { return c.path == "forward" ? 5e6 : 1e6; }, 40, 0.02);
    const auto fastest = find_fastest(journal.groups, {});
    ASSERT_THAT(fastest, SizeIs(1));
    for (const auto& range : fastest[0].ranges) {
        EXPECT_FALSE(range.surely);
        ASSERT_THAT(range.rivals, SizeIs(1)) << "forward is surely slower";
        EXPECT_NE(range.rivals[0].path, range.arm.path);
        EXPECT_NE(range.rivals[0].path, "forward");
    }
}

TEST(Fastest, without_a_noise_floor_nobody_is_surely_fastest) {
    auto journal = synthetic_journal(kThree, kLights, three_paths, 60, 0.02);
    for (auto& group : journal.groups) group.noise.reset();
    for (const auto& range : find_fastest(journal.groups, {})[0].ranges) {
        EXPECT_FALSE(range.surely);
        EXPECT_THAT(range.rivals, SizeIs(2));
    }
}

TEST(Fastest, an_arm_too_slow_to_sample_is_out_of_the_running) {
    auto journal = synthetic_journal(kThree, kLights, three_paths, 60, 0.02);
    time_out(journal.groups[5].cells[1]);
    time_out(journal.groups[5].cells[2]);
    EXPECT_THAT(ranges_text(find_fastest(journal.groups, {})[0]),
                ElementsAre("forward 1-16!", "deferred_tiled 64-256!", "forward 1024-1024!"));
}

TEST(Fastest, each_layout_and_each_hdr_format_has_its_own) {
    auto journal = synthetic_journal(
        {{"forward", ""}, {"deferred", "oct16"}, {"deferred", "oct32"}}, {1, 64},
        [](const CellParams& c) { return c.layout == "oct32" ? 1e6 : 2e6; }, 20, 0.02);
    EXPECT_THAT(find_fastest(journal.groups, {}), SizeIs(2));
    for (auto& group : journal.groups) group.cells[1].params.hdr = "rgba32f";  // alone with its format
    const auto fastest = find_fastest(journal.groups, {});
    ASSERT_THAT(fastest, SizeIs(1));
    EXPECT_EQ(fastest[0].view.layout, "oct32");
    EXPECT_EQ(fastest[0].view.hdr, "rgba16f");
}

TEST(Fastest, guards_and_sums_have_contests_of_their_own) {
    // The unguarded arms are faster, and would win every range of a common contest.
    auto journal = synthetic_journal(kThree, kLights, three_paths, 60, 0.02);
    for (auto& group : journal.groups) {
        SyntheticClock clock(7, 60, 0.02, 0.3);
        for (const size_t i : {size_t{0}, size_t{1}}) {
            CellParams params = group.cells[i].params;
            params.guards = "off";
            group.cells.push_back(synthetic_cell(params, 1e5 + three_paths(params) / 2.0, clock));
        }
    }
    const auto fastest = find_fastest(journal.groups, {});
    ASSERT_THAT(fastest, SizeIs(2));
    for (const auto& contest : fastest) {
        for (const auto& range : contest.ranges) EXPECT_EQ(range.arm.guards, contest.view.guards);
    }
    EXPECT_NE(fastest[0].view.guards, fastest[1].view.guards);
    EXPECT_THAT(ranges_text(fastest[0]),
                ElementsAre("forward 1-16!", "deferred_tiled 64-256!", "deferred_clustered 1024-1024!"));
    for (const auto& crossover : find_crossovers(journal.groups, fastest)) {
        EXPECT_EQ(crossover.a.guards, crossover.b.guards);
    }
}

TEST(Fastest, one_arm_or_one_light_count_is_no_contest) {
    const auto flat = [](const CellParams&) { return 1e6; };
    EXPECT_THAT(find_fastest(synthetic_journal({{"forward", ""}}, {1, 4}, flat).groups, {}), IsEmpty());
    EXPECT_THAT(find_fastest(synthetic_journal(kThree, {4}, flat).groups, {}), IsEmpty());
}

TEST(Crossovers, are_those_against_forward_and_then_of_the_pairs_that_change_places) {
    const auto journal = synthetic_journal(kThree, kLights, three_paths, 60, 0.02);
    const auto crossovers = find_crossovers(journal.groups, find_fastest(journal.groups, {}));
    EXPECT_THAT(pairs_text(crossovers), ElementsAre("deferred_tiled/forward envelope", "deferred_clustered/forward",
                                                    "deferred_clustered/deferred_tiled envelope"));
    // Straight lines between the measured counts are not the true curves.
    EXPECT_NEAR(crossovers[0].crossover.lights->estimate, 22.2, 3.0);
    EXPECT_NEAR(crossovers[1].crossover.lights->estimate, 50.5, 6.0);
    EXPECT_NEAR(crossovers[2].crossover.lights->estimate, 333.3, 40.0);
    EXPECT_LT(*crossovers[2].crossover.lights->low, crossovers[2].crossover.lights->estimate);
}

TEST(Crossovers, of_two_others_that_never_change_places_are_left_out) {
    const auto journal = synthetic_journal(kThree, {1, 4, 16}, three_paths, 60, 0.02);
    EXPECT_THAT(pairs_text(find_crossovers(journal.groups, find_fastest(journal.groups, {}))),
                ElementsAre("deferred_tiled/forward none", "deferred_clustered/forward none"));
}

TEST(Crossovers, are_not_of_different_layouts_or_formats) {
    auto journal =
        synthetic_journal({{"deferred_tiled", "oct16"}, {"deferred_clustered", "oct32"}}, kLights, three_paths);
    EXPECT_THAT(find_crossovers(journal.groups, find_fastest(journal.groups, {})), IsEmpty());
    for (auto& group : journal.groups) group.cells[1].params.layout = "oct16";
    EXPECT_THAT(find_crossovers(journal.groups, find_fastest(journal.groups, {})), SizeIs(1));
    for (auto& group : journal.groups) group.cells[1].params.hdr = "rgba32f";
    EXPECT_THAT(find_crossovers(journal.groups, find_fastest(journal.groups, {})), IsEmpty());
}

TEST(Crossovers, of_an_arm_that_stands_before_forward_have_forward_last_all_the_same) {
    const auto journal =
        synthetic_journal({{"deferred_tiled", "oct16"}, {"forward", ""}}, kLights, three_paths, 60, 0.02);
    const auto crossovers = find_crossovers(journal.groups, {});
    EXPECT_THAT(pairs_text(crossovers), ElementsAre("deferred_tiled/forward"));
    EXPECT_NEAR(crossovers[0].crossover.lights->estimate, 22.2, 3.0);
}

}  // namespace
}  // namespace lightsweep
