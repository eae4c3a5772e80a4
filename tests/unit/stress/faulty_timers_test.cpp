// The verdict on verdicts: a faulty timer that a self-test believes is found. No context, no clock.
#include "bench/stress/faulty_timers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightsweep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TimerMethodReport report(const std::string& method, bool accepted, const std::string& why) {
    TimerMethodReport result;
    result.method = method;
    result.accepted = accepted;
    result.why = why;
    return result;
}

TEST(FaultyTimers, AllRefusedWithAReasonIsRight) {
    EXPECT_THAT(wrong_verdicts({report("zero", false, "says 0"), report("half", false, "says half")}), IsEmpty());
}

TEST(FaultyTimers, OneThatIsBelievedIsWrong) {
    EXPECT_THAT(wrong_verdicts({report("zero", false, "says 0"), report("half", true, "agrees")}),
                ElementsAre(HasSubstr("half is believed"), HasSubstr("half is chosen")));
}

TEST(FaultyTimers, ARefusalWithoutAReasonIsWrong) {
    EXPECT_THAT(wrong_verdicts({report("zero", false, "")}), ElementsAre(HasSubstr("without a reason")));
}

}  // namespace
}  // namespace lightsweep
