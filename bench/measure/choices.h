// What the cells of a run that leave something open come to: who builds light lists, which path draws, what is skipped.
// Each is found out once and kept.
#pragma once

#include "bench/measure/arm.h"
#include "bench/measure/cost_model.h"
#include "bench/report/record.h"

#include <map>
#include <optional>
#include <string>

namespace lightsweep {

/// The cell as it was drawn, with nothing left to choose: the other way to what resolve() returned.
CellParams drawn_params(const CellResult& cell);

class Choices {
  public:
    /// Keeps references to both.
    Choices(FrameBuffers& buffers, const DrawShapes& shapes) : buffers_(&buffers), shapes_(&shapes) {}

    /// What path=auto decides by. Without it a cell that asks for it is invalid.
    void know_costs(CostModel costs) { costs_ = std::move(costs); }

    /// What the cells of a group that was measured before came to holds from here on.
    void remember(const GroupResult& group);

    /// The cell as it is drawn, with nothing left to choose; says in `cell` what was chosen. Throws InputError.
    CellParams resolve(const CellParams& params, const Subject& subject, CellResult& cell);

  private:
    PathChoice auto_path(const CellParams& drawn, const Subject& subject) const;
    const SkipChoice& auto_skips(const CellParams& drawn, const Subject& subject, const CellResult& cell);
    const ListChoice& auto_light_lists();

    FrameBuffers* buffers_;
    const DrawShapes* shapes_;
    std::optional<CostModel> costs_;
    std::optional<ListChoice> light_lists_;    ///< once it was asked for
    std::map<std::string, SkipChoice> skips_;  ///< by what the choice hangs on
};

}  // namespace lightsweep
