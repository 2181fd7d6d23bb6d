/* The header in every language and standard that it promises, compiled only. Values of constants and
 * places of fields are frozen: what fails to compile here would break programs that are already built. */
#include "difmesh/difmesh.h"
#include "difmesh/difmesh.h" /* twice */

#define FROZEN(constant, value) typedef char frozen_##constant[(constant) == (value) ? 1 : -1]
/* Structs may grow at their ends, beyond what 0.1 had. */
#define AT_LEAST(type, size)                                                             \
  typedef char size_of_##type[sizeof(type) >= (size) && sizeof(type) % 8 == 0 ? 1 : -1]; \
  typedef char start_of_##type[offsetof(type, struct_size) == 0 ? 1 : -1]

FROZEN(DIF_OK, 0);
FROZEN(DIF_ERROR_INVALID_ARGUMENT, 10);
FROZEN(DIF_ERROR_INVALID_GRID, 11);
FROZEN(DIF_ERROR_INVALID_VALUE, 12);
FROZEN(DIF_ERROR_STRUCT, 13);
FROZEN(DIF_ERROR_TOO_LARGE, 20);
FROZEN(DIF_ERROR_OUT_OF_MEMORY, 21);
FROZEN(DIF_ERROR_CANCELLED, 30);
FROZEN(DIF_ERROR_FILE_MISSING, 40);
FROZEN(DIF_ERROR_FILE_FORMAT, 41);
FROZEN(DIF_ERROR_FILE_WRITE, 42);
FROZEN(DIF_ERROR_UNSUPPORTED, 50);
FROZEN(DIF_ERROR_INTERNAL, 90);
FROZEN(DIF_PART_THREADS, 1);
FROZEN(DIF_PART_FILES, 2);
FROZEN(DIF_PART_DISTANCE, 3);
FROZEN(DIF_FLOAT32, 1);
FROZEN(DIF_FLOAT64, 2);
FROZEN(DIF_UINT8, 3);
FROZEN(DIF_UINT16, 4);
FROZEN(DIF_PLACEMENT_DEFAULT, 0);
FROZEN(DIF_PLACEMENT_MIDPOINT, 1);
FROZEN(DIF_PLACEMENT_LINEAR, 2);
FROZEN(DIF_PLACEMENT_MANSON, 3);
FROZEN(DIF_PLACEMENT_PLIC, 4);
FROZEN(DIF_NORMALS_DEFAULT, 0);
FROZEN(DIF_NORMALS_YOUNGS, 1);
FROZEN(DIF_NORMALS_MYC, 2);
FROZEN(DIF_NORMALS_HEIGHT_FUNCTION, 3);
FROZEN(DIF_SIDE_DEFAULT, 0);
FROZEN(DIF_SIDE_OPEN, 1);
FROZEN(DIF_SIDE_MIRROR, 2);
FROZEN(DIF_SIDE_PERIODIC, 3);
FROZEN(DIF_SIDE_EMPTY, 4);
FROZEN(DIF_SIDE_FULL, 5);
FROZEN(DIF_INT32, 11);
FROZEN(DIF_UINT32, 12);
FROZEN(DIF_INT64, 13);
FROZEN(DIF_SOURCE_NONE, 0);
FROZEN(DIF_SOURCE_YOUNGS, 1);
FROZEN(DIF_SOURCE_CENTRED_COLUMNS, 2);
FROZEN(DIF_SOURCE_HEIGHT_FUNCTION, 3);
FROZEN(DIF_SOURCE_LEAST_SQUARES, 4);
FROZEN(DIF_SHAPE_SPHERE, 1);
FROZEN(DIF_SHAPE_ELLIPSOID, 2);
FROZEN(DIF_SHAPE_TORUS, 3);
FROZEN(DIF_SHAPE_GENUS, 4);
FROZEN(DIF_SHAPE_SMOOTH_BOX, 5);
FROZEN(DIF_SHAPE_GOLF_BALL, 6);
FROZEN(DIF_MESH_FORMAT_BY_EXTENSION, 0);
FROZEN(DIF_MESH_FORMAT_PLY, 1);
FROZEN(DIF_MESH_FORMAT_OBJ, 2);
FROZEN(DIF_MESH_FORMAT_OFF, 3);
FROZEN(DIF_MESH_FORMAT_STL, 4);
FROZEN(DIF_MESH_FORMAT_GLB, 5);
FROZEN(DIF_MESH_FORMAT_GLTF, 6);
FROZEN(DIF_MESH_FORMAT_DRC, 7);
FROZEN(DIF_FIELD_FORMAT_BY_EXTENSION, 0);
FROZEN(DIF_FIELD_FORMAT_NPY, 1);
FROZEN(DIF_FIELD_FORMAT_NRRD, 2);

AT_LEAST(dif_field, 120);
AT_LEAST(dif_options, 96);
AT_LEAST(dif_report, 168);
AT_LEAST(dif_plane_arrays, 72);
AT_LEAST(dif_grid, 80);
AT_LEAST(dif_function_options, 72);
AT_LEAST(dif_function_report, 88);
AT_LEAST(dif_triangle_options, 48);
AT_LEAST(dif_triangle_report, 72);
AT_LEAST(dif_shape_options, 144);
AT_LEAST(dif_measure, 168);
AT_LEAST(dif_distance_options, 40);
typedef char size_of_dif_statistics[sizeof(dif_statistics) == 88 ? 1 : -1];
AT_LEAST(dif_distance, 208);
AT_LEAST(dif_mesh_write_options, 24);
AT_LEAST(dif_raw_layout, 48);
AT_LEAST(dif_field_write_options, 24);
AT_LEAST(dif_block, 104);
