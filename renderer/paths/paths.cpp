#include "renderer/paths/paths.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <algorithm>

namespace lightsweep {

extern const PathInfo path_forward;
extern const PathInfo path_forward_prepass;
extern const PathInfo path_forward_multipass;
extern const PathInfo path_forward_tiled;
extern const PathInfo path_forward_clustered;
extern const PathInfo path_deferred;
extern const PathInfo path_deferred_scissor;
extern const PathInfo path_deferred_volumes;
extern const PathInfo path_deferred_tiled;
extern const PathInfo path_deferred_clustered;
extern const PathInfo path_light_prepass;
extern const PathInfo path_visibility;

namespace {
constexpr const PathInfo* kPaths[] = {
    &path_forward,           &path_forward_prepass,    &path_forward_multipass, &path_forward_tiled,
    &path_forward_clustered, &path_deferred,           &path_deferred_scissor,  &path_deferred_volumes,
    &path_deferred_tiled,    &path_deferred_clustered, &path_light_prepass,     &path_visibility,
};
}  // namespace

std::span<const PathInfo* const> all_paths() { return kPaths; }

std::vector<std::string> path_keys() {
    std::vector<std::string> keys;
    for (const PathInfo* path : kPaths) keys.emplace_back(path->key);
    return keys;
}

const PathInfo& find_path(std::string_view key) {
    const auto found = std::find_if(std::begin(kPaths), std::end(kPaths), [&](const auto* p) { return p->key == key; });
    if (found == std::end(kPaths)) throw InputError(unknown_name("path", key, path_keys()));
    return **found;
}

}  // namespace lightsweep
