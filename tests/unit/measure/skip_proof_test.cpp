#include "bench/measure/skip_proof.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image picture(std::vector<float> rgb) {
    Image image(static_cast<int>(rgb.size() / 3), 1, ColorSpace::linear);
    image.rgb = std::move(rgb);
    return image;
}

CellResult cell(const std::string& path, const std::string& skip) {
    CellResult result;
    result.params.scene = "atrium";
    result.params.path = path;
    result.params.skip = skip;
    result.id = result.params.id();
    return result;
}

std::vector<CellParams> params_of(const std::vector<CellResult>& cells) {
    std::vector<CellParams> params;
    for (const auto& c : cells) params.push_back(c.params);
    return params;
}

TEST(SkipProof, equal_pictures_have_the_same_bits) {
    const Image image = picture({0.0F, 1.5F, kInfinity, std::nanf(""), -2.0F, 1e-30F});
    const SkipProof proof = prove_same_picture("a", image, image);
    EXPECT_EQ(proof.compared_with, "a");
    EXPECT_TRUE(proof.same_bits);
    EXPECT_EQ(proof.max_abs, 0.0);
    EXPECT_EQ(proof.max_rel, 0.0);
    EXPECT_EQ(proof.differing_px, 0);
}

TEST(SkipProof, differences_are_counted_by_pixels_and_measured_by_channels) {
    // Differences 0.5 of 2 (a quarter), 0.25 of 0.25 (all of it), and two channels of one pixel.
    const SkipProof proof = prove_same_picture("a", picture({2.0F, 0.0F, 1.0F, 0.25F, 8.0F, 1.0F, 3.0F, 3.0F, 3.0F}),
                                               picture({1.5F, 0.0F, 1.0F, 0.0F, 7.875F, 1.0F, 3.0F, 3.0F, 3.0F}));
    EXPECT_FALSE(proof.same_bits);
    EXPECT_EQ(proof.max_abs, 0.5);
    EXPECT_EQ(proof.max_rel, 1.0);
    EXPECT_EQ(proof.differing_px, 2);
}

TEST(SkipProof, a_bit_alone_is_a_difference) {
    const SkipProof signs = prove_same_picture("a", picture({0.0F, 0.0F, 0.0F}), picture({0.0F, -0.0F, 0.0F}));
    EXPECT_FALSE(signs.same_bits);
    EXPECT_EQ(signs.max_abs, 0.0);
    EXPECT_EQ(signs.max_rel, 0.0);
    const float next = std::nextafter(1.0F, 2.0F);
    EXPECT_FLOAT_EQ(
        static_cast<float>(prove_same_picture("a", picture({1.0F, 1.0F, 1.0F}), picture({1.0F, next, 1.0F})).max_rel),
        next - 1.0F);
}

TEST(SkipProof, what_is_not_finite_in_one_picture_is_endlessly_far) {
    for (const float broken : {kInfinity, -kInfinity, std::nanf("")}) {
        const SkipProof proof = prove_same_picture("a", picture({1.0F, 1.0F, 1.0F, 5.0F, 5.0F, 5.0F}),
                                                   picture({1.0F, broken, 1.0F, 5.0F, 4.0F, 5.0F}));
        EXPECT_TRUE(std::isinf(proof.max_abs) && std::isinf(proof.max_rel)) << broken;
        EXPECT_EQ(proof.differing_px, 2);
    }
}

TEST(SkipProofs, compare_with_the_first_cell_of_the_kind) {
    const std::vector<CellResult> cells{cell("forward", "all"), cell("deferred", "all"), cell("forward", "none"),
                                        cell("forward", "auto"), cell("visibility", "all")};
    SkipProofs proofs(params_of(cells));
    EXPECT_TRUE(proofs.wants(cells[0].params));
    EXPECT_FALSE(proofs.wants(cells[1].params)) << "it is alone";
    EXPECT_FALSE(proofs.wants(cells[4].params));
    EXPECT_FALSE(proofs.prove(cells[0], picture({1.0F, 2.0F, 3.0F})));
    const auto same = proofs.prove(cells[2], picture({1.0F, 2.0F, 3.0F}));
    const auto other = proofs.prove(cells[3], picture({1.0F, 2.0F, 3.5F}));
    ASSERT_TRUE(same && other);
    EXPECT_TRUE(same->same_bits);
    EXPECT_EQ(same->compared_with, cells[0].id);
    EXPECT_EQ(other->max_abs, 0.5);
    EXPECT_EQ(other->compared_with, cells[0].id);
}

// What a skip does alone is seen against no skip at all, not through what all the others round.
TEST(SkipProofs, sets_near_to_none_are_compared_with_none) {
    const std::vector<CellResult> cells{cell("forward", "all"), cell("forward", "none"), cell("forward", "none+sort"),
                                        cell("forward", "all-sort")};
    SkipProofs proofs(params_of(cells));
    EXPECT_FALSE(proofs.prove(cells[0], picture({1.0F, 2.0F, 3.0F})));
    EXPECT_EQ(proofs.prove(cells[1], picture({1.0F, 2.0F, 3.5F}))->compared_with, cells[0].id);
    const auto near = proofs.prove(cells[2], picture({1.0F, 2.0F, 3.5F}));
    EXPECT_EQ(near->compared_with, cells[1].id);
    EXPECT_TRUE(near->same_bits);
    EXPECT_EQ(proofs.prove(cells[3], picture({1.0F, 2.0F, 3.0F}))->compared_with, cells[0].id);
}

TEST(SkipProofs, paths_that_auto_came_to_are_told_apart) {
    std::vector<CellResult> cells{cell("auto", "all"), cell("auto", "none"), cell("auto", "auto")};
    cells[0].auto_path = cells[2].auto_path =
        PathChoice{.path = "forward", .why = "", .expected_ns = {}, .tried_ns = {}};
    cells[1].auto_path = PathChoice{.path = "deferred", .why = "", .expected_ns = {}, .tried_ns = {}};
    SkipProofs proofs(params_of(cells));
    const Image image = picture({1.0F, 2.0F, 3.0F});
    EXPECT_FALSE(proofs.prove(cells[0], image));
    EXPECT_FALSE(proofs.prove(cells[1], image));
    EXPECT_EQ(proofs.prove(cells[2], image)->compared_with, cells[0].id);
}

}  // namespace
}  // namespace lightsweep
