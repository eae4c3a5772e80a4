// How far a run is: a bar with the time left on a terminal, plain lines otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lightsweep {

class ProgressBar {
  public:
    /// `budget_s`: the run ends after that time at the latest. `word`: what a group is called.
    ProgressBar(size_t group_count, std::optional<double> budget_s, std::string word = "group");
    /// `fraction` of group `index`. Redraws at most ten times a second.
    void update(size_t index, double fraction, const std::string& group);
    /// A group is done: on a terminal the bar goes on, otherwise one line.
    void finish_group(size_t index, const std::string& line);
    void clear();

  private:
    bool terminal_;
    size_t count_;
    std::optional<double> budget_s_;
    std::string word_;
    int64_t start_ns_;
    int64_t drawn_ns_ = 0;
};

}  // namespace lightsweep
