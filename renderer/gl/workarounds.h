// The one list of known driver problems. What the program does differently because of a driver is here, or nowhere.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace lightsweep::gl {

struct ContextInfo;

struct Workaround {
    const char* key;
    const char* paragraph;  ///< what the driver does; then "Acted on:" and how, or "Only reported:" and why
    bool (*applies)(const ContextInfo& info);
};

std::span<const Workaround> all_workarounds();

/// The keys of those that apply, in the order of the list: for the log and the report.
std::vector<std::string> active_workarounds(const ContextInfo& info);

}  // namespace lightsweep::gl
