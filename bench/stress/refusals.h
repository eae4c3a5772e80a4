// What should come of asking for more than there is: a message, not a wrong picture, and never an end of the program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace lightsweep {

enum class Answer : uint8_t {
    right,             ///< it is done, and done right
    refused,           ///< with an InputError or EnvironmentError that says something
    refused_or_right,  ///< either
};

/// Asks for something. `ask` returns what is wrong with what it got, in a few words; empty: nothing.
/// Returns what is wrong with the answer: nothing when it is the one that is due.
std::string wrong_answer(Answer due, const std::function<std::string()>& ask);

}  // namespace lightsweep
