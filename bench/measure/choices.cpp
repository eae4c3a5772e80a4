#include "bench/measure/choices.h"

#include "bench/measure/calibrate.h"
#include "bench/measure/list_probe.h"
#include "bench/measure/skip_choice.h"
#include "bench/measure/trial.h"
#include "renderer/base/error.h"
#include "renderer/paths/paths.h"

#include <vector>

namespace lightsweep {
namespace {

// Another path's cell, without what that path does not use.
CellParams with_path(CellParams cell, const std::string& path) {
    cell.path = path;
    const PathInfo& info = find_path(path);
    if (!info.uses_layout) cell.layout.clear();
    if (!info.uses_light_lists) cell.light_lists.clear();
    return cell;
}

// What the choice of skip=auto hangs on: the view, and the arm but for its HDR format.
std::string skips_key(const CellParams& cell, const CellParams& drawn) {
    CellParams key = cell;
    key.path = drawn.path;
    key.layout = drawn.layout;
    key.light_lists = drawn.light_lists;
    key.hdr = kHdrFormats.front();
    key.skip = kAutoSkip;
    return key.name();
}

}  // namespace

CellParams drawn_params(const CellResult& cell) {
    CellParams drawn = cell.auto_path ? with_path(cell.params, cell.auto_path->path) : cell.params;
    if (cell.light_lists) drawn.light_lists = cell.light_lists->used;
    if (cell.auto_skip) drawn.skip = cell.auto_skip->skip;
    return drawn;
}

void Choices::remember(const GroupResult& group) {
    for (const auto& cell : group.cells) {
        const bool chosen = cell.light_lists && cell.light_lists->asked == kAutoLightLists;
        if (chosen && !light_lists_) light_lists_ = cell.light_lists;
        if (cell.auto_skip) skips_.try_emplace(skips_key(cell.params, drawn_params(cell)), *cell.auto_skip);
    }
}

CellParams Choices::resolve(const CellParams& params, const Subject& subject, CellResult& cell) {
    CellParams drawn = params;
    if (params.light_lists == kAutoLightLists) {
        cell.light_lists = auto_light_lists();
        drawn.light_lists = cell.light_lists->used;
    }
    if (params.skip == kAutoSkip) drawn.skip = kSkipEverything;
    if (params.path == kAutoPath) {
        cell.auto_path = auto_path(drawn, subject);
        drawn = with_path(drawn, cell.auto_path->path);
    }
    if (drawn.light_lists.empty()) {
        cell.light_lists.reset();
    } else if (params.light_lists != kAutoLightLists) {
        cell.light_lists = ListChoice{.asked = params.light_lists, .used = params.light_lists, .why = "asked for"};
    }
    if (params.skip == kAutoSkip) {
        cell.auto_skip = auto_skips(drawn, subject, cell);
        drawn.skip = cell.auto_skip->skip;
    }
    return drawn;
}

PathChoice Choices::auto_path(const CellParams& drawn, const Subject& subject) const {
    if (!costs_) throw InputError("path=auto", "no cost model; `lightsweep doctor --calibrate` measures one");
    PathChoice choice = choose_path(*costs_, cost_features(subject, *buffers_, *shapes_));
    const auto candidates = may_be_fastest(*costs_, choice);
    if (candidates.size() < 2) return choice;
    std::vector<CellParams> cells;
    for (const auto& path : candidates) cells.push_back(with_path(drawn, path));
    const auto tried = try_arms(cells, subject, *buffers_, *shapes_);
    for (size_t i = 0; i < candidates.size(); ++i) {
        if (tried[i]) choice.tried_ns[candidates[i]] = *tried[i];
    }
    decide_by_trial(choice);
    return choice;
}

// Found out once for each view and arm.
const SkipChoice& Choices::auto_skips(const CellParams& drawn, const Subject& subject, const CellResult& cell) {
    const std::string key = skips_key(cell.params, drawn);
    auto found = skips_.find(key);
    if (found == skips_.end()) {
        found = skips_.emplace(key, choose_skips(drawn, subject, *buffers_, *shapes_)).first;
    }
    return found->second;
}

// The one that is faster on this device; found out once.
const ListChoice& Choices::auto_light_lists() {
    if (!light_lists_) {
        const ListProbe probe = probe_light_lists();
        const std::string& used = list_builder_names()[static_cast<size_t>(probe.faster())];
        light_lists_ = ListChoice{.asked = kAutoLightLists, .used = used, .why = probe.why()};
    }
    return *light_lists_;
}

}  // namespace lightsweep
