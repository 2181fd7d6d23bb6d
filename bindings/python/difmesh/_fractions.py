"""Volume fractions of functions, shapes and meshes."""

from __future__ import annotations

from ctypes import byref, c_double
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._calls import Function, Handle, Progress, Relay
from ._errors import check
from ._field import Field, FunctionReport, TriangleReport
from ._library import defaults, library
from ._memory import Edges, Triple, address_of, floats, grid_struct, triple
from ._mesh import Mesh, to_dataclass, triples
from ._options import choice, choices, int32
from ._structs import (
    DifFunctionOptions,
    DifFunctionReport,
    DifGrid,
    DifShapeOptions,
    DifTriangleOptions,
    DifTriangleReport,
)

Dims = Union[int, Sequence[int], npt.NDArray[Any]]

_OVERLAPS = choices("OVERLAPS_")
_SHAPES = choices("SHAPE_")


class Shape:
    """A built-in shape. Cannot be changed; may be used from several threads at once."""

    __slots__ = ("kind", "_handle")

    def __init__(
        self,
        kind: str = "sphere",
        *,
        centre: Triple = 0.0,
        rotation_degrees: Triple = 0.0,
        **parameters: Any,
    ) -> None:
        """kind and its parameters (with their defaults), all lengths > 0:

        "sphere": radius (1)
        "ellipsoid": semi_axes (1, 0.8, 0.6)
        "torus": radius (1) of the centre line, tube_radius (0.4)
        "genus": scale (1); of genus 2, Evrard et al., IEEE TVCG 2019, eq. 15
        "smooth_box": semi_axes (1, 0.8, 0.6), exponent (8)
        "golf_ball": radius (1), dimples (333), dimple_radius (0.08), dimple_depth (0.012), the last
            two over radius

        rotation_degrees: about the fixed axes x, then y, then z.
        """
        options = defaults(DifShapeOptions, "dif_shape_options_init")
        options.kind = choice(kind, _SHAPES, "kind")
        options.centre = triple(centre, "centre")
        options.rotation_degrees = triple(rotation_degrees, "rotation_degrees")
        common = ("struct_size", "kind", "centre", "rotation_degrees", "reserved")
        known = [name for name, _ in DifShapeOptions._fields_ if name not in common]
        for name, value in parameters.items():
            if name not in known:
                raise TypeError(f"no parameter {name!r}; there are {', '.join(known)}")
            setattr(options, name, triple(value, name) if name == "semi_axes" else value)
        self.kind = kind
        self._handle = Handle(library.dif_shape_free)
        check(library.dif_shape_create(byref(options), byref(self._handle.pointer)))

    @property
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Low and high corner of a box that encloses the shape."""
        low, high = (c_double * 3)(), (c_double * 3)()
        check(library.dif_shape_bounds(self._handle.pointer, low, high))
        return floats(low), floats(high)

    @property
    def volume(self) -> float:
        """In closed form or to 1e-14."""
        volume = c_double()
        check(library.dif_shape_volume(self._handle.pointer, byref(volume)))
        return volume.value

    def distances(self, points: Any) -> npt.NDArray[np.float64]:
        """Signed distances (n,) of points (n, 3) to the surface, < 0 inside."""
        positions = triples(points, "points")
        result = np.empty(len(positions))
        check(
            library.dif_shape_distances(
                self._handle.pointer, len(positions), address_of(positions), address_of(result)
            )
        )
        return result

    def __repr__(self) -> str:
        return f"Shape({self.kind!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a Shape cannot be pickled or copied")


def _sample(
    relay: Relay, grid: DifGrid, kind: type[Any], call: Any, *arguments: Any, report: Any
) -> Field:
    """Runs call(grid, *arguments, report, fractions)."""
    grid_cells = grid.dims[0] * grid.dims[1] * grid.dims[2]
    valid = min(grid.dims) > 0 and grid_cells < 2**60
    # What the library refuses anyway must not be allocated before.
    fractions = np.empty(tuple(grid.dims)[::-1] if valid else (1, 1, 1))
    relay.call(call, byref(grid), *arguments, byref(report), fractions.ctypes.data)
    return Field(
        fractions,
        floats(grid.spacing),
        floats(grid.origin),
        to_dataclass(kind, report),
        getattr(grid, "_edges", None),
    )


def _function_options(
    relay: Relay,
    tolerance: Optional[float],
    kink_tolerance: Optional[float],
    max_calls_per_cell: Optional[int],
    threads: int,
) -> DifFunctionOptions:
    options = defaults(DifFunctionOptions, "dif_function_options_init")
    options.progress = relay.progress
    options.threads = int32(threads, "threads")
    if tolerance is not None:
        options.tolerance = tolerance
    if kink_tolerance is not None:
        options.kink_tolerance = kink_tolerance
    if max_calls_per_cell is not None:
        options.max_calls_per_cell = max_calls_per_cell
    return options


def fractions_from_function(
    function: Function,
    dims: Dims,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    *,
    edges: Edges = None,
    gradient: Optional[Function] = None,
    tolerance: Optional[float] = None,
    kink_tolerance: Optional[float] = None,
    max_calls_per_cell: Optional[int] = None,
    threads: int = 1,
    progress: Progress = None,
) -> Field:
    """Volume fractions of {f < 0}, by quadrature.

    function: takes points as an array (n, 3) and returns an array (n,); continuous, and smooth
        but for kinks. What it raises cancels, and is raised here.
    dims: cells in x, y, z, or one number for all; the array of fractions has shape (nz, ny, nx).
    spacing, origin: edges of a cell, and low corner of the grid; in x, y, z or one number for all,
        1 and 0.
    edges: stretched axes, as for reconstruct().
    gradient: of function, (n, 3) to (n, 3); makes cells in which f wiggles safer.
    tolerance, kink_tolerance: aimed at in each cell's fraction, and where f has a kink; both in
        [1e-13, 1e-2], 1e-10 and 1e-5.
    max_calls_per_cell: [1000, 1e9], 200000.
    threads: with more than 1, or 0 for as many as the machine has, function is called from several
        threads at once. That is of use only if it lets go of the GIL for long, which NumPy does not
        for arrays as short as here: a few to some hundred points.
    progress: as for reconstruct().
    """
    relay = Relay(progress)
    options = _function_options(relay, tolerance, kink_tolerance, max_calls_per_cell, threads)
    if gradient is not None:
        options.gradient = relay.function(gradient, "gradient", vectors=True)
    return _sample(
        relay,
        grid_struct(dims, spacing, origin, edges),
        FunctionReport,
        library.dif_fractions_from_function,
        relay.function(function, "function"),
        None,
        byref(options),
        report=DifFunctionReport(),
    )


def fractions_from_shape(
    shape: Shape,
    dims: Dims,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    *,
    edges: Edges = None,
    tolerance: Optional[float] = None,
    kink_tolerance: Optional[float] = None,
    max_calls_per_cell: Optional[int] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Field:
    """Volume fractions of a built-in shape; arguments as for fractions_from_function()."""
    if not isinstance(shape, Shape):
        raise TypeError(f"shape must be a Shape, got {type(shape).__name__}")
    relay = Relay(progress)
    options = _function_options(relay, tolerance, kink_tolerance, max_calls_per_cell, threads)
    return _sample(
        relay,
        grid_struct(dims, spacing, origin, edges),
        FunctionReport,
        library.dif_fractions_from_shape,
        shape._handle.pointer,
        byref(options),
        report=DifFunctionReport(),
    )


def fractions_from_mesh(
    mesh: Mesh,
    dims: Dims,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    *,
    tolerance: Optional[float] = None,
    flip: bool = False,
    check_edges: bool = True,
    overlaps: str = "union",
    threads: int = 0,
    progress: Progress = None,
) -> Field:
    """Exact volume fractions of the inside of a closed mesh.

    dims, spacing, origin, progress: as for fractions_from_function().
    tolerance: by which a column of cells may miss an integer; [1e-12, 0.25], 1e-9.
    flip: triangles are clockwise seen from outside.
    check_edges: every edge must have its opposite.
    overlaps: where parts of the mesh overlap, "union" counts space once, "refuse" raises, and
        "count" as often as it is covered; fractions may then exceed 1. The report says how much
        overlaps and where.

    Raises InvalidArgumentError for a mesh that is open, inside out or of mixed orientation, or has
    parts that are inside out.
    """
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh must be a Mesh, got {type(mesh).__name__}; see Mesh(points, faces)")
    relay = Relay(progress)
    options = defaults(DifTriangleOptions, "dif_triangle_options_init")
    options.progress = relay.progress
    options.threads = int32(threads, "threads")
    options.flip = bool(flip)
    options.check_edges = bool(check_edges)
    options.overlaps = choice(overlaps, _OVERLAPS, "overlaps")
    if tolerance is not None:
        options.tolerance = tolerance
    return _sample(
        relay,
        grid_struct(dims, spacing, origin),
        TriangleReport,
        library.dif_fractions_from_mesh,
        mesh._handle.pointer,
        byref(options),
        report=DifTriangleReport(),
    )
