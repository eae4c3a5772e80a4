// The cost model finds back the costs that synthetic times were made of, and chooses by them.
#include "bench/measure/cost_model.h"
#include "renderer/base/error.h"

#include <gmock/gmock.h>

#include <random>

namespace lightsweep {
namespace {

using testing::HasSubstr;

CostFeatures frame(double triangles, double pixels, double lights, double listed) {
    return {.draws = 10,
            .triangles = triangles,
            .pixels = pixels,
            .fragments = 1.5 * pixels,
            .covered_pixels = 0.9 * pixels,
            .texture_kinds = 1,
            .models = {true, false, false},
            .lights = lights,
            .cells = pixels / 64,
            .cluster_lights = listed,
            .tile_lights = 1.5 * listed,
            .light_rectangles_px = pixels * listed / 2,
            .light_triangles = triangles * listed / 10};
}

// Frames of many sizes.
std::vector<CostFeatures> many_frames() {
    std::mt19937 random(3);
    const auto power = [&](double low, double high) {
        return low * std::pow(high / low, std::uniform_real_distribution<double>(0.0, 1.0)(random));
    };
    std::vector<CostFeatures> frames;
    for (int i = 0; i < 40; ++i)
        frames.push_back(frame(power(1e3, 1e6), power(5e4, 1e6), power(1, 8192), power(1, 40)));
    return frames;
}

PathCost fit(LightSearch search, double (*truth_ns)(const CostFeatures&)) {
    std::vector<CostSample> samples;
    for (const auto& f : many_frames()) samples.push_back({f, truth_ns(f)});
    return fit_path_cost(search, samples);
}

double every_light_ns(const CostFeatures& f) {
    return 1e5 + 90 * f.triangles + 20 * f.pixels + 3 * f.pixels * f.lights;
}
double listed_light_ns(const CostFeatures& f) {
    return 1e5 + 120 * f.triangles + 30 * f.pixels + 3 * f.pixels * f.cluster_lights + 80 * f.lights;
}

TEST(CostModel, PredictsFramesThatItDidNotSee) {
    using Truth = double (*)(const CostFeatures&);
    const std::vector<std::pair<LightSearch, Truth>> cases{{LightSearch::all, every_light_ns},
                                                           {LightSearch::clusters, listed_light_ns}};
    for (const auto& [search, truth] : cases) {
        const PathCost cost = fit(search, truth);
        EXPECT_LT(cost.fit_error, 1e-3);
        const CostFeatures unseen = frame(5e5, 2e6, 300, 12);
        EXPECT_NEAR(expected_ns(cost, unseen) / truth(unseen), 1.0, 1e-2);
    }
}

TEST(CostModel, FitErrorTellsOfTimesThatTheTermsCannotExplain) {
    const PathCost cost =
        fit(LightSearch::all, [](const CostFeatures& f) { return 1e4 + 3e-9 * std::pow(f.pixels, 3.0); });
    EXPECT_GT(cost.fit_error, 0.05);
}

TEST(CostModel, ChoosesTheCheaperPathOnEachSideOfTheirCrossing) {
    CostModel model;
    model.paths["plain"] = fit(LightSearch::all, every_light_ns);
    model.paths["lists"] = fit(LightSearch::clusters, listed_light_ns);
    const PathChoice few = choose_path(model, frame(2e5, 1e6, 1, 1));
    const PathChoice many = choose_path(model, frame(2e5, 1e6, 1024, 16));
    EXPECT_EQ(few.path, "plain");
    EXPECT_EQ(many.path, "lists");
    ASSERT_EQ(many.expected_ns.size(), 2U);
    EXPECT_LT(many.expected_ns.at("lists"), many.expected_ns.at("plain"));
    EXPECT_THAT(many.why, HasSubstr("1024 lights"));
    EXPECT_THAT(many.why, HasSubstr("plain"));
    EXPECT_THROW(choose_path({}, frame(1, 1, 1, 1)), InputError);
}

// Who may be fastest follows from how far off each fit was; who is fastest, from the trial.
TEST(CostModel, TriesThoseThatItsErrorsLeaveOpen) {
    CostModel model;
    for (const auto& [key, fit_error] : {std::pair{"near", 0.1}, {"exact", 0.0}, {"vague", 0.5}, {"best", 0.05}}) {
        model.paths[key] = PathCost{.ns_per_term = {}, .fit_error = fit_error, .samples = 1};
    }
    PathChoice choice{.path = "best", .why = "said so", .expected_ns = {}, .tried_ns = {}};
    // 105 at the worst for the best: 0.9 * 115 = 103.5 is below, 1.0 * 106 is not, 0.5 * 200 is.
    choice.expected_ns = {{"best", 100.0}, {"near", 115.0}, {"exact", 106.0}, {"vague", 200.0}};
    EXPECT_EQ(may_be_fastest(model, choice), (std::vector<std::string>{"best", "near", "vague"}));

    choice.tried_ns = {{"best", 3e6}, {"near", 2e6}, {"vague", 5e6}};
    decide_by_trial(choice);
    EXPECT_EQ(choice.path, "near");
    EXPECT_THAT(choice.why, HasSubstr("2 ms"));
    EXPECT_THAT(choice.why, HasSubstr("said so"));
}

// More work never makes a frame cheaper, whatever the samples were.
TEST(CostModel, IsMonotone) {
    std::mt19937 random(11);
    std::vector<CostSample> samples;
    for (const auto& f : many_frames()) {
        samples.push_back({f, 1e6 * std::uniform_real_distribution<double>(0.5, 2.0)(random)});
    }
    for (const auto search : {LightSearch::all, LightSearch::tiles, LightSearch::clusters, LightSearch::each}) {
        const PathCost cost = fit_path_cost(search, samples);
        const double before = expected_ns(cost, frame(1e5, 1e5, 100, 10));
        EXPECT_GE(expected_ns(cost, frame(2e5, 1e5, 100, 10)), before);
        EXPECT_GE(expected_ns(cost, frame(1e5, 1e5, 200, 10)), before);
        EXPECT_GE(expected_ns(cost, frame(1e5, 1e5, 100, 20)), before);
    }
}

TEST(CostModel, TextRoundTripAndForeignTexts) {
    CostModel model{.fingerprint = "abc", .paths = {}};
    model.paths["plain"] = fit(LightSearch::all, every_light_ns);
    model.paths["each"] = fit(LightSearch::each, every_light_ns);
    const auto read = parse_cost_model(to_json(model).dump());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->fingerprint, "abc");
    EXPECT_EQ(read->paths.at("plain").ns_per_term, model.paths["plain"].ns_per_term);
    EXPECT_EQ(read->paths.at("each").search, LightSearch::each);
    Json other = to_json(model);
    other["version"] = -1;
    EXPECT_FALSE(parse_cost_model(other.dump()));
    EXPECT_FALSE(parse_cost_model("{"));
    EXPECT_FALSE(parse_cost_model("[1]"));
}

}  // namespace
}  // namespace lightsweep
