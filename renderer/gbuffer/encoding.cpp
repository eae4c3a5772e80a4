#include "renderer/gbuffer/encoding.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/names.h"
#include "renderer/base/resources.h"
#include "renderer/gbuffer/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace lightsweep {
namespace {

constexpr const char* kFolder = "shaders/gbuffer/encodings";
const std::vector<std::string> kChannelNames = {"unsigned", "signed", "float", "bits"};

std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> result;
    for (std::string word; in >> word;) result.push_back(word);
    return result;
}

}  // namespace

std::string Encoding::channel_type() const {
    if (channels.front() == Channel::bits) return "uint";
    return channels.size() == 1 ? "float" : fmt::format("vec{}", channels.size());
}

std::vector<std::string> encoding_keys() { return resource_keys(kFolder, ".glsl"); }

Encoding load_encoding(const std::string& key) {
    const auto file = resource(kFolder) / (key + ".glsl");
    const auto known = encoding_keys();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
        throw InputError(unknown_name("encoding", key, known));
    }
    Encoding encoding{.key = key, .summary = {}, .source = {}, .fields = {}, .channels = {}, .glsl = read_file(file)};
    std::istringstream lines(encoding.glsl);
    for (std::string line; std::getline(lines, line) && line.starts_with("//");) {
        const size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        const std::string name = line.substr(3, colon - 3), value = line.substr(std::min(colon + 2, line.size()));
        if (name == "fields") encoding.fields = words(value);
        if (name == "summary") encoding.summary = value;
        if (name == "source") encoding.source = value;
        if (name == "channels") {
            for (const auto& word : words(value)) {
                const auto found = std::find(kChannelNames.begin(), kChannelNames.end(), word);
                if (found == kChannelNames.end())
                    throw InputError(file.string(), unknown_name("channel", word, kChannelNames));
                encoding.channels.push_back(static_cast<Channel>(found - kChannelNames.begin()));
            }
        }
    }
    for (const auto& field : encoding.fields) {
        const auto& names = field_names();
        if (std::find(names.begin(), names.end(), field) == names.end()) {
            throw InputError(file.string(), unknown_name("field", field, names));
        }
    }
    const bool bits = std::count(encoding.channels.begin(), encoding.channels.end(), Channel::bits) > 0;
    if (encoding.fields.empty() || encoding.channels.empty() || encoding.channels.size() > (bits ? 1 : 4)) {
        throw InputError(file.string(),
                         "its first lines must say '// fields: ...' and '// channels: ...' (1 to 4 of "
                         "unsigned, signed, float; or bits alone)");
    }
    return encoding;
}

}  // namespace lightsweep
