#include "bench/stress/arm.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/frame/light_list_service.h"
#include "renderer/gbuffer/layout.h"
#include "renderer/paths/paths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace lightsweep {
namespace {

// The axes that a cell of a sweep has too, spelled and checked as there.
bool is_cell_axis(std::string_view name) {
    return name == kPathAxis || name == kLayoutAxis || name == kHdrAxis || name == kGuardsAxis || name == kSumsAxis;
}

Catalog stress_catalog() {
    Catalog catalog{.paths = {}, .layouts = layout_keys(), .scenes = {}};
    for (const PathInfo* path : all_paths()) {
        catalog.paths.push_back({std::string(path->key), path->uses_layout, path->uses_light_lists});
    }
    return catalog;
}

std::vector<std::string> known_values(const std::string& axis, const std::vector<ArmBlock>& blocks) {
    if (axis == kDepthAxis) return kStressDepths;
    std::vector<std::string> values;
    for (const ArmBlock& block : blocks) {
        for (const StressAxis& own : block) {
            if (own.name == axis) values.insert(values.end(), own.values.begin(), own.values.end());
        }
    }
    return values;
}

std::vector<std::string> parse_values(const std::string& axis, const std::string& text,
                                      const std::vector<ArmBlock>& blocks) {
    if (is_cell_axis(axis)) return parse_axis_values(find_cell_field(axis), text, stress_catalog());
    const auto known = known_values(axis, blocks);
    if (text == "*") return known;
    auto values = split(text, ',');
    for (const std::string& value : values) {
        if (std::ranges::find(known, value) == known.end()) {
            throw InputError(axis + "=" + value, unknown_name("value", value, known));
        }
    }
    return values;
}

// The value of an axis in each combination: digits of `number` in the blocks' mixed base.
StressArm arm_of(const ArmBlock& block, size_t number) {
    StressArm::Choices choices;
    bool layout_is_used = true, lists_are_used = true;
    size_t places = 1;
    for (const StressAxis& axis : block) places *= axis.values.size();
    for (const StressAxis& axis : block) {
        places /= axis.values.size();
        const std::string& value = axis.values[number / places % axis.values.size()];
        if (axis.name == kPathAxis) {
            layout_is_used = find_path(value).uses_layout;
            lists_are_used = find_path(value).uses_light_lists;
        }
        if (axis.name == kLayoutAxis && !layout_is_used) continue;
        if (axis.name == kListsAxis && !lists_are_used) continue;
        choices.emplace_back(axis.name, value);
    }
    return StressArm(std::move(choices));
}

}  // namespace

const std::vector<std::string> kStressDepths{"D32F-reversed", "D32F-standard", "D24-reversed",
                                             "D24-standard",  "D16-reversed",  "D16-standard"};

std::string StressArm::name() const {
    std::vector<std::string> words;
    for (const auto& [axis, value] : choices_) words.push_back(axis + "=" + value);
    return fmt::format("{}", fmt::join(words, " "));
}

std::string StressArm::get(std::string_view axis, std::string_view otherwise) const {
    const auto found = std::ranges::find(choices_, axis, &std::pair<std::string, std::string>::first);
    return found == choices_.end() ? std::string(otherwise) : found->second;
}

std::vector<StressArm> stress_arms(const std::vector<ArmBlock>& blocks, const AxisValues& selection) {
    std::vector<StressArm> arms;
    for (ArmBlock block : blocks) {
        size_t count = 1;
        for (StressAxis& axis : block) {
            if (const auto chosen = selection.find(axis.name); chosen != selection.end()) {
                const bool shared = is_cell_axis(axis.name) || axis.name == kDepthAxis;
                std::vector<std::string> values;
                for (const std::string& value : chosen->second) {
                    if (shared || std::ranges::find(axis.values, value) != axis.values.end()) values.push_back(value);
                }
                axis.values = values;
            }
            count *= axis.values.size();
        }
        for (size_t i = 0; i < count; ++i) {
            const StressArm arm = arm_of(block, i);
            if (std::ranges::find(arms, arm) == arms.end()) arms.push_back(arm);
        }
    }
    return arms;
}

AxisValues parse_stress_axes(const std::vector<std::string>& arguments, const std::vector<ArmBlock>& blocks) {
    std::vector<std::string> names;
    for (const ArmBlock& block : blocks) {
        for (const StressAxis& axis : block) {
            if (std::ranges::find(names, axis.name) == names.end()) names.push_back(axis.name);
        }
    }
    AxisValues values;
    for (const std::string& argument : arguments) {
        const size_t equals = argument.find('=');
        const std::string axis = argument.substr(0, equals);
        if (equals == std::string::npos) {
            throw InputError("-a " + argument, "not an axis; allowed: axis=value,value");
        }
        if (std::ranges::find(names, axis) == names.end()) {
            throw InputError("-a " + argument, unknown_name("axis of these cases", axis, names));
        }
        if (!values.emplace(axis, parse_values(axis, argument.substr(equals + 1), blocks)).second) {
            throw InputError("-a " + argument, fmt::format("'{}' was given before", axis));
        }
    }
    return values;
}

ArmBlock every_path(const std::string& layout, const std::string& hdr) {
    return {
        {std::string(kPathAxis), path_keys()}, {std::string(kLayoutAxis), {layout}}, {std::string(kHdrAxis), {hdr}}};
}

ArmBlock every_layout(const std::string& hdr) {
    return {{std::string(kPathAxis), {"deferred"}},
            {std::string(kLayoutAxis), layout_keys()},
            {std::string(kHdrAxis), {hdr}}};
}

ArmBlock every_listing_path(const std::string& layout, const std::string& hdr) {
    std::vector<std::string> keys;
    for (const PathInfo* path : all_paths()) {
        if (path->uses_light_lists) keys.emplace_back(path->key);
    }
    return {{std::string(kPathAxis), keys}, {std::string(kLayoutAxis), {layout}}, {std::string(kHdrAxis), {hdr}}};
}

ArmBlock with_list_builders(ArmBlock block) {
    block.push_back({std::string(kListsAxis), list_builder_names()});
    return block;
}

}  // namespace lightsweep
