#ifndef DIFMESH_DIFMESH_H
#define DIFMESH_DIFMESH_H
/*
 * difmesh.h: surfaces from volume fractions, for every language with a C interface.
 *
 * C99 and C++. Link with -ldifmesh. Reads top-down: 1 basics, 2 the main job, 3 more about meshes,
 * 4 planes and normals alone, 5 making fields, 6 measuring and smoothing, 7 files, 8 experimental.
 *
 *     double c[NZ][NY][NX];                              // volume fractions, x fastest
 *     int64_t dims[3] = {NX, NY, NZ};
 *     dif_field field;
 *     dif_mesh* mesh = NULL;
 *     if (dif_field_init(&field, sizeof field, c, DIF_FLOAT64, dims) != DIF_OK ||
 *         dif_reconstruct(&field, NULL, &mesh) != DIF_OK ||
 *         dif_mesh_write(mesh, "surface.ply", NULL, NULL) != DIF_OK) {
 *       fprintf(stderr, "%s\n", dif_last_message());
 *     }
 *     dif_mesh_free(mesh);
 *
 * What holds for all of it
 *
 * Stability. Functions, constants and struct fields that a release has shipped keep their names,
 *   values, places and meanings for as long as the library is called libdifmesh.so.0; only section
 *   8 is exempt. New fields are added at the ends of structs, new constants beside the old ones.
 * Status. Functions return DIF_OK (0) or an error. On an error, output parameters are untouched
 *   (handles set to NULL) unless said otherwise, and dif_last_message() tells what is wrong and
 *   where. No C++ exception leaves the library, and bad arguments never crash it, as far as can be
 *   seen: a pointer that is not NULL is taken to point to what it should.
 * Structs begin with their size, as the caller was compiled to see it, and are prepared by their
 *   _init function, which also fills in the defaults: dif_options_init(&options, sizeof options). A
 *   caller compiled against an older header has shorter structs: fields that it does not know take
 *   their defaults. One compiled against a newer header has longer ones: they are accepted as long
 *   as all bytes beyond the known ones are 0, and refused (DIF_ERROR_STRUCT) otherwise. Output
 *   structs are filled as far as they reach; bytes beyond become 0. Sizes are multiples of 8.
 *   Fields called `reserved` must be 0.
 * Options. NULL in place of an options struct means the defaults.
 * Pointers. `double* x` points to one number, `double x[]` to as many as the function's comment
 *   says. NULL is refused unless that comment or these lines say that `x` may be NULL.
 * Handles (dif_mesh and others) are opaque. Whoever gets one frees it, once, with its _free
 *   function, which takes NULL too.
 * Borrowed pointers, such as those of dif_mesh_positions(), belong to the handle and are valid
 *   until it is freed or changed.
 * Arrays are given with their number of elements where it does not follow from other arguments.
 *   Points are three doubles x, y, z; triangles three indices; cells three indices i, j, k (x, y,
 *   z). Arrays of 0 elements may be NULL.
 * Units. Lengths are in whatever unit `spacing` has. Fractions are shares of cells in [0, 1].
 * Strides count elements, not bytes, unless said otherwise.
 * Callbacks get the `user` pointer that was given with them first. They may call the library, but
 *   must not free what the running call uses.
 * Threads. The library has no global state that changes, but for two messages per thread. Different
 *   threads may call any functions at once, also with the same handles, as long as none of them
 *   changes or frees the handle. `threads` in options: at most so many, 0 for as many as the
 *   machine has; no result depends on it, to the last bit.
 * Floating point. The library computes with the default settings, whatever those of the caller:
 *   round to nearest, no traps, subnormal numbers as they are (programs compiled with -ffast-math
 *   take them for 0). So no result depends on them, and no trap that the caller has set, say by
 *   feenableexcept() or gfortran's -ffpe-trap, is sprung in here. On return, from errors too, the
 *   settings and raised flags are what they were. Callbacks find the settings of the caller, on
 *   whatever thread they run; what they change or raise on the calling thread stays.
 * Unloading. Once loaded, the library stays until the program ends: dlclose() leaves it where it
 *   is, for its threads may be asleep in it.
 * Cost, memory and sources of the methods are those of the C++ headers of the same names, and of
 *   docs/method.md; here is what differs.
 */

#include <stddef.h>
#include <stdint.h>

#if defined(DIF_STATIC)
#define DIF_API
#elif defined(_WIN32) && defined(DIF_BUILD)
#define DIF_API __declspec(dllexport)
#elif defined(_WIN32)
#define DIF_API __declspec(dllimport)
#elif defined(__GNUC__)
#define DIF_API __attribute__((visibility("default")))
#else
#define DIF_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ============================== 1. Basics ===================================================== */

/* Version of this header; dif_version() tells that of the library. */
#define DIF_VERSION_MAJOR 0
#define DIF_VERSION_MINOR 2
#define DIF_VERSION_PATCH 0

/* Status of a call. Values are frozen. */
typedef int32_t dif_status;
enum {
  DIF_OK = 0,
  DIF_ERROR_INVALID_ARGUMENT = 10, /* an argument or option is NULL, out of range or inconsistent */
  DIF_ERROR_INVALID_GRID = 11,     /* dims, origin or spacing unusable */
  DIF_ERROR_INVALID_VALUE = 12,    /* NaN, infinity or overshoot in a field; the cell is named */
  DIF_ERROR_STRUCT = 13,           /* a struct's size or its unknown tail; was _init called? */
  DIF_ERROR_TOO_LARGE = 20,        /* sizes overflow, or more than 2^32 - 1 indices needed */
  DIF_ERROR_OUT_OF_MEMORY = 21,
  DIF_ERROR_CANCELLED = 30,    /* a callback asked to stop */
  DIF_ERROR_FILE_MISSING = 40, /* an input file cannot be opened */
  DIF_ERROR_FILE_FORMAT = 41,  /* an input file is malformed, truncated or not supported */
  DIF_ERROR_FILE_WRITE = 42,   /* an output file cannot be written; nothing is left behind */
  DIF_ERROR_UNSUPPORTED = 50,  /* this build lacks the part; see dif_has() */
  DIF_ERROR_INTERNAL = 90      /* a defect of the library, or an exception of a callback */
};

/* The constant's name, "DIF_OK" and so on; "unknown status" for other values. Never NULL; static.
 * Since 0.2. */
DIF_API const char* dif_status_name(dif_status status);

/* What went wrong in the last call that failed on this thread: one English sentence in UTF-8 that
 * names the argument, cell or file, at most 1023 bytes; "" if none failed. Valid until the next
 * failing call on this thread. Never NULL. Since 0.2. */
DIF_API const char* dif_last_message(void);

/* Version of the library, 1000000 major + 1000 minor + patch. Since 0.2. */
DIF_API int32_t dif_version(void);

/* The same as text, "0.2.0". Static. Since 0.2. */
DIF_API const char* dif_version_text(void);

/* Parts that a build may lack; their functions then return DIF_ERROR_UNSUPPORTED. */
enum {
  DIF_PART_THREADS = 1,  /* oneTBB; without, everything runs on the calling thread */
  DIF_PART_FILES = 2,    /* section 7 */
  DIF_PART_DISTANCE = 3, /* dif_distance_...() of section 6 */
  DIF_PART_GLTF = 4,     /* the formats .glb and .gltf */
  DIF_PART_DRACO = 5     /* the format .drc, and compressed glTF */
};

/* 1 if this build has the part, 0 if not or if there is no such part. Since 0.2. */
DIF_API int32_t dif_has(int32_t part);

/* Called now and then during long work, always on the thread that called the library, with the
 * share done in [0, 1], never decreasing. Return 0 to go on; anything else cancels: the call
 * returns DIF_ERROR_CANCELLED and gives nothing. */
