# The CMake package: find_package(difmesh) gives difmesh::core and the other parts that were built.

include(CMakePackageConfigHelpers)
set(difmesh_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/difmesh)

# Of each part: the parts that it builds on, and what users of a static library have to find again,
# as arguments of find_package().
set(difmesh_core_parts "")
set(difmesh_io_parts core)
set(difmesh_adapters_parts "")
set(difmesh_metrics_parts core)
set(difmesh_core_needs "")
if(DIFMESH_WITH_TBB)
  list(APPEND difmesh_core_needs "TBB CONFIG COMPONENTS tbb")
endif()
set(difmesh_io_needs "ZLIB")
# Users of the adapters bring OpenMesh or CGAL themselves.
set(difmesh_adapters_needs "")
if(DIFMESH_WITH_DRACO)
  list(APPEND difmesh_io_needs "draco CONFIG")
endif()
set(difmesh_metrics_needs "embree 3 CONFIG" "TBB CONFIG COMPONENTS tbb")
# libdifmesh.so brings all it needs.
set(difmesh_capi_parts "")
set(difmesh_capi_needs "")
set(difmesh_capi_static_parts core)
foreach(part IN ITEMS io metrics)
  if(TARGET difmesh::${part})
    list(APPEND difmesh_capi_static_parts ${part})
  endif()
endforeach()
set(difmesh_capi_static_needs "")
set(difmesh_fortran_parts capi)
set(difmesh_fortran_needs "")

# One export set per part, so that users find only the dependencies of the parts that they ask for.
get_property(difmesh_parts GLOBAL PROPERTY difmesh_parts)
set(difmesh_needs "")
foreach(part IN LISTS difmesh_parts)
  if(NOT DEFINED difmesh_${part}_needs)
    message(FATAL_ERROR "difmesh_install.cmake does not say what the part '${part}' needs")
  endif()
  string(APPEND difmesh_needs "set(difmesh_${part}_parts \"${difmesh_${part}_parts}\")\n")
  string(APPEND difmesh_needs "set(difmesh_${part}_needs \"${difmesh_${part}_needs}\")\n")
  if(part STREQUAL "fortran")  # compiled in its users' builds
    continue()
  endif()
  install(EXPORT difmesh_${part}_targets NAMESPACE difmesh:: DESTINATION ${difmesh_package_dir})
endforeach()

# Not at the top of the build folder: find_package() looks there, and would find no targets.
set(difmesh_generated_dir ${PROJECT_BINARY_DIR}/package)
configure_file(
  ${CMAKE_CURRENT_LIST_DIR}/difmesh-config.cmake.in
  ${difmesh_generated_dir}/difmesh-config.cmake @ONLY)
write_basic_package_version_file(
  ${difmesh_generated_dir}/difmesh-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${difmesh_generated_dir}/difmesh-config.cmake
  ${difmesh_generated_dir}/difmesh-config-version.cmake
  DESTINATION ${difmesh_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/difmesh)
