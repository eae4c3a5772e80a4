// A sweep file: blocks of axis values. The cells of a sweep are the union of its blocks' products.
#pragma once

#include "bench/plan/axes.h"

#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

struct Sweep {
    std::string key;  ///< the file's key, or its path
    std::string summary;
    std::vector<AxisValues> blocks;
    std::optional<double> time_budget_s;  ///< for the whole run; nothing: none
    std::optional<double> target_ci;      ///< half width of a median's interval, as a fraction of it
    std::optional<double> max_frame_s;    ///< arms whose frame takes longer are not sampled; nothing: all are
    bool maps = false;                    ///< write each cell's FLIP map
};

/// Reads a shipped sweep by its key (bench/sweeps/<key>.json) or a user's by its path. Throws InputError.
Sweep load_sweep(const std::string& key_or_path, const Catalog& catalog);
/// The same from text; `name` stands for the file in messages.
Sweep parse_sweep(std::string_view text, const std::string& name, const Catalog& catalog);

/// Every cell of every block once, in the order of the blocks; inside a block the last axis (skip) varies fastest. A
/// value in `overrides` replaces that axis in every block. Paths without a layout, or without light lists, give one
/// cell for the whole of that axis. Throws InputError when a block has no scene.
std::vector<CellParams> sweep_cells(const Sweep& sweep, const AxisValues& overrides, const Catalog& catalog);

}  // namespace lightsweep
