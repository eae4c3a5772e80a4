// Columns of text for the terminal.
#pragma once

#include <string>
#include <vector>

namespace lightsweep {

class Table {
  public:
    explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    size_t size() const { return rows_.size() - 1; }
    /// Columns as wide as their widest cell; a column in which every cell is a number (with its unit) is set right.
    std::string text() const;

  private:
    std::vector<std::vector<std::string>> rows_;
};

struct TimeUnit {
    const char* name = "ns";
    double ns = 1.0;
};

/// The largest in which the time is 1 or more: ns, us, ms, s.
TimeUnit time_unit(double ns);
/// `12.3`, `850`: in that unit, with three significant digits; below 1 with two decimals, from 1000 on in full.
std::string time_number(double ns, const TimeUnit& unit);
/// `12.3 ms`, `850 us`, `2.41 s`
std::string time_text(double ns);

}  // namespace lightsweep
