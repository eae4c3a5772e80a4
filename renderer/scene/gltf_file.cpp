#include "renderer/scene/gltf_file.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace lightsweep {
namespace {

constexpr std::string_view kSupportedExtension = "KHR_mesh_quantization";
constexpr uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"

// The parser's messages may be many lines, and may hold a whole data URI.
std::string one_line(std::string text) {
    text = text.substr(0, text.find('\n'));
    return text.size() > 200 ? text.substr(0, 200) + "..." : text;
}

// Decoding waits until it is known which images are used, and then runs on all cores. Buffer views are read later too,
// with their ranges checked: the pointer given here is not.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

bool read_whole_file(std::vector<unsigned char>* out, std::string*, const std::string& path, void*) {
    const std::string bytes = read_file(path);
    out->assign(bytes.begin(), bytes.end());
    return true;
}

// tinygltf looks for a missing file in the working directory next. Saying that it exists makes reading it fail instead.
bool claim_existence(const std::string&, void*) { return true; }

// glTF 2.0, 4.4: a header of 12 bytes, then chunks, each of a length, a type and that many bytes. tinygltf leaves a
// chunk's own 8 bytes out when it checks where the last one ends, and so reads past it.
void check_chunks(const GltfFile& file, std::string_view bytes) {
    for (size_t at = 12; at + 8 <= bytes.size();) {
        uint32_t length = 0, type = 0;
        std::memcpy(&length, bytes.data() + at, sizeof length);
        std::memcpy(&type, bytes.data() + at + 4, sizeof type);
        at += 8;
        if (length > bytes.size() - at) {
            throw InputError(file.path, fmt::format("is cut off: a chunk of {} bytes begins at byte {} of {}", length,
                                                    at, bytes.size()));
        }
        if (type == kJsonChunk) check_nesting(bytes.substr(at, length), file.path);
        at += length;
    }
}

void check_extensions(const GltfFile& file, std::vector<std::string>& warnings) {
    for (const auto& name : file.model.extensionsRequired) {
        if (name == kSupportedExtension) continue;
        file.fail("/extensionsRequired", fmt::format("the extension '{}' is required, but not supported; supported: {}",
                                                     name, kSupportedExtension));
    }
    for (const auto& name : file.model.extensionsUsed) {
        if (name != kSupportedExtension) warn_once(warnings, file, fmt::format("the extension {} is ignored", name));
    }
}

// The elements of an accessor, known to lie within their buffer.
struct Elements {
    const unsigned char* data = nullptr;
    size_t count = 0;
    size_t stride = 0;
    int component_type = 0;
    bool normalized = false;
};

size_t component_size(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

Elements find_elements(const GltfFile& file, int index, int components, const std::string& pointer) {
    const auto& model = file.model;
    file.check_index(index, model.accessors.size(), "accessors", pointer);
    const auto& accessor = model.accessors[static_cast<size_t>(index)];
    const std::string here = fmt::format("/accessors/{}", index);
    if (accessor.sparse.isSparse) file.fail(here + "/sparse", "sparse accessors are not supported");
    const size_t size = component_size(accessor.componentType) * static_cast<size_t>(components);
    if (size == 0) file.fail(here + "/componentType", fmt::format("{} is not allowed", accessor.componentType));
    if (tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)) != components) {
        file.fail(here + "/type", fmt::format("{} numbers per element were expected by {}", components, pointer));
    }
    if (accessor.bufferView < 0) file.fail(here, "the key 'bufferView' is missing");
    const auto bytes = view_bytes(file, accessor.bufferView, here + "/bufferView");
    const auto& view = model.bufferViews[static_cast<size_t>(accessor.bufferView)];
    const size_t stride = view.byteStride == 0 ? size : view.byteStride;
    if (stride < size)
        file.fail(fmt::format("/bufferViews/{}/byteStride", accessor.bufferView), "is below one element");
    if (accessor.count > 0) {
        const bool fits = accessor.byteOffset <= bytes.size() && size <= bytes.size() - accessor.byteOffset &&
                          accessor.count - 1 <= (bytes.size() - accessor.byteOffset - size) / stride;
        if (!fits) {
            file.fail(here, fmt::format("{} elements at byte {} reach past the end of the buffer view, which has {} "
                                        "bytes",
                                        accessor.count, accessor.byteOffset, bytes.size()));
        }
    }
    return {bytes.data() + (accessor.count > 0 ? accessor.byteOffset : 0), accessor.count, stride,
            accessor.componentType, accessor.normalized};
}

// Data may be unaligned in a malformed file.
template <typename T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// glTF 2.0, 3.6.2.2: c / max, and for signed types no less than -1.
template <typename T>
float to_float(const unsigned char* bytes, bool normalized) {
    const auto value = static_cast<float>(load<T>(bytes));
    if constexpr (std::is_integral_v<T>) {
        if (normalized) return std::max(-1.0F, value / static_cast<float>(std::numeric_limits<T>::max()));
    }
    return value;
}

