#include "bench/explore/explore.h"

#include "bench/measure/cell_error.h"
#include "renderer/base/error.h"
#include "renderer/paths/paths.h"
#include "renderer/post/post.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr size_t kDrawnPerSize = 4;  // combinations of one size that are drawn: those that should err least

/// Draws the scene with any layout, and says how far the picture is from the control's.
class Draftsman {
  public:
    Draftsman(const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes)
        : subject_(subject), buffers_(buffers), shapes_(shapes) {
        control_ = drop_unneeded(load_layout("float32"), subject.scene.needs());
        truth_ = draw(control_);
    }
    const Layout& control() const { return control_; }
    PictureError error(const Layout& layout) { return picture_error(truth_, draw(layout), HdrFlip::leave_out); }

  private:
    Picture draw(const Layout& layout) {
        const PathSetup setup{.needs = subject_.scene.needs(), .layout = layout, .hdr = gl::Format::RGBA32F};
        Path path = find_path("deferred").build(setup);
        post_tone_map.append(path);
        Arm arm(std::move(path), setup, subject_, buffers_, shapes_);
        arm.draw();
        return picture_of(arm.hdr_image());
    }

    const Subject& subject_;
    FrameBuffers& buffers_;
    const DrawShapes& shapes_;
    Layout control_;
    Picture truth_;
};

double number_of(const PictureError& error, std::string_view key) {
    return error.display.value(key).value_or(std::numeric_limits<double>::infinity());
}

Layout without_position(Layout layout, const DepthOption& depth) {
    for (auto& target : layout.targets) {
        std::erase_if(target.fields, [](const StoredField& stored) { return stored.field == Field::position; });
    }
    std::erase_if(layout.targets, [](const LayoutTarget& target) { return target.fields.empty(); });
    layout.key = depth.name();
    layout.depth = depth.format;
    layout.convention = depth.convention;
    return layout;
}

/// One thing to choose, a field's option or the depth's: those worth their bits.
using Choice = std::vector<CostedOption>;

/// A combination: an index into each choice's list of options, in the order of the choices.
struct Combination {
    std::vector<size_t> picks;
    double squared_error = 0.0;
};

// Every combination of the choices' options; errors of different fields are taken to be independent.
std::vector<Combination> combinations(const std::vector<Choice>& choices) {
    std::vector<Combination> all{{}};
    for (const auto& choice : choices) {
        std::vector<Combination> longer;
        for (const auto& begun : all) {
            for (const auto& option : choice) {
                Combination next = begun;
                next.picks.push_back(option.index);
                next.squared_error += option.error * option.error;
                longer.push_back(std::move(next));
            }
        }
        all = std::move(longer);
    }
    return all;
}

void mark_front(std::vector<ExploredLayout>& layouts) {
    std::stable_sort(layouts.begin(), layouts.end(), [](const auto& a, const auto& b) {
        return std::pair(a.bytes_per_px, a.flip_mean) < std::pair(b.bytes_per_px, b.flip_mean);
    });
    double least = std::numeric_limits<double>::infinity();
    for (auto& explored : layouts) {
        explored.on_front = explored.flip_mean < least;
        least = std::min(least, explored.flip_mean);
    }
}

/// The three steps of an exploration.
class Explorer {
  public:
    Explorer(const Subject& subject, const Options& options, FrameBuffers& buffers, const DrawShapes& shapes,
             const ExploreProgress& progress)
        : options_(options), progress_(progress), draftsman_(subject, buffers, shapes) {
        for (size_t f = 0; f < field_names().size(); ++f) {
            const auto field = static_cast<Field>(f);
            if (field == Field::position || !info(field).needed(subject.scene.needs())) continue;
            if (!options.fields.contains(field)) {
                throw InputError(
                    fmt::format("the options have none for '{}', which this scene needs", info(field).name));
            }
            fields_.push_back(field);
        }
    }

