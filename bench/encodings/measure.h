// Error and time of each variant. What a time is: one whole pass over the target by the steady clock with glFinish
// before and after, that is fetch + encode + store or fetch + decode + store, divided by the pixels. The passes of a
// field's variants are interleaved in rounds, and the median round counts. Variants differ in their encodings and in
// their formats, which the target's bandwidth and conversion are part of: only those of one format differ by the
// encoding alone. Depth has no encoder of its own: its time to encode is that of drawing a point in each pixel.
#pragma once

#include "bench/encodings/field_kind.h"
#include "bench/encodings/variant.h"
#include "bench/stats/quantile.h"

#include <string>
#include <vector>

namespace lightsweep {

/// 1024 x 1024 values of each variant.
inline constexpr int kSampleColumns = 1024, kSampleRows = 1024;

struct EncodingResult {
    std::string field, name, domain;
    std::string unit;  ///< of the error: "deg", "rel" or "abs"
    int bits = 0;
    ErrorSummary error;
    Interval encode_ns_per_px, decode_ns_per_px;  ///< the median over the rounds, at 95 %
};

/// In the order of `variants`; needs a current context. `rounds` of timing, at least 1.
std::vector<EncodingResult> measure_encodings(const std::vector<Variant>& variants, int rounds);

}  // namespace lightsweep
