#!/usr/bin/env bash
# Sets up, builds and tests everything: formatting, the release preset, the same tests under
# AddressSanitizer and UndefinedBehaviorSanitizer, and the core without oneTBB.
#   test.sh             all of it
#   test.sh release     only these presets
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --browser
presets=("$@")
if [ ${#presets[@]} -eq 0 ]; then
  presets=(release serial asan)
  echo "== formatting"
  git ls-files '*.cpp' '*.hpp' '*.h' | xargs -r clang-format --dry-run --Werror
  scripts/check_columns.py
fi

for preset in "${presets[@]}"; do
  echo "== $preset: configure and build"
  cmake --preset "$preset" -DDIFMESH_WARNINGS_AS_ERRORS=ON >/dev/null
  cmake --build --preset "$preset" -j "$(nproc)"
  echo "== $preset: test"
  ctest --preset "$preset" -j "$(nproc)"
done
