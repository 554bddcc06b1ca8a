# Run once a test program is built: writes a file that makes each of its suites a ctest test.
#   cmake -D PROGRAM=file -D WITHOUT=filter -D PROPERTIES=list -D OUTPUT=file -P add_suites.cmake
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests "--gtest_filter=-${WITHOUT}"
                OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
# Suites stand at the begin of their lines and end with a dot; their cases are indented.
string(REGEX MATCHALL "(^|\n)[^ \n.]+\\." suites "${listed}")
set(script "")
foreach(suite ${suites})
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" name "${suite}")
  # A skipped case would hide among those that passed: it belongs to BUT of limbcast_add_test.
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}*-${WITHOUT}]==])\n"
                       "set_tests_properties([==[${name}]==] PROPERTIES\n"
                       "  FAIL_REGULAR_EXPRESSION [==[\\[  SKIPPED \\]]==] ${PROPERTIES})\n")
endforeach()
file(WRITE "${OUTPUT}" "${script}")
