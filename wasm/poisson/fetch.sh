#!/usr/bin/env bash
# Fetches Kazhdan's screened Poisson reconstruction (version 9, BSD licence) as MeshLab's source package in Debian has it, into
# the cache outside the tree, and prints the folder that holds its files on its last line. Needs python3, and apt or a network.
#   PARSEL_CACHE    where to keep downloads (default: ~/.cache/parsel)
#   PARSEL_SOURCES  a folder that already holds the tarball, for machines without a network
set -euo pipefail
cache=${PARSEL_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/parsel}
name=meshlab_2020.09+dfsg1.orig.tar.xz
sum=d6715352ff65caffdec0292858d4263eb0c3cbbf3b1e5c2e2bab218e3f234630
pool=pool/main/m/meshlab/$name
tarball=$cache/sources/$name
folder=$cache/poisson-${sum:0:16}

if [ ! -e "$folder/complete" ]; then
  mkdir -p "$cache/sources"
  exec 9> "$cache/poisson.lock"
  flock 9 # two checkouts may ask at the same time
fi
if [ ! -e "$folder/complete" ]; then
  is_there() { echo "$sum  $tarball" | sha256sum --quiet --check > /dev/null 2>&1; }
  if ! is_there && [ -n "${PARSEL_SOURCES:-}" ]; then cp "$PARSEL_SOURCES/$name" "$tarball" 2> /dev/null || true; fi
  # This machine's own mirror, by apt's own means, which know its proxies.
  if ! is_there && [ -x /usr/lib/apt/apt-helper ]; then
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 2> /dev/null | grep -E '/debian/?$' | head -n 1 || true)
    for from in ${mirror:+"${mirror%/}"} http://deb.debian.org/debian; do
      is_there || /usr/lib/apt/apt-helper download-file "$from/$pool" "$tarball" "SHA256:$sum" > /dev/null 2>&1 || true
    done
  fi
  if ! is_there; then
    python3 -c 'import sys, urllib.request; urllib.request.urlretrieve(sys.argv[1], sys.argv[2])' \
      "https://deb.debian.org/debian/$pool" "$tarball" > /dev/null 2>&1 || true
  fi
  if ! is_there; then
    echo "wasm/poisson: $name could not be downloaded, or is another file than expected. Check the network, or put the file" \
      "into a folder and set PARSEL_SOURCES to it." >&2
    exit 1
  fi
  rm -rf "$folder"
  mkdir -p "$folder"
  python3 - "$tarball" "$folder" << 'END'
import os, sys, tarfile
with tarfile.open(sys.argv[1]) as tar:
    for member in tar:
        if member.isfile() and '/filter_screened_poisson/Src/' in member.name:
            with open(os.path.join(sys.argv[2], os.path.basename(member.name)), 'wb') as file:
                file.write(tar.extractfile(member).read())
END
  touch "$folder/complete"
fi
echo "$folder"
