# What the scripts of this folder share.

include(${OUTER_BUILD})

# consumer_run(OUTPUT command...): stops, with all that the command printed, where it fails.
function(consumer_run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nfailed (${result}):\n${text}")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# consumer_config_option(VARIABLE config): the option of cmake, none for an empty CMAKE_BUILD_TYPE.
function(consumer_config_option option config)
  set(${option} "" PARENT_SCOPE)
  if(config)
    set(${option} --config ${config} PARENT_SCOPE)
  endif()
endfunction()

# consumer_build(source binary config [options]): configures as difmesh was, and builds. Fresh: the
# defaults of options may have changed since the last time.
function(consumer_build source binary config)
  consumer_run(ignored ${CMAKE_COMMAND} --fresh -C ${OUTER_BUILD} -G ${outer_generator}
    -S ${source} -B ${binary} -D CMAKE_BUILD_TYPE=${config} ${ARGN})
  consumer_config_option(config_option "${config}")
  consumer_run(ignored ${CMAKE_COMMAND} --build ${binary} --parallel 2 ${config_option})
endfunction()

# consumer_program(VARIABLE binary config name): the path of a program, whether or not the generator
# has a folder for each configuration.
function(consumer_program path binary config name)
  find_program(found ${name} PATHS ${binary} ${binary}/${config} NO_DEFAULT_PATH NO_CACHE REQUIRED)
  set(${path} ${found} PARENT_SCOPE)
endfunction()
