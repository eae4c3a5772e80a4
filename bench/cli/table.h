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

/// `12.3 ms`, `850 us`, `2.41 s`: three significant digits.
std::string time_text(double ns);

}  // namespace lightsweep
