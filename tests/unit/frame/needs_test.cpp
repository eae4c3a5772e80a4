// scene_needs: each flag is raised by a scene that has just that, and by nothing that no instance shows.
#include "renderer/frame/needs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lightsweep {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;

// Two instances of a mesh of three triangles, plain Lambert, under a black sky without lights.
Scene plain_scene() {
    Scene scene;
    scene.materials.push_back({.name = "plain", .model = ShadingModel::lambert});
    scene.meshes.push_back({.name = "mesh", .index_count = 9, .bounds = {}});
    scene.instances.resize(2);
    return scene;
}

std::set<std::string> flags(const SceneNeeds& needs) {
    std::set<std::string> result;
    visit_needs(needs, [&](std::string_view name, auto value) {
        if constexpr (std::is_same_v<decltype(value), bool>) {
            if (value) result.insert(std::string(name));
        }
    });
    return result;
}

const std::set<std::string> kPlainFlags{"lambert", "single_sided"};

struct Change {
    std::string name;
    std::function<void(Scene&, Material&)> apply;
    std::set<std::string> added;
    std::set<std::string> removed{};
};

std::vector<Change> changes() {
    const auto light = [](LightKind kind) {
        return [kind](Scene& scene, Material&) { scene.lights.fixed.push_back({.kind = kind}); };
    };
    const auto generator = [](double spot_share) {
        return [spot_share](Scene& scene, Material&) {
            scene.lights.generator = LightGenerator{.bounds = {}, .spot_share = spot_share};
        };
    };
    return {
        {"nothing", [](Scene&, Material&) {}, {}},
        {"ggx", [](Scene&, Material& m) { m.model = ShadingModel::ggx; }, {"ggx", "roughness"}, {"lambert"}},
        {"metal",
         [](Scene&, Material& m) {
             m.model = ShadingModel::ggx;
             m.metallic = 0.5F;
         },
         {"ggx", "roughness", "metallic"},
         {"lambert"}},
        {"metallic, of a model without", [](Scene&, Material& m) { m.metallic = 0.5F; }, {}},
        {"dull Blinn-Phong",
         [](Scene&, Material& m) { m.model = ShadingModel::blinn_phong; },
         {"blinn_phong", "roughness"},
         {"lambert"}},
        {"Blinn-Phong",
         [](Scene&, Material& m) {
             m.model = ShadingModel::blinn_phong;
             m.specular.g = 0.1F;
         },
         {"blinn_phong", "roughness", "specular"},
         {"lambert"}},
        {"emission", [](Scene&, Material& m) { m.emissive.b = 2.0F; }, {"emissive"}},
        {"base colour texture", [](Scene&, Material& m) { m.base_color_texture = 0; }, {"base_color_textures"}},
        {"metallic-roughness texture",
         [](Scene&, Material& m) { m.metallic_roughness_texture = 0; },
         {"metallic_roughness_textures"}},
        {"normal texture", [](Scene&, Material& m) { m.normal_texture = 0; }, {"normal_textures"}},
        {"emissive texture, all black", [](Scene&, Material& m) { m.emissive_texture = 0; }, {}},
        {"emissive texture",
         [](Scene&, Material& m) {
             m.emissive_texture = 0;
             m.emissive.r = 1.0F;
         },
         {"emissive", "emissive_textures"}},
        {"mask", [](Scene&, Material& m) { m.alpha_cutoff = 0.5F; }, {"alpha_masks"}},
        {"double-sided", [](Scene&, Material& m) { m.double_sided = true; }, {"double_sided"}, {"single_sided"}},
        {"sun", light(LightKind::directional), {"directional_lights"}},
        {"point", light(LightKind::point), {"local_lights"}},
        {"spot", light(LightKind::spot), {"local_lights", "spot_lights"}},
        {"generated points", generator(0.0), {"local_lights"}},
        {"generated spots", generator(0.1), {"local_lights", "spot_lights"}},
        {"ambient", [](Scene& scene, Material&) { scene.ambient.r = 0.01; }, {"ambient"}},
        {"background", [](Scene& scene, Material&) { scene.background.g = 0.01; }, {"background"}},
    };
}

TEST(SceneNeeds, EachFlagIsRaisedByJustWhatItSays) {
    std::set<std::string> raised;
    for (const Change& change : changes()) {
        Scene scene = plain_scene();
        change.apply(scene, scene.materials[0]);
        std::set<std::string> expected = kPlainFlags;
        for (const auto& flag : change.removed) expected.erase(flag);
        expected.insert(change.added.begin(), change.added.end());
        EXPECT_EQ(flags(scene_needs(scene)), expected) << change.name;
        raised.insert(expected.begin(), expected.end());
    }
    size_t count = 0;
    visit_needs(SceneNeeds{}, [&](std::string_view, auto value) { count += std::is_same_v<decltype(value), bool>; });
    EXPECT_EQ(raised.size(), count) << "a flag that nothing above raises";
}

