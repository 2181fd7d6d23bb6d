# An example in another language, from a copy, against the installed package, on a solver's field.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

set(dir ${consumer_dir}/example_${LANGUAGE})
file(REMOVE_RECURSE ${dir})
file(COPY ${outer_source_dir}/examples/${LANGUAGE}/ DESTINATION ${dir}/source)
consumer_build(${dir}/source ${dir}/build "${CONFIG}")
consumer_program(surface ${dir}/build "${CONFIG}" surface)
consumer_run(said ${surface}
  ${outer_source_dir}/examples/data/gerris_drops64_t0.45.nrrd ${dir}/surface.off)
file(STRINGS ${dir}/surface.off lines LIMIT_COUNT 2)
if(NOT lines STREQUAL "OFF;3352 6700 0")
  message(FATAL_ERROR "surface.off begins with ${lines}; the program said:\n${said}")
endif()

# What goes wrong is told, in the library's words.
execute_process(COMMAND ${surface} ${dir}/no_such.nrrd ${dir}/surface.off
  RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(result EQUAL 0 OR NOT said MATCHES "no_such.nrrd")
  message(FATAL_ERROR "without a field the program ends with ${result} and says:\n${said}")
endif()
