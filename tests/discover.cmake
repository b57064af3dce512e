# Writes OUTPUT, with which CTest knows the test cases of PROGRAM: each as "FOLDER: name", with its suite as
# label and with PROPERTIES. It asks the program once; doctest's own script asks it once more for each test, which
# takes ten seconds of a build, and gives no label to a test whose name has a comma.
execute_process(COMMAND ${PROGRAM} --list-test-cases --reporters=xml OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)

# what would end an element of a list, or keep it from ending
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
  string(REPLACE "," "\\," pattern "${name}")  # where doctest would see the end of one pattern of several
  string(APPEND script "add_test([==[${FOLDER}: ${name}]==] [==[${PROGRAM}]==] [==[--test-case=${pattern}]==])\n"
    "set_tests_properties([==[${FOLDER}: ${name}]==] PROPERTIES LABELS ${label} ${PROPERTIES})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
