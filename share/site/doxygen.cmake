# SPDX-License-Identifier: BSD-3-Clause
# Runs Doxygen with FOLDER/Doxyfile, and fails if it warns.
file(MAKE_DIRECTORY ${FOLDER}/site)
execute_process(COMMAND ${DOXYGEN} ${FOLDER}/Doxyfile RESULT_VARIABLE failed)
file(STRINGS ${FOLDER}/site_doxygen.log warnings REGEX "warning:")
list(LENGTH warnings count)
list(JOIN warnings "\n" text)
message("${count} warnings\n${text}")
if(failed OR count)
  message(FATAL_ERROR "Doxygen warns")
endif()
