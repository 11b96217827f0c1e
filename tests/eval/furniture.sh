#!/usr/bin/env bash
# Debian's sweethome3d-furniture (CC0 and CC-BY models), converted to part-labelled GLBs. Prints their folder.
#   tests/eval/furniture.sh [OUTPUT]        default: ~/.cache/parsel/eval/models
# Does nothing when the models are there and the converter has not changed since. See convert.mjs for what is converted.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../wasm/setup.sh"

output=${1:-$PARSEL_CACHE/eval/models}
here=$root/tests/eval
unpacked=$PARSEL_CACHE/eval/sweethome3d
stamp=$(cat "$here"/{convert,obj,parts,glb}.mjs | sha256sum)
if [ "$(cat "$output/.converted-by" 2> /dev/null)" = "$stamp" ]; then
  echo "$output"
  exit
fi
need_node

if [ ! -e "$unpacked/.complete" ]; then
  need "apt-get apt
dpkg dpkg
python3 python3"
  download=$(mktemp -d)
  trap 'rm -rf "$download"' EXIT
  say "Fetching sweethome3d-furniture (120 MB)" >&2
  chmod 755 "$download"
  (cd "$download" && apt-get -q download sweethome3d-furniture > log 2>&1) || {
    tail -n 3 "$download/log" >&2
    die "The package sweethome3d-furniture could not be fetched: check the network, run 'apt-get update', and note that only Debian and Ubuntu have it."
  }
  dpkg -x "$download"/sweethome3d-furniture_*.deb "$download/package"
  rm -rf "$unpacked"
  for library in "$download"/package/usr/share/sweethome3d/furniture/*.sh3f; do
    python3 -m zipfile -e "$library" "$unpacked/$(basename "$library" .sh3f)"
  done
  cp "$download/package/usr/share/doc/sweethome3d-furniture/copyright" "$unpacked/"
  touch "$unpacked/.complete"
fi
say "Converting the furniture" >&2
node "$here/convert.mjs" "$unpacked" "$output" >&2
cp "$unpacked/copyright" "$output/licences/debian-copyright.txt"
echo "$stamp" > "$output/.converted-by"
echo "$output"
