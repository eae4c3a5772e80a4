// Light whose answer can be written down: one light over one surface, in each model; what each kind of light gives.
#include "tests/unit/reference/fixtures.h"

#include <gtest/gtest.h>

namespace lightsweep {
namespace {

constexpr glm::dvec3 kUp{0, 1, 0};

void expect_near(const glm::dvec3& value, const glm::dvec3& expected, double relative = 1e-14) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], relative * std::abs(expected[c])) << "channel " << c;
}

// --- Models, by unit irradiance from straight above or from 60 degrees ---

const glm::dvec3 kSlanted{std::sqrt(0.75), 0.5, 0.0};

TEST(LambertSurface, ReflectsItsColorOverPi) {
    const auto s = surface_seen_from(glm::normalize(glm::dvec3(1, 2, 3)), 4.0, ShadingModel::lambert);
    expect_near(radiance(s, std::vector{sun(kUp, 3.0)}), s.base_color * 3.0 / kPi);
    expect_near(radiance(s, std::vector{sun(kSlanted)}), s.base_color * 0.5 / kPi);
    EXPECT_EQ(radiance(s, std::vector{sun(-kUp)}), glm::dvec3(0.0)) << "a light behind the surface";
}

TEST(GgxSurface, StraightOnIsF0OverFourPiAlphaSquared) {
    // Roughness 0.5: alpha^2 = 1/16, D = 16 / pi, V = 1/4, F = f0; what Fresnel lets through is diffuse.
    auto s = surface_seen_from(kUp, 4.0, ShadingModel::ggx);
    expect_near(radiance(s, std::vector{sun(kUp)}), (0.04 * 4.0 + 0.96 * s.base_color) / kPi);
    s.metallic = 1.0;
    expect_near(radiance(s, std::vector{sun(kUp)}), 4.0 * s.base_color / kPi);
}

TEST(GgxSurface, MirroredDirectionsAtSixtyDegrees) {
    // v.h = 1/2, so F = f0 + (1 - f0) / 32; n.h = 1, D = 16 / pi; n.l = n.v = 1/2, V = 1 / (4 n.l g) with
    // g^2 = 1/4 + 3/4 / 16 = 19/64.
    auto s = surface_seen_from({-kSlanted.x, kSlanted.y, 0.0}, 2.0, ShadingModel::ggx);
    s.metallic = 1.0;
    const glm::dvec3 fresnel = s.base_color + (1.0 - s.base_color) / 32.0;
    const double visibility = 1.0 / (2.0 * std::sqrt(19.0 / 64.0));
    expect_near(radiance(s, std::vector{sun(kSlanted)}), fresnel * (16.0 / kPi) * visibility * 0.5);
}

TEST(GgxSurface, SeenFromBelowItsHorizonIsMaskedAsAtTheSmallestCosine) {
    // v.l = -1/2: the half vector is 60 degrees from both and from the normal. For masking, n.v is 1e-4.
    auto s = surface_seen_from({kSlanted.x, -kSlanted.y, 0.0}, 2.0, ShadingModel::ggx);
    s.metallic = 1.0;
    const double distribution = (1.0 / 16.0) / (kPi * std::pow(0.25 / 16.0 + 0.75, 2.0));
    const double visibility = 0.5 / (std::sqrt(1.0 / 16.0 + 1e-8 * 15.0 / 16.0) + 1e-4);
    const glm::dvec3 fresnel = s.base_color + (1.0 - s.base_color) / 32.0;
    expect_near(radiance(s, std::vector{sun(kUp)}), fresnel * distribution * visibility, 1e-13);
}

