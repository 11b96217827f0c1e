#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test. See README.md.
# The tests of real models read the folder PARSEL_DATA (default: shared/data beside the checkout) and skip without it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../wasm/setup.sh"

if [ -z "${PARSEL_DATA:-}" ] && [ -d "$root/../shared/data" ]; then PARSEL_DATA=$(cd "$root/../shared/data" && pwd); fi
export PARSEL_DATA=${PARSEL_DATA:-}
[ -n "$PARSEL_DATA" ] || echo "PARSEL_DATA is not set: the tests of real models will be skipped."

need "$build_needs
$native_needs"
if ! has chromium && ! has google-chrome; then
  if grep -qs '^ID=ubuntu' /etc/os-release; then
    die "The browser tests want Chromium, which Ubuntu has only as a snap: run 'sudo snap install chromium' (or install google-chrome) and run again."
  fi
  need "chromium chromium"
fi
need "openscad openscad
blender blender
redis-server redis-server"
"$root/web/start.sh" --build-only
need_node

output=$root/tests/output
mkdir -p "$output"
failed=()
# run NAME COMMAND…: runs one suite, keeps its output for the closing count, goes on when it fails.
run() {
  local name=$1
  shift
  say "$name"
  if ! "$@" 2>&1 | tee "$output/$name.log"; then failed+=("$name"); fi
}

say "Building the native core with sanitizers"
configure_and_build native-debug
run lint npm --prefix "$root/web" run --silent lint
run doctest-native "$root/build/native-debug/tests/core/core_tests"
# Some tests nest hostile input deeper than Node's default stack of about 1 MB holds.
run doctest-wasm node --stack-size=4000 "$root/build/wasm/tests/core/core_tests.js"
run vitest npm --prefix "$root/web" run --silent test
run playwright npm --prefix "$root/web" run --silent e2e

node "$root/tests/count.mjs" "$output"/*.log
[ ${#failed[@]} -eq 0 ] || die "Failed: ${failed[*]}"
