// An encoding: how one field becomes channels and comes back. Its GLSL file says what it is in its first comment lines:
//
//     // fields: normal
//     // channels: signed signed
//     // summary: octahedral map of the unit sphere
//     // source: ...
//
// and defines `encode_<name>` (field type -> channels) and `decode_<name>` (channels -> field type).
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

struct Encoding {
    std::string key;
    std::string summary;
    std::string source;
    std::vector<std::string> fields;  ///< which it can carry
    std::vector<Channel> channels;    ///< 1 to 4; all `bits` or none
    std::string glsl;                 ///< the file's text

    /// float, vec2, vec3, vec4, or uint.
    std::string channel_type() const;
};

/// Reads shaders/gbuffer/encodings/<key>.glsl. Throws InputError for an unknown key or a malformed header.
Encoding load_encoding(const std::string& key);
std::vector<std::string> encoding_keys();

}  // namespace lightsweep
