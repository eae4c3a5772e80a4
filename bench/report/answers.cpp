#include "bench/report/answers.h"

#include "bench/report/json_codec.h"
#include "bench/report/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lightsweep {
namespace {

using Points = std::vector<TimeErrorPoint>;

std::string words(const CellResult& cell) {
    const CellParams& arm = cell.params;
    std::string text = arm.path;
    if (!arm.layout.empty()) text += "/" + arm.layout;
    text += "/" + arm.hdr;
    for (const auto& word : switched(arm)) text += "/" + word;
    return text;
}

// `4.21 [4.18, 4.25]`; an open end is a question mark.
std::string words(const Interval& interval, double unit = 1.0) {
    const auto end = [&](const std::optional<double>& v) { return v ? fmt::format("{:.3g}", *v / unit) : "?"; };
    const std::string estimate = fmt::format("{:.3g}", interval.estimate / unit);
    if (!interval.low && !interval.high) return estimate;
    return fmt::format("{} [{}, {}]", estimate, end(interval.low), end(interval.high));
}

std::string time_words(const Interval& time_ns) { return words(time_ns, 1e6) + " ms"; }

std::string point_words(const TimeErrorPoint& point, std::string_view metric) {
    return fmt::format("{}, {}, {} {}", words(*point.cell), time_words(point.time_ns), metric, words(point.error));
}

double time_of(const TimeErrorPoint& point) { return point.time_ns.estimate; }
double error_of(const TimeErrorPoint& point) { return point.error.estimate; }

// Compares the first two of `within`, which are in the order of their medians, and sets them right.
void compare_times(Answer& answer, Points& within) {
    auto ratio = time_ratio(*within[0].cell, *within[1].cell, kIntervalLevel);
    if (ratio && ratio->ratio.estimate > 1.0) {
        std::swap(within[0], within[1]);
        ratio = time_ratio(*within[0].cell, *within[1].cell, kIntervalLevel);
    }
    Verdict judged = Verdict::ambiguous;
    if (ratio) {
        answer.ratio = ratio->ratio;
        const double level = level_for_each(kIntervalLevel, within.size() * (within.size() - 1) / 2);
        const auto wide = time_ratio(*within[0].cell, *within[1].cell, level);
        if (answer.floor) judged = verdict(wide->ratio, *answer.floor);
    }
    answer.verdict = word(judged);
}

// The errors of one picture are exact: no interval stands between them. `first` has none larger than `second`.
void compare_errors(Answer& answer, const TimeErrorPoint& first, const TimeErrorPoint& second) {
    if (error_of(second) > 0.0) answer.ratio = {.estimate = error_of(first) / error_of(second), .low = {}, .high = {}};
    answer.verdict = error_of(first) < error_of(second) ? "more_exact" : "same";
}

// `; 0.871 [0.85, 0.89] times the time of the runner-up, ...: faster`
std::string margin_words(const Answer& answer, const TimeErrorPoint& runner_up, std::string_view what,
                         std::string_view metric) {
    if (!answer.ratio) return fmt::format("; the runner-up, {}: {}", point_words(runner_up, metric), *answer.verdict);
    return fmt::format("; {} times the {} of the runner-up, {}: {}", words(*answer.ratio), what,
                       point_words(runner_up, metric), *answer.verdict);
}

// The most exact few; of more arms than that nobody reads the names.
std::string uncertain_words(Points uncertain) {
    constexpr size_t kNamed = 3;
    if (uncertain.empty()) return "";
    std::ranges::stable_sort(uncertain, {}, error_of);
    std::string text = "; uncertain, since the time's interval reaches over or is not known: ";
    for (size_t i = 0; i < std::min(kNamed, uncertain.size()); ++i) {
        text += (i > 0 ? "; " : "") + point_words(uncertain[i], kErrorMetric);
    }
    return uncertain.size() > kNamed ? fmt::format("{}; and {} more", text, uncertain.size() - kNamed) : text;
}

Answer no_arm(Answer answer, std::string reason) {
    answer.statement = reason;
    answer.reason = std::move(reason);
    return answer;
}

const char* const kNoErrors = "no arm has a time and an error against the reference";

}  // namespace

