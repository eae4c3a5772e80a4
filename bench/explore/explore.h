// Finds G-buffer layouts for one scene: packs each field alone to see what it costs, combines what is worth its bits,
// draws the best combinations, and keeps those that nothing beats in bytes and error. Time is measured afterwards, like
// that of any other layout.
#pragma once

#include "bench/explore/candidates.h"
#include "bench/measure/arm.h"

#include <functional>
#include <string>
#include <vector>

namespace lightsweep {

struct ExploredLayout {
    Layout layout;
    int bytes_per_px = 0;    ///< of all targets, depth included
    double predicted = 0.0;  ///< RMSE of display values against the control, from its fields' own errors
    double rmse = 0.0;       ///< the same, measured
    double flip_mean = 0.0;  ///< against the control
    bool on_front = false;   ///< no other is as small with as little flip_mean
};

/// What one option costs when it alone is packed.
struct OptionCost {
    std::string name;
    int bits = 0;
    double rmse = 0.0;
    bool kept = false;
};

struct Exploration {
    std::vector<OptionCost> options;
    size_t combinations = 0;              ///< that fit
    std::vector<ExploredLayout> layouts;  ///< drawn ones, smallest first, then least error
};

/// Says what is being done: a word, and how much of it.
using ExploreProgress = std::function<void(const std::string& what, double fraction)>;

/// `max_bytes`: per pixel, depth included. Throws InputError when nothing fits, or when a field that the scene needs
/// has no option.
Exploration explore(const Subject& subject, const Options& options, int max_bytes, FrameBuffers& buffers,
                    const DrawShapes& shapes, const ExploreProgress& progress);

}  // namespace lightsweep
