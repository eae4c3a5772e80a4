#include "bench/measure/skip_choice.h"

#include "bench/measure/trial.h"
#include "renderer/base/error.h"
#include "renderer/gl/context.h"
#include "renderer/paths/paths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lightsweep {
namespace {

// Lists that leave out most of many lights win, and shading all of them at every pixel takes long to try.
constexpr size_t kFewLights = 32;
constexpr double kSmallShare = 0.25;
constexpr int64_t kLongFrameNs = 500'000'000;
constexpr int64_t kEnoughNs = 10'000'000'000;  // for all trials of a cell

struct Doubtful {
    Skip skip;
    const char* cost;                                  ///< what it does that may not pay
    const char* (*pointless)(const SkipFacts&);        ///< why it is turned off without a trial, or null
    const char* (*surely_worth_it)(const SkipFacts&);  ///< why it is kept without one, or null
};

const char* never(const SkipFacts&) { return nullptr; }
const char* one_instance(const SkipFacts& facts) { return facts.instances < 2 ? "one instance" : nullptr; }
const char* no_local_lights(const SkipFacts& facts) {
    return facts.local_lights == 0 ? "no point or spot lights" : nullptr;
}
const char* no_listed_lights(const SkipFacts& facts) { return facts.lists_lights ? no_local_lights(facts) : nullptr; }
const char* lists_many(const SkipFacts& facts) {
    if (!facts.lists_lights) return "the path has none";
    return facts.local_lights > kFewLights && facts.listed_share < kSmallShare ? "lists leave out most" : nullptr;
}

// The skips that are not here cost a test on the CPU, or nothing.
constexpr Doubtful kDoubtful[] = {
    {Skip::occlusion, "waits for the depth of what was seen before", one_instance, never},
    {Skip::sort, "orders instances on the CPU in each frame", one_instance, never},
    {Skip::light_lists, "makes lists before a light is shaded", no_listed_lights, lists_many},
    {Skip::light_depth, "finds the depths of tiles, or marks the stencil, before a light is shaded", no_local_lights,
     never},
    {Skip::background, "tests the depth of every pixel", never, never},
    {Skip::backface, "changes states between materials", never, never},
};

std::string percent(double ratio) {
    return fmt::format("{:.1f} % {} with it", 100.0 * std::abs(ratio - 1.0), ratio > 1.0 ? "slower" : "faster");
}

std::string joined(const char* what, const std::vector<std::string>& parts) {
    return parts.empty() ? "" : fmt::format("{}: {}", what, fmt::join(parts, ", "));
}

double listed_share(const Arm& arm) {
    const LightListService* service = arm.path().light_lists();
    const auto& data = arm.frame().data;
    if (service == nullptr || data.light_count == data.directional_count) return 0.0;
    const LightLists lists = service->read();
    return static_cast<double>(lists.indices.size()) /
           (static_cast<double>(lists.cells.size()) * (data.light_count - data.directional_count));
}

// The arms that trials draw with, made when they are first asked for.
class Trials {
  public:
    Trials(const CellParams& cell, const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes)
        : cell_(cell), subject_(&subject), buffers_(&buffers), shapes_(&shapes) {}

    int64_t frame_ns(SkipSet skips) { return arm(skips).frame_ns; }
    double share_listed(SkipSet skips) { return listed_share(*arm(skips).arm); }

    std::optional<SkipTrial> operator()(SkipSet with, SkipSet without) {
        if (now_ns() - start_ns_ > kEnoughNs) return {};
        try {
            std::erase_if(arms_, [&](const auto& entry) { return entry.first != with.text(); });
            WarmArm& a = arm(with);
            auto fresh = make(without);
            if (a.arm->work_key() == fresh->work_key()) return SkipTrial{.same_work = true, .ratio = {}};
            WarmArm& b = arms_[without.text()] = warm(std::move(fresh));
            return SkipTrial{.ratio = try_pair(*a.arm, *b.arm, 1.0 + kSkipMustSave)};
        } catch (const InputError&) {
            return {};
        } catch (const EnvironmentError&) {
            return {};
        }
    }

