// The answer a user came for: the cheapest arm within an error, or the most exact one within a time, and by how much it
// wins. Pure functions of samples.
#pragma once

#include "bench/report/time_error.h"

#include <optional>
#include <string>
#include <vector>

namespace lightsweep {

/// The answer for one group. The cells are those of the group it was made from.
struct Answer {
    std::string group;
    std::optional<ErrorLimit> max_error;    ///< the question: this,
    std::optional<double> max_time_ns;      ///< or this
    const CellResult* arm = nullptr;        ///< the winner; none: see reason
    const CellResult* runner_up = nullptr;  ///< who would win without it
    std::string ratio_of;                   ///< what `ratio` is of: wall_ns, or the error's key
    std::optional<Interval> ratio;          ///< winner over runner-up, of errors without ends; nothing of 0 over 0
    /// Of the winner against the runner-up. Times: word(Verdict). Errors: `more_exact` or `same` (equal).
    std::optional<std::string> verdict;
    std::optional<double> floor;               ///< the noise floor that times were judged by
    std::vector<const CellResult*> uncertain;  ///< that may be within max_time_ns, or not
    std::optional<std::string> reason;         ///< why there is no arm
    std::string statement;                     ///< all of it in one sentence
};

/// Of the arms whose error is at most the limit the one with the smallest median time. Between the first two the paired
/// ratio decides, which drift does not touch. Its interval is of kIntervalLevel; the verdict is given on one so wide
/// that it holds for every pair of the arms within, since the two were chosen by their times.
Answer cheapest_within(const GroupResult& group, const ErrorLimit& limit, std::optional<double> run_floor);

/// Of the arms whose time's interval lies within the limit the one with the smallest kErrorMetric; of equal ones the
/// fastest. An arm whose interval reaches over the limit is uncertain, and so is one within it by its median alone. The
/// errors are exact numbers of this picture, and so is their ratio; the statement names each with its interval over the
/// picture's regions, which says how much it hangs on what the picture shows.
Answer most_exact_within(const GroupResult& group, double max_time_ns);

/// What the run asked, of each group in turn. Nothing asked: none.
std::vector<Answer> answer_questions(const RunInfo& run, const std::vector<GroupResult>& groups,
                                     std::optional<double> run_floor);

Json to_json(const Answer& answer);

}  // namespace lightsweep