typedef int32_t (*dif_progress)(void* user, double share_done);

/* ============================== 2. The main job =============================================== */

/* Element types of fields. Integers stand for value / (largest value), so in [0, 1]. */
enum { DIF_FLOAT32 = 1, DIF_FLOAT64 = 2, DIF_UINT8 = 3, DIF_UINT16 = 4 };

/* A field of volume fractions in memory that the caller owns, and where it lies in space. The
 * fraction of cell (i, j, k) is the element at data + i strides[0] + j strides[1] + k strides[2].
 * Ghost layers are cut off by pointing `data` at the first cell inside and keeping the strides. */
typedef struct dif_field {
  uint64_t struct_size;
  const void* data;   /* element of cell (0, 0, 0), aligned for its type */
  int64_t dims[3];    /* cells in x, y, z; >= 1 each */
  int64_t strides[3]; /* elements from a cell to the next one in x, y, z; may be 0 or negative */
  double origin[3];   /* low corner of cell (0, 0, 0) */
  double spacing[3];  /* edges of a cell, in [2^-300, 2^300] */
  /* Stretched axes: dims + 1 strictly increasing faces of cells in place of origin and spacing
   * along the axis, read during calls; NULL, the default: the axis is uniform. */
  const double* faces_x;
  const double* faces_y;
  const double* faces_z;
  int32_t type;     /* DIF_FLOAT64, ...; of values, see section 5, also DIF_INT8, ... */
  int32_t reserved; /* 0 */
} dif_field;

/* Describes `dims[0]` x `dims[1]` x `dims[2]` cells that lie without gaps, x fastest, as in a C
 * array [nz][ny][nx] or a Fortran array (nx, ny, nz); origin 0, spacing 1. Set other strides,
 * origin and spacing afterwards. Nothing of `data` is read here.
 * Errors: INVALID_ARGUMENT, INVALID_GRID (a dim < 1), TOO_LARGE, STRUCT. Since 0.2. */
DIF_API dif_status dif_field_init(dif_field* field, uint64_t struct_size, const void* data,
                                  int32_t type, const int64_t dims[3]);

/* Where a vertex is put on the edge between two cell centres. */
enum {
  DIF_PLACEMENT_DEFAULT = 0, /* PLIC */
  DIF_PLACEMENT_MIDPOINT = 1,
  DIF_PLACEMENT_LINEAR = 2, /* what plain marching cubes does */
  DIF_PLACEMENT_MANSON = 3, /* Manson, Smith, Schaefer, Eurographics 2011 */
  DIF_PLACEMENT_PLIC = 4,   /* Evrard, Denner, van Wachem, IEEE TVCG 2019: second-order accurate */
  DIF_PLACEMENT_CURVED = 5  /* curved surfaces of cells, or PLIC where they have none: of fourth
                               order and more where surfaces are smooth; see docs/method.md */
};

/* How the normal of an interfacial cell is estimated. */
enum {
  DIF_NORMALS_DEFAULT = 0,         /* HEIGHT_FUNCTION */
  DIF_NORMALS_YOUNGS = 1,          /* weighted gradient */
  DIF_NORMALS_MYC = 2,             /* mixed Youngs-centred, Aulisa et al., J. Comput. Phys. 2007 */
  DIF_NORMALS_HEIGHT_FUNCTION = 3, /* columns of heights where consistent, MYC elsewhere */
  DIF_NORMALS_ELVIRA = 4,          /* of 27 planes the one that suits the neighbours best */
  DIF_NORMALS_LVIRA = 5 /* the plane that suits the neighbours best; Pilliod & Puckett 2004 */
};

/* What lies beyond a side of the domain. */
enum {
  DIF_SIDE_DEFAULT = 0,  /* OPEN */
  DIF_SIDE_OPEN = 1,     /* nothing is known; the surface runs on to the domain face */
  DIF_SIDE_MIRROR = 2,   /* a symmetry plane */
  DIF_SIDE_PERIODIC = 3, /* wraps round, both sides of an axis together; spans one period */
  DIF_SIDE_EMPTY = 4,    /* fraction 0: closes the surface */
  DIF_SIDE_FULL = 5      /* fraction 1: closes the surface of the complement */
};

typedef struct dif_options {
  uint64_t struct_size;
  int32_t placement;       /* DIF_PLACEMENT_... */
  int32_t normals;         /* DIF_NORMALS_... */
  int32_t boundary[6];     /* DIF_SIDE_...: x low, x high, y low, y high, z low, z high */
  int32_t vertex_normals;  /* 1: the mesh gets unit normals at its vertices; default 0 */
  int32_t edge_ids;        /* 1: the mesh gets the names of its vertices' edges; default 0 */
  double purity_tolerance; /* fraction <= this is empty, >= 1 - this full; [0, 0.1]; 1e-6 */
  double overshoot_bound;  /* fractions so far outside [0, 1] are clamped; [0, 1]; 0.1 */
  double clearance;      /* of vertices from the edges' ends, over the edge; [1e-13, 0.25]; 1e-12 */
  dif_progress progress; /* may be NULL */
  void* progress_user;
  int32_t threads;  /* 0: as many as the machine has */
  int32_t reserved; /* 0 */
} dif_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_options_init(dif_options* options, uint64_t struct_size);

/* A triangle mesh. Triangles are counter-clockwise seen from the empty side. */
typedef struct dif_mesh dif_mesh;

/* Reconstructs the surface of a field: marching cubes on the grid of cell centres at 1/2 (CURVED
 * may put a centre with a fraction of 0.3 to 0.7 on the other side: moved_centres), with the
 * vertices where `placement` puts them. The mesh is manifold and free of self-intersections for
 * every field. It ends only on `open` and `mirror` sides, at the ends of the period of `periodic`
 * axes, which are the first cell centre and its image, and along edges of the domain where an
 * `empty` side meets a `full` one. An empty field gives an empty mesh. Where DIF_UINT8 or
 * DIF_UINT16 hardly hold shares of 255 or 65535, dif_mesh_warning() says so and names the highest
 * value: in masks and segmentations no cell is full, and none is half full or there are at most 16
 * different values. OUT_OF_MEMORY comes before the pass over the field where that is known already.
 * Errors: INVALID_ARGUMENT, INVALID_GRID, INVALID_VALUE, STRUCT, TOO_LARGE, OUT_OF_MEMORY,
 * CANCELLED. Cost: one pass over the field, then O(interfacial cells). Since 0.2. */
DIF_API dif_status dif_reconstruct(const dif_field* field, const dif_options* options,
                                   dif_mesh** mesh);

/* Frees a mesh; NULL is fine. Since 0.2. */
DIF_API void dif_mesh_free(dif_mesh* mesh);

/* Borrowed: three coordinates per vertex. NULL and 0 for a mesh without vertices. Errors:
 * INVALID_ARGUMENT, also for the following. Since 0.2. */
DIF_API dif_status dif_mesh_positions(const dif_mesh* mesh, const double** positions,
                                      int64_t* vertices);
/* Borrowed: three indices of vertices per triangle, from 0. Since 0.2. */
DIF_API dif_status dif_mesh_triangles(const dif_mesh* mesh, const uint32_t** indices,
                                      int64_t* triangles);
/* Borrowed: a unit vector per vertex, out of the material; NULL and 0 if the mesh has none. Since
 * 0.1. */
DIF_API dif_status dif_mesh_normals(const dif_mesh* mesh, const double** normals,
                                    int64_t* vertices);
/* Borrowed: per vertex the name of the edge that it lies on, ascending; NULL and 0 if the mesh has
 * none. id = 3 (((k+1)(ny+2) + (j+1))(nx+2) + (i+1)) + axis, (i, j, k) being the cell at the edge's
 * lower end. Since 0.2. */
