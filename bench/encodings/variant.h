// What `lightsweep encodings` measures: one field in one encoding and format. Data, from bench/encodings/variants.json.
#pragma once

#include "renderer/gbuffer/layout.h"
#include "renderer/gl/state.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lightsweep {

/// How far the camera of the samples sees; depths and positions are log-uniform in between.
inline constexpr double kNearDistance = 0.1, kFarDistance = 1000.0;

struct Variant {
    std::string name;   ///< unique among the variants of its field
    std::string field;  ///< a layout's field, or "depth"
    Layout layout;      ///< one target with this field alone; for "depth" no target but its own depth format
    gl::ClipDepth clip = gl::ClipDepth::zero_to_one;                    ///< "depth" only
    double near_distance = kNearDistance, far_distance = kFarDistance;  ///< of the camera that it is seen with

    bool is_depth() const { return layout.targets.empty(); }
    const StoredField& stored() const { return layout.targets.front().fields.front(); }  ///< not of "depth"
    int bits() const;                                                                    ///< of all that is stored
    bool hemisphere() const { return !is_depth() && stored().encoding.hemisphere; }
};

/// Throws InputError with file and place, as load_layout does.
std::vector<Variant> load_variants(const std::filesystem::path& file);
/// Those of bench/encodings/variants.json.
std::vector<Variant> shipped_variants();

}  // namespace lightsweep
