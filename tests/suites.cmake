# SPDX-License-Identifier: MIT
# Included by ctest with `folder`, `program` (its tests) and `list` (a file of this build): one entry a suite, of those that are not slow.
# With one a test most of the time would go into starting processes. A suite that fails names its tests in the output.
if(NOT EXISTS "${program}")
  add_test("${folder}_NOT_BUILT" "${folder}_NOT_BUILT")
  return()
endif()
if(NOT EXISTS "${list}" OR NOT "${list}" IS_NEWER_THAN "${program}")
  execute_process(COMMAND "${program}" "--gtest_list_tests" "--gtest_filter=-Slow*:*/Slow*" OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${program} cannot list its tests: ${failed}")
  endif()
  string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")  # indented lines are their tests
  list(TRANSFORM suites STRIP)
  list(TRANSFORM suites REPLACE "\\.$" "")
  file(WRITE "${list}" "${suites}")
endif()
file(READ "${list}" suites)
foreach(suite IN LISTS suites)
  set(entry "${folder}.${suite}")
  add_test("${entry}" "${program}" "--gtest_filter=${suite}.*")
  # Skipped is a suite of which no test ran and none failed.
  set_tests_properties("${entry}" PROPERTIES TIMEOUT 300
                       SKIP_REGULAR_EXPRESSION "PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\] [^\n]*\n)+$")
endforeach()