  private:
    struct WarmArm {
        std::unique_ptr<Arm> arm;
        int64_t frame_ns = 0;  ///< of one frame
    };

    // With its first frame.
    std::unique_ptr<Arm> make(SkipSet skips) {
        cell_.skip = skips.text();
        auto arm = std::make_unique<Arm>(cell_, *subject_, *buffers_, *shapes_);
        arm->draw();
        return arm;
    }
    static WarmArm warm(std::unique_ptr<Arm> arm) {
        WarmArm result{.arm = std::move(arm)};
        for (int frame = 0; frame < kFramesToSettle; ++frame) {
            const int64_t start = now_ns();
            result.arm->draw();
            result.frame_ns = now_ns() - start;
        }
        return result;
    }
    WarmArm& arm(SkipSet skips) {
        const auto found = arms_.find(skips.text());
        if (found != arms_.end()) return found->second;
        WarmArm made = warm(make(skips));  // may throw
        return arms_[skips.text()] = std::move(made);
    }

    CellParams cell_;
    const Subject* subject_;
    FrameBuffers* buffers_;
    const DrawShapes* shapes_;
    std::map<std::string, WarmArm> arms_;  ///< by SkipSet::text()
    int64_t start_ns_ = now_ns();
};

}  // namespace

SkipChoice choose_skips(const SkipFacts& facts, const TrySkip& try_skip) {
    SkipSet skips = SkipSet::all();
    SkipChoice choice;
    std::vector<std::string> off, kept;
    for (const auto& doubtful : kDoubtful) {
        const std::string key(skip_key(doubtful.skip));
        if (const char* reason = doubtful.pointless(facts)) {
            off.push_back(fmt::format("{} ({})", key, reason));
            skips = skips.without(doubtful.skip);
            continue;
        }
        if (const char* reason = doubtful.surely_worth_it(facts)) {
            kept.push_back(fmt::format("{} ({})", key, reason));
            continue;
        }
        const auto trial = try_skip(skips, skips.without(doubtful.skip));
        if (!trial || trial->same_work) continue;
        const Interval& ratio = trial->ratio;
        choice.tried_ratio[key] = ratio.estimate;
        const bool slower = ratio.estimate > 1.0 + kSkipMustSave, surely = ratio.low.value_or(0.0) > 1.0;
        if (slower && surely) {
            off.push_back(fmt::format("{} ({}: {})", key, doubtful.cost, percent(ratio.estimate)));
            skips = skips.without(doubtful.skip);
        } else {
            kept.push_back(fmt::format("{} ({}{})", key, percent(ratio.estimate), slower ? ", not surely" : ""));
        }
    }
    choice.skip = skips.text();
    choice.why = joined("off", off) + (off.empty() || kept.empty() ? "" : "; ") + joined("kept", kept);
    if (choice.why.empty()) choice.why = "nothing to choose";
    return choice;
}

SkipChoice choose_skips(const CellParams& cell, const Subject& subject, FrameBuffers& buffers,
                        const DrawShapes& shapes) {
    Trials trials(cell, subject, buffers, shapes);
    const SkipFacts facts{.instances = subject.scene.needs().instances,
                          .local_lights = static_cast<size_t>(std::ranges::count_if(
                              subject.lights, [](const Light& l) { return l.kind != LightKind::directional; })),
                          .lists_lights = find_path(cell.path).uses_light_lists,
                          .listed_share = trials.share_listed(SkipSet::all())};
    const int64_t frame_ns = trials.frame_ns(SkipSet::all());
    if (frame_ns <= kLongFrameNs) return choose_skips(facts, std::ref(trials));
    SkipChoice choice = choose_skips(facts, [](SkipSet, SkipSet) { return std::optional<SkipTrial>(); });
    choice.why += fmt::format("; a frame takes {:.2g} s: nothing was tried", static_cast<double>(frame_ns) * 1e-9);
    return choice;
}

}  // namespace lightsweep
