# Installs the built tree (BUILD) to a fresh prefix below FOLDER, builds the
# project beside this file against it, natively optimised, and requires that it
# prints what the same program built within the tree (EXPECTED) prints.
file(REMOVE_RECURSE ${FOLDER})
set(build ${FOLDER}/build)
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${text}")
  endif()
  set(text ${text} PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${build} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${FOLDER}/prefix)
run(${CMAKE_COMMAND} --build ${build})
run(${build}/sem_user)
set(found "${text}")
run(${EXPECTED})
if(NOT found STREQUAL text)
  message(FATAL_ERROR "installed library:\n${found}\nwithin the tree:\n${text}")
endif()
file(GLOB_RECURSE targets ${FOLDER}/prefix/*sem-targets.cmake)
file(READ ${targets} text)
if(text MATCHES "-Wall|sem_flags|sem_precompiled|${BUILD}")
  message(FATAL_ERROR "the exported targets carry flags or paths of the build: ${CMAKE_MATCH_0}")
endif()
