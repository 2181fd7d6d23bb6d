! Triangle meshes.
module difmesh_meshes
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_float, &
    c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr, c_sizeof
  use difmesh_types
  use difmesh_c
  use difmesh_basics
  use difmesh_shapes, only: dif_shape
  implicit none
  private

  ! A mesh of the library, which frees itself. Triangles are counter-clockwise seen from the empty
  ! side. Assignment copies it, without its report. All procedures but clear() and the counts have a
  ! status, dif_ok or one of dif_error_..., and can give the message that says what is wrong; those
  ! that make a mesh leave it as it was if they fail.
  type, public :: dif_mesh
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    ! Making it.
    procedure, public :: reconstruct
    procedure, public :: reconstruct_block
    procedure, public :: weld
    procedure, public :: set_arrays
    procedure, public :: smooth
    procedure, public :: read => read_file
    procedure, public :: clear
    ! Its arrays: get_...() allocate copies.
    procedure, public :: vertex_count
    procedure, public :: triangle_count
    procedure, private :: get_points_real64, get_points_real32
    generic, public :: get_points => get_points_real64, get_points_real32
    procedure, private :: get_normals_real64, get_normals_real32
    generic, public :: get_normals => get_normals_real64, get_normals_real32
    procedure, private :: get_triangles_int32, get_triangles_int64
    generic, public :: get_triangles => get_triangles_int32, get_triangles_int64
    procedure, public :: get_edge_ids
    procedure, public :: borrow_points
    ! Numbers of your own that go with the vertices, by name.
    procedure, public :: set_scalars
    procedure, public :: get_scalars
    procedure, public :: scalars_name
    ! Facts about it.
    procedure, public :: get_warnings
    procedure, public :: get_report
    procedure, public :: measure
    procedure, public :: get_curvature
    procedure, private :: distance_to_mesh, distance_to_shape
    generic, public :: distance_to => distance_to_mesh, distance_to_shape
    procedure, public :: write => write_file
    ! For the module difmesh_c.
    procedure, public :: c_handle
    procedure, private :: copy
    generic, public :: assignment(=) => copy
    final :: free
  end type

