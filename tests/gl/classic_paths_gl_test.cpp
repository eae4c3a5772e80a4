// What must hold for the paths that find lights by drawing their bounds (forward_multipass, deferred_scissor,
// deferred_volumes) or sum lights before materials (light_prepass): bounds cut nothing off, wherever light and eye are,
// and leave out what they can.
#include "renderer/base/file.h"
#include "renderer/frame/light_draws.h"
#include "renderer/pass/recorder.h"
#include "tests/gl/fixture.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace lightsweep {
namespace {

// The paths compared evaluate the same formulas on the same numbers: roundings of sums, and of compilers that contract
// differently in front of a narrow cone's edge.
constexpr double kRelative = 1e-4, kAbsolute = 1e-5;

using Record = void (*)(Recorder&);

/// Draws one scene, at an odd size, with lights that change from picture to picture.
class Rig {
  public:
    explicit Rig(const std::string& scene_key)
        : scene_(scenes_.scene(scene_key)),
          gpu_scene_(scenes_.gpu_scene(scene_key)),
          needs_(gpu_scene_.needs()),
          subject_{gpu_scene_, {}, 157, 83} {
        needs_.spot_lights = true;  // whatever the scene's own lights are
    }

    const Scene& scene() const { return scene_; }
    const GpuScene& gpu_scene() const { return gpu_scene_; }
    Layout layout(const std::string& key) const { return drop_unneeded(load_layout(key), needs_); }
    PathSetup setup(const Layout& layout) const {
        return {.needs = needs_, .layout = layout, .hdr = gl::Format::RGBA32F};
    }
    std::unique_ptr<Arm> arm(const std::string& path_key, const Layout& layout) {
        return arm(find_path(path_key).build(setup(layout)), layout);
    }
    std::unique_ptr<Arm> arm(Path path, const Layout& layout) {
        return std::make_unique<Arm>(std::move(path), setup(layout), subject_, buffers_, shapes_);
    }
    Image draw(Arm& arm, const std::vector<Light>& lights) {
        subject_.lights = lights;
        arm.draw();
        return arm.hdr_image();
    }
    uint64_t count_evaluations(const std::string& path_key, const std::vector<Light>& lights) {
        const auto counted = arm(path_key, layout("float32"));
        draw(*counted, lights);
        return counted->count_light_evaluations();
    }

  private:
    SceneStore scenes_;
    const Scene& scene_;
    const GpuScene& gpu_scene_;
    SceneNeeds needs_;
    FrameBuffers buffers_;
    DrawShapes shapes_;
    Subject subject_;
};

// The brute-force path whose numbers a path must give.
std::string plain_twin(const std::string& path) { return find_path(path).uses_layout ? "deferred" : "forward"; }

struct Pose {
    std::string name;
    Light light;
};

// Lights around and in the Cornell box, [-1, 1] x [0, 2] x [-1, 1]; the eye is at (0, 1, 3.88) and looks along -z.
std::vector<Pose> poses(LightKind kind, double outer_deg) {
    const auto pose = [&](const char* name, glm::dvec3 position, glm::dvec3 direction, double radius) {
        return Pose{name,
                    {.kind = kind,
                     .position = position,
                     .direction = glm::normalize(direction),
                     .color = glm::dvec3(50.0),
                     .radius = radius,
                     .inner_deg = 0.9 * outer_deg,  // a hard edge: what is cut off there was bright
                     .outer_deg = outer_deg}};
    };
    return {pose("away from the eye", {0.2, 1.1, 0.9}, {-0.3, -0.2, -1.0}, 2.2),
            pose("across", {-0.8, 0.5, 0.0}, {1.0, 0.2, -0.3}, 1.5),
            pose("small", {0.1, 0.3, -0.7}, {0.3, -1.0, -0.4}, 0.45),
            pose("at the eye: inside the volume", {0.0, 1.0, -0.8}, {0.0, 0.0, 1.0}, 6.0),
            pose("in the eye: fills the screen", {0.0, 1.0, 3.88}, {0.0, 0.0, -1.0}, 6.0),
            pose("from behind the eye", {0.1, 1.2, 5.0}, {0.0, -0.05, -1.0}, 8.0),
            pose("behind the eye, away", {0.0, 1.0, 5.0}, {0.0, 0.0, 1.0}, 0.9),
            pose("beside the eye: in the sphere, not in the cone", {0.5, 1.0, 3.3}, {0.3, -0.5, -1.0}, 5.0),
            pose("out of the floor", {0.3, 0.01, 0.0}, {0.1, 1.0, -0.2}, 1.9),
            pose("past the far plane", {0.0, 1.9, 0.0}, {0.1, -1.0, 0.1}, 30.0)};
}

constexpr double kHalfAngles[] = {0.5, 5.0, 30.0, 45.0, 60.0, 75.0, 89.0, 89.99};

std::vector<Pose> every_pose() {
    std::vector<Pose> result = poses(LightKind::point, 45.0);
    for (const double angle : kHalfAngles) {
        for (auto& pose : poses(LightKind::spot, angle)) {
            pose.name += ", a spot of " + std::to_string(angle) + " degrees";
            result.push_back(std::move(pose));
        }
    }
    return result;
}

size_t count_different(const Image& a, const Image& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        const double r = static_cast<double>(a.rgb[i]), t = static_cast<double>(b.rgb[i]);
        if (!(std::abs(t - r) <= kRelative * std::abs(r) + kAbsolute)) ++count;
    }
    return count;
}

