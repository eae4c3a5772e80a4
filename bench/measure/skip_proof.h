// That what a cell skips changes nothing: its picture against that of a cell that differs from it in skips alone.
#pragma once

#include "bench/report/record.h"
#include "renderer/image/image.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// `compared_with` and its picture against another one of the same size.
SkipProof prove_same_picture(const std::string& compared_with, const Image& first, const Image& other);

/// The pictures of one group. Keeps the first of those kinds that have several cells, and that
/// of skip=none.
class SkipProofs {
  public:
    explicit SkipProofs(const std::vector<CellParams>& cells);

    /// Whether another cell of the group may be compared with this one: then its picture is worth reading.
    bool wants(const CellParams& cell) const;

    /// Against the first cell of its kind; sets that are nearer to none against skip=none, where that was drawn before.
    /// Nothing for the first cell. Cells of path=auto that came to different paths are of different kinds.
    std::optional<SkipProof> prove(const CellResult& cell, Image hdr);

  private:
    struct Picture {
        std::string id;
        Image hdr;
    };
    std::map<std::string, int> cells_of_kind_;
    std::map<std::string, Picture> first_of_kind_, none_of_kind_;
};

}  // namespace lightsweep
