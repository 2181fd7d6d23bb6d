"""A field of volume fractions with its place in space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True)
class FunctionReport:
    """Facts about fractions of a function or shape."""

    interfacial_cells: int  #: 0 < fraction < 1
    sampled_cells: int  #: looked at beyond their corners
    subdivided_cells: int  #: of these, bisected
    unresolved_cells: int  #: of these, out of calls before the tolerances were met
    largest_error_estimate: float
    function_calls: int  #: points at which the function was evaluated
    lattice_calls: int  #: of these, corners of the grid's cells
    gradient_calls: int
    fraction_volume: float
    seconds: float


@dataclass(frozen=True)
class TriangleReport:
    """Facts about fractions of a mesh."""

    pieces: int  #: parts of triangles inside cells
    cells_touched: int  #: all others are exactly 0 or 1
    lowest_raw: float  #: least mean winding number of a cell
    highest_raw: float  #: greatest
    largest_gap: float  #: of a column's sum from an integer
    fraction_volume: float  #: in the grid
    mesh_volume: float  #: in the grid or not
    seconds: float
    overlap_volume: float  #: covered more than once, in the grid; thrice counts twice
    overlap_cells: int  #: that have some, by more than rounding
    largest_overlap: float  #: as a share of a cell
    overlap_cell: tuple[int, int, int]  #: (i, j, k) of the first with the largest
    overlap_low: tuple[float, float, float]  #: corners of the box round these cells
    overlap_high: tuple[float, float, float]
    inverted_volume: float  #: of pockets that are inside out, which are outside
    inverted_cells: int
    undecided_volume: float  #: where it was not found out how often it is covered; bounds errors
    undecided_cells: int
    largest_undecided: float  #: as a share of a cell: a bound for the error of each fraction
    undecided_cell: tuple[int, int, int]  #: (i, j, k) of the first with the largest


@dataclass(frozen=True, eq=False)
class Field:
    """Volume fractions, where they lie, and how they came about.

    Can be given to all functions that take fractions; its spacing and origin are used unless others
    are given. `numpy.asarray(field)` is `field.fractions`.
    """

    fractions: npt.NDArray[Any]  #: [k, j, i]; from a file: read-only
    spacing: tuple[float, float, float] = (1.0, 1.0, 1.0)  #: edges of a cell in x, y, z
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)  #: low corner of the grid
    report: Union[FunctionReport, TriangleReport, None] = None  #: of fractions_from_...()
    #: of stretched axes: the faces of cells along x, y, z; None for an axis that is uniform
    edges: Union[tuple[Any, Any, Any], None] = None

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        if copy:
            return np.array(self.fractions, dtype=dtype)
        return np.asarray(self.fractions, dtype=dtype)

    def __repr__(self) -> str:
        nz, ny, nx = self.fractions.shape
        return f"Field({nx} x {ny} x {nz} cells of {self.fractions.dtype})"
