// A journal's content to report.json: everything derived is derived here, by pure functions, from raw samples.
#pragma once

#include "bench/report/journal.h"

namespace lightsweep {

/// The report, as results/report.schema.json describes it.
Json assemble_report(const JournalContent& journal);

}  // namespace lightsweep
