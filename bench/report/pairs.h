// The arms of a group against each other, and an arm against itself: ratios of paired frames. Pure functions of
// samples.
#pragma once

#include "bench/report/record.h"

#include "bench/stats/ratio.h"

#include <optional>
#include <vector>

namespace lightsweep {

/// Every interval in a report has this level.
inline constexpr double kIntervalLevel = 0.95;
/// The path that the others are compared with.
inline constexpr const char* kBaselinePath = "forward";

/// The `skip` of the arms that a group's answers, fronts and crossovers are about, one for all of them: all, where a
/// cell has it, else the first cell's. What other sets cost is told in `skips`.
const std::string& contested_skip(const GroupResult& group);

/// The measured cells with that `skip` that are arms of their own: path=auto draws what another arm draws.
std::vector<const CellResult*> competitors(const GroupResult& group);

/// The wall times of the frames of both that share a round, in the order taken.
struct PairedFrames {
    std::vector<double> a_ns, b_ns;
};
PairedFrames pair_by_round(const std::vector<int64_t>& round_a, const std::vector<int64_t>& wall_ns_a,
                           const std::vector<int64_t>& round_b, const std::vector<int64_t>& wall_ns_b);

/// Ratio a over b of the wall times of the frames that share a round. Rounds in the order taken. Nothing when none
/// does.
std::optional<PairedRatio> ratio_by_round(const std::vector<int64_t>& round_a, const std::vector<int64_t>& wall_ns_a,
                                          const std::vector<int64_t>& round_b, const std::vector<int64_t>& wall_ns_b,
                                          double level);

/// The same of two measured cells of one group.
std::optional<PairedRatio> time_ratio(const CellResult& a, const CellResult& b, double level);

/// Whether the samples of one are those of the other, or both those of a third: their ratio says nothing.
bool share_samples(const CellResult& a, const CellResult& b);

/// The noise of a group: the twin over its arm. Nothing without a twin, or when its arm was not measured.
std::optional<PairedRatio> noise_ratio(const GroupResult& group);

/// The smallest relative difference that such a twin lets one see: how far its interval reaches from 1, as a factor
/// less 1. Nothing when an end is open.
std::optional<double> noise_floor(const PairedRatio& twin);

/// The largest floor of the groups; nothing when none has one.
std::optional<double> noise_floor(const std::vector<GroupResult>& groups);

/// The floor that the arms of a group are judged by: the group's own, else `run_floor`.
std::optional<double> floor_of(const GroupResult& group, std::optional<double> run_floor);

struct ArmPair {
    const CellResult* a = nullptr;
    const CellResult* b = nullptr;
    PairedRatio ratio;
    Verdict verdict = Verdict::ambiguous;
    std::optional<double> floor;  ///< the noise floor it was judged by
};

/// Every arm against the group's first, and every arm with a layout against the forward arm of the same HDR format,
/// skips, guards and sums; each pair once, arms that are not ok and pairs that share their samples left out. The
/// interval is of kIntervalLevel; the verdict is given on the wider one of level_for_each(), so that all verdicts of
/// the group hold together with that level. It is judged by floor_of(); without one it stays ambiguous.
std::vector<ArmPair> compare_arms(const GroupResult& group, std::optional<double> run_floor);

}  // namespace lightsweep