contains

  ! The surface of a field; see dif_reconstruct in difmesh.h.
  subroutine reconstruct(mesh, field, status, options, message)
    class(dif_mesh), intent(inout) :: mesh
    type(dif_field), intent(in) :: field
    integer(c_int32_t), intent(out) :: status
    type(dif_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    type(c_ptr) :: made
    call finish(dif_reconstruct(field, options, made), status, message)
    call take(mesh, made, status)
  end subroutine

  ! The surface of a block of a larger grid, for weld(). Experimental.
  subroutine reconstruct_block(mesh, field, block, grid, status, options, message)
    class(dif_mesh), intent(inout) :: mesh
    type(dif_field), intent(in) :: field
    type(dif_block), intent(in) :: block
    type(dif_grid), intent(in) :: grid
    integer(c_int32_t), intent(out) :: status
    type(dif_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    type(c_ptr) :: made
    call finish(dif_reconstruct_block(field, block, grid, options, made), status, message)
    call take(mesh, made, status)
  end subroutine

  ! Joins the meshes of disjoint blocks of a grid; others are refused. Experimental.
  subroutine weld(mesh, parts, grid, status, message)
    class(dif_mesh), intent(inout) :: mesh
    type(dif_mesh), intent(in) :: parts(:)
    type(dif_grid), intent(in) :: grid
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(c_ptr) :: made
    call finish(dif_mesh_weld(parts%handle, size(parts, kind=c_int64_t), grid, made), &
      status, message)
    call take(mesh, made, status)
  end subroutine

  ! Another mesh with its vertices moved, with normals of the smooth surface if it has normals,
  ! without scalars; see dif_mesh_smooth in difmesh.h. dif_smoothing_constrained needs the grid of
  ! the reconstruction.
  subroutine smooth(mesh, from, status, options, grid, message)
    class(dif_mesh), intent(inout) :: mesh
    type(dif_mesh), intent(in) :: from
    integer(c_int32_t), intent(out) :: status
    type(dif_smoothing_options), intent(in), optional :: options
    type(dif_grid), intent(in), optional :: grid
    character(*), intent(inout), optional :: message
    type(c_ptr) :: made
    call finish(dif_mesh_smooth(from%handle, grid, options, made), status, message)
    call take(mesh, made, status)
  end subroutine

  ! Copies points(3, n) and triangles(3, m), whose indices count from 1.
  subroutine set_arrays(mesh, points, triangles, status, message)
    class(dif_mesh), intent(inout) :: mesh
    real(c_double), intent(in) :: points(:, :)
    integer(c_int32_t), intent(in) :: triangles(:, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(c_ptr) :: made
    if (size(points, 1) /= 3 .or. size(triangles, 1) /= 3) then
      call refuse('points and triangles must have shapes (3, n) and (3, m)', status, message)
      return
    end if
    if (any(triangles < 1 .or. triangles > size(points, 2))) then
      call refuse('triangles refer to vertices that are not there', status, message)
      return
    end if
    call finish(dif_mesh_from_arrays(points, size(points, 2, c_int64_t), triangles - 1, &
      size(triangles, 2, c_int64_t), made), status, message)
    call take(mesh, made, status)
  end subroutine

  ! From .ply, .obj, .off, .stl, .glb, .gltf or .drc.
  subroutine read_file(mesh, path, status, message, options)
    class(dif_mesh), intent(inout) :: mesh
    character(*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(dif_mesh_read_options), intent(in), optional :: options
    type(c_ptr) :: made
    call finish(dif_mesh_read_with(to_c(path), options, made), status, message)
    call take(mesh, made, status)
  end subroutine

  subroutine take(mesh, made, status)
    class(dif_mesh), intent(inout) :: mesh
    type(c_ptr), intent(in) :: made
    integer(c_int32_t), intent(in) :: status
    if (status /= dif_ok) return
    call mesh%clear()
    mesh%handle = made
  end subroutine

  ! Frees its memory; what was borrowed must not be used any more.
  subroutine clear(mesh)
    class(dif_mesh), intent(inout) :: mesh
    call dif_mesh_free(mesh%handle)
    mesh%handle = c_null_ptr
  end subroutine

  impure elemental subroutine free(mesh)
    type(dif_mesh), intent(inout) :: mesh
    call mesh%clear()
  end subroutine

  subroutine copy(mesh, from)
    class(dif_mesh), intent(inout) :: mesh
    type(dif_mesh), intent(in) :: from
    type(c_ptr) :: made, at
    integer(c_int64_t) :: vertices, triangles, count
    real(c_double), pointer :: numbers(:)
    integer(c_int32_t), pointer :: corners(:)
    integer(c_int64_t), pointer :: names(:)
    real(c_double), target :: no_numbers(0)
    integer(c_int32_t), target :: no_corners(0)
    integer(c_int32_t) :: status
    if (c_associated(from%handle, mesh%handle)) return
    call mesh%clear()
    if (.not. c_associated(from%handle)) return
    numbers => no_numbers
    corners => no_corners
    status = dif_mesh_positions(from%handle, at, vertices)
    if (vertices > 0) call c_f_pointer(at, numbers, [3*vertices])
    status = dif_mesh_triangles(from%handle, at, triangles)
    if (triangles > 0) call c_f_pointer(at, corners, [3*triangles])
    status = dif_mesh_from_arrays(numbers, vertices, corners, triangles, made)
    if (status /= dif_ok) return  ! out of memory: an empty mesh
    mesh%handle = made
    status = dif_mesh_normals(from%handle, at, count)
    if (count > 0) then
      call c_f_pointer(at, numbers, [3*count])
      status = dif_mesh_set_normals(made, numbers)
    end if
    status = dif_mesh_edge_ids(from%handle, at, count)
    if (count > 0) then
      call c_f_pointer(at, names, [count])
      status = dif_mesh_set_edge_ids(made, names)
    end if
    call copy_scalars(mesh, from)
  end subroutine

  subroutine copy_scalars(mesh, from)
    class(dif_mesh), intent(inout) :: mesh
    type(dif_mesh), intent(in) :: from
    character(:), allocatable :: name
    real(c_double), allocatable :: values(:)
    integer(c_int32_t) :: status
    integer :: n
    n = 1
    do
      name = from%scalars_name(n)
      if (name == '') return
      call from%get_scalars(name, values, status)
      if (status == dif_ok) call mesh%set_scalars(name, values, status)
      n = n + 1
    end do
  end subroutine

  integer(c_int64_t) function vertex_count(mesh)
    class(dif_mesh), intent(in) :: mesh
    type(c_ptr) :: ignored
    if (dif_mesh_positions(mesh%handle, ignored, vertex_count) /= dif_ok) vertex_count = 0
  end function

  integer(c_int64_t) function triangle_count(mesh)
    class(dif_mesh), intent(in) :: mesh
    type(c_ptr) :: ignored
    if (dif_mesh_triangles(mesh%handle, ignored, triangle_count) /= dif_ok) triangle_count = 0
  end function

  ! Coordinates, points(3, n).
  subroutine get_points_real64(mesh, points, status, message)
    class(dif_mesh), intent(in) :: mesh
    real(c_double), allocatable, target, intent(out) :: points(:, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    integer :: code
    allocate (points(3, mesh%vertex_count()), stat=code)
    if (no_room(code, status, message)) return
    call finish(dif_mesh_copy_positions(mesh%handle, dif_float64, 3_c_int64_t, &
      size(points, kind=c_int64_t), c_loc(points)), status, message)
  end subroutine

  subroutine get_points_real32(mesh, points, status, message)
    class(dif_mesh), intent(in) :: mesh
    real(c_float), allocatable, target, intent(out) :: points(:, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    integer :: code
    allocate (points(3, mesh%vertex_count()), stat=code)
    if (no_room(code, status, message)) return
    call finish(dif_mesh_copy_positions(mesh%handle, dif_float32, 3_c_int64_t, &
      size(points, kind=c_int64_t), c_loc(points)), status, message)
  end subroutine

  ! Unit normals at the vertices, normals(3, n); see options%vertex_normals.
  subroutine get_normals_real64(mesh, normals, status, message)
    class(dif_mesh), intent(in) :: mesh
    real(c_double), allocatable, target, intent(out) :: normals(:, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    integer :: code
    allocate (normals(3, mesh%vertex_count()), stat=code)
    if (no_room(code, status, message)) return
    call finish(dif_mesh_copy_normals(mesh%handle, dif_float64, 3_c_int64_t, &
      size(normals, kind=c_int64_t), c_loc(normals)), status, message)
  end subroutine

  subroutine get_normals_real32(mesh, normals, status, message)
    class(dif_mesh), intent(in) :: mesh
    real(c_float), allocatable, target, intent(out) :: normals(:, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    integer :: code
    allocate (normals(3, mesh%vertex_count()), stat=code)
    if (no_room(code, status, message)) return
    call finish(dif_mesh_copy_normals(mesh%handle, dif_float32, 3_c_int64_t, &
      size(normals, kind=c_int64_t), c_loc(normals)), status, message)
  end subroutine

  ! Indices of the triangles' vertices, triangles(3, m), from 1.
  subroutine get_triangles_int32(mesh, triangles, status, message)
    class(dif_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, target, intent(out) :: triangles(:, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    integer :: code
    allocate (triangles(3, mesh%triangle_count()), stat=code)
    if (no_room(code, status, message)) return
    call finish(dif_mesh_copy_triangles(mesh%handle, dif_int32, 1_c_int64_t, 3_c_int64_t, &
      size(triangles, kind=c_int64_t), c_loc(triangles)), status, message)
  end subroutine

  subroutine get_triangles_int64(mesh, triangles, status, message)
    class(dif_mesh), intent(in) :: mesh
    integer(c_int64_t), allocatable, target, intent(out) :: triangles(:, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    integer :: code
    allocate (triangles(3, mesh%triangle_count()), stat=code)
    if (no_room(code, status, message)) return
    call finish(dif_mesh_copy_triangles(mesh%handle, dif_int64, 1_c_int64_t, 3_c_int64_t, &
      size(triangles, kind=c_int64_t), c_loc(triangles)), status, message)
  end subroutine

  ! Names of the vertices' edges, as difmesh.h has them, so counted from 0; of size 0 if the mesh
  ! has none: see options%edge_ids.
  subroutine get_edge_ids(mesh, ids, status, message)
    class(dif_mesh), intent(in) :: mesh
    integer(c_int64_t), allocatable, intent(out) :: ids(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(c_ptr) :: at
    integer(c_int64_t) :: count
    integer(c_int64_t), pointer :: names(:)
    integer :: code
    call finish(dif_mesh_edge_ids(mesh%handle, at, count), status, message)
    if (status /= dif_ok) return
    allocate (ids(count), stat=code)
    if (no_room(code, status, message) .or. count == 0) return
    call c_f_pointer(at, names, [count])
    ids = names
  end subroutine

  ! The mesh's own points(3, n), until it is cleared or another is made; not associated if there
  ! are none.
  function borrow_points(mesh) result(points)
    class(dif_mesh), intent(in) :: mesh
    real(c_double), pointer :: points(:, :)
    type(c_ptr) :: at
    integer(c_int64_t) :: count
    nullify (points)
    if (dif_mesh_positions(mesh%handle, at, count) /= dif_ok) return
    if (count > 0) call c_f_pointer(at, points, [3_c_int64_t, count])
  end function

  ! Numbers that go with the vertices, values(n), in place of those of the same name; without
  ! values these are removed. Names are letters, digits and underscores. PLY, glTF and Draco files
  ! take scalars, and read() brings them.
  subroutine set_scalars(mesh, name, values, status, message)
    class(dif_mesh), intent(inout) :: mesh
    character(*), intent(in) :: name
    real(c_double), intent(in), optional :: values(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    if (present(values)) then
      if (size(values, kind=c_int64_t) /= mesh%vertex_count()) then
        call refuse('values must have one element per vertex', status, message)
        return
      end if
    end if
    call finish(dif_mesh_set_scalars(mesh%handle, to_c(name), values), status, message)
  end subroutine

  ! The scalars of a name; of size 0 if the mesh has none of it.
  subroutine get_scalars(mesh, name, values, status, message)
    class(dif_mesh), intent(in) :: mesh
    character(*), intent(in) :: name
    real(c_double), allocatable, intent(out) :: values(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(c_ptr) :: at
    integer(c_int64_t) :: count
    real(c_double), pointer :: numbers(:)
    integer :: code
    call finish(dif_mesh_scalars(mesh%handle, to_c(name), at, count), status, message)
    if (status /= dif_ok) return
    allocate (values(count), stat=code)
    if (no_room(code, status, message) .or. count == 0) return
    call c_f_pointer(at, numbers, [count])
    values = numbers
  end subroutine

  ! The name of the scalars number `index`, from 1; '' from their count on.
  function scalars_name(mesh, index) result(name)
    class(dif_mesh), intent(in) :: mesh
    integer, intent(in) :: index
    character(:), allocatable :: name
    type(c_ptr) :: text
    name = ''
    if (dif_mesh_scalars_name(mesh%handle, index - 1_c_int64_t, text) /= dif_ok) return
    if (c_associated(text)) name = from_c(text)
  end function

  ! What read() left out of the file or took otherwise than it says, and what reconstruct() says of
  ! values that look like a mask, one sentence each of at most 1000 characters; of size 0 if there
  ! is nothing to tell.
  subroutine get_warnings(mesh, warnings, status, message)
    class(dif_mesh), intent(in) :: mesh
    character(*), allocatable, intent(out) :: warnings(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    call get_list(mesh%handle, dif_mesh_warning, warnings, status, message)
  end subroutine

  ! Facts about a reconstruction.
  subroutine get_report(mesh, report, status, message)
    class(dif_mesh), intent(in) :: mesh
    type(dif_report), intent(out) :: report
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    call dif_init(report)
    call finish(dif_mesh_report(mesh%handle, report), status, message)
  end subroutine

  ! Facts about any mesh.
  subroutine measure(mesh, facts, status, message)
    class(dif_mesh), intent(in) :: mesh
    type(dif_measure), intent(out) :: facts
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    call dif_init(facts)
    call finish(dif_mesh_measure(mesh%handle, facts), status, message)
  end subroutine

  ! Mean and Gaussian curvature at the vertices, mean(n) and gaussian(n), NaN where there is none.
  subroutine get_curvature(mesh, mean, gaussian, status, options, message)
    class(dif_mesh), intent(in) :: mesh
    real(c_double), allocatable, intent(out) :: mean(:), gaussian(:)
    integer(c_int32_t), intent(out) :: status
    type(dif_curvature_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    integer(c_int64_t) :: n
    integer :: code
    n = mesh%vertex_count()
    allocate (mean(n), gaussian(n), stat=code)
    if (no_room(code, status, message)) return
    call finish(dif_mesh_curvature(mesh%handle, options, mean, gaussian), status, message)
  end subroutine

  subroutine distance_to_mesh(mesh, reference, distance, status, options, message)
    class(dif_mesh), intent(in) :: mesh
    type(dif_mesh), intent(in) :: reference
    type(dif_distance), intent(out) :: distance
    integer(c_int32_t), intent(out) :: status
    type(dif_distance_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    call dif_init(distance)
    call finish(dif_distance_to_mesh(mesh%handle, reference%handle, options, distance), &
      status, message)
  end subroutine

  subroutine distance_to_shape(mesh, shape, distance, status, options, message)
    class(dif_mesh), intent(in) :: mesh
    type(dif_shape), intent(in) :: shape
    type(dif_distance), intent(out) :: distance
    integer(c_int32_t), intent(out) :: status
    type(dif_distance_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    call dif_init(distance)
    call finish(dif_distance_to_shape(mesh%handle, shape%c_handle(), options, distance), &
      status, message)
  end subroutine

  ! To .ply (double precision), .obj, .off, .stl, .glb, .gltf or .drc, by the extension or by
  ! `format`, such as 'ply'. `color_by`, the name of scalars, and `name` are for glTF; all three
  ! come before those of the options. `report` tells what was written; if that fails it is as
  ! dif_init leaves it. `warning` is what a user should know though the file is there, or ''; up to
  ! 1000 characters.
  subroutine write_file(mesh, path, status, options, message, color_by, name, report, format, &
    warning)
    class(dif_mesh), intent(in) :: mesh
    character(*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    type(dif_mesh_write_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    character(*), intent(in), optional :: color_by, name, format
    type(dif_mesh_write_report), intent(out), optional :: report
    character(*), intent(out), optional :: warning
    type(dif_mesh_write_report) :: facts
    type(dif_mesh_write_options) :: given
    character(kind=c_char), allocatable, target :: scalars(:), title(:), extension(:)
    call dif_init(given)
    if (present(options)) given = options
    if (present(color_by)) then
      scalars = to_c(color_by)
      given%color_by = c_loc(scalars)
    end if
    if (present(format)) then
      extension = to_c(format)
      given%format = c_loc(extension)
    end if
    if (present(name)) then
      title = to_c(name)
      given%name = c_loc(title)
    end if
    call dif_init(facts)
    call finish(dif_mesh_write(mesh%handle, to_c(path), given, facts), status, message)
    if (present(report)) report = facts
    if (.not. present(warning)) return
    warning = ''
    if (c_associated(facts%warning)) warning = from_c(facts%warning)
  end subroutine

  type(c_ptr) function c_handle(mesh)
    class(dif_mesh), intent(in) :: mesh
    c_handle = mesh%handle
  end function
end module
