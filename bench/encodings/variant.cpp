#include "bench/encodings/variant.h"

#include "renderer/base/json_reader.h"
#include "renderer/base/resources.h"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace lightsweep {
namespace {

const std::vector<std::string> kClips = {"zero_to_one", "minus_one_to_one"};

Variant read_depth(const JsonReader& json) {
    json.allow_keys({"field", "name", "format", "convention", "clip"});
    Variant variant;
    variant.layout.depth = static_cast<gl::Format>(json.at("format").choice("format", gl::format_names()));
    if (gl::info(variant.layout.depth).kind != gl::FormatKind::depth) json.at("format").fail("not a depth format");
    variant.layout.convention =
        static_cast<DepthConvention>(json.at("convention").choice("convention", depth_convention_names()));
    variant.clip = static_cast<gl::ClipDepth>(json.at("clip").choice("clip", kClips));
    return variant;
}

Variant read_colour(const JsonReader& json) {
    json.allow_keys({"field", "name", "format", "encoding", "in"});
    const auto format = static_cast<gl::Format>(json.at("format").choice("format", gl::format_names()));
    if (gl::info(format).kind == gl::FormatKind::depth)
        json.at("format").fail("a depth format cannot be a colour target");
    Variant variant;
    variant.layout.targets = {{.name = "probe", .format = format, .fields = {read_stored_field(json, format)}}};
    return variant;
}

}  // namespace

int Variant::bits() const {
    if (is_depth()) return gl::info(layout.depth).bits[0];
    int bits = 0;
    for (size_t i = 0; i < stored().slots.size(); ++i) {
        bits += channel_bits(layout.targets.front().format, stored(), i);
    }
    return bits;
}

std::vector<Variant> load_variants(const std::filesystem::path& file) {
    const auto json = JsonReader::from_file(file);
    json.allow_keys({"variants"});
    std::vector<Variant> variants;
    std::set<std::pair<std::string, std::string>> taken;
    for (const auto& item : json.at("variants").elements()) {
        const std::string field = item.at("field").string();
        Variant variant = field == "depth" ? read_depth(item) : read_colour(item);
        variant.field = field;
        variant.name = item.at("name").string();
        variant.layout.key = variant.name;
        if (!taken.emplace(variant.field, variant.name).second) {
            item.at("name").fail(fmt::format("field '{}' has a variant '{}' already", variant.field, variant.name));
        }
        variants.push_back(std::move(variant));
    }
    return variants;
}

std::vector<Variant> shipped_variants() { return load_variants(resource("bench/encodings/variants.json")); }

}  // namespace lightsweep
