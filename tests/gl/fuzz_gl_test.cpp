// What must hold of the fuzzer: the paths survive it, it finds a planted defect, and the scene that it writes out is
// small and shows that defect by itself.
#include "bench/stress/fuzz.h"

#include "bench/stress/fuzz_check.h"
#include "bench/stress/fuzz_scene.h"
#include "renderer/gl/context.h"
#include "renderer/scene/scene_json.h"
#include "tests/gl/moved_attributes.h"

#include <gtest/gtest.h>

namespace lightsweep {
namespace {

Scene scene_of(const FuzzCase& fuzz_case) {
    return read_scene_json(JsonReader::from_text(fuzz_case.scene.dump(), std::to_string(fuzz_case.seed)));
}

TEST(Fuzz, ThePathsSurviveIt) {
    Workbench bench(gl::Context::current()->limits());
    uint64_t scenes = 0;
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        const FuzzReport report = fuzz(bench, {.only_seed = seed, .out = {}, .shrink = false});
        scenes += report.scenes;
        for (const FuzzFinding& finding : report.findings) {
            EXPECT_EQ(finding.verdict, "limit") << finding.cell << ": " << finding.reason;
        }
    }
    EXPECT_EQ(scenes, 8U);
}

TEST(Fuzz, TheSameSeedFindsTheSame) {
    Workbench bench(gl::Context::current()->limits());
    const auto first = fuzz(bench, {.only_seed = 3, .out = {}}), second = fuzz(bench, {.only_seed = 3, .out = {}});
    EXPECT_EQ(first.cells, second.cells);
    EXPECT_EQ(first.limits, second.limits);
    ASSERT_EQ(first.findings.size(), second.findings.size());
    for (size_t i = 0; i < first.findings.size(); ++i) EXPECT_EQ(first.findings[i].reason, second.findings[i].reason);
}

struct Defect {
    const char* file;
    const char* right;
    const char* wrong;
};

// Most random scenes show a wrong formula; a handful of seeds must.
TEST(Fuzz, FindsPlantedDefects) {
    const Defect defects[] = {
        {"lib/light.glsl", "window * window", "window"},
        {"lib/shade.glsl", "frame.ambient * s.base_color", "vec3(0.0)"},
    };
    Workbench bench(gl::Context::current()->limits());
    for (const Defect& defect : defects) {
        const PlantedText planted{
            {defect.file, said_differently(shader_text(defect.file), defect.right, defect.wrong)}};
        int found = 0;
        for (uint64_t seed = 1; seed <= 8 && found == 0; ++seed) {
            const FuzzCase fuzz_case = make_fuzz_case(seed);
            const CellParams& cell = fuzz_case.cells.front();
            FuzzStage stage(bench, scene_of(fuzz_case), cell.width, cell.height);
            found += stage.check(cell, planted).verdict == StressVerdict::fail;
        }
        EXPECT_GT(found, 0) << defect.right;
    }
}

}  // namespace
}  // namespace lightsweep
