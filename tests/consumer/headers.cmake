# The project `installed`, against the installed package.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)
consumer_build(${CMAKE_CURRENT_LIST_DIR}/installed ${consumer_dir}/installed "${CONFIG}")
