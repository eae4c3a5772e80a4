// The cells of a sweep as Google Benchmarks. The library is a front end here: a repetition is one frame of a cell,
// timed by the timer that the self-test trusts. How noise is measured and what a report says is not known here.
#pragma once

#include "bench/measure/arm.h"
#include "bench/measure/scene_store.h"
#include "bench/plan/plan.h"

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

class CellBenchmarks {
  public:
    /// Plans the cells of `sweep` with `axes` (`axis=values`) in place of its own. Throws InputError.
    CellBenchmarks(const std::string& sweep, const std::vector<std::string>& axes);
    ~CellBenchmarks();

    /// Registers one benchmark per cell, named after it. `repetitions`: frames of each; 0: as the library's own flag
    /// says. This object must live until the benchmarks have run.
    void add(int repetitions);
    /// Whether the benchmark `name` is one of them.
    bool owns(std::string_view name) const;

    /// Lets the timer self-test choose on the current context, which the benchmarks need; or takes `forced`, unless it
    /// is empty, unproved. Gives the method. Throws EnvironmentError when no timer can be trusted.
    std::string choose_timer(const std::string& forced);

  private:
    struct LiveGroup;
    void run(benchmark::State& state, const CellParams& cell);
    Arm& prepared_arm(const CellParams& cell);

    Plan plan_;
    SceneStore scenes_;
    std::unique_ptr<FrameTimer> timer_;
    std::string timer_method_;
    std::string faster_lists_;  // what light_lists=auto stands for, once asked
    std::unique_ptr<LiveGroup> live_;
};

}  // namespace lightsweep