class ClassicPath : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Paths, ClassicPath,
                         testing::Values("forward_multipass", "deferred_scissor", "deferred_volumes", "light_prepass"),
                         [](const auto& c) { return c.param; });

TEST_P(ClassicPath, LosesNothingWhereverTheLightIs) {
    Rig rig("cornell");
    const auto plain = rig.arm(plain_twin(GetParam()), rig.layout("float32"));
    const auto tested = rig.arm(GetParam(), rig.layout("float32"));
    const Image dark = rig.draw(*plain, {});
    size_t lit = 0;
    for (const auto& [name, light] : every_pose()) {
        const Image expected = rig.draw(*plain, {light});
        expect_close(expected, rig.draw(*tested, {light}), kRelative, kAbsolute, name);
        lit += count_different(dark, expected) > 0 ? 1 : 0;
    }
    EXPECT_GT(lit, 60U) << "of 90: most poses light something";
}

// Surfaces are not quite where depth says: in half floats, and in fixed-point depth.
class ClassicDeferredPath : public ClassicPath {};
INSTANTIATE_TEST_SUITE_P(Paths, ClassicDeferredPath,
                         testing::Values("deferred_scissor", "deferred_volumes", "light_prepass"),
                         [](const auto& c) { return c.param; });

TEST_P(ClassicDeferredPath, LosesNothingToCoarsePositions) {
    Rig rig("cornell");
    const Layout float32 = rig.layout("float32");
    const auto but_position = keep_fields(float32, std::vector{Field::normal, Field::base_color, Field::roughness,
                                                               Field::metallic, Field::specular, Field::model});
    Layout coarse_position = keep_fields(rig.layout("position_half"), std::vector{Field::position});
    coarse_position.targets.insert(coarse_position.targets.end(), but_position.targets.begin(),
                                   but_position.targets.end());
    ASSERT_GT(position_error(coarse_position), 0.0);
    Layout coarse_depth = but_position;
    coarse_depth.depth = gl::Format::D24;  // deferred_volumes adds a stencil to it, and changes no bit
    coarse_depth.convention = DepthConvention::standard;
    for (const Layout& layout : {coarse_position, coarse_depth}) {
        const auto plain = rig.arm("deferred", layout), tested = rig.arm(GetParam(), layout);
        for (const auto& [name, light] : every_pose()) {
            expect_close(rig.draw(*plain, {light}), rig.draw(*tested, {light}), kRelative, kAbsolute,
                         layout.key + ", " + name);
        }
    }
}

TEST_P(ClassicPath, ManyLightsAreTheirSum) {
    Rig rig("materials");
    const auto plain = rig.arm(plain_twin(GetParam()), rig.layout("float32"));
    const auto tested = rig.arm(GetParam(), rig.layout("float32"));
    const auto lights = make_lights(rig.scene(), 300, {8.0});
    expect_close(rig.draw(*plain, lights), rig.draw(*tested, lights), kRelative, kAbsolute, "300 lights");
}

// --- Faults that these tests must find

struct VolumeFault {
    const char* name;
    const char* right;
    const char* wrong;
};
void PrintTo(const VolumeFault& fault, std::ostream* out) { *out << fault.name; }

const VolumeFault kVolumeFaults[] = {
    {"sphere_not_enclosing", "(light.radius + error) * vertex", "0.94 * (light.radius + error) * vertex"},
    // cos(pi / 10): the polygon's corners on the circle
    {"cone_not_enclosing", "+ profile.y * (", "+ 0.9510565 * profile.y * ("},
    {"lid_too_low", "vec2(1.0, sin_a / (1.0 + cos_a))", "vec2(0.95, sin_a / (1.0 + cos_a))"},
    {"lid_too_narrow", "sin_a / (1.0 + cos_a)", "0.6 * sin_a / (1.0 + cos_a)"},
};

class PlantedVolumeFault : public testing::TestWithParam<VolumeFault> {};
INSTANTIATE_TEST_SUITE_P(Shader, PlantedVolumeFault, testing::ValuesIn(kVolumeFaults),
                         [](const auto& c) { return c.param.name; });