DIF_API dif_status dif_mesh_edge_ids(const dif_mesh* mesh, const uint64_t** ids, int64_t* vertices);

/* Facts about a reconstruction. */
typedef struct dif_report {
  uint64_t struct_size;
  int64_t cells;                 /* read */
  int64_t interfacial_cells;     /* tolerance < fraction < 1 - tolerance */
  int64_t clamped_cells;         /* fraction < 0 or > 1 */
  double largest_overshoot;      /* largest distance of a fraction from [0, 1] */
  double fraction_volume;        /* sum of fraction x cell volume, clamped */
  int64_t planes;                /* cells that were given a normal and a plane */
  int64_t height_function_cells; /* of these, with a normal from heights */
  int64_t gradient_free_cells;   /* of these, without gradient: edge directions were used */
  int64_t solved_edges;          /* vertices placed by the half-full window */
  double newton_steps_mean;      /* per solved edge */
  int64_t newton_steps_max;
  int64_t non_monotone_edges; /* solved edges along which the window's fraction falls */
  double enclosed_volume;     /* signed; 0 where not closed */
  double seconds_classify;    /* wall time: the pass over the field */
  double seconds_normals;     /* normals and planes */
  double seconds_count;       /* counting and allocation of the output */
  double seconds_vertices;
  double seconds_triangles;
  double seconds_total;
  int32_t closed; /* 1: no boundary edge; an empty mesh is closed */
  int32_t reserved;
  int64_t curved_cells;    /* CURVED: cells that own a curved surface */
  int64_t curved_vertices; /* vertices that such surfaces placed */
  int64_t moved_centres;   /* cells whose centre they put on another side than fraction >= 1/2 */
} dif_report;

/* Prepares an output struct. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_report_init(dif_report* report, uint64_t struct_size);
/* Errors: INVALID_ARGUMENT (also for a mesh that no reconstruction made), STRUCT. Since 0.2. */
DIF_API dif_status dif_mesh_report(const dif_mesh* mesh, dif_report* report);

/* ============================== 3. More about meshes ========================================== */

/* A mesh from arrays, which are copied. Coordinates are not looked at.
 * Errors: INVALID_ARGUMENT (an index out of range is named), TOO_LARGE, OUT_OF_MEMORY. Since 0.2.
 * */
DIF_API dif_status dif_mesh_from_arrays(const double positions[], int64_t vertices,
                                        const uint32_t indices[], int64_t triangles,
                                        dif_mesh** mesh);

/* Gives a mesh normals, three numbers per vertex, or names of edges; they are copied. `normals` and
 * `ids` may be NULL, which removes what there is.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. Since 0.2. */
DIF_API dif_status dif_mesh_set_normals(dif_mesh* mesh, const double normals[]);
DIF_API dif_status dif_mesh_set_edge_ids(dif_mesh* mesh, const uint64_t ids[]);

/* Scalars: numbers of your own that go with the vertices, under a name of letters, digits and
 * underscores. Those of a file come with dif_mesh_read(); PLY, glTF and Draco files take them. */

/* Gives a mesh scalars, one number per vertex, copied, in place of those of the same name.
 * `values` may be NULL, which removes these. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. Since 0.2. */
DIF_API dif_status dif_mesh_set_scalars(dif_mesh* mesh, const char* name, const double values[]);
/* Borrowed: the name of the scalars number `index`, from 0; NULL from their count on. Errors:
 * INVALID_ARGUMENT. Since 0.2. */
DIF_API dif_status dif_mesh_scalars_name(const dif_mesh* mesh, int64_t index, const char** name);
/* Borrowed: the scalars of a name; NULL and 0 if the mesh has none of it. Errors: INVALID_ARGUMENT.
 * Since 0.2. */
DIF_API dif_status dif_mesh_scalars(const dif_mesh* mesh, const char* name, const double** values,
                                    int64_t* vertices);

/* Element types of index arrays. */
enum { DIF_INT32 = 11, DIF_UINT32 = 12, DIF_INT64 = 13 };

/* Copies positions or normals into the caller's array: the numbers of vertex v go to elements
 * v stride, v stride + 1, v stride + 2 of `out`, which has room for `capacity` elements. `type` is
 * DIF_FLOAT32 (rounded to nearest) or DIF_FLOAT64.
 * Errors: INVALID_ARGUMENT (a stride < 3, too little room, or no normals). Since 0.2. */
DIF_API dif_status dif_mesh_copy_positions(const dif_mesh* mesh, int32_t type, int64_t stride,
                                           int64_t capacity, void* out);
DIF_API dif_status dif_mesh_copy_normals(const dif_mesh* mesh, int32_t type, int64_t stride,
                                         int64_t capacity, void* out);

/* Copies triangles likewise. `type` is DIF_INT32, DIF_UINT32 or DIF_INT64; `first_vertex` is what
 * the first vertex is called: 0, or 1 in Fortran.
 * Errors: as above, and TOO_LARGE if an index does not fit. Since 0.2. */
DIF_API dif_status dif_mesh_copy_triangles(const dif_mesh* mesh, int32_t type, int64_t first_vertex,
                                           int64_t stride, int64_t capacity, void* out);

/* ============================== 4. Planes and normals alone =================================== */

/* A plane {x : normal . (x - centre) = offset} in a cell; material is where it is <= offset. The
 * normal need not have unit length; the offset then is in units of its length. */

/* Shares of `count` cells of one spacing below their planes. normals: 3 count numbers.
 * Errors: INVALID_ARGUMENT (a normal that is 0 or not finite, an offset that is not; its index is
 * named), INVALID_GRID (spacing). On an error, fractions of planes before the bad one are written.
 * Cost: some 10 ns each. Since 0.2. */
DIF_API dif_status dif_plane_fraction(const double spacing[3], int64_t count,
                                      const double normals[], const double offsets[],
                                      double fractions[]);
/* The inverse, exact to 1e-14 in the fraction: offsets of planes below which `fractions` of the
 * cells lie, clamped to [0, 1]. Errors: likewise. Cost: up to 100 ns each. Since 0.2. */
DIF_API dif_status dif_plane_offset(const double spacing[3], int64_t count, const double normals[],
                                    const double fractions[], double offsets[]);

/* Where a normal came from. */
enum {
  DIF_SOURCE_NONE = 0, /* no gradient; the normal is 0 */
  DIF_SOURCE_YOUNGS = 1,
  DIF_SOURCE_CENTRED_COLUMNS = 2, /* of MYC */
  DIF_SOURCE_HEIGHT_FUNCTION = 3,
  DIF_SOURCE_LEAST_SQUARES = 4 /* ELVIRA, LVIRA, and where an open side cuts stencils short */
};

/* Unit normals, out of the material, and offsets of the planes of `count` cells, by
 * options->normals, sides and purity_tolerance. cells: 3 count indices, in [0, dims). normals: 3
 * count numbers; offsets, sources: count. `normals`, `offsets` and `sources` may be NULL. The field
 * is read only near these cells; NaN there count as some fraction.
 * Errors: as dif_reconstruct(). Cost: 0.05 to 0.4 microseconds per cell, 7 to 9 by ELVIRA,
 * 1 to 2 by LVIRA. Since 0.2. */
DIF_API dif_status dif_cell_planes(const dif_field* field, const dif_options* options,
                                   int64_t count, const int64_t cells[], double normals[],
                                   double offsets[], int32_t sources[]);

/* Arrays of a flow solver, one element per cell: that of cell (i, j, k) is at i strides[0] +
 * j strides[1] + k strides[2] from the pointer. Pointers may be NULL where a result is not wanted.
 * */
