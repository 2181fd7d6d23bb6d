#!/usr/bin/env bash
# Searches for inputs that crash the C interface or a reader of files, under AddressSanitizer and
# UndefinedBehaviorSanitizer, with clang's libFuzzer.
#   fuzz.sh                     every target for 60 seconds
#   fuzz.sh SECONDS [TARGET...] these targets for so long each: capi, npy, nrrd, ...
# Inputs that do harm are written to build/fuzz/found, and belong into tests/fuzz/corpus/TARGET once
# the defect is mended; all inputs that reach new code are kept in build/fuzz/work/TARGET for the
# next search.
set -euo pipefail
export LC_ALL=C
cd "$(dirname "$(realpath "$0")")/.."

seconds=${1:-60}
shift || true
scripts/setup.sh --fuzz
cmake --preset fuzz >/dev/null
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  mapfile -t targets < <(find tests/fuzz/corpus -mindepth 1 -maxdepth 1 -printf '%f\n' | sort)
fi
cmake --build --preset fuzz -j "$(nproc)" --target "${targets[@]/%/_fuzz}"

# What a call frees stays in quarantine until long after it; more of it costs page faults. The
# program TARGET_replay of the preset asan shows deeper stacks of allocations.
export ASAN_OPTIONS=quarantine_size_mb=16:malloc_context_size=3

mkdir -p build/fuzz/found
failed=()
for target in "${targets[@]}"; do
  mkdir -p "build/fuzz/work/$target"
  # Of a short input the rest of the field is empty. Weighing inputs by rare features costs as much
  # as short calls of the library. Nobody else adds to the folder: there is nothing to reload.
  settings=(-max_len=4096 -reload=0)
  [ "$target" != capi ] || settings=(-max_len=256 -reload=0 -entropic=0)
  echo "== $target for $seconds s"
  if ! "build/fuzz/tests/fuzz/${target}_fuzz" -max_total_time="$seconds" "${settings[@]}" \
    -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/found/$target-" \
    "build/fuzz/work/$target" "tests/fuzz/corpus/$target" >"build/fuzz/$target.log" 2>&1; then
    failed+=("$target")
    tail -n 30 "build/fuzz/$target.log" >&2
  fi
  grep -E 'number_of_executed_units|^#[0-9]+.*DONE' "build/fuzz/$target.log" || true
done
if [ ${#failed[@]} -gt 0 ]; then
  echo "fuzz: inputs that do harm, in build/fuzz/found, for: ${failed[*]}" >&2
  exit 1
fi
echo "fuzz: nothing found"
