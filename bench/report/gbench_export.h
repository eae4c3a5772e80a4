// A report in the JSON form of Google Benchmark, so that its compare.py and other readers of that form work on our
// cells.
#pragma once

#include "bench/report/report_file.h"

namespace lightsweep {

/// One entry per frame ("iteration"), named after the cell: real_time is wall_ns, cpu_time is cpu_ns (building the
/// frame), the counter gpu_ns beside them; then their medians ("aggregate", `<cell>_median`). A cell that is not ok, or
/// has no samples, is one entry with error_occurred and its reason.
Json to_google_benchmark(const Report& report);

}  // namespace lightsweep
