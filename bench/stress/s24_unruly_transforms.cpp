// S24: a sphere under transforms that real scenes hold: tiny, huge, flattened, mirrored, sheared, singular.
#include "bench/stress/case.h"
#include "bench/stress/parameter_grid.h"
#include "bench/stress/test_scenes.h"

#include <glm/ext/matrix_transform.hpp>

#include <cmath>
#include <memory>

namespace lightsweep {
namespace {

constexpr std::string_view kTransformAxis = "transform";
constexpr int kSide = 48;
constexpr double kDarkest = 1e-2;  // a hundredth of what is lit
constexpr double kMostRatio = 1e6;

glm::dmat4 turned() { return glm::rotate(glm::dmat4(1.0), 0.9, glm::normalize(glm::dvec3(0.7, 0.5, -0.3))); }

// So coarse that pixels see the triangles at the rim, and with zeros where sines of whole turns leave 1e-17: flattened
// to nothing, those normals have no direction.
Geometry coarse_sphere() {
    Geometry sphere = make_shape(SphereShape{.radius = 1.0, .segments = 12, .rings = 8});
    for (Vertex& vertex : sphere.vertices) {
        for (int k = 0; k < 3; ++k) {
            if (std::abs(vertex.normal[k]) < 1e-6F) vertex.normal[k] = 0.0F;
        }
    }
    return sphere;
}

// Spheres of radius 1 for every ratio, transformed by it, each where a camera sees it alone.
class Spheres {
  public:
    explicit Spheres(std::string transform) : transform_(std::move(transform)) {
        const Material material{.name = "glazed", .base_color = {0.5F, 0.4F, 0.3F}, .roughness = 0.5F};
        add_instance(scene_, coarse_sphere(), material, placed(0));
        for (size_t i = 1; i < ratios_.size(); ++i) add_instance(scene_, 0, placed(i));
        scene_.camera = camera(0);
        scene_.lights.fixed = lights(0);
    }

    const Scene& scene() const { return scene_; }
    const ParameterGrid& ratios() const { return ratios_; }

    Camera camera(size_t i) const {
        return {.eye = place(i) + size(i) * glm::dvec3(0.3, 0.5, 3.0),
                .target = place(i),
                .near_distance = 0.1 * size(i),
                .far_distance = 6.0 * size(i)};
    }

    // A point light that is as bright as at size 1, and a sun, which no size changes.
    std::vector<Light> lights(size_t i) const {
        const glm::dvec3 from = place(i) + size(i) * glm::dvec3(1.5, 1.0, 2.0);
        return {point_light(from, 8.0 * size(i), size(i) * size(i) * glm::dvec3(6.0, 5.0, 4.0)),
                sun({-0.3, -0.8, -0.5}, {1.0, 1.2, 1.4})};
    }

  private:
    // Of the whole sphere, and of the view with it.
    double size(size_t i) const {
        if (transform_ == "small" || transform_ == "singular") return 1.0 / ratios_[i];
        return transform_ == "large" ? ratios_[i] : 1.0;
    }

    // Two neighbours are eight radii apart: where sizes follow the ratios, in steps of at least 2 %, 400 of them out.
    glm::dvec3 place(size_t i) const {
        const bool follows = size(1) != 1.0;
        return {follows ? 400.0 * size(i) : 8.0 * static_cast<double>(i), 0.0, 0.0};
    }

    glm::dmat4 placed(size_t i) const {
        const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), place(i));
        const double flat = 1.0 / ratios_[i];
        if (transform_ == "flat") return moved * turned() * glm::scale(glm::dmat4(1.0), {1.0, 1.0, flat});
        if (transform_ == "mirrored") return moved * turned() * glm::scale(glm::dmat4(1.0), {-1.0, 1.0, flat});
        if (transform_ == "sheared") {
            return moved * turned() * glm::scale(glm::dmat4(1.0), {1.0, 1.0, flat}) * glm::transpose(turned());
        }
        const double thickness = transform_ == "singular" ? 0.0 : size(i);
        return moved * turned() * glm::scale(glm::dmat4(1.0), {size(i), size(i), thickness});
    }

    std::string transform_;
    ParameterGrid ratios_{1.0, kMostRatio};
    Scene scene_;
};

std::vector<ArmBlock> arms() {
    ArmBlock everywhere = every_path();
    everywhere.push_back({std::string(kTransformAxis), {"flat", "singular"}});
    return {everywhere,
            {{std::string(kPathAxis), {"forward", "deferred", "visibility"}},
             {std::string(kLayoutAxis), {"float32"}},
             {std::string(kHdrAxis), {"rgba32f"}},
             {std::string(kTransformAxis), {"small", "large", "mirrored", "sheared"}}}};
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto spheres = std::make_shared<Spheres>(arm.get(kTransformAxis));
    const auto drawing = std::make_shared<Drawing>(bench, arm, spheres->scene(), kSide, kSide);
    return [spheres, drawing](double ratio) {
        const size_t i = spheres->ratios().nearest(ratio);
        drawing->set_camera(spheres->camera(i));
        drawing->set_lights(spheres->lights(i));
        const PictureErrors errors = picture_errors(drawing->reference(), drawing->draw(), kDarkest);
        return StressMeasurement{.error = errors.p999, .non_finite = errors.non_finite, .where = errors.where()};
    };
}

}  // namespace

extern const StressCase stress_unruly_transforms{
    .id = "S24",
    .summary = "a sphere tiny, huge, flattened, mirrored, sheared and flattened to nothing",
    .measures = "p99.9 error of the picture over its brightness",
    .unit = "rel",
    .bound = 0x1p-11,
    .bound_source = "what storing the picture in half floats loses: half a step of 2^-10",
    .failure = "black or speckled objects; light from the wrong side of mirrored or squashed ones",
    .parameter =
        StressParameter{.name = "largest scale over smallest", .unit = "", .easy = 1.0, .hard = kMostRatio, .steps = 7},
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
