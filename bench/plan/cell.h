// One point of a sweep: its parameters, the one line of text that names it everywhere, and what is derived from that
// line. Knows no scene and no GL: the scene's own light count stays "default" here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightsweep {

inline constexpr int kMaxLights = 1'048'576;
inline constexpr int kMaxExtentPx = 65'536;
/// Formats of the HDR target, the default first.
extern const std::vector<std::string> kHdrFormats;
/// What builds the light lists. The first, the default, stands for the one of the others that is faster on the device.
extern const std::vector<std::string> kLightListBuilders;
inline constexpr const char* kAutoLightLists = "auto";
/// Whether shaders guard what may divide by zero, overflow or lose all digits; on, the default, first.
extern const std::vector<std::string> kGuards;
/// How a pixel's lights are added up; plainly, the default, first.
extern const std::vector<std::string> kSums;
inline constexpr const char* kCompensatedSums = "compensated";
/// The path that stands for the one expected to be fastest (cost_model.h of bench/measure). Not among those of `*`.
inline constexpr const char* kAutoPath = "auto";
/// What is skipped unless a cell says otherwise.
inline constexpr const char* kSkipEverything = "all";
/// The skips that are worth their cost in this cell (skip_choice.h of bench/measure).
inline constexpr const char* kAutoSkip = "auto";

struct CellParams {
    std::string scene;              ///< key or file
    std::optional<int> lights;      ///< [0, kMaxLights]; nothing: the scene's own count
    int width = 640;                ///< px, [1, kMaxExtentPx]
    int height = 360;               ///< px, [1, kMaxExtentPx]
    std::optional<double> overlap;  ///< lights reaching a point, > 0; 0: fixed radius; nothing: the scene's own regime
    std::string path;               ///< key
    std::string layout;             ///< key or file; empty for paths without one
    std::string light_lists{};      ///< one of kLightListBuilders; empty for paths that list no lights
    std::string hdr = "rgba16f";    ///< one of kHdrFormats
    std::string skip = kSkipEverything;  ///< SkipSet::text(), or auto
    std::string guards = "on";           ///< one of kGuards
    std::string sums = "plain";          ///< one of kSums

    bool operator==(const CellParams&) const = default;

    /// `scene=atrium lights=64 size=640x360 path=deferred layout=oct16 hdr=rgba16f`: canonical, so that equal cells
    /// have equal names. What is left out: the scene's own overlap regime, the layout and the light lists of a path
    /// without them, skip=all, guards=on and sums=plain.
    std::string name() const;
    /// The part of the name that the cells compared with each other share: scene, lights, size, overlap.
    std::string group() const;
    /// hash_hex of the name; the same in every shard.
    std::string id() const;
};

/// One `key=value` word of a cell's name. The table of them is also the table of a sweep's axes.
struct CellField {
    std::string name;
    std::string allowed;  ///< what a user may write as one value, for messages and help
    bool of_group;        ///< part of the group's key
    /// Empty: left out of the name.
    std::string (*text)(const CellParams&);
    /// False: the value is not allowed. Throws InputError where it can say more than that.
    bool (*set)(CellParams&, const std::string& value);
};

/// scene, lights, size, overlap, path, layout, light_lists, hdr, skip, guards, sums: in the order of the name.
const std::vector<CellField>& cell_fields();

/// What the cell has switched, skip, guards and sums, otherwise than they are by default: `skip=none`, `guards=off`.
std::vector<std::string> switched(const CellParams& cell);
/// Throws InputError with the nearest name.
const CellField& find_cell_field(std::string_view name);

/// Sets one field from its text. Throws InputError naming field, value and what is allowed. Whether a scene, path or
/// layout of that name exists is not its business.
void set_cell_field(CellParams& cell, const CellField& field, const std::string& value);

/// The inverse of CellParams::name(). Throws InputError.
CellParams parse_cell(std::string_view name);

}  // namespace lightsweep
