# SPDX-License-Identifier: MIT
# The programs and the Python module once more, for newer processors: the same sources in a build folder of their own, installed below libexec, where
# the programs that run anywhere find them at run time (harness/work/program_place.hpp; harness/python/shakedown/_processor.py).
set(SHAKEDOWN_ALSO_FOR "" CACHE STRING "compile programs and module for these processors too, to be chosen at run time: x86-64-v3 or nothing")
if(NOT SHAKEDOWN_ALSO_FOR)
  return()
endif()
if(NOT SHAKEDOWN_ALSO_FOR STREQUAL "x86-64-v3")
  message(FATAL_ERROR "SHAKEDOWN_ALSO_FOR is ${SHAKEDOWN_ALSO_FOR}; the programs choose at run time by x86-64-v3 alone: say that, or nothing.")
endif()
if(NOT SHAKEDOWN_CPU STREQUAL "portable" OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  return()  # this build has the machine's instructions already, or another machine's
endif()

include(ExternalProject)
set(faster ${PROJECT_BINARY_DIR}/${SHAKEDOWN_ALSO_FOR})
set(made shakedown shakedown-studies)
set(with_python OFF)
if(TARGET shakedown_python)
  set(with_python ON)
  list(APPEND made shakedown_python)
endif()
ExternalProject_Add(shakedown_faster
  SOURCE_DIR ${PROJECT_SOURCE_DIR} BINARY_DIR ${faster} PREFIX ${faster}/external
  CMAKE_ARGS -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
    -DSHAKEDOWN_CPU=${SHAKEDOWN_ALSO_FOR} -DSHAKEDOWN_PYTHON=${with_python} -DPython_EXECUTABLE=${Python_EXECUTABLE}
    -DSHAKEDOWN_TOGETHER=${SHAKEDOWN_TOGETHER} -DSHAKEDOWN_WERROR=${SHAKEDOWN_WERROR} -DSHAKEDOWN_INSTALL=OFF -DSHAKEDOWN_TESTS=OFF -DSHAKEDOWN_BENCH=OFF
    -DCMAKE_EXE_LINKER_FLAGS=-s -DCMAKE_MODULE_LINKER_FLAGS=-s
  CMAKE_GENERATOR ${CMAKE_GENERATOR}
  BUILD_COMMAND ${CMAKE_COMMAND} --build ${faster} --target ${made}
  BUILD_ALWAYS ON USES_TERMINAL_BUILD ON
  INSTALL_COMMAND "" TEST_COMMAND ""
  DEPENDS ${made})  # after these, so that two builds do not share the cores and the memory
install(PROGRAMS ${faster}/shakedown ${faster}/shakedown-studies
  DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/shakedown/${SHAKEDOWN_ALSO_FOR} COMPONENT programs)
if(TARGET shakedown_python)
  install(DIRECTORY ${faster}/python/shakedown/ DESTINATION ${SHAKEDOWN_PYTHON_FOLDER}/shakedown/${SHAKEDOWN_ALSO_FOR}
    COMPONENT python FILES_MATCHING PATTERN "_core*.so")
endif()
