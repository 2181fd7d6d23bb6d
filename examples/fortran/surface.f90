! A flow solver's array with ghost layers, filled from a file, and the surface of what is in it:
!   surface FIELD.nrrd SURFACE.ply
program surface
  use difmesh
  implicit none
  character(1000) :: from, to
  if (command_argument_count() /= 2) error stop 'usage: surface FIELD SURFACE'
  call get_command_argument(1, from)
  call get_command_argument(2, to)
  call run(from, to)

contains

  subroutine run(from, to)
    character(*), intent(in) :: from, to
    real(8), allocatable, target :: c(:, :, :)
    real(8), allocatable :: fractions(:, :, :), points(:, :)
    integer, allocatable :: triangles(:, :)
    type(dif_field_file) :: file
    type(dif_field) :: field
    type(dif_mesh) :: mesh
    type(dif_report) :: report
    character(1000) :: message
    integer :: status, nx, ny, nz

    call file%read(from, status, message=message)
    if (status == dif_ok) call file%view(field, status, message)
    if (status == dif_ok) call file%get_fractions(fractions, status, message)
    if (status /= dif_ok) error stop trim(message)

    ! In a solver c is there already. It is not copied: the ghost layers are cut off by strides.
    nx = size(fractions, 1)
    ny = size(fractions, 2)
    nz = size(fractions, 3)
    allocate (c(0:nx + 1, 0:ny + 1, 0:nz + 1), source=-1d0)  ! no fraction
    c(1:nx, 1:ny, 1:nz) = fractions
    field = dif_view(c, spacing=field%spacing, origin=field%origin, ghosts=1)

    call mesh%reconstruct(field, status, message=message)
    if (status == dif_ok) call mesh%get_report(report, status, message)
    if (status == dif_ok) call mesh%get_points(points, status, message)
    if (status == dif_ok) call mesh%get_triangles(triangles, status, message)
    if (status == dif_ok) call mesh%write(to, status, message=message)
    if (status /= dif_ok) error stop trim(message)
    print '(i0, a, i0, a, es17.10)', size(points, 2), ' points, ', size(triangles, 2), &
      ' triangles, volume', report%enclosed_volume
    print '(a, 3f9.5)', 'first corner of the first triangle:', points(:, triangles(1, 1))
  end subroutine
end program
