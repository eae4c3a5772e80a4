// The fuzzer: random scenes, cells and lights from a seed, extreme on purpose. Every path must agree with double
// precision or name the format that cannot hold what is asked; a scene on which one does not is shrunk and written out.
#pragma once

#include "bench/stress/workbench.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

struct FuzzOptions {
    double seconds = 60.0;              ///< no new scene begins after that
    uint64_t seed = 1;                  ///< of the first scene; the next ones' follow
    std::optional<uint64_t> only_seed;  ///< this scene alone, whatever the time
    std::filesystem::path out;  ///< folder of the scenes that fail, made where it is missing; empty: none is written
    bool shrink = true;
};

struct FuzzFinding {
    uint64_t seed = 0;
    std::string cell;     ///< CellParams::name(); its scene is scene_file, or `seed<N>` where none is written
    std::string verdict;  ///< "fail" or "limit"
    std::string reason;   ///< one line
    std::filesystem::path scene_file;  ///< of a failure: its "comment" says how to draw it; empty where none is written
};

struct FuzzReport {
    uint64_t scenes = 0;
    uint64_t cells = 0;                      ///< checked; those refused are not
    std::vector<FuzzFinding> findings;       ///< every failure, and the first limit of each kind
    std::map<std::string, uint64_t> limits;  ///< cells by what could not hold them: "layout=oct8", "hdr=rgba16f"
    double seconds = 0.0;                    ///< that it took
};

/// The same seeds find the same. `progress` is called after each scene. Throws InputError where `out` cannot be
/// written.
FuzzReport fuzz(Workbench& bench, const FuzzOptions& options,
                const std::function<void(const FuzzReport&)>& progress = {});

}  // namespace lightsweep
