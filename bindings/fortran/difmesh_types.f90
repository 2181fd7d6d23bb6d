! Written by scripts/generate_bindings.py from difmesh.h; do not edit, run that again.
! Constants and structs of difmesh.h, where their fields are described. A struct that
! dif_init did not prepare has struct_size 0, which the library refuses.
module difmesh_types
  use, intrinsic :: iso_c_binding, only: c_double, c_funptr, c_int32_t, c_int64_t, c_null_funptr, &
    c_null_ptr, c_ptr
  implicit none
  private

  integer(c_int32_t), parameter, public :: &
    dif_ok = 0, &
    dif_error_invalid_argument = 10, &
    dif_error_invalid_grid = 11, &
    dif_error_invalid_value = 12, &
    dif_error_struct = 13, &
    dif_error_too_large = 20, &
    dif_error_out_of_memory = 21, &
    dif_error_cancelled = 30, &
    dif_error_file_missing = 40, &
    dif_error_file_format = 41, &
    dif_error_file_write = 42, &
    dif_error_unsupported = 50, &
    dif_error_internal = 90

  integer(c_int32_t), parameter, public :: &
    dif_part_threads = 1, &
    dif_part_files = 2, &
    dif_part_distance = 3, &
    dif_part_gltf = 4, &
    dif_part_draco = 5

  integer(c_int32_t), parameter, public :: &
    dif_float32 = 1, &
    dif_float64 = 2, &
    dif_uint8 = 3, &
    dif_uint16 = 4

  integer(c_int32_t), parameter, public :: &
    dif_placement_default = 0, &
    dif_placement_midpoint = 1, &
    dif_placement_linear = 2, &
    dif_placement_manson = 3, &
    dif_placement_plic = 4, &
    dif_placement_curved = 5

  integer(c_int32_t), parameter, public :: &
    dif_normals_default = 0, &
    dif_normals_youngs = 1, &
    dif_normals_myc = 2, &
    dif_normals_height_function = 3, &
    dif_normals_elvira = 4, &
    dif_normals_lvira = 5

  integer(c_int32_t), parameter, public :: &
    dif_side_default = 0, &
    dif_side_open = 1, &
    dif_side_mirror = 2, &
    dif_side_periodic = 3, &
    dif_side_empty = 4, &
    dif_side_full = 5

  integer(c_int32_t), parameter, public :: &
    dif_int32 = 11, &
    dif_uint32 = 12, &
    dif_int64 = 13

  integer(c_int32_t), parameter, public :: &
    dif_source_none = 0, &
    dif_source_youngs = 1, &
    dif_source_centred_columns = 2, &
    dif_source_height_function = 3, &
    dif_source_least_squares = 4

  integer(c_int32_t), parameter, public :: &
    dif_surface_none = 0, &
    dif_surface_heights_13 = 1, &
    dif_surface_heights_25 = 2, &
    dif_surface_quadratic_fit = 3, &
    dif_surface_quartic_fit = 4

  integer(c_int32_t), parameter, public :: &
    dif_surfaces_for_position = 0, &
    dif_surfaces_for_curvature = 1

  integer(c_int32_t), parameter, public :: &
    dif_overlaps_default = 0, &
    dif_overlaps_union = 1, &
    dif_overlaps_refuse = 2, &
    dif_overlaps_count = 3

  integer(c_int32_t), parameter, public :: &
    dif_shape_sphere = 1, &
    dif_shape_ellipsoid = 2, &
    dif_shape_torus = 3, &
    dif_shape_genus = 4, &
    dif_shape_smooth_box = 5, &
    dif_shape_golf_ball = 6

  integer(c_int32_t), parameter, public :: &
    dif_int8 = 14, &
    dif_int16 = 15, &
    dif_uint64 = 16

  integer(c_int32_t), parameter, public :: &
    dif_smoothing_default = 0, &
    dif_smoothing_laplacian = 1, &
    dif_smoothing_taubin = 2, &
    dif_smoothing_flow = 3, &
    dif_smoothing_constrained = 4

  integer(c_int32_t), parameter, public :: &
    dif_boundary_default = 0, &
    dif_boundary_stay = 1, &
    dif_boundary_along = 2

  integer(c_int32_t), parameter, public :: &
    dif_draco_default = 0, &
    dif_draco_edgebreaker = 1, &
    dif_draco_sequential = 2

  integer(c_int32_t), parameter, public :: &
    dif_color_map_default = 0, &
    dif_color_map_viridis = 1, &
    dif_color_map_cool_warm = 2

  integer(c_int32_t), parameter, public :: &
    dif_up_default = 0, &
    dif_up_y = 1, &
    dif_up_z = 2

  integer(c_int32_t), parameter, public :: &
    dif_field_format_by_extension = 0, &
    dif_field_format_npy = 1, &
    dif_field_format_nrrd = 2

  integer(c_int64_t), parameter, public :: &
    dif_version_major = 0, &
    dif_version_minor = 2, &
    dif_version_patch = 0, &
    dif_ghost_layers = 5, &
    dif_curved_ghost_layers = 8

  type, bind(c), public :: dif_field
    integer(c_int64_t) :: struct_size = 0
    type(c_ptr) :: data = c_null_ptr
    integer(c_int64_t) :: dims(3) = 0
    integer(c_int64_t) :: strides(3) = 0
    real(c_double) :: origin(3) = 0
    real(c_double) :: spacing(3) = 0
    type(c_ptr) :: faces_x = c_null_ptr
    type(c_ptr) :: faces_y = c_null_ptr
    type(c_ptr) :: faces_z = c_null_ptr
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_options
    integer(c_int64_t) :: struct_size = 0
    integer(c_int32_t) :: placement = 0
    integer(c_int32_t) :: normals = 0
    integer(c_int32_t) :: boundary(6) = 0
    integer(c_int32_t) :: vertex_normals = 0
    integer(c_int32_t) :: edge_ids = 0
    real(c_double) :: purity_tolerance = 0
    real(c_double) :: overshoot_bound = 0
    real(c_double) :: clearance = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
    integer(c_int32_t) :: threads = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_report
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: cells = 0
    integer(c_int64_t) :: interfacial_cells = 0
    integer(c_int64_t) :: clamped_cells = 0
    real(c_double) :: largest_overshoot = 0
    real(c_double) :: fraction_volume = 0
    integer(c_int64_t) :: planes = 0
    integer(c_int64_t) :: height_function_cells = 0
    integer(c_int64_t) :: gradient_free_cells = 0
    integer(c_int64_t) :: solved_edges = 0
    real(c_double) :: newton_steps_mean = 0
    integer(c_int64_t) :: newton_steps_max = 0
    integer(c_int64_t) :: non_monotone_edges = 0
    real(c_double) :: enclosed_volume = 0
    real(c_double) :: seconds_classify = 0
    real(c_double) :: seconds_normals = 0
    real(c_double) :: seconds_count = 0
    real(c_double) :: seconds_vertices = 0
    real(c_double) :: seconds_triangles = 0
    real(c_double) :: seconds_total = 0
    integer(c_int32_t) :: closed = 0
    integer(c_int32_t) :: reserved = 0
    integer(c_int64_t) :: curved_cells = 0
    integer(c_int64_t) :: curved_vertices = 0
    integer(c_int64_t) :: moved_centres = 0
  end type

  type, bind(c), public :: dif_plane_arrays
    integer(c_int64_t) :: struct_size = 0
    type(c_ptr) :: normal_x = c_null_ptr
    type(c_ptr) :: normal_y = c_null_ptr
    type(c_ptr) :: normal_z = c_null_ptr
    type(c_ptr) :: offset = c_null_ptr
    type(c_ptr) :: source = c_null_ptr
    integer(c_int64_t) :: strides(3) = 0
  end type

  type, bind(c), public :: dif_surface_arrays
    integer(c_int64_t) :: struct_size = 0
    type(c_ptr) :: source = c_null_ptr
    type(c_ptr) :: axis = c_null_ptr
    type(c_ptr) :: foot = c_null_ptr
    type(c_ptr) :: normal = c_null_ptr
    type(c_ptr) :: mean = c_null_ptr
    type(c_ptr) :: gaussian = c_null_ptr
    type(c_ptr) :: largest = c_null_ptr
    type(c_ptr) :: smallest = c_null_ptr
    type(c_ptr) :: residual = c_null_ptr
    type(c_ptr) :: length = c_null_ptr
    type(c_ptr) :: frame = c_null_ptr
    type(c_ptr) :: coefficients = c_null_ptr
  end type

  type, bind(c), public :: dif_grid
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: dims(3) = 0
    real(c_double) :: origin(3) = 0
    real(c_double) :: spacing(3) = 0
    type(c_ptr) :: faces_x = c_null_ptr
    type(c_ptr) :: faces_y = c_null_ptr
    type(c_ptr) :: faces_z = c_null_ptr
  end type

  type, bind(c), public :: dif_function_options
    integer(c_int64_t) :: struct_size = 0
    real(c_double) :: tolerance = 0
    real(c_double) :: kink_tolerance = 0
    integer(c_int64_t) :: max_calls_per_cell = 0
    type(c_funptr) :: gradient = c_null_funptr
    type(c_ptr) :: gradient_user = c_null_ptr
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
    integer(c_int32_t) :: threads = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_function_report
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: interfacial_cells = 0
    integer(c_int64_t) :: sampled_cells = 0
    integer(c_int64_t) :: subdivided_cells = 0
    integer(c_int64_t) :: unresolved_cells = 0
    real(c_double) :: largest_error_estimate = 0
    integer(c_int64_t) :: function_calls = 0
    integer(c_int64_t) :: lattice_calls = 0
    integer(c_int64_t) :: gradient_calls = 0
    real(c_double) :: fraction_volume = 0
    real(c_double) :: seconds = 0
  end type

  type, bind(c), public :: dif_triangle_options
    integer(c_int64_t) :: struct_size = 0
    real(c_double) :: tolerance = 0
    integer(c_int32_t) :: flip = 0
    integer(c_int32_t) :: check_edges = 0
    integer(c_int32_t) :: threads = 0
    integer(c_int32_t) :: overlaps = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
  end type

  type, bind(c), public :: dif_triangle_report
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: pieces = 0
    integer(c_int64_t) :: cells_touched = 0
    real(c_double) :: lowest_raw = 0
    real(c_double) :: highest_raw = 0
    real(c_double) :: largest_gap = 0
    real(c_double) :: fraction_volume = 0
    real(c_double) :: mesh_volume = 0
    real(c_double) :: seconds = 0
    real(c_double) :: overlap_volume = 0
    integer(c_int64_t) :: overlap_cells = 0
    real(c_double) :: largest_overlap = 0
    integer(c_int64_t) :: overlap_cell(3) = 0
    real(c_double) :: overlap_low(3) = 0
    real(c_double) :: overlap_high(3) = 0
    real(c_double) :: inverted_volume = 0
    integer(c_int64_t) :: inverted_cells = 0
    real(c_double) :: undecided_volume = 0
    integer(c_int64_t) :: undecided_cells = 0
    real(c_double) :: largest_undecided = 0
    integer(c_int64_t) :: undecided_cell(3) = 0
  end type

  type, bind(c), public :: dif_shape_options
    integer(c_int64_t) :: struct_size = 0
    real(c_double) :: centre(3) = 0
    real(c_double) :: rotation_degrees(3) = 0
    real(c_double) :: radius = 0
    real(c_double) :: tube_radius = 0
    real(c_double) :: semi_axes(3) = 0
    real(c_double) :: exponent = 0
    real(c_double) :: scale = 0
    integer(c_int64_t) :: dimples = 0
    real(c_double) :: dimple_radius = 0
    real(c_double) :: dimple_depth = 0
    integer(c_int32_t) :: kind = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_mollify_options
    integer(c_int64_t) :: struct_size = 0
    real(c_double) :: radius = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
    integer(c_int32_t) :: boundary(6) = 0
    integer(c_int32_t) :: threads = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_measure
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: vertices = 0
    integer(c_int64_t) :: edges = 0
    integer(c_int64_t) :: triangles = 0
    integer(c_int64_t) :: components = 0
    integer(c_int64_t) :: isolated_vertices = 0
    integer(c_int64_t) :: boundary_edges = 0
    integer(c_int64_t) :: non_manifold_edges = 0
    integer(c_int64_t) :: misoriented_edges = 0
    integer(c_int64_t) :: non_manifold_vertices = 0
    integer(c_int64_t) :: degenerate_triangles = 0
    integer(c_int64_t) :: euler_number = 0
    integer(c_int32_t) :: closed = 0
    integer(c_int32_t) :: manifold = 0
    real(c_double) :: area = 0
    real(c_double) :: volume = 0
    real(c_double) :: low(3) = 0
    real(c_double) :: high(3) = 0
    integer(c_int64_t) :: unbalanced_edges = 0
    integer(c_int32_t) :: has_volume = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_distance_options
    integer(c_int64_t) :: struct_size = 0
    real(c_double) :: facet_spacing = 0
    integer(c_int32_t) :: with_sign = 0
    integer(c_int32_t) :: threads = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
  end type

  type, bind(c), public :: dif_statistics
    integer(c_int64_t) :: points = 0
    real(c_double) :: rms = 0
    real(c_double) :: mean = 0
    real(c_double) :: signed_mean = 0
    real(c_double) :: lowest = 0
    real(c_double) :: highest = 0
    real(c_double) :: maximum = 0
    integer(c_int64_t) :: maximum_index = 0
    real(c_double) :: maximum_position(3) = 0
  end type

  type, bind(c), public :: dif_distance
    integer(c_int64_t) :: struct_size = 0
    type(dif_statistics) :: vertices
    type(dif_statistics) :: facets
    real(c_double) :: area = 0
    real(c_double) :: reach = 0
    integer(c_int32_t) :: has_sign = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_curvature_options
    integer(c_int64_t) :: struct_size = 0
    integer(c_int32_t) :: rings = 0
    integer(c_int32_t) :: threads = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
  end type

  type, bind(c), public :: dif_smoothing_options
    integer(c_int64_t) :: struct_size = 0
    integer(c_int32_t) :: kind = 0
    integer(c_int32_t) :: steps = 0
    integer(c_int32_t) :: boundary = 0
    integer(c_int32_t) :: threads = 0
    real(c_double) :: factor = 0
    real(c_double) :: lambda = 0
    real(c_double) :: pass_band = 0
    real(c_double) :: time = 0
    real(c_double) :: residual = 0
    real(c_double) :: tolerance = 0
    real(c_double) :: clearance = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
  end type

  type, bind(c), public :: dif_mesh_write_options
    integer(c_int64_t) :: struct_size = 0
    type(c_ptr) :: format = c_null_ptr
    integer(c_int32_t) :: normals = 0
    integer(c_int32_t) :: edge_ids = 0
    integer(c_int32_t) :: scalars = 0
    integer(c_int32_t) :: draco = 0
    integer(c_int32_t) :: draco_method = 0
    integer(c_int32_t) :: draco_speed = 0
    integer(c_int32_t) :: position_bits = 0
    integer(c_int32_t) :: normal_bits = 0
    integer(c_int32_t) :: generic_bits = 0
    integer(c_int32_t) :: color_map = 0
    type(c_ptr) :: color_by = c_null_ptr
    real(c_double) :: color_range(2) = 0
    real(c_double) :: cell_size = 0
    real(c_double) :: metres_per_unit = 0
    real(c_double) :: local_origin(3) = 0
    integer(c_int32_t) :: has_local_origin = 0
    integer(c_int32_t) :: up = 0
    integer(c_int64_t) :: most_vertices = 0
    type(c_ptr) :: name = c_null_ptr
  end type

  type, bind(c), public :: dif_mesh_write_report
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: bytes = 0
    integer(c_int64_t) :: vertices = 0
    integer(c_int64_t) :: triangles = 0
    integer(c_int64_t) :: primitives = 0
    real(c_double) :: position_error = 0
    real(c_double) :: local_origin(3) = 0
    integer(c_int64_t) :: collapsed_triangles = 0
    type(c_ptr) :: warning = c_null_ptr
    integer(c_int32_t) :: position_bits = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_mesh_read_options
    integer(c_int64_t) :: struct_size = 0
    integer(c_int32_t) :: outside_files = 0
    integer(c_int32_t) :: reserved = 0
  end type

  type, bind(c), public :: dif_raw_layout
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: dims(3) = 0
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: big_endian = 0
    integer(c_int64_t) :: offset = 0
  end type

  type, bind(c), public :: dif_field_read_options
    integer(c_int64_t) :: struct_size = 0
    real(c_double) :: origin(3) = 0
    real(c_double) :: spacing(3) = 0
    integer(c_int32_t) :: has_origin = 0
    integer(c_int32_t) :: has_spacing = 0
    real(c_double) :: empty_value = 0
    real(c_double) :: full_value = 0
    integer(c_int32_t) :: has_full_value = 0
    integer(c_int32_t) :: outside_files = 0
    integer(c_int64_t) :: label_count = 0
    type(c_ptr) :: labels = c_null_ptr
  end type

  type, bind(c), public :: dif_field_write_options
    integer(c_int64_t) :: struct_size = 0
    integer(c_int32_t) :: format = 0
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: gzip = 0
    integer(c_int32_t) :: gzip_level = 0
  end type

  type, bind(c), public :: dif_block
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: offset(3) = 0
    integer(c_int64_t) :: dims(3) = 0
    integer(c_int64_t) :: ghost_low(3) = 0
    integer(c_int64_t) :: ghost_high(3) = 0
  end type

  ! What procedures have to be whose c_funloc() the library gets.
  abstract interface
    integer(c_int32_t) function dif_progress(user, share_done) bind(c)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: user
      real(c_double), value :: share_done
    end function

    integer(c_int32_t) function dif_function(user, count, points, values) bind(c)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: user
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: points(*)
      real(c_double), intent(inout) :: values(*)
    end function

    integer(c_int32_t) function dif_gradient(user, count, points, gradients) bind(c)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: user
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: points(*)
      real(c_double), intent(inout) :: gradients(*)
    end function
  end interface
  public :: dif_progress, dif_function, dif_gradient
end module
