"""The functions of difmesh.h as ctypes has them.

Written by scripts/generate_bindings.py from difmesh.h; do not edit, run that again.
"""

from __future__ import annotations

from ctypes import POINTER, c_char_p, c_double, c_int32, c_int64, c_uint64, c_void_p
from typing import Any

from . import _structs as s

#: Result and arguments of each function.
FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {
    "dif_status_name": (c_char_p, [c_int32]),
    "dif_last_message": (c_char_p, []),
    "dif_version": (c_int32, []),
    "dif_version_text": (c_char_p, []),
    "dif_has": (c_int32, [c_int32]),
    "dif_field_init": (
        c_int32,
        [POINTER(s.DifField), c_uint64, c_void_p, c_int32, POINTER(c_int64)],
    ),
    "dif_options_init": (c_int32, [POINTER(s.DifOptions), c_uint64]),
    "dif_reconstruct": (c_int32, [POINTER(s.DifField), POINTER(s.DifOptions), POINTER(c_void_p)]),
    "dif_mesh_free": (None, [c_void_p]),
    "dif_mesh_positions": (c_int32, [c_void_p, POINTER(c_void_p), POINTER(c_int64)]),
    "dif_mesh_triangles": (c_int32, [c_void_p, POINTER(c_void_p), POINTER(c_int64)]),
    "dif_mesh_normals": (c_int32, [c_void_p, POINTER(c_void_p), POINTER(c_int64)]),
    "dif_mesh_edge_ids": (c_int32, [c_void_p, POINTER(c_void_p), POINTER(c_int64)]),
    "dif_report_init": (c_int32, [POINTER(s.DifReport), c_uint64]),
    "dif_mesh_report": (c_int32, [c_void_p, POINTER(s.DifReport)]),
    "dif_mesh_from_arrays": (c_int32, [c_void_p, c_int64, c_void_p, c_int64, POINTER(c_void_p)]),
    "dif_mesh_set_normals": (c_int32, [c_void_p, c_void_p]),
    "dif_mesh_set_edge_ids": (c_int32, [c_void_p, c_void_p]),
    "dif_mesh_set_scalars": (c_int32, [c_void_p, c_char_p, c_void_p]),
    "dif_mesh_scalars_name": (c_int32, [c_void_p, c_int64, POINTER(c_char_p)]),
    "dif_mesh_scalars": (c_int32, [c_void_p, c_char_p, POINTER(c_void_p), POINTER(c_int64)]),
    "dif_mesh_copy_positions": (c_int32, [c_void_p, c_int32, c_int64, c_int64, c_void_p]),
    "dif_mesh_copy_normals": (c_int32, [c_void_p, c_int32, c_int64, c_int64, c_void_p]),
    "dif_mesh_copy_triangles": (c_int32, [c_void_p, c_int32, c_int64, c_int64, c_int64, c_void_p]),
    "dif_plane_fraction": (c_int32, [POINTER(c_double), c_int64, c_void_p, c_void_p, c_void_p]),
    "dif_plane_offset": (c_int32, [POINTER(c_double), c_int64, c_void_p, c_void_p, c_void_p]),
    "dif_cell_planes": (
        c_int32,
        [
            POINTER(s.DifField),
            POINTER(s.DifOptions),
            c_int64,
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
        ],
    ),
    "dif_plane_arrays_init": (c_int32, [POINTER(s.DifPlaneArrays), c_uint64]),
    "dif_field_planes": (
        c_int32,
        [POINTER(s.DifField), POINTER(s.DifOptions), POINTER(s.DifPlaneArrays)],
    ),
    "dif_interfacial_cells": (
        c_int32,
        [POINTER(s.DifField), POINTER(s.DifOptions), c_int64, c_void_p, POINTER(c_int64)],
    ),
    "dif_surface_arrays_init": (c_int32, [POINTER(s.DifSurfaceArrays), c_uint64]),
    "dif_cell_surfaces": (
        c_int32,
        [
            POINTER(s.DifField),
            POINTER(s.DifOptions),
            c_int32,
            c_int64,
            c_void_p,
            POINTER(s.DifSurfaceArrays),
        ],
    ),
    "dif_cell_curvature": (
        c_int32,
        [POINTER(s.DifField), POINTER(s.DifOptions), c_void_p, POINTER(c_int64)],
    ),
    "dif_grid_init": (c_int32, [POINTER(s.DifGrid), c_uint64, POINTER(c_int64)]),
    "dif_function_options_init": (c_int32, [POINTER(s.DifFunctionOptions), c_uint64]),
    "dif_function_report_init": (c_int32, [POINTER(s.DifFunctionReport), c_uint64]),
    "dif_fractions_from_function": (
        c_int32,
        [
            POINTER(s.DifGrid),
            s.DifFunction,
            c_void_p,
            POINTER(s.DifFunctionOptions),
            POINTER(s.DifFunctionReport),
            c_void_p,
        ],
    ),
    "dif_triangle_options_init": (c_int32, [POINTER(s.DifTriangleOptions), c_uint64]),
    "dif_triangle_report_init": (c_int32, [POINTER(s.DifTriangleReport), c_uint64]),
    "dif_fractions_from_mesh": (
        c_int32,
        [
            POINTER(s.DifGrid),
            c_void_p,
            POINTER(s.DifTriangleOptions),
            POINTER(s.DifTriangleReport),
            c_void_p,
        ],
    ),
    "dif_shape_options_init": (c_int32, [POINTER(s.DifShapeOptions), c_uint64]),
    "dif_shape_create": (c_int32, [POINTER(s.DifShapeOptions), POINTER(c_void_p)]),
    "dif_shape_free": (None, [c_void_p]),
    "dif_shape_bounds": (c_int32, [c_void_p, POINTER(c_double), POINTER(c_double)]),
    "dif_shape_volume": (c_int32, [c_void_p, POINTER(c_double)]),
    "dif_shape_distances": (c_int32, [c_void_p, c_int64, c_void_p, c_void_p]),
    "dif_fractions_from_shape": (
        c_int32,
        [
            POINTER(s.DifGrid),
            c_void_p,
            POINTER(s.DifFunctionOptions),
            POINTER(s.DifFunctionReport),
            c_void_p,
        ],
    ),
    "dif_fractions_from_values": (c_int32, [POINTER(s.DifField), c_double, c_double, c_void_p]),
    "dif_fractions_from_labels": (c_int32, [POINTER(s.DifField), c_int64, c_void_p, c_void_p]),
    "dif_value_extremes": (c_int32, [POINTER(s.DifField), POINTER(c_double), POINTER(c_double)]),
    "dif_mollify_options_init": (c_int32, [POINTER(s.DifMollifyOptions), c_uint64]),
    "dif_mollify": (c_int32, [POINTER(s.DifField), POINTER(s.DifMollifyOptions), c_void_p]),
    "dif_measure_init": (c_int32, [POINTER(s.DifMeasure), c_uint64]),
    "dif_mesh_measure": (c_int32, [c_void_p, POINTER(s.DifMeasure)]),
    "dif_distance_options_init": (c_int32, [POINTER(s.DifDistanceOptions), c_uint64]),
    "dif_distance_init": (c_int32, [POINTER(s.DifDistance), c_uint64]),
    "dif_distance_to_shape": (
        c_int32,
        [c_void_p, c_void_p, POINTER(s.DifDistanceOptions), POINTER(s.DifDistance)],
    ),
    "dif_distance_to_function": (
        c_int32,
        [c_void_p, s.DifFunction, c_void_p, POINTER(s.DifDistanceOptions), POINTER(s.DifDistance)],
    ),
    "dif_distance_to_mesh": (
        c_int32,
        [
            c_void_p,
            c_void_p,
            POINTER(s.DifDistanceOptions),
            POINTER(s.DifDistance),
            POINTER(s.DifDistance),
        ],
    ),
    "dif_curvature_options_init": (c_int32, [POINTER(s.DifCurvatureOptions), c_uint64]),
    "dif_mesh_curvature": (
        c_int32,
        [c_void_p, POINTER(s.DifCurvatureOptions), c_void_p, c_void_p, c_void_p, c_void_p],
    ),
    "dif_smoothing_options_init": (c_int32, [POINTER(s.DifSmoothingOptions), c_uint64]),
    "dif_mesh_smooth": (
        c_int32,
        [c_void_p, POINTER(s.DifGrid), POINTER(s.DifSmoothingOptions), POINTER(c_void_p)],
    ),
    "dif_mesh_write_options_init": (c_int32, [POINTER(s.DifMeshWriteOptions), c_uint64]),
    "dif_mesh_write_report_init": (c_int32, [POINTER(s.DifMeshWriteReport), c_uint64]),
    "dif_mesh_write": (
        c_int32,
        [c_void_p, c_char_p, POINTER(s.DifMeshWriteOptions), POINTER(s.DifMeshWriteReport)],
    ),
    "dif_mesh_read": (c_int32, [c_char_p, POINTER(c_void_p)]),
    "dif_mesh_warning": (c_int32, [c_void_p, c_int64, POINTER(c_char_p)]),
    "dif_mesh_read_options_init": (c_int32, [POINTER(s.DifMeshReadOptions), c_uint64]),
    "dif_mesh_read_with": (c_int32, [c_char_p, POINTER(s.DifMeshReadOptions), POINTER(c_void_p)]),
    "dif_raw_layout_init": (c_int32, [POINTER(s.DifRawLayout), c_uint64]),
    "dif_field_read": (c_int32, [c_char_p, POINTER(s.DifRawLayout), POINTER(c_void_p)]),
    "dif_field_read_options_init": (c_int32, [POINTER(s.DifFieldReadOptions), c_uint64]),
    "dif_field_read_with": (
        c_int32,
        [c_char_p, POINTER(s.DifRawLayout), POINTER(s.DifFieldReadOptions), POINTER(c_void_p)],
    ),
    "dif_field_file_warning": (c_int32, [c_void_p, c_int64, POINTER(c_char_p)]),
    "dif_field_file_type": (c_int32, [c_void_p, POINTER(c_int32)]),
    "dif_field_file_free": (None, [c_void_p]),
    "dif_field_file_field": (c_int32, [c_void_p, POINTER(s.DifField)]),
    "dif_field_write_options_init": (c_int32, [POINTER(s.DifFieldWriteOptions), c_uint64]),
    "dif_field_write": (c_int32, [POINTER(s.DifField), c_char_p, POINTER(s.DifFieldWriteOptions)]),
    "dif_block_init": (c_int32, [POINTER(s.DifBlock), c_uint64]),
    "dif_reconstruct_block": (
        c_int32,
        [
            POINTER(s.DifField),
            POINTER(s.DifBlock),
            POINTER(s.DifGrid),
            POINTER(s.DifOptions),
            POINTER(c_void_p),
        ],
    ),
    "dif_mesh_weld": (c_int32, [POINTER(c_void_p), c_int64, POINTER(s.DifGrid), POINTER(c_void_p)]),
}
