#include "bench/report/journal.h"

#include "bench/report/sound.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json_reader.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace lightsweep {
namespace {

Json parse_line(std::string_view line, const std::string& where) {
    check_nesting(line, where);
    try {
        return Json::parse(line);
    } catch (const Json::exception& error) {
        throw InputError(where, fmt::format("not a journal's line: {}", error.what()));
    }
}

Json take(const Json& line, const char* key, const std::string& where) {
    if (!line.is_object() || !line.contains(key)) throw InputError(where, fmt::format("the key '{}' is missing", key));
    return line.at(key);
}

void require_kind(const Json& line, const char* kind, const std::string& where) {
    if (take(line, "kind", where) == kind) return;
    throw InputError(where,
                     fmt::format("a line of kind \"{}\" was expected, not {}", kind, line_text(line.at("kind"))));
}

}  // namespace

JournalContent read_journal(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    JournalContent journal;
    int number = 0;
    size_t begin = 0;
    for (size_t end = text.find('\n'); end != std::string::npos; begin = end + 1, end = text.find('\n', begin)) {
        const std::string where = fmt::format("{}:{}", file.string(), ++number);
        const Json line = parse_line(std::string_view(text).substr(begin, end - begin), where);
        if (number == 1) {
            require_kind(line, "run", where);
            require_schema(line.value("schema", Json()), where + ":/schema");
            journal.run = from_json<RunInfo>(take(line, "run", where), where + ":/run");
            journal.environment = from_json<Environment>(take(line, "environment", where), where + ":/environment");
            journal.timer = from_json<TimerReport>(take(line, "timer", where), where + ":/timer");
            continue;
        }
        require_kind(line, "group", where);
        auto group = from_json<GroupResult>(line, where + ":");
        require_sound(group, where + ":");
        for (const auto& before : journal.groups) {
            if (before.group == group.group) {
                throw InputError(where, fmt::format("the group '{}' stands twice in the journal", group.group));
            }
        }
        journal.groups.push_back(std::move(group));
    }
    if (number == 0) throw InputError(file.string(), "holds no complete line: nothing was finished; start a new run");
    return journal;
}

std::set<std::string> finished_groups(const JournalContent& journal, const std::filesystem::path& file,
                                      const RunInfo& run, const Environment& environment) {
    const auto require_same = [&](const char* what, const auto& then, const auto& now) {
        if (then == now) return;
        throw InputError(file.string(), fmt::format("cannot be continued: its {} is {}, this run's is {}; repeat the "
                                                    "run as it was started, or start a new one",
                                                    what, then, now));
    };
    require_same("plan", journal.run.plan_hash, run.plan_hash);
    require_same("shard", fmt::format("{}/{}", journal.run.shard.index, journal.run.shard.count),
                 fmt::format("{}/{}", run.shard.index, run.shard.count));
    require_same("seed", journal.run.seed, run.seed);
    require_same("program version", journal.run.version, run.version);
    require_same("git commit", journal.run.git_commit.value_or("unknown"), run.git_commit.value_or("unknown"));
    const auto limit = [](const RunInfo& r) { return r.max_frame_s ? fmt::format("{} s", *r.max_frame_s) : "none"; };
    require_same("longest frame", limit(journal.run), limit(run));
    require_same("build type", journal.run.build_type, run.build_type);
    if (journal.environment.fingerprint != environment.fingerprint) {
        throw InputError(file.string(), "cannot be continued: its environment is not this one's (" +
                                            environment_difference(journal.environment, environment) +
                                            "); start a new run");
    }
    std::set<std::string> keys;
    for (const auto& group : journal.groups) keys.insert(group.group);
    return keys;
}

JournalWriter JournalWriter::create(const std::filesystem::path& file, const RunInfo& run,
                                    const Environment& environment, const TimerReport& timer) {
    JournalWriter writer(file, O_CREAT | O_EXCL);
    writer.append_line({{"kind", "run"},
                        {"schema", kReportSchema},
                        {"run", to_json(run)},
                        {"environment", to_json(environment)},
                        {"timer", to_json(timer)}});
    return writer;
}

JournalWriter JournalWriter::resume(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    const size_t last_break = text.rfind('\n');
    JournalWriter writer(file, 0);
    const size_t complete = last_break == std::string::npos ? 0 : last_break + 1;
    if (::ftruncate(writer.descriptor_, static_cast<off_t>(complete)) != 0)
        writer.fail("its torn end cannot be cut off");
    return writer;
}

JournalWriter::JournalWriter(std::filesystem::path file, int flags)
    : file_(std::move(file)), descriptor_(::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | flags, 0666)) {
    if (descriptor_ >= 0) return;
    if (errno == EEXIST) {
        throw InputError(file_.string(),
                         "exists already and may hold results; resume it, remove it, or write elsewhere");
    }
    fail("cannot be opened for writing");
}

JournalWriter::JournalWriter(JournalWriter&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

JournalWriter::~JournalWriter() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void JournalWriter::append(const GroupResult& group) {
    Json line{{"kind", "group"}};
    line.update(to_json(group));
    append_line(line);
}

void JournalWriter::append_line(const Json& json) {
    const std::string text = line_text(json) + '\n';
    std::string_view rest = text;
    while (!rest.empty()) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("cannot be written");
        rest.remove_prefix(static_cast<size_t>(written));
    }
    if (::fsync(descriptor_) != 0) fail("cannot be flushed to disk");
}

void JournalWriter::fail(const char* what) const {
    throw InputError(file_.string(), fmt::format("{}: {}", what, std::strerror(errno)));
}

}  // namespace lightsweep
