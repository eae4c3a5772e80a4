#!/usr/bin/env bash
# Searches for bytes that the program's readers do not refuse as they should, with Clang's libFuzzer and the address and
# undefined-behaviour sanitizers. What it finds is written to build/fuzz/findings/.
# Usage: scripts/fuzz.sh [SECONDS for each reader, 60] [READERS... all: scene gltf layout sweep report journal]
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
seconds=${1:-60}
shift || true
readers=("$@")
[[ ${#readers[@]} -gt 0 ]] || readers=(scene gltf layout sweep report journal)

"$root/scripts/install_packages.sh" clang libclang-rt-14-dev
build="$root/build/fuzz"
cmake -S "$root" -B "$build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-fsanitize=fuzzer-no-link \
    -DLIGHTSWEEP_SANITIZE=ON -DLIGHTSWEEP_FUZZ=ON
cmake --build "$build" --target "${readers[@]/#/fuzz_}"

findings="$build/findings"
status=0
for reader in "${readers[@]}"; do
    new_inputs="$build/new_inputs/$reader"
    mkdir -p "$new_inputs" "$findings"
    # A scene of a few bytes may ask for a large texture or a million instances: room for that, and time.
    "$build/tests/fuzz_$reader" -max_total_time="$seconds" -max_len=20000 -timeout=60 -rss_limit_mb=4096 \
        -artifact_prefix="$findings/$reader-" "$new_inputs" "$root/tests/fuzz/corpus/$reader" || status=1
done
exit $status
