// The functions of shaders/lib and the encodings, called on the GPU with arrays of values, against formulas in double
// precision: by how many units in the last place they are off.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lightsweep {

struct UlpRow {
    std::string function;
    size_t inputs = 0;
    double max_ulp = 0.0, mean_ulp = 0.0;  ///< of the results that are finite
    std::string worst_input{};             ///< the one of max_ulp, as `a = (1, 2, 3)`; empty where that is 0
    size_t non_finite = 0;                 ///< inputs whose result is NaN or infinite
    std::string non_finite_input{};        ///< the first of them
    std::string domain;                    ///< of the inputs, in words
};

/// The distance from `magnitude` to the next 32-bit float: 2^(e - 23) for 2^e <= magnitude < 2^(e + 1), and 2^-149 for
/// denormals and 0. `magnitude` is finite and not negative.
double ulp_of(double magnitude);

/// How far `components` of a result are off, in ulps of the exact result's largest component: a vector's small
/// components carry its rounding. Nothing below 2^-126 counts: devices may flush denormals. Infinite where one
/// is NaN or infinite.
double ulps_off(const float* result, const double* exact, int components);

/// One row for each function, then one for each encoding and channel width whose codes are all decoded, encoded and
/// decoded again. `quick`: fewer random inputs, all codes nevertheless. The same inputs every time. Needs a current
/// context.
std::vector<UlpRow> measure_ulp(bool quick);

}  // namespace lightsweep
