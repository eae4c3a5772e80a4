#include "renderer/gbuffer/layout.h"

#include "renderer/base/names.h"
#include "renderer/base/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>

namespace lightsweep {
namespace {

constexpr const char* kFolder = "shaders/gbuffer/layouts";
constexpr int kMaxTargets = 7;  // every GL 4.5 device has 8 colour targets; forward and deferred leave one for output

// "rgb" -> one whole component per letter; "r[0-15] r[16-31]" -> runs of bits, inclusive.
std::vector<Slot> parse_slots(const JsonReader& json) {
    static const std::regex kBits(R"(([rgba])\[(\d{1,2})-(\d{1,2})\])");
    const std::string components = "rgba";
    std::vector<Slot> slots;
    const std::string text = json.string();
    if (text.find('[') == std::string::npos) {
        for (const char c : text) {
            const size_t component = components.find(c);
            if (component == std::string::npos) json.fail("components are letters of 'rgba', such as \"rg\"");
            slots.push_back({.component = static_cast<int>(component)});
        }
        return slots;
    }
    for (const auto& word : split(text, ' ')) {
        std::smatch match;
        if (!std::regex_match(word, match, kBits)) {
            json.fail(fmt::format("'{}' is not a run of bits such as \"r[0-15]\"", word));
        }
        const int low = std::stoi(match[2]), high = std::stoi(match[3]);
        if (low > high || high > 31) json.fail(fmt::format("'{}': bits run upwards, from 0 to 31", word));
        slots.push_back({.component = static_cast<int>(components.find(match[1].str()[0])),
                         .low_bit = low,
                         .bit_count = high - low + 1});
    }
    return slots;
}

void check_slots(const JsonReader& json, gl::Format target_format, const StoredField& stored) {
    const auto& format = gl::info(target_format);
    const auto& channels = stored.encoding.channels;
    if (stored.slots.size() != channels.size()) {
        json.fail(fmt::format("encoding '{}' has {} channels, but \"in\" names {} places", stored.encoding.key,
                              channels.size(), stored.slots.size()));
    }
    for (size_t i = 0; i < channels.size(); ++i) {
        const Slot& slot = stored.slots[i];
        if (slot.component >= format.components) {
            json.fail(fmt::format("format {} has only {} components", format.name, format.components));
        }
        const bool integer = format.kind == gl::FormatKind::uint;
        if (integer != (slot.bit_count > 0)) {
            json.fail(integer ? "an integer format is packed by bits, such as \"r[0-15]\""
                              : fmt::format("format {} has whole components, such as \"rg\"", format.name));
        }
        if (channels[i] == Channel::bits && !integer) {
            json.fail(fmt::format("encoding '{}' makes bits; it needs an integer format", stored.encoding.key));
        }
        if (channels[i] == Channel::real && format.kind != gl::FormatKind::floating) {
            json.fail(fmt::format("encoding '{}' makes unbounded numbers; it needs a float format, not {}",
                                  stored.encoding.key, format.name));
        }
        if (channels[i] == Channel::signed_unit && format.name == "R11G11B10F") {
            json.fail(fmt::format("encoding '{}' makes signed numbers; R11G11B10F has no sign", stored.encoding.key));
        }
        if (integer && channels[i] == Channel::signed_unit && slot.bit_count < 2) {
            json.fail("a signed channel needs at least 2 bits");
        }
        if (stored.encoding.needs.grid && !channel_grid(target_format, stored, i)) {
            json.fail(fmt::format("encoding '{}' searches among evenly spaced values; format {} has none",
                                  stored.encoding.key, format.name));
        }
    }
}

LayoutTarget read_target(const JsonReader& json, std::map<Field, std::string>& where_stored) {
    json.allow_keys({"name", "format", "fields"});
    LayoutTarget target{.name = json.at("name").string(), .format = {}, .fields = {}};
    target.format = static_cast<gl::Format>(json.at("format").choice("format", gl::format_names()));
    if (gl::info(target.format).kind == gl::FormatKind::depth)
        json.at("format").fail("a depth format cannot be a colour target");
    uint32_t used[4] = {};  // bits taken of each component
    for (const auto& item : json.at("fields").elements()) {
        item.allow_keys({"field", "encoding", "in"});
        StoredField stored = read_stored_field(item, target.format);
        for (const Slot& slot : stored.slots) {
            const uint32_t mask =
                slot.bit_count == 0 || slot.bit_count == 32 ? ~0U : ((1U << slot.bit_count) - 1U) << slot.low_bit;
            if ((used[slot.component] & mask) != 0) item.at("in").fail("this place is taken by another field");
            used[slot.component] |= mask;
        }
        if (const auto [first, is_new] = where_stored.try_emplace(stored.field, item.where()); !is_new) {
            item.fail(fmt::format("field '{}' is stored already, at {}", info(stored.field).name, first->second));
        }
        target.fields.push_back(std::move(stored));
    }
    return target;
}

}  // namespace

const std::vector<std::string>& depth_convention_names() {
    static const std::vector<std::string> names = {"standard", "reversed"};
    return names;
}

Encoding read_encoding(const JsonReader& json, Field field) {
    json.choice("encoding", encoding_keys());
    Encoding encoding = load_encoding(json.string());
    const auto& carries = encoding.fields;
    if (std::find(carries.begin(), carries.end(), info(field).name) == carries.end()) {
        json.fail(fmt::format("encoding '{}' cannot carry the field '{}'", encoding.key, info(field).name));
    }
    return encoding;
}

StoredField read_stored_field(const JsonReader& json, gl::Format format) {
    const auto field = static_cast<Field>(json.at("field").choice("field", field_names()));
    StoredField stored{field, read_encoding(json.at("encoding"), field), parse_slots(json.at("in"))};
    check_slots(json.at("in"), format, stored);
    return stored;
}

int channel_bits(gl::Format format, const StoredField& stored, size_t i) {
    const Slot& slot = stored.slots[i];
    return slot.bit_count > 0 ? slot.bit_count : gl::info(format).bits[slot.component];
}

std::optional<ChannelGrid> channel_grid(gl::Format format, const StoredField& stored, size_t i) {
    const Channel channel = stored.encoding.channels[i];
    const auto kind = gl::info(format).kind;
    if (kind == gl::FormatKind::floating || format == gl::Format::SRGB8_A8) return std::nullopt;
    if (channel == Channel::bits || channel == Channel::real) return std::nullopt;
    const int bits = channel_bits(format, stored, i);
    const double steps = std::ldexp(1.0, bits) - 1.0, steps_of_half = std::ldexp(1.0, bits - 1) - 1.0;
    // An snorm component spends half of its steps on the negative side whether they are wanted or not.
    if (kind == gl::FormatKind::snorm || (kind == gl::FormatKind::uint && channel == Channel::signed_unit)) {
        return ChannelGrid{.step = 1.0 / steps_of_half, .offset = 0.0};
    }
    if (channel == Channel::unsigned_unit) return ChannelGrid{.step = 1.0 / steps, .offset = 0.0};
    // c / 2 + 1 / 2 in unorm: an even number of values, none of them zero.
    return ChannelGrid{.step = 2.0 / steps, .offset = 1.0 / steps};
}

bool Layout::stores(Field field) const {
    return std::any_of(targets.begin(), targets.end(), [&](const LayoutTarget& target) {
        return std::any_of(target.fields.begin(), target.fields.end(),
                           [&](const StoredField& stored) { return stored.field == field; });
    });
}

int Layout::bytes_per_pixel() const {
    int bytes = gl::info(depth).bytes;
    for (const auto& target : targets) bytes += gl::info(target.format).bytes;
    return bytes;
}

std::vector<std::string> layout_keys() { return resource_keys(kFolder, ".json"); }

Layout load_layout(const std::string& key_or_path) {
    const auto file = find_resource("layout", key_or_path, kFolder, {".json"});
    const auto json = JsonReader::from_file(file);
    json.allow_keys({"summary", "depth", "targets"});
    Layout layout;
    layout.key = file.stem().string();
    layout.summary = json.string_or("summary", "");
    if (const auto depth = json.find("depth")) {
        depth->allow_keys({"format", "convention"});
        layout.depth = static_cast<gl::Format>(depth->at("format").choice("format", gl::format_names()));
        if (gl::info(layout.depth).kind != gl::FormatKind::depth) {
            depth->at("format").fail("not a depth format; known: D16, D24, D32F");
        }
        if (const auto convention = depth->find("convention")) {
            layout.convention =
                static_cast<DepthConvention>(convention->choice("convention", depth_convention_names()));
        }
    }
    std::map<Field, std::string> where_stored;
    const auto targets = json.at("targets").elements();
    if (targets.size() > kMaxTargets) json.at("targets").fail(fmt::format("at most {} targets", kMaxTargets));
    for (const auto& target : targets) layout.targets.push_back(read_target(target, where_stored));
    return layout;
}

double position_error(const Layout& layout) {
    for (const auto& target : layout.targets) {
        for (const auto& stored : target.fields) {
            if (stored.field != Field::position) continue;
            // Half floats have 11 significant bits, R11G11B10F has 6; some drivers truncate.
            const int bits = gl::info(target.format).bits[0];
            return bits == 32 ? 0.0 : bits == 16 ? 0x1p-10 : 0x1p-5;
        }
    }
    return 0.0;
}

double depth_step(gl::Format depth, DepthConvention convention) {
    const int bits = gl::info(depth).bits[0];
    const bool relative = bits == 32 && convention == DepthConvention::reversed;
    return relative ? 0.0 : std::ldexp(1.0, -std::min(bits, 24)) + 0x1p-24;  // floats just below 1 step by 2^-24
}

Layout drop_unneeded(const Layout& layout, const SceneNeeds& needs) {
    std::vector<Field> needed;
    for (size_t i = 0; i < field_names().size(); ++i) {
        const auto field = static_cast<Field>(i);
        if (!info(field).needed(needs)) continue;
        if (field != Field::position && !layout.stores(field)) {
            throw InputError(
                fmt::format("layout '{}' does not store '{}', which this scene needs", layout.key, info(field).name));
        }
        needed.push_back(field);
    }
    return keep_fields(layout, needed);
}

Layout keep_fields(const Layout& layout, std::span<const Field> fields) {
    Layout result = layout;
    for (auto& target : result.targets) {
        std::erase_if(target.fields, [&](const StoredField& stored) {
            return std::find(fields.begin(), fields.end(), stored.field) == fields.end();
        });
    }
    std::erase_if(result.targets, [](const LayoutTarget& target) { return target.fields.empty(); });
    return result;
}

}  // namespace lightsweep
