// skip_use: what is called pointless must have nothing to leave out, and each need brings its skips to life.
#include "renderer/frame/skip_needs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace lightsweep {
namespace {

using testing::HasSubstr;

// One instance that shows all that shaders can do, and no point or spot light.
SceneNeeds one_of_everything() {
    SceneNeeds needs = SceneNeeds{}.with_all_code();
    needs.models.fill(true);
    needs.roughness = needs.metallic = needs.specular = needs.emissive = true;
    needs.double_sided = true;
    needs.single_sided = false;
    needs.local_lights = false;
    needs.ambient = needs.background = true;
    needs.instances = 1;
    needs.triangles = 2;
    return needs;
}

std::set<Skip> pointless_in(const SceneNeeds& needs) {
    std::set<Skip> skips;
    for (const auto& info : skip_infos()) {
        if (!skip_use(info.skip, needs).may_help) skips.insert(info.skip);
    }
    return skips;
}

// What `change` makes of the pointless skips of one_of_everything().
template <typename Change>
std::set<Skip> brought_to_life(Change change) {
    SceneNeeds needs = one_of_everything();
    const auto before = pointless_in(needs);
    change(needs);
    std::set<Skip> result;
    for (const Skip skip : before) {
        if (skip_use(skip, needs).may_help) result.insert(skip);
    }
    return result;
}

TEST(SkipNeeds, SayWhyInAFewWordsWhateverTheScene) {
    SceneNeeds nothing;
    nothing.instances = 1'000'000;
    for (const SceneNeeds& needs : {nothing, one_of_everything()}) {
        for (const auto& info : skip_infos()) {
            const SkipUse use = skip_use(info.skip, needs);
            EXPECT_FALSE(use.why.empty()) << info.key;
            EXPECT_LT(use.why.size(), 95U) << info.key;
        }
    }
}

TEST(SkipNeeds, OneInstanceOfEverythingLeavesFourToTheFrame) {
    using enum Skip;
    // Passes, background, clears and cells are left: a frame, a path or a sweep alone can tell.
    EXPECT_EQ(pointless_in(one_of_everything()), (std::set<Skip>{frustum, light_frustum, light_lists, light_depth,
                                                                 occlusion, backface, sort, fields, code}));
}

TEST(SkipNeeds, EachNeedBringsItsSkipsToLife) {
    using enum Skip;
    const auto instances = brought_to_life([](SceneNeeds& needs) { needs.instances = 2; });
    EXPECT_EQ(instances, (std::set<Skip>{frustum, occlusion, sort}));
    const auto lights = brought_to_life([](SceneNeeds& needs) { needs.local_lights = true; });
    EXPECT_EQ(lights, (std::set<Skip>{light_frustum, light_lists, light_depth}));
    const auto sides = brought_to_life([](SceneNeeds& needs) { needs.single_sided = true; });
    EXPECT_EQ(sides, (std::set<Skip>{backface}));
    const auto fields_alone = brought_to_life([](SceneNeeds& needs) { needs.metallic = false; });
    EXPECT_EQ(fields_alone, (std::set<Skip>{fields}));
    const auto code_alone = brought_to_life([](SceneNeeds& needs) { needs.alpha_masks = false; });
    EXPECT_EQ(code_alone, (std::set<Skip>{code}));
    const auto one_model = brought_to_life([](SceneNeeds& needs) { needs.models = {true, false, false}; });
    EXPECT_EQ(one_model, (std::set<Skip>{fields, code}));
}

TEST(SkipNeeds, TheReasonNamesWhatThereIs) {
    SceneNeeds needs = one_of_everything();
    EXPECT_THAT(skip_use(Skip::sort, needs).why, HasSubstr("1 instance:"));
    needs.instances = 64;
    EXPECT_THAT(skip_use(Skip::sort, needs).why, HasSubstr("64 instances:"));
    needs.normal_textures = needs.specular = false;
    EXPECT_THAT(skip_use(Skip::code, needs).why, "lacks normal texture");
    EXPECT_THAT(skip_use(Skip::fields, needs).why, HasSubstr("specular"));
    needs.emissive = needs.ambient = needs.directional_lights = needs.background = false;
    EXPECT_THAT(skip_use(Skip::passes, needs).why, HasSubstr("base pass"));
}

}  // namespace
}  // namespace lightsweep
