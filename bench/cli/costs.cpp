#include "bench/cli/costs.h"

#include "bench/cli/progress.h"
#include "bench/measure/list_probe.h"

#include <fmt/format.h>

namespace lightsweep {

CostModel measure_costs(const Environment& environment) {
    fmt::print(stderr, "measuring what each path costs on this machine; kept for later runs\n");
    ProgressBar bar(1, std::nullopt);
    CostModel model = calibrate_costs(environment, probe_light_lists().faster(),
                                      [&](double share) { bar.update(0, share, "cost model"); });
    bar.clear();
    keep_cost_model(model);
    return model;
}

CostModel known_costs(const Environment& environment) {
    const auto kept = find_cost_model(environment);
    return kept ? *kept : measure_costs(environment);
}

}  // namespace lightsweep
