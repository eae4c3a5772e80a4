// What must hold for a layout that is cut down to some of its fields.
#include "renderer/gbuffer/layout.h"

#include <gtest/gtest.h>

namespace lightsweep {
namespace {

TEST(KeepFields, KeepsTheseAndNoTargetForNothing) {
    constexpr Field kKept[] = {Field::normal, Field::roughness};
    for (const auto& key : layout_keys()) {
        const Layout layout = load_layout(key), thin = keep_fields(layout, kKept);
        EXPECT_LE(thin.bytes_per_pixel(), layout.bytes_per_pixel()) << key;
        EXPECT_EQ(thin.depth, layout.depth) << key;
        for (size_t i = 0; i < field_names().size(); ++i) {
            const auto field = static_cast<Field>(i);
            const bool kept = field == Field::normal || field == Field::roughness;
            EXPECT_EQ(thin.stores(field), kept) << key << " " << field_names()[i];
        }
        EXPECT_GE(thin.targets.size(), 1U) << key;
        EXPECT_LE(thin.targets.size(), 2U) << key << ": one for each field at most";
        for (const auto& target : thin.targets) EXPECT_FALSE(target.fields.empty()) << key;
    }
}

TEST(KeepFields, OfNoneIsNoTarget) { EXPECT_TRUE(keep_fields(load_layout("float32"), {}).targets.empty()); }

}  // namespace
}  // namespace lightsweep
