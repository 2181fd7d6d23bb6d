#!/usr/bin/env bash
# Attacks the C interface with ugly fields, each made from a number, on all cores: what must hold of
# every surface is in tests/capi/attack. Of every hundredth field CGAL looks at the surface too.
# Ends with 1 if anything is wrong.
#   attack.sh                    two million fields, some 20 minutes on two cores
#   attack.sh --fields N         so many, from field 1 on
#   attack.sh --first M          from field M on
#   attack.sh --hours H          for so long instead
# One field again: build/release/tests/capi/attack/attack --seed M
set -euo pipefail
export LC_ALL=C
cd "$(dirname "$(realpath "$0")")/.."

fields=2000000
first=1
seconds=
while [ $# -gt 0 ]; do
  case "$1" in
    --fields) fields=$2 ;;
    --first) first=$2 ;;
    --hours) seconds=$(awk "BEGIN {printf \"%d\", 3600 * $2}") fields=1000000000000 ;;
    *) sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
  shift 2
done

scripts/setup.sh
cmake --preset release >/dev/null
cmake --build --preset release -j "$(nproc)" --target attack attack_cgal
programs=build/release/tests/capi/attack

# run_all PROGRAM FIELDS [SECONDS]: on all cores, which take turns at the fields.
run_all() {
  local cores running=() failed=0
  cores=$(nproc)
  for ((core = 0; core < cores; ++core)); do
    "$programs/$1" --first $((first + core)) --step "$cores" --fields $(($2 / cores + 1)) \
      ${3:+--seconds "$3"} &
    running+=($!)
  done
  for process in "${running[@]}"; do
    wait "$process" || failed=1
  done
  return $failed
}

failed=0
run_all attack "$fields" "$seconds" || failed=1
run_all attack_cgal $((fields / 100)) "${seconds:+$((seconds / 100 + 1))}" || failed=1
if [ $failed -ne 0 ]; then
  echo "attack: SOMETHING IS WRONG, see above" >&2
  exit 1
fi
echo "attack: nothing is wrong"
