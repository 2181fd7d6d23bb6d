# What every target of the project has in common.

set(difmesh_warnings -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion)
if(DIFMESH_WARNINGS_AS_ERRORS)
  list(APPEND difmesh_warnings -Werror)
endif()

# Language level and warnings, for libraries, programs and tests alike. Contraction to fused
# multiply-add is off: results must not depend on the instruction set.
function(difmesh_set_up_unwatched target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE ${difmesh_warnings} -ffp-contract=off)
  if(DIFMESH_SANITIZE)
    target_link_options(${target} PUBLIC -fsanitize=${DIFMESH_SANITIZE})
  endif()
endfunction()

# The same, and sanitizers.
function(difmesh_set_up target)
  difmesh_set_up_unwatched(${target})
  if(DIFMESH_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${DIFMESH_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  endif()
endfunction()

# For targets whose own code takes longer to compile than it ever runs.
function(difmesh_compile_fast target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(DIFMESH_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  endif()
endfunction()

# A library of the project: difmesh_<part>, seen by users as difmesh::<part>, installed as
# the package's component <part>. Parts are to be added in the order of their dependence.
function(difmesh_add_library part)
  add_library(difmesh_${part} STATIC ${ARGN})
  add_library(difmesh::${part} ALIAS difmesh_${part})
  difmesh_set_up(difmesh_${part})
  target_include_directories(difmesh_${part} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(difmesh_${part} PROPERTIES EXPORT_NAME ${part})
  set_property(GLOBAL APPEND PROPERTY difmesh_parts ${part})
  install(TARGETS difmesh_${part} EXPORT difmesh_${part}_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.hpp")
endfunction()
