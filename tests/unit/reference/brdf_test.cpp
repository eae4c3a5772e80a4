// Laws that the shading models obey: energy, reciprocity; and arithmetic in float converges to them.
#include "tests/unit/reference/fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lightsweep {
namespace {

glm::dvec3 seen_at(double cosine) { return {std::sqrt(1.0 - cosine * cosine), cosine, 0.0}; }

// --- White furnace: a surface that absorbs nothing, under a sky of radiance 1, is as bright as the sky ---

TEST(WhiteFurnace, LambertReflectsAll) {
    // Rings of equal solid angle; the midpoint rule is exact, since the integrand is linear in the cosine.
    constexpr int kRings = 32, kAround = 8;
    std::vector<Light> sky;
    for (int ring = 0; ring < kRings; ++ring) {
        const double cosine = (ring + 0.5) / kRings, sine = std::sqrt(1.0 - cosine * cosine);
        for (int i = 0; i < kAround; ++i) {
            const double angle = 2.0 * kPi * i / kAround;
            sky.push_back(sun({sine * std::cos(angle), cosine, sine * std::sin(angle)}, 2.0 * kPi / kRings / kAround));
        }
    }
    const auto s = surface_seen_from(seen_at(0.3), 2.0, ShadingModel::lambert);
    const auto lit = radiance(s, sky);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], s.base_color[c], 1e-13);
}

// The share of a white sky that a perfect GGX mirror sends to the eye. The sky is sampled where the lobe is: half
// vectors distributed as D n.h, each standing for the solid angle 4 v.h / (D n.h) per sample of the light's direction.
double ggx_energy(double roughness, double n_dot_v) {
    constexpr int kSteps = 256;
    const double alpha = roughness * roughness;
    const glm::dvec3 v = seen_at(n_dot_v);
    std::vector<Light> sky;
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double tan2 = alpha * alpha * u / (1.0 - u);
        const double cosine = 1.0 / std::sqrt(1.0 + tan2), sine = cosine * std::sqrt(tan2);
        const double density = std::pow(1.0 - u, 2.0) / (kPi * alpha * alpha * std::pow(cosine, 3.0));
        for (int k = 0; k < kSteps; ++k) {
            const double angle = 2.0 * kPi * (k + 0.5) / kSteps;
            const glm::dvec3 h(sine * std::cos(angle), cosine, sine * std::sin(angle));
            const double v_dot_h = glm::dot(v, h);
            if (v_dot_h <= 0.0) continue;
            sky.push_back(sun(2.0 * v_dot_h * h - v, 4.0 * v_dot_h / density / (kSteps * kSteps)));
        }
    }
    auto s = surface_seen_from(v, 2.0, ShadingModel::ggx);
    s.base_color = glm::dvec3(1.0);
    s.metallic = 1.0;
    s.roughness = roughness;
    return radiance(s, sky).g;
}

TEST(WhiteFurnace, SmoothGgxReflectsNearlyAll) {
    for (const double n_dot_v : {1.0, 0.7, 0.3}) {
        EXPECT_GT(ggx_energy(0.1, n_dot_v), 0.999) << "n.v = " << n_dot_v;
        EXPECT_LT(ggx_energy(0.1, n_dot_v), 1.0001) << "n.v = " << n_dot_v;
    }
}

TEST(WhiteFurnace, RoughGgxLosesWhatIsScatteredTwice) {
    // One bounce only: the rougher, the more is lost, and nothing is ever gained.
    for (const double n_dot_v : {1.0, 0.7, 0.3}) {
        double last = 1.0001;
        for (const double roughness : {0.1, 0.3, 0.5, 0.7, 1.0}) {
            const double energy = ggx_energy(roughness, n_dot_v);
            EXPECT_LT(energy, last) << "roughness " << roughness << ", n.v = " << n_dot_v;
            EXPECT_GT(energy, 0.3);
            last = energy;
        }
    }
}

// --- Reciprocity: eye and light may change places ---

class EveryModel : public testing::TestWithParam<ShadingModel> {};
INSTANTIATE_TEST_SUITE_P(All, EveryModel,
                         testing::Values(ShadingModel::ggx, ShadingModel::blinn_phong, ShadingModel::lambert),
                         [](const auto& tested) { return kShadingModelNames[static_cast<size_t>(tested.param)]; });

TEST_P(EveryModel, IsReciprocal) {
    Random random(3);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 a = random_upward(random), b = random_upward(random);
        const double roughness = random.uniform(0.1, 1.0), metallic = random.uniform();
        const auto reflectance = [&](const glm::dvec3& to_eye, const glm::dvec3& to_light) {
            auto s = surface_seen_from(to_eye, 2.0, GetParam());
            s.roughness = roughness;
            s.metallic = metallic;
            return radiance(s, std::vector{sun(to_light)}) / to_light.y;
        };
        const auto there = reflectance(a, b), back = reflectance(b, a);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], back[c], 1e-11 * there[c]);
    }
}

// --- Float: the formulas as a shader has them ---

float float_lambert(const glm::vec3& n, const glm::vec3& l, float base_color) {
    return base_color * glm::dot(n, l) / static_cast<float>(kPi);
}

float float_ggx(const glm::vec3& n, const glm::vec3& v, const glm::vec3& l, float base_color, float roughness,
                float metallic) {
    const glm::vec3 h = glm::normalize(v + l), sine = glm::cross(n, h);
    const float a2 = std::pow(roughness, 4.0F), nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h);
    const float denominator = nh * nh * a2 + glm::dot(sine, sine);
    const float d = a2 / (static_cast<float>(kPi) * denominator * denominator);
    const float visibility =
        0.5F / (nl * std::sqrt(nv * nv * (1.0F - a2) + a2) + nv * std::sqrt(nl * nl * (1.0F - a2) + a2));
    const float f0 = glm::mix(0.04F, base_color, metallic);
    const float f = f0 + (1.0F - f0) * std::pow(1.0F - glm::dot(v, h), 5.0F);
    return ((1.0F - f) * (1.0F - metallic) * base_color / static_cast<float>(kPi) + f * d * visibility) * nl;
}

TEST(Float, ConvergesToTheReference) {
    Random random(4);
    for (const auto model : {ShadingModel::lambert, ShadingModel::ggx}) {
        std::vector<double> errors;
        for (int i = 0; i < 2001; ++i) {
            // Inputs that are the same in both precisions; the normal as near to unit as float allows.
            const glm::vec3 v(random_upward(random)), l(random_upward(random));
            auto s = surface_seen_from(v, 1.0, model);
            const auto roughness = static_cast<float>(random.uniform(0.2, 1.0));
            const auto metallic = static_cast<float>(random.uniform());
            s.base_color = glm::dvec3(0.5);
            s.roughness = roughness;
            s.metallic = metallic;
            const double exact = radiance(s, std::vector{sun(glm::dvec3(l))}).g;
            const glm::vec3 n(0, 1, 0);
            const float rounded =
                model == ShadingModel::ggx ? float_ggx(n, v, l, 0.5F, roughness, metallic) : float_lambert(n, l, 0.5F);
            errors.push_back(std::abs(static_cast<double>(rounded) - exact) / exact);
        }
        std::ranges::sort(errors);
        EXPECT_LT(errors[errors.size() / 2], 5e-7) << kShadingModelNames[static_cast<size_t>(model)];
        EXPECT_LT(errors.back(), 3e-5) << kShadingModelNames[static_cast<size_t>(model)];
        EXPECT_GT(errors.back(), 1e-9) << "the comparison sees float at all";
    }
}

}  // namespace
}  // namespace lightsweep
