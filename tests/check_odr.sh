#!/usr/bin/env bash
# Two types of one name in the core break the one-definition rule in silence: the linker keeps either. Link-time
# optimisation sees all files at once and says so (-Wodr). Takes minutes, so it is no part of run.sh; run it after a type
# has been added or moved.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cmake -S "$root" -B "$root/build/odr" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG="-O0 -flto=auto -Wodr -Werror=odr" >/dev/null
cmake --build "$root/build/odr" --target parsel
echo "No type is defined twice."
