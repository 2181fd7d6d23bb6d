"""What calling from Python costs beside the call itself, and that a field is not copied.

    DIFMESH_LIBRARY=build/release/capi/libdifmesh.so.0 PYTHONPATH=bindings/python \
        /usr/bin/python3 bench/python_overhead.py [CELLS [ROUNDS]]

For a sphere in CELLS^3 (256) cells of float64, ROUNDS (15) times in turn: difmesh.reconstruct(),
with all that it returns looked at, against dif_reconstruct() and dif_mesh_free() called with a
struct that is ready, without progress. The peak of memory is that of a process of its own.
"""

import ctypes
import subprocess
import sys
import time

import numpy as np

import difmesh
from difmesh import _library, _memory
from difmesh._structs import DifOptions


def sphere(cells: int) -> np.ndarray:
    axis = np.arange(cells) + 0.5 - cells / 2
    distance = np.sqrt(axis[:, None, None] ** 2 + axis[:, None] ** 2 + axis**2)
    return np.clip(0.4 * cells + 0.5 - distance, 0.0, 1.0)


def clocks() -> np.ndarray:
    """Wall time, and time of all cores."""
    return np.array([time.perf_counter(), time.process_time()])


def direct(struct: object, options: object) -> np.ndarray:
    mesh = ctypes.c_void_p()
    begin = clocks()
    status = _library.library.dif_reconstruct(
        ctypes.byref(struct), ctypes.byref(options), ctypes.byref(mesh)
    )
    _library.library.dif_mesh_free(mesh)
    taken = clocks() - begin
    assert status == 0
    return taken


def from_python(field: np.ndarray) -> np.ndarray:
    begin = clocks()
    mesh = difmesh.reconstruct(field)
    assert mesh.points.size and mesh.faces.size and mesh.report.closed
    del mesh
    return clocks() - begin


def time_both(cells: int, rounds: int) -> None:
    field = sphere(cells)
    struct, _ = _memory.field_struct(field, None, None, "kji")
    options = _library.defaults(DifOptions, "dif_options_init")
    pairs = []
    for turn in range(rounds + 1):
        if turn % 2:
            there = from_python(field)
            pairs.append((direct(struct, options), there))
        else:
            pairs.append((direct(struct, options), from_python(field)))
    taken = 1e3 * np.array(pairs[1:])  # [round, which, clock]
    c, python = np.median(taken, axis=0)
    difference = np.median(taken[:, 1] - taken[:, 0], axis=0)
    print(f"{cells}^3 cells, {rounds} rounds in turn, medians in ms: wall time, time of all cores")
    print(f"  C function         {c[0]:9.3f} {c[1]:9.3f}")
    print(f"  Python             {python[0]:9.3f} {python[1]:9.3f}")
    print(f"  of the differences {difference[0]:9.3f} {difference[1]:9.3f}, "
          f"{100 * difference[0] / c[0]:.2f} % and {100 * difference[1] / c[1]:.2f} %")  # fmt: skip


def peak() -> int:
    """Not of getrusage(), which counts the process that started this one."""
    with open("/proc/self/status") as status:
        (line,) = (line for line in status if line.startswith("VmHWM"))
    return int(line.split()[1]) * 1024


def memory(cells: int) -> None:
    """In a fresh process: peaks before and after the call."""
    field = np.empty((cells + 2, cells + 2, cells + 2))
    field[...] = 0
    inside = field[1:-1, 1:-1, 1:-1]
    for k, layer in enumerate(inside):  # without temporary arrays of the field's size
        axis = np.arange(cells) + 0.5 - cells / 2
        distance = np.sqrt((k + 0.5 - cells / 2) ** 2 + axis[:, None] ** 2 + axis**2)
        np.clip(0.4 * cells + 0.5 - distance, 0.0, 1.0, out=layer)
    before = peak()
    mesh = difmesh.reconstruct(inside)
    grown = peak() - before
    output = mesh.points.nbytes + mesh.faces.nbytes
    print(f"  field {inside.nbytes / 2**20:.1f} MiB, a view inside ghost layers; the peak grew by "
          f"{grown / 2**20:.1f} MiB, of which the mesh has {output / 2**20:.1f}")  # fmt: skip


if __name__ == "__main__":
    if sys.argv[1:2] == ["--memory"]:
        memory(int(sys.argv[2]))
    else:
        size = int(sys.argv[1]) if len(sys.argv) > 1 else 256
        time_both(size, int(sys.argv[2]) if len(sys.argv) > 2 else 15)
        subprocess.run([sys.executable, __file__, "--memory", str(size)], check=True)
