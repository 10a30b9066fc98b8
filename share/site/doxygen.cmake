# SPDX-License-Identifier: BSD-3-Clause
# Runs Doxygen with FOLDER/Doxyfile, and fails if it warns of what KNOWN, lines `header reason`,
# does not name.
file(MAKE_DIRECTORY ${FOLDER}/site)
execute_process(COMMAND ${DOXYGEN} ${FOLDER}/Doxyfile RESULT_VARIABLE failed)
file(STRINGS ${FOLDER}/site_doxygen.log warnings REGEX "warning:")
list(LENGTH warnings all)
file(STRINGS ${KNOWN} known)
foreach(line IN LISTS known)
  string(REGEX MATCH "^[^ ]+" header "${line}")
  list(FILTER warnings EXCLUDE REGEX "/${header}:")
endforeach()
list(LENGTH warnings count)
list(JOIN warnings "\n" text)
message("${all} warnings, of which ${count} are not known\n${text}")
if(failed OR count)
  message(FATAL_ERROR "Doxygen warns")
endif()