typedef struct dif_plane_arrays {
  uint64_t struct_size;
  double* normal_x; /* element of cell (0, 0, 0) */
  double* normal_y;
  double* normal_z;
  double* offset;
  int32_t* source;    /* DIF_SOURCE_... */
  int64_t strides[3]; /* elements, the same for all arrays */
} dif_plane_arrays;

/* Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_plane_arrays_init(dif_plane_arrays* arrays, uint64_t struct_size);

/* The planes of all interfacial cells of a field, into arrays of the caller; other cells get 0. The
 * whole field is checked, as dif_reconstruct() does. On an error the arrays are untouched, or on
 * CANCELLED and OUT_OF_MEMORY written in part.
 * Errors: as dif_reconstruct(). Cost: one pass over field and arrays, and as above. Since 0.2. */
DIF_API dif_status dif_field_planes(const dif_field* field, const dif_options* options,
                                    const dif_plane_arrays* arrays);

/* The interfacial cells of a field, purity_tolerance < fraction < 1 - purity_tolerance, in the
 * order z, y, x. `count` gets their number; `cells`, three indices each, as many of them as there
 * is room for, `capacity`. `cells` may be NULL, with a capacity of 0, to ask for the number. The
 * whole field is checked, as dif_reconstruct() does.
 * Errors: as dif_reconstruct(), and INVALID_ARGUMENT where there is too little room; `count` and
 * what fits are there then, too. Cost: two passes over the field. Since 0.2. */
DIF_API dif_status dif_interfacial_cells(const dif_field* field, const dif_options* options,
                                         int64_t capacity, int64_t cells[], int64_t* count);

/* What the surface of a cell is made of. */
enum {
  DIF_SURFACE_NONE = 0,          /* the fractions around determine no smooth surface */
  DIF_SURFACE_HEIGHTS_13 = 1,    /* heights of 13 columns: a quartic along both axes across them */
  DIF_SURFACE_HEIGHTS_25 = 2,    /* heights of 25 columns: a biquartic */
  DIF_SURFACE_QUADRATIC_FIT = 3, /* a paraboloid fitted to the fractions within 2.1 cells */
  DIF_SURFACE_QUARTIC_FIT = 4    /* a quartic fitted to those within 3.2 cells */
};

/* What surfaces are for, which decides on what they are made of. */
enum {
  DIF_SURFACES_FOR_POSITION = 0, /* 13 columns, else a paraboloid: the least error of position */
  /* 25 columns, else a quartic, else 13 columns, else a paraboloid: the least error of curvature */
  DIF_SURFACES_FOR_CURVATURE = 1
};

/* Curved surfaces of cells, one after the other in arrays of the caller; NULL where a result is not
 * wanted. A surface is the graph zeta = q(xi, eta) over a plane through the cell's centre; the
 * material is below it. Curvatures are in 1 / unit of the spacing, the Gaussian in its square, and
 * positive where the material is convex: a drop of radius R has mean curvature 1/R. Without a
 * source all is 0 but for axis (-1), length, and curvatures and residual, which are NaN; the
 * residual not where a surface was tried to the end. */
typedef struct dif_surface_arrays {
  uint64_t struct_size;
  int32_t* source;  /* DIF_SURFACE_... */
  int32_t* axis;    /* heights: 0 to 2, the axis that columns run along, the lowest of those that
                         * have the same right; -1 else */
  double* foot;     /* 3 per cell, from its centre: point of the surface next to the centre */
  double* normal;   /* 3 per cell, there: unit vector out of the material */
  double* mean;     /* there: half the sum of the principal curvatures */
  double* gaussian; /* their product */
  double* largest;  /* the larger of them */
  double* smallest; /* the smaller */
  double* residual; /* by how much fractions differ from what the surface says, at most 0.03 */
  double* length;   /* cube root of the cell's volume */
  double* frame;    /* 9 per cell: unit vectors along xi, eta and zeta, orthogonal */
  double* coefficients; /* 25 per cell: zeta / length is the sum of coefficients[5 p + q]
                         * (xi / length)^p (eta / length)^q, p and q from 0 to 4 */
} dif_surface_arrays;

/* Without arrays. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_surface_arrays_init(dif_surface_arrays* arrays, uint64_t struct_size);

/* Curved surfaces of `count` cells, by heights and fits, sides and purity_tolerance; cells that are
 * as good as pure have none. kind: DIF_SURFACES_FOR_...; cells: 3 count indices, in [0, dims). The
 * field is read only near these cells; NaN count as 0. On an error the arrays are untouched, or on
 * CANCELLED and OUT_OF_MEMORY written in part.
 * Errors: as dif_reconstruct(). Cost: 3 to 6 microseconds per cell from heights, 50 to 200 from
 * fits. Since 0.2. */
DIF_API dif_status dif_cell_surfaces(const dif_field* field, const dif_options* options,
                                     int32_t kind, int64_t count, const int64_t cells[],
                                     const dif_surface_arrays* arrays);

/* Mean curvature of all interfacial cells of a field, by surfaces of DIF_SURFACES_FOR_CURVATURE,
 * into an array of the caller: that of cell (i, j, k) goes to mean[i strides[0] + j strides[1] +
 * k strides[2]]. Interfacial cells without a surface get NaN, other cells 0. `strides` may be NULL:
 * x fastest, without gaps. The whole field is checked, as dif_reconstruct() does. On an error the
 * array is untouched, or on CANCELLED and OUT_OF_MEMORY written in part.
 * Errors: as dif_reconstruct(). Cost: two passes over the field, one over the array, and as above.
 * Since 0.2. */
DIF_API dif_status dif_cell_curvature(const dif_field* field, const dif_options* options,
                                      double mean[], const int64_t strides[3]);

/* ============================== 5. Making fields ============================================== */

/* A grid without data. */
typedef struct dif_grid {
  uint64_t struct_size;
  int64_t dims[3];   /* cells in x, y, z; >= 1 each */
  double origin[3];  /* low corner of cell (0, 0, 0) */
  double spacing[3]; /* edges of a cell, in [2^-300, 2^300] */
  /* Stretched axes: dims + 1 strictly increasing faces of cells in place of origin and spacing
   * along the axis, read during calls; NULL, the default: the axis is uniform. */
  const double* faces_x;
  const double* faces_y;
  const double* faces_z;
} dif_grid;

/* Origin 0, spacing 1, which can be set afterwards. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_grid_init(dif_grid* grid, uint64_t struct_size, const int64_t dims[3]);

/* Writes f(points[i]) to values[i], i < count, f < 0 inside. Called from several threads at once
 * unless `threads` is 1. Returns 0 to go on; anything else cancels. */
typedef int32_t (*dif_function)(void* user, int64_t count, const double points[], double values[]);
/* Writes the gradients of f, three numbers each, likewise. */
typedef int32_t (*dif_gradient)(void* user, int64_t count, const double points[],
                                double gradients[]);

typedef struct dif_function_options {
  uint64_t struct_size;
  double tolerance;           /* aimed at in each cell's fraction; [1e-13, 1e-2]; 1e-10 */
  double kink_tolerance;      /* the same where f has a kink; [1e-13, 1e-2]; 1e-5 */
  int64_t max_calls_per_cell; /* [1000, 1e9]; 200000 */
  dif_gradient gradient;      /* may be NULL; makes cells in which f wiggles safer */
  void* gradient_user;
  dif_progress progress;
  void* progress_user;
  int32_t threads;
  int32_t reserved;
} dif_function_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_function_options_init(dif_function_options* options, uint64_t struct_size);

typedef struct dif_function_report {
  uint64_t struct_size;
  int64_t interfacial_cells; /* 0 < fraction < 1 */
  int64_t sampled_cells;     /* looked at beyond their corners */
  int64_t subdivided_cells;  /* of these, bisected */
  int64_t unresolved_cells;  /* of these, out of calls before the tolerances were met */
  double largest_error_estimate;
  int64_t function_calls; /* points at which f was evaluated */
  int64_t lattice_calls;  /* of these, corners of the grid's cells */
  int64_t gradient_calls;
  double fraction_volume;
  double seconds;
} dif_function_report;

