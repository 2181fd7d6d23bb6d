! The functions of difmesh.h as they are: absent arguments are NULL, callbacks have interfaces.
module header_test
  use, intrinsic :: iso_c_binding
  use difmesh, only: dif_init, dif_make_grid
  use difmesh_c
  use difmesh_types
  use expect_module, only: expect, expect_near
  implicit none
  private
  public :: test_header

  real(8), parameter :: pi = acos(-1d0)

contains

  subroutine test_header()
    type(dif_plane_arrays) :: arrays
    type(c_ptr) :: ball
    real(8) :: volume, fractions(8, 8, 8)
    integer(c_int32_t) :: status
    procedure(dif_function), pointer :: distance
    call dif_init(arrays)
    call expect(arrays%struct_size == c_sizeof(arrays), 'arrays of planes are prepared')
    call expect(.not. c_associated(arrays%normal_x), 'without arrays')

    ball = c_null_ptr
    status = dif_shape_create(shape=ball)
    call expect(status == dif_ok, 'a shape without options')
    volume = 0
    status = dif_shape_volume(ball, volume)
    call expect_near(volume, 4*pi/3, 1d-14, 'is a ball of radius 1')
    call dif_shape_free(ball)

    distance => ball_distance
    fractions = 0
    status = dif_fractions_from_function(dif_make_grid([8, 8, 8]), c_funloc(distance), c_null_ptr, &
      fractions=fractions)
    call expect(status == dif_ok, 'fractions without options and report')
    call expect_near(sum(fractions), 4*pi/3*27, 1d-6, 'volume of a ball of radius 3')
  end subroutine

  integer(c_int32_t) function ball_distance(user, count, points, values) bind(c)
    type(c_ptr), value :: user
    integer(c_int64_t), value :: count
    real(c_double), intent(in) :: points(*)
    real(c_double), intent(inout) :: values(*)
    integer(c_int64_t) :: n
    do n = 1, count
      values(n) = norm2(points(3*n - 2:3*n) - 4) - 3
    end do
    ball_distance = merge(1, 0, c_associated(user))
  end function
end module
