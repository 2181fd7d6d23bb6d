"""Surfaces of fields, whole or in blocks."""

from __future__ import annotations

from ctypes import byref, c_void_p
from typing import Any, Optional, Sequence, Union

import numpy.typing as npt

from . import _constants
from ._calls import Progress, Relay
from ._errors import check, warn_of
from ._library import library
from ._memory import Edges, Triple, field_struct, grid_struct, index_triple
from ._mesh import Mesh, new_mesh_handle
from ._options import to_options
from ._structs import DifBlock
from ._values import Labels, taken_as_asked

#: Ghost cells that a block needs beyond each face, as far as the domain reaches; and for "curved".
GHOST_LAYERS = _constants.GHOST_LAYERS
CURVED_GHOST_LAYERS = _constants.CURVED_GHOST_LAYERS


def reconstruct(
    fractions: Any,
    *,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    edges: Edges = None,
    axes: str = "kji",
    full_value: Optional[float] = None,
    empty_value: float = 0.0,
    labels: Optional[Labels] = None,
    placement: str = "plic",
    normals: str = "height_function",
    boundary: Union[str, Sequence[str]] = "open",
    vertex_normals: bool = False,
    edge_ids: bool = False,
    purity_tolerance: Optional[float] = None,
    overshoot_bound: Optional[float] = None,
    clearance: Optional[float] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """The surface of a field of volume fractions.

    Marching cubes on the grid of cell centres at 1/2 ("curved" may put a centre with a fraction of
    0.3 to 0.7 on the other side), with the vertices where `placement` puts them. The mesh is
    manifold and free of self-intersections for every field. It ends only on `open` and `mirror`
    sides, at the ends of the period of `periodic` axes, which are the first cell centre and its
    image, and along edges of the domain where an `empty` side meets a `full` one.

    fractions: the share of each cell that is inside: a Field, or an array of float32, float64, or
        uint8 and uint16, which stand for value / largest value. Read where it lies, whatever its
        strides; only a bool array is copied, to one byte per cell, and a list to an array.
        Elements must be aligned and in the machine's byte order.
    spacing, origin: edges of a cell, and low corner of the grid, in x, y, z or one number for all;
        that of the Field, or 1 and 0.
    edges: stretched axes: for x, y and z the faces between cells, one more than there are cells,
        strictly increasing, in place of spacing and origin; None for an axis that is uniform.
    axes: "kji" if the array is indexed [k, j, i], z first and x last, as C and most files have
        it; "ijk" if it is indexed [i, j, k]. Says nothing of how it lies in memory.
    full_value, empty_value: the values that stand for 1 and 0, as fractions_from_values() takes
        them; the array may then be of any integers or floats.
    labels: one integer or several; cells with one of these values are full, the others empty.
        If neither is given, a Warning names the highest value of integers that look like a mask or
        a segmentation: none is the largest of the type, and none reaches half of it or there are at
        most 16 different ones.
    placement: "plic" (second-order accurate), "curved" (of fourth order where surfaces are smooth),
        "manson", "linear" (plain marching cubes) or "midpoint".
    normals: how those of cells are estimated: "height_function", "myc", "youngs", "elvira" or
        "lvira".
    boundary: what lies beyond the domain: "open", "mirror", "periodic", "empty" or "full"; one
        for all or six: x low, x high, y low, y high, z low, z high.
    vertex_normals, edge_ids: whether the mesh gets them.
    purity_tolerance: a fraction up to this is empty, from 1 - this on full; [0, 0.1], 1e-6.
    overshoot_bound: fractions so far outside [0, 1] are clamped; [0, 1], 0.1.
    clearance: of vertices from the ends of edges, over the edge; [1e-13, 0.25], 1e-12.
    threads: at most so many, 0 for as many as the machine has; the mesh is the same, bit for bit.
    progress: called with the share done, in [0, 1]; cancels by returning False or raising.

    Ctrl-C cancels too, within some milliseconds to some tenths of a second in the main thread;
    other threads of Python run meanwhile, and must not write to the array.

    Raises TypeError or ValueError for what is no field, and Error, which says what and where:
    InvalidGridError, InvalidValueError (a cell that is NaN, for instance), InvalidArgumentError,
    TooLargeError, OutOfMemoryError, CancelledError.
    """
    relay = Relay(progress)
    asked = taken_as_asked(fractions, full_value, empty_value, labels)
    field, array = field_struct(asked, spacing, origin, axes, edges)
    options = to_options(
        relay,
        boundary,
        placement=placement,
        normals=normals,
        vertex_normals=bool(vertex_normals),
        edge_ids=bool(edge_ids),
        purity_tolerance=purity_tolerance,
        overshoot_bound=overshoot_bound,
        clearance=clearance,
        threads=threads,
    )
    handle = new_mesh_handle()
    relay.call(library.dif_reconstruct, byref(field), byref(options), byref(handle.pointer))
    mesh = Mesh._from_handle(handle)
    warn_of(handle.pointer, library.dif_mesh_warning)
    del array  # which had to live until here
    return mesh


def reconstruct_block(
    fractions: Any,
    *,
    grid_dims: Union[int, Sequence[int], npt.NDArray[Any]],
    offset: Union[Sequence[int], npt.NDArray[Any]],
    dims: Union[int, Sequence[int], npt.NDArray[Any]],
    ghost_low: Union[int, Sequence[int], npt.NDArray[Any]] = 0,
    ghost_high: Union[int, Sequence[int], npt.NDArray[Any]] = 0,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    edges: Edges = None,
    axes: str = "kji",
    placement: str = "plic",
    normals: str = "height_function",
    boundary: Union[str, Sequence[str]] = "open",
    vertex_normals: bool = False,
    purity_tolerance: Optional[float] = None,
    overshoot_bound: Optional[float] = None,
    clearance: Optional[float] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """The surface of one block of a larger grid, for weld(). Experimental.

    fractions: of the cells [offset - ghost_low, offset + dims + ghost_high) of the whole grid,
        which has grid_dims cells; GHOST_LAYERS ghost cells (CURVED_GHOST_LAYERS for "curved") are
        needed beyond each face of the block, as far as the domain reaches. All of these in x, y, z.
    spacing, origin, edges, boundary: of the whole grid. Others as for reconstruct(). The mesh has
    edge_ids.
    """
    relay = Relay(progress)
    field, array = field_struct(fractions, spacing, origin, axes)
    options = to_options(
        relay,
        boundary,
        placement=placement,
        normals=normals,
        vertex_normals=bool(vertex_normals),
        purity_tolerance=purity_tolerance,
        overshoot_bound=overshoot_bound,
        clearance=clearance,
        threads=threads,
    )
    block = DifBlock(
        offset=index_triple(offset, "offset"),
        dims=index_triple(dims, "dims"),
        ghost_low=index_triple(ghost_low, "ghost_low"),
        ghost_high=index_triple(ghost_high, "ghost_high"),
    )
    grid = grid_struct(grid_dims, spacing, origin, edges)
    handle = new_mesh_handle()
    relay.call(
        library.dif_reconstruct_block,
        byref(field),
        byref(block),
        byref(grid),
        byref(options),
        byref(handle.pointer),
    )
    del array
    return Mesh._from_handle(handle)


def weld(
    meshes: Sequence[Mesh],
    grid_dims: Union[int, Sequence[int], npt.NDArray[Any]],
    spacing: Triple = 1.0,
    origin: Triple = 0.0,
) -> Mesh:
    """Joins meshes of disjoint blocks, others are refused. Experimental.

    Those of blocks that cover the grid give the mesh of the whole field, bit for bit.
    """
    pointers = (c_void_p * len(meshes))(*(mesh._handle.pointer.value for mesh in meshes))
    grid = grid_struct(grid_dims, spacing, origin)
    handle = new_mesh_handle()
    check(library.dif_mesh_weld(pointers, len(meshes), byref(grid), byref(handle.pointer)))
    return Mesh._from_handle(handle)
