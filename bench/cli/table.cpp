#include "bench/cli/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightsweep {
namespace {

// Code points, not bytes: the cells hold a few signs beyond ASCII.
size_t width(const std::string& text) {
    return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool numeric(const std::string& text) {
    return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) != 0 || text[0] == '-');
}

}  // namespace

std::string Table::text() const {
    std::vector<size_t> widths(rows_.front().size(), 0);
    std::vector<bool> right(rows_.front().size(), rows_.size() > 1);
    for (const auto& row : rows_) {
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
    }
    for (size_t r = 1; r < rows_.size(); ++r) {
        for (size_t i = 0; i < right.size(); ++i) right[i] = right[i] && numeric(rows_[r][i]);
    }
    std::string out;
    for (size_t r = 0; r < rows_.size(); ++r) {
        std::string line;
        for (size_t i = 0; i < rows_[r].size(); ++i) {
            const std::string padding(widths[i] - width(rows_[r][i]), ' ');
            line += (i == 0 ? "" : "  ") + (right[i] ? padding + rows_[r][i] : rows_[r][i] + padding);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
        if (r == 0) out += std::string(width(line), '-') + "\n";
    }
    return out;
}

TimeUnit time_unit(double ns) {
    if (ns < 1e3) return {"ns", 1.0};
    if (ns < 1e6) return {"us", 1e3};
    if (ns < 1e9) return {"ms", 1e6};
    return {"s", 1e9};
}

std::string time_number(double ns, const TimeUnit& unit) {
    const double v = ns / unit.ns;
    return fmt::format("{:.{}f}", v, unit.ns == 1.0 ? 0 : v < 9.995 ? 2 : v < 99.95 ? 1 : 0);
}

std::string time_text(double ns) {
    const TimeUnit unit = time_unit(ns);
    return fmt::format("{} {}", time_number(ns, unit), unit.name);
}

}  // namespace lightsweep
