! Meshes, callbacks and blocks.
module meshes_test
  use, intrinsic :: iso_c_binding
  use difmesh
  use difmesh_c, only: dif_has
  use expect_module
  implicit none
  private
  public :: test_arrays, test_results, test_progress, test_blocks, test_mesh_files, test_distance
  public :: test_scalars, test_smoothing, test_warnings

  integer :: calls = 0

contains

  subroutine test_arrays()
    real(8), parameter :: points(3, 4) = reshape( &
      [0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 4])
    integer, parameter :: faces(3, 4) = reshape([1, 3, 2, 1, 2, 4, 2, 3, 4, 1, 4, 3], [3, 4])
    type(dif_mesh) :: mesh, copy, many(2)
    type(dif_measure) :: facts
    real(8), allocatable :: again(:, :), normals(:, :)
    real(4), allocatable :: single(:, :)
    real(8), pointer :: borrowed(:, :)
    integer, allocatable :: triangles(:, :)
    integer(8), allocatable :: long(:, :), ids(:)
    integer :: status
    character(1000) :: message
    call mesh%set_arrays(points, faces, status)
    call expect(status == dif_ok, 'a mesh from arrays')
    call mesh%measure(facts, status)
    call expect_near(facts%volume, 1/6d0, 1d-15, 'volume of a tetrahedron')
    call expect_near(facts%area, 1.5d0 + sqrt(3d0)/2, 1d-15, 'its area')
    call expect(facts%closed == 1 .and. facts%euler_number == 2, 'it is closed')
    call expect(facts%has_volume == 1 .and. facts%unbalanced_edges == 0, 'it has a volume')

    copy = mesh
    many(1) = copy
    many(2) = many(1)
    call mesh%clear()
    call expect(mesh%vertex_count() == 0, 'vertices of a mesh that is cleared')
    call expect(mesh%triangle_count() == 0, 'triangles of a mesh that is cleared')
    call expect_same(copy, many(2), 'copies')
    call copy%get_points(again, status)
    call expect(maxval(abs(again - points)) <= 0, 'points')
    call copy%get_points(single, status)
    call expect(maxval(abs(single - points)) <= 0, 'points in single precision')
    call copy%get_triangles(triangles, status)
    call expect(all(triangles == faces), 'triangles count from 1')
    call copy%get_triangles(long, status)
    call expect(all(long == faces), 'triangles in 8 bytes')
    borrowed => copy%borrow_points()
    call expect(maxval(abs(borrowed - points)) <= 0, 'borrowed points')
    call copy%get_edge_ids(ids, status)
    call expect(status == dif_ok .and. size(ids) == 0, 'no names of edges')
    call copy%get_normals(normals, status, message)
    call expect(status == dif_error_invalid_argument, 'no normals')
    call expect(index(message, 'vertex_normals') > 0, 'how to get them: '//trim(message))
    call mesh%get_points(again, status)
    call expect(status == dif_error_invalid_argument, 'points of no mesh')

    call copy%set_arrays(points, faces + 1, status, message)
    call expect(status == dif_error_invalid_argument, 'an index out of range')
    call copy%set_arrays(points(:2, :), faces, status)
    call expect(status == dif_error_invalid_argument, 'no points in space')
    call expect_same(copy, many(1), 'left as it was')
  end subroutine

  ! A ball of radius 8: its curvature, and what smoothing does to it.
  subroutine test_smoothing()
    real(8), target :: c(24, 24, 24)
    real(8) :: smooth_field(24, 24, 24)
    type(dif_grid) :: grid
    type(dif_shape) :: ball
    type(dif_shape_options) :: shape
    type(dif_options) :: options
    type(dif_smoothing_options) :: smoothing
    type(dif_curvature_options) :: curvature
    type(dif_mollify_options) :: mollify
    type(dif_mesh) :: mesh, smooth
    type(dif_measure) :: before, after
    real(8), allocatable :: mean(:), gaussian(:), other(:)
    integer :: status
    character(1000) :: message
    call dif_init(shape)
    shape%centre = [12.1d0, 11.8d0, 12.3d0]
    shape%radius = 8
    call ball%create(shape, status)
    grid = dif_make_grid([24, 24, 24])
    call dif_fractions_of_shape(grid, ball, c, status)
    call expect(status == dif_ok, 'a ball to smooth')
    call dif_init(options)
    options%edge_ids = 1
    call mesh%reconstruct(dif_view(c), status, options)
    call mesh%measure(before, status)

    call mesh%get_curvature(mean, gaussian, status)
    call expect(status == dif_ok, 'curvature')
    call expect(size(mean, kind=8) == before%vertices, 'curvature of each vertex')
    call expect(maxval(abs(8*mean - 1)) < 0.1d0, 'mean curvature of a ball')
    call expect(maxval(abs(64*gaussian - 1)) < 0.2d0, 'Gaussian curvature of a ball')
    call dif_init(curvature)
    curvature%rings = 3
    call mesh%get_curvature(other, gaussian, status, curvature)
    call expect(status == dif_ok .and. any(abs(other - mean) > 0), 'three rings')
    curvature%rings = 0
    call mesh%get_curvature(other, gaussian, status, curvature, message)
    call expect(status == dif_error_invalid_argument .and. index(message, 'rings') > 0, 'no rings')

    call smooth%smooth(mesh, status)
    call smooth%measure(after, status)
    call expect(abs(after%volume/before%volume - 1) < 0.03d0, "Taubin's smoothing keeps the volume")
    call dif_init(smoothing)
    smoothing%kind = dif_smoothing_flow
    call smooth%smooth(mesh, status, smoothing)
    call smooth%measure(after, status)
    call expect_near(after%volume/before%volume, (1 - 4/64d0)**1.5d0, 0.01d0, 'flow shrinks a ball')
    smoothing%kind = dif_smoothing_constrained
    call smooth%smooth(mesh, status, smoothing, grid)
    call expect(status == dif_ok, 'smoothing within fractions')
    call smooth%measure(after, status)
    call expect(abs(after%volume/before%volume - 1) < 1d-3, 'it keeps the volume')
    call smooth%smooth(mesh, status, smoothing, message=message)
    call expect(status == dif_error_invalid_argument .and. index(message, 'grid') > 0, &
      'without grid')
    call expect(smooth%vertex_count() == before%vertices, 'left as it was')

    call dif_mollified(dif_view(c), smooth_field, status)
    call expect(status == dif_ok, 'mollified')
    call expect_near(sum(smooth_field), sum(c), 1d-9, 'the sum is kept')
    call expect(maxval(abs(smooth_field - c)) > 0.1d0, 'the field is another')
    call dif_init(mollify)
    mollify%radius = 1
    call dif_mollified(dif_view(c), smooth_field, status, mollify)
    call expect(maxval(abs(smooth_field - c)) <= 0, 'a kernel of one cell')
    call dif_mollified(dif_view(c), smooth_field(:, :, :23), status)
    call expect(status == dif_error_invalid_argument, 'too few values')
  end subroutine

  subroutine test_results()
    real(8), target :: c(24, 19, 21)
    type(dif_options) :: options
    type(dif_mesh) :: mesh, copy
    type(dif_report) :: report
    real(8), allocatable :: points(:, :), normals(:, :), again(:, :)
    integer(8), allocatable :: ids(:)
    integer :: status, n
    c = ball(24, 19, 21)
    call dif_init(options)
    options%vertex_normals = 1
    options%edge_ids = 1
    call mesh%reconstruct(dif_view(c), status, options)
    call mesh%get_report(report, status)
    call expect(report%cells == 24*19*21 .and. report%closed == 1, 'a report')
    call mesh%get_points(points, status)
    call mesh%get_normals(normals, status)
    call expect(all(shape(normals) == shape(points)), 'a normal per vertex')
    do n = 1, size(points, 2)
      call expect(dot_product(normals(:, n), points(:, n) - [12.3d0, 9.1d0, 10.4d0]) &
        > 0.98d0*norm2(points(:, n) - [12.3d0, 9.1d0, 10.4d0]), 'normals point outwards')
    end do
    call mesh%get_edge_ids(ids, status)
    call expect(size(ids) == size(points, 2), 'a name per vertex')
    call expect(all(ids(2:) > ids(:size(ids) - 1)), 'names ascend')
    copy = mesh
    call copy%get_normals(again, status)
    call expect(maxval(abs(again - normals)) <= 0, 'normals are copied')
    call copy%get_report(report, status)
    call expect(status == dif_error_invalid_argument, 'reports are not')
    options%placement = 77
    call mesh%reconstruct(dif_view(c), status, options)
    call expect(status == dif_error_invalid_argument, 'no such placement')
    call expect(mesh%vertex_count() == size(points, 2), 'a mesh is left as it was')
  end subroutine

  integer(c_int32_t) function stop_at_third(user, share_done) bind(c)
    type(c_ptr), value :: user
    real(c_double), value :: share_done
    real(8), pointer :: last
    call c_f_pointer(user, last)
    last = share_done
    calls = calls + 1
    stop_at_third = merge(1, 0, calls == 3)
  end function

  subroutine test_progress()
    real(8), target :: c(24, 19, 21), last
    type(dif_options) :: options
    type(dif_mesh) :: mesh
    integer :: status
    procedure(dif_progress), pointer :: callback
    c = ball(24, 19, 21)
    callback => stop_at_third
    call dif_init(options)
    options%progress = c_funloc(callback)
    options%progress_user = c_loc(last)
    call mesh%reconstruct(dif_view(c), status, options)
    call expect(status == dif_error_cancelled .and. calls == 3, 'the third call cancels')
    call mesh%reconstruct(dif_view(c), status, options)
    call expect(status == dif_ok .and. calls > 4, 'later ones do not')
    call expect_near(last, 1d0, 0d0, 'all is done')
  end subroutine

  subroutine test_blocks()
    real(8), target :: c(24, 19, 21)
    type(dif_mesh) :: whole, parts(2), welded
    type(dif_block) :: block
    type(dif_grid) :: grid
    integer :: status
    character(1000) :: message
    c = ball(24, 19, 21)
    grid = dif_make_grid([24, 19, 21], spacing=[0.5d0, 0.5d0, 0.25d0])
    call whole%reconstruct(dif_view(c, spacing=grid%spacing), status)
    call dif_init(block)
    block%dims = [24, 19, 11]
    block%ghost_high = [0_c_int64_t, 0_c_int64_t, dif_ghost_layers]
    call parts(1)%reconstruct_block(dif_view(c(:, :, :16)), block, grid, status, message=message)
    call expect(status == dif_ok, 'the lower block: '//trim(message))
    block%offset = [0, 0, 11]
    block%dims = [24, 19, 10]
    block%ghost_low = block%ghost_high
    block%ghost_high = 0
    call parts(2)%reconstruct_block(dif_view(c(:, :, 7:)), block, grid, status, message=message)
    call expect(status == dif_ok, 'the upper block: '//trim(message))
    call expect(parts(2)%vertex_count() < whole%vertex_count(), 'a part of the whole')
    call welded%weld(parts, grid, status)
    call expect_same(welded, whole, 'blocks')
  end subroutine

  subroutine test_far_stl(c)
    real(8), intent(in), target :: c(:, :, :)
    type(dif_mesh) :: mesh
    character(1000) :: warning
    integer :: status
    call mesh%reconstruct(dif_view(c, spacing=[0.01d0, 0.01d0, 0.01d0]), status)
    call mesh%write('meshes_test.stl', status, warning=warning)
    call expect(status == dif_ok .and. warning == '', 'nothing to tell of STL nearby')
    call mesh%reconstruct(dif_view(c, spacing=[0.01d0, 0.01d0, 0.01d0], &
      origin=[5d5, 5.4d6, 3d2]), status)
    call mesh%write('meshes_test.stl', status, warning=warning)
    call expect(status == dif_ok .and. index(warning, 'collapse') > 0, trim(warning))
    open (unit=11, file='meshes_test.stl')
    close (11, status='delete')
  end subroutine

  subroutine test_mesh_files()
    real(8), target :: c(24, 19, 21)
    type(dif_mesh) :: mesh, again
    type(dif_mesh_write_report) :: report
    integer :: status
    character(1000) :: message
    if (dif_has(dif_part_files) == 0) return
    c = ball(24, 19, 21)
    call mesh%reconstruct(dif_view(c), status)
    call mesh%write('meshes_test.ply   ', status, report=report)
    call expect(status == dif_ok, 'a mesh is written')
    call expect(report%bytes == size_of('meshes_test.ply'), 'the size of a file')
    call expect(report%vertices == mesh%vertex_count(), 'the vertices of a file')
    call expect(report%triangles == mesh%triangle_count(), 'the triangles of a file')
    call expect(report%position_bits == 0, 'no bits')
    call expect_near(report%position_error, 0d0, 0d0, 'no error')
    call expect(report%collapsed_triangles == 0, 'no triangle collapses')
    call test_far_stl(c)
    call mesh%write('no/such/folder.ply', status, report=report)
    call expect(status == dif_error_file_write .and. report%bytes == 0, 'nothing was written')
    call again%read('meshes_test.ply', status)
    call expect_same(mesh, again, 'a file')
    call mesh%write('meshes_test.ply', status, format='off')
    call again%read('meshes_test.ply', status, message)
    call expect(status == dif_error_file_format, 'not what the extension says')
    call again%read('no_such.ply', status, message)
    call expect(status == dif_error_file_missing, 'no file')
    call expect_same(mesh, again, 'a mesh after a file that is not there')
    open (unit=11, file='meshes_test.ply')
    close (11, status='delete')
  end subroutine

  ! Bytes behind the end that a .glb file says it has.
  subroutine test_warnings()
    real(8), target :: c(24, 19, 21)
    type(dif_mesh) :: mesh, again
    character(1000), allocatable :: warnings(:)
    character(30), allocatable :: short(:)
    character(1000) :: message
    integer :: status
    if (dif_has(dif_part_gltf) == 0) return
    call mesh%get_warnings(warnings, status, message)
    call expect(status == dif_error_invalid_argument, 'warnings of no mesh: '//trim(message))
    c = ball(24, 19, 21)
    call mesh%reconstruct(dif_view(c), status)
    call mesh%write('meshes_test.glb', status)
    call again%read('meshes_test.glb', status)
    call again%get_warnings(warnings, status)
    call expect(status == dif_ok .and. size(warnings) == 0, 'nothing to warn of')
    open (unit=11, file='meshes_test.glb', access='stream', position='append')
    write (11) 'tail'
    close (11)
    call again%read('meshes_test.glb', status)
    call again%get_warnings(warnings, status)
    call expect(status == dif_ok .and. size(warnings) == 1, 'one warning')
    call expect(index(warnings(1), "'meshes_test.glb': ") == 1, 'it names the file')
    call expect(index(warnings(1), ' was left out, 4 bytes.') + 22 == len_trim(warnings(1)), &
      'and the bytes')
    call again%get_warnings(short, status)
    call expect(short(1) == warnings(1)(:30), 'a warning that is cut off')
    open (unit=11, file='meshes_test.glb')
    close (11, status='delete')
  end subroutine

  subroutine test_scalars()
    real(8), target :: c(24, 19, 21)
    type(dif_mesh) :: mesh, copy
    type(dif_mesh_write_options) :: options
    type(dif_mesh_write_report) :: report
    real(8), allocatable :: points(:, :), before(:, :), values(:)
    integer :: status
    character(1000) :: message
    c = ball(24, 19, 21)
    call mesh%reconstruct(dif_view(c), status)
    call mesh%get_points(points, status)
    call expect(mesh%scalars_name(1) == '', 'no scalars')
    call mesh%get_scalars('height', values, status)
    call expect(status == dif_ok .and. size(values) == 0, 'none of that name')
    call mesh%set_scalars('height  ', points(3, :), status)
    call expect(status == dif_ok, 'scalars are set')
    call mesh%set_scalars('depth', -points(3, :), status)
    copy = mesh
    call mesh%set_scalars('depth', status=status)
    call expect(mesh%scalars_name(1) == 'height', 'what is left')
    call expect(mesh%scalars_name(2) == '', 'and no more')
    call expect(copy%scalars_name(2) == 'depth', 'copied')
    call expect(copy%scalars_name(3) == '', 'those alone')
    call copy%get_scalars('depth', values, status)
    call expect(maxval(abs(values + points(3, :))) <= 0, 'their values')
    call mesh%set_scalars('height', points(3, 2:), status, message)
    call expect(status == dif_error_invalid_argument, 'too few: '//trim(message))
    call mesh%set_scalars('no name', points(3, :), status, message)
    call expect(status == dif_error_invalid_argument, 'a blank: '//trim(message))

    if (dif_has(dif_part_gltf) == 0) return
    call mesh%write('scalars_test.glb', status, color_by='height ', name='ball', message=message)
    call expect(status == dif_ok, 'written with colors: '//trim(message))
    call copy%read('scalars_test.glb', status)
    call copy%get_scalars('height', values, status)
    call expect(maxval(abs(values - points(3, :))) < 2d-6, 'read again')
    call dif_init(options)
    options%draco = 1
    options%draco_method = dif_draco_sequential
    options%position_bits = 8
    before = points
    call mesh%write('scalars_test.glb', status, options, message, report=report)
    if (dif_has(dif_part_draco) == 1) then
      call expect(report%bytes == size_of('scalars_test.glb'), 'the size of a compressed file')
      call expect(report%position_bits == 8, 'its bits')
      call expect_near(report%local_origin(3), (minval(before(3, :)) + maxval(before(3, :)))/2, &
        1d-14, 'the centre')
      call copy%read('scalars_test.glb', status)
      call copy%get_points(points, status)
      call expect(maxval(abs(points - before)) <= report%position_error, 'its error')
      call expect(maxval(abs(points - before)) > report%position_error/2, 'and no less')
      call mesh%get_scalars('height', values, status)
      call expect(maxval(abs(values - points(3, :))) < 13/510d0, 'within half a step')
      call expect(maxval(abs(values - points(3, :))) > 10/1020d0, 'and compressed')
    end if
    call mesh%write('scalars_test.ply', status, options, message)
    call expect(status == dif_error_invalid_argument, 'no Draco here: '//trim(message))
    open (unit=11, file='scalars_test.glb')
    close (11, status='delete')
  end subroutine

  integer function size_of(path)
    character(*), intent(in) :: path
    inquire (file=path, size=size_of)
  end function

  subroutine test_distance()
    real(8), target :: c(24, 19, 21)
    real(8), allocatable :: points(:, :), distances(:)
    type(dif_mesh) :: mesh
    type(dif_shape) :: shape
    type(dif_shape_options) :: options
    type(dif_distance) :: distance
    integer :: status
    if (dif_has(dif_part_distance) == 0) return
    c = ball(24, 19, 21)
    call mesh%reconstruct(dif_view(c), status)
    call dif_init(options)
    options%centre = [12.3d0, 9.1d0, 10.4d0]
    options%radius = 6.5d0
    call shape%create(options, status)
    call mesh%distance_to(shape, distance, status)
    call mesh%get_points(points, status)
    allocate (distances(size(points, 2)))
    call shape%distances(points, distances, status)
    call expect_near(distance%vertices%signed_mean, sum(distances)/size(distances), 1d-12, &
      'mean distance')
    call expect_near(distance%vertices%maximum, maxval(abs(distances)), 1d-12, 'largest distance')
    call mesh%distance_to(mesh, distance, status)
    call expect_near(distance%facets%maximum, 0d0, 1d-12, 'distance to itself')
  end subroutine
end module
