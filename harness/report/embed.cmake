# SPDX-License-Identifier: MIT
# Makes a C++ source of the page's files, and checks that the vendored ones are what they were.
#   cmake -D FOLDER=... -D OUTPUT=... -P embed.cmake
file(STRINGS ${FOLDER}/vendor/uPlot/sha256.txt digests)
foreach(line IN LISTS digests)
  string(REGEX MATCH "^([0-9a-f]+) +(.+)$" whole "${line}")
  file(SHA256 ${FOLDER}/vendor/uPlot/${CMAKE_MATCH_2} found)
  if(NOT found STREQUAL CMAKE_MATCH_1)
    message(FATAL_ERROR "vendor/uPlot/${CMAKE_MATCH_2} is not the file that sha256.txt names; fetch it again (vendor/uPlot/README.md)")
  endif()
endforeach()

set(source "// Made by embed.cmake.\n#include \"page_files.hpp\"\n\nnamespace shakedown {\n")
foreach(item IN ITEMS "plot_script=vendor/uPlot/uPlot.iife.min.js" "plot_style=vendor/uPlot/uPlot.min.css" "plot_licence=vendor/uPlot/LICENSE"
        "page_script=page/page.js" "replay_script=page/replay.js" "model_script=page/model.js" "knobs_script=page/knobs.js" "figures_script=page/figures.js" "page_style=page/page.css")
  string(REGEX MATCH "^([^=]+)=(.+)$" whole "${item}")
  set(name ${CMAKE_MATCH_1})
  set(item_file ${CMAKE_MATCH_2})
  file(READ ${FOLDER}/${CMAKE_MATCH_2} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" escaped "${hex}")
  # Adjacent literals, for lines that tools can show.
  string(REGEX REPLACE "(................................................................................................)" "\\1\"\n\"" escaped "${escaped}")
  string(APPEND source "const char* const ${name} = \"${escaped}\";\n")
  if(name MATCHES "_script$")
    file(SHA256 ${FOLDER}/${item_file} digest)
    string(APPEND source "const char* const ${name}_sha256 = \"${digest}\";\n")
  endif()
endforeach()
string(APPEND source "}  // namespace shakedown\n")
file(WRITE ${OUTPUT} "${source}")