/* Prepares an output struct. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_function_report_init(dif_function_report* report, uint64_t struct_size);

/* Volume fractions of {f < 0}, by quadrature; see fractions_from_function.hpp for what is assumed
 * of f. `fractions` has one element per cell of the grid, x fastest. `report` may be NULL.
 * Errors: INVALID_ARGUMENT, INVALID_GRID, INVALID_VALUE (f is NaN or infinite; the point is named),
 * STRUCT, TOO_LARGE, OUT_OF_MEMORY, CANCELLED. Since 0.2. */
DIF_API dif_status dif_fractions_from_function(const dif_grid* grid, dif_function f, void* user,
                                               const dif_function_options* options,
                                               dif_function_report* report, double fractions[]);

/* What to do where parts of a mesh overlap: where its winding number, which counts how often a
 * point is inside, exceeds 1. */
enum {
  DIF_OVERLAPS_DEFAULT = 0, /* UNION */
  DIF_OVERLAPS_UNION = 1,   /* the share of a cell where the winding number is 1 or more */
  DIF_OVERLAPS_REFUSE = 2,  /* INVALID_ARGUMENT, also where it is undecided; a cell is named */
  DIF_OVERLAPS_COUNT = 3    /* the winding number's mean in a cell: may exceed 1 or be negative */
};

typedef struct dif_triangle_options {
  uint64_t struct_size;
  double tolerance;    /* by which a column may miss an integer, and of a cell that may be covered
                        * twice with REFUSE; [1e-12, 0.25]; 1e-9 */
  int32_t flip;        /* 1: triangles are clockwise seen from outside; default 0 */
  int32_t check_edges; /* 1, the default: every edge must have its opposite */
  int32_t threads;
  int32_t overlaps; /* DIF_OVERLAPS_... */
  dif_progress progress;
  void* progress_user;
} dif_triangle_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_triangle_options_init(dif_triangle_options* options, uint64_t struct_size);

typedef struct dif_triangle_report {
  uint64_t struct_size;
  int64_t pieces;         /* parts of triangles inside cells */
  int64_t cells_touched;  /* all others are exactly 0 or 1 */
  double lowest_raw;      /* least mean winding number of a cell */
  double highest_raw;     /* greatest */
  double largest_gap;     /* of a column's sum from an integer */
  double fraction_volume; /* in the grid */
  double mesh_volume;     /* in the grid or not */
  double seconds;
  double overlap_volume;   /* covered more than once, in the grid; thrice counts twice */
  int64_t overlap_cells;   /* that have some, by more than rounding */
  double largest_overlap;  /* as a share of a cell */
  int64_t overlap_cell[3]; /* the first with the largest */
  double overlap_low[3];   /* corners of the box round these cells */
  double overlap_high[3];
  double inverted_volume; /* of pockets that are inside out, which are outside */
  int64_t inverted_cells;
  double undecided_volume; /* where it was not found out how often it is covered: a bound for the
                              * error of fraction_volume and overlap_volume; usually 0 */
  int64_t undecided_cells;
  double largest_undecided;  /* as a share of a cell: a bound for the error of each fraction */
  int64_t undecided_cell[3]; /* the first with the largest */
} dif_triangle_report;

/* Prepares an output struct. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_triangle_report_init(dif_triangle_report* report, uint64_t struct_size);

/* Exact volume fractions of the inside of a closed mesh. `fractions` has one element per cell of
 * the grid, x fastest. `report` may be NULL.
 * Errors: INVALID_ARGUMENT (also an open mesh, mixed orientation, a mesh or part inside out; edge,
 * triangles, column or cell are named), INVALID_GRID, STRUCT, TOO_LARGE, OUT_OF_MEMORY, CANCELLED.
 * Since 0.2. */
DIF_API dif_status dif_fractions_from_mesh(const dif_grid* grid, const dif_mesh* mesh,
                                           const dif_triangle_options* options,
                                           dif_triangle_report* report, double fractions[]);

/* Built-in shapes; see shapes.hpp for their formulas. */
enum {
  DIF_SHAPE_SPHERE = 1,
  DIF_SHAPE_ELLIPSOID = 2,
  DIF_SHAPE_TORUS = 3,
  DIF_SHAPE_GENUS = 4,
  DIF_SHAPE_SMOOTH_BOX = 5,
  DIF_SHAPE_GOLF_BALL = 6
};

typedef struct dif_shape_options {
  uint64_t struct_size;
  double centre[3];
  double rotation_degrees[3]; /* about the fixed axes x, then y, then z */
  double radius;              /* sphere, torus, golf ball; 1 */
  double tube_radius;         /* torus; 0.4 */
  double semi_axes[3];        /* ellipsoid, smooth box; 1, 0.8, 0.6 */
  double exponent;            /* smooth box; [2, 64]; 8 */
  double scale;               /* genus; 1 */
  int64_t dimples;            /* golf ball; [1, 5000]; 333 */
  double dimple_radius;       /* golf ball, over radius; 0.08 */
  double dimple_depth;        /* golf ball, over radius; 0.012 */
  int32_t kind;               /* DIF_SHAPE_...; SPHERE */
  int32_t reserved;           /* 0 */
} dif_shape_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_shape_options_init(dif_shape_options* options, uint64_t struct_size);

/* A shape that cannot be changed. */
typedef struct dif_shape dif_shape;

/* Errors: INVALID_ARGUMENT naming the option, STRUCT, OUT_OF_MEMORY. Since 0.2. */
DIF_API dif_status dif_shape_create(const dif_shape_options* options, dif_shape** shape);
/* Frees a shape; NULL is fine. Since 0.2. */
DIF_API void dif_shape_free(dif_shape* shape);
/* A box that encloses the shape: low and high are three numbers each. Since 0.2. */
DIF_API dif_status dif_shape_bounds(const dif_shape* shape, double low[3], double high[3]);
/* Volume inside, in closed form or to 1e-14. Since 0.2. */
DIF_API dif_status dif_shape_volume(const dif_shape* shape, double* volume);
/* Signed distances of points to the surface, < 0 inside. Errors: INVALID_ARGUMENT. Since 0.2. */
DIF_API dif_status dif_shape_distances(const dif_shape* shape, int64_t count, const double points[],
                                       double distances[]);
/* As dif_fractions_from_function(), of a shape. options->gradient must be NULL; `report` may be
 * NULL. Since 0.2. */
DIF_API dif_status dif_fractions_from_shape(const dif_grid* grid, const dif_shape* shape,
                                            const dif_function_options* options,
                                            dif_function_report* report, double fractions[]);

/* Values of scanners and segmentations, which become fractions here. They are described by a
 * dif_field whose type may also be DIF_INT8, DIF_INT16, DIF_INT32, DIF_UINT32, DIF_INT64 or
 * DIF_UINT64; its origin and spacing are not looked at. What comes out has one element per cell, x
 * fastest. */
enum { DIF_INT8 = 14, DIF_INT16 = 15, DIF_UINT64 = 16 };

/* (value - empty) / (full - empty), values beyond counting as 0 or 1; `full` may be the smaller
 * one. NaN stays NaN. Errors: INVALID_ARGUMENT (the two are equal or not finite), INVALID_GRID,
 * STRUCT. Since 0.2. */
DIF_API dif_status dif_fractions_from_values(const dif_field* values, double empty, double full,
                                             double fractions[]);
/* 255, that is 1, where a value is one of the labels, else 0. Exact for integers of all sizes.
 * Errors: INVALID_ARGUMENT (also for no labels), INVALID_GRID, STRUCT, OUT_OF_MEMORY. Since 0.2. */
