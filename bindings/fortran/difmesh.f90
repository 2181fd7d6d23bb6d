! Surfaces from volume fractions. A program needs `use difmesh` and -ldifmesh:
!
!   use difmesh
!   real(8), target :: c(0:nx+1, 0:ny+1, 0:nz+1)       ! the solver's, with a layer of ghost cells
!   type(dif_mesh) :: mesh
!   real(8), allocatable :: points(:, :)
!   integer, allocatable :: triangles(:, :)
!   integer :: status
!   character(1000) :: message
!
!   call mesh%reconstruct(dif_view(c, spacing=[dx, dy, dz], ghosts=1), status, message=message)
!   if (status /= dif_ok) error stop trim(message)
!   call mesh%get_points(points, status)                ! points(3, n)
!   call mesh%get_triangles(triangles, status)          ! triangles(3, m), from 1
!   call mesh%write('surface.ply', status)
!
! What holds for difmesh.h holds here: units, ranges, errors, threads. Options are structs that
! dif_init prepares. Status and message are of the call; nothing here stops the program.
module difmesh
  use difmesh_types
  use difmesh_basics, only: dif_init, dif_message, dif_name_of_status, dif_library_version
  use difmesh_fields
  use difmesh_fractions
  use difmesh_meshes
  use difmesh_shapes
  implicit none
  public
end module
