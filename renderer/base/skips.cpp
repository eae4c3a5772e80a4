#include "renderer/base/skips.h"

#include <algorithm>

namespace lightsweep {

const std::array<SkipInfo, kSkipCount>& skip_infos() {
    static constexpr std::array<SkipInfo, kSkipCount> infos{{
        {Skip::frustum, "frustum", "instances whose bounds miss the view", true},
        {Skip::light_frustum, "light_frustum", "lights whose reach misses the view, or that give nothing", true},
        {Skip::light_lists, "light_lists", "lights that do not reach a pixel's tile or cluster: they are zero there",
         true},
        {Skip::light_depth, "light_depth", "lights in front of or behind all that a tile or a pixel shows", true},
        {Skip::occlusion, "occlusion", "instances hidden behind what this frame has drawn so far", true},
        {Skip::backface, "backface", "triangles of single-sided materials that face away", false},
        {Skip::sort, "sort", "hidden fragments: instances are drawn front to back", true},
        {Skip::fields, "fields", "G-buffer fields and targets that no material of the scene uses", false},
        {Skip::passes, "passes", "passes with nothing to do in this scene or frame", true},
        {Skip::code, "code", "shader code for what the scene lacks", false},
        {Skip::background, "background", "shading of pixels that no surface covers", true},
        {Skip::clears, "clears", "clearing targets that are wholly overwritten, keeping those not read again", true},
        {Skip::cells, "cells", "cells that are the same work as one that was measured: they share its samples", true},
    }};
    return infos;
}

std::string SkipSet::text() const {
    const auto count =
        static_cast<size_t>(std::ranges::count_if(skip_infos(), [&](const SkipInfo& info) { return has(info.skip); }));
    const bool from_all = 2 * count >= kSkipCount;
    std::string result = from_all ? "all" : "none";
    for (const auto& info : skip_infos()) {
        if (has(info.skip) == from_all) continue;
        result += from_all ? '-' : '+';
        result += info.key;
    }
    return result;
}

std::optional<SkipSet> parse_skips(std::string_view text) {
    const auto word = [&]() {  // takes the next one, up to a sign
        const size_t length = std::min(text.find_first_of("+-"), text.size());
        const std::string_view taken = text.substr(0, length);
        text.remove_prefix(length);
        return taken;
    };
    const std::string_view base = word();
    if (base != "all" && base != "none") return std::nullopt;
    SkipSet set = base == "all" ? SkipSet::all() : SkipSet::none();
    while (!text.empty()) {
        const bool add = text.front() == '+';
        text.remove_prefix(1);
        const std::string_view key = word();
        const auto found = std::ranges::find(skip_infos(), key, &SkipInfo::key);
        if (found == skip_infos().end()) return std::nullopt;
        set = add ? set.with(found->skip) : set.without(found->skip);
    }
    return set;
}

}  // namespace lightsweep
