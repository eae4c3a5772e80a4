#include "bench/measure/skip_proof.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lightsweep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string kind(CellParams cell) {
    cell.skip = kSkipEverything;
    return cell.name();
}

// Of two values that differ in some bit.
void take_difference(float a, float b, SkipProof& proof) {
    const double apart = std::abs(static_cast<double>(a) - b);
    if (!std::isfinite(apart)) {
        proof.max_abs = proof.max_rel = kInfinity;
        return;
    }
    const double larger = std::max(std::abs(a), std::abs(b));
    proof.max_abs = std::max(proof.max_abs, apart);
    if (larger > 0.0) proof.max_rel = std::max(proof.max_rel, apart / larger);
}

}  // namespace

SkipProof prove_same_picture(const std::string& compared_with, const Image& first, const Image& other) {
    CHECK_THAT(first.width == other.width && first.height == other.height, "{}x{} and {}x{}", first.width, first.height,
               other.width, other.height);
    SkipProof proof{.compared_with = compared_with};
    for (size_t pixel = 0; pixel < first.pixel_count(); ++pixel) {
        bool same = true;
        for (size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const float a = first.rgb[i], b = other.rgb[i];
            if (std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b)) continue;
            same = false;
            take_difference(a, b, proof);
        }
        proof.differing_px += same ? 0 : 1;
    }
    proof.same_bits = proof.differing_px == 0;
    return proof;
}

SkipProofs::SkipProofs(const std::vector<CellParams>& cells) {
    for (const auto& cell : cells) ++cells_of_kind_[kind(cell)];
}

bool SkipProofs::wants(const CellParams& cell) const {
    const auto found = cells_of_kind_.find(kind(cell));
    return found != cells_of_kind_.end() && found->second > 1;
}

std::optional<SkipProof> SkipProofs::prove(const CellResult& cell, Image hdr) {
    const std::string key = kind(cell.params) + (cell.auto_path ? " came to " + cell.auto_path->path : "");
    const std::string& skip = cell.params.skip;
    const auto [first, is_new] = first_of_kind_.try_emplace(key);
    if (is_new) {
        first->second = {.id = cell.id, .hdr = std::move(hdr)};
        return {};
    }
    const auto none = none_of_kind_.find(key);
    const bool nearer_to_none = none != none_of_kind_.end() && skip.starts_with(SkipSet::none().text());
    const Picture& other = nearer_to_none ? none->second : first->second;
    const SkipProof proof = prove_same_picture(other.id, other.hdr, hdr);
    if (skip == SkipSet::none().text()) none_of_kind_[key] = {.id = cell.id, .hdr = std::move(hdr)};
    return proof;
}

}  // namespace lightsweep
