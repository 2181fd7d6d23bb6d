# Installs the build, compares what came with what should come, and moves it: the package has to
# work from where it was not installed to.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

file(REMOVE_RECURSE ${first_prefix} ${moved_prefix})
consumer_config_option(config_option "${CONFIG}")
consumer_run(ignored
  ${CMAKE_COMMAND} --install ${outer_build_dir} --prefix ${first_prefix} ${config_option})

# What should come.
set(package_dir ${outer_libdir}/cmake/difmesh)
set(config_suffix noconfig)
if(CONFIG)
  string(TOLOWER ${CONFIG} config_suffix)
endif()
set(expected
  ${outer_datadir}/doc/difmesh/LICENSE
  ${outer_includedir}/difmesh/version.hpp
  ${package_dir}/difmesh-config-version.cmake
  ${package_dir}/difmesh-config.cmake)
foreach(part IN LISTS outer_parts)
  if(part STREQUAL "fortran")
    list(APPEND expected ${package_dir}/difmesh_fortran_targets.cmake)
    file(GLOB sources RELATIVE ${outer_source_dir}/bindings/fortran
      ${outer_source_dir}/bindings/fortran/*.f90)
    list(TRANSFORM sources PREPEND ${outer_includedir}/difmesh/fortran/)
    list(APPEND expected ${sources})
    continue()
  endif()
  list(APPEND expected ${package_dir}/difmesh_${part}_targets.cmake)
  if(NOT part STREQUAL "adapters") # headers only
    list(APPEND expected ${package_dir}/difmesh_${part}_targets-${config_suffix}.cmake)
  endif()
  if(part STREQUAL "capi")
    list(APPEND expected
      ${outer_includedir}/difmesh/difmesh.h
      ${outer_libdir}/libdifmesh.so
      ${outer_libdir}/libdifmesh.so.0
      ${outer_libdir}/libdifmesh.so.${outer_version}
      ${outer_libdir}/pkgconfig/difmesh.pc)
    if("adapters" IN_LIST outer_parts)
      list(APPEND expected ${outer_includedir}/difmesh/adapters/c_mesh.hpp)
    endif()
    continue()
  elseif(part STREQUAL "capi_static")
    list(APPEND expected ${outer_libdir}/libdifmesh.a)
    continue()
  endif()
  if(NOT part STREQUAL "adapters")
    list(APPEND expected ${outer_libdir}/libdifmesh_${part}.a)
  endif()
  set(include_dir ${outer_source_dir}/${part}/include)
  if(part STREQUAL "core")
    set(include_dir ${outer_source_dir}/cxx/include)
  endif()
  file(GLOB_RECURSE headers RELATIVE ${include_dir} ${include_dir}/*.hpp)
  list(TRANSFORM headers PREPEND ${outer_includedir}/)
  list(APPEND expected ${headers})
endforeach()
if(outer_with_cli)
  list(APPEND expected ${outer_bindir}/difmesh)
endif()

file(GLOB_RECURSE installed LIST_DIRECTORIES false RELATIVE ${first_prefix} ${first_prefix}/*)
set(surplus ${installed})
list(REMOVE_ITEM surplus ${expected})
list(REMOVE_ITEM expected ${installed})
if(surplus OR expected)
  message(FATAL_ERROR "installed but not expected: ${surplus}\nexpected but not installed: "
    "${expected}")
endif()

# Text must not name the folders of this build, nor anything the parts of CGAL under the GPL. The
# adapter to CGAL includes headers under the LGPL, and names others in comments.
foreach(file IN LISTS installed)
  if(file MATCHES "\\.(h|hpp|f90|cmake|pc)$")
    file(READ "${first_prefix}/${file}" text)
    foreach(folder IN ITEMS ${outer_source_dir} ${outer_build_dir} ${first_prefix})
      string(FIND "${text}" "${folder}" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${file} names ${folder}")
      endif()
    endforeach()
  endif()
  file(STRINGS "${first_prefix}/${file}" lines REGEX "CGAL/|4CGAL")
  if(file MATCHES "/difmesh/adapters/(detail/cgal_[a-z]+|cgal)\\.hpp$")
    set(free "boost/graph/properties|Kernel_traits|number_utils")
    list(FILTER lines EXCLUDE REGEX "^#include <CGAL/(${free})\\.h>$|^ *//")
  endif()
  if(lines)
    message(FATAL_ERROR "${file} uses CGAL: ${lines}")
  endif()
endforeach()

file(RENAME ${first_prefix} ${moved_prefix})

if(outer_with_cli)
  consumer_run(said ${moved_prefix}/${outer_bindir}/difmesh --version)
  if(NOT said STREQUAL "difmesh ${outer_version}\n")
    message(FATAL_ERROR "the program says: ${said}")
  endif()
endif()