float component(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return to_float<int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return to_float<uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return to_float<int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return to_float<uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return to_float<uint32_t>(bytes, normalized);
        default:
            return to_float<float>(bytes, normalized);
    }
}

}  // namespace

void GltfFile::fail(const std::string& pointer, const std::string& what) const {
    throw InputError(path + ":" + pointer, what);
}

void GltfFile::check_index(int index, size_t count, std::string_view name, const std::string& pointer) const {
    if (index >= 0 && static_cast<size_t>(index) < count) return;
    fail(pointer, fmt::format("{} is not an index of '{}', which has {} elements", index, name, count));
}

GltfFile open_gltf(const std::filesystem::path& path, std::vector<std::string>& warnings) {
    GltfFile file{.path = path.string(), .model = {}};
    const std::string bytes = read_file(path);
    const bool binary = bytes.starts_with("glTF");
    const auto length = static_cast<unsigned int>(bytes.size());
    if (bytes.size() >= UINT32_MAX) throw InputError(file.path, "is larger than 4 GiB");
    if (binary) {
        check_chunks(file, bytes);
    } else {
        check_nesting(bytes, file.path);
    }

    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keep_encoded, nullptr);
    reader.SetFsCallbacks(
        {claim_existence, tinygltf::ExpandFilePath, read_whole_file, tinygltf::WriteWholeFile, nullptr});
    const std::string folder = path.parent_path().string();
    std::string error;
    std::string ignored;
    bool ok = false;
    try {
        ok = binary ? reader.LoadBinaryFromMemory(&file.model, &error, &ignored,
                                                  reinterpret_cast<const unsigned char*>(bytes.data()), length, folder)
                    : reader.LoadASCIIFromString(&file.model, &error, &ignored, bytes.data(), length, folder);
    } catch (const std::exception& exception) {
        throw InputError(file.path, one_line(exception.what()));
    }
    if (!ok || !error.empty()) throw InputError(file.path, error.empty() ? "is not glTF 2.0" : one_line(error));
    if (!file.model.asset.version.starts_with("2.")) {
        file.fail("/asset/version", fmt::format("glTF 2.x was expected, not '{}'", file.model.asset.version));
    }
    check_extensions(file, warnings);
    return file;
}

std::span<const unsigned char> view_bytes(const GltfFile& file, int index, const std::string& pointer) {
    file.check_index(index, file.model.bufferViews.size(), "bufferViews", pointer);
    const auto& view = file.model.bufferViews[static_cast<size_t>(index)];
    const std::string here = fmt::format("/bufferViews/{}", index);
    file.check_index(view.buffer, file.model.buffers.size(), "buffers", here + "/buffer");
    const auto& data = file.model.buffers[static_cast<size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        file.fail(here, fmt::format("{} bytes at byte {} reach past the end of the buffer, which has {} bytes",
                                    view.byteLength, view.byteOffset, data.size()));
    }
    return {data.data() + view.byteOffset, view.byteLength};
}

std::vector<float> read_floats(const GltfFile& file, int accessor, int components, const std::string& pointer) {
    const Elements elements = find_elements(file, accessor, components, pointer);
    const size_t size = component_size(elements.component_type);
    std::vector<float> values;
    values.reserve(elements.count * static_cast<size_t>(components));
    for (size_t i = 0; i < elements.count; ++i) {
        for (size_t k = 0; k < static_cast<size_t>(components); ++k) {
            const float value =
                component(elements.data + i * elements.stride + k * size, elements.component_type, elements.normalized);
            if (!std::isfinite(value)) {
                file.fail(fmt::format("/accessors/{}", accessor), fmt::format("element {} is not finite", i));
            }
            values.push_back(value);
        }
    }
    return values;
}

std::vector<uint32_t> read_indices(const GltfFile& file, int accessor, size_t vertex_count,
                                   const std::string& pointer) {
    const Elements elements = find_elements(file, accessor, 1, pointer);
    std::vector<uint32_t> indices;
    indices.reserve(elements.count);
    for (size_t i = 0; i < elements.count; ++i) {
        const unsigned char* at = elements.data + i * elements.stride;
        uint32_t index = 0;
        switch (elements.component_type) {
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                index = load<uint8_t>(at);
                break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                index = load<uint16_t>(at);
                break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                index = load<uint32_t>(at);
                break;
            default:
                file.fail(fmt::format("/accessors/{}/componentType", accessor), "indices are unsigned integers");
        }
        if (index >= vertex_count) {
            file.fail(fmt::format("/accessors/{}", accessor),
                      fmt::format("index {} (element {}) is past the last of {} vertices", index, i, vertex_count));
        }
        indices.push_back(index);
    }
    return indices;
}

void warn_once(std::vector<std::string>& warnings, const GltfFile& file, const std::string& what) {
    std::string line = std::filesystem::path(file.path).filename().string() + ": " + what;
    if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) warnings.push_back(std::move(line));
}

}  // namespace lightsweep
