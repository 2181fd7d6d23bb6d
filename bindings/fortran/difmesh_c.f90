! Written by scripts/generate_bindings.py from difmesh.h; do not edit, run that again.
! The functions of difmesh.h as they are, for what the module difmesh does not cover. An
! absent optional argument is NULL; text ends with c_null_char; see the header for more.
module difmesh_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int8_t, c_int32_t, &
    c_int64_t, c_ptr
  use difmesh_types
  implicit none
  private :: c_char, c_double, c_funptr, c_int8_t, c_int32_t, c_int64_t, c_ptr

  interface
    type(c_ptr) function dif_status_name(status) bind(c)
      import :: c_int32_t, c_ptr
      integer(c_int32_t), value :: status
    end function

    type(c_ptr) function dif_last_message() bind(c)
      import :: c_ptr
    end function

    integer(c_int32_t) function dif_version() bind(c)
      import :: c_int32_t
    end function

    type(c_ptr) function dif_version_text() bind(c)
      import :: c_ptr
    end function

    integer(c_int32_t) function dif_has(part) bind(c)
      import :: c_int32_t
      integer(c_int32_t), value :: part
    end function

    integer(c_int32_t) function dif_field_init(field, struct_size, data, type, dims) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr, dif_field
      type(dif_field), intent(inout) :: field
      integer(c_int64_t), value :: struct_size
      type(c_ptr), value :: data
      integer(c_int32_t), value :: type
      integer(c_int64_t), intent(in) :: dims(3)
    end function

    integer(c_int32_t) function dif_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_options
      type(dif_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_reconstruct(field, options, mesh) bind(c)
      import :: c_int32_t, c_ptr, dif_field, dif_options
      type(dif_field), intent(in) :: field
      type(dif_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: mesh
    end function

    subroutine dif_mesh_free(mesh) bind(c)
      import :: c_ptr
      type(c_ptr), value :: mesh
    end subroutine

    integer(c_int32_t) function dif_mesh_positions(mesh, positions, vertices) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: positions
      integer(c_int64_t), intent(inout) :: vertices
    end function

    integer(c_int32_t) function dif_mesh_triangles(mesh, indices, triangles) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: indices
      integer(c_int64_t), intent(inout) :: triangles
    end function

    integer(c_int32_t) function dif_mesh_normals(mesh, normals, vertices) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: normals
      integer(c_int64_t), intent(inout) :: vertices
    end function

    integer(c_int32_t) function dif_mesh_edge_ids(mesh, ids, vertices) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: ids
      integer(c_int64_t), intent(inout) :: vertices
    end function

    integer(c_int32_t) function dif_report_init(report, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_report
      type(dif_report), intent(inout) :: report
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mesh_report(mesh, report) bind(c)
      import :: c_int32_t, c_ptr, dif_report
      type(c_ptr), value :: mesh
      type(dif_report), intent(inout) :: report
    end function

    integer(c_int32_t) function dif_mesh_from_arrays(positions, vertices, indices, triangles, &
        mesh) bind(c)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      real(c_double), intent(in) :: positions(*)
      integer(c_int64_t), value :: vertices
      integer(c_int32_t), intent(in) :: indices(*)
      integer(c_int64_t), value :: triangles
      type(c_ptr), intent(inout) :: mesh
    end function

    integer(c_int32_t) function dif_mesh_set_normals(mesh, normals) bind(c)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: mesh
      real(c_double), intent(in), optional :: normals(*)
    end function

    integer(c_int32_t) function dif_mesh_set_edge_ids(mesh, ids) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      integer(c_int64_t), intent(in), optional :: ids(*)
    end function

    integer(c_int32_t) function dif_mesh_set_scalars(mesh, name, values) bind(c)
      import :: c_char, c_double, c_int32_t, c_ptr
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(in), optional :: values(*)
    end function

    integer(c_int32_t) function dif_mesh_scalars_name(mesh, index, name) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout) :: name
    end function

    integer(c_int32_t) function dif_mesh_scalars(mesh, name, values, vertices) bind(c)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(inout) :: values
      integer(c_int64_t), intent(inout) :: vertices
    end function

    integer(c_int32_t) function dif_mesh_copy_positions(mesh, type, stride, capacity, out) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: type
      integer(c_int64_t), value :: stride
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: out
    end function

    integer(c_int32_t) function dif_mesh_copy_normals(mesh, type, stride, capacity, out) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: type
      integer(c_int64_t), value :: stride
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: out
    end function

    integer(c_int32_t) function dif_mesh_copy_triangles(mesh, type, first_vertex, stride, &
        capacity, out) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: type
      integer(c_int64_t), value :: first_vertex
      integer(c_int64_t), value :: stride
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: out
    end function

    integer(c_int32_t) function dif_plane_fraction(spacing, count, normals, offsets, &
        fractions) bind(c)
      import :: c_double, c_int32_t, c_int64_t
      real(c_double), intent(in) :: spacing(3)
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: normals(*)
      real(c_double), intent(in) :: offsets(*)
      real(c_double), intent(inout) :: fractions(*)
    end function

    integer(c_int32_t) function dif_plane_offset(spacing, count, normals, fractions, &
        offsets) bind(c)
      import :: c_double, c_int32_t, c_int64_t
      real(c_double), intent(in) :: spacing(3)
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: normals(*)
      real(c_double), intent(in) :: fractions(*)
      real(c_double), intent(inout) :: offsets(*)
    end function

    integer(c_int32_t) function dif_cell_planes(field, options, count, cells, normals, offsets, &
        sources) bind(c)
      import :: c_double, c_int32_t, c_int64_t, dif_field, dif_options
      type(dif_field), intent(in) :: field
      type(dif_options), intent(in), optional :: options
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in) :: cells(*)
      real(c_double), intent(inout), optional :: normals(*)
      real(c_double), intent(inout), optional :: offsets(*)
      integer(c_int32_t), intent(inout), optional :: sources(*)
    end function

    integer(c_int32_t) function dif_plane_arrays_init(arrays, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_plane_arrays
      type(dif_plane_arrays), intent(inout) :: arrays
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_field_planes(field, options, arrays) bind(c)
      import :: c_int32_t, dif_field, dif_options, dif_plane_arrays
      type(dif_field), intent(in) :: field
      type(dif_options), intent(in), optional :: options
      type(dif_plane_arrays), intent(in) :: arrays
    end function

    integer(c_int32_t) function dif_interfacial_cells(field, options, capacity, cells, &
        count) bind(c)
      import :: c_int32_t, c_int64_t, dif_field, dif_options
      type(dif_field), intent(in) :: field
      type(dif_options), intent(in), optional :: options
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout), optional :: cells(*)
      integer(c_int64_t), intent(inout) :: count
    end function

    integer(c_int32_t) function dif_surface_arrays_init(arrays, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_surface_arrays
      type(dif_surface_arrays), intent(inout) :: arrays
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_cell_surfaces(field, options, kind, count, cells, &
        arrays) bind(c)
      import :: c_int32_t, c_int64_t, dif_field, dif_options, dif_surface_arrays
      type(dif_field), intent(in) :: field
      type(dif_options), intent(in), optional :: options
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in) :: cells(*)
      type(dif_surface_arrays), intent(in) :: arrays
    end function

    integer(c_int32_t) function dif_cell_curvature(field, options, mean, strides) bind(c)
      import :: c_double, c_int32_t, c_int64_t, dif_field, dif_options
      type(dif_field), intent(in) :: field
      type(dif_options), intent(in), optional :: options
      real(c_double), intent(inout) :: mean(*)
      integer(c_int64_t), intent(in), optional :: strides(3)
    end function

    integer(c_int32_t) function dif_grid_init(grid, struct_size, dims) bind(c)
      import :: c_int32_t, c_int64_t, dif_grid
      type(dif_grid), intent(inout) :: grid
      integer(c_int64_t), value :: struct_size
      integer(c_int64_t), intent(in) :: dims(3)
    end function

    integer(c_int32_t) function dif_function_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_function_options
      type(dif_function_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_function_report_init(report, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_function_report
      type(dif_function_report), intent(inout) :: report
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_fractions_from_function(grid, f, user, options, report, &
        fractions) bind(c)
      import :: c_double, c_funptr, c_int32_t, c_ptr, dif_function_options, dif_function_report, &
        dif_grid
      type(dif_grid), intent(in) :: grid
      type(c_funptr), value :: f
      type(c_ptr), value :: user
      type(dif_function_options), intent(in), optional :: options
      type(dif_function_report), intent(inout), optional :: report
      real(c_double), intent(inout) :: fractions(*)
    end function

    integer(c_int32_t) function dif_triangle_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_triangle_options
      type(dif_triangle_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_triangle_report_init(report, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_triangle_report
      type(dif_triangle_report), intent(inout) :: report
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_fractions_from_mesh(grid, mesh, options, report, &
        fractions) bind(c)
      import :: c_double, c_int32_t, c_ptr, dif_grid, dif_triangle_options, dif_triangle_report
      type(dif_grid), intent(in) :: grid
      type(c_ptr), value :: mesh
      type(dif_triangle_options), intent(in), optional :: options
      type(dif_triangle_report), intent(inout), optional :: report
      real(c_double), intent(inout) :: fractions(*)
    end function

    integer(c_int32_t) function dif_shape_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_shape_options
      type(dif_shape_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_shape_create(options, shape) bind(c)
      import :: c_int32_t, c_ptr, dif_shape_options
      type(dif_shape_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: shape
    end function

    subroutine dif_shape_free(shape) bind(c)
      import :: c_ptr
      type(c_ptr), value :: shape
    end subroutine

    integer(c_int32_t) function dif_shape_bounds(shape, low, high) bind(c)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: shape
      real(c_double), intent(inout) :: low(3)
      real(c_double), intent(inout) :: high(3)
    end function

    integer(c_int32_t) function dif_shape_volume(shape, volume) bind(c)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: shape
      real(c_double), intent(inout) :: volume
    end function

    integer(c_int32_t) function dif_shape_distances(shape, count, points, distances) bind(c)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: shape
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: points(*)
      real(c_double), intent(inout) :: distances(*)
    end function

    integer(c_int32_t) function dif_fractions_from_shape(grid, shape, options, report, &
        fractions) bind(c)
      import :: c_double, c_int32_t, c_ptr, dif_function_options, dif_function_report, dif_grid
      type(dif_grid), intent(in) :: grid
      type(c_ptr), value :: shape
      type(dif_function_options), intent(in), optional :: options
      type(dif_function_report), intent(inout), optional :: report
      real(c_double), intent(inout) :: fractions(*)
    end function

    integer(c_int32_t) function dif_fractions_from_values(values, empty, full, fractions) bind(c)
      import :: c_double, c_int32_t, dif_field
      type(dif_field), intent(in) :: values
      real(c_double), value :: empty
      real(c_double), value :: full
      real(c_double), intent(inout) :: fractions(*)
    end function

    integer(c_int32_t) function dif_fractions_from_labels(values, count, labels, fractions) bind(c)
      import :: c_int8_t, c_int32_t, c_int64_t, dif_field
      type(dif_field), intent(in) :: values
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in) :: labels(*)
      integer(c_int8_t), intent(inout) :: fractions(*)
    end function

    integer(c_int32_t) function dif_value_extremes(values, lowest, highest) bind(c)
      import :: c_double, c_int32_t, dif_field
      type(dif_field), intent(in) :: values
      real(c_double), intent(inout) :: lowest
      real(c_double), intent(inout) :: highest
    end function

    integer(c_int32_t) function dif_mollify_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_mollify_options
      type(dif_mollify_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mollify(field, options, values) bind(c)
      import :: c_double, c_int32_t, dif_field, dif_mollify_options
      type(dif_field), intent(in) :: field
      type(dif_mollify_options), intent(in), optional :: options
      real(c_double), intent(inout) :: values(*)
    end function

    integer(c_int32_t) function dif_measure_init(measure, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_measure
      type(dif_measure), intent(inout) :: measure
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mesh_measure(mesh, measure) bind(c)
      import :: c_int32_t, c_ptr, dif_measure
      type(c_ptr), value :: mesh
      type(dif_measure), intent(inout) :: measure
    end function

    integer(c_int32_t) function dif_distance_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_distance_options
      type(dif_distance_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_distance_init(distance, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_distance
      type(dif_distance), intent(inout) :: distance
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_distance_to_shape(mesh, shape, options, distance) bind(c)
      import :: c_int32_t, c_ptr, dif_distance, dif_distance_options
      type(c_ptr), value :: mesh
      type(c_ptr), value :: shape
      type(dif_distance_options), intent(in), optional :: options
      type(dif_distance), intent(inout) :: distance
    end function

    integer(c_int32_t) function dif_distance_to_function(mesh, function, user, options, &
        distance) bind(c)
      import :: c_funptr, c_int32_t, c_ptr, dif_distance, dif_distance_options
      type(c_ptr), value :: mesh
      type(c_funptr), value :: function
      type(c_ptr), value :: user
      type(dif_distance_options), intent(in), optional :: options
      type(dif_distance), intent(inout) :: distance
    end function

    integer(c_int32_t) function dif_distance_to_mesh(mesh, reference, options, distance, &
        back) bind(c)
      import :: c_int32_t, c_ptr, dif_distance, dif_distance_options
      type(c_ptr), value :: mesh
      type(c_ptr), value :: reference
      type(dif_distance_options), intent(in), optional :: options
      type(dif_distance), intent(inout) :: distance
      type(dif_distance), intent(inout), optional :: back
    end function

    integer(c_int32_t) function dif_curvature_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_curvature_options
      type(dif_curvature_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mesh_curvature(mesh, options, mean, gaussian, largest, &
        smallest) bind(c)
      import :: c_double, c_int32_t, c_ptr, dif_curvature_options
      type(c_ptr), value :: mesh
      type(dif_curvature_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: mean(*)
      real(c_double), intent(inout), optional :: gaussian(*)
      real(c_double), intent(inout), optional :: largest(*)
      real(c_double), intent(inout), optional :: smallest(*)
    end function

    integer(c_int32_t) function dif_smoothing_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_smoothing_options
      type(dif_smoothing_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mesh_smooth(mesh, grid, options, smooth) bind(c)
      import :: c_int32_t, c_ptr, dif_grid, dif_smoothing_options
      type(c_ptr), value :: mesh
      type(dif_grid), intent(in), optional :: grid
      type(dif_smoothing_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: smooth
    end function

    integer(c_int32_t) function dif_mesh_write_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_mesh_write_options
      type(dif_mesh_write_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mesh_write_report_init(report, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_mesh_write_report
      type(dif_mesh_write_report), intent(inout) :: report
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mesh_write(mesh, path, options, report) bind(c)
      import :: c_char, c_int32_t, c_ptr, dif_mesh_write_options, dif_mesh_write_report
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: path(*)
      type(dif_mesh_write_options), intent(in), optional :: options
      type(dif_mesh_write_report), intent(inout), optional :: report
    end function

    integer(c_int32_t) function dif_mesh_read(path, mesh) bind(c)
      import :: c_char, c_int32_t, c_ptr
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(inout) :: mesh
    end function

    integer(c_int32_t) function dif_mesh_warning(mesh, index, text) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout) :: text
    end function

    integer(c_int32_t) function dif_mesh_read_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_mesh_read_options
      type(dif_mesh_read_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_mesh_read_with(path, options, mesh) bind(c)
      import :: c_char, c_int32_t, c_ptr, dif_mesh_read_options
      character(kind=c_char), intent(in) :: path(*)
      type(dif_mesh_read_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: mesh
    end function

    integer(c_int32_t) function dif_raw_layout_init(layout, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_raw_layout
      type(dif_raw_layout), intent(inout) :: layout
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_field_read(path, layout, file) bind(c)
      import :: c_char, c_int32_t, c_ptr, dif_raw_layout
      character(kind=c_char), intent(in) :: path(*)
      type(dif_raw_layout), intent(in), optional :: layout
      type(c_ptr), intent(inout) :: file
    end function

    integer(c_int32_t) function dif_field_read_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_field_read_options
      type(dif_field_read_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_field_read_with(path, layout, options, file) bind(c)
      import :: c_char, c_int32_t, c_ptr, dif_field_read_options, dif_raw_layout
      character(kind=c_char), intent(in) :: path(*)
      type(dif_raw_layout), intent(in), optional :: layout
      type(dif_field_read_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: file
    end function

    integer(c_int32_t) function dif_field_file_warning(file, index, text) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: file
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout) :: text
    end function

    integer(c_int32_t) function dif_field_file_type(file, type) bind(c)
      import :: c_int32_t, c_ptr
      type(c_ptr), value :: file
      integer(c_int32_t), intent(inout) :: type
    end function

    subroutine dif_field_file_free(file) bind(c)
      import :: c_ptr
      type(c_ptr), value :: file
    end subroutine

    integer(c_int32_t) function dif_field_file_field(file, field) bind(c)
      import :: c_int32_t, c_ptr, dif_field
      type(c_ptr), value :: file
      type(dif_field), intent(inout) :: field
    end function

    integer(c_int32_t) function dif_field_write_options_init(options, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_field_write_options
      type(dif_field_write_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_field_write(field, path, options) bind(c)
      import :: c_char, c_int32_t, dif_field, dif_field_write_options
      type(dif_field), intent(in) :: field
      character(kind=c_char), intent(in) :: path(*)
      type(dif_field_write_options), intent(in), optional :: options
    end function

    integer(c_int32_t) function dif_block_init(block, struct_size) bind(c)
      import :: c_int32_t, c_int64_t, dif_block
      type(dif_block), intent(inout) :: block
      integer(c_int64_t), value :: struct_size
    end function

    integer(c_int32_t) function dif_reconstruct_block(field, block, grid, options, mesh) bind(c)
      import :: c_int32_t, c_ptr, dif_block, dif_field, dif_grid, dif_options
      type(dif_field), intent(in) :: field
      type(dif_block), intent(in) :: block
      type(dif_grid), intent(in) :: grid
      type(dif_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: mesh
    end function

    integer(c_int32_t) function dif_mesh_weld(meshes, count, grid, mesh) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr, dif_grid
      type(c_ptr), intent(in) :: meshes(*)
      integer(c_int64_t), value :: count
      type(dif_grid), intent(in) :: grid
      type(c_ptr), intent(inout) :: mesh
    end function
  end interface
end module
