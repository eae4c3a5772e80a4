#!/usr/bin/env bash
# Installs what is missing, builds Release, measures, and plots what was measured.
# Usage: scripts/bench.sh [ARGUMENTS OF lightsweep run...]      on Debian 12, as root or with sudo; exit code of the run.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$root/build/release"

# The folder of the report: the one given, or one of our own, so that the plots find it.
out=
previous=
for argument in "$@"; do
    [[ $previous != --out ]] || out=$argument
    [[ $argument != --out=* ]] || out=${argument#--out=}
    previous=$argument
done
arguments=("$@")
if [[ -z $out ]]; then
    out="out/$(date +%Y-%m-%dT%H-%M-%S)"
    arguments+=(--out "$out")
fi

# What the preparations say is no result: it goes to stderr.
{
    "$root/scripts/install_packages.sh"
    cmake -S "$root" --preset release --log-level=WARNING
    cmake --build "$build" --target lightsweep
} >&2

started="$(mktemp)"
trap 'rm -f "$started"' EXIT
code=0
"$build/lightsweep" run "${arguments[@]}" || code=$?

# Also after failed cells (4) and an interruption (5): what was measured is worth a look.
report="$out/report.json"
if [[ ($code -eq 0 || $code -eq 4 || $code -eq 5) && $report -nt $started ]]; then
    plotted=0
    pictures="$(/usr/bin/python3 "$root/scripts/plot.py" "$report" --out "$out")" || plotted=$?
    echo "pictures:"
    echo "  ${pictures//$'\n'/$'\n'  }"
    [[ $code -ne 0 ]] || code=$plotted
fi
exit "$code"
