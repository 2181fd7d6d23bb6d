"""Ours beside scikit-image's marching cubes and OpenVDB's contours, from Python, on the same
fields.

    scripts/bench.sh --others

float32, a sphere of radius 0.35 N in N^3 cells and eight periods of a gyroid, one thread of ours;
the others do not say how many they use. Medians of ROUNDS (5) runs in turn. What each returns
differs: scikit-image adds normals that cannot be had without, OpenVDB gives quadrilaterals from a
grid of its own, whose filling is not timed.
"""

import statistics
import sys
import time

import numpy as np
import pyopenvdb as openvdb
import skimage
from skimage.measure import marching_cubes

import difmesh


def sphere(cells: int) -> np.ndarray:
    axis = np.arange(cells) + 0.5 - cells / 2 + 0.137
    distance = np.sqrt(axis[:, None, None] ** 2 + axis[:, None] ** 2 + axis**2)
    return np.clip(0.35 * cells + 0.5 - distance, 0.0, 1.0).astype(np.float32)


def gyroid(cells: int) -> np.ndarray:
    w = 2.0 * np.pi * 8.0 / cells
    axis = w * (np.arange(cells) + 0.5)
    x, y, z = axis[None, None, :], axis[None, :, None], axis[:, None, None]
    value = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    return np.clip(0.5 - value / (1.5 * w), 0.0, 1.0).astype(np.float32)


def milliseconds(call: object) -> float:
    begin = time.perf_counter()
    call()
    return 1e3 * (time.perf_counter() - begin)


def compare(name: str, field: np.ndarray, rounds: int) -> None:
    grid = openvdb.FloatGrid()
    grid.copyFromArray(field)
    calls = {
        "linear": lambda: difmesh.reconstruct(field, placement="linear", threads=1),
        "plic": lambda: difmesh.reconstruct(field, threads=1),
        "skimage": lambda: marching_cubes(field, 0.5),
        "openvdb": lambda: grid.convertToQuads(0.5),
    }
    times = {label: [] for label in calls}
    for _ in range(rounds):
        for label, call in calls.items():
            times[label].append(milliseconds(call))
    row = " | ".join(f"{statistics.median(times[label]):.1f}" for label in calls)
    print(f"| {name} | {row} |", flush=True)


def main() -> None:
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    vdb_version = ".".join(map(str, openvdb.LIBRARY_VERSION))
    print(f"scikit-image {skimage.__version__}, OpenVDB {vdb_version}\n")
    print("| field | difmesh linear ms | difmesh plic ms | scikit-image ms | OpenVDB ms |")
    print("|---|---|---|---|---|")
    for cells in (64, 128, 256):
        compare(f"sphere {cells}", sphere(cells), rounds)
    compare("gyroid 256", gyroid(256), rounds)


if __name__ == "__main__":
    main()
