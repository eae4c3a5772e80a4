#include "bench/plan/sweep.h"

#include "renderer/base/error.h"
#include "renderer/base/json_reader.h"
#include "renderer/base/resources.h"

#include <fmt/format.h>

#include <unordered_set>

namespace lightsweep {
namespace {

constexpr size_t kMostCells = 100'000;  // of a block

AxisValues read_block(const JsonReader& json, const Catalog& catalog) {
    AxisValues block;
    for (const auto& [name, values] : json.members()) {
        const CellField* axis = nullptr;
        try {
            axis = &find_cell_field(name);
        } catch (const InputError& error) {
            json.fail(error.what());
        }
        block[name] = parse_axis_values(*axis, values, catalog);
    }
    return block;
}

Sweep read_sweep(const JsonReader& json, const std::string& key, const Catalog& catalog) {
    json.allow_keys({"summary", "blocks", "time_budget_s", "target_ci", "max_frame_s", "maps"});
    Sweep sweep;
    sweep.key = key;
    sweep.summary = json.at("summary").string();
    for (const auto& block : json.at("blocks").elements()) sweep.blocks.push_back(read_block(block, catalog));
    if (sweep.blocks.empty()) json.at("blocks").fail("no block; at least one is needed");
    if (json.has("time_budget_s")) sweep.time_budget_s = json.at("time_budget_s").number(1e-3, 1e9);
    if (json.has("target_ci")) sweep.target_ci = json.at("target_ci").number(1e-6, 1.0);
    if (json.has("max_frame_s")) sweep.max_frame_s = json.at("max_frame_s").number(1e-6, 1e9);
    sweep.maps = json.boolean_or("maps", false);
    return sweep;
}

std::vector<CellParams> block_cells(const AxisValues& block, const AxisValues& overrides, const Catalog& catalog) {
    std::vector<CellParams> cells(1);
    for (const auto& axis : cell_fields()) {
        const auto overridden = overrides.find(axis.name);
        const auto written = block.find(axis.name);
        const auto values = overridden != overrides.end() ? overridden->second
                            : written != block.end()      ? written->second
                                                          : default_axis_values(axis, catalog);
        if (cells.size() * values.size() > kMostCells) {
            throw InputError(axis.name, fmt::format("more than {} cells", kMostCells));
        }
        std::vector<CellParams> product;
        for (const auto& cell : cells) {
            for (const auto& value : values) {
                product.push_back(cell);
                if (!cell.path.empty() && !catalog.uses(cell.path, axis)) break;
                set_cell_field(product.back(), axis, value);
            }
        }
        cells = std::move(product);
    }
    return cells;
}

}  // namespace

Sweep load_sweep(const std::string& key_or_path, const Catalog& catalog) {
    const auto file = find_resource("sweep", key_or_path, "bench/sweeps", {".json"});
    return read_sweep(JsonReader::from_file(file), key_or_path, catalog);
}

Sweep parse_sweep(std::string_view text, const std::string& name, const Catalog& catalog) {
    return read_sweep(JsonReader::from_text(text, name), name, catalog);
}

std::vector<CellParams> sweep_cells(const Sweep& sweep, const AxisValues& overrides, const Catalog& catalog) {
    std::vector<CellParams> cells;
    std::unordered_set<std::string> seen;
    for (size_t i = 0; i < sweep.blocks.size(); ++i) {
        try {
            for (auto& cell : block_cells(sweep.blocks[i], overrides, catalog)) {
                if (seen.insert(cell.name()).second) cells.push_back(std::move(cell));
            }
        } catch (const InputError& error) {
            throw InputError(sweep.key + ":/blocks/" + std::to_string(i), error.what());
        }
    }
    return cells;
}

}  // namespace lightsweep
