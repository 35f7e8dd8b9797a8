# SPDX-License-Identifier: MIT
# Manual pages as packages have them, without the time in them: the same pages give the same bytes.
#   cmake -D FOLDER=... -D GZIP=... -P compress.cmake
if(GZIP)
  file(GLOB pages ${FOLDER}/*.1)
  execute_process(COMMAND ${GZIP} -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
endif()
