#include "bench/stress/cases.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <algorithm>
#include <string>
#include <vector>

namespace lightsweep {

extern const StressCase stress_sharp_ggx;            // s01_sharp_ggx.cpp
extern const StressCase stress_zero_roughness;       // s02_zero_roughness.cpp
extern const StressCase stress_grazing;              // s03_grazing.cpp
extern const StressCase stress_zero_vectors;         // s04_zero_vectors.cpp
extern const StressCase stress_vector_lengths;       // s05_vector_lengths.cpp
extern const StressCase stress_function_domains;     // s06_function_domains.cpp
extern const StressCase stress_light_on_surface;     // s07_light_on_surface.cpp
extern const StressCase stress_light_radius;         // s08_light_radius.cpp
extern const StressCase stress_injected_nan;         // s09_injected_nan.cpp
extern const StressCase stress_hdr_overflow;         // s10_hdr_overflow.cpp
extern const StressCase stress_negative_radiance;    // s11_negative_radiance.cpp
extern const StressCase stress_long_sums;            // s12_long_sums.cpp
extern const StressCase stress_permuted_lights;      // s13_permuted_lights.cpp
extern const StressCase stress_depth_formats;        // s14_depth_formats.cpp
extern const StressCase stress_coplanar_layers;      // s15_coplanar_layers.cpp
extern const StressCase stress_far_origin;           // s16_far_origin.cpp
extern const StressCase stress_volume_crossing;      // s17_volume_crossing.cpp
extern const StressCase stress_odd_sizes;            // s18_odd_sizes.cpp
extern const StressCase stress_list_lengths;         // s19_list_lengths.cpp
extern const StressCase stress_depth_discontinuity;  // s20_depth_discontinuity.cpp
extern const StressCase stress_slice_ends;           // s21_slice_ends.cpp
extern const StressCase stress_tangent_frames;       // s22_tangent_frames.cpp
extern const StressCase stress_special_normals;      // s23_special_normals.cpp
extern const StressCase stress_unruly_transforms;    // s24_unruly_transforms.cpp
extern const StressCase stress_denormals;            // s25_denormals.cpp
extern const StressCase stress_empty_pixels;         // s26_empty_pixels.cpp
extern const StressCase stress_decoded_length;       // s27_decoded_length.cpp
extern const StressCase stress_srgb_ramp;            // s28_srgb_ramp.cpp
extern const StressCase stress_refusals;             // s29_refusals.cpp
extern const StressCase stress_faulty_timers;        // s30_faulty_timers.cpp
extern const StressCase stress_small_steps;          // s31_small_steps.cpp

namespace {

constexpr const StressCase* kCases[] = {
    &stress_sharp_ggx,       &stress_zero_roughness,   &stress_grazing,           &stress_zero_vectors,
    &stress_vector_lengths,  &stress_function_domains, &stress_light_on_surface,  &stress_light_radius,
    &stress_injected_nan,    &stress_hdr_overflow,     &stress_negative_radiance, &stress_long_sums,
    &stress_permuted_lights, &stress_depth_formats,    &stress_coplanar_layers,   &stress_far_origin,
    &stress_volume_crossing, &stress_odd_sizes,        &stress_list_lengths,      &stress_depth_discontinuity,
    &stress_slice_ends,      &stress_tangent_frames,   &stress_special_normals,   &stress_unruly_transforms,
    &stress_denormals,       &stress_empty_pixels,     &stress_decoded_length,    &stress_srgb_ramp,
    &stress_refusals,        &stress_faulty_timers,    &stress_small_steps,
};

}  // namespace

std::span<const StressCase* const> all_stress_cases() { return kCases; }

const StressCase& find_stress_case(std::string_view id) {
    const auto found = std::ranges::find(kCases, id, [](const StressCase* c) { return c->id; });
    if (found != std::end(kCases)) return **found;
    std::vector<std::string> ids;
    for (const StressCase* c : kCases) ids.emplace_back(c->id);
    throw InputError(unknown_name("stress case", id, ids));
}

}  // namespace lightsweep
