// Measures one group: all arms live at once, their frames interleaved in a balanced order so that what slows the
// machine slows them alike; the first arm runs a second time as its own twin, whose ratio to it is the noise floor.
// Cells that ask for the same work as others share their samples.
#pragma once

#include "bench/measure/arm.h"
#include "bench/measure/choices.h"
#include "bench/measure/scene_store.h"
#include "bench/measure/shared_work.h"
#include "bench/measure/slow_arms.h"
#include "bench/measure/truth.h"
#include "bench/plan/plan.h"
#include "bench/report/record.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lightsweep {

struct SamplingRules {
    double seconds = 1e9;     ///< for the whole group, preparing it included
    double target_ci = 0.02;  ///< stop when every arm's median is known to this half width (fraction)
    int min_rounds = 6;       ///< below this a median has no interval
    int max_rounds = 400;
    double max_frame_s =
        1e9;  ///< an arm whose frame takes longer is drawn once, not sampled, and not drawn with more lights
    std::filesystem::path
        maps_folder{};  ///< where each cell's FLIP map goes, as <id>.png (16-bit grey); empty: nowhere
};

/// What a progress bar shows: [0, 1] of this group.
using GroupProgress = std::function<void(double fraction)>;

class GroupRunner {
  public:
    GroupRunner(SceneStore& scenes, std::string timer_method, const std::atomic<bool>& interrupted);
    GroupRunner(const GroupRunner&) = delete;
    GroupRunner& operator=(const GroupRunner&) = delete;

    /// What path=auto decides by. Without it a cell that asks for it is invalid.
    void know_costs(CostModel costs) { choices_.know_costs(std::move(costs)); }

    /// A group of this run that was measured before: its slow arms, its samples and what `auto` came to hold from here
    /// on. Those that run() returns are known already.
    void remember(const GroupResult& group);

    /// A cell that cannot be measured is recorded with its reason and the rest goes on. Throws InputError when the
    /// scene cannot be loaded. When `interrupted` becomes true it returns early: the result is not a finished group.
    GroupResult run(const PlanGroup& group, const SamplingRules& rules, const GroupProgress& progress);

  private:
    using Arms = std::vector<std::unique_ptr<Arm>>;
    struct Slot;
    GroupResult measure(const PlanGroup& group, const SamplingRules& rules, const GroupProgress& progress);
    Arms draw_cells(const PlanGroup& group, const Subject& subject, const SamplingRules& rules, GroupResult& result);
    void prepare(Arms& arms, const Subject& subject, const SamplingRules& rules, GroupResult& result);
    std::unique_ptr<Arm> warm_up(const CellParams& params, const Subject& subject, const SamplingRules& rules,
                                 GroupResult& result, CellResult& cell);
    void settle(Arm& arm, const Truth& truth, GroupResult& result, CellResult& cell);
    std::string sample_rounds(const SamplingRules& rules, int64_t start_ns, GroupResult& result,
                              std::vector<Slot>& slots, const GroupProgress& progress);
    FrameSample take(Arm& arm, GroupResult& result);

    SceneStore* scenes_;
    const std::atomic<bool>* interrupted_;
    std::unique_ptr<FrameTimer> timer_;
    FrameBuffers buffers_;
    DrawShapes shapes_;
    TruthFinder truths_;
    Choices choices_;
    SlowArms slow_arms_;
    SharedWork shared_work_;
};

}  // namespace lightsweep
