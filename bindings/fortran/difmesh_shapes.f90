! Built-in shapes.
module difmesh_shapes
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int32_t, c_int64_t, &
    c_null_ptr, c_ptr
  use difmesh_types
  use difmesh_c
  use difmesh_basics
  implicit none
  private

  ! A shape of the library, which frees itself. Assignment gives an empty one: it cannot be copied.
  type, public :: dif_shape
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, public :: create
    procedure, public :: bounds
    procedure, public :: volume
    procedure, public :: distances
    procedure, public :: c_handle
    procedure, private :: leave
    generic, public :: assignment(=) => leave
    final :: free
  end type

contains

  subroutine create(shape, options, status, message)
    class(dif_shape), intent(inout) :: shape
    type(dif_shape_options), intent(in) :: options
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(c_ptr) :: made
    call finish(dif_shape_create(options, made), status, message)
    if (status /= dif_ok) return
    call dif_shape_free(shape%handle)
    shape%handle = made
  end subroutine

  ! Corners of a box that encloses the shape.
  subroutine bounds(shape, low, high, status, message)
    class(dif_shape), intent(in) :: shape
    real(c_double), intent(inout) :: low(3), high(3)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    call finish(dif_shape_bounds(shape%handle, low, high), status, message)
  end subroutine

  subroutine volume(shape, inside, status, message)
    class(dif_shape), intent(in) :: shape
    real(c_double), intent(inout) :: inside
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    call finish(dif_shape_volume(shape%handle, inside), status, message)
  end subroutine

  ! Signed distances(n) of points(3, n) to the surface, < 0 inside.
  subroutine distances(shape, points, values, status, message)
    class(dif_shape), intent(in) :: shape
    real(c_double), intent(in) :: points(:, :)
    real(c_double), intent(inout) :: values(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    if (size(points, 1) /= 3 .or. size(points, 2) /= size(values)) then
      call refuse('points and distances must have shapes (3, n) and (n)', status, message)
      return
    end if
    call finish(dif_shape_distances(shape%handle, size(values, kind=c_int64_t), points, values), &
      status, message)
  end subroutine

  type(c_ptr) function c_handle(shape)
    class(dif_shape), intent(in) :: shape
    c_handle = shape%handle
  end function

  subroutine leave(shape, from)
    class(dif_shape), intent(inout) :: shape
    type(dif_shape), intent(in) :: from
    if (c_associated(from%handle, shape%handle)) return
    call dif_shape_free(shape%handle)
    shape%handle = c_null_ptr
  end subroutine

  impure elemental subroutine free(shape)
    type(dif_shape), intent(inout) :: shape
    call dif_shape_free(shape%handle)
    shape%handle = c_null_ptr
  end subroutine
end module
