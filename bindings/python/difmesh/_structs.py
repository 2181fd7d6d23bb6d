"""The structs of difmesh.h, field by field in its order; see there for what they mean.

Written by scripts/generate_bindings.py from difmesh.h; do not edit, run that again.
"""

from __future__ import annotations

from ctypes import CFUNCTYPE, Structure, c_char_p, c_double, c_int32, c_int64, c_uint64, c_void_p

from ._sized import Sized

DifProgress = CFUNCTYPE(c_int32, c_void_p, c_double)
DifFunction = CFUNCTYPE(c_int32, c_void_p, c_int64, c_void_p, c_void_p)
DifGradient = CFUNCTYPE(c_int32, c_void_p, c_int64, c_void_p, c_void_p)


class DifField(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("data", c_void_p),
        ("dims", c_int64 * 3),
        ("strides", c_int64 * 3),
        ("origin", c_double * 3),
        ("spacing", c_double * 3),
        ("faces_x", c_void_p),
        ("faces_y", c_void_p),
        ("faces_z", c_void_p),
        ("type", c_int32),
        ("reserved", c_int32),
    ]


class DifOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("placement", c_int32),
        ("normals", c_int32),
        ("boundary", c_int32 * 6),
        ("vertex_normals", c_int32),
        ("edge_ids", c_int32),
        ("purity_tolerance", c_double),
        ("overshoot_bound", c_double),
        ("clearance", c_double),
        ("progress", DifProgress),
        ("progress_user", c_void_p),
        ("threads", c_int32),
        ("reserved", c_int32),
    ]


class DifReport(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("cells", c_int64),
        ("interfacial_cells", c_int64),
        ("clamped_cells", c_int64),
        ("largest_overshoot", c_double),
        ("fraction_volume", c_double),
        ("planes", c_int64),
        ("height_function_cells", c_int64),
        ("gradient_free_cells", c_int64),
        ("solved_edges", c_int64),
        ("newton_steps_mean", c_double),
        ("newton_steps_max", c_int64),
        ("non_monotone_edges", c_int64),
        ("enclosed_volume", c_double),
        ("seconds_classify", c_double),
        ("seconds_normals", c_double),
        ("seconds_count", c_double),
        ("seconds_vertices", c_double),
        ("seconds_triangles", c_double),
        ("seconds_total", c_double),
        ("closed", c_int32),
        ("reserved", c_int32),
        ("curved_cells", c_int64),
        ("curved_vertices", c_int64),
        ("moved_centres", c_int64),
    ]


class DifPlaneArrays(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("normal_x", c_void_p),
        ("normal_y", c_void_p),
        ("normal_z", c_void_p),
        ("offset", c_void_p),
        ("source", c_void_p),
        ("strides", c_int64 * 3),
    ]


class DifSurfaceArrays(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("source", c_void_p),
        ("axis", c_void_p),
        ("foot", c_void_p),
        ("normal", c_void_p),
        ("mean", c_void_p),
        ("gaussian", c_void_p),
        ("largest", c_void_p),
        ("smallest", c_void_p),
        ("residual", c_void_p),
        ("length", c_void_p),
        ("frame", c_void_p),
        ("coefficients", c_void_p),
    ]


class DifGrid(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("dims", c_int64 * 3),
        ("origin", c_double * 3),
        ("spacing", c_double * 3),
        ("faces_x", c_void_p),
        ("faces_y", c_void_p),
        ("faces_z", c_void_p),
    ]


class DifFunctionOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("tolerance", c_double),
        ("kink_tolerance", c_double),
        ("max_calls_per_cell", c_int64),
        ("gradient", DifGradient),
        ("gradient_user", c_void_p),
        ("progress", DifProgress),
        ("progress_user", c_void_p),
        ("threads", c_int32),
        ("reserved", c_int32),
    ]


class DifFunctionReport(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("interfacial_cells", c_int64),
        ("sampled_cells", c_int64),
        ("subdivided_cells", c_int64),
        ("unresolved_cells", c_int64),
        ("largest_error_estimate", c_double),
        ("function_calls", c_int64),
        ("lattice_calls", c_int64),
        ("gradient_calls", c_int64),
        ("fraction_volume", c_double),
        ("seconds", c_double),
    ]


class DifTriangleOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("tolerance", c_double),
        ("flip", c_int32),
        ("check_edges", c_int32),
        ("threads", c_int32),
        ("overlaps", c_int32),
        ("progress", DifProgress),
        ("progress_user", c_void_p),
    ]


class DifTriangleReport(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("pieces", c_int64),
        ("cells_touched", c_int64),
        ("lowest_raw", c_double),
        ("highest_raw", c_double),
        ("largest_gap", c_double),
        ("fraction_volume", c_double),
        ("mesh_volume", c_double),
        ("seconds", c_double),
        ("overlap_volume", c_double),
        ("overlap_cells", c_int64),
        ("largest_overlap", c_double),
        ("overlap_cell", c_int64 * 3),
        ("overlap_low", c_double * 3),
        ("overlap_high", c_double * 3),
        ("inverted_volume", c_double),
        ("inverted_cells", c_int64),
        ("undecided_volume", c_double),
        ("undecided_cells", c_int64),
        ("largest_undecided", c_double),
        ("undecided_cell", c_int64 * 3),
    ]


class DifShapeOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("centre", c_double * 3),
        ("rotation_degrees", c_double * 3),
        ("radius", c_double),
        ("tube_radius", c_double),
        ("semi_axes", c_double * 3),
        ("exponent", c_double),
        ("scale", c_double),
        ("dimples", c_int64),
        ("dimple_radius", c_double),
        ("dimple_depth", c_double),
        ("kind", c_int32),
        ("reserved", c_int32),
    ]


class DifMollifyOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("radius", c_double),
        ("progress", DifProgress),
        ("progress_user", c_void_p),
        ("boundary", c_int32 * 6),
        ("threads", c_int32),
        ("reserved", c_int32),
    ]


class DifMeasure(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("vertices", c_int64),
        ("edges", c_int64),
        ("triangles", c_int64),
        ("components", c_int64),
        ("isolated_vertices", c_int64),
        ("boundary_edges", c_int64),
        ("non_manifold_edges", c_int64),
        ("misoriented_edges", c_int64),
        ("non_manifold_vertices", c_int64),
        ("degenerate_triangles", c_int64),
        ("euler_number", c_int64),
        ("closed", c_int32),
        ("manifold", c_int32),
        ("area", c_double),
        ("volume", c_double),
        ("low", c_double * 3),
        ("high", c_double * 3),
        ("unbalanced_edges", c_int64),
        ("has_volume", c_int32),
        ("reserved", c_int32),
    ]


class DifDistanceOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("facet_spacing", c_double),
        ("with_sign", c_int32),
        ("threads", c_int32),
        ("progress", DifProgress),
        ("progress_user", c_void_p),
    ]


class DifStatistics(Structure):
    _fields_ = [
        ("points", c_int64),
        ("rms", c_double),
        ("mean", c_double),
        ("signed_mean", c_double),
        ("lowest", c_double),
        ("highest", c_double),
        ("maximum", c_double),
        ("maximum_index", c_int64),
        ("maximum_position", c_double * 3),
    ]


class DifDistance(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("vertices", DifStatistics),
        ("facets", DifStatistics),
        ("area", c_double),
        ("reach", c_double),
        ("has_sign", c_int32),
        ("reserved", c_int32),
    ]


class DifCurvatureOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("rings", c_int32),
        ("threads", c_int32),
        ("progress", DifProgress),
        ("progress_user", c_void_p),
    ]


class DifSmoothingOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("kind", c_int32),
        ("steps", c_int32),
        ("boundary", c_int32),
        ("threads", c_int32),
        ("factor", c_double),
        ("lambda", c_double),
        ("pass_band", c_double),
        ("time", c_double),
        ("residual", c_double),
        ("tolerance", c_double),
        ("clearance", c_double),
        ("progress", DifProgress),
        ("progress_user", c_void_p),
    ]


class DifMeshWriteOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("format", c_char_p),
        ("normals", c_int32),
        ("edge_ids", c_int32),
        ("scalars", c_int32),
        ("draco", c_int32),
        ("draco_method", c_int32),
        ("draco_speed", c_int32),
        ("position_bits", c_int32),
        ("normal_bits", c_int32),
        ("generic_bits", c_int32),
        ("color_map", c_int32),
        ("color_by", c_char_p),
        ("color_range", c_double * 2),
        ("cell_size", c_double),
        ("metres_per_unit", c_double),
        ("local_origin", c_double * 3),
        ("has_local_origin", c_int32),
        ("up", c_int32),
        ("most_vertices", c_int64),
        ("name", c_char_p),
    ]


class DifMeshWriteReport(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("bytes", c_int64),
        ("vertices", c_int64),
        ("triangles", c_int64),
        ("primitives", c_int64),
        ("position_error", c_double),
        ("local_origin", c_double * 3),
        ("collapsed_triangles", c_int64),
        ("warning", c_char_p),
        ("position_bits", c_int32),
        ("reserved", c_int32),
    ]


class DifMeshReadOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("outside_files", c_int32),
        ("reserved", c_int32),
    ]


class DifRawLayout(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("dims", c_int64 * 3),
        ("type", c_int32),
        ("big_endian", c_int32),
        ("offset", c_int64),
    ]


class DifFieldReadOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("origin", c_double * 3),
        ("spacing", c_double * 3),
        ("has_origin", c_int32),
        ("has_spacing", c_int32),
        ("empty_value", c_double),
        ("full_value", c_double),
        ("has_full_value", c_int32),
        ("outside_files", c_int32),
        ("label_count", c_int64),
        ("labels", c_void_p),
    ]


class DifFieldWriteOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("format", c_int32),
        ("type", c_int32),
        ("gzip", c_int32),
        ("gzip_level", c_int32),
    ]


class DifBlock(Sized):
    _fields_ = [
        ("struct_size", c_uint64),
        ("offset", c_int64 * 3),
        ("dims", c_int64 * 3),
        ("ghost_low", c_int64 * 3),
        ("ghost_high", c_int64 * 3),
    ]
