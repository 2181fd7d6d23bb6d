"""Accurate triangle surfaces from volume fractions.

    import difmesh

    mesh = difmesh.reconstruct(fractions, spacing=0.01)  # fractions[k, j, i]
    mesh.points, mesh.faces                              # NumPy arrays
    mesh.save("surface.ply")

Functions that take or give coordinates, spacings, numbers of cells (`dims`) or cells use the order
x, y, z. Arrays of fractions are indexed [k, j, i], that is [z, y, x], unless `axes="ijk"` is given.
What the library refuses is raised as Error or one of its subclasses, with the library's message.
"""

from . import _library
from ._cell_surfaces import CellSurfaces, cell_curvature, cell_surfaces
from ._distance import Distance, Statistics, distance, distance_both_ways
from ._errors import (
    CancelledError,
    Error,
    FileFormatError,
    FileMissingError,
    FileWriteError,
    InvalidArgumentError,
    InvalidGridError,
    InvalidValueError,
    OutOfMemoryError,
    TooLargeError,
    UnsupportedError,
    Warning,
)
from ._field import Field, FunctionReport, TriangleReport
from ._files import read_field, write_field
from ._fractions import Shape, fractions_from_function, fractions_from_mesh, fractions_from_shape
from ._mesh import Measure, Mesh, Report, WriteReport, read_mesh
from ._options import choice as _choice
from ._options import choices as _choices
from ._planes import Planes, cell_planes, normals, plane_fraction, plane_offset
from ._reconstruct import CURVED_GHOST_LAYERS, GHOST_LAYERS, reconstruct, reconstruct_block, weld
from ._smoothing import Curvature, curvature, mollify, smooth
from ._values import fractions_from_labels, fractions_from_values

__version__ = "0.2.0"

__all__ = [
    "CURVED_GHOST_LAYERS",
    "GHOST_LAYERS",
    "CancelledError",
    "CellSurfaces",
    "Curvature",
    "Distance",
    "Error",
    "Field",
    "FileFormatError",
    "FileMissingError",
    "FileWriteError",
    "FunctionReport",
    "InvalidArgumentError",
    "InvalidGridError",
    "InvalidValueError",
    "Measure",
    "Mesh",
    "OutOfMemoryError",
    "Planes",
    "Report",
    "Shape",
    "Statistics",
    "TooLargeError",
    "TriangleReport",
    "UnsupportedError",
    "Warning",
    "WriteReport",
    "cell_curvature",
    "cell_planes",
    "cell_surfaces",
    "curvature",
    "distance",
    "distance_both_ways",
    "fractions_from_labels",
    "fractions_from_values",
    "has",
    "library_version",
    "mollify",
    "normals",
    "plane_fraction",
    "plane_offset",
    "read_field",
    "read_mesh",
    "reconstruct",
    "reconstruct_block",
    "fractions_from_function",
    "fractions_from_mesh",
    "fractions_from_shape",
    "smooth",
    "weld",
    "write_field",
]


_PARTS = _choices("PART_")


def library_version() -> str:
    """Version of the library that was loaded, "0.2.0" for instance."""
    text: bytes = _library.library.dif_version_text()
    return text.decode()


def has(part: str) -> bool:
    """Whether the library was built with "threads", "files", "distance", "gltf" or "draco"."""
    number = _choice(part, _PARTS, "part")
    present: int = _library.library.dif_has(number)
    return present == 1
