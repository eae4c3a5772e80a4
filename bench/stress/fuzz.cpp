#include "bench/stress/fuzz.h"

#include "bench/stress/fuzz_check.h"
#include "bench/stress/fuzz_scene.h"
#include "bench/stress/fuzz_shrink.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/scene/scene_json.h"

#include <fmt/format.h>

#include <chrono>

namespace lightsweep {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr double kShrinkSeconds = 60.0;  // for one scene

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Scene scene_of(const Json& json, uint64_t seed) {
    Scene scene = read_scene_json(JsonReader::from_text(json.dump(), fmt::format("seed {}", seed)));
    scene.key = fmt::format("seed{}", seed);
    return scene;
}

// A scene and the one of its cells that fails.
struct Failing {
    Json scene;
    CellParams cell;
    std::string reason;
};

class Fuzzer {
  public:
    Fuzzer(Workbench& bench, const FuzzOptions& options) : bench_(bench), options_(options) {
        if (options.out.empty()) return;
        std::error_code failed;
        std::filesystem::create_directories(options.out, failed);
        if (failed) throw InputError(options.out.string(), "the folder cannot be made: " + failed.message());
    }

    void try_seed(uint64_t seed, FuzzReport& report) {
        const FuzzCase fuzz_case = make_fuzz_case(seed);
        const CellParams& first = fuzz_case.cells.front();
        FuzzStage stage(bench_, scene_of(fuzz_case.scene, seed), first.width, first.height);
        ++report.scenes;
        for (const CellParams& cell : fuzz_case.cells) {
            const CellCheck check = stage.check(cell);
            if (check.verdict == StressVerdict::skipped) continue;
            ++report.cells;
            for (const auto& [kind, number] : check.limits) {
                if (++report.limits[kind] > 1) continue;
                report.findings.push_back({seed, name(cell, seed, {}), "limit", kind + ": " + number, {}});
            }
            if (check.verdict != StressVerdict::fail) continue;
            report.findings.push_back(finding(seed, {fuzz_case.scene, cell, check.reason}));
        }
    }

  private:
    static std::string name(CellParams cell, uint64_t seed, const std::filesystem::path& file) {
        cell.scene = file.empty() ? fmt::format("seed{}", seed) : file.string();
        return cell.name();
    }

    FuzzFinding finding(uint64_t seed, Failing failing) {
        if (options_.shrink) shrink_failing(seed, failing);
        std::filesystem::path file;
        if (!options_.out.empty()) {
            file = options_.out / fmt::format("seed{}-{}.json", seed, failing.cell.path);
            Json scene{{"comment", comment(seed, failing, file)}};
            scene.update(failing.scene);
            write_file_atomically(file, scene.dump(2) + "\n");
        }
        return {seed, name(failing.cell, seed, file), "fail", failing.reason, file};
    }

    static std::string comment(uint64_t seed, const Failing& failing, const std::filesystem::path& file) {
        const CellParams& c = failing.cell;
        std::string command = fmt::format("lightsweep render --scene {} --path {} --size {}x{} --hdr {} --skip {}",
                                          file.string(), c.path, c.width, c.height, c.hdr, c.skip);
        if (!c.layout.empty()) command += " --layout " + c.layout;
        if (!c.light_lists.empty()) command += " --light-lists " + c.light_lists;
        if (c.sums != kSums.front()) command += " --sums " + c.sums;
        return fmt::format("seed {}: {}; {} -o picture.exr", seed, failing.reason, command);
    }

    // Nothing where it does not fail.
    std::string failure(uint64_t seed, const Json& json, const CellParams& cell) {
        try {
            const CellCheck check = FuzzStage(bench_, scene_of(json, seed), cell.width, cell.height).check(cell);
            return check.verdict == StressVerdict::fail ? check.reason : "";
        } catch (const InputError&) {
            return {};
        }
    }

    void shrink_failing(uint64_t seed, Failing& failing) {
        const Clock::time_point start = Clock::now();
        const auto may_go_on = [&] { return seconds_since(start) < kShrinkSeconds; };
        const auto accept = [&](const Json& scene, const CellParams& cell) {
            std::string reason = failure(seed, scene, cell);
            if (reason.empty()) return false;
            failing = {scene, cell, std::move(reason)};
            return true;
        };
        const auto simplify = [&](const auto& change) {
            CellParams simpler = failing.cell;
            change(simpler);
            return may_go_on() && simpler != failing.cell && accept(failing.scene, simpler);
        };
        simplify([](CellParams& c) { c.skip = kSkipEverything; });
        simplify([](CellParams& c) { c.sums = kSums.front(); });
        simplify([](CellParams& c) { c.hdr = "rgba32f"; });
        simplify([](CellParams& c) { c.layout = c.layout.empty() ? "" : "float32"; });
        shrink(
            failing.scene,
            [&](Json scene) {
                if (!scene.contains(Json::json_pointer("/lights/fixed"))) return false;
                scene["lights"]["default_count"] = scene["lights"]["fixed"].size();
                return accept(scene, failing.cell);
            },
            may_go_on);
        while (simplify([](CellParams& c) { c.width = (c.width + 1) / 2; })) continue;
        while (simplify([](CellParams& c) { c.height = (c.height + 1) / 2; })) continue;
    }

    Workbench& bench_;
    const FuzzOptions& options_;
};

}  // namespace

FuzzReport fuzz(Workbench& bench, const FuzzOptions& options, const std::function<void(const FuzzReport&)>& progress) {
    const Clock::time_point start = Clock::now();
    Fuzzer fuzzer(bench, options);
    FuzzReport report;
    for (uint64_t seed = options.only_seed.value_or(options.seed);; ++seed) {
        fuzzer.try_seed(seed, report);
        report.seconds = seconds_since(start);
        if (progress) progress(report);
        if (options.only_seed || report.seconds >= options.seconds) return report;
    }
}

}  // namespace lightsweep
