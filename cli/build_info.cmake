# cmake -D TEMPLATE=… -D OUTPUT=… -D SOURCE=… -D …=… -P build_info.cmake: writes OUTPUT from TEMPLATE.
set(TAUT_COMMIT unknown)
if(EXISTS ${SOURCE}/.git)  # an unpacked archive can be inside another repository
  execute_process(COMMAND git --no-optional-locks -C ${SOURCE} describe --always --dirty --abbrev=12 --match=
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed EQUAL 0)
    set(TAUT_COMMIT ${commit})
  endif()
endif()
set(TAUT_LIBRARIES "")
foreach(library IN LISTS LIBRARIES)  # "fmt=9.1.0"; some .pc files have no version
  string(REGEX REPLACE "=$" "=unknown" library "${library}")
  string(REGEX REPLACE "^(.+)=(.+)$" "{\"\\1\", \"\\2\"},\n    " library "${library}")
  string(APPEND TAUT_LIBRARIES "${library}")
endforeach()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
