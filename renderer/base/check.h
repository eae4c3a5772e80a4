// CHECK: a programmer's mistake ends the program with the expression, the place and the values. Never for user input.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace lightsweep::detail {
[[noreturn]] inline void check_failed(const char* file, int line, const char* expression, const std::string& values) {
    std::fputs(fmt::format("{}:{}: CHECK({}) failed{}{}\n", file, line, expression, values.empty() ? "" : ": ", values)
                   .c_str(),
               stderr);
    std::abort();
}
}  // namespace lightsweep::detail

#define CHECK(condition)                                                                          \
    do {                                                                                          \
        if (!(condition)) ::lightsweep::detail::check_failed(__FILE__, __LINE__, #condition, {}); \
    } while (false)

/// CHECK_THAT(a < b, "a = {}, b = {}", a, b): like CHECK, and prints the values.
#define CHECK_THAT(condition, ...)                                                                          \
    do {                                                                                                    \
        if (!(condition))                                                                                   \
            ::lightsweep::detail::check_failed(__FILE__, __LINE__, #condition, ::fmt::format(__VA_ARGS__)); \
    } while (false)
