// What the cells of a group are compared with, the control arm's picture and the reference, and how far they are from
// it.
#pragma once

#include "bench/measure/arm.h"
#include "bench/measure/cell_error.h"
#include "bench/measure/reference_store.h"
#include "bench/report/record.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// Of one group.
struct Truth {
    std::optional<Picture> control;
    std::optional<Reference> reference;
    std::optional<int64_t> light_hits;
    std::vector<std::string> failures;                ///< why there is none of these
    std::map<uint64_t, CellError> errors_of_picture;  ///< by a hash of its texels: many paths give the very same one
};

/// The control arm of a group: nothing packed. What its cells' pictures differ from this one's is the packing's doing.
/// With many lights it takes the listed ones alone, which gives the same picture sooner.
CellParams control_cell(const CellParams& any_cell_of_group, size_t light_count);

class TruthFinder {
  public:
    /// Keeps references to both.
    TruthFinder(FrameBuffers& buffers, const DrawShapes& shapes) : buffers_(&buffers), shapes_(&shapes) {}

    /// Never throws: the truth says what it lacks. Writes down `result.reference`, and what frames took.
    Truth find(const CellParams& any_cell_of_group, const Subject& subject, GroupResult& result);

    /// Of the arm's last frame. `maps_folder`: where the cell's FLIP map goes, as <id>.png; empty: nowhere.
    CellError error(const Arm& arm, const Subject& subject, const std::filesystem::path& maps_folder, Truth& truth,
                    CellResult& cell);

  private:
    const LayoutError& layout_error_of(const CellParams& params, const Arm& arm, const Subject& subject);

    FrameBuffers* buffers_;
    const DrawShapes* shapes_;
    ReferenceStore references_;
    std::map<std::string, LayoutError> layout_errors_;  ///< by scene, size and layout: lights change nothing here
};

}  // namespace lightsweep
