// The journals of a plan's shards as one.
#pragma once

#include "bench/report/journal.h"

#include <filesystem>
#include <span>
#include <utility>

namespace lightsweep {

struct NamedJournal {
    std::filesystem::path file;
    JournalContent content;
};

/// One journal with the groups of all, in the order given; at least one. Of several, run and timer are the first one's,
/// with the shard 1/1 and the earliest start, so that shards left out make the report incomplete. Throws InputError,
/// naming the file, when a plan, program or environment differs from the first one's or a shard or group comes twice.
JournalContent merge_journals(std::span<const NamedJournal> journals);

}  // namespace lightsweep
