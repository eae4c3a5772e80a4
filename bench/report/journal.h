// journal.jsonl: what is safe on disk while a run goes on. The first line holds the run, each further line one finished
// group. A line counts once its line break is written, so a process may be killed at any moment.
#pragma once

#include "bench/report/record.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace lightsweep {

struct JournalContent {
    RunInfo run;
    Environment environment;
    TimerReport timer;
    std::vector<GroupResult> groups;  ///< in the order finished, each once
};

/// A last line without its line break is left out; anything else that is not a journal's line is refused. Throws
/// InputError with `file:line`.
JournalContent read_journal(const std::filesystem::path& file);

/// The groups that need not run again. Throws InputError, saying what differs, unless the journal is of the same plan,
/// shard, seed, program and environment: samples of two of them do not belong into one report.
std::set<std::string> finished_groups(const JournalContent& journal, const std::filesystem::path& file,
                                      const RunInfo& run, const Environment& environment);

/// Appends lines, each flushed to disk before the call returns. Throws InputError naming the file.
class JournalWriter {
  public:
    /// Starts a journal with its first line. Refuses a file that exists: it may hold results.
    static JournalWriter create(const std::filesystem::path& file, const RunInfo& run, const Environment& environment,
                                const TimerReport& timer);
    /// Continues one; a torn last line is cut off.
    static JournalWriter resume(const std::filesystem::path& file);

    JournalWriter(JournalWriter&& other) noexcept;
    JournalWriter& operator=(JournalWriter&&) = delete;
    ~JournalWriter();

    void append(const GroupResult& group);

  private:
    JournalWriter(std::filesystem::path file, int flags);
    void append_line(const Json& json);
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace lightsweep
