#!/usr/bin/env bash
# Builds CLN and GiNaC for WebAssembly into a cache outside the tree, once for each set of sources, recipes and compiler,
# and prints the folder that holds include/ and lib/ on its last line. Needs emcc, cmake, ninja, python3, bison, flex.
#   PARSEL_CACHE    where to keep downloads and builds (default: ~/.cache/parsel)
#   PARSEL_SOURCES  a folder that already holds the tarballs of sources.sha256, for machines without a network
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cache=${PARSEL_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/parsel}
# shellcheck source=wasm/deps/fetch.sh
source "$here/fetch.sh"

# Every object file that is linked together must be built with the same exception scheme.
flags="-O3 -fwasm-exceptions"
key=$({ cat "$here/sources.sha256"; find "$here" -type f ! -name '*.md' -print0 | sort -z | xargs -0 cat; \
        emcc --version | sed -n 1p; echo "$flags"; } | sha256sum | cut -c1-16)
prefix=$cache/wasm-deps-$key
if [ -e "$prefix/complete" ]; then
  echo "$prefix"
  exit 0
fi

mkdir -p "$cache"
exec 9> "$cache/wasm-deps.lock"
flock 9 # two checkouts may ask at the same time
if [ ! -e "$prefix/complete" ]; then
  log=$cache/wasm-deps-$key.log
  work=$(mktemp -d "$cache/wasm-deps-build.XXXXXX")
  trap 'rm -rf "$work"' EXIT
  fail() {
    tail -n 40 "$log" >&2
    echo "wasm/deps: building $1 for WebAssembly failed; the whole log is $log." >&2
    exit 1
  }
  fetch_sources "$cache/sources" >&2
  for tarball in "$cache/sources"/*.orig.tar.bz2; do tar -xf "$tarball" -C "$work"; done
  rm -rf "$prefix"

  configure() { emcmake cmake -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_CXX_FLAGS_RELEASE= \
                  -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib "$@" >> "$log" 2>&1; }
  echo "wasm/deps: building CLN for WebAssembly (once, about two minutes on two cores)" >&2
  : > "$log"
  configure -S "$here/cln" -B "$work/cln" -DCLN_SOURCE_DIR="$(echo "$work"/cln-*)" || fail CLN
  cmake --build "$work/cln" --target install >> "$log" 2>&1 || fail CLN
  echo "wasm/deps: building GiNaC for WebAssembly (once, about a minute on two cores)" >&2
  configure -S "$(echo "$work"/ginac-*)" -B "$work/ginac" -DBUILD_SHARED_LIBS=OFF \
    -DCLN_INCLUDE_DIR="$prefix/include" -DCLN_LIBRARIES="$prefix/lib/libcln.a" || fail GiNaC
  cmake --build "$work/ginac" --target ginac >> "$log" 2>&1 || fail GiNaC
  cmake --install "$work/ginac/ginac" >> "$log" 2>&1 || fail GiNaC
  touch "$prefix/complete"
fi
echo "$prefix"
