// Where the program's own data is: shaders, scenes, sweeps, the schema. In the source tree, or installed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

/// The folder that holds shaders/, scenes/ and bench/sweeps/: $LIGHTSWEEP_HOME, else ../share/lightsweep beside the
/// program, else the source tree it was built from. Throws InputError when none of them holds shaders/.
const std::filesystem::path& resource_root();

/// resource_root() / relative; not checked for existence.
std::filesystem::path resource(std::string_view relative);

/// The keys (file names without `extension`) in a folder of the program's own data, sorted.
/// `resource_keys("shaders/gbuffer/layouts", ".json")` -> {"float16", "float32", ...}
std::vector<std::string> resource_keys(std::string_view folder, std::string_view extension);

/// What a user may write for a scene, layout or sweep: one of the keys of `folder`, or the path of a file of their own
/// (anything that contains '/' or ends in one of `extensions`). Throws InputError naming the nearest key.
/// `what` is the word for the message ("scene").
std::filesystem::path find_resource(std::string_view what, std::string_view key_or_path, std::string_view folder,
                                    const std::vector<std::string>& extensions);

}  // namespace lightsweep
