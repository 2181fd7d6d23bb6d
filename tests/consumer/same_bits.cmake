# Runs the program `bits` of every build: the outer one's, optimised as that was, and those by
# add_subdirectory (VARIANTS, with commas), each with one thread and with three.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

string(REPLACE "," ";" variants "${VARIANTS}")
foreach(build IN ITEMS installed ${variants})
  set(config Debug)
  if(build STREQUAL "installed")
    set(config ${CONFIG})
  endif()
  consumer_program(bits ${consumer_dir}/${build} "${config}" bits)
  foreach(threads IN ITEMS 1 3)
    consumer_run(printed ${bits} ${threads})
    if(NOT DEFINED first)
      set(first "${printed}")
      message(STATUS "${build}:\n${printed}")
    elseif(NOT printed STREQUAL first)
      message(FATAL_ERROR "${build} with ${threads} threads differs:\n${printed}")
    endif()
  endforeach()
endforeach()
