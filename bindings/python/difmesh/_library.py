"""Finds and loads libdifmesh, and declares its functions to ctypes."""

from __future__ import annotations

import ctypes
import os
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_int64, c_uint64, c_void_p
from pathlib import Path
from typing import Any, TypeVar

from . import _structs as s

#: The interface that this package is written for; see "Stability" in difmesh.h.
_NAME = "libdifmesh.so.0"


def _load() -> ctypes.CDLL:
    given = os.environ.get("DIFMESH_LIBRARY")
    beside = Path(__file__).with_name(_NAME)
    path = given or (str(beside) if beside.exists() else _NAME)
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        where = "which DIFMESH_LIBRARY names" if given else "the library that difmesh calls"
        raise ImportError(
            f"cannot load {path}, {where}: {error}. It is looked for where the environment "
            f"variable DIFMESH_LIBRARY says, then at {beside}, then where the system's loader "
            f"looks (LD_LIBRARY_PATH, /usr/local/lib after ldconfig, and so on)"
        ) from error


library = _load()

_MESH = _SHAPE = _FILE = c_void_p
_OUT = POINTER(c_void_p)
_DIMS = POINTER(c_int64)
_COUNT = POINTER(c_int64)
_FIELD = POINTER(s.DifField)
_OPTIONS = POINTER(s.DifOptions)
_GRID = POINTER(s.DifGrid)
_FUNCTION_OPTIONS = POINTER(s.DifFunctionOptions)
_FUNCTION_REPORT = POINTER(s.DifFunctionReport)
_TRIANGLE_OPTIONS = POINTER(s.DifTriangleOptions)
_TRIANGLE_REPORT = POINTER(s.DifTriangleReport)
_DISTANCE_OPTIONS = POINTER(s.DifDistanceOptions)
_DISTANCE = POINTER(s.DifDistance)
_TRIPLE = POINTER(c_double)


def _init(struct: type[s.Sized]) -> list[Any]:
    return [POINTER(struct), c_uint64]


