! What the tests of the Fortran module share.
module expect_module
  use difmesh
  implicit none
  private
  public :: expect, expect_same, expect_near, ball, inspect, failures

  integer, protected :: failures = 0

contains

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(*), intent(in) :: what
    if (holds) return
    failures = failures + 1
    print '(2a)', 'FAILED: ', what
  end subroutine

  subroutine expect_near(value, expected, tolerance, what)
    real(8), intent(in) :: value, expected, tolerance
    character(*), intent(in) :: what
    call expect(abs(value - expected) <= tolerance, what)
    if (.not. abs(value - expected) <= tolerance) print *, value, ' is not ', expected
  end subroutine

  ! A ball with a ramp one cell wide, without symmetry.
  function ball(nx, ny, nz) result(c)
    integer, intent(in) :: nx, ny, nz
    real(8) :: c(nx, ny, nz)
    integer :: i, j, k
    do k = 1, nz
      do j = 1, ny
        do i = 1, nx
          c(i, j, k) = 0.5d0 + 6.2d0 - norm2([i, j, k] - 0.5d0 - [12.3d0, 9.1d0, 10.4d0])
        end do
      end do
    end do
    c = min(max(c, 0d0), 1d0)
  end function

  ! The same mesh to the last bit.
  subroutine expect_same(mesh, other, what)
    type(dif_mesh), intent(in) :: mesh, other
    character(*), intent(in) :: what
    real(8), allocatable :: points(:, :), other_points(:, :)
    integer, allocatable :: triangles(:, :), other_triangles(:, :)
    integer :: status
    call mesh%get_points(points, status)
    call other%get_points(other_points, status)
    call mesh%get_triangles(triangles, status)
    call other%get_triangles(other_triangles, status)
    call expect(size(points) > 0, what//': points')
    call expect(all(shape(points) == shape(other_points)), what//': as many points')
    call expect(all(shape(triangles) == shape(other_triangles)), what//': as many triangles')
    if (any(shape(points) /= shape(other_points))) return
    if (any(shape(triangles) /= shape(other_triangles))) return
    call expect(all(transfer(points, [0_8]) == transfer(other_points, [0_8])), what//': points')
    call expect(all(triangles == other_triangles), what//': triangles')
  end subroutine

  ! Reconstructs a view and compares with a mesh.
  subroutine inspect(field, expected, what)
    type(dif_field), intent(in) :: field
    type(dif_mesh), intent(in) :: expected
    character(*), intent(in) :: what
    type(dif_mesh) :: mesh
    character(1000) :: message
    integer :: status
    message = ''
    call mesh%reconstruct(field, status, message=message)
    call expect(status == dif_ok, what//': '//trim(message))
    call expect_same(mesh, expected, what)
  end subroutine
end module
