#!/usr/bin/env bash
# Holds libdifmesh.so and difmesh.h against what was promised: exported.txt, the functions that
# leave the library, and difmesh.abi, all of the header's functions, structs and types as libabigail
# sees them. Then makes incompatible changes to copies of the header and fails unless each of them
# is noticed.
#   abi_guard.sh LIBRARY          check
#   abi_guard.sh LIBRARY update   write both files anew: after additions, never after incompatible
#                                 changes
# The library is the real one; its types are taken from the header, with a function of no effect for
# each declaration, for the real functions drag in all that C++ they use.
set -euo pipefail
export LC_ALL=C

library=$1
here=$(dirname "$(realpath "$0")")
header=$here/../../capi/include/difmesh/difmesh.h
exported=$here/exported.txt
baseline=$here/difmesh.abi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if ! command -v abidiff >/dev/null; then
  echo "skipped: abidiff is missing (Debian: abigail-tools)"
  exit 0
fi
if [ "$(uname -m)" != x86_64 ]; then
  echo "skipped: the baseline is that of x86_64"
  exit 0
fi

# describe HEADER NAME: $work/NAME.so has the ABI of the header.
describe() {
  "${CC:-cc}" -E -P -x c "$1" | tr '\n' ' ' | sed 's/;/;\n/g' >"$work/$2.i"
  sed -E '/visibility\("default"\)/ s/;$/ { __builtin_trap(); }/' "$work/$2.i" >"$work/$2.c"
  "${CC:-cc}" -std=c99 -g -shared -fPIC -w -Wl,-soname,libdifmesh.so.0 "$work/$2.c" -o "$work/$2.so"
}

functions() {
  nm -D --defined-only "$1" | awk '{ print $3 }' | sort
}

describe "$header" now
functions "$library" >"$work/exported.txt"
if [ "${2:-}" = update ]; then
  cp "$work/exported.txt" "$exported"
  abidw --no-corpus-path --no-comp-dir-path --no-show-locs "$work/now.so" |
    sed "s/path='[^']*'/path='difmesh.h'/" >"$baseline"
  echo "written: $exported, $baseline"
  exit 0
fi

if ! diff -u "$exported" "$work/exported.txt"; then
  echo "the functions that libdifmesh.so exports are not those of $exported" >&2
  exit 1
fi
if ! diff -u "$work/exported.txt" <(functions "$work/now.so"); then
  echo "the functions that difmesh.h declares are not those that libdifmesh.so exports" >&2
  exit 1
fi
if ! abidiff "$baseline" "$work/now.so"; then
  echo "difmesh.h has not the ABI of $baseline; additions: run abi_guard.sh LIBRARY update" >&2
  exit 1
fi
echo "exported functions: $(wc -l <"$exported"); the header's ABI is that of the baseline"

# caught NAME SED-SCRIPT PATTERN: the change is noticed, and said in words that match the pattern.
caught() {
  sed -E "$2" "$header" >"$work/$1.h"
  if cmp -s "$header" "$work/$1.h"; then
    echo "the change '$1' changed nothing" >&2
    exit 1
  fi
  describe "$work/$1.h" "$1"
  if abidiff "$baseline" "$work/$1.so" >"$work/$1.txt" || ! grep -qE "$3" "$work/$1.txt"; then
    echo "the incompatible change '$1' was not caught:" >&2
    cat "$work/$1.txt" >&2
    exit 1
  fi
  echo "caught: $1"
}
caught swapped_fields '/^typedef struct dif_options/,/^}/ {
  s/double purity_tolerance;/double purity_tolerance_;/
  s/double overshoot_bound;/double purity_tolerance;/
  s/double purity_tolerance_;/double overshoot_bound;/ }' 'purity_tolerance'
caught narrower_field 's/^  int64_t interfacial_cells;/  int32_t interfacial_cells, spare;/' \
  'interfacial_cells'
caught inserted_field 's/^  double centre\[3\];/  double inserted; double centre[3];/' 'inserted'
caught removed_function '/^DIF_API int32_t dif_has\(/d' 'dif_has'
caught other_parameter 's/int64_t first_vertex,/int32_t first_vertex,/' 'dif_mesh_copy_triangles'
caught other_result 's/^DIF_API int32_t dif_version\(/DIF_API int64_t dif_version(/' 'dif_version'
