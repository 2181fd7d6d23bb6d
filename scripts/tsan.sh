#!/usr/bin/env bash
# Runs the tests of concurrency under ThreadSanitizer. Debian's oneTBB is built without it, which
# gives over a hundred false reports, so oneTBB is built here from Debian's source. Needs `deb-src`
# to be reachable where `deb` is; takes some minutes. Not part of test.sh.
#   tsan.sh [FILTER]    FILTER as for ctest -R; default: the tests that use threads
set -euo pipefail
export LC_ALL=C
cd "$(dirname "$(realpath "$0")")/.."

cases='a reconstruction has|reconstructions on eight|planes of|fractions from'
filter=${1:-"capi_test: ?($cases)|thread"}
scripts/setup.sh --tsan
root=$PWD/build/tsan-tbb
if [ ! -e "$root/install/lib/cmake/TBB/TBBConfig.cmake" ]; then
  echo "tsan: building oneTBB from Debian's source"
  rm -rf "$root"
  mkdir -p "$root"/{parts,lists/partial,source}
  # The configured sources, as deb-src, with lists of their own: nothing of the system is changed.
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
    [ -f "$file" ] && sed -E 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' "$file" \
      >"$root/parts/$(basename "$file")"
  done
  [ -e "$root/parts/sources.list" ] && mv "$root/parts/sources.list" "$root/parts/main.list"
  apt=(apt-get -qq -o "Dir::Etc::SourceList=/dev/null" -o "Dir::Etc::SourceParts=$root/parts"
    -o "Dir::State::Lists=$root/lists" -o "APT::Sandbox::User=root")
  "${apt[@]}" update
  (cd "$root/source" && "${apt[@]}" source onetbb >/dev/null)
  source=$(find "$root/source" -mindepth 1 -maxdepth 1 -type d)
  cmake -G Ninja -S "$source" -B "$root/build" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_TEST=OFF \
    -DTBB_STRICT=OFF -DTBB_SANITIZE=thread -DTBBMALLOC_BUILD=OFF \
    -DCMAKE_INSTALL_PREFIX="$root/install" -DCMAKE_INSTALL_LIBDIR=lib >"$root/log" 2>&1
  cmake --build "$root/build" -j "$(nproc)" >>"$root/log" 2>&1
  cmake --install "$root/build" >>"$root/log"
fi

cmake --preset tsan -DTBB_DIR="$root/install/lib/cmake/TBB" >/dev/null
cmake --build --preset tsan -j "$(nproc)" --target capi_test core_test
ctest --preset tsan -R "$filter"
