// What a renderer may leave out because a scene or a frame does not need it, each a switch. Whoever leaves something
// out asks a SkipSet, and what the scene needs stands in SceneNeeds (renderer/frame/needs.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lightsweep {

enum class Skip : uint8_t {
    frustum,
    light_frustum,
    light_lists,
    light_depth,
    occlusion,
    backface,
    sort,
    fields,
    passes,
    code,
    background,
    clears,
    cells,
};
inline constexpr size_t kSkipCount = 13;

struct SkipInfo {
    Skip skip;
    std::string_view key;
    std::string_view what;  ///< is left out, and why that is safe, in a line
    /// The picture with it equals the one without it in every bit. Otherwise within rounding, since constants stand for
    /// what was stored; or but for slivers (backface).
    bool same_bits;
};

/// By value.
const std::array<SkipInfo, kSkipCount>& skip_infos();
inline std::string_view skip_key(Skip skip) { return skip_infos()[static_cast<size_t>(skip)].key; }

class SkipSet {
  public:
    static constexpr SkipSet all() { return SkipSet((1U << kSkipCount) - 1U); }
    static constexpr SkipSet none() { return SkipSet(0); }

    constexpr bool has(Skip skip) const { return (bits_ >> static_cast<unsigned>(skip) & 1U) != 0; }
    constexpr SkipSet with(Skip skip) const { return SkipSet(bits_ | 1U << static_cast<unsigned>(skip)); }
    constexpr SkipSet without(Skip skip) const { return SkipSet(bits_ & ~(1U << static_cast<unsigned>(skip))); }
    constexpr bool operator==(const SkipSet&) const = default;

    /// `all`, `none`, `all-frustum-sort`, `none+light_lists`: the shorter of the two ways, in the order of the table.
    std::string text() const;

  private:
    explicit constexpr SkipSet(unsigned bits) : bits_(bits) {}
    unsigned bits_;
};

/// The inverse of text(); keys may stand in any order, and both signs may follow either word. Nothing when the text is
/// not a set.
std::optional<SkipSet> parse_skips(std::string_view text);

}  // namespace lightsweep