DIF_API dif_status dif_fractions_from_labels(const dif_field* values, int64_t count,
                                             const int64_t labels[], uint8_t fractions[]);
/* The lowest and the highest value; NaN takes no part, and both are NaN where there is nothing
 * else. Errors: INVALID_ARGUMENT, INVALID_GRID, STRUCT. Since 0.2. */
DIF_API dif_status dif_value_extremes(const dif_field* values, double* lowest, double* highest);

typedef struct dif_mollify_options {
  uint64_t struct_size;
  double radius; /* where the kernel ends, in cells; [1, 8]; 2 */
  dif_progress progress;
  void* progress_user;
  int32_t boundary[6]; /* DIF_SIDE_..., as in dif_options; OPEN counts as MIRROR here */
  int32_t threads;
  int32_t reserved; /* 0 */
} dif_mollify_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_mollify_options_init(dif_mollify_options* options, uint64_t struct_size);

/* Convolution of a field with a compact kernel that keeps the sum, unless sides are EMPTY or FULL.
 * `values` has one element per cell, x fastest. Origin and spacing are not looked at;
 * stretched axes are refused, where the sum is not the volume.
 * Errors: INVALID_ARGUMENT, INVALID_GRID, INVALID_VALUE (the cell that is NaN or infinite is
 * named), STRUCT, TOO_LARGE, OUT_OF_MEMORY, CANCELLED. Since 0.2. */
DIF_API dif_status dif_mollify(const dif_field* field, const dif_mollify_options* options,
                               double values[]);

/* ============================== 6. Measuring and smoothing ==================================== */

/* Facts about a mesh from its arrays alone; vertices are told apart by index. */
typedef struct dif_measure {
  uint64_t struct_size;
  int64_t vertices; /* in use or not */
  int64_t edges;
  int64_t triangles;
  int64_t components;            /* of triangles joined by edges */
  int64_t isolated_vertices;     /* in no triangle */
  int64_t boundary_edges;        /* with one triangle */
  int64_t non_manifold_edges;    /* with more than two */
  int64_t misoriented_edges;     /* with two that run along it the same way */
  int64_t non_manifold_vertices; /* whose triangles are not one fan or one cycle */
  int64_t degenerate_triangles;  /* an index twice, or area exactly 0 */
  int64_t euler_number;          /* V - E + F over the vertices in use */
  int32_t closed;                /* every edge has an even number of triangles */
  int32_t manifold;              /* no non-manifold edge or vertex, no misoriented edge */
  double area;
  double volume; /* signed; means something only where has_volume */
  double low[3]; /* bounding box of all positions */
  double high[3];
  int64_t unbalanced_edges; /* with more than two triangles, more one way than the other */
  int32_t has_volume;       /* triangles run along every edge as often one way as the other, where
                             * vertices at equal positions count as one */
  int32_t reserved;
} dif_measure;

/* Prepares an output struct. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_measure_init(dif_measure* measure, uint64_t struct_size);
/* Errors: INVALID_ARGUMENT (a position that is not finite is named), STRUCT, OUT_OF_MEMORY. Since
 * 0.1. */
DIF_API dif_status dif_mesh_measure(const dif_mesh* mesh, dif_measure* measure);

typedef struct dif_distance_options {
  uint64_t struct_size;
  double facet_spacing; /* of the points on facets; 0, the default: four points per usual facet */
  int32_t with_sign;    /* reference meshes: 1, the default: tell inside from outside */
  int32_t threads;
  dif_progress progress;
  void* progress_user;
} dif_distance_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_distance_options_init(dif_distance_options* options, uint64_t struct_size);

/* Distances d of some points. This struct has no size and never changes. */
typedef struct dif_statistics {
  int64_t points;
  double rms;
  double mean;           /* of |d| */
  double signed_mean;    /* of d: the bias */
  double lowest;         /* least d */
  double highest;        /* greatest d */
  double maximum;        /* greatest |d| */
  int64_t maximum_index; /* its vertex, or triangle for facet points; -1 for no points */
  double maximum_position[3];
} dif_statistics;

typedef struct dif_distance {
  uint64_t struct_size;
  dif_statistics vertices; /* of the vertices in use */
  dif_statistics facets;   /* of points on the facets; means are by area */
  double area;             /* of the measured surface */
  double reach;            /* no point is further from a vertex or facet point */
  int32_t has_sign;        /* 0: all d >= 0 */
  int32_t reserved;
} dif_distance;

/* Prepares an output struct. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_distance_init(dif_distance* distance, uint64_t struct_size);

/* Distances of a mesh from a shape, which may be given by its signed distance. `function` is called
 * from several threads at once unless `threads` is 1.
 * Errors: INVALID_ARGUMENT (also for an empty mesh), INVALID_VALUE (a distance that is NaN),
 * STRUCT, OUT_OF_MEMORY, CANCELLED, UNSUPPORTED. Since 0.2. */
DIF_API dif_status dif_distance_to_shape(const dif_mesh* mesh, const dif_shape* shape,
                                         const dif_distance_options* options,
                                         dif_distance* distance);
DIF_API dif_status dif_distance_to_function(const dif_mesh* mesh, dif_function function, void* user,
                                            const dif_distance_options* options,
                                            dif_distance* distance);
/* Distances of a mesh from a reference mesh, and back: `back` may be NULL, and then is not
 * measured. Their larger maximum bounds the Hausdorff distance from below, and with the larger
 * reach added from above. Errors: likewise, and TOO_LARGE. Since 0.2. */
DIF_API dif_status dif_distance_to_mesh(const dif_mesh* mesh, const dif_mesh* reference,
                                        const dif_distance_options* options, dif_distance* distance,
                                        dif_distance* back);

typedef struct dif_curvature_options {
  uint64_t struct_size;
  int32_t rings; /* neighbours up to so many edges away are fitted; [1, 8]; 2 */
  int32_t threads;
  dif_progress progress;
  void* progress_user;
} dif_curvature_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_curvature_options_init(dif_curvature_options* options, uint64_t struct_size);

/* Curvatures at the vertices of a mesh, by parabolic patches fitted to their neighbours: the mean
 * of the principal ones, their product (Gaussian), the larger and the smaller. One number per
 * vertex each, NaN where too few neighbours determine no patch; `mean`, `gaussian`, `largest` and
 * `smallest` may be NULL. In 1 / unit, the Gaussian squared; positive where bodies are convex: 1/R
 * for a ball.
 * Errors: INVALID_ARGUMENT (a position that is not finite is named), STRUCT, OUT_OF_MEMORY,
 * CANCELLED. Since 0.2. */
DIF_API dif_status dif_mesh_curvature(const dif_mesh* mesh, const dif_curvature_options* options,
                                      double mean[], double gaussian[], double largest[],
                                      double smallest[]);

enum {
  DIF_SMOOTHING_DEFAULT = 0,    /* TAUBIN */
  DIF_SMOOTHING_LAPLACIAN = 1,  /* to the neighbours' mean; shrinks */
  DIF_SMOOTHING_TAUBIN = 2,     /* to the neighbours' mean and back by more; hardly shrinks */
  DIF_SMOOTHING_FLOW = 3,       /* along the normal by the mean curvature, implicit; shrinks */
  DIF_SMOOTHING_CONSTRAINED = 4 /* keeps each cell's fraction within a tolerance */
};

/* What vertices on boundaries do under LAPLACIAN and TAUBIN; others keep them where they are. */
enum {
  DIF_BOUNDARY_DEFAULT = 0, /* STAY */
  DIF_BOUNDARY_STAY = 1,
  DIF_BOUNDARY_ALONG = 2 /* see their neighbours along the boundary only */
};

