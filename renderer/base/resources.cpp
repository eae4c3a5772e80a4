#include "renderer/base/resources.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <algorithm>
#include <cstdlib>

namespace lightsweep {
namespace fs = std::filesystem;
namespace {

fs::path find_root() {
    std::vector<fs::path> places;
    if (const char* home = std::getenv("LIGHTSWEEP_HOME")) {
        places.emplace_back(home);
    } else {
        std::error_code ignored;
        const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
        if (!program.empty()) places.push_back(program.parent_path().parent_path() / "share/lightsweep");
        places.emplace_back(LIGHTSWEEP_SOURCE_DIR);
    }
    for (const auto& place : places) {
        if (fs::is_directory(place / "shaders")) return fs::weakly_canonical(place);
    }
    throw InputError(places.front().string(),
                     "holds no shaders/; set LIGHTSWEEP_HOME to the folder with lightsweep's shaders and scenes");
}

}  // namespace

const fs::path& resource_root() {
    static const fs::path root = find_root();
    return root;
}

fs::path resource(std::string_view relative) { return resource_root() / relative; }

std::vector<std::string> resource_keys(std::string_view folder, std::string_view extension) {
    std::vector<std::string> keys;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(resource(folder), missing)) {
        if (entry.path().extension() == extension) keys.push_back(entry.path().stem().string());
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

fs::path find_resource(std::string_view what, std::string_view key_or_path, std::string_view folder,
                       const std::vector<std::string>& extensions) {
    const fs::path as_path(key_or_path);
    std::error_code ignored;  // a name that no file can have is one that does not exist
    const bool is_path = key_or_path.find('/') != std::string_view::npos ||
                         std::find(extensions.begin(), extensions.end(), as_path.extension()) != extensions.end();
    if (is_path) {
        if (!fs::exists(as_path, ignored)) throw InputError(as_path.string(), "no such file");
        return as_path;
    }
    for (const auto& extension : extensions) {
        fs::path path = resource(folder) / (std::string(key_or_path) + extension);
        if (!key_or_path.empty() && fs::exists(path, ignored)) return path;
    }
    throw InputError(unknown_name(what, key_or_path, resource_keys(folder, extensions.front())) +
                     ", or the path of a file");
}

}  // namespace lightsweep
