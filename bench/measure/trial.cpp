#include "bench/measure/trial.h"

#include "bench/stats/ratio.h"
#include "bench/stats/schedule.h"
#include "renderer/base/error.h"
#include "renderer/gl/context.h"

namespace lightsweep {
namespace {

constexpr size_t kRounds = 4;
// Where frames are long, fewer tell as much: they are disturbed less.
constexpr int64_t kEnoughNs = 1'500'000'000;
constexpr size_t kFewestRounds = 2;
// Of a pair: more where noise would decide.
constexpr size_t kPairRounds = 6;
constexpr size_t kMostPairRounds = 18;
constexpr double kPairLevel = 0.8;

double timed_draw(Arm& arm) {
    const int64_t start = now_ns();
    arm.draw();
    return static_cast<double>(now_ns() - start);
}

}  // namespace

std::vector<std::optional<double>> try_arms(const std::vector<CellParams>& cells, const Subject& subject,
                                            FrameBuffers& buffers, const DrawShapes& shapes) {
    std::vector<std::unique_ptr<Arm>> arms(cells.size());
    for (size_t i = 0; i < cells.size(); ++i) {
        try {
            arms[i] = std::make_unique<Arm>(cells[i], subject, buffers, shapes);
            const int64_t start = now_ns();
            for (int frame = 0; frame <= kFramesToSettle && now_ns() - start < kEnoughNs; ++frame) arms[i]->draw();
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
            ns[i].push_back(timed_draw(*arms[i]));
        }
    }
    std::vector<std::optional<double>> medians(cells.size());
    for (size_t i = 0; i < cells.size(); ++i) {
        if (!ns[i].empty()) medians[i] = median(ns[i]);
    }
    return medians;
}

Interval try_pair(Arm& a, Arm& b, double edge) {
    std::vector<double> a_ns, b_ns;
    Interval ratio;
    const auto decided = [&] { return (ratio.low && *ratio.low > edge) || (ratio.high && *ratio.high < edge); };
    const int64_t start = now_ns();
    for (size_t round = 0; round < kMostPairRounds; ++round) {
        if (round >= kFewestRounds && now_ns() - start > kEnoughNs) break;
        if (round >= kPairRounds && decided()) break;
        for (const size_t i : schedule(2, round)) (i == 0 ? a_ns : b_ns).push_back(timed_draw(i == 0 ? a : b));
        ratio = ratio_of_pairs(a_ns, b_ns, kPairLevel)->ratio;
    }
    return ratio;
}

}  // namespace lightsweep
