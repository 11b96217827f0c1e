#!/usr/bin/env bash
# Runs every benchmark and shows what became slower or faster since the last record.
#   tests/bench/run.sh [--record] [--sympy SECONDS]
#     --record   appends the figures to tests/bench/results.csv
#     --sympy    also runs the paper's procedure with SymPy (python3-sympy) on a few small cases, SECONDS each at most
# Furniture is measured when PARSEL_DATA names a folder with it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../wasm/setup.sh"

record=false
sympy=0
while [ $# -gt 0 ]; do
  case $1 in
    --record) record=true ;;
    --sympy)
      [ $# -ge 2 ] || die "--sympy needs a number of seconds."
      sympy=$2
      shift
      ;;
    *) die "Usage: tests/bench/run.sh [--record] [--sympy SECONDS]" ;;
  esac
  shift
done

if [ -z "${PARSEL_DATA:-}" ] && [ -d "$root/../shared/data" ]; then PARSEL_DATA=$(cd "$root/../shared/data" && pwd); fi
export PARSEL_DATA=${PARSEL_DATA:-}
need "$build_needs
$native_needs"
"$root/web/start.sh" --build-only
need_node
say "Building the native core, optimised"
targets="parsel benchmarks" configure_and_build native-release

output=$root/tests/output/bench
mkdir -p "$output"
figures=$output/figures.csv
: > "$figures"
tool=$root/build/native-release/core/parsel
# measure COMMAND…: its lines, on the screen and among the figures.
measure() { "$@" | tee -a "$figures"; }

for program in abstraction evaluate propagate prove ablation; do
  measure "$root/build/native-release/tests/bench/bench_$program"
done
"$tool" gallery "$output" --wall 100
measure node "$root/tests/bench/core.bench.mjs" "$output"/shelf_wall_100.glb
measure node "$root/tests/bench/split.bench.mjs"
measure node --expose-gc "$root/tests/bench/program.bench.mjs"
measure node "$root/tests/bench/runtime.bench.mjs"
measure node "$root/tests/bench/batch.bench.mjs"
measure node "$root/tests/bench/ranking.bench.mjs"
measure node "$root/web/runtime/build.mjs" --figures
measure node "$root/web/tools/sizes.mjs" --figures
if ! has chromium && ! has google-chrome; then need "chromium chromium"; fi
npm --prefix "$root/web" run --silent bench:page | grep '^page,' | tee -a "$figures"
if [ "$sympy" -gt 0 ]; then
  need "/usr/lib/python3/dist-packages/sympy/__init__.py python3-sympy"
  "$tool" gallery "$output" > /dev/null
  measure node "$root/tests/bench/sympy_ratio.mjs" "$output" "$sympy"
fi
if $record; then set -- --record; else set --; fi
node "$root/tests/bench/compare.mjs" "$figures" "$@"
