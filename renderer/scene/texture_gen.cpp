#include "renderer/scene/texture_gen.h"

#include "renderer/base/random.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace lightsweep {
namespace {

uint8_t to_byte(double value) { return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0)); }

// IEC 61966-2-1.
double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// Every texel from the centre of it, as linear RGBA.
Texture make_texture(std::string name, const TextureFormat& format,
                     const std::function<glm::dvec4(double u, double v)>& color) {
    Texture texture{
        .name = std::move(name), .width = format.size, .height = format.size, .srgb = format.srgb, .rgba = {}};
    texture.rgba.reserve(4 * static_cast<size_t>(format.size) * static_cast<size_t>(format.size));
    for (int y = 0; y < format.size; ++y) {
        for (int x = 0; x < format.size; ++x) {
            const glm::dvec4 c = color((x + 0.5) / format.size, (y + 0.5) / format.size);
            for (int k = 0; k < 3; ++k) texture.rgba.push_back(to_byte(format.srgb ? srgb_encode(c[k]) : c[k]));
            texture.rgba.push_back(to_byte(c.a));
        }
    }
    return texture;
}

// Value noise on a lattice of `cells` x `cells` that repeats, with smooth interpolation; [0, 1].
class Lattice {
  public:
    Lattice(int cells, Random& random) : cells_(cells), values_(static_cast<size_t>(cells) * cells) {
        for (double& value : values_) value = random.uniform();
    }

    double at(double u, double v) const {
        const double x = u * cells_;
        const double y = v * cells_;
        const int i = static_cast<int>(x);
        const int j = static_cast<int>(y);
        const double s = smooth(x - i);
        const double t = smooth(y - j);
        return glm::mix(glm::mix(value(i, j), value(i + 1, j), s), glm::mix(value(i, j + 1), value(i + 1, j + 1), s),
                        t);
    }

  private:
    static double smooth(double x) { return x * x * (3.0 - 2.0 * x); }
    double value(int i, int j) const { return values_[static_cast<size_t>(j % cells_) * cells_ + i % cells_]; }

    int cells_;
    std::vector<double> values_;
};

}  // namespace

Texture make_checker(const TextureFormat& format, int squares, const ColorPair& colors) {
    return make_texture("checker", format, [&](double u, double v) {
        const int parity = static_cast<int>(u * squares) + static_cast<int>(v * squares);
        return glm::dvec4(colors[static_cast<size_t>(parity % 2)], 1.0);
    });
}

Texture make_noise(const TextureFormat& format, int cells, int octaves, uint64_t seed, const ColorPair& colors) {
    Random random(seed);
    std::vector<Lattice> lattices;
    for (int octave = 0; octave < octaves; ++octave) lattices.emplace_back(cells << octave, random);
    return make_texture("noise", format, [&](double u, double v) {
        double sum = 0.0;
        double weights = 0.0;
        for (double weight = 1.0; const Lattice& lattice : lattices) {
            sum += weight * lattice.at(u, v);
            weights += weight;
            weight *= 0.5;
        }
        return glm::dvec4(glm::mix(colors[0], colors[1], sum / weights), 1.0);
    });
}

Texture make_holes(const TextureFormat& format, int count, double radius, const glm::dvec3& color) {
    return make_texture("holes", format, [&](double u, double v) {
        const glm::dvec2 from_center = glm::fract(glm::dvec2(u, v) * static_cast<double>(count)) - 0.5;
        return glm::dvec4(color, glm::length(from_center) < radius ? 0.0 : 1.0);
    });
}

Texture make_bumps(int size, int count, double height) {
    return make_texture("bumps", {.size = size}, [&](double u, double v) {
        // The surface is height/2 * sin(a) * sin(b) in bump widths; v runs down, +Y up, so the slope along Y is
        // negated.
        const double a = 2.0 * std::numbers::pi * count * u;
        const double b = 2.0 * std::numbers::pi * count * v;
        const double slope = height * std::numbers::pi;
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(-slope * std::cos(a) * std::sin(b), slope * std::sin(a) * std::cos(b), 1.0));
        return glm::dvec4(normal * 0.5 + 0.5, 1.0);
    });
}

}  // namespace lightsweep