typedef struct dif_smoothing_options {
  uint64_t struct_size;
  int32_t kind;     /* DIF_SMOOTHING_... */
  int32_t steps;    /* 0, the default: 1, for TAUBIN 15, for CONSTRAINED 3 */
  int32_t boundary; /* DIF_BOUNDARY_... */
  int32_t threads;
  double factor;    /* LAPLACIAN: share of the way to the mean; (0, 1]; 1 */
  double lambda;    /* TAUBIN: likewise; 0.6307 */
  double pass_band; /* TAUBIN: frequency below which nothing is damped, 0 to 2; 0.1 */
  double time;      /* FLOW: of each step, in the square of the mesh's unit; > 0; 1 */
  double residual;  /* FLOW: of the linear systems, over the first; [1e-14, 0.1]; 1e-10 */
  double tolerance; /* CONSTRAINED: of fractions; [1e-9, 0.5]; 0.01 */
  double clearance; /* CONSTRAINED: as in dif_options; 1e-12 */
  dif_progress progress;
  void* progress_user;
} dif_smoothing_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_smoothing_options_init(dif_smoothing_options* options, uint64_t struct_size);

/* A new mesh with the vertices moved. It has the triangles and edge_ids of the given one and, if
 * that has normals, those of the smooth surface, but no scalars or report, which no longer hold.
 * CONSTRAINED needs a closed mesh with edge_ids and the grid of its reconstruction; `grid` may be
 * NULL for the others, which do not look at it.
 * Errors: INVALID_ARGUMENT, INVALID_GRID, TOO_LARGE, STRUCT, OUT_OF_MEMORY, CANCELLED. Since 0.2.
 * */
DIF_API dif_status dif_mesh_smooth(const dif_mesh* mesh, const dif_grid* grid,
                                   const dif_smoothing_options* options, dif_mesh** smooth);

/* ============================== 7. Files ====================================================== */

/* Paths are those of the system, on POSIX any bytes but 0. Files appear under their names when they
 * are complete and not before; on failure nothing is left. Files that a file names, the data of
 * .nhdr and the buffers of .gltf, must be named relative to its folder and lie in it or below,
 * symbolic links resolved, unless `outside_files` is set: a file from a stranger must not read
 * others. All functions return UNSUPPORTED in a build without files. */

/* How Draco orders a mesh. */
enum {
  DIF_DRACO_DEFAULT = 0,     /* EDGEBREAKER */
  DIF_DRACO_EDGEBREAKER = 1, /* smallest; vertices and triangles come in another order */
  DIF_DRACO_SEQUENTIAL = 2   /* keeps their order; some three times as large */
};

enum {
  DIF_COLOR_MAP_DEFAULT = 0,  /* VIRIDIS */
  DIF_COLOR_MAP_VIRIDIS = 1,  /* from dark blue over green to yellow */
  DIF_COLOR_MAP_COOL_WARM = 2 /* diverging: blue, grey at 0, red */
};

/* The axis of the mesh's coordinates that points up; in glTF that is y. */
enum {
  DIF_UP_DEFAULT = 0, /* Y */
  DIF_UP_Y = 1,       /* coordinates are written as they are */
  DIF_UP_Z = 2        /* a root node turns z up to y up; the coordinates below it are as they are */
};

/* "glTF" is .glb and .gltf; "Draco" is .drc, and glTF with `draco`. What a format cannot honour
 * must be left as it is. */
typedef struct dif_mesh_write_options {
  uint64_t struct_size;
  const char* format;     /* an extension, such as "ply"; NULL, the default: that of the path */
  int32_t normals;        /* 1, the default: write them, where mesh and format have them */
  int32_t edge_ids;       /* 1, the default: likewise */
  int32_t scalars;        /* 1, the default: likewise; PLY, glTF and Draco */
  int32_t draco;          /* 1: compress glTF, with KHR_draco_mesh_compression; default 0 */
  int32_t draco_method;   /* DIF_DRACO_...; EDGEBREAKER */
  int32_t draco_speed;    /* 0 small to 10 fast; 5 */
  int32_t position_bits;  /* Draco: 1 to 24; 0, the default: as many as keep coordinates within a
                           * thousandth of cell_size */
  int32_t normal_bits;    /* Draco: 2 to 24; 10, off by up to 0.25 degrees */
  int32_t generic_bits;   /* Draco: of scalars, in steps of their range; 1 to 24; 12 */
  int32_t color_map;      /* glTF: DIF_COLOR_MAP_...; VIRIDIS */
  const char* color_by;   /* glTF: the name of scalars to color by; NULL, the default: light grey */
  double color_range[2];  /* of the first and the last color; 0, 0, the default: least and greatest
                           * value, for COOL_WARM as far from 0 on both sides */
  double cell_size;       /* Draco: >= 0; 0, the default: the mean length of the triangles' edges */
  double metres_per_unit; /* glTF, whose unit is the metre: > 0; 1 */
  double local_origin[3]; /* glTF: what positions are relative to, if has_local_origin */
  int32_t has_local_origin; /* 0, the default: the centre of the bounding box */
  int32_t up;               /* glTF: DIF_UP_...; Y */
  int64_t most_vertices;    /* glTF: of a primitive, >= 3; 2^32 - 1. 65535: indices of 16 bits */
  const char* name;         /* glTF: of mesh and node, in UTF-8; NULL, the default: "surface" */
} dif_mesh_write_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_mesh_write_options_init(dif_mesh_write_options* options,
                                               uint64_t struct_size);
/* What became of a mesh in a file. Counts are those of the file: STL has three vertices per
 * triangle, the parts of a split glTF repeat some, and Draco adds some where the mesh is not
 * manifold. `warning` says that triangles of STL collapse, or that its coordinates are off by more
 * than a hundredth of the mean edge: one English sentence in UTF-8, at most 1023 bytes, valid until
 * the next dif_mesh_write() on this thread; NULL if there is nothing to tell. */
typedef struct dif_mesh_write_report {
  uint64_t struct_size;
  int64_t bytes; /* size of the file */
  int64_t vertices;
  int64_t triangles;
  int64_t primitives;     /* of glTF; 1 in other formats */
  double position_error;  /* no coordinate is off by more; exact for STL, 0 for PLY, OBJ, OFF */
  double local_origin[3]; /* glTF, Draco: what positions are relative to in the file; else 0 */
  int64_t collapsed_triangles; /* STL: that lose their area in float32; else 0 */
  const char* warning;         /* what a user should know though the file is there; see above */
  int32_t position_bits;       /* of Draco; 0 without */
  int32_t reserved;
} dif_mesh_write_report;

/* Prepares an output struct. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_mesh_write_report_init(dif_mesh_write_report* report, uint64_t struct_size);
/* Writes .ply (float64), .obj, .off, .stl (float32), .glb, .gltf (glTF, float32 about the centre)
 * or .drc (Draco), told by the extension or the options. `report` may be NULL; one that cannot be
 * filled is refused before anything is written. Errors: INVALID_ARGUMENT, INVALID_VALUE (a position
 * or scalar that is not finite; for glTF and Draco a mesh without triangles), TOO_LARGE,
 * FILE_WRITE, STRUCT, OUT_OF_MEMORY, UNSUPPORTED (DIF_PART_GLTF or DIF_PART_DRACO is not there).
 * Since 0.2. */
DIF_API dif_status dif_mesh_write(const dif_mesh* mesh, const char* path,
                                  const dif_mesh_write_options* options,
                                  dif_mesh_write_report* report);
/* Reads .ply, .obj, .off, .stl, .glb, .gltf or .drc, told by the extension.
 * Errors: FILE_MISSING, FILE_FORMAT, TOO_LARGE, OUT_OF_MEMORY, UNSUPPORTED (as above; FILE_FORMAT
 * for compressed glTF). Since 0.2. */
