! Fields of volume fractions: views of the solver's arrays, files, and the planes in their cells.
module difmesh_fields
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_float, c_int8_t, &
    c_int16_t, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr, c_sizeof
  use difmesh_types
  use difmesh_c
  use difmesh_basics
  implicit none
  private

  public :: dif_view, dif_make_grid, dif_set_faces, dif_planes, dif_curvature, dif_mollified
  public :: dif_write_field, dif_fractions_of_values, dif_fractions_of_labels

  ! field = dif_view(c, spacing, origin, ghosts): what the library is told of a solver's array
  ! c(i, j, k) of real(8), real(4), or 1- or 2-byte integers, whose bits count as unsigned, 0 to 255
  ! or 65535. Nothing is copied: c must have the TARGET attribute, be a variable or a section of one
  ! by subscript triplets, and stay where it is as long as the view is in use. `ghosts` layers of
  ! cells are cut off at all sides; where they differ, give a section, c(1:nx, 1:ny, 1:nz).
  ! Not so cells%c: of a component of an array of structures compilers pass a temporary copy, which
  ! is gone when the view is used. Set the view's data and strides by hand then:
  !   field%data = c_loc(cells(1, 1, 1)%c)
  !   field%strides = storage_size(cells)/storage_size(cells%c)*[1, nx, nx*ny]
  ! spacing: edges of a cell, 1 by default; origin: low corner of the first cell inside, 0.
  ! An array without cells gives a view that the library refuses.
  ! Integers of 4 and 8 bytes are values, such as labels, of which dif_fractions_of_values and
  ! dif_fractions_of_labels make fractions.
  interface dif_view
    module procedure view_real64, view_real32, view_uint8, view_uint16, view_int32, view_int64
  end interface

  ! call dif_set_faces(field, x, y, z), of a field or a grid: stretched axes, each by its faces
  ! between cells, one more than there are cells, strictly increasing, in place of spacing and
  ! origin. Nothing is copied: the arrays must have the TARGET attribute, lie without gaps, and
  ! stay where they are as long as the field or grid is in use. An axis that is left out stays
  ! uniform; a table of another length makes a field without cells, which the library refuses.
  interface dif_set_faces
    module procedure set_faces_of_field, set_faces_of_grid
  end interface

  ! The solver's arrays, or sections without ghost layers, that dif_planes is to fill; all with the
  ! same distances between elements. Those not associated are left out.
  type, public :: dif_plane_targets
    real(c_double), pointer :: normal_x(:, :, :) => null()
    real(c_double), pointer :: normal_y(:, :, :) => null()
    real(c_double), pointer :: normal_z(:, :, :) => null()
    real(c_double), pointer :: offset(:, :, :) => null()
    integer(c_int32_t), pointer :: source(:, :, :) => null()  ! dif_source_...
  end type

  ! A field read from a file, which frees itself. Assignment gives an empty one.
  type, public :: dif_field_file
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, public :: read => read_file
    procedure, public :: view => view_file
    procedure, public :: get_fractions
    procedure, public :: get_warnings
    procedure, private :: leave
    generic, public :: assignment(=) => leave
    final :: free
  end type

