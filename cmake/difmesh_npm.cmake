# What comes from npm: the parts of the page of `difmesh view`, and the judges of the tests of glTF.

option(DIFMESH_WITH_NPM "Get three.js and the tests' judges from npm; without, no command view"
  ${DIFMESH_WITH_CLI})

# Installs web/package.json into the build folder, once for each package-lock.json, and sets
# DIFMESH_NPM_DIR to it, or to nothing and DIFMESH_NPM_MISSING to the reason.
function(difmesh_get_npm)
  set(DIFMESH_NPM_DIR "" PARENT_SCOPE)
  set(DIFMESH_NPM_MISSING "DIFMESH_WITH_NPM is off" PARENT_SCOPE)
  if(NOT DIFMESH_WITH_NPM)
    return()
  endif()
  find_program(DIFMESH_NODE node)
  find_program(DIFMESH_NPM npm)
  mark_as_advanced(DIFMESH_NODE DIFMESH_NPM)
  if(NOT DIFMESH_NODE OR NOT DIFMESH_NPM)
    set(DIFMESH_NPM_MISSING "node and npm are not installed" PARENT_SCOPE)
    message(STATUS
      "difmesh: node and npm are not installed: no command view, no judges of glTF")
    return()
  endif()
  # Debian 12's. esbuild and the tests' judges need it.
  execute_process(COMMAND ${DIFMESH_NODE} --version OUTPUT_VARIABLE version ERROR_QUIET)
  string(REGEX MATCH "[0-9]+[.0-9]*" version "${version}")
  if(version VERSION_LESS 18)
    set(DIFMESH_NPM_MISSING "node '${version}' is older than 18" PARENT_SCOPE)
    message(STATUS
      "difmesh: node '${version}' is older than 18: no command view, no judges of glTF")
    return()
  endif()
  set(source ${PROJECT_SOURCE_DIR}/web)
  set(folder ${PROJECT_BINARY_DIR}/npm)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source}/package-lock.json)
  file(SHA256 ${source}/package-lock.json hash)
  set(stamp ${folder}/${hash}.done)
  if(NOT EXISTS ${stamp})
    file(REMOVE_RECURSE ${folder})
    file(COPY ${source}/package.json ${source}/package-lock.json ${source}/.npmrc
      DESTINATION ${folder})
    # No scripts: no package here needs one, and none should run on a user's machine.
    execute_process(
      COMMAND ${DIFMESH_NPM} ci --ignore-scripts --fetch-retries=1 --fetch-timeout=30000
      WORKING_DIRECTORY ${folder}
      RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE words TIMEOUT 180)
    if(failed)
      set(DIFMESH_NPM_MISSING "npm could not get the packages of web/package.json" PARENT_SCOPE)
      message(WARNING "difmesh: no command view, no judges of glTF: npm ci failed: ${words}")
      return()
    endif()
    file(TOUCH ${stamp})
  endif()
  set(DIFMESH_NPM_DIR ${folder} PARENT_SCOPE)
  set(DIFMESH_NPM_MISSING "" PARENT_SCOPE)
endfunction()

difmesh_get_npm()
