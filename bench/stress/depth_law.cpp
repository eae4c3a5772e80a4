#include "bench/stress/depth_law.h"

#include "renderer/base/check.h"
#include "renderer/base/float_split.h"

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

// Of a constant that a shader gets as a 32-bit float.
double constant_error(double exact) { return -beyond_float(exact); }

// A power of two counts as the numbers below it: no depth is above 1.
double half_spacing(double value) { return 0.5 * float_spacing(value * (1.0 - 1e-12)); }

// Of what is too small to change the sum, no more than itself is lost.
double sum_rounding(double a, double b) { return std::min({half_spacing(a + b), std::abs(a), std::abs(b)}); }

}  // namespace

// Each is even within its half spacing h, with the deviation h / sqrt(3). The largest of some thousand sums of a few is
// three deviations away, and never more than all of them together.
class DepthLaw::Roundings {
  public:
    void add(double half) {
        sum_ += half;
        squares_ += half * half;
    }
    double sum() const { return sum_; }
    double largest() const { return std::min(sum_, std::sqrt(3.0 * squares_)); }

  private:
    double sum_ = 0.0, squares_ = 0.0;
};

double float_spacing(double value) {
    if (value == 0.0) return 0x1p-149;
    return std::ldexp(1.0, std::max(std::ilogb(value), -126) - 23);
}

DepthLaw::DepthLaw(gl::Format format, DepthConvention convention, gl::ClipDepth clip, double near_distance,
                   double far_distance)
    : format_(format), near_(near_distance), far_(far_distance) {
    CHECK_THAT(near_ > 0.0 && near_ < far_, "{} to {}", near_, far_);
    const bool reversed = convention == DepthConvention::reversed;
    const double span = far_ - near_;
    a_ = reversed ? -near_ / span : far_ / span;
    b_ = (reversed ? 1.0 : -1.0) * near_ * far_ / span;
    decode_offset_ = (reversed ? 1.0 : -1.0) * near_ / span;
    const bool halves = clip == gl::ClipDepth::minus_one_to_one;
    viewport_scale_ = halves ? 0.5 : 1.0;
    clip_a_ = halves ? 2.0 * a_ - 1.0 : a_;
    clip_b_ = halves ? 2.0 * b_ : b_;
}

double DepthLaw::depth(double z) const { return std::clamp(a_ + b_ / z, 0.0, 1.0); }

double DepthLaw::distance(double depth) const {
    return std::clamp(b_ / (std::clamp(depth, 0.0, 1.0) - a_), near_, far_);
}

double DepthLaw::spacing(double depth) const {
    const int bits = gl::info(format_).bits[0];
    return bits == 32 ? float_spacing(depth) : 1.0 / (std::ldexp(1.0, bits) - 1.0);
}

double DepthLaw::rasterised_error(double z) const {
    Roundings roundings;
    add_rasterised(z, roundings);
    return std::abs(rasterised_bias(z)) + roundings.sum();
}

double DepthLaw::rasterised_bias(double z) const {
    return viewport_scale_ * (constant_error(clip_a_) + constant_error(clip_b_) / z);
}

// A product, a sum, the division by w as a reciprocal and a product, and the viewport where it does anything.
void DepthLaw::add_rasterised(double z, Roundings& roundings) const {
    const double over_w = clip_a_ + clip_b_ / z;
    roundings.add(viewport_scale_ * half_spacing(clip_a_ * z) / z);
    roundings.add(viewport_scale_ * sum_rounding(clip_a_ * z, clip_b_) / z);
    roundings.add(viewport_scale_ * half_spacing(over_w));
    roundings.add(viewport_scale_ * half_spacing(over_w));
    if (viewport_scale_ != 1.0) roundings.add(half_spacing(depth(z)));
}

double DepthLaw::depth_error(double z) const {
    Roundings roundings;
    add_rasterised(z, roundings);
    // A float is rounded by the arithmetic that makes it, and not once more when it is stored; a fixed-point number is,
    // and again when it is read as a float.
    if (gl::info(format_).bits[0] != 32) {
        roundings.add(0.5 * spacing(depth(z)));
        roundings.add(half_spacing(depth(z)));
    }
    // z = b / from_far: a sum and a division.
    const double from_far = b_ / z;
    roundings.add(sum_rounding(from_far - decode_offset_, decode_offset_));
    roundings.add(std::abs(from_far) * half_spacing(z) / z);
    // What both ways get wrong alike cancels.
    const double bias = rasterised_bias(z) + constant_error(decode_offset_) - from_far * constant_error(b_) / b_;
    return std::abs(bias) + roundings.largest();
}

double DepthLaw::distance_error(double z) const {
    const double off = depth_error(z), at = depth(z);
    return std::max(std::abs(distance(at - off) - z), std::abs(distance(at + off) - z)) / z;
}

}  // namespace lightsweep
