! Views of arrays, files, fractions and planes.
module fields_test
  use, intrinsic :: iso_c_binding
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
  use difmesh
  use difmesh_c, only: dif_has, dif_value_extremes
  use expect_module
  implicit none
  private
  public :: test_views, test_bad_views, test_samples, test_planes, test_plane_arrays, test_files, &
    test_values, test_value_files, test_curvature

  real(8), parameter :: centre(3) = [8.2d0, 8.4d0, 9.1d0], normal(3) = [0.36d0, -0.48d0, 0.8d0]
  integer :: calls

contains

  ! However the numbers lie, they are read where they lie and give the same bits.
  subroutine test_views()
    integer, parameter :: nx = 24, ny = 19, nz = 21
    real(8), target :: c(nx, ny, nz), ghosts(0:nx + 1, 0:ny + 1, 0:nz + 1)
    real(8), target :: uneven(-1:nx + 3, 0:ny + 1, 1:nz + 4), sparse(2*nx, 3*ny, nz)
    real(8), target :: turned(nx, ny, nz)
    type cell
      real(8) :: velocity(3), alpha
      integer :: material
    end type
    type(cell), allocatable, target :: cells(:, :, :)
    type(dif_mesh) :: expected
    type(dif_field) :: field
    integer :: status
    c = ball(nx, ny, nz)
    field = dif_view(c)
    call expect(c_associated(field%data, c_loc(c)), 'a view is of the array itself')
    call expect(all(field%strides == [1, nx, nx*ny]), 'strides of a whole array')
    call expected%reconstruct(field, status)
    call expect(expected%triangle_count() > 500, 'a ball')

    ghosts = -7
    ghosts(1:nx, 1:ny, 1:nz) = c
    field = dif_view(ghosts, ghosts=1)
    call expect(c_associated(field%data, c_loc(ghosts(1, 1, 1))), 'ghost layers are not copied')
    call expect(all(field%dims == [nx, ny, nz]), 'ghost layers are cut off')
    call inspect(field, expected, 'one layer of ghost cells')
    call inspect(dif_view(ghosts(1:nx, 1:ny, 1:nz)), expected, 'a section')

    uneven = -7
    uneven(1:nx, 1:ny, 2:nz + 1) = c
    field = dif_view(uneven(1:nx, 1:ny, 2:nz + 1))
    call expect(c_associated(field%data, c_loc(uneven(1, 1, 2))), 'sections are not copied')
    call inspect(field, expected, 'uneven ghost layers')

    sparse = -7
    sparse(2::2, 1::3, :) = c
    call inspect(dif_view(sparse(2::2, 1::3, :)), expected, 'every other element')
    turned = c(nx:1:-1, :, nz:1:-1)
    field = dif_view(turned(nx:1:-1, :, nz:1:-1))
    call expect(field%strides(1) == -1, 'a negative stride')
    call inspect(field, expected, 'turned round')

    allocate (cells(nx, ny, nz))
    cells%alpha = c
    field%data = c_loc(cells(1, 1, 1)%alpha)
    field%strides = storage_size(cells)/storage_size(c)*[1, nx, nx*ny]
    call inspect(field, expected, 'a component, described by hand')
    call test_other_types(c)
  end subroutine

  subroutine test_other_types(c)
    real(8), intent(in) :: c(:, :, :)
    real(4), target :: r4(size(c, 1), size(c, 2), size(c, 3))
    real(8), target :: r8(size(c, 1), size(c, 2), size(c, 3))
    integer(c_int8_t), target :: i1(size(c, 1), size(c, 2), size(c, 3))
    integer(c_int16_t), target :: i2(size(c, 1), size(c, 2), size(c, 3))
    integer :: whole(size(c, 1), size(c, 2), size(c, 3))
    type(dif_mesh) :: mesh
    integer :: status
    r4 = real(c, 4)
    r8 = r4
    call mesh%reconstruct(dif_view(r8), status)
    call inspect(dif_view(r4), mesh, 'real(4)')
    whole = nint(c*255)
    r8 = whole/255d0
    i1 = int(merge(whole - 256, whole, whole > 127), c_int8_t)
    call mesh%reconstruct(dif_view(r8), status)
    call inspect(dif_view(i1), mesh, 'bytes')
    whole = nint(c*65535)
    r8 = whole/65535d0
    i2 = int(merge(whole - 65536, whole, whole > 32767), c_int16_t)
    call mesh%reconstruct(dif_view(r8), status)
    call inspect(dif_view(i2), mesh, 'two bytes')
  end subroutine

  subroutine test_bad_views()
    real(8), target :: c(6, 6, 6), none(6, 0, 6)
    type(dif_mesh) :: mesh
    type(dif_options) :: options
    integer :: status
    character(1000) :: message
    c = 0
    c(2, 3, 4) = ieee_value(0d0, ieee_quiet_nan)
    call mesh%reconstruct(dif_view(c), status, message=message)
    call expect(status == dif_error_invalid_value, 'NaN')
    call expect(index(message, '(1, 2, 3)') > 0, 'the cell is named: '//trim(message))
    call expect(dif_message() == message, 'the same message')
    call expect(dif_name_of_status(status) == 'DIF_ERROR_INVALID_VALUE', 'name of a status')
    c = 0
    call mesh%reconstruct(dif_view(none), status)
    call expect(status == dif_error_invalid_grid, 'no cells')
    call mesh%reconstruct(dif_view(c, ghosts=3), status)
    call expect(status == dif_error_invalid_grid, 'ghost cells only')
    call mesh%reconstruct(dif_view(c, ghosts=-1), status)
    call expect(status == dif_error_invalid_grid, 'ghosts < 0')
    call mesh%reconstruct(dif_view(c, spacing=[1d0, 0d0, 1d0]), status)
    call expect(status == dif_error_invalid_grid, 'spacing 0')
    call mesh%reconstruct(dif_view(c), status, options)
    call expect(status == dif_error_struct, 'options that nobody prepared')
    message = 'as before'
    call mesh%reconstruct(dif_view(c), status, message=message)
    call expect(status == dif_ok, 'nothing')
    call expect(mesh%vertex_count() == 0, 'vertices of nothing')
    call expect(message == 'as before', 'messages are of errors only')
  end subroutine

  subroutine test_samples()
    real(8) :: fractions(16, 17, 18), with_ghosts(0:17, 0:18, 0:19), expected(3, 18)
    real(8) :: volume
    real(8), target :: faces(19)
    type(dif_grid) :: grid
    type(dif_function_report) :: report
    type(dif_shape_options) :: options
    type(dif_shape) :: shape
    type(dif_mesh) :: box
    integer :: status, i, j, k
    character(1000) :: message
    calls = 0
    faces = [(real(k, 8), k = 0, 18)]
    ! Unit cells, as tables: the same grid; then a table that is too short.
    grid = dif_make_grid([16, 17, 18])
    call dif_set_faces(grid, z=faces)
    call dif_fractions_of_function(grid, distance, fractions, status, report=report)
    call expect_near(sum(fractions), 4*acos(-1d0)/3*5.5d0**3, 1d-6, 'volume of a ball by faces')
    grid = dif_make_grid([16, 17, 18])
    call dif_set_faces(grid, y=faces)
    call dif_fractions_of_function(grid, distance, fractions, status)
    call expect(status /= dif_ok, 'faces of another axis')
    calls = 0
    grid = dif_make_grid([16, 17, 18])
    call dif_fractions_of_function(grid, distance, fractions, status, report=report)
    call expect(status == dif_ok, 'fractions of a function')
    call expect_near(sum(fractions), 4*acos(-1d0)/3*5.5d0**3, 1d-6, 'volume of a ball')
    call expect(report%function_calls == calls, 'calls are counted')
    with_ghosts = -7
    call dif_fractions_of_function(grid, distance, with_ghosts(1:16, 1:17, 1:18), status)
    call expect(maxval(abs(with_ghosts(1:16, 1:17, 1:18) - fractions)) <= 0, 'inside ghost layers')
    call expect(all(with_ghosts(0, :, :) < -6), 'ghost layers are left alone')
    call dif_fractions_of_function(grid, distance, with_ghosts, status, message=message)
    call expect(status == dif_error_invalid_argument, 'another shape than the grid')
    call expect(index(message, 'shape of the grid') > 0, 'what is wrong: '//trim(message))

    call dif_init(options)
    options%radius = 5.5d0
    options%centre = centre
    call shape%create(options, status)
    call shape%volume(volume, status)
    call expect_near(volume, 4*acos(-1d0)/3*5.5d0**3, 1d-10, 'volume of a sphere')
    call dif_fractions_of_shape(grid, shape, with_ghosts(1:16, 1:17, 1:18), status)
    call expect(maxval(abs(with_ghosts(1:16, 1:17, 1:18) - fractions)) < 1d-9, 'a sphere')

    call make_box(box, [2.25d0, 3.5d0, 4.75d0], [9.5d0, 10.25d0, 11.125d0])
    call dif_fractions_of_mesh(grid, box, fractions, status)
    call expect(status == dif_ok, 'fractions of a mesh')
    do i = 1, 18
      expected(:, i) = min(max(min([9.5d0, 10.25d0, 11.125d0], real(i, 8)) &
        - max([2.25d0, 3.5d0, 4.75d0], i - 1d0), 0d0), 1d0)
    end do
    do k = 1, 18
      do j = 1, 17
        do i = 1, 16
          fractions(i, j, k) = fractions(i, j, k) - expected(1, i)*expected(2, j)*expected(3, k)
        end do
      end do
    end do
    call expect(maxval(abs(fractions)) < 1d-14, 'a box, clipped in closed form')
    call expect_overlaps(grid)
  end subroutine

  ! Boxes of 2 x 2 x 2 that have 1 x 2 x 2 in common, as one mesh.
  subroutine expect_overlaps(grid)
    type(dif_grid), intent(in) :: grid
    type(dif_mesh) :: first, second, both
    type(dif_triangle_options) :: options
    type(dif_triangle_report) :: report
    real(8), allocatable :: points(:, :), others(:, :)
    integer, allocatable :: faces(:, :)
    real(8) :: fractions(16, 17, 18)
    integer :: status
    call make_box(first, [2.25d0, 3.5d0, 4.75d0], [4.25d0, 5.5d0, 6.75d0])
    call make_box(second, [3.25d0, 3.5d0, 4.75d0], [5.25d0, 5.5d0, 6.75d0])
    call first%get_points(points, status)
    call second%get_points(others, status)
    call first%get_triangles(faces, status)
    call both%set_arrays(reshape([points, others], [3, 16]), &
      reshape([faces, faces + 8], [3, 24]), status)
    call expect(status == dif_ok, 'two boxes')
    call dif_fractions_of_mesh(grid, both, fractions, status, report=report)
    call expect(status == dif_ok, 'two boxes that overlap')
    call expect_near(sum(fractions), 12d0, 1d-12, 'their union')
    call expect_near(report%overlap_volume, 4d0, 1d-12, 'what they have in common')
    call expect_near(report%overlap_high(1), 5d0, 1d-12, 'where it ends, by cells')
    call dif_init(options)
    options%overlaps = dif_overlaps_count
    call dif_fractions_of_mesh(grid, both, fractions, status, options)
    call expect_near(sum(fractions), 16d0, 1d-12, 'counted twice')
    options%overlaps = dif_overlaps_refuse
    call dif_fractions_of_mesh(grid, both, fractions, status, options)
    call expect(status == dif_error_invalid_argument, 'overlaps are refused')
  end subroutine

  subroutine distance(points, values)
    real(8), intent(in) :: points(:, :)
    real(8), intent(out) :: values(:)
    integer :: n
    do n = 1, size(values)
      values(n) = norm2(points(:, n) - centre) - 5.5d0
    end do
    calls = calls + size(values)
  end subroutine

  subroutine make_box(mesh, low, high)
    type(dif_mesh), intent(inout) :: mesh
    real(8), intent(in) :: low(3), high(3)
    real(8) :: points(3, 8)
    integer, parameter :: faces(3, 12) = reshape([1, 3, 2, 2, 3, 4, 5, 6, 7, 6, 8, 7, 1, 2, 5, &
      2, 6, 5, 3, 7, 4, 4, 7, 8, 1, 5, 3, 3, 5, 7, 2, 4, 6, 4, 8, 6], [3, 12])
    integer :: n, status
    do n = 0, 7
      points(:, n + 1) = merge(high, low, [btest(n, 0), btest(n, 1), btest(n, 2)])
    end do
    call mesh%set_arrays(points, faces, status)
    call expect(status == dif_ok, 'a box')
  end subroutine

  subroutine test_planes()
    real(8) :: normals(3, 3), fractions(3), offsets(3), back(3), short(2)
    integer :: status
    character(1000) :: message
    normals = reshape([0d0, 0d0, 2d0, 1d0, 1d0, 1d0, 1d0, 0d0, 0d0], [3, 3])
    call dif_plane_fractions([1d0, 1d0, 1d0], normals, [0.5d0, -1d0, 9d0], fractions, status)
    call expect(maxval(abs(fractions - [0.75d0, 1/48d0, 1d0])) < 1d-15, 'fractions of planes')
    call dif_plane_offsets([0.5d0, 1d0, 2d0], normals, [0.3d0, 0.2d0, 0.9d0], offsets, status)
    call dif_plane_fractions([0.5d0, 1d0, 2d0], normals, offsets, back, status)
    call expect(maxval(abs(back - [0.3d0, 0.2d0, 0.9d0])) < 1d-14, 'offsets of planes')
    normals(:, 2) = 0
    call dif_plane_offsets([1d0, 1d0, 1d0], normals, fractions, offsets, status, message)
    call expect(status == dif_error_invalid_argument, 'a normal of 0')
    call expect(index(message, 'normal 1') > 0, 'it is named: '//trim(message))
    call dif_plane_offsets([1d0, 1d0, 1d0], normals, fractions, short, status)
    call expect(status == dif_error_invalid_argument, 'too few offsets')
  end subroutine

  ! Of a plane's cells, into the arrays of a solver with ghost layers.
  subroutine test_plane_arrays()
    integer, parameter :: n = 10
    real(8), target :: c(0:n + 1, 0:n + 1, 0:n + 1), m(0:n + 1, 0:n + 1, 0:n + 1, 3)
    real(8), target :: offset(0:n + 1, 0:n + 1, 0:n + 1), small(n, n, n)
    integer, target :: source(0:n + 1, 0:n + 1, 0:n + 1)
    type(dif_plane_targets) :: targets
    integer :: status, i, j, k, inside
    character(1000) :: message
    call dif_fractions_of_function(dif_make_grid([n, n, n]), plane, c(1:n, 1:n, 1:n), status)
    m = -7
    offset = -7
    source = -7
    targets%normal_x => m(1:n, 1:n, 1:n, 1)
    targets%normal_y => m(1:n, 1:n, 1:n, 2)
    targets%normal_z => m(1:n, 1:n, 1:n, 3)
    targets%offset => offset(1:n, 1:n, 1:n)
    targets%source => source(1:n, 1:n, 1:n)
    call dif_planes(dif_view(c, ghosts=1), targets, status, message=message)
    call expect(status == dif_ok, 'planes: '//trim(message))
    inside = 0
    do k = 3, n - 2
      do j = 3, n - 2
        do i = 3, n - 2
          if (source(i, j, k) /= dif_source_height_function) cycle
          inside = inside + 1
          call expect_near(norm2(m(i, j, k, :) - normal), 0d0, 1d-9, 'a normal')
          call expect_near(offset(i, j, k), 3.3d0 - dot_product(normal, [i, j, k] - 0.5d0), 1d-8, &
            'an offset')
        end do
      end do
    end do
    call expect(inside > 10, 'cells of the plane')
    call expect(all(abs(m(0, :, :, :) + 7) <= 0) .and. all(abs(m(:, :, n + 1, :) + 7) <= 0), &
      'ghost layers are left alone')
    nullify (targets%normal_y, targets%source)
    call dif_planes(dif_view(c, ghosts=1), targets, status)
    call expect(status == dif_ok, 'some arrays only')
    targets%offset => small
    call dif_planes(dif_view(c, ghosts=1), targets, status, message=message)
    call expect(status == dif_error_invalid_argument, 'different strides')
    call expect(index(message, 'distances between elements') > 0, 'what is wrong')
    targets%offset => offset
    call dif_planes(dif_view(c, ghosts=1), targets, status)
    call expect(status == dif_error_invalid_argument, 'different shapes')
  end subroutine

  ! Of a drop and a bubble, into the arrays of a solver with ghost layers.
  subroutine test_curvature()
    integer, parameter :: n = 26
    real(8), target :: c(0:n + 1, 0:n + 1, 0:n + 1), speck(5, 5, 5), none(6, 0, 6)
    real(8) :: kappa(0:n + 1, 0:n + 1, 0:n + 1), dense(n, n, n), turned(2*n, n, n), nothing(6, 0, 6)
    real(8) :: curvature(5, 5, 5)
    logical :: interfacial(n, n, n)
    integer :: status
    character(1000) :: message
    call dif_fractions_of_function(dif_make_grid([n, n, n], [0.1d0, 0.1d0, 0.1d0]), drop, &
      c(1:n, 1:n, 1:n), status)
    interfacial = c(1:n, 1:n, 1:n) > 1d-6 .and. c(1:n, 1:n, 1:n) < 1 - 1d-6
    kappa = -7
    call dif_curvature(dif_view(c, [0.1d0, 0.1d0, 0.1d0], ghosts=1), kappa, status, &
      message=message, ghosts=1)
    call expect(status == dif_ok, 'curvature: '//trim(message))
    dense = kappa(1:n, 1:n, 1:n)
    call expect(count(interfacial) > 1000, 'cells of the drop')
    call expect(all(abs(pack(dense, interfacial) - 1) < 0.02d0), 'curvature of a drop')
    call expect(all(abs(pack(dense, .not. interfacial)) <= 0), '0 in other cells')
    call expect(all(abs(kappa(0, :, :) + 7) <= 0) .and. all(abs(kappa(:, :, n + 1) + 7) <= 0), &
      'ghost layers are left alone')

    turned = -7
    call dif_curvature(dif_view(c(1:n, 1:n, 1:n), [0.1d0, 0.1d0, 0.1d0]), &
      turned(2*n:2:-2, :, n:1:-1), status)
    call expect(all(abs(turned(2*n:2:-2, :, n:1:-1) - dense) <= 0), 'a section, turned round')
    call expect(all(abs(turned(1::2, :, :) + 7) <= 0), 'elements between are left alone')
    c = 1 - c
    call dif_curvature(dif_view(c(1:n, 1:n, 1:n), [0.1d0, 0.1d0, 0.1d0]), dense, status)
    call expect(all(abs(pack(dense, interfacial) + 1) < 0.02d0), 'curvature of a bubble')

    speck = 0
    speck(3, 3, 3) = 0.5d0
    call dif_curvature(dif_view(speck), curvature, status)
    call expect(ieee_is_nan(curvature(3, 3, 3)), 'NaN where there is no surface')
    call expect(count(ieee_is_nan(curvature)) == 1, 'and nowhere else')
    call dif_curvature(dif_view(c), kappa(1:n, :, :), status, message=message)
    call expect(status == dif_error_invalid_argument, 'another shape')
    call expect(index(message, 'kappa') > 0, 'what is wrong')
    call dif_curvature(dif_view(c), kappa, status, ghosts=-1)
    call expect(status == dif_error_invalid_argument, 'ghosts < 0')
    call dif_curvature(dif_view(none), nothing, status)
    call expect(status == dif_error_invalid_grid, 'no cells')
  end subroutine

  subroutine drop(points, values)
    real(8), intent(in) :: points(:, :)
    real(8), intent(out) :: values(:)
    integer :: n
    do n = 1, size(values)
      values(n) = norm2(points(:, n) - [1.31d0, 1.29d0, 1.33d0]) - 1
    end do
  end subroutine

  subroutine plane(points, values)
    real(8), intent(in) :: points(:, :)
    real(8), intent(out) :: values(:)
    values = matmul(normal, points) - 3.3d0
  end subroutine

  ! Labels and values of the solver's become the fractions of a mask and of a ramp.
  subroutine test_values()
    integer(c_int32_t), target :: i4(0:9, 0:8, 0:7)
    integer(c_int64_t), target :: i8(8, 7, 6)
    integer(c_int8_t), target :: mask(8, 7, 6), also(8, 7, 6)
    real(8) :: fractions(8, 7, 6), low, high
    integer :: i, j, k, status
    character(1000) :: message
    i4 = 99
    do k = 1, 6
      do j = 1, 7
        do i = 1, 8
          i8(i, j, k) = merge(-5, i + 10*j + 100*k, i == 4 .and. j == 3 .and. k == 2)
        end do
      end do
    end do
    i4(1:8, 1:7, 1:6) = int(i8, c_int32_t)
    call dif_fractions_of_labels(dif_view(i4, ghosts=1), [-5, 111, 678, 1000], mask, status)
    call expect(status == dif_ok, 'labels of four bytes')
    call dif_fractions_of_labels(dif_view(i8), [-5, 111, 678, 1000], also, status)
    call expect(all(mask == also), 'labels of eight bytes')
    call expect(count(mask == -1_c_int8_t) == 3 .and. count(mask == 0) == size(mask) - 3, &
      'bits of 255 or 0')
    call expect(mask(4, 3, 2) == -1 .and. mask(1, 1, 1) == -1 .and. mask(8, 7, 6) == -1, 'where')
    call dif_fractions_of_values(dif_view(i8), 500d0, fractions, status, empty=100d0)
    call expect(status == dif_ok, 'values of eight bytes')
    call expect(maxval(abs(fractions - min(max((i8 - 100)/400d0, 0d0), 1d0))) <= 0, 'a ramp')
    call expect(dif_value_extremes(dif_view(i8), low, high) == dif_ok, 'extremes')
    call expect(nint(low) == -5 .and. nint(high) == 678, 'extremes of values')
    call dif_fractions_of_values(dif_view(i8), 0d0, fractions, status, message=message)
    call expect(status == dif_error_invalid_argument, 'full as empty')
    call dif_fractions_of_values(dif_view(i4), 1d0, fractions, status, message=message)
    call expect(status == dif_error_invalid_argument, 'another shape')
    call dif_fractions_of_labels(dif_view(i4), [1], mask, status)
    call expect(status == dif_error_invalid_argument, 'labels in another shape')
  end subroutine

  subroutine test_mask()
    integer(c_int8_t), target :: u1(8, 7, 6)
    character(1000), allocatable :: warnings(:)
    type(dif_mesh) :: mesh
    integer :: status
    u1 = 0
    u1(2:7, 2:6, 2:5) = int(200 - 256, c_int8_t)
    call mesh%reconstruct(dif_view(u1), status)
    call mesh%get_warnings(warnings, status)
    call expect(size(warnings) == 1, 'a warning of a mask')
    call expect(index(warnings(1), 'highest value is 200') > 0, trim(warnings(1)))
    where (u1 /= 0) u1 = -1_c_int8_t
    call mesh%reconstruct(dif_view(u1), status)
    call mesh%get_warnings(warnings, status)
    call expect(size(warnings) == 0, 'no warning of what is full')
  end subroutine

  subroutine test_value_files()
    integer(c_int16_t), target :: i2(8, 7, 6)
    real(8), allocatable :: c(:, :, :)
    character(1000), allocatable :: warnings(:)
    type(dif_field_file) :: file
    type(dif_field_read_options) :: options
    type(dif_raw_layout) :: layout
    type(dif_field) :: field
    integer :: status, none(0)
    if (dif_has(dif_part_files) == 0) return
    i2 = 3
    i2(2:7, 2:6, 2:5) = 40
    open (unit=11, file='values_test.raw', access='stream', form='unformatted', status='replace')
    write (11) i2
    close (11)
    call dif_init(layout)
    layout%dims = shape(i2)
    layout%type = dif_int16
    call file%read('values_test.raw', status, layout)
    call expect(status == dif_ok, 'integers that are no fractions')
    call file%get_warnings(warnings, status)
    call expect(size(warnings) == 1, 'a warning')
    call expect(index(warnings(1), 'highest value is 40') > 0, trim(warnings(1)))
    call test_mask()
    call file%read('values_test.raw', status, layout, labels=[40])
    call file%get_fractions(c, status)
    call expect(count(c > 0.5d0) == 120 .and. nint(sum(c)) == 120, 'labels in a file')
    call file%get_warnings(warnings, status)
    call expect(size(warnings) == 0, 'no warning')
    call dif_init(options)
    options%has_full_value = 1
    options%full_value = 43
    options%empty_value = 3
    options%has_spacing = 1
    options%spacing = [1d0, 2d0, 3d0]
    call file%read('values_test.raw', status, layout, options=options)
    call file%get_fractions(c, status)
    call expect(abs(c(2, 2, 2) - 37d0/40) < 1d-7 .and. abs(c(1, 1, 1)) <= 0, 'a full value')
    call file%view(field, status)
    call expect(nint(field%spacing(3)) == 3, 'a spacing of the caller''s')
    call file%read('values_test.raw', status, layout, labels=none)
    call expect(status == dif_error_invalid_argument, 'no labels')
    open (unit=11, file='values_test.raw')
    close (11, status='delete')
  end subroutine

  subroutine test_files()
    real(8), target :: c(24, 19, 21)
    real(8), allocatable :: again(:, :, :)
    integer(c_int16_t), target :: i2(24, 19, 21)
    integer :: whole(24, 19, 21), status
    type(dif_field_file) :: file
    type(dif_field) :: field
    character(1000) :: message
    if (dif_has(dif_part_files) == 0) return
    c = ball(24, 19, 21)
    field = dif_view(c, spacing=[0.5d0, 1d0, 2d0], origin=[3d0, 4d0, 5d0])
    call dif_write_field(field, 'fields_test.nrrd  ', status)
    call expect(status == dif_ok, 'a field is written')
    call file%read('fields_test.nrrd', status)
    call expect(status == dif_ok, 'a field is read')
    call file%get_fractions(again, status)
    call expect(all(shape(again) == shape(c)), 'the shape that was written')
    call expect(maxval(abs(again - c)) <= 0, 'the numbers that were written')
    call file%view(field, status)
    call expect(maxval(abs(field%spacing - [0.5d0, 1d0, 2d0])) <= 0, 'spacing in a file')
    call expect(maxval(abs(field%origin - [3d0, 4d0, 5d0])) <= 0, 'origin in a file')
    whole = nint(c*65535)
    i2 = int(merge(whole - 65536, whole, whole > 32767), c_int16_t)
    call dif_write_field(dif_view(i2), 'fields_test.nrrd', status)
    call file%read('fields_test.nrrd', status)
    call file%get_fractions(again, status)
    call expect(maxval(abs(again - whole/65535d0)) <= 0, 'integers in a file')
    call file%read('no_such.nrrd', status, message=message)
    call expect(status == dif_error_file_missing, 'no file')
    call expect(index(message, 'no_such.nrrd') > 0, 'it is named: '//trim(message))
    open (unit=11, file='fields_test.nrrd')
    close (11, status='delete')
  end subroutine
end module
