// The axes of a sweep, as users write them on the command line and in sweep files, and the values they stand for.
// An axis is a field of a cell (cell.h) with lists, `*` and ranges on top.
#pragma once

#include "bench/plan/cell.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <vector>

namespace lightsweep {

class JsonReader;

/// A shading path as planning sees it.
struct PathName {
    std::string key;
    bool uses_layout = false;
    bool uses_light_lists = false;
};

/// The names that `*` stands for and that a value is checked against.
struct Catalog {
    std::vector<PathName> paths;
    std::vector<std::string> layouts;
    std::vector<std::string> scenes;

    /// False for an axis that the path ignores: layout, or light_lists, of a path without. `path` must be in the
    /// catalog, or auto.
    bool uses(const std::string& path, const CellField& axis) const;
};

/// The given paths with the layouts and scenes in the program's own folders.
Catalog shipped_catalog(std::vector<PathName> paths);

/// Axis name -> its values, each one allowed and existing, in the order written.
using AxisValues = std::map<std::string, std::vector<std::string>>;

/// The values of one axis from `1,16,256`, `pow2:0:12`, `*`, ... Of skip, `*` is all and none, `all-*` the sets that
/// lack one skip, and `none+*` those that have one. Throws InputError `axis=value: what; allowed`.
std::vector<std::string> parse_axis_values(const CellField& axis, const std::string& text, const Catalog& catalog);
/// The same from a sweep file: a string as above, a number, or a list of numbers and strings without commas.
std::vector<std::string> parse_axis_values(const CellField& axis, const JsonReader& json, const Catalog& catalog);

/// The arguments of `-a`: `axis=values`, each axis at most once.
AxisValues parse_axis_arguments(const std::vector<std::string>& arguments, const Catalog& catalog);

/// What an axis is when a sweep does not name it.
std::vector<std::string> default_axis_values(const CellField& axis, const Catalog& catalog);

}  // namespace lightsweep
