# Sourced by build.sh. Fetches the upstream tarballs named in sources.sha256 and checks them.

# fetch_sources DIR: leaves every tarball of sources.sha256 in DIR, or explains and returns 1. Tried in order:
# DIR itself, $PARSEL_SOURCES, the source packages of this machine's own package mirror, and GiNaC's own site.
fetch_sources() {
  local dir=$1 sums=$here/sources.sha256 name
  mkdir -p "$dir"
  local from
  for from in have_local from_mirror from_upstream; do
    if (cd "$dir" && sha256sum --quiet --check "$sums" > /dev/null 2>&1); then return 0; fi
    "$from" "$dir" || true
  done
  if (cd "$dir" && sha256sum --quiet --check "$sums" > /dev/null 2>&1); then return 0; fi

  while read -r _ name; do
    if [ -e "$dir/$name" ]; then
      (cd "$dir" && grep -F "$name" "$sums" | sha256sum --quiet --check > /dev/null 2>&1) ||
        echo "wasm/deps: $dir/$name is not the file that sources.sha256 names (wrong checksum). Delete it and run again." >&2
    else
      echo "wasm/deps: $name could not be downloaded. Check the network, or put the file into a folder and set PARSEL_SOURCES to it." >&2
    fi
  done < "$sums"
  return 1
}

have_local() {
  [ -n "${PARSEL_SOURCES:-}" ] || return 1
  local name
  while read -r _ name; do cp "$PARSEL_SOURCES/$name" "$1/" || true; done < "$here/sources.sha256"
}

# The release that carries exactly these versions is asked for by name, at whatever mirror this machine uses. A private
# apt configuration leaves the machine's own lists alone; the checksum stands in for the archive's signature.
from_mirror() {
  command -v apt-get > /dev/null || return 1
  local apt=$1/apt mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 2> /dev/null | grep -E '/debian/?$' | head -n 1)
  [ -n "$mirror" ] || return 1
  mkdir -p "$apt/lists/partial" "$apt/archives/partial"
  echo "deb-src [trusted=yes] $mirror bookworm main" > "$apt/sources.list"
  local options=(-qq -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o "Dir::State::Lists=$apt/lists" -o "Dir::Cache=$apt" -o APT::Sandbox::User="$(id -un)")
  apt-get "${options[@]}" update > /dev/null 2>&1 &&
    (cd "$1" && apt-get "${options[@]}" source --download-only cln=1.3.6-4 ginac=1.8.6-1 > /dev/null 2>&1)
  rm -rf "$apt"
}

from_upstream() {
  command -v curl > /dev/null || return 1
  curl -fsSL --max-time 120 -o "$1/cln_1.3.6.orig.tar.bz2" https://www.ginac.de/CLN/cln-1.3.6.tar.bz2
  curl -fsSL --max-time 120 -o "$1/ginac_1.8.6.orig.tar.bz2" https://www.ginac.de/ginac-1.8.6.tar.bz2
}
