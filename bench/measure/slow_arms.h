// The arms of a run whose frame took too long to sample: with as many lights or more they are not drawn again.
#pragma once

#include "bench/report/record.h"

#include <map>
#include <optional>
#include <string>

namespace lightsweep {

class SlowArms {
  public:
    struct Found {
        int64_t lights = 0;  ///< with so many it was too slow
        std::string reason;  ///< that a cell with as many or more is not drawn
    };

    /// Takes over the cells with the status timeout.
    void remember(const GroupResult& group);

    /// `params`: a cell's, with the scene's own light count and overlap filled in.
    std::optional<Found> find(const CellParams& params) const;

  private:
    std::map<std::string, Found> by_arm_;  ///< the fewest lights of each
};

}  // namespace lightsweep
