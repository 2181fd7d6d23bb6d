"""Curvature and smoothing of meshes, mollification of fields."""

from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._calls import Progress, Relay
from ._field import Field
from ._library import defaults, library
from ._memory import Triple, address_of, field_struct, floats, grid_struct
from ._mesh import Mesh, new_mesh_handle
from ._options import choice, choices, int32, six_kinds
from ._structs import DifCurvatureOptions, DifMollifyOptions, DifSmoothingOptions

_KINDS = choices("SMOOTHING_")
_BOUNDARIES = choices("BOUNDARY_")


@dataclass(frozen=True, eq=False)
class Curvature:
    """Curvatures at the vertices of a mesh, (n,) each; NaN where too few neighbours determine none.

    In 1 / unit of the points, the Gaussian squared. Positive where bodies are convex: 1/R for a
    ball of radius R.
    """

    mean: npt.NDArray[np.float64]  #: half the sum of the principal curvatures
    gaussian: npt.NDArray[np.float64]  #: their product
    largest: npt.NDArray[np.float64]  #: the larger of them
    smallest: npt.NDArray[np.float64]  #: the smaller


def curvature(
    mesh: Mesh, *, rings: int = 2, threads: int = 0, progress: Progress = None
) -> Curvature:
    """Curvatures by parabolic patches, fitted to the neighbours up to so many edges away.

    rings: [1, 8]; more smooth more, and see less.
    threads, progress: as for reconstruct().
    """
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh must be a Mesh, got {type(mesh).__name__}; see Mesh(points, faces)")
    relay = Relay(progress)
    options = defaults(DifCurvatureOptions, "dif_curvature_options_init")
    options.rings = int32(rings, "rings")
    options.threads = int32(threads, "threads")
    options.progress = relay.progress
    arrays = [np.empty(len(mesh.points)) for _ in range(4)]
    relay.call(
        library.dif_mesh_curvature,
        mesh._handle.pointer,
        byref(options),
        *(address_of(array) for array in arrays),
    )
    return Curvature(*arrays)


def smooth(
    mesh: Mesh,
    kind: str = "taubin",
    *,
    steps: Optional[int] = None,
    factor: Optional[float] = None,
    pass_band: Optional[float] = None,
    boundary: str = "stay",
    time: Optional[float] = None,
    residual: Optional[float] = None,
    tolerance: Optional[float] = None,
    clearance: Optional[float] = None,
    dims: Union[int, Sequence[int], npt.NDArray[Any], None] = None,
    spacing: Triple = 1.0,
    origin: Triple = 0.0,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """A mesh with the vertices moved and the same faces; without scalars and report.

    If the mesh has normals, the new one has those of the smooth surface.

    kind:
        "laplacian": to the mean of the neighbours; shrinks. `factor`, (0, 1], is the share of the
            way, 1; `steps` 1.
        "taubin": to the mean and back by more; hardly shrinks. `factor` 0.6307; `pass_band`, the
            frequency below which nothing is damped, 0.1; `steps` 15.
        "flow": along the normal by the mean curvature, implicit; shrinks. `time` of each step, in
            the square of the unit of the points, 1; `residual` of the linear systems, over the
            first, [1e-14, 0.1], 1e-10; `steps` 1.
        "constrained": no cell's fraction changes by more than `tolerance`, 0.01; `clearance` as for
            reconstruct(); `steps` 3. For closed meshes with edge_ids; dims, spacing and origin of
            the grid must be those of the reconstruction.
    boundary: of "laplacian" and "taubin": whether vertices on boundaries "stay", or see their
        neighbours "along" the boundary only.
    threads, progress: as for reconstruct().
    """
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh must be a Mesh, got {type(mesh).__name__}; see Mesh(points, faces)")
    relay = Relay(progress)
    options = defaults(DifSmoothingOptions, "dif_smoothing_options_init")
    options.kind = choice(kind, _KINDS, "kind")
    options.boundary = choice(boundary, _BOUNDARIES, "boundary")
    options.threads = int32(threads, "threads")
    options.progress = relay.progress
    if steps is not None:
        options.steps = int32(steps, "steps")
        if steps == 0:
            raise ValueError("steps is 0; leave it out for the usual number")
    if factor is not None:
        options.factor = factor
        setattr(options, "lambda", factor)
    for name, value in (
        ("pass_band", pass_band),
        ("time", time),
        ("residual", residual),
        ("tolerance", tolerance),
        ("clearance", clearance),
    ):
        if value is not None:
            setattr(options, name, value)
    grid = None if dims is None else byref(grid_struct(dims, spacing, origin))
    handle = new_mesh_handle()
    relay.call(
        library.dif_mesh_smooth,
        mesh._handle.pointer,
        grid,
        byref(options),
        byref(handle.pointer),
    )
    return Mesh._from_handle(handle)


def mollify(
    fractions: Any,
    *,
    radius: float = 2.0,
    boundary: Union[str, Sequence[str]] = "open",
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    axes: str = "kji",
    threads: int = 0,
    progress: Progress = None,
) -> Field:
    """The convolution of a field with a compact kernel, which keeps its sum.

    fractions, spacing, origin, axes, threads, progress: as for reconstruct().
    radius: where the kernel ends, in cells; [1, 8].
    boundary: as for reconstruct(); "open" counts as "mirror" here, and "empty" and "full" let
        material out or in.
    """
    relay = Relay(progress)
    field, array = field_struct(fractions, spacing, origin, axes)
    options = defaults(DifMollifyOptions, "dif_mollify_options_init")
    options.radius = radius
    options.boundary = six_kinds(boundary)
    options.threads = int32(threads, "threads")
    options.progress = relay.progress
    values = np.empty(tuple(field.dims)[::-1])
    relay.call(library.dif_mollify, byref(field), byref(options), address_of(values))
    del array  # which had to live until here
    return Field(values, floats(field.spacing), floats(field.origin))