contains

  function view_real64(c, spacing, origin, ghosts) result(field)
    real(c_double), intent(in), target :: c(:, :, :)
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    integer, intent(in), optional :: ghosts
    type(dif_field) :: field
    integer :: i, n(3)
    call describe(field, dif_float64, shape(c, c_int64_t), ghosts)
    call set_place(field, spacing, origin)
    if (any(field%dims < 1)) return
    i = first_inside(ghosts)
    n = merge(i + 1, i, field%dims > 1)
    call set_data(field, c_loc(c(i, i, i)), &
      [c_loc(c(n(1), i, i)), c_loc(c(i, n(2), i)), c_loc(c(i, i, n(3)))])
  end function

  function view_real32(c, spacing, origin, ghosts) result(field)
    real(c_float), intent(in), target :: c(:, :, :)
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    integer, intent(in), optional :: ghosts
    type(dif_field) :: field
    integer :: i, n(3)
    call describe(field, dif_float32, shape(c, c_int64_t), ghosts)
    call set_place(field, spacing, origin)
    if (any(field%dims < 1)) return
    i = first_inside(ghosts)
    n = merge(i + 1, i, field%dims > 1)
    call set_data(field, c_loc(c(i, i, i)), &
      [c_loc(c(n(1), i, i)), c_loc(c(i, n(2), i)), c_loc(c(i, i, n(3)))])
  end function

  function view_uint8(c, spacing, origin, ghosts) result(field)
    integer(c_int8_t), intent(in), target :: c(:, :, :)
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    integer, intent(in), optional :: ghosts
    type(dif_field) :: field
    integer :: i, n(3)
    call describe(field, dif_uint8, shape(c, c_int64_t), ghosts)
    call set_place(field, spacing, origin)
    if (any(field%dims < 1)) return
    i = first_inside(ghosts)
    n = merge(i + 1, i, field%dims > 1)
    call set_data(field, c_loc(c(i, i, i)), &
      [c_loc(c(n(1), i, i)), c_loc(c(i, n(2), i)), c_loc(c(i, i, n(3)))])
  end function

  function view_uint16(c, spacing, origin, ghosts) result(field)
    integer(c_int16_t), intent(in), target :: c(:, :, :)
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    integer, intent(in), optional :: ghosts
    type(dif_field) :: field
    integer :: i, n(3)
    call describe(field, dif_uint16, shape(c, c_int64_t), ghosts)
    call set_place(field, spacing, origin)
    if (any(field%dims < 1)) return
    i = first_inside(ghosts)
    n = merge(i + 1, i, field%dims > 1)
    call set_data(field, c_loc(c(i, i, i)), &
      [c_loc(c(n(1), i, i)), c_loc(c(i, n(2), i)), c_loc(c(i, i, n(3)))])
  end function

  function view_int32(c, spacing, origin, ghosts) result(field)
    integer(c_int32_t), intent(in), target :: c(:, :, :)
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    integer, intent(in), optional :: ghosts
    type(dif_field) :: field
    integer :: i, n(3)
    call describe(field, dif_int32, shape(c, c_int64_t), ghosts)
    call set_place(field, spacing, origin)
    if (any(field%dims < 1)) return
    i = first_inside(ghosts)
    n = merge(i + 1, i, field%dims > 1)
    call set_data(field, c_loc(c(i, i, i)), &
      [c_loc(c(n(1), i, i)), c_loc(c(i, n(2), i)), c_loc(c(i, i, n(3)))])
  end function

  function view_int64(c, spacing, origin, ghosts) result(field)
    integer(c_int64_t), intent(in), target :: c(:, :, :)
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    integer, intent(in), optional :: ghosts
    type(dif_field) :: field
    integer :: i, n(3)
    call describe(field, dif_int64, shape(c, c_int64_t), ghosts)
    call set_place(field, spacing, origin)
    if (any(field%dims < 1)) return
    i = first_inside(ghosts)
    n = merge(i + 1, i, field%dims > 1)
    call set_data(field, c_loc(c(i, i, i)), &
      [c_loc(c(n(1), i, i)), c_loc(c(i, n(2), i)), c_loc(c(i, i, n(3)))])
  end function

  subroutine describe(field, type, extent, ghosts)
    type(dif_field), intent(out) :: field
    integer(c_int32_t), intent(in) :: type
    integer(c_int64_t), intent(in) :: extent(3)
    integer, intent(in), optional :: ghosts
    integer(c_int64_t) :: layers
    field%struct_size = c_sizeof(field)
    field%type = type
    layers = first_inside(ghosts) - 1
    if (layers >= 0) field%dims = max(extent - 2*layers, 0_c_int64_t)
  end subroutine

  subroutine set_place(field, spacing, origin)
    type(dif_field), intent(inout) :: field
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    field%spacing = 1
    if (present(spacing)) field%spacing = spacing
    if (present(origin)) field%origin = origin
  end subroutine

  integer function first_inside(ghosts)
    integer, intent(in), optional :: ghosts
    first_inside = 1
    if (present(ghosts)) first_inside = 1 + ghosts
  end function

  ! From the addresses of the first cell and its neighbours in x, y, z.
  subroutine set_data(field, first, next)
    type(dif_field), intent(inout) :: field
    type(c_ptr), intent(in) :: first, next(3)
    integer(c_int64_t) :: apart(3), bytes
    apart = distances(first, next)
    bytes = bytes_of(field%type)
    if (any(mod(apart, bytes) /= 0)) return  ! components of an odd type: left without data
    field%data = first
    field%strides = apart/bytes
  end subroutine

  function distances(first, next) result(apart)
    type(c_ptr), intent(in) :: first, next(:)
    integer(c_int64_t) :: apart(size(next))
    integer :: n
    do n = 1, size(next)
      apart(n) = address_of(next(n)) - address_of(first)
    end do
  end function

  integer(c_int64_t) function bytes_of(type)
    integer(c_int32_t), intent(in) :: type
    select case (type)
    case (dif_float64, dif_int64)
      bytes_of = 8
    case (dif_float32, dif_int32)
      bytes_of = 4
    case (dif_uint16)
      bytes_of = 2
    case default
      bytes_of = 1
    end select
  end function

  subroutine set_faces_of_field(field, x, y, z)
    type(dif_field), intent(inout) :: field
    real(c_double), intent(in), contiguous, target, optional :: x(:), y(:), z(:)
    if (present(x)) field%faces_x = place_of_faces(x, field%dims(1))
    if (present(y)) field%faces_y = place_of_faces(y, field%dims(2))
    if (present(z)) field%faces_z = place_of_faces(z, field%dims(3))
  end subroutine

  subroutine set_faces_of_grid(grid, x, y, z)
    type(dif_grid), intent(inout) :: grid
    real(c_double), intent(in), contiguous, target, optional :: x(:), y(:), z(:)
    if (present(x)) grid%faces_x = place_of_faces(x, grid%dims(1))
    if (present(y)) grid%faces_y = place_of_faces(y, grid%dims(2))
    if (present(z)) grid%faces_z = place_of_faces(z, grid%dims(3))
  end subroutine

  ! A table of another length would be read beyond its end: the library refuses no cells.
  type(c_ptr) function place_of_faces(faces, cells)
    real(c_double), intent(in), contiguous, target :: faces(:)
    integer(c_int64_t), intent(inout) :: cells
    place_of_faces = c_loc(faces)
    if (size(faces, kind=c_int64_t) /= cells + 1) cells = 0
  end function

  ! A grid without data.
  function dif_make_grid(dims, spacing, origin) result(grid)
    integer, intent(in) :: dims(3)
    real(c_double), intent(in), optional :: spacing(3), origin(3)
    type(dif_grid) :: grid
    grid%struct_size = c_sizeof(grid)
    grid%dims = dims
    grid%spacing = 1
    if (present(spacing)) grid%spacing = spacing
    if (present(origin)) grid%origin = origin
  end function

  ! Normals, out of the material, and offsets of the planes of all interfacial cells, into the
  ! solver's arrays; cells that are not interfacial get 0. See dif_field_planes in difmesh.h.
  subroutine dif_planes(field, targets, status, options, message)
    type(dif_field), intent(in) :: field
    type(dif_plane_targets), intent(in) :: targets
    integer(c_int32_t), intent(out) :: status
    type(dif_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    type(dif_plane_arrays) :: arrays
    logical :: fits
    fits = .true.
    status = dif_plane_arrays_init(arrays, c_sizeof(arrays))
    arrays%strides = 0
    if (associated(targets%normal_x)) arrays%normal_x = place(targets%normal_x)
    if (associated(targets%normal_y)) arrays%normal_y = place(targets%normal_y)
    if (associated(targets%normal_z)) arrays%normal_z = place(targets%normal_z)
    if (associated(targets%offset)) arrays%offset = place(targets%offset)
    if (associated(targets%source)) arrays%source = place_source(targets%source)
    if (.not. fits) then
      call refuse('the arrays for planes must have the shape of the field, and all of them the '// &
        'same distances between elements', status, message)
      return
    end if
    where (arrays%strides == 0) arrays%strides = 1  ! nothing wanted, or one cell along the axis
    call finish(dif_field_planes(field, options, arrays), status, message)

  contains

    type(c_ptr) function place(array)
      real(c_double), intent(in), target :: array(:, :, :)
      integer :: n(3)
      place = c_null_ptr
      fits = fits .and. all(shape(array, c_int64_t) == field%dims)
      if (.not. fits .or. size(array) == 0) return
      n = merge(2, 1, field%dims > 1)
      place = c_loc(array(1, 1, 1))
      call agree(distances(place, [c_loc(array(n(1), 1, 1)), c_loc(array(1, n(2), 1)), &
        c_loc(array(1, 1, n(3)))]), 8_c_int64_t)
    end function

    type(c_ptr) function place_source(array)
      integer(c_int32_t), intent(in), target :: array(:, :, :)
      integer :: n(3)
      place_source = c_null_ptr
      fits = fits .and. all(shape(array, c_int64_t) == field%dims)
      if (.not. fits .or. size(array) == 0) return
      n = merge(2, 1, field%dims > 1)
      place_source = c_loc(array(1, 1, 1))
      call agree(distances(place_source, [c_loc(array(n(1), 1, 1)), c_loc(array(1, n(2), 1)), &
        c_loc(array(1, 1, n(3)))]), 4_c_int64_t)
    end function

    ! Sets the strides, or compares with those of the arrays before.
    subroutine agree(apart, bytes)
      integer(c_int64_t), intent(in) :: apart(3), bytes
      integer(c_int64_t) :: strides(3)
      strides = apart/bytes
      fits = fits .and. all(mod(apart, bytes) == 0)
      if (all(arrays%strides == 0)) arrays%strides = strides
      fits = fits .and. all(arrays%strides == strides)
    end subroutine
  end subroutine

  ! Mean curvature of all interfacial cells into the solver's array kappa(i, j, k), positive where
  ! the material is convex; interfacial cells where none can be told get NaN, other cells 0. See
  ! dif_cell_curvature in difmesh.h. `ghosts` layers of kappa, as of c in dif_view, are left alone:
  !   call dif_curvature(dif_view(c, ghosts=1), kappa, status, ghosts=1)
  subroutine dif_curvature(field, kappa, status, options, message, ghosts)
    type(dif_field), intent(in) :: field
    real(c_double), intent(inout), target :: kappa(:, :, :)
    integer(c_int32_t), intent(out) :: status
    type(dif_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    integer, intent(in), optional :: ghosts
    real(c_double), contiguous, pointer :: first(:)
    real(c_double) :: nothing(1)
    integer(c_int64_t) :: apart(3)
    integer :: i, n(3)
    i = first_inside(ghosts)
    if (i < 1 .or. any(shape(kappa, c_int64_t) - 2*(i - 1) /= field%dims)) then
      call refuse('kappa must have the shape of the field, and `ghosts` layers around it', status, &
        message)
      return
    end if
    if (any(field%dims < 1)) then  ! which the library refuses
      call finish(dif_cell_curvature(field, options, nothing), status, message)
      return
    end if
    n = merge(i + 1, i, field%dims > 1)
    apart = distances(c_loc(kappa(i, i, i)), &
      [c_loc(kappa(n(1), i, i)), c_loc(kappa(i, n(2), i)), c_loc(kappa(i, i, n(3)))])
    call c_f_pointer(c_loc(kappa(i, i, i)), first, [1])
    call finish(dif_cell_curvature(field, options, first, apart/8), status, message)
  end subroutine

  ! The field, smoothed by a compact kernel, into values(nx, ny, nz); see dif_mollify in difmesh.h.
  subroutine dif_mollified(field, values, status, options, message)
    type(dif_field), intent(in) :: field
    real(c_double), intent(inout), contiguous :: values(:, :, :)
    integer(c_int32_t), intent(out) :: status
    type(dif_mollify_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    if (any(shape(values, c_int64_t) /= field%dims)) then
      call refuse('values must have the shape of the field', status, message)
      return
    end if
    call finish(dif_mollify(field, options, values), status, message)
  end subroutine

  ! (value - empty)/(full - empty) into fractions(nx, ny, nz), values beyond counting as 0 or 1; see
  ! dif_fractions_from_values in difmesh.h. `empty` is 0 by default.
  subroutine dif_fractions_of_values(values, full, fractions, status, empty, message)
    type(dif_field), intent(in) :: values
    real(c_double), intent(in) :: full
    real(c_double), intent(inout), contiguous :: fractions(:, :, :)
    integer(c_int32_t), intent(out) :: status
    real(c_double), intent(in), optional :: empty
    character(*), intent(inout), optional :: message
    real(c_double) :: low
    if (any(shape(fractions, c_int64_t) /= values%dims)) then
      call refuse('fractions must have the shape of the values', status, message)
      return
    end if
    low = 0
    if (present(empty)) low = empty
    call finish(dif_fractions_from_values(values, low, full, fractions), status, message)
  end subroutine

  ! The bits of 255, that is 1, into fractions(nx, ny, nz) where a value is one of the labels, and 0
  ! elsewhere; see dif_fractions_from_labels in difmesh.h.
  subroutine dif_fractions_of_labels(values, labels, fractions, status, message)
    type(dif_field), intent(in) :: values
    integer, intent(in) :: labels(:)
    integer(c_int8_t), intent(inout), contiguous :: fractions(:, :, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    if (any(shape(fractions, c_int64_t) /= values%dims)) then
      call refuse('fractions must have the shape of the values', status, message)
      return
    end if
    call finish(dif_fractions_from_labels(values, size(labels, kind=c_int64_t), &
      int(labels, c_int64_t), fractions), status, message)
  end subroutine

  ! To .npy or .nrrd; only the latter holds spacing and origin.
  subroutine dif_write_field(field, path, status, options, message)
    type(dif_field), intent(in) :: field
    character(*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    type(dif_field_write_options), intent(in), optional :: options
    character(*), intent(inout), optional :: message
    call finish(dif_field_write(field, to_c(path), options), status, message)
  end subroutine

  ! From .npy, .nrrd or .nhdr, or with a layout from a raw file. `labels`: cells with one of these
  ! values are full, others empty; in place of those in the options.
  subroutine read_file(file, path, status, layout, message, options, labels)
    class(dif_field_file), intent(inout) :: file
    character(*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    type(dif_raw_layout), intent(in), optional :: layout
    character(*), intent(inout), optional :: message
    type(dif_field_read_options), intent(in), optional :: options
    integer, intent(in), optional :: labels(:)
    type(dif_field_read_options) :: chosen
    integer(c_int64_t), allocatable, target :: wanted(:)
    type(c_ptr) :: made
    call dif_init(chosen)
    if (present(options)) chosen = options
    if (present(labels)) then
      if (size(labels) == 0) then
        call refuse('labels: there are none', status, message)
        return
      end if
      wanted = labels
      chosen%label_count = size(wanted, kind=c_int64_t)
      chosen%labels = c_loc(wanted)
    end if
    call finish(dif_field_read_with(to_c(path), layout, chosen, made), status, message)
    if (status /= dif_ok) return
    call dif_field_file_free(file%handle)
    file%handle = made
  end subroutine

  ! What a user must know of the file though it is no error, one sentence each; of size 0 if there
  ! is nothing to tell.
  subroutine get_warnings(file, warnings, status, message)
    class(dif_field_file), intent(in) :: file
    character(*), allocatable, intent(out) :: warnings(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    call get_list(file%handle, dif_field_file_warning, warnings, status, message)
  end subroutine

  ! A view of the memory of the file, as long as nothing else is read into it.
  subroutine view_file(file, field, status, message)
    class(dif_field_file), intent(in) :: file
    type(dif_field), intent(out) :: field
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    field%struct_size = c_sizeof(field)
    call finish(dif_field_file_field(file%handle, field), status, message)
  end subroutine

  ! A copy c(nx, ny, nz); integers are divided by their largest value.
  subroutine get_fractions(file, c, status, message)
    class(dif_field_file), intent(in) :: file
    real(c_double), allocatable, intent(out) :: c(:, :, :)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(dif_field) :: field
    integer(c_int64_t) :: i, j, k
    integer :: code
    call file%view(field, status, message)
    if (status /= dif_ok) return
    allocate (c(field%dims(1), field%dims(2), field%dims(3)), stat=code)
    if (no_room(code, status, message)) return
    do k = 1, field%dims(3)
      do j = 1, field%dims(2)
        do i = 1, field%dims(1)
          c(i, j, k) = fraction_at(field, sum(([i, j, k] - 1)*field%strides))
        end do
      end do
    end do
  end subroutine

  ! Of the element so many elements after the first.
  real(c_double) function fraction_at(field, n)
    type(dif_field), intent(in) :: field
    integer(c_int64_t), intent(in) :: n
    real(c_double), pointer :: r8(:)
    real(c_float), pointer :: r4(:)
    integer(c_int8_t), pointer :: i1(:)
    integer(c_int16_t), pointer :: i2(:)
    select case (field%type)
    case (dif_float64)
      call c_f_pointer(field%data, r8, [n + 1])
      fraction_at = r8(n + 1)
    case (dif_float32)
      call c_f_pointer(field%data, r4, [n + 1])
      fraction_at = real(r4(n + 1), c_double)
    case (dif_uint8)
      call c_f_pointer(field%data, i1, [n + 1])
      fraction_at = iand(int(i1(n + 1)), 255)/255.0_c_double
    case default
      call c_f_pointer(field%data, i2, [n + 1])
      fraction_at = iand(int(i2(n + 1)), 65535)/65535.0_c_double
    end select
  end function

  subroutine leave(file, from)
    class(dif_field_file), intent(inout) :: file
    type(dif_field_file), intent(in) :: from
    if (c_associated(from%handle, file%handle)) return
    call dif_field_file_free(file%handle)
    file%handle = c_null_ptr
  end subroutine

  impure elemental subroutine free(file)
    type(dif_field_file), intent(inout) :: file
    call dif_field_file_free(file%handle)
    file%handle = c_null_ptr
  end subroutine
end module
