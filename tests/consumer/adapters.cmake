# The project `adapters`, against the installed package, with g++ and with clang, optimised: some
# warnings come only then.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

foreach(compiler IN ITEMS g++ clang++)
  find_program(path NAMES ${compiler} NO_CACHE)
  if(NOT path)
    message(FATAL_ERROR "no ${compiler}; scripts/setup.sh installs it")
  endif()
  set(build ${consumer_dir}/adapters_${compiler})
  consumer_build(${CMAKE_CURRENT_LIST_DIR}/adapters ${build} Release -D CMAKE_CXX_COMPILER=${path})
  foreach(library IN ITEMS openmesh cgal)
    consumer_program(program ${build} Release use_${library})
    consumer_run(ignored ${program})
  endforeach()
  unset(path)
endforeach()
