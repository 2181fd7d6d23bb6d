"""Normals and planes of cells, without a mesh."""

from __future__ import annotations

from ctypes import byref, c_double
from dataclasses import dataclass
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._calls import Progress, Relay
from ._errors import check
from ._library import library
from ._memory import Edges, Triple, address_of, cell_array, field_struct, triple
from ._options import to_options
from ._structs import DifPlaneArrays


@dataclass(frozen=True, eq=False)
class Planes:
    """Planes {x : normal . (x - centre) = offset} in cells; material is where it is <= offset."""

    normals: npt.NDArray[np.float64]  #: [..., axis]: unit vectors out of the material, or 0
    offsets: npt.NDArray[np.float64]
    #: 0 none, 1 Youngs, 2 centred columns, 3 height function, 4 least squares at an open side
    sources: npt.NDArray[np.int32]


def normals(
    fractions: Any,
    *,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    edges: Edges = None,
    axes: str = "kji",
    normals: str = "height_function",
    boundary: Union[str, Sequence[str]] = "open",
    purity_tolerance: Optional[float] = None,
    overshoot_bound: Optional[float] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Planes:
    """Normals and planes of all interfacial cells; those of other cells are 0.

    Arguments and exceptions as for reconstruct(). The results are indexed like `fractions`, with
    x, y, z of the normals last, and lie x fastest, component by component, as solvers have them.
    """
    relay = Relay(progress)
    field, array = field_struct(fractions, spacing, origin, axes, edges)
    options = to_options(
        relay,
        boundary,
        normals=normals,
        purity_tolerance=purity_tolerance,
        overshoot_bound=overshoot_bound,
        threads=threads,
    )
    shape = tuple(field.dims)[::-1]
    numbers = np.empty((4, *shape))
    sources = np.empty(shape, np.int32)
    nx, ny, _ = field.dims
    arrays = DifPlaneArrays(
        normal_x=numbers[0].ctypes.data,
        normal_y=numbers[1].ctypes.data,
        normal_z=numbers[2].ctypes.data,
        offset=numbers[3].ctypes.data,
        source=sources.ctypes.data,
        strides=(1, nx, nx * ny),
    )
    relay.call(library.dif_field_planes, byref(field), byref(options), byref(arrays))
    del array
    if axes == "ijk":
        return Planes(numbers[:3].T, numbers[3].T, sources.T)
    return Planes(np.moveaxis(numbers[:3], 0, -1), numbers[3], sources)


def cell_planes(
    fractions: Any,
    cells: Any,
    *,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    edges: Edges = None,
    axes: str = "kji",
    normals: str = "height_function",
    boundary: Union[str, Sequence[str]] = "open",
    purity_tolerance: Optional[float] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Planes:
    """Normals and planes of some cells, given as integers (n, 3): i, j, k in x, y, z.

    The field is read only near these cells; NaN there count as some fraction. Results have the
    shapes (n, 3), (n,) and (n,). Other arguments and exceptions as for reconstruct().
    """
    index = cell_array(cells)
    relay = Relay(progress)
    field, array = field_struct(fractions, spacing, origin, axes, edges)
    options = to_options(
        relay, boundary, normals=normals, purity_tolerance=purity_tolerance, threads=threads
    )
    result = Planes(np.empty(index.shape), np.empty(len(index)), np.empty(len(index), np.int32))
    relay.call(
        library.dif_cell_planes,
        byref(field),
        byref(options),
        len(index),
        address_of(index),
        address_of(result.normals),
        address_of(result.offsets),
        address_of(result.sources),
    )
    del array
    return result


def _plane_numbers(
    normals: Any, others: Any, name: str
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    vectors = np.asarray(normals, dtype=np.float64)
    if vectors.ndim == 0 or vectors.shape[-1] != 3:
        raise ValueError(f"normals must have shape (..., 3), got {vectors.shape}")
    numbers = np.asarray(others, dtype=np.float64)
    try:
        shape = np.broadcast_shapes(vectors.shape[:-1], numbers.shape)
    except ValueError:
        raise ValueError(
            f"normals of shape {vectors.shape} do not go with {name} of shape {numbers.shape}"
        ) from None
    return (
        np.require(np.broadcast_to(vectors, (*shape, 3)), requirements=["A", "C"]),
        np.require(np.broadcast_to(numbers, shape), requirements=["A", "C"]),
    )


def _plane_call(
    function: Any, normals: Any, others: Any, name: str, spacing: Triple
) -> npt.NDArray[np.float64]:
    vectors, numbers = _plane_numbers(normals, others, name)
    result = np.empty(numbers.shape)
    edges = (c_double * 3)(*triple(spacing, "spacing"))
    check(
        function(
            edges, numbers.size, address_of(vectors), address_of(numbers), address_of(result)
        )
    )
    return result


def plane_fraction(
    normals: Any, offsets: Any, spacing: Triple = 1.0
) -> npt.NDArray[np.float64]:
    """Shares of cells below planes {x : normal . (x - centre) = offset}.

    normals: (..., 3), out of the material, of any length but 0, in units of which `offsets`, (...),
    are; spacing: edges of the cells. The arrays are broadcast against each other.
    """
    return _plane_call(library.dif_plane_fraction, normals, offsets, "offsets", spacing)


def plane_offset(
    normals: Any, fractions: Any, spacing: Triple = 1.0
) -> npt.NDArray[np.float64]:
    """The inverse of plane_fraction(): offsets of planes below which `fractions` of the cells lie.

    Fractions are clamped to [0, 1]; the offsets are exact to 1e-14 in the fraction.
    """
    return _plane_call(library.dif_plane_offset, normals, fractions, "fractions", spacing)
