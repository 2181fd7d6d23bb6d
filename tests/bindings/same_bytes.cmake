# Every language's program writes the file that the command line's does, to the last byte.

cmake_minimum_required(VERSION 3.25)
if(NOT EXISTS ${FIELD})
  message(STATUS "skipped: no ${FIELD}")
  return()
endif()
string(REPLACE "," ";" programs "${PROGRAMS}")
string(REPLACE "," ";" environment "${ENVIRONMENT}")
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})

execute_process(COMMAND ${CLI} reconstruct ${FIELD} -o ${OUT}/expected.ply --quiet
  COMMAND_ERROR_IS_FATAL ANY)
file(SIZE ${OUT}/expected.ply bytes)
if(bytes LESS 50000)
  message(FATAL_ERROR "the surface has ${bytes} bytes only")
endif()
foreach(program IN LISTS programs)
  set(command ${program})
  if(program MATCHES "\\.py$")
    set(command ${CMAKE_COMMAND} -E env ${environment} ${PYTHON} ${program})
  endif()
  execute_process(COMMAND ${command} ${FIELD} ${OUT}/surface.ply
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${program} ends with ${result}:\n${said}")
  endif()
  execute_process(COMMAND
    ${CMAKE_COMMAND} -E compare_files ${OUT}/expected.ply ${OUT}/surface.ply
    RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${program} writes other bytes than the command line")
  endif()
  message(STATUS "${program}: the same ${bytes} bytes")
  file(REMOVE ${OUT}/surface.ply)
endforeach()
