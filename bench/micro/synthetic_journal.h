// A journal as a run writes it, its times drawn at random: input for timing what makes and reads reports.
#pragma once

#include "bench/report/journal.h"

namespace lightsweep {

inline constexpr int kSyntheticArms = 8;  ///< cells in a group

/// `groups` light counts, each with kSyntheticArms arms of `frames` frames and a twin of its first.
JournalContent synthetic_journal(int groups, int frames);

}  // namespace lightsweep
