// Small groups for the tests of the runner.
#pragma once

#include "bench/measure/group_runner.h"
#include "tests/gl/fixture.h"

#include <atomic>
#include <string>
#include <utility>
#include <vector>

namespace lightsweep {

inline PlanGroup group_of(const std::string& scene, int lights,
                          const std::vector<std::pair<std::string, std::string>>& arms) {
    PlanGroup group;
    for (const auto& [path, layout] : arms) {
        CellParams cell;
        cell.scene = scene;
        cell.lights = lights;
        cell.width = 128;
        cell.height = 72;
        cell.path = path;
        cell.layout = layout;
        if (find_path(path).uses_light_lists) cell.light_lists = "auto";
        group.cells.push_back(cell);
    }
    group.key = group.cells.front().group();
    return group;
}

inline GroupResult run_group(const PlanGroup& group, int rounds) {
    SceneStore scenes;
    const std::atomic<bool> never{false};
    GroupRunner runner(scenes, "finish_clock", never);
    return runner.run(group, {.target_ci = 1e-9, .min_rounds = rounds, .max_rounds = rounds}, [](double) {});
}

}  // namespace lightsweep
