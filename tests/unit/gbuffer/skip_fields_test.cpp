// The skip of fields is called pointless exactly where drop_unneeded has no field to drop.
#include "renderer/frame/skip_needs.h"
#include "renderer/gbuffer/field.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lightsweep {
namespace {

TEST(SkipFields, IsPointlessExactlyWhenEveryFieldIsNeeded) {
    for (unsigned bits = 0; bits < 64; ++bits) {
        SceneNeeds needs;
        needs.roughness = (bits & 1U) != 0;
        needs.metallic = (bits & 2U) != 0;
        needs.specular = (bits & 4U) != 0;
        needs.emissive = (bits & 8U) != 0;
        needs.models = {true, (bits & 16U) != 0, (bits & 32U) != 0};
        const auto& names = field_names();
        const auto unneeded = std::ranges::find_if(
            names, [&](const auto& name) { return !info(static_cast<Field>(&name - names.data())).needed(needs); });
        EXPECT_EQ(skip_use(Skip::fields, needs).may_help, unneeded != names.end()) << "bits = " << bits;
    }
}

}  // namespace
}  // namespace lightsweep
