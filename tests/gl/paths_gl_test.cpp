// What must hold for every shading path: it gives forward's image, and light behaves as light does.
#include "tests/gl/fixture.h"

#include <algorithm>
#include <ostream>
#include <random>

namespace lightsweep {
namespace {

// Paths sum the same lights, but the volumes add them in the frame buffer, one rounding per light, and compilers may
// contract differently: a few units of 2^-24 per light, far below these.
constexpr double kRelative = 1e-4, kAbsolute = 1e-5;

struct Case {
    std::string scene, path;
    std::string light_lists{};  // of paths that have them
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " " << c.path << " " << c.light_lists; }

std::string case_name(const testing::TestParamInfo<Case>& info) {
    const Case& c = info.param;
    return c.scene + "_" + c.path + (c.light_lists.empty() ? "" : "_" + c.light_lists);
}

class EveryPath : public testing::TestWithParam<Case> {
  protected:
    EveryPath() : studio(GetParam().scene) { studio.light_lists = GetParam().light_lists; }
    Studio studio;
};

std::vector<Case> every_scene_and_path() {
    std::vector<Case> cases;
    for (const auto& scene : resource_keys("scenes", ".json")) {
        for (const auto& path : path_keys()) {
            if (!find_path(path).uses_light_lists) {
                cases.push_back({scene, path});
                continue;
            }
            for (const auto& builder : list_builder_names()) cases.push_back({scene, path, builder});
        }
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryPath, testing::ValuesIn(every_scene_and_path()), case_name);

TEST_P(EveryPath, EqualsForward) {
    const auto lights = studio.lights(24);
    expect_close(studio.hdr("forward", "", lights), studio.hdr(GetParam().path, "float32", lights), kRelative,
                 kAbsolute, "24 lights", studio.allowance(GetParam().path, lights));
}

TEST_P(EveryPath, ZeroLightsLeaveWhatNeedsNone) {
    const Image image = studio.hdr(GetParam().path, "float32", {});
    expect_close(studio.hdr("forward", "", {}), image, 0.0, 1e-6, "no lights", studio.allowance(GetParam().path, {}));
    auto black = studio.lights(8);
    for (auto& light : black) light.color = glm::dvec3(0.0);
    expect_close(image, studio.hdr(GetParam().path, "float32", black), 0.0, 0.0, "black lights");
}

TEST_P(EveryPath, OrderOfLightsIsOnlyRounding) {
    auto lights = studio.lights(24);
    const Image before = studio.hdr(GetParam().path, "float32", lights);
    std::shuffle(lights.begin(), lights.end(), std::mt19937(7));
    // 24 sums of positive terms: each ordering is within 24 roundings of the exact sum (two, where blending truncates).
    expect_close(before, studio.hdr(GetParam().path, "float32", lights), 2 * 2 * 24 * 0x1p-24, 1e-9, "shuffled");
}

TEST_P(EveryPath, AHalfTwiceIsAWhole) {
    const auto lights = studio.lights(6);
    std::vector<Light> halves;
    for (Light light : lights) {
        light.color *= 0.5;  // exact
        halves.push_back(light);
        halves.push_back(light);
    }
    expect_close(studio.hdr(GetParam().path, "float32", lights), studio.hdr(GetParam().path, "float32", halves),
                 2 * 2 * 12 * 0x1p-24, 1e-9, "split");
}

TEST_P(EveryPath, MoreLightIsNeverDarker) {
    const Image few = studio.hdr(GetParam().path, "float32", studio.lights(3));
    auto lights = studio.lights(3);
    Light lamp = lights.front();
    lamp.position = studio.scene().camera.eye;
    lamp.radius = 0.5 * studio.scene().camera.far_distance;  // the camera is inside its volume
    lamp.color = glm::dvec3(5.0);
    lights.push_back(lamp);
    const Image more = studio.hdr(GetParam().path, "float32", lights);
    size_t brighter = 0;
    for (size_t i = 0; i < few.rgb.size(); ++i) {
        EXPECT_GE(more.rgb[i], few.rgb[i] * (1.0F - 1e-5F)) << "value " << i;
        if (more.rgb[i] > few.rgb[i]) ++brighter;
    }
    EXPECT_GT(brighter, few.rgb.size() / 20) << "the lamp at the camera lights what the camera sees";
    expect_close(studio.hdr("forward", "", lights), more, kRelative, kAbsolute, "camera inside a volume",
                 studio.allowance(GetParam().path, lights));
}

class EveryScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, EveryScene, testing::ValuesIn(resource_keys("scenes", ".json")),
                         [](const auto& c) { return c.param; });

TEST_P(EveryScene, PositionFromDepthIsTheInterpolatedOne) {
    Studio studio(GetParam());
    studio.width = 131;  // odd sizes: a ray that is half a pixel off shows here
    studio.height = 77;
    const auto stored = studio.view("position", "float32"), rebuilt = studio.view("position", "oct32");
    const auto z = studio.view("depth", "float32");
    const Camera& camera = studio.scene().camera;
    // The rebuilt position lies on the pixel's ray. A device may interpolate over vertices snapped to 1/256 px
    // (GL_SUBPIXEL_BITS 8), and be that far off it; in 32 bits slivers are off by less.
    const double pixel = 2.0 * std::tan(glm::radians(camera.fov_y_deg) / 2.0) / studio.height;
    for (size_t i = 0; i < stored.rgb.size(); ++i) {
        const double distance = std::abs(static_cast<double>(z.rgb[i]));
        ASSERT_NEAR(stored.rgb[i], rebuilt.rgb[i], distance * (pixel / 256.0 + 2e-6) + 1e-6) << "value " << i;
    }
}

TEST(LightVolumes, CameraThroughTheSurface) {
    // The volume's surface passes through the camera and the near plane; one larger than the far distance is cut by it.
    Studio studio("cornell");
    const Camera& camera = studio.scene().camera;
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    Light lamp;
    lamp.color = glm::dvec3(3.0);
    for (const double radius : {0.5, 3.0, 3.0 * camera.far_distance}) {
        for (const double offset : {-1.01, -1.0, -0.99, 0.0, 0.97, 1.0, 1.03}) {
            lamp.radius = radius;
            lamp.position = camera.eye + forward * (camera.near_distance + offset * radius);
            expect_close(studio.hdr("forward", "", {lamp}), studio.hdr("deferred_volumes", "float32", {lamp}),
                         kRelative, kAbsolute,
                         "radius " + std::to_string(radius) + " offset " + std::to_string(offset));
        }
    }
}

TEST(Lights, NothingAtAndPastTheRadius) {
    Studio studio("cornell");
    const auto position = studio.view("position", "float32");
    const glm::dvec3 eye = studio.scene().camera.eye;
    Light lamp;
    lamp.position = eye;
    lamp.color = glm::dvec3(1e6);
    const float* p = position.pixel(kTestWidth / 2, kTestHeight / 2);
    const double distance = glm::length(glm::dvec3(p[0], p[1], p[2]));
    lamp.radius = distance * 0.9999;
    const Image without = studio.hdr("forward", "", {});
    const Image just_short = studio.hdr("forward", "", {lamp});
    lamp.radius = distance * 1.1;
    const Image reaching = studio.hdr("forward", "", {lamp});
    const auto centre = [](const Image& image) { return image.pixel(kTestWidth / 2, kTestHeight / 2)[0]; };
    EXPECT_EQ(centre(without), centre(just_short));
    EXPECT_GT(centre(reaching), centre(without));
}

TEST(Camera, FarFromTheOriginIsTheSamePicture) {
    // Camera-relative rendering: moving everything by 1e5 units changes nothing but the rounding of the move itself.
    SceneStore scenes;
    Scene scene = scenes.scene("spheres");
    Scene moved = scene;
    const glm::dvec3 shift(131072.0, -65536.0, 262144.0);
    for (auto& instance : moved.instances) instance.transform[3] += glm::dvec4(shift, 0.0);
    moved.camera.eye += shift;
    moved.camera.target += shift;
    auto lights = make_lights(scene, 12, {});
    auto moved_lights = lights;
    for (auto& light : moved_lights) light.position += shift;
    FrameBuffers buffers;
    const DrawShapes shapes;
    CellParams cell;
    cell.path = "deferred";
    cell.layout = "float32";
    cell.hdr = "rgba32f";
    const auto draw = [&](const Scene& s, const std::vector<Light>& l) {
        const GpuScene gpu(s, scene_needs(s));
        const Subject subject{gpu, l, kTestWidth, kTestHeight};
        Arm arm(cell, subject, buffers, shapes);
        arm.draw();
        return arm.hdr_image();
    };
    const Image near = draw(scene, lights), far = draw(moved, moved_lights);
    size_t different = 0;  // a pixel on an edge may fall to the other side
    for (size_t i = 0; i < near.rgb.size(); ++i) {
        if (std::abs(near.rgb[i] - far.rgb[i]) > 1e-3F * near.rgb[i] + 1e-4F) ++different;
    }
    EXPECT_LT(different, near.rgb.size() / 500);
}

}  // namespace
}  // namespace lightsweep
