#!/usr/bin/env bash
# Installs what is missing, builds the page and serves it. See README.md.
#   ./web/start.sh [--build-only] [--port N]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../wasm/setup.sh"

build_only=false
port=4173
while [ $# -gt 0 ]; do
  case $1 in
    --build-only) build_only=true ;;
    --port)
      [ $# -ge 2 ] || die "--port needs a number."
      port=$2
      shift
      ;;
    *) die "Usage: ./web/start.sh [--build-only] [--port N]" ;;
  esac
  shift
done

need "$build_needs"
need_node
need_emscripten
need_npm_packages

say "Building the core for WebAssembly"
build_wasm
node "$root/web/tools/gallery.mjs" || die "The gallery could not be written; the lines above say why."
node "$root/web/tools/recordings.mjs" || die "The recorded replies could not be written; the lines above say why."
say "Building the page"
(cd "$root/web" && npm run --silent build -- --logLevel warn) || die "Building the page failed; the lines above say why."
npm --prefix "$root/web" run --silent headless || die "Building the package of the command line failed; the lines above say why."
node "$root/web/tools/sizes.mjs"
echo "The page is in web/dist: a static site for any server and any path."
$build_only && exit

say "Serving the page (Ctrl+C stops)"
cd "$root/web"
exec npx vite preview --port "$port" --strictPort
