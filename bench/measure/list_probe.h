// Which builder of light lists is faster on this device: both list the same lights for the same clusters. Tried, not
// assumed: software prefers the CPU, most GPUs do not.
#pragma once

#include "bench/report/record.h"
#include "renderer/frame/light_list_service.h"

#include <cstdint>
#include <optional>
#include <string>

namespace lightsweep {

struct ListProbe {
    int lights = 0;
    int64_t cpu_ns = 0;                 ///< median, to build and upload
    std::optional<int64_t> compute_ns;  ///< median; nothing: the device refuses
    std::string refusal{};              ///< why it does

    ListBuilder faster() const { return compute_ns && *compute_ns < cpu_ns ? ListBuilder::compute : ListBuilder::cpu; }
    /// `cpu 0.31 ms, compute 1.9 ms for 1,024 lights`
    std::string why() const;
};

/// On the current context: 1,024 lights, 16 of them at a point, in the clusters of a 1280x720 view of a hall. Takes a
/// fraction of a second.
ListProbe probe_light_lists();

/// For `lightsweep doctor`: lights, cpu_ns, compute_ns, faster, why.
Json to_json(const ListProbe& probe);

}  // namespace lightsweep
