# Sourced by web/start.sh and tests/run.sh: what the machine must have, and how it gets it.
#
#   PARSEL_CACHE   downloads and built dependencies, shared by all checkouts (default: ~/.cache/parsel)

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export PARSEL_CACHE=${PARSEL_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/parsel}

say() { printf '\n== %s\n' "$*"; }
die() {
  printf '\n%s\n' "$*" >&2
  exit 1
}

# Each line: what must be there (a command, or a file from /), and the Debian package that brings it.
build_needs="g++ g++
cmake cmake
ninja ninja-build
ccache ccache
python3 python3
bison bison
flex flex
bzip2 bzip2
git git
/etc/ssl/certs/ca-certificates.crt ca-certificates
/usr/include/eigen3/Eigen/Core libeigen3-dev
/usr/include/nlohmann/json.hpp nlohmann-json3-dev
/usr/include/tiny_gltf.h libtinygltf-dev
/usr/include/doctest/doctest.h doctest-dev"
native_needs="/usr/include/ginac/ginac.h libginac-dev
/usr/include/cln/cln.h libcln-dev"

has() { case $1 in /*) [ -e "$1" ] ;; *) command -v "$1" > /dev/null ;; esac; }

# need "<lines of needs>": installs the packages of what is missing, or says what to install.
need() {
  local what package missing=()
  while read -r what package; do has "$what" || missing+=("$package"); done <<< "$1"
  [ ${#missing[@]} -eq 0 ] && return
  if ! command -v apt-get > /dev/null; then
    die "This system has no apt-get. Please install what Debian calls ${missing[*]} with its own package manager and run again."
  fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo > /dev/null || die "Missing packages: ${missing[*]}. Install them as root (apt-get install ${missing[*]}) and run again."
    as_root=(sudo)
  fi
  say "Installing ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get -qq update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -y install --no-install-recommends "${missing[@]}"; } \
    > "$log" 2>&1 < /dev/null; then
    tail -n 5 "$log" >&2
    die "Installing ${missing[*]} failed: check the network and that these packages exist on this system (the whole log is $log)."
  fi
  rm -f "$log"
}

# Node.js 20.19 or newer, on the PATH. Debian 12's and Ubuntu 24.04's own is older: theirs then fetches a newer one.
node_is_new_enough() {
  command -v node > /dev/null && node -e 'const [a, b] = process.versions.node.split(".").map(Number);
    process.exit(a > 20 || (a === 20 && b >= 19) ? 0 : 1)'
}
need_node() {
  local own=$PARSEL_CACHE/node20
  if [ -x "$own/bin/node" ]; then export PATH=$own/bin:$PATH; fi
  if ! node_is_new_enough && ! command -v npm > /dev/null; then need "node nodejs
npm npm"; fi
  if ! node_is_new_enough; then
    local arch
    case $(uname -m) in
      x86_64) arch=x64 ;;
      aarch64) arch=arm64 ;;
      *) die "Node.js $(node --version) is too old and there is no newer one to fetch for $(uname -m): please install Node.js 20.19 or newer." ;;
    esac
    say "Fetching Node.js 20 (this machine has $(node --version 2> /dev/null || echo none), the build wants 20.19 or newer)"
    npm install --silent --no-audit --no-fund --prefix "$own" "node-linux-$arch@^20.19.0" npm@^10 > /dev/null 2>&1 ||
      die "Node.js 20 could not be fetched: check the network, or install Node.js 20.19 or newer yourself."
    mkdir -p "$own/bin"
    ln -sf "../node_modules/node-linux-$arch/bin/node" "$own/bin/node"
    ln -sf ../node_modules/npm/bin/npm-cli.js "$own/bin/npm"
    ln -sf ../node_modules/npm/bin/npx-cli.js "$own/bin/npx"
    export PATH=$own/bin:$PATH
    hash -r
    node_is_new_enough || die "Node.js $(node --version) is too old: please install Node.js 20.19 or newer."
  fi
}

# emcc: one on the PATH (an activated emsdk) first, else Debian's.
need_emscripten() {
  need "emcc emscripten"
  # Debian's emscripten finds its JavaScript packages only through Debian's own Node.js, unless it is told.
  if [ "$(command -v emcc)" = /usr/bin/emcc ]; then
    export NODE_PATH=/usr/share/nodejs
    [ -w /usr/share/emscripten/cache ] || export EM_CACHE=$PARSEL_CACHE/emscripten
  fi
}

# npm packages of web/, as package-lock.json says; done again only when that file changed.
need_npm_packages() {
  local lock=$root/web/package-lock.json stamp=$root/web/node_modules/.installed-lock
  cmp -s "$lock" "$stamp" && return
  say "Installing the npm packages"
  (cd "$root/web" && npm ci --no-audit --no-fund --loglevel=error) ||
    die "npm could not install the packages of web/package-lock.json: check the network and run again."
  cp "$lock" "$stamp"
}

# configure_and_build PRESET [command to run cmake through]
configure_and_build() {
  local preset=$1 log=$root/build/$1.log
  shift
  mkdir -p "$root/build"
  (cd "$root" && { [ -e "build/$preset/build.ninja" ] || "$@" cmake --preset "$preset"; } > "$log" 2>&1) || {
    grep -A 4 'CMake Error' "$log" >&2 || tail -n 20 "$log" >&2
    die "Configuring the preset $preset failed; the whole log is $log."
  }
  # `targets` may name what to build; everything otherwise.
  (cd "$root" && cmake --build --preset "$preset" ${targets:+--target $targets} > "$log" 2>&1) || {
    grep -E -A 8 'error|FAILED' "$log" | cut -c1-300 | head -n 60 >&2
    die "Building the preset $preset failed; the whole log is $log."
  }
}

build_wasm() {
  PARSEL_WASM_DEPS=$("$root/wasm/deps/build.sh" | tail -n 1) ||
    die "CLN and GiNaC could not be built for WebAssembly; the lines above say why."
  [ -n "$PARSEL_WASM_DEPS" ] || die "CLN and GiNaC could not be built for WebAssembly; the lines above say why."
  export PARSEL_WASM_DEPS
  # Another compiler or other dependencies need another configuration.
  local key="$PARSEL_WASM_DEPS $(command -v emcc)" stamp=$root/build/wasm/configured-with
  if [ "$(cat "$stamp" 2> /dev/null)" != "$key" ]; then rm -rf "$root/build/wasm"; fi
  configure_and_build wasm emcmake
  echo "$key" > "$stamp"
}
