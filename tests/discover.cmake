# Writes the script OUTPUT, which adds each test case of PROGRAM to CTest as "FOLDER: name", with its suite as label
# and with PROPERTIES. Unlike doctest's script, runs PROGRAM once and also labels test cases with a comma in the name.
execute_process(COMMAND ${PROGRAM} --list-test-cases --reporters=xml OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)

# characters that would end a list element, or keep it open
string(REPLACE ";" "&semicolon." listed "${listed}")
string(REPLACE "[" "&open." listed "${listed}")
string(REPLACE "]" "&close." listed "${listed}")
string(REGEX MATCHALL "<TestCase name=[^\n]*" cases "${listed}")
set(script "")
foreach(case IN LISTS cases)
  if(NOT case MATCHES "name=\"([^\"]*)\" testsuite=\"([^\"]+)\"")
    message(FATAL_ERROR "${PROGRAM}: a test case needs a name and a suite: ${case}")
  endif()
  set(name "${CMAKE_MATCH_1}")
  set(label "${CMAKE_MATCH_2}")
  foreach(mark IN ITEMS "&open. [" "&close. ]" "&lt; <" "&gt; >" "&quot; \"" "&amp; &")
    string(REGEX MATCH "^([^ ]+) (.+)$" mark "${mark}")
    string(REPLACE "${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}" name "${name}")
  endforeach()
  string(REPLACE "&semicolon." ";" name "${name}")
  string(REPLACE "," "\\," pattern "${name}")  # doctest would split the pattern at a comma
  string(APPEND script "add_test([==[${FOLDER}: ${name}]==] [==[${PROGRAM}]==] [==[--test-case=${pattern}]==])\n"
    "set_tests_properties([==[${FOLDER}: ${name}]==] PROPERTIES LABELS ${label} ${PROPERTIES})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