#: Arguments of the functions that return a status.
_ARGUMENTS: dict[str, list[Any]] = {
    "dif_options_init": _init(s.DifOptions),
    "dif_reconstruct": [_FIELD, _OPTIONS, _OUT],
    "dif_mesh_positions": [_MESH, _OUT, _COUNT],
    "dif_mesh_triangles": [_MESH, _OUT, _COUNT],
    "dif_mesh_normals": [_MESH, _OUT, _COUNT],
    "dif_mesh_edge_ids": [_MESH, _OUT, _COUNT],
    "dif_mesh_report": [_MESH, POINTER(s.DifReport)],
    "dif_mesh_from_arrays": [c_void_p, c_int64, c_void_p, c_int64, _OUT],
    "dif_mesh_set_normals": [_MESH, c_void_p],
    "dif_mesh_set_edge_ids": [_MESH, c_void_p],
    "dif_mesh_set_scalars": [_MESH, c_char_p, c_void_p],
    "dif_mesh_scalars_name": [_MESH, c_int64, POINTER(c_char_p)],
    "dif_mesh_scalars": [_MESH, c_char_p, _OUT, _COUNT],
    "dif_plane_fraction": [_TRIPLE, c_int64, c_void_p, c_void_p, c_void_p],
    "dif_plane_offset": [_TRIPLE, c_int64, c_void_p, c_void_p, c_void_p],
    "dif_cell_planes": [_FIELD, _OPTIONS, c_int64, c_void_p, c_void_p, c_void_p, c_void_p],
    "dif_field_planes": [_FIELD, _OPTIONS, POINTER(s.DifPlaneArrays)],
    "dif_function_options_init": _init(s.DifFunctionOptions),
    "dif_fractions_from_function": [
        _GRID, s.FUNCTION, c_void_p, _FUNCTION_OPTIONS, _FUNCTION_REPORT, c_void_p
    ],
    "dif_triangle_options_init": _init(s.DifTriangleOptions),
    "dif_fractions_from_mesh": [_GRID, _MESH, _TRIANGLE_OPTIONS, _TRIANGLE_REPORT, c_void_p],
    "dif_shape_options_init": _init(s.DifShapeOptions),
    "dif_shape_create": [POINTER(s.DifShapeOptions), _OUT],
    "dif_shape_bounds": [_SHAPE, _TRIPLE, _TRIPLE],
    "dif_shape_volume": [_SHAPE, _TRIPLE],
    "dif_shape_distances": [_SHAPE, c_int64, c_void_p, c_void_p],
    "dif_fractions_from_shape": [_GRID, _SHAPE, _FUNCTION_OPTIONS, _FUNCTION_REPORT, c_void_p],
    "dif_mesh_measure": [_MESH, POINTER(s.DifMeasure)],
    "dif_distance_options_init": _init(s.DifDistanceOptions),
    "dif_distance_to_shape": [_MESH, _SHAPE, _DISTANCE_OPTIONS, _DISTANCE],
    "dif_distance_to_function": [_MESH, s.FUNCTION, c_void_p, _DISTANCE_OPTIONS, _DISTANCE],
    "dif_distance_to_mesh": [_MESH, _MESH, _DISTANCE_OPTIONS, _DISTANCE, _DISTANCE],
    "dif_fractions_from_values": [_FIELD, c_double, c_double, c_void_p],
    "dif_fractions_from_labels": [_FIELD, c_int64, c_void_p, c_void_p],
    "dif_value_extremes": [_FIELD, _TRIPLE, _TRIPLE],
    "dif_mollify_options_init": _init(s.DifMollifyOptions),
    "dif_mollify": [_FIELD, POINTER(s.DifMollifyOptions), c_void_p],
    "dif_curvature_options_init": _init(s.DifCurvatureOptions),
    "dif_mesh_curvature": [
        _MESH, POINTER(s.DifCurvatureOptions), c_void_p, c_void_p, c_void_p, c_void_p
    ],
    "dif_smoothing_options_init": _init(s.DifSmoothingOptions),
    "dif_mesh_smooth": [_MESH, _GRID, POINTER(s.DifSmoothingOptions), _OUT],
    "dif_mesh_write_options_init": _init(s.DifMeshWriteOptions),
    "dif_mesh_write_reported": [
        _MESH, c_char_p, POINTER(s.DifMeshWriteOptions), POINTER(s.DifMeshWriteReport)
    ],
    "dif_mesh_read": [c_char_p, _OUT],
    "dif_mesh_warning": [_MESH, c_int64, POINTER(c_char_p)],
    "dif_mesh_read_options_init": _init(s.DifMeshReadOptions),
    "dif_mesh_read_with": [c_char_p, POINTER(s.DifMeshReadOptions), _OUT],
    "dif_raw_layout_init": _init(s.DifRawLayout),
    "dif_field_read": [c_char_p, POINTER(s.DifRawLayout), _OUT],
    "dif_field_read_options_init": _init(s.DifFieldReadOptions),
    "dif_field_read_with": [
        c_char_p, POINTER(s.DifRawLayout), POINTER(s.DifFieldReadOptions), _OUT
    ],
    "dif_field_file_warning": [_FILE, c_int64, POINTER(c_char_p)],
    "dif_field_file_type": [_FILE, POINTER(c_int32)],
    "dif_field_file_field": [_FILE, _FIELD],
    "dif_field_write_options_init": _init(s.DifFieldWriteOptions),
    "dif_field_write": [_FIELD, c_char_p, POINTER(s.DifFieldWriteOptions)],
    "dif_reconstruct_block": [_FIELD, POINTER(s.DifBlock), _GRID, _OPTIONS, _OUT],
    "dif_mesh_weld": [_OUT, c_int64, _GRID, _OUT],
}
#: Results and arguments of the others.
_OTHERS: dict[str, tuple[Any, list[Any]]] = {
    "dif_status_name": (c_char_p, [c_int32]),
    "dif_last_message": (c_char_p, []),
    "dif_version_text": (c_char_p, []),
    "dif_has": (c_int32, [c_int32]),
    "dif_mesh_free": (None, [_MESH]),
    "dif_shape_free": (None, [_SHAPE]),
    "dif_field_file_free": (None, [_FILE]),
}


def _declare() -> None:
    for name, (result, arguments) in {
        **_OTHERS,
        **{name: (c_int32, arguments) for name, arguments in _ARGUMENTS.items()},
    }.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            raise ImportError(
                f"{library._name} has no function {name}: it is older than this package"
            ) from None
        function.restype = result
        function.argtypes = arguments


_declare()

_Struct = TypeVar("_Struct", bound=s.Sized)


def defaults(struct: type[_Struct], init: str) -> _Struct:
    """A struct with the library's defaults."""
    result = struct()
    status = getattr(library, init)(byref(result), result.struct_size)
    if status != 0:  # a struct that the library refuses: not of this interface
        raise ImportError(f"{library._name} refuses {struct.__name__}, status {status}")
    return result
