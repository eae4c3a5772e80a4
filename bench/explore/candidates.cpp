#include "bench/explore/candidates.h"

#include "renderer/base/check.h"
#include "renderer/base/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>

namespace lightsweep {
namespace {

constexpr int kWordBits = 32;

FieldOption read_option(const JsonReader& json, Field field) {
    json.allow_keys({"encoding", "bits"});
    const auto encoding_json = json.at("encoding");
    FieldOption option{.field = field, .encoding = read_encoding(encoding_json, field), .bits = {}};
    const auto& channels = option.encoding.channels;
    for (const auto& bits : json.at("bits").elements()) option.bits.push_back(static_cast<int>(bits.integer(1, 32)));
    if (option.bits.size() != channels.size()) {
        json.at("bits").fail(fmt::format("encoding '{}' has {} channels", option.encoding.key, channels.size()));
    }
    if (option.total_bits() > kWordBits) json.at("bits").fail("a field is at most 32 bits wide");
    for (size_t i = 0; i < channels.size(); ++i) {
        if (channels[i] == Channel::real) {
            encoding_json.fail(
                fmt::format("encoding '{}' makes unbounded numbers, which bits cannot hold", option.encoding.key));
        }
        if (channels[i] == Channel::signed_unit && option.bits[i] < 2) {
            json.at("bits").fail("a signed channel needs at least 2 bits");
        }
    }
    return option;
}

DepthOption read_depth(const JsonReader& json) {
    json.allow_keys({"format", "convention"});
    DepthOption depth;
    depth.format = static_cast<gl::Format>(json.at("format").choice("format", gl::format_names()));
    if (gl::info(depth.format).kind != gl::FormatKind::depth) json.at("format").fail("not a depth format");
    depth.convention =
        static_cast<DepthConvention>(json.at("convention").choice("convention", depth_convention_names()));
    return depth;
}

// Where a field begins: its channels follow each other from there.
struct Place {
    size_t word = 0;
    int low_bit = 0;
};

// First fit, widest first: what lies in a word together wastes the least. As `fields`.
std::vector<Place> place(std::span<const FieldOption> fields, size_t& word_count) {
    std::vector<size_t> order(fields.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return fields[a].total_bits() > fields[b].total_bits(); });
    std::vector<Place> places(fields.size());
    std::vector<int> used_bits;
    for (const size_t f : order) {
        const int bits = fields[f].total_bits();
        const auto word =
            std::find_if(used_bits.begin(), used_bits.end(), [&](int used) { return used + bits <= kWordBits; });
        const auto index = static_cast<size_t>(word - used_bits.begin());
        if (word == used_bits.end()) used_bits.push_back(0);
        places[f] = {.word = index, .low_bit = used_bits[index]};
        used_bits[index] += bits;
    }
    word_count = used_bits.size();
    return places;
}

}  // namespace

int FieldOption::total_bits() const { return std::accumulate(bits.begin(), bits.end(), 0); }

std::string FieldOption::name() const {
    return fmt::format("{}={}_{}", info(field).name, encoding.key, fmt::join(bits, "_"));
}

std::string DepthOption::name() const {
    std::string text =
        fmt::format("depth={}_{}", gl::info(format).name, depth_convention_names()[static_cast<size_t>(convention)]);
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

Options load_options(const std::string& file) {
    const auto json = JsonReader::from_file(file);
    Options options;
    for (const auto& [key, list] : json.members()) {
        if (key == "comment" || key == "$schema") continue;
        if (key == "depth") {
            for (const auto& item : list.elements()) options.depths.push_back(read_depth(item));
            continue;
        }
        const auto& names = field_names();
        const auto name = std::find(names.begin(), names.end(), key);
        const auto field = static_cast<Field>(name - names.begin());
        if (name == names.end() || field == Field::position) {
            list.fail("not a field that is stored by bits, and not 'depth'");
        }
        for (const auto& item : list.elements()) options.fields[field].push_back(read_option(item, field));
        if (options.fields[field].empty()) list.fail("at least one option");
    }
    if (options.depths.empty()) json.fail("\"depth\" needs at least one option");
    return options;
}

Layout pack(const std::string& key, std::span<const FieldOption> fields, const DepthOption& depth) {
    size_t word_count = 0;
    const auto places = place(fields, word_count);
    Layout layout{.key = key, .summary = {}, .depth = depth.format, .convention = depth.convention, .targets = {}};
    for (const auto& field : fields) layout.summary += field.name() + " ";
    layout.summary += depth.name();

    // Words in runs of four, two and one: the widths that integer formats have.
    static constexpr std::array<std::pair<size_t, gl::Format>, 3> kRuns{
        {{4, gl::Format::RGBA32UI}, {2, gl::Format::RG32UI}, {1, gl::Format::R32UI}}};
    std::vector<std::pair<size_t, int>> where;  // target and component of each word
    while (where.size() < word_count) {
        const size_t left = word_count - where.size();
        const auto run = std::find_if(kRuns.begin(), kRuns.end(), [&](const auto& r) { return r.first <= left; });
        for (size_t i = 0; i < run->first; ++i) where.emplace_back(layout.targets.size(), static_cast<int>(i));
        layout.targets.push_back(
            {.name = fmt::format("words {}", layout.targets.size()), .format = run->second, .fields = {}});
    }
    for (size_t f = 0; f < fields.size(); ++f) {
        const auto [target, component] = where[places[f].word];
        StoredField stored{fields[f].field, fields[f].encoding, {}};
        int low_bit = places[f].low_bit;
        for (const int bits : fields[f].bits) {
            stored.slots.push_back({.component = component, .low_bit = low_bit, .bit_count = bits});
            low_bit += bits;
        }
        layout.targets[target].fields.push_back(std::move(stored));
    }
    return layout;
}

Layout with_option(const Layout& layout, const FieldOption& option) {
    CHECK(layout.stores(option.field));
    Layout result = layout;
    for (auto& target : result.targets) {
        std::erase_if(target.fields, [&](const StoredField& stored) { return stored.field == option.field; });
    }
    std::erase_if(result.targets, [](const LayoutTarget& target) { return target.fields.empty(); });
    Layout packed = pack(option.name(), std::span(&option, 1), {});
    result.key = option.name();
    result.summary = option.name();
    result.targets.push_back(std::move(packed.targets.front()));
    return result;
}

std::vector<CostedOption> undominated(std::vector<CostedOption> options) {
    std::stable_sort(options.begin(), options.end(), [](const CostedOption& a, const CostedOption& b) {
        return std::pair(a.bits, a.error) < std::pair(b.bits, b.error);
    });
    std::vector<CostedOption> front;
    for (const auto& option : options) {
        if (front.empty() || option.error < front.back().error) front.push_back(option);
    }
    return front;
}

}  // namespace lightsweep
