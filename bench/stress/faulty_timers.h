// Frame timers with a fault planted in each, every one seen in some driver: what the self-test of timers must refuse.
#pragma once

#include "bench/measure/self_test.h"

#include <string>
#include <vector>

namespace lightsweep {

/// One of each fault, by its name. A timer may be taken for one test only.
std::vector<TimerUnderTest> faulty_timers();

/// What is wrong with verdicts on faulty timers: one line for each that was accepted, or refused without a reason; and
/// one if, with these to choose from alone, one would be chosen after all.
std::vector<std::string> wrong_verdicts(const std::vector<TimerMethodReport>& of_faulty);

}  // namespace lightsweep