TEST(SceneNeeds, MaterialsOfNoInstanceCountForNothing) {
    Scene scene = plain_scene();
    Material busy{.name = "busy", .model = ShadingModel::ggx};
    busy.metallic = 1.0F;
    busy.emissive = glm::vec3(1.0F);
    busy.base_color_texture = busy.normal_texture = 0;
    busy.alpha_cutoff = 0.5F;
    busy.double_sided = true;
    scene.materials.push_back(busy);
    scene.meshes.push_back({.name = "unused", .index_count = 3, .material = 1, .bounds = {}});
    EXPECT_EQ(flags(scene_needs(scene)), kPlainFlags);
    scene.instances.push_back({.mesh = 1});
    EXPECT_THAT(flags(scene_needs(scene)), IsSupersetOf({"lambert", "single_sided", "ggx", "metallic", "emissive",
                                                         "normal_textures", "alpha_masks", "double_sided"}));
}

TEST(SceneNeeds, CountInstancesAndTheirTriangles) {
    std::map<std::string, uint64_t> counts;
    visit_needs(scene_needs(plain_scene()), [&](std::string_view name, auto value) {
        if constexpr (std::is_same_v<decltype(value), uint64_t>) counts[std::string(name)] = value;
    });
    EXPECT_EQ(counts, (std::map<std::string, uint64_t>{{"instances", 2}, {"triangles", 6}}));
}

TEST(SceneNeeds, BaseIsWhatNoPointOrSpotBrings) {
    for (const Change& change : changes()) {
        Scene scene = plain_scene();
        change.apply(scene, scene.materials[0]);
        bool expected = false;
        for (const char* flag : {"emissive", "directional_lights", "ambient", "background"}) {
            expected |= change.added.contains(flag);
        }
        EXPECT_EQ(scene_needs(scene).base(), expected) << change.name;
    }
}

TEST(SceneNeeds, OnlyModelIsTheFirstOfTheScene) {
    for (int model = 0; model < kShadingModelCount; ++model) {
        Scene scene = plain_scene();
        scene.materials[0].model = static_cast<ShadingModel>(model);
        const std::string define = "ONLY_MODEL " + std::to_string(model) + "u";
        EXPECT_THAT(scene_needs(scene).defines(), Contains(define));
        EXPECT_THAT(scene_needs(scene).defines(), Not(Contains("MULTIPLE_MODELS")));
        EXPECT_THAT(scene_needs(scene).with_all_code().defines(), Contains(define));
        EXPECT_THAT(scene_needs(scene).with_all_code().defines(), Contains("MULTIPLE_MODELS"));
    }
    Scene empty = plain_scene();
    empty.instances.clear();
    EXPECT_THAT(scene_needs(empty).defines(), IsSupersetOf({"HAS_GGX", "ONLY_MODEL 0u"})) << "a shader needs a model";
}

// Whatever a scene has, the shaders that can do everything can do it, and they are the same ones but for ONLY_MODEL.
TEST(SceneNeeds, AllCodeIsThatOfEveryScene) {
    const auto without_model = [](std::vector<std::string> defines) {
        std::erase_if(defines, [](const std::string& define) { return define.starts_with("ONLY_MODEL"); });
        return defines;
    };
    const auto all = without_model(scene_needs(plain_scene()).with_all_code().defines());
    std::set<std::string> used{"MULTIPLE_MODELS"};
    for (const Change& change : changes()) {
        Scene scene = plain_scene();
        change.apply(scene, scene.materials[0]);
        const SceneNeeds needs = scene_needs(scene);
        const auto own = without_model(needs.defines());
        EXPECT_THAT(all, IsSupersetOf(own)) << change.name;
        EXPECT_EQ(without_model(needs.with_all_code().defines()), all) << change.name;
        used.insert(own.begin(), own.end());
    }
    EXPECT_EQ(used, std::set<std::string>(all.begin(), all.end())) << "code that no scene needs";
}

TEST(SceneNeeds, AllCodeChangesNothingElse) {
    const SceneNeeds plain = scene_needs(plain_scene()), all = plain.with_all_code();
    for (const char* flag :
         {"roughness", "metallic", "specular", "emissive", "local_lights", "ambient", "background"}) {
        EXPECT_THAT(flags(all), Not(Contains(flag)));
    }
    EXPECT_TRUE(all.single_sided);
    EXPECT_EQ(all.instances, plain.instances);
    EXPECT_EQ(all.triangles, plain.triangles);
}

}  // namespace
}  // namespace lightsweep
