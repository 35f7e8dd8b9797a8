# SPDX-License-Identifier: MIT
# Writes build_info.hpp. A source without its history (a tarball) has no commit.
set(COMMIT "unknown")
find_program(GIT git)
if(GIT)
  # The checkout may belong to another user (a container); only the commit's name is read.
  execute_process(COMMAND ${GIT} -c safe.directory=* describe --always --dirty=+changes --abbrev=12 --exclude=*
                  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE found RESULT_VARIABLE failed ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    set(COMMIT ${found})
  endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
