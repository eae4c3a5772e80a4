// What theory says of a depth buffer: which number a distance becomes, how far the number is off, and how far the
// distance that shading rebuilds from it. Pure functions, no GL.
//
// Depth is a hyperbola of the distance z along the view axis, d = A + B / z, so an error e of d is one of z^2 / |B| e
// of z (Lapidous and Jiao 1999, "Optimal Depth Buffer for Low-Cost Graphics Hardware"). Of e, the format takes half of
// its spacing: 2^-bits for unorm, 2^(floor(log2 d) - 23) for 32-bit float, which is why reversed floats are even (Reed
// 2015, "Depth Precision Visualized"). The rest is the arithmetic in 32 bits before and after (Upchurch and Desbrun
// 2012, "Tightening the Precision of Perspective Rendering").
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/format.h"
#include "renderer/gl/state.h"

namespace lightsweep {

/// The unit roundoff of 32-bit float: a result rounded to nearest is off by this share of itself at most.
inline constexpr double kFloatUnit = 0x1p-24;

/// From |value| to the next 32-bit float: 2^(floor(log2 |value|) - 23).
double float_spacing(double value);

class DepthLaw {
  public:
    /// `near_distance` < `far_distance`, both above 0. `format`: D16, D24 or D32F.
    DepthLaw(gl::Format format, DepthConvention convention, gl::ClipDepth clip, double near_distance,
             double far_distance);

    /// In exact arithmetic, of z from near to far.
    double depth(double z) const;
    /// The inverse; depths outside of [0, 1] count as its ends.
    double distance(double depth) const;

    /// From a depth to the format's next.
    double spacing(double depth) const;
    /// The most that a vertex's depth can be off at the distance z before it is stored.
    double rasterised_error(double z) const;
    /// The largest error, of thousands of distances around z, of the depth that shading's distance stands for.
    double depth_error(double z) const;
    /// The same of the distance that shading rebuilds, relative to z. Counted through the hyperbola, not
    /// its slope: where a step of depth is as wide as what is left to the far plane, the two part.
    double distance_error(double z) const;

  private:
    class Roundings;
    double rasterised_bias(double z) const;
    void add_rasterised(double z, Roundings& roundings) const;

    gl::Format format_;
    double near_, far_;
    double a_, b_;            // depth = a + b / z
    double decode_offset_;    // z = b / (depth - the one at far + offset)
    double clip_a_, clip_b_;  // z / w = clip_a + clip_b / z
    double viewport_scale_;   // of z / w
};

}  // namespace lightsweep
