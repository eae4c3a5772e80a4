// S15: two parallel tilted planes, one a small gap behind the other as seen from the eye, over the same pixels. The
// farther one is drawn first: where the depth buffer cannot tell them apart, it stays, and the pixel is wrong.
#include "bench/stress/case.h"
#include "bench/stress/depth_law.h"
#include "bench/stress/parameter_grid.h"
#include "bench/stress/test_scenes.h"
#include "renderer/reference/view.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr std::string_view kDistanceAxis = "distance";
constexpr int kSide = 48;
constexpr double kEasyGap = 1e-1, kHardGap = 1e-8;  // of the distance
constexpr double kNear = 0.05, kFar = 1e5;

// Between the depth of a point and of a pixel of a triangle, in roundings of kFloatUnit: the position (three products,
// three sums), z and w (four each), and a weighted sum of three vertices whose depths are up to twice the pixel's.
constexpr double kRoundings = 6.0 + 8.0 + 2.0 * 3.0;

const glm::dvec3 kTiltAxis = glm::normalize(glm::dvec3(1.0, 0.3, 0.0));
constexpr double kTilt = 0.5;  // radians

// Pairs of planes for every gap, side by side, far enough apart that a camera sees one pair alone.
class Layers {
  public:
    explicit Layers(double distance) : distance_(distance) {
        const Geometry quad = make_shape(QuadShape{.size = glm::dvec2(3.0 * distance)});
        Material farther{.name = "farther", .model = ShadingModel::lambert, .base_color = glm::vec3(0.0F)};
        Material nearer = farther;
        nearer.name = "nearer";
        farther.emissive = {0.0F, 1.0F, 0.0F};
        nearer.emissive = {1.0F, 0.0F, 0.0F};
        // Seen from the eye, a plane (1 + gap) times as large is (1 + gap) times as far in every pixel.
        add_instance(scene_, quad, farther, placed(0, 1.0 + gaps_[0]));
        add_instance(scene_, quad, nearer, placed(0, 1.0));
        for (size_t i = 1; i < gaps_.size(); ++i) {
            add_instance(scene_, 0, placed(i, 1.0 + gaps_[i]));
            add_instance(scene_, 1, placed(i, 1.0));
        }
        scene_.camera = camera(0);
    }

    const Scene& scene() const { return scene_; }
    const ParameterGrid& gaps() const { return gaps_; }

    Camera camera(size_t i) const {
        return {
            .eye = eye(i), .target = eye(i) - glm::dvec3(0.0, 0.0, 1.0), .near_distance = kNear, .far_distance = kFar};
    }

    // Of the nearer plane, in each pixel.
    std::vector<double> view_distances() const {
        const View view(camera(0), kSide, kSide);
        const glm::dvec3 normal(glm::rotate(glm::dmat4(1.0), kTilt, kTiltAxis)[2]);
        std::vector<double> distances;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                distances.push_back(-distance_ * normal.z / glm::dot(normal, view.ray(x, y)));
            }
        }
        return distances;
    }

  private:
    glm::dvec3 eye(size_t i) const { return {8.0 * distance_ * static_cast<double>(i), 0.0, 0.0}; }

    glm::dmat4 placed(size_t i, double factor) const {
        const glm::dmat4 from_eye = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -distance_));
        return glm::translate(glm::dmat4(1.0), eye(i)) * glm::scale(glm::dmat4(1.0), glm::dvec3(factor)) *
               glm::rotate(from_eye, kTilt, kTiltAxis);
    }

    double distance_;
    ParameterGrid gaps_{kEasyGap, kHardGap};
    Scene scene_;
};

// The share of pixels whose order is lost. Two depths that differ by `apart` fall on one number of a format with the
// spacing s in a share 1 - apart / s of all cases; what arithmetic adds to each counts as wider spacing. A count of
// pixels scatters by its root.
double lost_share(const DepthLaw& law, const std::vector<double>& distances, double gap) {
    double lost = 0.0;
    for (const double z : distances) {
        const double apart = std::abs(law.depth(z) - law.depth(z * (1.0 + gap)));
        const double arithmetic = law.rasterised_error(z) + kRoundings * kFloatUnit * law.depth(z);
        const double spacing = law.spacing(law.depth(z)) + 2.0 * arithmetic;
        lost += std::max(1.0 - apart / spacing, 0.0);
    }
    return (lost + std::sqrt(lost)) / static_cast<double>(distances.size());
}

std::vector<ArmBlock> arms() {
    return {{{std::string(kPathAxis), {"forward"}},
             {std::string(kDepthAxis), kStressDepths},
             {std::string(kDistanceAxis), {"0.1", "1", "100", "10000"}}}};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const Layers layers(std::stod(arm.get(kDistanceAxis)));
    // In the order of the scene: sorted, the nearer plane would be drawn first, and win where depths are equal.
    const SkipSet skips = SkipSet::all().without(Skip::sort).without(Skip::occlusion);
    const auto drawing = std::make_shared<Drawing>(bench, arm, layers.scene(), kSide, kSide, skips);
    const Layout& layout = drawing->arm().setup().layout;
    const DepthLaw law(layout.depth, layout.convention, gl::ClipDepth::zero_to_one, kNear, kFar);
    return [layers, drawing, law, distances = layers.view_distances()](double gap) {
        const size_t pair = layers.gaps().nearest(gap);
        drawing->set_camera(layers.camera(pair));
        const Image picture = drawing->draw();
        int64_t wrong = 0;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) wrong += picture.pixel(x, y)[0] == 1.0F ? 0 : 1;
        }
        return StressMeasurement{.error = static_cast<double>(wrong) / static_cast<double>(distances.size()),
                                 .law = lost_share(law, distances, layers.gaps()[pair]),
                                 .non_finite = count_non_finite(picture),
                                 .where = fmt::format("{} of {} pixels", wrong, distances.size())};
    };
}

}  // namespace

extern const StressCase stress_coplanar_layers{
    .id = "S15",
    .summary = "two tilted planes a small gap apart, the farther one drawn first",
    .measures = "share of the pixels that do not show the nearer plane",
    .unit = "share",
    .bound = 0.0,
    .bound_source = "the nearer surface hides the farther one",
    .failure = "z-fighting: decals, roads and layers of paint flicker through each other",
    .parameter =
        StressParameter{.name = "gap", .unit = "of the distance", .easy = kEasyGap, .hard = kHardGap, .steps = 8},
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
