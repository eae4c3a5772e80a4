#include "bench/measure/shared_work.h"

#include "bench/measure/cell_work.h"
#include "renderer/base/check.h"

#include <algorithm>

namespace lightsweep {
namespace {

const CellResult* find_like(const GroupResult& group, const CellResult& cell) {
    const auto found = std::ranges::find_if(group.cells, [&](const CellResult& c) { return same_work(c, cell); });
    return found == group.cells.end() ? nullptr : &*found;
}

// The like of each drawn cell, null for others; empty when one has none, or was not fast enough to sample.
std::vector<const CellResult*> find_likes(const GroupResult& earlier, const GroupResult& group) {
    std::vector<const CellResult*> likes;
    bool any = false;
    for (const auto& cell : group.cells) {
        likes.push_back(cell.work_key ? find_like(earlier, cell) : nullptr);
        if (cell.work_key && (!likes.back() || cell.status != CellStatus::ok)) return {};
        any |= cell.work_key.has_value();
    }
    return any ? likes : std::vector<const CellResult*>();
}

}  // namespace

bool same_work(const CellResult& a, const CellResult& b) {
    const auto may_share = [](const CellResult& cell) {
        const auto skips = cell.skips();
        return cell.work_key && skips && skips->has(Skip::cells);
    };
    // The key holds all of it; but a hash of two scenes may be the same by chance.
    return may_share(a) && may_share(b) && a.work_key == b.work_key && a.params.scene == b.params.scene &&
           a.params.width == b.params.width && a.params.height == b.params.height && a.params.hdr == b.params.hdr;
}

void share(const CellResult& like, CellResult& cell) {
    CHECK_THAT(like.measured() && like.work && cell.work, "{} shares with {}", cell.name, like.name);
    cell.shared_with = like.id;
    cell.samples = like.samples;
    cell.stop_reason = like.stop_reason;
    cell.work = like_settled(*like.work, *cell.work);
    if (!cell.error) cell.error = like.error;
}

void SharedWork::remember(const GroupResult& group) {
    GroupResult own = group;
    std::erase_if(own.cells, [](const CellResult& cell) {
        return !cell.measured() || cell.shared_with || !cell.work_key || !cell.skips() ||
               !cell.skips()->has(Skip::cells);
    });
    if (!own.cells.empty()) groups_.push_back(std::move(own));
}

bool SharedWork::share_group(GroupResult& group) const {
    for (const auto& earlier : groups_) {
        const auto likes = find_likes(earlier, group);
        if (likes.empty()) continue;
        group.reference = earlier.reference;
        if (group.reference) {
            group.reference->from_cache = true;
            group.reference->seconds = 0.0;
        }
        for (size_t i = 0; i < likes.size(); ++i) {
            if (!likes[i]) continue;
            share(*likes[i], group.cells[i]);
            if (!group.noise && earlier.noise && earlier.noise->arm == likes[i]->name) {
                group.noise = earlier.noise;
                group.noise->arm = group.cells[i].name;
            }
        }
        return true;
    }
    return false;
}

}  // namespace lightsweep
