// The table of effects after shading. To add one: write <name>.cpp beside this, its shader in shaders/post/, and put
// its row into post.cpp.
#pragma once

#include "renderer/pass/path.h"

#include <span>
#include <string_view>

namespace lightsweep {

struct PostInfo {
    std::string_view key;
    std::string_view summary;
    /// Appends its targets and passes; reads `path.hdr`, sets what it makes (`path.display` or `path.hdr`).
    void (*append)(Path& path) = nullptr;
};

std::span<const PostInfo* const> all_post_effects();

/// From the HDR image to display values: the last effect of every path.
extern const PostInfo post_tone_map;

}  // namespace lightsweep
