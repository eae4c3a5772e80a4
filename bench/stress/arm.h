// What a stress case is tried on: a path, a layout, a depth format, an encoding ... one value for each of its axes.
#pragma once

#include "bench/plan/axes.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lightsweep {

/// The axes that mean the same in every case. Others (`format`, `encoding`, `order`, ...) are a case's own.
/// depth: one of kStressDepths; the layout's own where a case does not vary it.
inline constexpr std::string_view kPathAxis = "path", kLayoutAxis = "layout", kHdrAxis = "hdr", kDepthAxis = "depth",
                                  kGuardsAxis = "guards", kSumsAxis = "sums", kListsAxis = "light_lists";
/// Depth format and convention: D32F-reversed, D32F-standard, D24-reversed, ...
extern const std::vector<std::string> kStressDepths;

struct StressAxis {
    std::string name;
    std::vector<std::string> values;  ///< those tried unless a user says otherwise; of a case's own axis, all there are
};

/// Every combination of the axes' values. A layout or light lists fall away with a path that uses none.
using ArmBlock = std::vector<StressAxis>;

class StressArm {
  public:
    using Choices = std::vector<std::pair<std::string, std::string>>;
    explicit StressArm(Choices choices = {}) : choices_(std::move(choices)) {}

    /// `path=deferred layout=oct32 hdr=rgba32f`; empty for a case that has nothing to choose.
    std::string name() const;
    /// The value on an axis; `otherwise` where the arm has none.
    std::string get(std::string_view axis, std::string_view otherwise = {}) const;
    /// Axis and value, in the order of the block.
    const Choices& choices() const { return choices_; }
    bool operator==(const StressArm&) const = default;

  private:
    Choices choices_;
};

/// Each once, in the order of the blocks. `selection` (from `-a axis=values`) replaces the values of the axes that it
/// names, of a case's own axes with some of them; axes that no block has are ignored. Throws InputError for a value
/// that is not allowed.
std::vector<StressArm> stress_arms(const std::vector<ArmBlock>& blocks, const AxisValues& selection);

/// Reads `-a` arguments. Throws InputError for an axis that none of the blocks has, and for a name that nothing has.
AxisValues parse_stress_axes(const std::vector<std::string>& arguments, const std::vector<ArmBlock>& blocks);

// Blocks that many cases share.
/// Every path, with one layout; 32-bit float HDR, so that only the path's own error is left.
ArmBlock every_path(const std::string& layout = "float32", const std::string& hdr = "rgba32f");
/// deferred, with every shipped layout.
ArmBlock every_layout(const std::string& hdr = "rgba32f");
/// The paths that find lights by lists.
ArmBlock every_listing_path(const std::string& layout = "float32", const std::string& hdr = "rgba32f");
/// The same with each way to build light lists (kListsAxis).
ArmBlock with_list_builders(ArmBlock block);

}  // namespace lightsweep
