#include "bench/measure/catalog.h"

#include "renderer/paths/paths.h"

#include <string>
#include <vector>

namespace lightsweep {

Catalog program_catalog() {
    std::vector<PathName> paths;
    for (const PathInfo* path : all_paths()) {
        paths.push_back({std::string(path->key), path->uses_layout, path->uses_light_lists});
    }
    return shipped_catalog(std::move(paths));
}

}  // namespace lightsweep
