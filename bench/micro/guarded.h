// How every benchmark of this program is registered.
#pragma once

#include <benchmark/benchmark.h>

#include <exception>
#include <string>
#include <utility>

namespace lightsweep {

/// Registers `body`, called as body(benchmark::State&). What it throws becomes the benchmark's error, so that the
/// others run and the files of the library are whole.
template <typename Body>
benchmark::internal::Benchmark* add_benchmark(const std::string& name, Body body) {
    return benchmark::RegisterBenchmark(name.c_str(), [body = std::move(body)](benchmark::State& state) {
        try {
            body(state);
        } catch (const std::exception& error) {
            state.SkipWithError(error.what());
        }
    });
}

}  // namespace lightsweep
