#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test: units, GL, command line, floors, reports against their schema.
# Usage: scripts/test.sh [--preset release|dev|asan|clang] [ARGUMENTS OF ctest...]      on Debian 12, as root or with sudo.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

preset=release
if [[ ${1:-} == --preset && $# -ge 2 ]]; then
    preset=$2
    shift 2
fi
packages=()
case $preset in
    release | dev | asan) ;;
    clang) packages=(clang) ;;
    *)
        echo "test.sh: --preset $preset: unknown; allowed: release, dev, asan, clang" >&2
        exit 2
        ;;
esac

"$root/scripts/install_packages.sh" "${packages[@]}"
cmake -S "$root" --preset "$preset" --log-level=WARNING
cmake --build "$root/build/$preset"
# Tests that measure time are marked RUN_SERIAL where they are registered; the others may share the machine.
cd "$root"
ctest --preset "$preset" --parallel "$(nproc)" "$@"
