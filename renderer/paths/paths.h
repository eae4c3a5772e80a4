// The table of shading paths. To add one: write <name>.cpp beside this, and put its row into paths.cpp.
#pragma once

#include "renderer/pass/path.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

std::span<const PathInfo* const> all_paths();
std::vector<std::string> path_keys();

/// Throws InputError naming the nearest key.
const PathInfo& find_path(std::string_view key);

}  // namespace lightsweep
