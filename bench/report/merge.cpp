#include "bench/report/merge.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"

#include <algorithm>
#include <map>

namespace lightsweep {
namespace {

void require_mergeable(const NamedJournal& first, const NamedJournal& other) {
    const auto require_same = [&](const char* what, const auto& a, const auto& b) {
        if (a == b) return;
        throw InputError(other.file.string(), fmt::format("cannot be merged with {}: its {} is {}, not {}",
                                                          first.file.string(), what, b, a));
    };
    const RunInfo& a = first.content.run;
    const RunInfo& b = other.content.run;
    require_same("plan", a.plan_hash, b.plan_hash);
    require_same("number of shards", a.shard.count, b.shard.count);
    require_same("program version", a.version, b.version);
    require_same("git commit", a.git_commit.value_or("unknown"), b.git_commit.value_or("unknown"));
    require_same("build type", a.build_type, b.build_type);
    if (first.content.environment.fingerprint != other.content.environment.fingerprint) {
        throw InputError(other.file.string(),
                         fmt::format("cannot be merged with {}: the environments differ ({})", first.file.string(),
                                     environment_difference(first.content.environment, other.content.environment)));
    }
}

}  // namespace

JournalContent merge_journals(std::span<const NamedJournal> journals) {
    CHECK(!journals.empty());
    if (journals.size() == 1) return journals.front().content;
    JournalContent merged = journals.front().content;
    merged.groups.clear();
    merged.run.shard = {};
    merged.run.planned_cells = merged.run.plan_cells;

    std::map<int, std::string> file_of_shard;
    std::map<std::string, std::string> file_of_group;
    for (const auto& journal : journals) {
        require_mergeable(journals.front(), journal);
        const std::string file = journal.file.string();
        const auto require_new = [&](auto& seen, const auto& key, const char* what) {
            const auto [entry, is_new] = seen.try_emplace(key, file);
            if (!is_new) throw InputError(file, fmt::format("the {} {} is in {} already", what, key, entry->second));
        };
        require_new(file_of_shard, journal.content.run.shard.index, "shard");
        for (const auto& group : journal.content.groups) {
            require_new(file_of_group, group.group, "group");
            merged.groups.push_back(group);
        }
        merged.run.started_at = std::min(merged.run.started_at, journal.content.run.started_at);
    }
    return merged;
}

}  // namespace lightsweep