TEST_P(PlantedVolumeFault, IsFound) {
    const char* file = "lib/light_volume.glsl";
    std::string text = read_file(resource(std::string("shaders/") + file));
    const size_t at = text.find(GetParam().right);
    ASSERT_NE(at, std::string::npos) << "the shader no longer says: " << GetParam().right;
    text.replace(at, std::string_view(GetParam().right).size(), GetParam().wrong);
    Rig rig("cornell");
    const Layout layout = rig.layout("float32");
    Path path = find_path("deferred_volumes").build(rig.setup(layout));
    for (auto& pass : path.passes) {
        pass.shader.replaced = {{file, text}};
        for (auto& stage : pass.more_stages) stage.shader.replaced = {{file, text}};
    }
    const auto plain = rig.arm("deferred", layout), faulty = rig.arm(std::move(path), layout);
    size_t found = 0;
    for (const auto& pose : every_pose()) {
        found += count_different(rig.draw(*plain, {pose.light}), rig.draw(*faulty, {pose.light})) > 0 ? 1 : 0;
    }
    EXPECT_GT(found, 0U);
}

enum class Side { left, bottom, right, top };

template <Side side>
void draw_lights_with_a_pixel_less(Recorder& recorder) {
    recorder.bind_full_screen();
    uint32_t light = recorder.frame().data.directional_count;
    for (const auto& bounds : recorder.light_bounds()) {
        PixelRect rect = screen_rect(bounds, recorder.frame().setup);
        rect.x0 += side == Side::left ? 1 : 0;
        rect.y0 += side == Side::bottom ? 1 : 0;
        rect.x1 -= side == Side::right ? 1 : 0;
        rect.y1 -= side == Side::top ? 1 : 0;
        if (!rect.empty()) {
            recorder.set_scissor(rect);
            recorder.draw_light_screen(light);
        }
        ++light;
    }
}

TEST(PlantedScissorFault, APixelTooSmallIsFound) {
    Rig rig("cornell");
    const Layout layout = rig.layout("float32");
    const auto plain = rig.arm("deferred", layout);
    // Close to the far wall: there a light reaches nearly all of its own silhouette.
    std::vector<Light> lights;
    for (int i = 0; i < 40; ++i) {
        lights.push_back({.position = {-0.9 + 0.0463 * i, 0.1 + 0.0457 * (i * 17 % 40), -0.98},
                          .color = glm::dvec3(50.0),
                          .radius = 0.08 + 0.002 * i});
    }
    const Image expected = rig.draw(*plain, lights);
    EXPECT_EQ(count_different(expected, rig.draw(*rig.arm("deferred_scissor", layout), lights)), 0U);
    const std::pair<const char*, Record> faults[] = {{"left", draw_lights_with_a_pixel_less<Side::left>},
                                                     {"bottom", draw_lights_with_a_pixel_less<Side::bottom>},
                                                     {"right", draw_lights_with_a_pixel_less<Side::right>},
                                                     {"top", draw_lights_with_a_pixel_less<Side::top>}};
    for (const auto& [side, record] : faults) {
        Path path = find_path("deferred_scissor").build(rig.setup(layout));
        path.passes.back().record = record;
        EXPECT_GT(count_different(expected, rig.draw(*rig.arm(std::move(path), layout), lights)), 0U) << side;
    }
}

// --- What is left out

TEST(LightDraws, HoldEveryInstanceThatALightTouchesAndFewOthers) {
    Rig rig("atrium");
    const GpuScene& scene = rig.gpu_scene();
    const auto lights = make_lights(rig.scene(), 200, {8.0});
    Frame frame;
    build_frame(scene, lights, {.camera = rig.scene().camera, .width = 157, .height = 83}, frame);
    std::vector<shared::LightBounds> bounds;
    light_bounds(frame, 0.0, bounds);
    const LightDraws lit = make_light_draws(scene, frame, frame.visible, bounds);

    std::vector<std::vector<bool>> drawn(frame.lights.size(), std::vector<bool>(rig.scene().instances.size(), false));
    size_t pairs = 0;
    for (const auto& [light, draw] : lit.draws) {
        for (uint32_t i = 0; i < draw.instance_count; ++i) {
            const uint32_t instance = lit.instances[draw.first_visible + i];
            EXPECT_FALSE(drawn[light][instance]) << "twice";
            drawn[light][instance] = true;
            ++pairs;
        }
    }
    size_t touching = 0;
    for (size_t l = frame.data.directional_count; l < frame.lights.size(); ++l) {
        for (const uint32_t i : frame.visible.instances) {
            const InstanceBounds& sphere = scene.instance_bounds()[i];
            const glm::dvec3 apart = sphere.center - rig.scene().camera.eye - glm::dvec3(frame.lights[l].position);
            // A spot's bounds are smaller than its range; all of these are points.
            ASSERT_EQ(frame.lights[l].spot_scale, 0.0F);
            if (glm::length(apart) > sphere.radius + static_cast<double>(frame.lights[l].radius)) continue;
            ++touching;
            EXPECT_TRUE(drawn[l][i]) << "light " << l << " instance " << i;
        }
    }
    EXPECT_LE(pairs, touching + touching / 100) << "rounding alone";
    EXPECT_LT(pairs, bounds.size() * frame.visible.instances.size() / 4) << "culling leaves out most";
    EXPECT_GT(pairs, 0U);
}

