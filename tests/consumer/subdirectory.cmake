# The project `subdirectory`, unoptimised: that is quick, and the bits must not depend on it.
# VARIANT is serial or tbb.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

# Only what the variant needs may be looked for.
set(options -D DIFMESH_WITH_TBB=ON)
set(unneeded ZLIB CLI11 nlohmann_json doctest CGAL benchmark VTK)
if(VARIANT STREQUAL "serial")
  set(options -D DIFMESH_WITH_TBB=OFF)
  list(APPEND unneeded TBB)
endif()
foreach(package IN LISTS unneeded)
  list(APPEND options -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

consumer_build(${CMAKE_CURRENT_LIST_DIR}/subdirectory ${consumer_dir}/${VARIANT} Debug
  -D DIFMESH_SOURCE=${outer_source_dir} ${options})
