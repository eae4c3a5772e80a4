// An encoding: how one field becomes channels and comes back. Its GLSL file says what it is in its first comment lines:
//
//     // fields: normal
//     // channels: signed signed
//     // summary: octahedral map of the unit sphere
//     // source: ...
//
// and defines `encode_<name>` (field type -> channels) and `decode_<name>` (channels -> field type). What a function
// wants besides stands in `// needs:`, and `// domain: hemisphere` says that it carries only the normals that face the
// eye as the pixel sees it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lightsweep {

enum class Channel : uint8_t {
    unsigned_unit,  ///< "unsigned": [0, 1]
    signed_unit,    ///< "signed": [-1, 1]
    real,           ///< "float": any value; float formats only
    bits,           ///< "bits": a uint; integer formats only
};

/// What an encoding's functions take after their first argument, in this order. V is the channels' type.
struct EncodingNeeds {
    bool grid = false;        ///< "grid": encode gets V step, V offset: a channel holds exactly offset + k * step
    bool pixel = false;       ///< "pixel": both get the ivec2 pixel
    bool neighbours = false;  ///< "neighbours": decode gets V near[4], vec4 present: left, right, below, above
};

struct Encoding {
    std::string key;
    std::string summary;
    std::string source;
    std::vector<std::string> fields;  ///< which it can carry
    std::vector<Channel> channels;    ///< 1 to 4; all `bits` or none
    EncodingNeeds needs;
    bool hemisphere = false;  ///< a normal that looks away from the eye, as the pixel sees it, is clamped
    std::string glsl;         ///< the file's text

    /// float, vec2, vec3, vec4, or uint.
    std::string channel_type() const;
};

/// Reads shaders/gbuffer/encodings/<key>.glsl. Throws InputError for an unknown key or a malformed header.
Encoding load_encoding(const std::string& key);
/// From the text of its file, whose name is for messages. Throws InputError for a malformed header.
Encoding parse_encoding(const std::string& key, std::string glsl, const std::string& file);
std::vector<std::string> encoding_keys();

}  // namespace lightsweep