TEST(LightEvaluations, AreOfLitPixelsAndOfNoneWithoutSurface) {
    Rig rig("cornell");  // with background
    const auto lights = make_lights(rig.scene(), 24, {4.0});
    const uint64_t all = rig.count_evaluations("deferred", lights);
    const uint64_t scissor = rig.count_evaluations("deferred_scissor", lights);
    const uint64_t volumes = rig.count_evaluations("deferred_volumes", lights);
    const uint64_t multipass = rig.count_evaluations("forward_multipass", lights);
    EXPECT_EQ(rig.count_evaluations("light_prepass", lights), all);
    EXPECT_LT(scissor, all);
    EXPECT_LT(volumes, scissor);
    EXPECT_LE(multipass, scissor);

    // One light that reaches everything: an evaluation for each covered pixel, in every path.
    Light sun;
    sun.position = rig.scene().camera.eye;
    sun.radius = 3.0 * rig.scene().camera.far_distance;
    const uint64_t covered = rig.count_evaluations("deferred", {sun});
    EXPECT_LT(covered, uint64_t{157 * 83});
    for (const char* path : {"deferred_scissor", "deferred_volumes", "forward_multipass", "light_prepass"}) {
        EXPECT_EQ(rig.count_evaluations(path, {sun}), covered) << path;
    }
}

// --- Light pre-pass

TEST(LightPrepass, KeepsWhatLightsNeedAndOneBufferForEachLobe) {
    Rig rig("materials");
    const auto names = [&](std::array<bool, kShadingModelCount> models, const std::string& layout) {
        PathSetup setup = rig.setup(rig.layout(layout));
        setup.needs.models = models;
        std::vector<std::string> result;
        for (const auto& target : find_path("light_prepass").build(setup).targets) result.push_back(target.name);
        return result;
    };
    const auto buffers = [](const std::vector<std::string>& targets) {
        return std::count_if(targets.begin(), targets.end(),
                             [](const std::string& name) { return name.find(" light") != std::string::npos; });
    };
    EXPECT_EQ(buffers(names({true, false, false}, "float32")), 3) << "GGX";
    EXPECT_EQ(buffers(names({false, true, false}, "float32")), 2) << "Blinn-Phong";
    EXPECT_EQ(buffers(names({false, false, true}, "float32")), 1) << "Lambert";
    EXPECT_EQ(buffers(names({true, true, true}, "float32")), 3);
}

class LightPrepassLayout : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, LightPrepassLayout, testing::ValuesIn(layout_keys()),
                         [](const auto& c) { return c.param; });

// It stores position, normal, roughness and model as the layout says, and reads the rest from the materials: the
// picture of a deferred path whose layout packs those fields alone.
TEST_P(LightPrepassLayout, LosesWhatLightsNeedAlone) {
    Rig rig("materials");
    const Layout layout = rig.layout(GetParam());
    Layout mixed = keep_fields(layout, std::vector{Field::position, Field::normal, Field::roughness, Field::model});
    const Layout exact = keep_fields(rig.layout("float32"),
                                     std::vector{Field::base_color, Field::metallic, Field::specular, Field::emissive});
    mixed.targets.insert(mixed.targets.end(), exact.targets.begin(), exact.targets.end());
    const auto lights = make_lights(rig.scene(), 16, {4.0});
    expect_close(rig.draw(*rig.arm("deferred", mixed), lights), rig.draw(*rig.arm("light_prepass", layout), lights),
                 kRelative, kAbsolute, GetParam());
}

TEST(LightPrepass, AnOverflowingHighlightStaysANumber) {
    // A mirror-like metal without blue, a light whose highlight no half float holds: infinity times zero is no number.
    Rig rig("spheres");
    auto lights = make_lights(rig.scene(), 4, {4.0});
    for (auto& light : lights) light.color *= 1e6;
    for (const auto format : {gl::Format::RGBA16F, gl::Format::R11G11B10F}) {
        PathSetup setup = rig.setup(rig.layout("float32"));
        setup.hdr = format;
        const auto arm = rig.arm(find_path("light_prepass").build(setup), setup.layout);
        const Image image = rig.draw(*arm, lights);
        EXPECT_EQ(std::count_if(image.rgb.begin(), image.rgb.end(), [](float v) { return std::isnan(v); }), 0);
    }
}

}  // namespace
}  // namespace lightsweep
