! Written by scripts/generate_bindings.py from difmesh.h; do not edit, run that again.
! The preparation of structs.
module difmesh_init
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_sizeof
  use difmesh_types
  use difmesh_c
  implicit none
  private

  public :: dif_init

  ! Prepares a struct, with the defaults of the library where it holds options. A
  ! library of another interface may refuse; struct_size then stays 0, and calls with it
  ! say so.
  interface dif_init
    module procedure init_options, init_report, init_plane_arrays, init_surface_arrays, &
      init_function_options, init_function_report, init_triangle_options, init_triangle_report, &
      init_shape_options, init_mollify_options, init_measure, init_distance_options, &
      init_distance, init_curvature_options, init_smoothing_options, init_mesh_write_options, &
      init_mesh_write_report, init_mesh_read_options, init_raw_layout, init_field_read_options, &
      init_field_write_options, init_block
  end interface

contains

  subroutine init_options(struct)
    type(dif_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_report(struct)
    type(dif_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_plane_arrays(struct)
    type(dif_plane_arrays), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_plane_arrays_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_surface_arrays(struct)
    type(dif_surface_arrays), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_surface_arrays_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_function_options(struct)
    type(dif_function_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_function_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_function_report(struct)
    type(dif_function_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_function_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_triangle_options(struct)
    type(dif_triangle_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_triangle_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_triangle_report(struct)
    type(dif_triangle_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_triangle_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_shape_options(struct)
    type(dif_shape_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_shape_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mollify_options(struct)
    type(dif_mollify_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mollify_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_measure(struct)
    type(dif_measure), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_measure_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_distance_options(struct)
    type(dif_distance_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_distance_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_distance(struct)
    type(dif_distance), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_distance_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_curvature_options(struct)
    type(dif_curvature_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_curvature_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_smoothing_options(struct)
    type(dif_smoothing_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_smoothing_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mesh_write_options(struct)
    type(dif_mesh_write_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mesh_write_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mesh_write_report(struct)
    type(dif_mesh_write_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mesh_write_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mesh_read_options(struct)
    type(dif_mesh_read_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mesh_read_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_raw_layout(struct)
    type(dif_raw_layout), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_raw_layout_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_field_read_options(struct)
    type(dif_field_read_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_field_read_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_field_write_options(struct)
    type(dif_field_write_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_field_write_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_block(struct)
    type(dif_block), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_block_init(struct, c_sizeof(struct))
  end subroutine

end module
