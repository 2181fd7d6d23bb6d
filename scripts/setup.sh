#!/usr/bin/env bash
# Installs what difmesh needs on Debian 12: compilers, libraries, tools. Run by demo.sh and test.sh;
# does nothing where all is there. Needs root or sudo.
#   setup.sh            build, tests and demo
#   setup.sh --browser  Chromium as well, in which tests open our pages
#   setup.sh --bench    the benchmarks as well (Google Benchmark, VTK)
#   setup.sh --bench-others  what is timed beside ours from Python (scikit-image, OpenVDB)
#   setup.sh --paper    what draws figures as well (gnuplot, Chromium), and VTK, which is measured
#                       beside ours
#   setup.sh --fuzz     the search for bad inputs as well (clang's libFuzzer)
#   setup.sh --tsan     what oneTBB is built with for ThreadSanitizer as well
set -euo pipefail

packages=(
  g++ cmake ninja-build           # to build
  libtbb-dev                      # the core's threads
  zlib1g-dev                      # readers and writers of files
  libcli11-dev nlohmann-json3-dev # the program, glTF
  libdraco-dev                    # compressed meshes
  libembree-dev                   # distances between surfaces
  doctest-dev                     # tests
  libcgal-dev libopenmesh-dev     # tests: independent checks of meshes
  abigail-tools pkg-config        # tests: the C interface keeps its ABI and is found
  clang                           # tests: warnings in installed headers
  libeigen3-dev                   # examples with CGAL
  gfortran                        # the Fortran module
  python3-numpy                   # the Python package
  python3-pip python3-wheel mypy  # tests: that it can be installed, and its type hints
  clang-format git                # tests: formatting
)
if [ "${1:-}" = "--browser" ]; then
  packages+=(chromium)
fi
if [ "${1:-}" = "--bench" ]; then
  packages+=(libbenchmark-dev libvtk9-dev)
fi
if [ "${1:-}" = "--bench-others" ]; then
  packages+=(libbenchmark-dev python3-skimage python3-openvdb)
fi
if [ "${1:-}" = "--paper" ]; then
  packages+=(gnuplot-nox chromium libvtk9-dev)
fi
if [ "${1:-}" = "--fuzz" ]; then
  packages+=(clang libclang-rt-14-dev)
fi
if [ "${1:-}" = "--tsan" ]; then
  packages+=(dpkg-dev)
fi
# The page of `difmesh view` and the judges of glTF. Any node from 18 on will do.
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  packages+=(nodejs npm)
fi

missing=()
for package in "${packages[@]}"; do
  if ! dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then
    missing+=("$package")
  fi
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: needs root or sudo to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
echo "setup: done"
