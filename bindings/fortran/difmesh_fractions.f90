! Volume fractions of functions, shapes and meshes.
module difmesh_fractions
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_int32_t, c_int64_t, &
    c_loc, c_ptr, c_sizeof
  use difmesh_types
  use difmesh_c
  use difmesh_basics
  use difmesh_meshes, only: dif_mesh
  use difmesh_shapes, only: dif_shape
  implicit none
  private

  public :: dif_level_set, dif_fractions_of_function, dif_fractions_of_shape, dif_fractions_of_mesh
  public :: dif_plane_fractions, dif_plane_offsets

  abstract interface
    ! values(i) of f at points(:, i), < 0 inside.
    subroutine dif_level_set(points, values)
      import :: c_double
      real(c_double), intent(in) :: points(:, :)
      real(c_double), intent(out) :: values(:)
    end subroutine
  end interface

  type :: function_holder
    procedure(dif_level_set), pointer, nopass :: f => null()
  end type

contains

  ! Fractions of {f < 0} into fractions(nx, ny, nz); see dif_fractions_from_function in difmesh.h.
  ! f is called on one thread, unless options say otherwise. A section that is not contiguous is
  ! filled by way of a temporary array, here and in the other dif_sample_...
  subroutine dif_fractions_of_function(grid, f, fractions, status, options, report, message)
    type(dif_grid), intent(in) :: grid
    procedure(dif_level_set) :: f
    real(c_double), intent(inout), contiguous :: fractions(:, :, :)
    integer(c_int32_t), intent(out) :: status
    type(dif_function_options), intent(in), optional :: options
    type(dif_function_report), intent(out), optional :: report
    character(*), intent(inout), optional :: message
    type(dif_function_options) :: chosen
    type(function_holder), target :: holder
    if (.not. fits(grid, fractions, status, message)) return
    call dif_init(chosen)
    chosen%threads = 1
    if (present(options)) chosen = options
    if (present(report)) call dif_init(report)
    holder%f => f
    call finish(dif_fractions_from_function(grid, c_funloc(relay), c_loc(holder), chosen, report, &
      fractions), status, message)
  end subroutine

  integer(c_int32_t) function relay(user, count, points, values) bind(c)
    type(c_ptr), value :: user, points, values
    integer(c_int64_t), value :: count
    type(function_holder), pointer :: holder
    real(c_double), pointer :: places(:, :), numbers(:)
    call c_f_pointer(user, holder)
    call c_f_pointer(points, places, [3_c_int64_t, count])
    call c_f_pointer(values, numbers, [count])
    call holder%f(places, numbers)
    relay = 0
  end function

  subroutine dif_fractions_of_shape(grid, shape, fractions, status, options, report, message)
    type(dif_grid), intent(in) :: grid
    type(dif_shape), intent(in) :: shape
    real(c_double), intent(inout), contiguous :: fractions(:, :, :)
    integer(c_int32_t), intent(out) :: status
    type(dif_function_options), intent(in), optional :: options
    type(dif_function_report), intent(out), optional :: report
    character(*), intent(inout), optional :: message
    if (.not. fits(grid, fractions, status, message)) return
    if (present(report)) call dif_init(report)
    call finish(dif_fractions_from_shape(grid, shape%c_handle(), options, report, fractions), &
      status, message)
  end subroutine

  ! Exact fractions of the inside of a closed mesh. Where its parts overlap, options%overlaps
  ! decides; the report says how much and where.
  subroutine dif_fractions_of_mesh(grid, mesh, fractions, status, options, report, message)
    type(dif_grid), intent(in) :: grid
    type(dif_mesh), intent(in) :: mesh
    real(c_double), intent(inout), contiguous :: fractions(:, :, :)
    integer(c_int32_t), intent(out) :: status
    type(dif_triangle_options), intent(in), optional :: options
    type(dif_triangle_report), intent(out), optional :: report
    character(*), intent(inout), optional :: message
    if (.not. fits(grid, fractions, status, message)) return
    if (present(report)) call dif_init(report)
    call finish(dif_fractions_from_mesh(grid, mesh%c_handle(), options, report, fractions), &
      status, message)
  end subroutine

  logical function fits(grid, fractions, status, message)
    type(dif_grid), intent(in) :: grid
    real(c_double), intent(in) :: fractions(:, :, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    status = dif_ok
    fits = all(shape(fractions, c_int64_t) == grid%dims)
    if (.not. fits) call refuse('fractions must have the shape of the grid', status, message)
  end function

  ! Shares of cells below planes {x : normal . (x - centre) = offset}: normals(3, n), offsets(n).
  subroutine dif_plane_fractions(spacing, normals, offsets, fractions, status, message)
    real(c_double), intent(in) :: spacing(3), normals(:, :), offsets(:)
    real(c_double), intent(inout) :: fractions(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    if (.not. agree(shape(normals), size(offsets), size(fractions), status, message)) return
    call finish(dif_plane_fraction(spacing, size(offsets, kind=c_int64_t), normals, offsets, &
      fractions), status, message)
  end subroutine

  ! The inverse: offsets of planes below which these fractions of the cells lie.
  subroutine dif_plane_offsets(spacing, normals, fractions, offsets, status, message)
    real(c_double), intent(in) :: spacing(3), normals(:, :), fractions(:)
    real(c_double), intent(inout) :: offsets(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    if (.not. agree(shape(normals), size(offsets), size(fractions), status, message)) return
    call finish(dif_plane_offset(spacing, size(fractions, kind=c_int64_t), normals, fractions, &
      offsets), status, message)
  end subroutine

  logical function agree(normals, offsets, fractions, status, message)
    integer, intent(in) :: normals(2), offsets, fractions
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    status = dif_ok
    agree = normals(1) == 3 .and. normals(2) == offsets .and. offsets == fractions
    if (.not. agree) then
      call refuse('normals, offsets and fractions must have shapes (3, n), (n) and (n)', status, &
        message)
    end if
  end function
end module