TEST(GgxSurface, SharpHighlightKeepsItsDigitsOffThePeak) {
    // Alpha 0.002, the half vector tilted by 1e-3: D = a^2 / pi (1 - sin^2 (1 - a^2))^2 there; 1 - cos^2 would have
    // lost six digits. v is the normal, so l is tilted by twice as much.
    const double tilt = 1e-3, alpha2 = 4e-6;
    auto s = surface_seen_from(kUp, 2.0, ShadingModel::ggx);
    s.roughness = 0.0;
    s.metallic = 1.0;
    s.base_color = glm::dvec3(1.0);
    const double sin2 = std::sin(tilt) * std::sin(tilt), cos2 = std::cos(tilt) * std::cos(tilt);
    const double distribution = alpha2 / (kPi * std::pow(cos2 * alpha2 + sin2, 2.0));
    const double n_dot_l = std::cos(2.0 * tilt);
    const double visibility =
        0.5 / (n_dot_l + std::sqrt(n_dot_l * n_dot_l + alpha2 * std::pow(std::sin(2.0 * tilt), 2.0)));
    const auto lit = radiance(s, std::vector{sun({std::sin(2.0 * tilt), n_dot_l, 0.0})});
    expect_near(lit, glm::dvec3(distribution * visibility * n_dot_l), 1e-11);
}

TEST(BlinnPhongSurface, LobeHasItsExponentAndItsEnergyFactor) {
    // Roughness 0.5: exponent 2 * 16 - 2 = 30, factor (30 + 8) / 8 pi.
    const auto s = surface_seen_from(kUp, 4.0, ShadingModel::blinn_phong);
    expect_near(radiance(s, std::vector{sun(kUp)}), (s.base_color + 4.75 * s.specular) / kPi);
    // The half vector of 0 and 60 degrees: cos^2 = 3/4.
    const double lobe = 4.75 * std::pow(0.75, 15.0);
    expect_near(radiance(s, std::vector{sun(kSlanted)}), (s.base_color + lobe * s.specular) * 0.5 / kPi);
}

TEST(BlinnPhongSurface, FullyRoughHasAConstantLobe) {
    auto s = surface_seen_from(kUp, 4.0, ShadingModel::blinn_phong);
    s.roughness = 1.0;
    expect_near(radiance(s, std::vector{sun(kSlanted)}), (s.base_color + s.specular) * 0.5 / kPi);
}

TEST(EveryModel, NoRoughnessIsTheSmallestAlpha) {
    for (const auto model : {ShadingModel::ggx, ShadingModel::blinn_phong}) {
        auto smooth = surface_seen_from(kUp, 4.0, model), smallest = smooth;
        smooth.roughness = 0.0;
        smallest.roughness = std::sqrt(0.002);
        expect_near(radiance(smooth, std::vector{sun(kUp)}), radiance(smallest, std::vector{sun(kUp)}));
    }
}

TEST(EveryModel, StaysFiniteWhereVectorsAreDegenerate) {
    for (const auto model : {ShadingModel::ggx, ShadingModel::blinn_phong, ShadingModel::lambert}) {
        for (const double roughness : {0.0, 0.5, 1.0}) {
            // An interpolated normal may look away from the eye; then light and eye may even be opposite.
            for (const auto& to_eye : {kUp, -kUp, -kSlanted, glm::dvec3(1, 0, 0)}) {
                auto s = surface_seen_from(to_eye, 2.0, model);
                s.roughness = roughness;
                const Light at_surface{.position = s.position, .radius = 2.0};
                const Light close{.position = s.position + 1e-12 * kUp, .radius = 2.0};
                const Light grazing = sun(glm::normalize(glm::dvec3(1, 1e-9, 0)));
                const auto lit = radiance(s, std::vector{sun(kUp), sun(kSlanted), grazing, at_surface, close});
                for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(lit[c]) && lit[c] >= 0.0) << lit[c];
            }
        }
    }
}

// --- Lights, over a white Lambert surface: its radiance times pi is the irradiance ---

double irradiance(const Light& light_over_surface) {
    auto s = surface_seen_from(kUp, 3.0, ShadingModel::lambert);
    s.base_color = glm::dvec3(1.0);
    Light light = light_over_surface;
    light.position += s.position;
    return radiance(s, std::vector{light}).g * kPi;
}

TEST(PointLight, InverseSquareCosineAndWindow) {
    // At (1, 2, 0): d^2 = 5, cosine 2 / sqrt(5).
    const double window = 1.0 - std::pow(5.0 / 64.0, 2.0);
    const double expected = 10.0 * window * window / 5.0 * 2.0 / std::sqrt(5.0);
    EXPECT_NEAR(irradiance({.position = {1, 2, 0}, .color = glm::dvec3(10.0), .radius = 8.0}), expected, 1e-14);
}

