#include "renderer/gbuffer/layout_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lightsweep {
namespace {

// "rg", or "r[0-11] r[12-23]".
std::string places(const std::vector<Slot>& slots) {
    std::string text;
    for (const Slot& slot : slots) {
        const char component = "rgba"[slot.component];
        if (slot.bit_count == 0) {
            text += component;
        } else {
            text += fmt::format("{}{}[{}-{}]", text.empty() ? "" : " ", component, slot.low_bit,
                                slot.low_bit + slot.bit_count - 1);
        }
    }
    return text;
}

}  // namespace

std::string layout_json(const Layout& layout) {
    using Json = nlohmann::ordered_json;
    Json targets = Json::array();
    for (const auto& target : layout.targets) {
        Json fields = Json::array();
        for (const auto& stored : target.fields) {
            fields.push_back(
                {{"field", info(stored.field).name}, {"encoding", stored.encoding.key}, {"in", places(stored.slots)}});
        }
        targets.push_back(
            {{"name", target.name}, {"format", gl::info(target.format).name}, {"fields", std::move(fields)}});
    }
    const std::string& convention = depth_convention_names()[static_cast<size_t>(layout.convention)];
    const Json json = {{"summary", layout.summary},
                       {"depth", {{"format", gl::info(layout.depth).name}, {"convention", convention}}},
                       {"targets", std::move(targets)}};
    return json.dump(2) + "\n";
}

}  // namespace lightsweep
