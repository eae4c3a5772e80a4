// What the GL tests share: pictures of cells, made the way the program makes them.
#pragma once

#include "bench/measure/arm.h"
#include "bench/measure/scene_store.h"
#include "bench/plan/cell.h"
#include "renderer/base/resources.h"
#include "renderer/paths/paths.h"
#include "renderer/paths/view.h"
#include "renderer/post/post.h"
#include "tests/gl/moved_attributes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace lightsweep {

inline constexpr int kTestWidth = 160, kTestHeight = 90;

/// Draws cells of one scene at a small size.
class Studio {
  public:
    explicit Studio(const std::string& scene_key) : key_(scene_key), scene_(scenes_.scene(scene_key)) {}

    const Scene& scene() { return scene_; }
    std::vector<Light> lights(int count) { return make_lights(scene_, count, {scene_.lights.default_overlap}); }

    Image hdr(const std::string& path, const std::string& layout, const std::vector<Light>& lights,
              const std::string& hdr_format = "rgba32f") {
        CellParams cell;
        cell.scene = key_;
        cell.path = path;
        cell.layout = find_path(path).uses_layout ? layout : "";
        cell.light_lists = find_path(path).uses_light_lists ? light_lists : "";
        cell.hdr = hdr_format;
        const Subject subject{scenes_.gpu_scene(key_), lights, width, height};
        Arm arm(cell, subject, buffers_, shapes_);
        arm.draw();
        return arm.hdr_image();
    }

    /// By how much `path` may differ from forward beside roundings of its sums: nothing when it samples the same
    /// texels.
    Image allowance(const std::string& path, const std::vector<Light>& lights) {
        if (path != "visibility") return {};
        return attribute_movement(std::max(width, height),
                                  [&](const ReplacedText& replaced) { return forward(lights, replaced); });
    }

    /// The values of one buffer as it comes back out of a layout.
    Image view(const std::string& name, const std::string& layout_key) {
        const Subject subject{scenes_.gpu_scene(key_), {}, width, height};
        const SceneNeeds& needs = subject.scene.needs();
        const PathSetup setup{
            .needs = needs, .layout = drop_unneeded(load_layout(layout_key), needs), .hdr = gl::Format::RGBA32F};
        Arm arm(build_view(name, setup), setup, subject, buffers_, shapes_);
        arm.draw();
        return arm.hdr_image();
    }

    int width = kTestWidth, height = kTestHeight;
    std::string light_lists = "cpu";  ///< what builds them, for paths that have them

  private:
    Image forward(const std::vector<Light>& lights, const ReplacedText& replaced) {
        const Subject subject{scenes_.gpu_scene(key_), lights, width, height};
        const SceneNeeds& needs = subject.scene.needs();
        const PathSetup setup{.needs = needs, .layout = load_layout("float32"), .hdr = gl::Format::RGBA32F};
        Path path = find_path("forward").build(setup);
        for (auto& pass : path.passes) pass.shader.replaced = replaced;
        post_tone_map.append(path);
        Arm arm(std::move(path), setup, subject, buffers_, shapes_);
        arm.draw();
        return arm.hdr_image();
    }

    std::string key_;
    SceneStore scenes_;
    const Scene& scene_;
    FrameBuffers buffers_;
    DrawShapes shapes_;
};

/// Every channel of `test` is within relative * |reference| + absolute of `reference`, and finite where that is.
/// `allowance`: of each value besides; empty for none.
inline void expect_close(const Image& reference, const Image& test, double relative, double absolute,
                         const std::string& what, const Image& allowance = {}) {
    ASSERT_EQ(reference.rgb.size(), test.rgb.size());
    ASSERT_TRUE(allowance.rgb.empty() || allowance.rgb.size() == test.rgb.size());
    size_t wrong = 0, worst = 0;
    double worst_excess = 0.0;
    for (size_t i = 0; i < reference.rgb.size(); ++i) {
        const double r = static_cast<double>(reference.rgb[i]), t = static_cast<double>(test.rgb[i]);
        const double allowed = allowance.rgb.empty() ? 0.0 : static_cast<double>(allowance.rgb[i]);
        const double excess = std::abs(t - r) - (relative * std::abs(r) + absolute + allowed);
        if (std::isfinite(r) && std::isfinite(t) && excess <= 0.0) continue;
        ++wrong;
        if (!(excess <= worst_excess)) {
            worst_excess = excess;
            worst = i;
        }
    }
    EXPECT_EQ(wrong, 0U) << what << ": " << wrong << " of " << test.rgb.size()
                         << " values are off; the worst at pixel (" << worst / 3 % static_cast<size_t>(test.width)
                         << ", " << worst / 3 / static_cast<size_t>(test.width) << "): " << reference.rgb[worst]
                         << " became " << test.rgb[worst];
}

}  // namespace lightsweep