TEST(PointLight, IsExactlyZeroFromTheRadiusOn) {
    EXPECT_EQ(irradiance({.position = {0, 2, 0}, .radius = 2.0}), 0.0);
    EXPECT_EQ(irradiance({.position = {0, 2, 0}, .radius = 1.5}), 0.0);
    EXPECT_GT(irradiance({.position = {0, 2, 0}, .radius = 2.001}), 0.0);
    EXPECT_EQ(irradiance({.position = {0, 2, 0}, .radius = 0.0}), 0.0);
}

TEST(PointLight, StopsGrowingAtAHundredth) {
    const double window = std::pow(1.0 - 1e-12, 2.0);  // (d / r)^4 at a thousandth
    EXPECT_NEAR(irradiance({.position = {0, 1e-3, 0}, .radius = 1.0}), 1e4 * window, 1e-9);
    EXPECT_NEAR(irradiance({.position = {0, 0.02, 0}, .radius = 100.0}), 2500.0, 1e-9) << "not yet";
}

TEST(SpotLight, FadesBetweenItsCones) {
    // Straight above, its axis tilted: the angle to the axis is the tilt.
    const auto tilted = [](double degrees) {
        const double a = degrees * kPi / 180.0;
        return irradiance({.kind = LightKind::spot,
                           .position = {0, 2, 0},
                           .direction = {std::sin(a), -std::cos(a), 0},
                           .radius = 1e6,
                           .inner_deg = 30.0,
                           .outer_deg = 60.0});
    };
    EXPECT_NEAR(tilted(0.0), 0.25, 1e-12);
    EXPECT_NEAR(tilted(29.9), 0.25, 1e-12);
    const double halfway = std::acos(0.5 * (std::sqrt(0.75) + 0.5)) * 180.0 / kPi;  // in cosines
    EXPECT_NEAR(tilted(halfway), 0.25 * 0.25, 1e-12);
    EXPECT_EQ(tilted(60.1), 0.0);
    EXPECT_EQ(tilted(180.0), 0.0);
}

TEST(SpotLight, HardEdgeIsAsWideAsItsSmallestWidth) {
    // Inner and outer at 60 degrees: the cosine rises over 1e-4 from 1/2.
    const auto at_cosine = [](double cosine) {
        return irradiance({.kind = LightKind::spot,
                           .position = {0, 1, 0},
                           .direction = {std::sqrt(1.0 - cosine * cosine), -cosine, 0},
                           .radius = 1e6,
                           .inner_deg = 60.0,
                           .outer_deg = 60.0});
    };
    EXPECT_EQ(at_cosine(0.49999), 0.0);
    EXPECT_NEAR(at_cosine(0.50005), 0.25, 1e-9);
    EXPECT_NEAR(at_cosine(0.50011), 1.0, 1e-9);
}

// --- What is there without lights ---

TEST(Reference, WithoutLightsEmissionAndAmbientAreLeft) {
    Scene scene;
    scene.ambient = {0.5, 0.25, 1.0};
    scene.background = {7, 8, 9};
    auto s = surface_seen_from(kUp, 3.0, ShadingModel::ggx);
    s.emissive = {1, 2, 3};
    expect_near(radiance(s, {}, scene), {1.4, 2.125, 3.25});
    const Light black{.color = glm::dvec3(0.0), .radius = 100.0};
    EXPECT_EQ(radiance(s, std::vector{black}, scene), radiance(s, {}, scene));
    s.covered = false;
    EXPECT_EQ(radiance(s, std::vector{sun(kUp)}, scene), scene.background);
}

TEST(Reference, ImageIsRoundedOnceToFloat) {
    const std::vector<glm::dvec3> values{{1.0 / 3.0, 1e-3, 70000.1}, {0, 1, 2}};
    const Image image = to_image(values, 1, 2);
    EXPECT_EQ(image.space, ColorSpace::linear);
    EXPECT_EQ(image.rgb, (std::vector<float>{1.0F / 3.0F, 1e-3F, 70000.1F, 0, 1, 2}));
}

}  // namespace
}  // namespace lightsweep