DIF_API dif_status dif_mesh_read(const char* path, dif_mesh** mesh);
/* Borrowed: warning number `index`, from 0, of the reading or of dif_reconstruct(); NULL from their
 * count on. It tells what was left out of the file or taken otherwise than it says, or that values
 * look like a mask, in one English sentence of at most 1000 bytes of UTF-8. Other meshes have none.
 * Errors: INVALID_ARGUMENT. Since 0.2. */
DIF_API dif_status dif_mesh_warning(const dif_mesh* mesh, int64_t index, const char** text);

typedef struct dif_mesh_read_options {
  uint64_t struct_size;
  int32_t outside_files; /* 1: buffers of glTF may lie outside the folder of the file; default 0 */
  int32_t reserved;      /* 0 */
} dif_mesh_read_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_mesh_read_options_init(dif_mesh_read_options* options, uint64_t struct_size);
/* dif_mesh_read() with options. Errors: likewise, and INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_mesh_read_with(const char* path, const dif_mesh_read_options* options,
                                      dif_mesh** mesh);

/* A field read from a file, with its memory. */
typedef struct dif_field_file dif_field_file;

/* Where the elements of a raw file are: x fastest, up to the end of the file. */
typedef struct dif_raw_layout {
  uint64_t struct_size;
  int64_t dims[3];    /* cells in x, y, z */
  int32_t type;       /* DIF_FLOAT64, ..., DIF_INT8, ... */
  int32_t big_endian; /* 0 or 1 */
  int64_t offset;     /* bytes before the first element */
} dif_raw_layout;

/* Type FLOAT64, offset 0, little endian; dims must be set. Errors: INVALID_ARGUMENT, STRUCT. Since
 * 0.1. */
DIF_API dif_status dif_raw_layout_init(dif_raw_layout* layout, uint64_t struct_size);
/* Reads .npy, .nrrd or .nhdr, told by the extension, or with a layout a raw file; `layout` may be
 * NULL.
 * Errors: INVALID_ARGUMENT, FILE_MISSING, FILE_FORMAT, TOO_LARGE, STRUCT, OUT_OF_MEMORY. Since 0.2.
 * */
DIF_API dif_status dif_field_read(const char* path, const dif_raw_layout* layout,
                                  dif_field_file** file);

/* What is wanted of the file. */
typedef struct dif_field_read_options {
  uint64_t struct_size;
  double origin[3];       /* if has_origin: replaces what the file tells, unjudged */
  double spacing[3];      /* if has_spacing: likewise */
  int32_t has_origin;     /* 0 or 1; 0 */
  int32_t has_spacing;    /* 0 or 1; 0 */
  double empty_value;     /* if has_full_value: what stands for 0; 0 */
  double full_value;      /* and what stands for 1, as in dif_fractions_from_values(); 1 */
  int32_t has_full_value; /* 0, the default: integers stand for value / (largest of their type) */
  int32_t outside_files;  /* 1: data files may lie outside the folder of the header; default 0 */
  int64_t label_count;    /* > 0: cells with one of `labels` are full, others empty; 0 */
  const int64_t* labels;
} dif_field_read_options;

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_field_read_options_init(dif_field_read_options* options,
                                               uint64_t struct_size);
/* dif_field_read() with options; `layout` may be NULL. Where integers become shares of the largest
 * value, types but UINT8 and UINT16 become FLOAT32 or FLOAT64. Errors: likewise. Since 0.2. */
DIF_API dif_status dif_field_read_with(const char* path, const dif_raw_layout* layout,
                                       const dif_field_read_options* options,
                                       dif_field_file** file);
/* Borrowed: warning number `index`, from 0, of the reading; NULL from their count on. It tells what
 * a user must know though it is no error, in one English sentence of at most 1000 bytes of UTF-8.
 * Errors: INVALID_ARGUMENT. Since 0.2. */
DIF_API dif_status dif_field_file_warning(const dif_field_file* file, int64_t index,
                                          const char** text);
/* The type of the elements in the file, DIF_INT16 for instance. Errors: INVALID_ARGUMENT. Since
   0.1. */
DIF_API dif_status dif_field_file_type(const dif_field_file* file, int32_t* type);
/* Frees the field; NULL is fine. Since 0.2. */
DIF_API void dif_field_file_free(dif_field_file* file);
/* Describes what was read: `field` borrows the memory of `file`. Origin 0 and spacing 1 where the
 * file tells none. `field` needs no more than its struct_size set. Since 0.2. */
DIF_API dif_status dif_field_file_field(const dif_field_file* file, dif_field* field);

typedef struct dif_field_write_options {
  uint64_t struct_size;
  int32_t format;     /* DIF_FIELD_FORMAT_...; BY_EXTENSION */
  int32_t type;       /* DIF_FLOAT32, ...; 0, the default: that of the field */
  int32_t gzip;       /* NRRD: 1, the default, or 0 */
  int32_t gzip_level; /* 1 to 9; 6 */
} dif_field_write_options;
enum { DIF_FIELD_FORMAT_BY_EXTENSION = 0, DIF_FIELD_FORMAT_NPY = 1, DIF_FIELD_FORMAT_NRRD = 2 };

/* Fills in the defaults. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_field_write_options_init(dif_field_write_options* options,
                                                uint64_t struct_size);
/* NRRD holds origin and spacing, .npy does not. Errors: INVALID_ARGUMENT, INVALID_GRID,
 * INVALID_VALUE, TOO_LARGE, FILE_WRITE, STRUCT, OUT_OF_MEMORY. Since 0.2. */
DIF_API dif_status dif_field_write(const dif_field* field, const char* path,
                                   const dif_field_write_options* options);

/* ============================== 8. Experimental =============================================== */

/* What follows may change with any release. */

/* Ghost cells that a block needs beyond each face, as far as the domain reaches. */
#define DIF_GHOST_LAYERS 5
/* The same for DIF_PLACEMENT_CURVED. */
#define DIF_CURVED_GHOST_LAYERS 8

/* A block of a larger grid, as one rank of a distributed solver has it. The field given with it
 * covers the cells [offset - ghost_low, offset + dims + ghost_high) of the whole grid. */
typedef struct dif_block {
  uint64_t struct_size;
  int64_t offset[3]; /* first cell of the block in the whole grid */
  int64_t dims[3];   /* cells of the block */
  int64_t ghost_low[3];
  int64_t ghost_high[3];
} dif_block;

/* Prepares a block of 0 cells. Errors: INVALID_ARGUMENT, STRUCT. Since 0.2. */
DIF_API dif_status dif_block_init(dif_block* block, uint64_t struct_size);
/* As dif_reconstruct(), of one block. `grid` is the whole grid; origin and spacing of `field` are
 * not looked at. The mesh has edge_ids. Its report says what the block adds to the whole: its own
 * cells, the edges it owns (whose lower node is one of them), `closed` unless the surface ends at a
 * side of the domain, and a volume whose sum over the blocks is that enclosed. Since 0.2. */
DIF_API dif_status dif_reconstruct_block(const dif_field* field, const dif_block* block,
                                         const dif_grid* grid, const dif_options* options,
                                         dif_mesh** mesh);
/* Joins meshes of disjoint blocks by edge ids: those of blocks that cover the grid give the mesh of
 * the whole field, bit for bit. Errors: INVALID_ARGUMENT (also for blocks that are not disjoint,
 * such as one given twice: both meshes have triangles between the same cells), TOO_LARGE,
 * OUT_OF_MEMORY. Since 0.2. */
DIF_API dif_status dif_mesh_weld(const dif_mesh* const meshes[], int64_t count,
                                 const dif_grid* grid, dif_mesh** mesh);

#ifdef __cplusplus
}
#endif

#endif
