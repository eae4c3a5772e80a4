// Every scene in scenes/ loads, is deterministic and sound; a new one is covered as soon as it exists.
#include "renderer/base/resources.h"
#include "renderer/scene/scene.h"
#include "tests/unit/scene/scene_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightsweep {
namespace {

class ShippedScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(resource_keys("scenes", ".json")),
                         [](const auto& each) { return each.param; });

TEST_P(ShippedScene, LoadsTheSameTwice) {
    const Scene a = load_scene(GetParam());
    const Scene b = load_scene(GetParam());
    EXPECT_EQ(a.key, GetParam());
    EXPECT_FALSE(a.summary.empty());
    EXPECT_THAT(a.warnings, testing::IsEmpty());
    EXPECT_EQ(a.content_hash.size(), 16U);
    EXPECT_EQ(a.content_hash, b.content_hash);
}

TEST_P(ShippedScene, IsSound) {
    const Scene scene = load_scene(GetParam());
    expect_sound_frames(scene.vertices, scene.indices);
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_GT(mesh.index_count, 0U);
        EXPECT_LE(mesh.first_index + mesh.index_count, scene.indices.size());
        EXPECT_LT(mesh.material, scene.materials.size());
        EXPECT_FALSE(mesh.bounds.empty());
    }
    for (const Instance& instance : scene.instances) EXPECT_LT(instance.mesh, scene.meshes.size());
    for (const Texture& texture : scene.textures) {
        EXPECT_EQ(texture.rgba.size(), 4U * static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height));
    }
    const auto texture_count = static_cast<int>(scene.textures.size());
    for (const Material& m : scene.materials) {
        for (const int texture :
             {m.base_color_texture, m.metallic_roughness_texture, m.normal_texture, m.emissive_texture}) {
            EXPECT_GE(texture, kNoTexture);
            EXPECT_LT(texture, texture_count);
        }
        if (m.base_color_texture != kNoTexture) {
            EXPECT_TRUE(scene.textures.at(static_cast<size_t>(m.base_color_texture)).srgb);
        }
        if (m.normal_texture != kNoTexture) {
            EXPECT_FALSE(scene.textures.at(static_cast<size_t>(m.normal_texture)).srgb);
        }
    }
}

TEST_P(ShippedScene, GivesAsManyLightsAsAskedFor) {
    const Scene scene = load_scene(GetParam());
    EXPECT_GT(scene.lights.default_count, 0);
    for (const int count : {0, 1, 16, 1024}) {
        EXPECT_EQ(make_lights(scene, count, {scene.lights.default_overlap}).size(), static_cast<size_t>(count));
    }
}

TEST_P(ShippedScene, LiesWithinTheCamerasReach) {
    const Scene scene = load_scene(GetParam());
    const Bounds bounds = scene.world_bounds();
    const double farthest =
        glm::length(glm::max(glm::abs(bounds.low - scene.camera.eye), glm::abs(bounds.high - scene.camera.eye)));
    EXPECT_LT(farthest, scene.camera.far_distance * 1.5) << "the far plane cuts nothing that matters";
    EXPECT_LT(scene.camera.near_distance * 1000.0, scene.camera.far_distance * 100.0);
}

TEST(ShippedScenes, CornellIsABoxOfFiveWallsAndTwoBlocks) {
    const Scene scene = load_scene("cornell");
    EXPECT_EQ(scene.triangle_count(), 5U * 2U + 2U * 12U);
    EXPECT_EQ(scene.lights.generator->placement, Placement::grid);
    EXPECT_EQ(scene.lights.default_overlap, 0.0);
}

TEST(ShippedScenes, SpheresVaryRoughnessAndMetallic) {
    const Scene scene = load_scene("spheres");
    ASSERT_EQ(scene.instances.size(), 65U);
    const auto material = [&](size_t sphere) {
        return scene.materials.at(scene.meshes.at(scene.instances.at(1 + sphere).mesh).material);
    };
    EXPECT_FLOAT_EQ(material(0).roughness, 0.08F);
    EXPECT_FLOAT_EQ(material(7).roughness, 1.0F);
    EXPECT_FLOAT_EQ(material(7).metallic, 0.0F);
    EXPECT_FLOAT_EQ(material(63).metallic, 1.0F);
    EXPECT_FLOAT_EQ(material(8).metallic, 1.0F / 7.0F);
    EXPECT_EQ(scene.vertices.size(), 25U * 49U + 4U) << "all spheres share one geometry";
}

TEST(ShippedScenes, AtriumIsLarge) {
    const uint64_t triangles = load_scene("atrium").triangle_count();
    EXPECT_GT(triangles, 225'000U);
    EXPECT_LT(triangles, 275'000U);
}

TEST(ShippedScenes, OverdrawIsDrawnBackToFront) {
    const Scene scene = load_scene("overdraw");
    EXPECT_GE(scene.instances.size(), 12U);
    for (size_t i = 1; i < scene.instances.size(); ++i) {
        const glm::dvec3 nearer(scene.instances[i].transform[3]);
        const glm::dvec3 farther(scene.instances[i - 1].transform[3]);
        EXPECT_LT(glm::length(scene.camera.eye - nearer), glm::length(scene.camera.eye - farther));
    }
}

TEST(ShippedScenes, MaterialsShowsEveryKindOfSurface) {
    const Scene scene = load_scene("materials");
    std::vector<bool> models(kShadingModelCount);
    bool masked = false, emissive = false, normal_mapped = false, from_luminance = false;
    for (const Material& m : scene.materials) {
        models.at(static_cast<size_t>(m.model)) = true;
        masked |= m.alpha_cutoff > 0.0F;
        emissive |= m.emissive != glm::vec3(0.0F);
        normal_mapped |= m.normal_texture != kNoTexture;
        from_luminance |= m.specular_from_luminance;
        if (m.model == ShadingModel::blinn_phong) {
            EXPECT_TRUE(m.specular.r == m.specular.g && m.specular.g == m.specular.b)
                << m.name << ": layouts keep one specular value";
        }
    }
    EXPECT_THAT(models, testing::Each(true));
    EXPECT_TRUE(masked && emissive && normal_mapped && from_luminance);
}

TEST(ShippedScenes, UnknownNameGetsTheNearestOne) {
    EXPECT_THAT(input_error([] { load_scene("cornel"); }), testing::HasSubstr("did you mean 'cornell'?"));
}

}  // namespace
}  // namespace lightsweep
