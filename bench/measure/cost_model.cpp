#include "bench/measure/cost_model.h"

#include "bench/stats/nonnegative_fit.h"
#include "renderer/base/check.h"
#include "renderer/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

constexpr size_t kMostTried = 4;

// Raised whenever cost_terms changes: coefficients of other terms mean nothing.
constexpr int kModelVersion = 4;

const std::vector<std::string> kSearchNames{"all", "tiles", "clusters", "each"};

// About how many operations a light evaluation has: distance, window and direction; what each shading model adds (as in
// shaders/lib). A scene with several models pays for all of them where a driver does not branch.
constexpr double kLightOperations = 35.0;
constexpr std::array<double, kShadingModelCount> kModelOperations{85.0, 50.0, 10.0};  // by ShadingModel

double evaluation_weight(const CostFeatures& frame) {
    double operations = kLightOperations;
    for (size_t m = 0; m < kShadingModelCount; ++m) operations += frame.models[m] ? kModelOperations[m] : 0.0;
    return operations;
}

}  // namespace

std::vector<double> cost_terms(LightSearch search, const CostFeatures& frame) {
    const double per_pixel = search == LightSearch::all     ? frame.lights
                             : search == LightSearch::tiles ? frame.tile_lights
                                                            : frame.cluster_lights;
    const double evaluations = per_pixel * evaluation_weight(frame);
    std::vector<double> terms{1.0, frame.draws, frame.triangles, frame.pixels, frame.fragments,
                              frame.fragments * frame.texture_kinds, frame.covered_pixels,
                              frame.fragments * evaluations, frame.covered_pixels * evaluations,
                              // A triangle's edges shade pixels that are thrown away.
                              frame.triangles * evaluations};
    switch (search) {
        case LightSearch::all:
            break;
        case LightSearch::tiles:
            terms.insert(terms.end(), {frame.lights, frame.pixels * frame.tile_lights});
            break;
        case LightSearch::clusters:
            terms.insert(terms.end(), {frame.lights, frame.cells, frame.cells * frame.cluster_lights});
            break;
        case LightSearch::each:
            terms.insert(terms.end(), {frame.lights, frame.light_rectangles_px, frame.light_triangles});
            break;
    }
    return terms;
}

PathCost fit_path_cost(LightSearch search, const std::vector<CostSample>& samples) {
    CHECK(!samples.empty());
    std::vector<std::vector<double>> rows;
    for (const auto& sample : samples) {
        auto terms = cost_terms(search, sample.frame);
        for (double& term : terms) term /= sample.ns;
        rows.push_back(std::move(terms));
    }
    PathCost cost{.search = search,
                  .ns_per_term = nonnegative_fit(rows, std::vector<double>(rows.size(), 1.0)),
                  .samples = static_cast<int64_t>(samples.size())};
    double squares = 0.0;
    for (const auto& sample : samples) squares += std::pow(expected_ns(cost, sample.frame) / sample.ns - 1.0, 2);
    cost.fit_error = std::sqrt(squares / static_cast<double>(samples.size()));
    return cost;
}

double expected_ns(const PathCost& cost, const CostFeatures& frame) {
    const auto terms = cost_terms(cost.search, frame);
    CHECK_THAT(terms.size() == cost.ns_per_term.size(), "{} terms, {} coefficients", terms.size(),
               cost.ns_per_term.size());
    double ns = 0.0;
    for (size_t i = 0; i < terms.size(); ++i) ns += terms[i] * cost.ns_per_term[i];
    return ns;
}

Json to_json(const CostModel& model) {
    Json paths = Json::object();
    for (const auto& [key, cost] : model.paths) {
        paths[key] = {{"lights", kSearchNames[static_cast<size_t>(cost.search)]},
                      {"ns_per_term", cost.ns_per_term},
                      {"fit_error", cost.fit_error},
                      {"samples", cost.samples}};
    }
    return {{"version", kModelVersion}, {"fingerprint", model.fingerprint}, {"paths", paths}};
}

std::optional<CostModel> parse_cost_model(const std::string& text) {
    try {
        const Json json = Json::parse(text);
        if (json.at("version") != kModelVersion) return std::nullopt;
        CostModel model{.fingerprint = json.at("fingerprint").get<std::string>(), .paths = {}};
        for (const auto& [key, value] : json.at("paths").items()) {
            const auto search = std::ranges::find(kSearchNames, value.at("lights").get<std::string>());
            if (search == kSearchNames.end()) return std::nullopt;
            PathCost& cost = model.paths[key];
            cost.search = static_cast<LightSearch>(search - kSearchNames.begin());
            cost.ns_per_term = value.at("ns_per_term").get<std::vector<double>>();
            cost.fit_error = value.at("fit_error").get<double>();
            cost.samples = value.at("samples").get<int64_t>();
            if (cost.samples > 0 && cost.ns_per_term.size() != cost_terms(cost.search, {}).size()) return std::nullopt;
        }
        return model;
    } catch (const Json::exception&) {  // a damaged or foreign file: measured again
        return std::nullopt;
    }
}

std::vector<std::string> may_be_fastest(const CostModel& model, const PathChoice& choice) {
    const double best = choice.expected_ns.at(choice.path) * (1.0 + model.paths.at(choice.path).fit_error);
    std::vector<std::pair<double, std::string>> cheapest_first;
    for (const auto& [key, ns] : choice.expected_ns) {
        if (key == choice.path || ns * (1.0 - model.paths.at(key).fit_error) <= best) {
            cheapest_first.emplace_back(ns, key);
        }
    }
    std::ranges::sort(cheapest_first);
    std::vector<std::string> keys;
    for (const auto& [ns, key] : cheapest_first) {
        if (keys.size() < kMostTried) keys.push_back(key);
    }
    return keys;
}

void decide_by_trial(PathChoice& choice) {
    if (choice.tried_ns.empty()) return;
    const auto fastest = std::ranges::min_element(choice.tried_ns, {}, [](const auto& tried) { return tried.second; });
    choice.path = fastest->first;
    std::string others;
    for (const auto& [key, ns] : choice.tried_ns) {
        if (key != choice.path) others += fmt::format(", {} {:.3g} ms", key, ns * 1e-6);
    }
    choice.why = fmt::format("tried: {:.3g} ms{}; before, the model {}", fastest->second * 1e-6, others, choice.why);
}

PathChoice choose_path(const CostModel& model, const CostFeatures& frame) {
    std::vector<std::pair<double, std::string>> cheapest_first;
    PathChoice choice;
    for (const auto& [key, cost] : model.paths) {
        if (cost.samples == 0) continue;
        const double ns = expected_ns(cost, frame);
        choice.expected_ns[key] = ns;
        cheapest_first.emplace_back(ns, key);
    }
    if (cheapest_first.empty()) throw InputError("path=auto", "the cost model knows no path");
    std::ranges::sort(cheapest_first);
    choice.path = cheapest_first.front().second;
    choice.why = fmt::format("expected {} to take {:.3g} ms", choice.path, cheapest_first.front().first * 1e-6);
    if (cheapest_first.size() > 1) {
        choice.why += fmt::format(", {} {:.3g} ms", cheapest_first[1].second, cheapest_first[1].first * 1e-6);
    }
    choice.why += fmt::format(
        "; {:.0f} triangles, {:.3g} Mpx, {:.0f} lights in view, {:.3g} of them listed for a pixel's cluster",
        frame.triangles, frame.pixels * 1e-6, frame.lights, frame.cluster_lights);
    return choice;
}

}  // namespace lightsweep
