#!/usr/bin/env bash
# Evaluates the core on real models and writes a report with pictures.
#   tests/eval/run.sh [FOLDER] [EDITS.json]
# FOLDER: GLBs with named parts; without it, Debian's furniture (see furniture.sh; 120 MB from Debian's servers), when
# there is one $PARSEL_DATA/furniture, the recorded replies (requests.mjs, judged_requests.mjs), and a page of all figures of
# the README (figures.mjs; --readme there puts them into it). EDITS.json: {"model": [{"name", "edit": parsel/edit}]}; models
# that it does not name get automatic edits (seeds.h). Reports: tests/output/eval/NAME/report.html and report.json; the two
# ends of the 20 worst edits as GLBs beside them.
# The page must be built for the pictures: this builds it when web/dist is missing.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../wasm/setup.sh"

if [ -z "${PARSEL_DATA:-}" ] && [ -d "$root/../shared/data" ]; then PARSEL_DATA=$(cd "$root/../shared/data" && pwd); fi
export PARSEL_DATA=${PARSEL_DATA:-}
need "$build_needs
$native_needs"
if ! has google-chrome; then need "chromium chromium"; fi
need_node
need_npm_packages
[ -e "$root/web/dist/index.html" ] || "$root/web/start.sh" --build-only
say "Building the evaluation"
targets="parsel_eval parsel" configure_and_build native-release

# evaluate NAME FOLDER [EDITS.json]
evaluate() {
  local output=$root/tests/output/eval/$1
  say "Evaluating $2"
  rm -rf "$output"
  mkdir -p "$output"
  "$root/build/native-release/tests/eval/parsel_eval" "$2" -o "$output" ${3:+--edits "$3"}
  node "$root/tests/eval/report.mjs" "$output" "$2" --sheets "$output/sheets" \
    --parsel "$root/build/native-release/core/parsel"
}

if [ $# -gt 0 ]; then
  evaluate "$(basename "$1")" "$@"
else
  models=$("$root/tests/eval/furniture.sh" | tail -n 1)
  evaluate debian "$models"
  if [ -d "${PARSEL_DATA:-/nowhere}/furniture" ]; then evaluate furniture "$PARSEL_DATA/furniture"; fi
  say "Measuring the recorded replies"
  node "$root/tests/eval/requests.mjs" --json "$root/tests/output/eval/requests.json"
  for set in harder paper; do
    results=$root/tests/output/eval/$set.json
    rm -f "$results"
    node "$root/tests/eval/judged_requests.mjs" $set --json "$results"
    if [ -e "$results" ]; then
      node "$root/tests/eval/paper/report.mjs" "$results"
      node "$root/tests/eval/cost.mjs" "$results"
    fi
  done
  node "$root/tests/eval/figures.mjs" "$root/tests/output/eval"
fi
