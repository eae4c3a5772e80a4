// What counts as a wrong answer to a request for more than there is.
#include "bench/stress/refusals.h"

#include "renderer/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace lightsweep {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::string done_right() { return {}; }

TEST(Refusals, ARefusalWithAMessageIsRight) {
    for (const Answer due : {Answer::refused, Answer::refused_or_right}) {
        EXPECT_THAT(wrong_answer(due, []() -> std::string { throw EnvironmentError("too large"); }), IsEmpty());
        EXPECT_THAT(wrong_answer(due, []() -> std::string { throw InputError("size", "too large"); }), IsEmpty());
    }
    EXPECT_THAT(wrong_answer(Answer::refused_or_right, done_right), IsEmpty());
    EXPECT_THAT(wrong_answer(Answer::right, done_right), IsEmpty());
}

TEST(Refusals, WhatIsNotRefusedIsWrong) {
    EXPECT_THAT(wrong_answer(Answer::refused, done_right), HasSubstr("not refused"));
    EXPECT_THAT(wrong_answer(Answer::right, []() -> std::string { throw EnvironmentError("no"); }), HasSubstr("no"));
    const auto black = [] { return std::string("a picture is black"); };
    for (const Answer due : {Answer::refused, Answer::refused_or_right}) {
        EXPECT_THAT(wrong_answer(due, black), HasSubstr("black"));
        EXPECT_THAT(wrong_answer(due, []() -> std::string { throw EnvironmentError(""); }), HasSubstr("word"));
        EXPECT_THAT(wrong_answer(due, []() -> std::string { throw std::runtime_error("GL"); }), HasSubstr("GL"));
        EXPECT_THAT(wrong_answer(due, []() -> std::string { throw std::bad_alloc(); }), HasSubstr("broke"));
    }
}

}  // namespace
}  // namespace lightsweep
