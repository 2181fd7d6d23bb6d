# The example that newcomers copy, from a copy, against the installed package.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

set(dir ${consumer_dir}/minimal)
file(REMOVE_RECURSE ${dir})
file(COPY ${outer_source_dir}/examples/minimal/ DESTINATION ${dir}/source)

# A single full cell amidst empty ones, as text.
string(REPEAT "0 " 13 empty)
file(WRITE ${dir}/cell.nrrd "NRRD0004\ntype: float\ndimension: 3\nsizes: 3 3 3\n"
  "spacings: 1 1 1\nencoding: ascii\n\n${empty}1 ${empty}\n")

foreach(config IN ITEMS Release Debug)
  set(build ${dir}/${config})
  consumer_build(${dir}/source ${build} ${config})
  consumer_program(minimal ${build} ${config} minimal)
  consumer_run(printed ${minimal})
  if(NOT printed MATCHES
      "^([0-9]+) vertices, ([0-9]+) triangles\nvolume [a-z]+: ([0-9]+)[.0-9]*, [ a-z]+: ([0-9]+)")
    message(FATAL_ERROR "minimal printed:\n${printed}")
  endif()
  # V - E + F = 2 and 3 F = 2 E: a closed surface like a sphere has F = 2 V - 4.
  math(EXPR triangles "2 * ${CMAKE_MATCH_1} - 4")
  if(NOT CMAKE_MATCH_2 EQUAL triangles OR triangles LESS 1000)
    message(FATAL_ERROR "minimal: not one sphere:\n${printed}")
  endif()
  # Flat triangles on a ball enclose less than it holds; by 0.2 % here.
  math(EXPR missing "1000 * (${CMAKE_MATCH_4} - ${CMAKE_MATCH_3}) / ${CMAKE_MATCH_4}")
  if(missing LESS 0 OR missing GREATER 3)
    message(FATAL_ERROR "minimal: the volumes differ by ${missing} of 1000:\n${printed}")
  endif()
  message(STATUS "${config}: ${printed}")

  if("io" IN_LIST outer_parts)
    consumer_program(convert ${build} ${config} convert)
    consumer_run(ignored ${convert} ${dir}/cell.nrrd ${build}/cell.off)
    file(READ ${build}/cell.off off)
    if(NOT off MATCHES "^OFF\n6 8 ")  # an octahedron
      message(FATAL_ERROR "convert wrote:\n${off}")
    endif()
  endif()
endforeach()
