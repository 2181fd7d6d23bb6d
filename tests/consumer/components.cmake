# What the package answers to requests, good and bad.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

set(binary ${consumer_dir}/components)
file(REMOVE_RECURSE ${binary})

# request(REQUEST [WITHOUT packages] [HAS components] [SAYS pattern]): REQUEST follows the name in
# find_package(difmesh ...), WITHOUT hides packages of others. HAS lists all the components that
# must come, none where it is left out.
function(request request)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SAYS" "WITHOUT;HAS")
  set(options -U "*_DIR" -U "CMAKE_DISABLE_*")
  foreach(package IN LISTS arg_WITHOUT)
    list(APPEND options -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
  endforeach()
  execute_process(
    COMMAND ${CMAKE_COMMAND} -C ${OUTER_BUILD} -G ${outer_generator} ${options}
      -D "REQUEST=${request}" -S ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/components -B ${binary}
    OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  foreach(part IN ITEMS core io adapters metrics capi capi_static fortran)
    set(wanted FALSE)
    if(part IN_LIST arg_HAS)
      set(wanted TRUE)
    endif()
    foreach(sign IN ITEMS target found)
      set(seen FALSE)
      if(said MATCHES "-- ${sign} ${part} ")
        set(seen TRUE)
      endif()
      if(NOT seen STREQUAL wanted)
        message(FATAL_ERROR "find_package(difmesh ${request}) without '${arg_WITHOUT}': "
          "${sign} ${part} is ${seen}\n${said}")
      endif()
    endforeach()
  endforeach()
  if(arg_SAYS AND NOT said MATCHES "${arg_SAYS}")
    message(FATAL_ERROR "find_package(difmesh ${request}) does not say '${arg_SAYS}':\n${said}")
  endif()
  message(STATUS "find_package(difmesh ${request}) gives '${arg_HAS}' ${arg_SAYS}")
endfunction()

# The module needs a project in Fortran; see the test of the Fortran example.
set(parts ${outer_parts})
list(REMOVE_ITEM parts fortran)
request("CONFIG REQUIRED" HAS ${parts})
if(fortran IN_LIST outer_parts)
  request("CONFIG REQUIRED COMPONENTS core fortran"
    SAYS "Reason.*'fortran' is compiled with your project, which has not enabled")
  request("CONFIG REQUIRED COMPONENTS core OPTIONAL_COMPONENTS fortran" HAS core)
endif()
request("0.2 CONFIG REQUIRED COMPONENTS core" HAS core WITHOUT ZLIB)
request("0.3 CONFIG" SAYS "compatible with requested version \"0.3\"")
request("CONFIG REQUIRED COMPONENTS soap"
  SAYS "Reason.*this installation has no component 'soap'; it was built with: core")
request("CONFIG COMPONENTS core OPTIONAL_COMPONENTS soap" HAS core)
if(outer_with_tbb)
  request("CONFIG COMPONENTS core" WITHOUT TBB SAYS "Reason.*dependency TBB could not be found")
else()
  request("CONFIG REQUIRED COMPONENTS core" HAS core WITHOUT TBB)
endif()

# libdifmesh.so brings all it needs; the static one has to be linked with what it is made of.
if(capi IN_LIST outer_parts)
  request("CONFIG REQUIRED COMPONENTS capi" HAS capi WITHOUT TBB ZLIB embree)
  set(static_parts ${parts})
  list(REMOVE_ITEM static_parts capi adapters)
  request("CONFIG REQUIRED COMPONENTS capi_static" HAS ${static_parts})
  request("CONFIG REQUIRED OPTIONAL_COMPONENTS capi_static" HAS ${static_parts})
endif()

# The adapters need neither a library of ours nor those that they adapt to.
if(adapters IN_LIST outer_parts)
  request("CONFIG REQUIRED COMPONENTS adapters" HAS adapters WITHOUT TBB OpenMesh CGAL)
endif()

set(needs_io ZLIB)
set(needs_metrics embree)
foreach(part IN ITEMS io metrics)
  if(NOT part IN_LIST outer_parts)
    request("CONFIG REQUIRED COMPONENTS core ${part}" SAYS "Reason.*has no component '${part}'")
    request("CONFIG REQUIRED COMPONENTS core OPTIONAL_COMPONENTS ${part}" HAS core)
    continue()
  endif()
  request("CONFIG REQUIRED COMPONENTS ${part}" HAS core ${part})
  request("CONFIG REQUIRED COMPONENTS core OPTIONAL_COMPONENTS ${part}" HAS core ${part})
  foreach(package IN LISTS needs_${part})
    request("CONFIG" WITHOUT ${package} SAYS "Reason.*dependency ${package} could not be found")
    request("CONFIG COMPONENTS ${part}" WITHOUT ${package}
      SAYS "Reason.*dependency ${package} could not be found")
    request("CONFIG REQUIRED COMPONENTS core OPTIONAL_COMPONENTS ${part}" WITHOUT ${package}
      HAS core)
  endforeach()
endforeach()