    /// Each option alone.
    void judge_options() {
        for (const Field field : fields_) {
            const auto& list = options_.fields.at(field);
            choices_.push_back(judge(
                list, [](const FieldOption& o) { return o.total_bits(); },
                [&](const FieldOption& o) { return with_option(draftsman_.control(), o); }));
        }
        choices_.push_back(judge(
            options_.depths, [](const DepthOption& d) { return 8 * gl::info(d.format).bytes; },
            [&](const DepthOption& d) { return without_position(draftsman_.control(), d); }));
    }

    /// All together: those that fit, by their bytes per pixel, least predicted error first.
    std::map<int, std::vector<ExploredLayout>> combine(int max_bytes) {
        std::map<int, std::vector<ExploredLayout>> by_size;
        for (const auto& combination : combinations(choices_)) {
            std::vector<FieldOption> picked;
            for (size_t f = 0; f < fields_.size(); ++f) {
                picked.push_back(options_.fields.at(fields_[f])[combination.picks[f]]);
            }
            ExploredLayout explored;
            explored.layout = pack("", picked, options_.depths[combination.picks.back()]);
            explored.bytes_per_px = explored.layout.bytes_per_pixel();
            if (explored.bytes_per_px > max_bytes) continue;
            explored.predicted = std::sqrt(combination.squared_error);
            by_size[explored.bytes_per_px].push_back(std::move(explored));
            ++result_.combinations;
        }
        for (auto& [bytes, layouts] : by_size) {
            std::stable_sort(layouts.begin(), layouts.end(),
                             [](const auto& a, const auto& b) { return a.predicted < b.predicted; });
        }
        return by_size;
    }

    /// Of each size, those that should err least, drawn.
    void draw_best(std::map<int, std::vector<ExploredLayout>> by_size) {
        size_t done = 0;
        for (auto& [bytes, layouts] : by_size) {
            progress_(fmt::format("{} bytes per pixel", bytes),
                      static_cast<double>(done++) / static_cast<double>(by_size.size()));
            layouts.resize(std::min(layouts.size(), kDrawnPerSize));
            for (size_t i = 0; i < layouts.size(); ++i) {
                ExploredLayout& explored = layouts[i];
                explored.layout.key = fmt::format("explored_{}_{}", bytes, i + 1);
                const PictureError error = draftsman_.error(explored.layout);
                explored.rmse = number_of(error, "rmse");
                explored.flip_mean = number_of(error, "flip_mean");
                result_.layouts.push_back(std::move(explored));
            }
        }
        mark_front(result_.layouts);
    }

    Exploration take() { return std::move(result_); }

  private:
    template <class Option, class Bits, class MakeLayout>
    Choice judge(const std::vector<Option>& list, Bits bits, MakeLayout make_layout) {
        Choice choice;
        const size_t first = result_.options.size();
        for (size_t i = 0; i < list.size(); ++i) {
            progress_(list[i].name(), static_cast<double>(i) / static_cast<double>(list.size()));
            const double error = number_of(draftsman_.error(make_layout(list[i])), "rmse");
            choice.push_back({.index = i, .bits = bits(list[i]), .error = error});
            result_.options.push_back({.name = list[i].name(), .bits = bits(list[i]), .rmse = error, .kept = false});
        }
        choice = undominated(std::move(choice));
        for (const auto& kept : choice) result_.options[first + kept.index].kept = true;
        return choice;
    }

    const Options& options_;
    const ExploreProgress& progress_;
    Draftsman draftsman_;
    std::vector<Field> fields_;
    std::vector<Choice> choices_;  ///< as fields_, then the depth's
    Exploration result_;
};

}  // namespace

Exploration explore(const Subject& subject, const Options& options, int max_bytes, FrameBuffers& buffers,
                    const DrawShapes& shapes, const ExploreProgress& progress) {
    Explorer explorer(subject, options, buffers, shapes, progress);
    explorer.judge_options();
    auto by_size = explorer.combine(max_bytes);
    if (by_size.empty()) {
        throw InputError(fmt::format("--max-bytes {}", max_bytes),
                         "no combination of the options is that small; a depth buffer alone takes 2 or 4");
    }
    explorer.draw_best(std::move(by_size));
    return explorer.take();
}

}  // namespace lightsweep