Answer cheapest_within(const GroupResult& group, const ErrorLimit& limit, std::optional<double> run_floor) {
    Answer answer;
    answer.group = group.group;
    answer.max_error = limit;
    answer.ratio_of = "wall_ns";
    answer.floor = floor_of(group, run_floor);
    const Points all = time_error_points(group, limit.metric);
    if (all.empty()) return no_arm(std::move(answer), kNoErrors);
    const std::string question = fmt::format("{} {:g}", limit.metric, limit.limit);
    Points within;
    std::ranges::copy_if(all, std::back_inserter(within), [&](const auto& p) { return error_of(p) <= limit.limit; });
    if (within.empty()) {
        const auto& nearest = *std::ranges::min_element(all, {}, error_of);
        return no_arm(std::move(answer), fmt::format("no arm is within {}; the most exact is {}", question,
                                                     point_words(nearest, limit.metric)));
    }
    std::ranges::stable_sort(within, {}, time_of);
    if (within.size() > 1) compare_times(answer, within);
    answer.arm = within[0].cell;
    answer.statement = fmt::format("the cheapest within {} is {}", question, point_words(within[0], limit.metric));
    if (within.size() > 1) {
        answer.runner_up = within[1].cell;
        answer.statement += margin_words(answer, within[1], "time", limit.metric);
    } else {
        answer.statement += "; no other arm is within it";
    }
    return answer;
}

Answer most_exact_within(const GroupResult& group, double max_time_ns) {
    Answer answer;
    answer.group = group.group;
    answer.max_time_ns = max_time_ns;
    answer.ratio_of = error_key(kErrorMetric);
    const Points all = time_error_points(group, kErrorMetric);
    if (all.empty()) return no_arm(std::move(answer), kNoErrors);
    const std::string question = fmt::format("{:g} ms", max_time_ns / 1e6);
    Points within;
    Points uncertain;
    for (const auto& point : all) {
        const auto& time = point.time_ns;
        if (time.high && *time.high <= max_time_ns) {
            within.push_back(point);
        } else if (time.low.value_or(time.estimate) <= max_time_ns) {
            answer.uncertain.push_back(point.cell);
            uncertain.push_back(point);
        }
    }
    if (within.empty()) {
        const auto& fastest = *std::ranges::min_element(all, {}, time_of);
        const auto nearest = uncertain.empty() ? fmt::format("; the fastest is {}", point_words(fastest, kErrorMetric))
                                               : uncertain_words(uncertain);
        return no_arm(std::move(answer), fmt::format("no arm is surely within {}{}", question, nearest));
    }
    std::ranges::stable_sort(within, {}, [](const auto& p) { return std::pair(error_of(p), time_of(p)); });
    answer.arm = within[0].cell;
    answer.statement =
        fmt::format("on this picture the most exact within {} is {}", question, point_words(within[0], kErrorMetric));
    if (within.size() > 1) {
        answer.runner_up = within[1].cell;
        compare_errors(answer, within[0], within[1]);
        answer.statement += margin_words(answer, within[1], "error", kErrorMetric);
    } else {
        answer.statement += "; no other arm is surely within it";
    }
    std::erase_if(uncertain, [&](const auto& p) { return error_of(p) >= error_of(within[0]); });
    answer.statement += uncertain_words(uncertain);
    return answer;
}

std::vector<Answer> answer_questions(const RunInfo& run, const std::vector<GroupResult>& groups,
                                     std::optional<double> run_floor) {
    std::vector<Answer> answers;
    for (const auto& group : groups) {
        if (run.max_error) answers.push_back(cheapest_within(group, *run.max_error, run_floor));
        if (run.max_time_ns) answers.push_back(most_exact_within(group, *run.max_time_ns));
    }
    return answers;
}

Json to_json(const Answer& answer) {
    const auto id = [](const CellResult* cell) { return cell ? Json(cell->id) : Json(nullptr); };
    const auto end = [&](auto of) { return answer.ratio ? codec::encode(of(*answer.ratio)) : Json(nullptr); };
    Json uncertain = Json::array();
    for (const CellResult* cell : answer.uncertain) uncertain.push_back(cell->id);
    return {{"group", answer.group},
            {"question",
             answer.max_error ? to_json(*answer.max_error) : Json{{"max_time_ns", codec::encode(*answer.max_time_ns)}}},
            {"arm", id(answer.arm)},
            {"runner_up", id(answer.runner_up)},
            {"ratio_of", answer.ratio_of},
            {"ratio", end([](const Interval& r) { return std::optional(r.estimate); })},
            {"low", end([](const Interval& r) { return r.low; })},
            {"high", end([](const Interval& r) { return r.high; })},
            {"verdict", codec::encode(answer.verdict)},
            {"floor", codec::encode(answer.floor)},
            {"uncertain", std::move(uncertain)},
            {"reason", codec::encode(answer.reason)},
            {"statement", answer.statement}};
}

}  // namespace lightsweep
