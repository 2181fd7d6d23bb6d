#!/usr/bin/env bash
# Measures what the paper measures (Evrard, Denner, van Wachem, IEEE TVCG 2019): sets up a Debian 12
# machine, builds, runs all its bodies with all ways to a surface, and draws the figures.
#   paper.sh                all of it: a quarter of an hour or less on two cores
#   paper.sh --short        fewer cells, places and ways: a minute
#   paper.sh --out DIR      where to: tables (.csv, .md), plots (.svg) and pictures (.jpg); default
#                           paper-out
#   paper.sh --mesh FILE    a closed mesh instead of the bunny of ../shared/data; without either it
#                           is left out
#   paper.sh --docs         puts tables, plots and pictures into docs/paper.md and docs/paper, too
# Exit code 1: what is claimed does not hold.
set -euo pipefail
export LC_ALL=C.UTF-8
home=$(dirname "$(realpath "$0")")/..

out=paper-out
arguments=()
docs=
while [ $# -gt 0 ]; do
  case "$1" in
    --short) arguments+=(--short) ;;
    --docs) docs=yes ;;
    --out | --mesh)
      if [ $# -lt 2 ]; then
        echo "paper: $1 needs a value" >&2
        exit 2
      fi
      if [ "$1" = --out ]; then out=$2; else arguments+=(--mesh "$(realpath "$2")"); fi
      shift
      ;;
    *)
      echo "paper: unknown argument '$1'; see the head of scripts/paper.sh" >&2
      exit 2
      ;;
  esac
  shift
done
mkdir -p "$out"
out=$(realpath "$out")
cd "$home"

scripts/setup.sh --paper
vtk=OFF
if compgen -G '/usr/lib/*/cmake/vtk-9*/vtk-config.cmake' >/dev/null; then
  vtk=ON
fi
echo "paper: building in build/paper"
mkdir -p build/paper
if ! {
  cmake --preset paper -DDIFMESH_WITH_VTK=$vtk
  cmake --build --preset paper --target paper difmesh -j "$(nproc)"
} >build/paper/paper.log 2>&1; then
  tail -n 40 build/paper/paper.log >&2
  echo "paper: the build failed; all it said is in build/paper/paper.log" >&2
  exit 1
fi

status=0
build/paper/bench/paper/paper --out "$out" "${arguments[@]}" || status=$?
if [ $status -gt 1 ]; then
  exit $status
fi
gnuplot -c bench/paper/plots.gp "$out"
sed -z -E -i 's/<g [^>]*>\n<\/g>\n//g' "$out"/*.svg # empty groups, a quarter of what gnuplot writes
if [ -d build/paper/npm/node_modules ] && command -v chromium >/dev/null; then
  node bench/paper/pictures.mjs build/paper/npm build/paper/cli/difmesh "$(command -v chromium)" \
    "$out"
else
  echo "paper: left out: the pictures, as there is no chromium or npm could not get its packages"
fi
if [ -n "$docs" ]; then
  mkdir -p docs/paper
  find "$out" -maxdepth 1 \( -name '*.svg' -o -name '*.jpg' \) -exec cp {} docs/paper/ \;
  bench/paper/fill_page.sh docs/paper.md "$out"
fi
echo "paper: written to $out"
exit $status
