#!/usr/bin/env bash
# Measures reconstruction beside VTK's vtkFlyingEdges3D and prints the table of docs/performance.md.
#   bench.sh [ROUNDS] [THREADS]     11 rounds and up to 2 threads, if nothing is said
#   bench.sh --others               scikit-image's and OpenVDB's contours instead, from Python
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1:-}" = "--others" ]; then
  scripts/setup.sh --bench-others
  cmake --preset bench -DDIFMESH_WITH_VTK=OFF >/dev/null
  cmake --build --preset bench -j "$(nproc)" --target difmesh_capi
  DIFMESH_LIBRARY=$(find "$PWD/build/bench/capi" -name 'libdifmesh.so' | head -1) \
    PYTHONPATH=$PWD/bindings/python /usr/bin/python3 bench/contours_side_by_side.py
  exit
fi

scripts/setup.sh --bench
cmake --preset bench >/dev/null
cmake --build --preset bench -j "$(nproc)" --target side_by_side
echo "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores," \
  "$("$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' build/bench/CMakeCache.txt)" --version | head -1)"
build/bench/bench/side_by_side "${1:-11}" "${2:-2}"
