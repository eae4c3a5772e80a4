#include "bench/measure/skip_choice.h"

#include <gmock/gmock.h>

namespace lightsweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const SkipFacts kUsual{.instances = 100, .local_lights = 16, .lists_lights = true};

// Trials with planted ratios, and what was asked of them.
struct PlantedTrials {
    std::map<Skip, double> ratios{};  // of others: the same work
    double error = 0.005;             // half width of their intervals
    bool refuse = false;
    std::vector<std::pair<SkipSet, SkipSet>> asked{};

    TrySkip trials() {
        return [this](SkipSet with, SkipSet without) -> std::optional<SkipTrial> {
            asked.emplace_back(with, without);
            if (refuse) return {};
            for (const auto& [skip, ratio] : ratios) {
                if (without.with(skip) != with) continue;
                return SkipTrial{.ratio = {.estimate = ratio, .low = ratio - error, .high = ratio + error}};
            }
            return SkipTrial{.same_work = true, .ratio = {}};
        };
    }
};

TEST(SkipChoice, keeps_all_where_nothing_costs) {
    PlantedTrials planted{.ratios = {{Skip::occlusion, 0.5}, {Skip::sort, 1.0}, {Skip::background, 1.009}}};
    const SkipChoice choice = choose_skips(kUsual, planted.trials());
    EXPECT_EQ(choice.skip, "all");
    EXPECT_EQ(choice.tried_ratio.size(), 3U) << "what is the same work has no ratio";
    EXPECT_EQ(choice.tried_ratio.at("occlusion"), 0.5);
    EXPECT_THAT(choice.why, AllOf(HasSubstr("occlusion (50.0 % faster"), Not(HasSubstr("off"))));
}

TEST(SkipChoice, turns_off_what_costs_and_tries_the_next_with_what_is_left) {
    PlantedTrials planted{.ratios = {{Skip::occlusion, 1.2}, {Skip::sort, 0.9}, {Skip::light_depth, 1.011}}};
    const SkipChoice choice = choose_skips(kUsual, planted.trials());
    EXPECT_EQ(choice.skip, "all-light_depth-occlusion");
    EXPECT_THAT(choice.why,
                AllOf(HasSubstr("20.0 % slower with it"), HasSubstr("light_depth"), HasSubstr("kept: sort")));
    SkipSet left = SkipSet::all();
    for (const auto& [with, without] : planted.asked) {
        EXPECT_EQ(with, left);
        if (with.has(Skip::occlusion) && !without.has(Skip::occlusion)) left = without;
        if (with.has(Skip::light_depth) && !without.has(Skip::light_depth)) left = without;
    }
    EXPECT_EQ(left.text(), choice.skip);
}

TEST(SkipChoice, what_noise_may_have_slowed_is_kept) {
    PlantedTrials planted{.ratios = {{Skip::occlusion, 1.05}}, .error = 0.06};
    SkipChoice choice = choose_skips(kUsual, planted.trials());
    EXPECT_EQ(choice.skip, "all");
    EXPECT_THAT(choice.why, HasSubstr("not surely"));
    planted.error = 0.04;
    EXPECT_EQ(choose_skips(kUsual, planted.trials()).skip, "all-occlusion");
}

TEST(SkipChoice, what_the_scene_makes_pointless_needs_no_trial) {
    PlantedTrials planted{.ratios = {{Skip::occlusion, 0.1}, {Skip::sort, 0.1}, {Skip::light_lists, 0.1}}};
    const SkipChoice choice = choose_skips({.instances = 1, .local_lights = 0, .lists_lights = true}, planted.trials());
    EXPECT_EQ(choice.skip, "all-light_lists-light_depth-occlusion-sort");
    EXPECT_THAT(choice.why, AllOf(HasSubstr("occlusion (one instance)"), HasSubstr("no point or spot lights")));
    EXPECT_THAT(choice.tried_ratio, IsEmpty());
}

TEST(SkipChoice, lists_of_many_lights_are_kept_without_waiting_for_a_frame_without) {
    const auto tried = [](const SkipFacts& facts) {
        PlantedTrials planted{.ratios = {{Skip::light_lists, 1.5}}};
        return choose_skips(facts, planted.trials()).tried_ratio.contains("light_lists");
    };
    EXPECT_TRUE(tried({.instances = 9, .local_lights = 32, .lists_lights = true}));
    EXPECT_FALSE(tried({.instances = 9, .local_lights = 33, .lists_lights = true}));
    EXPECT_TRUE(tried({.instances = 9, .local_lights = 33, .lists_lights = true, .listed_share = 0.9}))
        << "what reaches everywhere is listed everywhere";
    PlantedTrials none{};
    EXPECT_THAT(choose_skips({.instances = 9, .local_lights = 33, .lists_lights = true}, none.trials()).why,
                HasSubstr("light_lists (lists leave out most)"));
    EXPECT_FALSE(tried({.instances = 9, .local_lights = 4, .lists_lights = false}));
}

TEST(SkipChoice, what_cannot_be_tried_is_kept) {
    PlantedTrials planted{.ratios = {{Skip::occlusion, 2.0}}, .refuse = true};
    const SkipChoice choice = choose_skips(kUsual, planted.trials());
    EXPECT_EQ(choice.skip, "all");
    EXPECT_THAT(choice.tried_ratio, IsEmpty());
    EXPECT_THAT(planted.asked, Not(IsEmpty()));
}

}  // namespace
}  // namespace lightsweep
