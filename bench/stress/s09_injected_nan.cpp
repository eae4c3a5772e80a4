// S9: what is no number, in a light or in a vertex. It may spoil the pixels that the light reaches or the triangle
// covers, and no other: those must be what they are without it, bit by bit.
#include "bench/stress/case.h"
#include "bench/stress/test_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

namespace lightsweep {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
constexpr int kSize = 48;
constexpr double kEyeDistance = 4.0;

// Pixels [x0, x1] x [y0, y1], the top row first; none unless said.
struct Box {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
    bool holds(int x, int y) const { return x0 <= x && x <= x1 && y0 <= y && y <= y1; }
};

// Of what is within `reach` of (x, y, z) across the view, in both directions; a pixel more for rounding.
Box box_around(double x, double y, double z, double reach) {
    const double px_per_unit = 0.5 * kSize / ((kEyeDistance - z) * std::tan(glm::radians(30.0)));
    const auto pixel = [&](double place) { return 0.5 * kSize + place * px_per_unit; };
    return {static_cast<int>(std::floor(pixel(x - reach))) - 1, static_cast<int>(std::floor(pixel(-y - reach))) - 1,
            static_cast<int>(std::ceil(pixel(x + reach))) + 1, static_cast<int>(std::ceil(pixel(-y + reach))) + 1};
}

Light sane_light() { return point_light({1.0, 0.5, 2.0}, 20.0, glm::dvec3(8.0)); }

constexpr glm::dvec3 kSpoiltPlace(-1.0, 0.6, 0.5);
constexpr double kSpoiltRadius = 0.8;

struct SpoiltLight {
    std::string_view what;
    Light light;
    Box spoils;  // what the light reaches
};

// A colour that is no number reaches what the light does; a light without a place reaches nothing.
std::vector<SpoiltLight> spoilt_lights() {
    const Light light = point_light(kSpoiltPlace, kSpoiltRadius, glm::dvec3(1.0));
    const Box reached = box_around(kSpoiltPlace.x, kSpoiltPlace.y, 0.0, kSpoiltRadius);
    std::vector<SpoiltLight> lights;
    for (const double bad : {kNan, kInf, -kInf}) {
        lights.push_back({"colour", light, reached});
        lights.back().light.color.g = bad;
        for (int axis = 0; axis < 3; ++axis) {
            lights.push_back({"position", light, {}});
            lights.back().light.position[axis] = bad;
        }
    }
    lights.push_back({"radius", light, {}});
    lights.back().light.radius = kNan;
    lights.push_back(
        {"direction", spot_light(kSpoiltPlace, {0.0, 0.0, -1.0}, kSpoiltRadius, 40.0, glm::dvec3(1.0)), {}});
    lights.back().light.direction.x = kNan;
    return lights;
}

struct SpoiltVertex {
    glm::dvec3 place;
    void (*spoil)(Vertex&);
};
constexpr double kQuadSize = 0.8;
const SpoiltVertex kSpoiltVertices[] = {
    {{-1.2, -1.2, 0.5}, [](Vertex& v) { v.position.x = static_cast<float>(kNan); }},
    {{0.0, -1.2, 0.5}, [](Vertex& v) { v.position = glm::vec3(static_cast<float>(kInf)); }},
    {{1.2, -1.2, 0.5}, [](Vertex& v) { v.normal.y = static_cast<float>(kNan); }},
    {{1.2, 1.2, 0.5}, [](Vertex& v) { v.normal = glm::vec3(static_cast<float>(kInf)); }},
};

Scene scene_of(bool spoilt) {
    const Material material{.name = "surface", .base_color = {0.8F, 0.5F, 0.3F}, .roughness = 0.6F};
    Scene scene = facing_plane(material, 2.0 * kEyeDistance, kEyeDistance);
    for (const SpoiltVertex& vertex : kSpoiltVertices) {
        Geometry quad = make_shape(QuadShape{.size = glm::dvec2(kQuadSize)});
        for (Vertex& v : quad.vertices) v.position += glm::vec3(vertex.place);
        if (spoilt) vertex.spoil(quad.vertices.front());
        add_instance(scene, quad, material);
    }
    declare_light_kinds(scene, true, true, false);
    return scene;
}

// A display shows black for NaN, white for +Inf, and black for -Inf.
bool shows_badly(const Image& hdr, const Image& display, int x, int y) {
    for (int c = 0; c < 3; ++c) {
        const float value = hdr.pixel(x, y)[c];
        if (!std::isfinite(value) && display.pixel(x, y)[c] != (value > 0.0F ? 1.0F : 0.0F)) return true;
    }
    return false;
}

// Counts the pixels that are another than they may be.
template <class MaySpoil>
int64_t spread_pixels(Drawing& spoilt, const Image& clean, const Image& clean_display, MaySpoil may_spoil) {
    const Image hdr = spoilt.draw(), display = spoilt.display();
    int64_t count = 0;
    const auto equal = [&](const Image& a, const Image& b, int x, int y) {
        return std::memcmp(a.pixel(x, y), b.pixel(x, y), 3 * sizeof(float)) == 0;
    };
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const bool changed = !equal(hdr, clean, x, y) || !equal(display, clean_display, x, y);
            if ((changed && !may_spoil(x, y)) || shows_badly(hdr, display, x, y)) ++count;
        }
    }
    return count;
}

