#include "renderer/gbuffer/encoding.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/names.h"
#include "renderer/base/resources.h"
#include "renderer/gbuffer/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace lightsweep {
namespace {

constexpr const char* kFolder = "shaders/gbuffer/encodings";
const std::vector<std::string> kChannelNames = {"unsigned", "signed", "float", "bits"};
const std::vector<std::string> kNeedNames = {"grid", "pixel", "neighbours"};
const std::vector<std::string> kDomainNames = {"hemisphere"};

std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> result;
    for (std::string word; in >> word;) result.push_back(word);
    return result;
}

// The words of a header's line as indices into `known`.
std::vector<size_t> choices(const std::string& line, const char* what, const std::vector<std::string>& known,
                            const std::string& file) {
    std::vector<size_t> result;
    for (const auto& word : words(line)) {
        const auto found = std::find(known.begin(), known.end(), word);
        if (found == known.end()) throw InputError(file, unknown_name(what, word, known));
        result.push_back(static_cast<size_t>(found - known.begin()));
    }
    return result;
}

}  // namespace

std::string Encoding::channel_type() const {
    if (channels.front() == Channel::bits) return "uint";
    return channels.size() == 1 ? "float" : fmt::format("vec{}", channels.size());
}

std::vector<std::string> encoding_keys() { return resource_keys(kFolder, ".glsl"); }

Encoding load_encoding(const std::string& key) {
    const auto known = encoding_keys();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
        throw InputError(unknown_name("encoding", key, known));
    }
    const auto file = resource(kFolder) / (key + ".glsl");
    return parse_encoding(key, read_file(file), file.string());
}

Encoding parse_encoding(const std::string& key, std::string glsl, const std::string& file) {
    Encoding encoding;
    encoding.key = key;
    encoding.glsl = std::move(glsl);
    std::istringstream lines(encoding.glsl);
    for (std::string line; std::getline(lines, line) && line.starts_with("//");) {
        const size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        const std::string name = line.substr(3, colon - 3), value = line.substr(std::min(colon + 2, line.size()));
        if (name == "summary") encoding.summary = value;
        if (name == "source") encoding.source = value;
        if (name == "fields") {
            for (const size_t i : choices(value, "field", field_names(), file))
                encoding.fields.push_back(field_names()[i]);
        }
        if (name == "channels") {
            for (const size_t i : choices(value, "channel", kChannelNames, file))
                encoding.channels.push_back(static_cast<Channel>(i));
        }
        if (name == "needs") {
            bool* const needs[] = {&encoding.needs.grid, &encoding.needs.pixel, &encoding.needs.neighbours};
            for (const size_t i : choices(value, "need", kNeedNames, file)) *needs[i] = true;
        }
        if (name == "domain") encoding.hemisphere = !choices(value, "domain", kDomainNames, file).empty();
    }
    const bool bits = std::count(encoding.channels.begin(), encoding.channels.end(), Channel::bits) > 0;
    if (encoding.fields.empty() || encoding.channels.empty() || encoding.channels.size() > (bits ? 1 : 4)) {
        throw InputError(file,
                         "its first lines must say '// fields: ...' and '// channels: ...' (1 to 4 of "
                         "unsigned, signed, float; or bits alone)");
    }
    return encoding;
}

}  // namespace lightsweep
