"""Curved surfaces of cells, and their curvature, without a mesh."""

from __future__ import annotations

from ctypes import byref, c_int64
from dataclasses import dataclass
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._calls import Progress, Relay
from ._constants import SURFACES_FOR_CURVATURE, SURFACES_FOR_POSITION
from ._library import library
from ._memory import Edges, Triple, address_of, cell_array, field_struct
from ._options import choice, to_options
from ._structs import DifField, DifSurfaceArrays

_KINDS = {"position": SURFACES_FOR_POSITION, "curvature": SURFACES_FOR_CURVATURE}
#: Of cell_surfaces() that finds the cells itself: shares of its time for counting and for listing.
_LISTING = 0.05


@dataclass(frozen=True, eq=False)
class CellSurfaces:
    """Surfaces of n cells: graphs zeta = q(xi, eta) over planes through the cells' centres.

    The material is below, zeta < q. Curvatures are in 1 / unit of the spacing, the Gaussian in its
    square, and positive where the material is convex: 1/R for a drop of radius R. Cells without a
    surface have source 0, and NaN for curvatures.
    """

    cells: npt.NDArray[np.int64]  #: (n, 3): i, j, k in x, y, z
    #: (n,): 0 none, 1 heights of 13 columns, 2 of 25, 3 quadratic fit, 4 quartic fit
    source: npt.NDArray[np.int32]
    axis: npt.NDArray[np.int32]  #: (n,): the axis that columns run along, 0 to 2; -1 for fits
    foot: npt.NDArray[np.float64]  #: (n, 3), from the centre: point of the surface next to it
    normal: npt.NDArray[np.float64]  #: (n, 3), there: unit vector out of the material
    mean: npt.NDArray[np.float64]  #: (n,), there: half the sum of the principal curvatures
    gaussian: npt.NDArray[np.float64]  #: (n,): their product
    largest: npt.NDArray[np.float64]  #: (n,): the larger of them
    smallest: npt.NDArray[np.float64]  #: (n,): the smaller
    #: (n,): by how much fractions differ from what the surface says, at most 0.03
    residual: npt.NDArray[np.float64]
    length: npt.NDArray[np.float64]  #: (n,): cube root of the cell's volume
    frame: npt.NDArray[np.float64]  #: (n, 3, 3): unit vectors along xi, eta and zeta
    #: (n, 5, 5): of (xi / length)^p (eta / length)^q at [p, q]; their sum is zeta / length
    coefficients: npt.NDArray[np.float64]


def cell_curvature(
    fractions: Any,
    *,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    edges: Edges = None,
    axes: str = "kji",
    boundary: Union[str, Sequence[str]] = "open",
    purity_tolerance: Optional[float] = None,
    overshoot_bound: Optional[float] = None,
    threads: int = 0,
    progress: Progress = None,
) -> npt.NDArray[np.float64]:
    """Mean curvature of the surface in all interfacial cells; other cells get 0.

    In 1 / unit of the spacing; positive where the material is convex: 1/R in a drop of radius R.
    Interfacial cells where none can be told get NaN. Arguments and exceptions as for reconstruct().
    The result is indexed like `fractions`, and lies x fastest.
    """
    relay = Relay(progress)
    field, array = field_struct(fractions, spacing, origin, axes, edges)
    options = to_options(
        relay,
        boundary,
        purity_tolerance=purity_tolerance,
        overshoot_bound=overshoot_bound,
        threads=threads,
    )
    mean = np.empty(tuple(field.dims)[::-1])
    relay.call(library.dif_cell_curvature, byref(field), byref(options), address_of(mean), None)
    del array
    return mean.T if axes == "ijk" else mean


def cell_surfaces(
    fractions: Any,
    cells: Any = None,
    kind: str = "curvature",
    *,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    edges: Edges = None,
    axes: str = "kji",
    boundary: Union[str, Sequence[str]] = "open",
    purity_tolerance: Optional[float] = None,
    overshoot_bound: Optional[float] = None,
    threads: int = 0,
    progress: Progress = None,
) -> CellSurfaces:
    """Curved surfaces of some cells, given as integers (n, 3): i, j, k in x, y, z.

    cells: None for all interfacial cells, in the order z, y, x; the whole field is checked then.
        Otherwise it is read only near these cells, and NaN there count as 0.
    kind: what is to have the least error, "curvature" or "position".
    Other arguments and exceptions as for reconstruct().
    """
    number = choice(kind, _KINDS, "kind")
    field, array = field_struct(fractions, spacing, origin, axes, edges)
    given = {
        "purity_tolerance": purity_tolerance,
        "overshoot_bound": overshoot_bound,
        "threads": threads,
    }
    done = 0.0
    if cells is None:
        index = _interfacial_cells(field, boundary, given, progress)
        done = 2 * _LISTING
    else:
        index = cell_array(cells)
    result = _empty_surfaces(index)
    arrays = DifSurfaceArrays(
        **{
            name: address_of(values) for name, values in vars(result).items() if name != "cells"
        }
    )
    relay = Relay(_part(progress, done, 1.0))
    options = to_options(relay, boundary, **given)
    relay.call(
        library.dif_cell_surfaces,
        byref(field),
        byref(options),
        number,
        len(index),
        address_of(index),
        byref(arrays),
    )
    del array
    return result


def _part(progress: Progress, begin: float, end: float) -> Progress:
    """The progress of a call that is a part of the work."""
    if progress is None:
        return None
    tell = progress
    return lambda share: tell(end if share == 1.0 else begin + (end - begin) * share)


def _interfacial_cells(
    field: DifField, boundary: Union[str, Sequence[str]], given: dict[str, Any], progress: Progress
) -> npt.NDArray[np.int64]:
    count = c_int64()
    index = np.empty((0, 3), np.int64)
    for begin in (0.0, _LISTING):  # first their number
        relay = Relay(_part(progress, begin, begin + _LISTING))
        options = to_options(relay, boundary, **given)
        relay.call(
            library.dif_interfacial_cells,
            byref(field),
            byref(options),
            len(index),
            address_of(index),
            byref(count),
        )
        if begin == 0.0:
            index = np.empty((count.value, 3), np.int64)
    return index[: count.value]  # fewer if another thread writes to the field meanwhile


def _empty_surfaces(index: npt.NDArray[np.int64]) -> CellSurfaces:
    count = len(index)
    return CellSurfaces(
        cells=index,
        source=np.empty(count, np.int32),
        axis=np.empty(count, np.int32),
        foot=np.empty((count, 3)),
        normal=np.empty((count, 3)),
        mean=np.empty(count),
        gaussian=np.empty(count),
        largest=np.empty(count),
        smallest=np.empty(count),
        residual=np.empty(count),
        length=np.empty(count),
        frame=np.empty((count, 3, 3)),
        coefficients=np.empty((count, 5, 5)),
    )