StressMeasurement measure(Drawing& clean, Drawing& spoilt) {
    StressMeasurement found;
    const auto add = [&](int64_t pixels, std::string_view what) {
        if (pixels > 0 && found.error == 0.0) found.where = fmt::format("by a {} that is no number", what);
        found.error += static_cast<double>(pixels);
    };
    clean.set_lights({sane_light()});
    const Image picture = clean.draw(), display = clean.display();
    found.non_finite = count_non_finite(picture);

    spoilt.set_lights({sane_light()});
    const auto in_a_quad = [](int x, int y) {
        for (const SpoiltVertex& v : kSpoiltVertices) {
            if (box_around(v.place.x, v.place.y, v.place.z, 0.5 * kQuadSize).holds(x, y)) return true;
        }
        return false;
    };
    add(spread_pixels(spoilt, picture, display, in_a_quad), "vertex");

    for (const SpoiltLight& light : spoilt_lights()) {
        clean.set_lights({light.light, sane_light()});
        const auto reached = [&](int x, int y) { return light.spoils.holds(x, y); };
        add(spread_pixels(clean, picture, display, reached), fmt::format("light's {}", light.what));
    }
    return found;
}

StressTrial begin(Workbench& bench, const StressArm& arm) {
    const auto clean = std::make_shared<Drawing>(bench, arm, scene_of(false), kSize, kSize);
    const auto spoilt = std::make_shared<Drawing>(bench, arm, scene_of(true), kSize, kSize);
    return [clean, spoilt](double) { return measure(*clean, *spoilt); };
}

std::vector<ArmBlock> arms() {
    ArmBlock computed_lists = every_listing_path();
    computed_lists.push_back({std::string(kListsAxis), {"compute"}});
    return {every_path(),
            computed_lists,
            {{std::string(kPathAxis), {"deferred", "deferred_scissor", "light_prepass"}},
             {std::string(kLayoutAxis), {"oct32"}},
             {std::string(kHdrAxis), {"rgba16f", "r11g11b10f"}}}};
}

}  // namespace

extern const StressCase stress_injected_nan;
const StressCase stress_injected_nan{
    .id = "S9",
    .summary = "NaN and Inf in a light's colour, place, radius or axis, and in vertices",
    .measures = "pixels beyond the light's reach or the triangle that change, and pixels not shown black or white",
    .unit = "count",
    .bound = 0.0,
    .bound_source = "what is no number is confined to its own pixels; the display shows none",
    .failure = "black or white rectangles, tiles or whole pictures",
    .arms = arms,
    .begin = begin,
};

}  // namespace lightsweep
