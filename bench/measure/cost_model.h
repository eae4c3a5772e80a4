// What a frame of each path is expected to cost on this machine: a nonnegative combination of the work that the frame
// asks for, fitted to cells that were measured (calibrate.h). Pure functions; the terms are the model.
#pragma once

#include "bench/report/record.h"
#include "renderer/scene/scene.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// How a path finds the lights of a pixel: it decides which work its time depends on.
enum class LightSearch : uint8_t { all, tiles, clusters, each };

/// What is known of a frame before any path draws it.
struct CostFeatures {
    double draws = 0;
    double triangles = 0;  ///< after frustum culling
    double pixels = 0;
    double fragments = 0;                           ///< nearest so far in the order of drawing: those of overdraw too
    double covered_pixels = 0;                      ///< that show a surface
    double texture_kinds = 0;                       ///< base colour, normal, ...: how many of them the scene samples
    std::array<bool, kShadingModelCount> models{};  ///< whether the scene has it
    double lights = 0;                              ///< points and spots that can reach the view
    double cells = 0;                               ///< of the clustered grid
    double cluster_lights = 0;                      ///< listed for a covered pixel's cluster, on average
    double tile_lights = 0;          ///< listed for a covered pixel's tile, bounded by its depths, on average
    double light_rectangles_px = 0;  ///< sum of the lights' rectangles on the screen
    double light_triangles = 0;      ///< of the instances that each light may reach, summed over the lights
};

/// The amounts of work of one path's frame, in the order of its coefficients.
std::vector<double> cost_terms(LightSearch search, const CostFeatures& frame);

/// One measured frame of a path.
struct CostSample {
    CostFeatures frame;
    double ns = 0;
};

struct PathCost {
    LightSearch search = LightSearch::all;
    std::vector<double> ns_per_term;
    double fit_error = 0;  ///< root mean square of (predicted - measured) / measured over the samples
    int64_t samples = 0;   ///< 0: the device refused the path; there are no coefficients
};

/// `samples` must not be empty. Every sample weighs the same, whatever its time.
PathCost fit_path_cost(LightSearch search, const std::vector<CostSample>& samples);

double expected_ns(const PathCost& cost, const CostFeatures& frame);

struct CostModel {
    std::string fingerprint;  ///< of the environment that it was measured in
    std::map<std::string, PathCost> paths;
};

Json to_json(const CostModel& model);
/// Nothing when the text is not a model of this program's version.
std::optional<CostModel> parse_cost_model(const std::string& text);

/// What `path=auto` stands for in one cell as far as the model knows: the cheapest. Throws InputError when the model
/// knows no path.
PathChoice choose_path(const CostModel& model, const CostFeatures& frame);

/// The paths that may be the fastest of `choice.expected_ns`, the cheapest first, a few at most: were each as far off
/// as its fit was, they would not be slower than it.
std::vector<std::string> may_be_fastest(const CostModel& model, const PathChoice& choice);

/// Takes the fastest of those that were tried (`choice.tried_ns`, ns by path), and says so.
void decide_by_trial(PathChoice& choice);

}  // namespace lightsweep
