# SPDX-License-Identifier: MIT
# `cpack -G DEB` after `cmake --preset package`: shakedown (the programs), libshakedown-dev, python3-shakedown.
set(packed programs development)
if(TARGET shakedown_python)
  list(APPEND packed python)
endif()

set(CPACK_PACKAGE_NAME shakedown)
set(CPACK_PACKAGE_VENDOR "the shakedown authors")
set(CPACK_PACKAGE_CONTACT "the shakedown authors <shakedown@shakedown.invalid>" CACHE STRING "who answers for the package")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${packed})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_BINARY_DIR}/check.cmake)
configure_file(check.cmake.in check.cmake @ONLY)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME shakedown)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "granular dampers: which effect is missing in the model
A box on a spring, partly filled with grains, loses its swing by impacts.
shakedown simulates it by several engines, compares it with what was filmed,
and says which physical effects are missing in the model, how strong each is,
and how probable.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libshakedown-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, nlohmann-json3-dev")
if(NOT BUILD_SHARED_LIBS)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    ", libfmt-dev, libmuparser-dev, libbullet-dev, libnlopt-dev, libnlopt-cxx-dev, libsqlite3-dev, libsndfile1-dev, libcairo2-dev, zlib1g-dev, pkg-config")
endif()
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "granular dampers: library and headers
What the programs of the package shakedown are made of, for C++20: setups,
engines, ensembles, measurements, diagnosis; with files for CMake
and pkg-config.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-shakedown)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${python_after}), python3-numpy")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "granular dampers: Python module
Setups, runs, ensembles, comparison with measurements, diagnosis and fits of
the program shakedown, with numpy arrays and pages for notebooks.")

# Each package has its licence and its changes, as Debian wants them.
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
configure_file(copyright.in copyright @ONLY)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH makes it the same again
configure_file(changelog.Debian.in changelog.Debian @ONLY)
find_program(GZIP gzip)
function(compressed file to)
  execute_process(COMMAND ${GZIP} -9nc ${file} OUTPUT_FILE ${CMAKE_CURRENT_BINARY_DIR}/${to} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
set(changes "")
if(GZIP AND SHAKEDOWN_DEBIAN)
  compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog.gz)
  compressed(${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian changelog.Debian.gz)
  set(changes ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz)
endif()
foreach(component IN LISTS packed)
  string(TOUPPER ${component} upper)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/copyright ${changes} DESTINATION ${folder} COMPONENT ${component})
endforeach()
include(CPack)
