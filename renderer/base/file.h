// Files as a whole: read, and replaced atomically.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lightsweep {

/// The whole file as bytes. Throws InputError naming the file.
std::string read_file(const std::filesystem::path& path);

/// Writes beside `path`, flushes to disk, renames over it: a reader sees the old file or the new one, never a part.
/// Throws InputError naming the file.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Where what takes long to compute is kept between runs: $LIGHTSWEEP_CACHE, else $XDG_CACHE_HOME/lightsweep, else
/// ~/.cache/lightsweep. Empty when the environment names none. May not exist yet.
std::filesystem::path cache_folder();

}  // namespace lightsweep
