# SPDX-License-Identifier: BSD-3-Clause
# No document holds a placeholder that nobody filled in, or a link to a file that is not
# there.
include(${SETTINGS})

# faults_of(FILE VARIABLE) lists what is wrong with a document.
function(faults_of file variable)
  file(READ ${file} text)
  set(faults)
  string(REGEX MATCHALL "@[A-Z_]+@" placeholders "${text}")
  foreach(placeholder IN LISTS placeholders)
    list(APPEND faults "placeholder ${placeholder}")
  endforeach()
  string(REPLACE ";" "," text "${text}") # lists break at it, and are kept together by
  string(REPLACE "](" "<link>(" text "${text}") # brackets
  string(REGEX REPLACE "[][]" "" text "${text}")
  string(REGEX MATCHALL "<link>\\([^) \n]+\\)" links "${text}")
  get_filename_component(folder ${file} DIRECTORY)
  foreach(link IN LISTS links)
    string(REGEX REPLACE "^<link>\\(([^#)]*).*" "\\1" target "${link}")
    if(target AND NOT target MATCHES "^(https?|mailto):" AND NOT EXISTS ${folder}/${target})
      list(APPEND faults "link to ${target}")
    endif()
  endforeach()
  set(${variable} "${faults}" PARENT_SCOPE)
endfunction()

# The check itself finds what it is for.
set(sample ${work}/documents/sample.md)
file(WRITE ${sample} "[none](no/such.md#part), [here](sample.md), [web](https://a.b/c),\n"
  "[top](#top), a; [lambda](int a) 3 @RATIO@ x\n")
faults_of(${sample} faults)
if(NOT faults STREQUAL "placeholder @RATIO@;link to no/such.md")
  message(FATAL_ERROR "the sample has other faults: ${faults}")
endif()

file(GLOB documents ${source}/*.md)
foreach(folder modules share test)
  file(GLOB_RECURSE more ${source}/${folder}/*.md)
  list(APPEND documents ${more})
endforeach()
set(count 0)
foreach(document IN LISTS documents)
  faults_of(${document} faults)
  foreach(fault IN LISTS faults)
    message("${document}: ${fault}")
    math(EXPR count "${count} + 1")
  endforeach()
endforeach()
list(LENGTH documents size)
message("${size} documents, ${count} faults")
if(count OR size LESS 10)
  message(FATAL_ERROR "faults in the documents, or documents not found")
endif()
