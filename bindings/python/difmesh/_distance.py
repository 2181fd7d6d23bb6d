"""Distances between surfaces."""

from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass
from typing import Any, Optional, Union

from ._calls import Function, Progress, Relay
from ._fractions import Shape
from ._library import defaults, library
from ._mesh import Mesh, to_dataclass
from ._options import int32
from ._structs import DifDistance, DifDistanceOptions, DifStatistics


@dataclass(frozen=True)
class Statistics:
    """Distances d of some points."""

    points: int
    rms: float
    mean: float  #: of |d|
    signed_mean: float  #: of d: the bias
    lowest: float  #: least d
    highest: float  #: greatest d
    maximum: float  #: greatest |d|
    maximum_index: int  #: its vertex, or triangle for facet points; -1 for no points
    maximum_position: tuple[float, float, float]


@dataclass(frozen=True)
class Distance:
    """Distances of a surface from another."""

    vertices: Statistics  #: of the vertices in use
    facets: Statistics  #: of points on the facets; means are by area
    area: float  #: of the measured surface
    reach: float  #: no point is further from a vertex or facet point
    has_sign: bool  #: False: all d >= 0


def _result(struct: DifDistance) -> Distance:
    def statistics(of: DifStatistics) -> Statistics:
        result: Statistics = to_dataclass(Statistics, of)
        return result

    return Distance(
        statistics(struct.vertices),
        statistics(struct.facets),
        struct.area,
        struct.reach,
        struct.has_sign != 0,
    )


def _options(
    relay: Relay, facet_spacing: Optional[float], with_sign: bool, threads: int
) -> DifDistanceOptions:
    options = defaults(DifDistanceOptions, "dif_distance_options_init")
    options.progress = relay.progress
    options.with_sign = bool(with_sign)
    options.threads = int32(threads, "threads")
    if facet_spacing is not None:
        options.facet_spacing = facet_spacing
    return options


def distance(
    mesh: Mesh,
    reference: Union[Mesh, Shape, Function],
    *,
    facet_spacing: Optional[float] = None,
    with_sign: bool = True,
    threads: Optional[int] = None,
    progress: Progress = None,
) -> Distance:
    """Distances of a mesh's vertices and facets from a reference; < 0 is inside.

    reference: a mesh, a shape, or a signed distance: a function of points (n, 3) that returns (n,),
        which is called with few points at a time, so that Python spends microseconds on each.
    facet_spacing: of the points on facets; by default four points per usual facet.
    with_sign: of a reference mesh: tell inside from outside.
    threads: as for reconstruct(), but 1 by default if reference is a function.

    Raises InvalidArgumentError for an empty mesh, UnsupportedError if not has("distance").
    """
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh must be a Mesh, got {type(mesh).__name__}")
    relay = Relay(progress)
    by_function = not isinstance(reference, (Mesh, Shape))
    if threads is None:
        threads = 1 if by_function else 0
    options = _options(relay, facet_spacing, with_sign, threads)
    result = DifDistance()
    middle: list[Any]
    tail: list[Any] = [byref(options), byref(result)]
    if isinstance(reference, Mesh):
        call, middle = library.dif_distance_to_mesh, [reference._handle.pointer]
        tail.append(None)
    elif isinstance(reference, Shape):
        call, middle = library.dif_distance_to_shape, [reference._handle.pointer]
    else:
        call = library.dif_distance_to_function
        middle = [relay.function(reference, "reference"), None]
    relay.call(call, mesh._handle.pointer, *middle, *tail)
    return _result(result)


def distance_both_ways(
    mesh: Mesh,
    reference: Mesh,
    *,
    facet_spacing: Optional[float] = None,
    with_sign: bool = True,
    threads: int = 0,
    progress: Progress = None,
) -> tuple[Distance, Distance]:
    """Distances of a mesh from a reference mesh, and of the reference from the mesh.

    The larger of their maxima bounds the Hausdorff distance from below, and with the larger reach
    added from above. Arguments as for distance().
    """
    for given in (mesh, reference):
        if not isinstance(given, Mesh):
            raise TypeError(f"mesh and reference must be Meshes, got {type(given).__name__}")
    relay = Relay(progress)
    options = _options(relay, facet_spacing, with_sign, threads)
    there, back = DifDistance(), DifDistance()
    relay.call(
        library.dif_distance_to_mesh,
        mesh._handle.pointer,
        reference._handle.pointer,
        byref(options),
        byref(there),
        byref(back),
    )
    return _result(there), _result(back)
