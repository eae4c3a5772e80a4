// A parsed glTF file, and checked access to its data: no index or range from the file is trusted.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

struct GltfFile {
    std::string path;
    tinygltf::Model model;  ///< images hold their encoded bytes, unless they lie in a buffer view

    /// Throws InputError `path:pointer: what`.
    [[noreturn]] void fail(const std::string& pointer, const std::string& what) const;

    /// Fails unless `index` is one of `count` elements of the array `name`; `pointer` is where it is written.
    void check_index(int index, size_t count, std::string_view name, const std::string& pointer) const;
};

/// Reads the file and the buffers and images beside it. Throws InputError, also for required extensions that are not
/// supported; the others are named in `warnings`.
GltfFile open_gltf(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// The bytes of a buffer view.
std::span<const unsigned char> view_bytes(const GltfFile& file, int view, const std::string& pointer);

/// All elements of an accessor of `components` numbers each, as finite floats; normalised integers are scaled.
std::vector<float> read_floats(const GltfFile& file, int accessor, int components, const std::string& pointer);

/// All elements of an accessor of indices, each below `vertex_count`.
std::vector<uint32_t> read_indices(const GltfFile& file, int accessor, size_t vertex_count, const std::string& pointer);

/// Adds the warning `file name: what` unless it is there already.
void warn_once(std::vector<std::string>& warnings, const GltfFile& file, const std::string& what);

}  // namespace lightsweep
