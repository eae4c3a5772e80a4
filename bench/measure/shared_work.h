// Cells that ask for the same work are measured once (Skip::cells): the others take the samples over, and say so.
#pragma once

#include "bench/report/record.h"

#include <vector>

namespace lightsweep {

/// Whether the samples of one are samples of the other: both were drawn, ask for the same work, and have Skip::cells.
bool same_work(const CellResult& a, const CellResult& b);

/// Gives `cell`, which was drawn once, what was measured of `like`. Both keep their first frame's time, and `cell` its
/// own error where it has one.
void share(const CellResult& like, CellResult& cell);

/// What a run has measured so far.
class SharedWork {
  public:
    void remember(const GroupResult& group);

    /// When every drawn cell of `group` finds its like in one and the same earlier group, they take over its samples
    /// with the noise of that group, so that ratios stay those of paired frames. Otherwise false, and nothing changes.
    bool share_group(GroupResult& group) const;

  private:
    std::vector<GroupResult> groups_;  ///< their own samples alone, not shared ones
};

}  // namespace lightsweep
