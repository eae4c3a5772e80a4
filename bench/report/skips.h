// What each skip saved: arms of a group that differ in one skip, side by side. Pure functions of samples.
#pragma once

#include "bench/report/pairs.h"

#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// Work of a frame without it less that of one with it; nothing where either is not known.
struct SavedWork {
    std::optional<int64_t> draws, instances, triangles, lights, light_evaluations, moved_bytes_per_px;
};

/// Two arms of a group that are the same but for one skip, or for all of them.
struct SkipSaving {
    const CellResult* with = nullptr;
    const CellResult* without = nullptr;
    std::string skip;  ///< its key; `all` or `auto`: that set against none
    /// What both do with the other skips: `all` of them, `none` of them, or else the set that both share, as
    /// SkipSet::text() says it. Where `cells` stands does not matter.
    std::string others;
    bool same_work = false;  ///< both ask for the same work: the skip finds nothing to do, and costs nothing
    /// Time with it over time without it, paired; below 1: it saves. Of kIntervalLevel. Nothing without samples of
    /// their own.
    std::optional<PairedRatio> time;
    std::optional<double> saved_ns;  ///< median over the paired frames of the time without it less the time with it
    /// Of `with` against `without` on that interval, by `floor`. Each for itself: of many verdicts some may be wrong.
    Verdict verdict = Verdict::ambiguous;
    std::optional<double> floor;  ///< the noise floor of the group: a ratio nearer to 1 says nothing
    SavedWork work;
    /// That the picture stays the same: of one cell against the other, or both the same as a third. Nothing where
    /// pictures were not compared that way.
    std::optional<SkipProof> proof;
};

/// For each two cells of one group that were drawn and differ in one skip alone, and for `all` and `auto` against
/// `none`, in the order met. `cells` itself is left out: it changes what is measured, not what is drawn.
std::vector<SkipSaving> find_skip_savings(const GroupResult& group, std::optional<double> run_floor);

Json to_json(const SkipSaving& saving);

}  // namespace lightsweep
