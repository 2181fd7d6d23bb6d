program bindings_fortran_test
  use expect_module, only: failures
  use fields_test
  use header_test
  use meshes_test
  implicit none
  call test_views()
  call test_bad_views()
  call test_samples()
  call test_planes()
  call test_plane_arrays()
  call test_curvature()
  call test_values()
  call test_files()
  call test_value_files()
  call test_arrays()
  call test_results()
  call test_progress()
  call test_blocks()
  call test_mesh_files()
  call test_scalars()
  call test_warnings()
  call test_distance()
  call test_smoothing()
  call test_header()
  if (failures > 0) error stop 'some expectations failed'
  print '(a)', 'all expectations hold'
end program
