#include "bench/measure/trial.h"

#include "bench/stats/quantile.h"
#include "bench/stats/schedule.h"
#include "renderer/base/error.h"
#include "renderer/gl/context.h"

namespace lightsweep {
namespace {

constexpr size_t kRounds = 4;
// Where frames are long, fewer tell as much: they are disturbed less.
constexpr int64_t kEnoughNs = 1'500'000'000;
constexpr size_t kFewestRounds = 2;

}  // namespace

std::vector<std::optional<double>> try_arms(const std::vector<CellParams>& cells, const Subject& subject,
                                            FrameBuffers& buffers, const DrawShapes& shapes) {
    std::vector<std::unique_ptr<Arm>> arms(cells.size());
    for (size_t i = 0; i < cells.size(); ++i) {
        try {
            arms[i] = std::make_unique<Arm>(cells[i], subject, buffers, shapes);
            arms[i]->draw();
        } catch (const InputError&) {
            arms[i].reset();
        } catch (const EnvironmentError&) {
            arms[i].reset();
        }
    }
    std::vector<std::vector<double>> ns(cells.size());
    const int64_t start = now_ns();
    for (size_t round = 0; round < kRounds; ++round) {
        if (round >= kFewestRounds && now_ns() - start > kEnoughNs) break;
        for (const size_t i : schedule(cells.size(), round)) {
            if (!arms[i]) continue;
            const int64_t frame_start = now_ns();
            arms[i]->draw();
            ns[i].push_back(static_cast<double>(now_ns() - frame_start));
        }
    }
    std::vector<std::optional<double>> medians(cells.size());
    for (size_t i = 0; i < cells.size(); ++i) {
        if (!ns[i].empty()) medians[i] = median(ns[i]);
    }
    return medians;
}

}  // namespace lightsweep
