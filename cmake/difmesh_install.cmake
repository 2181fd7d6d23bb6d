# The CMake package: find_package(difmesh) gives difmesh::core and, where built, difmesh::io.

include(CMakePackageConfigHelpers)
set(difmesh_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/difmesh)

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/difmesh-config.cmake.in
  ${PROJECT_BINARY_DIR}/difmesh-config.cmake
  INSTALL_DESTINATION ${difmesh_package_dir})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/difmesh-config-version.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT difmesh_targets NAMESPACE difmesh:: DESTINATION ${difmesh_package_dir})
install(FILES
  ${PROJECT_BINARY_DIR}/difmesh-config.cmake
  ${PROJECT_BINARY_DIR}/difmesh-config-version.cmake
  DESTINATION ${difmesh_package_dir})
