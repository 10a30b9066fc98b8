# SPDX-License-Identifier: BSD-3-Clause
# pcl6d_add_module, pcl6d_add_app, pcl6d_add_test, pcl6d_add_benchmark and the package.
include(CMakePackageConfigHelpers)

# Stops when a helper was called with an argument that it does not know.
macro(_pcl6d_check_arguments helper)
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${helper}: unknown arguments: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  if(ARG_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "${helper}: no value for: ${ARG_KEYWORDS_MISSING_VALUES}")
  endif()
endmacro()

# Warnings and floating-point rules of every target; none of it reaches a user's code.
function(_pcl6d_compile_rules target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -ffp-contract=off # the same bits on every x86-64 CPU
    ${PCL6D_FEWER_COLLECTIONS}
    $<$<BOOL:${PCL6D_WERROR}>:-Werror>)
endfunction()

# Several sources of a target as one: headers are parsed, and Eigen's types are made, once for all
# of them. batch: how many at most, PCL6D_BATCH if empty; the units become about equally large.
# ARGN: sources whose own names (of unnamed namespaces) are also names of others beside them, or
# that take long enough alone.
function(_pcl6d_unity target batch)
  if(NOT batch)
    set(batch ${PCL6D_BATCH})
  endif()
  get_target_property(sources ${target} SOURCES)
  if(ARGN)
    list(REMOVE_ITEM sources ${ARGN})
  endif()
  list(LENGTH sources count)
  math(EXPR units "(${count} + ${batch} - 1) / ${batch}")
  if(units GREATER 0)
    math(EXPR batch "(${count} + ${units} - 1) / ${units}")
  endif()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${PCL6D_UNITY_BUILD}
    UNITY_BUILD_BATCH_SIZE ${batch})
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# pcl6d_hot_sources(NAME sources ...)
# Sources of the module NAME, which is COOL, that have loops over all points: -O2, as one unit.
# They have no precompiled header, for that has the optimisation of the others.
function(pcl6d_hot_sources name)
  set(sources ${ARGN})
  if(PCL6D_UNITY_BUILD)
    list(TRANSFORM sources REPLACE "(.+)" "#include \"${CMAKE_CURRENT_SOURCE_DIR}/\\1\"\n"
      OUTPUT_VARIABLE includes)
    list(JOIN includes "" includes)
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/${name}_hot.cpp)
    file(CONFIGURE OUTPUT ${sources} CONTENT "${includes}" @ONLY)
  endif()
  set_source_files_properties(${sources} PROPERTIES
    SKIP_PRECOMPILE_HEADERS ON
    COMPILE_OPTIONS $<$<CONFIG:Release>:-O2>) # which takes it out of the other units
  target_sources(pcl6d_${name} PRIVATE ${sources})
endfunction()

# Gives a library of the suite its headers, name, version and installation.
function(_pcl6d_library_rules target module)
  add_library(pcl6d::${target} ALIAS pcl6d_${target})
  set_target_properties(pcl6d_${target} PROPERTIES
    EXPORT_NAME ${target}
    DEFINE_SYMBOL ""
    POSITION_INDEPENDENT_CODE ON # static ones may become part of a user's shared one
    CXX_VISIBILITY_PRESET hidden # shown: what public headers declare (export.h)
    VISIBILITY_INLINES_HIDDEN ON
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(pcl6d_${target} PUBLIC cxx_std_17)
  _pcl6d_compile_rules(pcl6d_${target})
  install(TARGETS pcl6d_${target} EXPORT pcl6d_${module}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${module}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${module})
endfunction()

# Optimisation of a library, and the precompiled header that has it. is_cool: COOL of
# pcl6d_add_module.
function(_pcl6d_optimise target is_cool)
  if(is_cool)
    target_compile_options(${target} PRIVATE ${PCL6D_COOL_OPTIMISATION})
    pcl6d_precompile(${target} cool)
  else()
    pcl6d_precompile(${target} hot)
  endif()
endfunction()

# pcl6d_add_module(NAME BOOK chapters HOLDS text FLOOR n SOURCES ... [ALONE sources ...]
#                  [DEPENDS module ...] [PCL_COMPONENTS ...] [LINK public targets ...]
#                  [LINK_PRIVATE targets ...] [COOL] [BATCH n])
# makes the library pcl6d::NAME. A module may depend only on lower floors. BOOK and
# HOLDS are for the map of the rooms (CONTRIBUTING.md). COOL: its work is not in loops over
# points (files, text, pictures, the order of a run): it compiles with less optimisation. BATCH: how many
# sources are compiled as one.
function(pcl6d_add_module name)
  cmake_parse_arguments(ARG "COOL" "BOOK;HOLDS;FLOOR;BATCH"
    "SOURCES;ALONE;DEPENDS;PCL_COMPONENTS;LINK;LINK_PRIVATE" ${ARGN})
  _pcl6d_check_arguments("pcl6d_add_module(${name})")
  set(target pcl6d_${name})
  add_library(${target} ${ARG_SOURCES}) # BUILD_SHARED_LIBS says which kind
  _pcl6d_library_rules(${name} ${name})
  _pcl6d_unity(${target} "${ARG_BATCH}" ${ARG_ALONE})
  _pcl6d_optimise(${target} ${ARG_COOL})
  set_target_properties(${target} PROPERTIES PCL6D_FLOOR ${ARG_FLOOR})
  target_include_directories(${target}
    PUBLIC
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/internal> # not installed
      $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE src)

  foreach(module IN LISTS ARG_DEPENDS)
    if(NOT TARGET pcl6d_${module})
      message(FATAL_ERROR "Module ${name}: no module ${module} below it")
    endif()
    get_target_property(floor pcl6d_${module} PCL6D_FLOOR)
    if(NOT floor LESS ARG_FLOOR)
      message(FATAL_ERROR
        "Module ${name} (floor ${ARG_FLOOR}) must not depend on ${module} (floor ${floor})")
    endif()
    target_link_libraries(${target} PUBLIC pcl6d_${module})
  endforeach()
  list(TRANSFORM ARG_PCL_COMPONENTS PREPEND pcl_ OUTPUT_VARIABLE pcl_targets)
  target_link_libraries(${target}
    PUBLIC ${pcl_targets} ${ARG_LINK} PRIVATE ${ARG_LINK_PRIVATE})

  set_property(GLOBAL APPEND PROPERTY PCL6D_MODULES ${name})
  string(JOIN " " below ${ARG_DEPENDS})
  set_property(GLOBAL APPEND_STRING PROPERTY PCL6D_ROOMS
    "| ${ARG_FLOOR} | [${name}](modules/${name}) | ${ARG_BOOK} | ${ARG_HOLDS} | ${below} |\n")
  set_property(GLOBAL PROPERTY PCL6D_${name}_DEPENDS ${ARG_DEPENDS})
  set_property(GLOBAL PROPERTY PCL6D_${name}_PCL_COMPONENTS ${ARG_PCL_COMPONENTS})
  set_property(GLOBAL PROPERTY PCL6D_${name}_PRIVATE ${ARG_LINK_PRIVATE})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${name}
    OPTIONAL) # some modules serve our programs only
  install(EXPORT pcl6d_${name} NAMESPACE pcl6d:: FILE module_${name}.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pcl6d COMPONENT ${name})
endfunction()

# pcl6d_add_part(MODULE PART SOURCES ... [LINK_PRIVATE targets ...])
# makes the static library pcl6d::MODULE_PART: sources of a module whose headers are all internal,
# for those programs and tests that name it in DEPENDS. Whoever links the module alone, such as the
# target demo, does not compile them. A part uses of its module only what that shows to others
# (PCL6D_EXPORTS). Nothing of it is installed. COOL as in pcl6d_add_module.
function(pcl6d_add_part module part)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "COOL" "" "SOURCES;LINK_PRIVATE")
  _pcl6d_check_arguments("pcl6d_add_part(${module} ${part})")
  set(target pcl6d_${module}_${part})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(pcl6d::${module}_${part} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    DEFINE_SYMBOL ""
    POSITION_INDEPENDENT_CODE ON # as the module, so that they share a precompiled header
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  _pcl6d_compile_rules(${target})
  _pcl6d_unity(${target} "")
  _pcl6d_optimise(${target} ${ARG_COOL})
  target_include_directories(${target} PRIVATE src)
  target_link_libraries(${target} PUBLIC pcl6d_${module} PRIVATE ${ARG_LINK_PRIVATE})
endfunction()

# pcl6d_add_late_library(NAME SOURCES ... LINK_PRIVATE targets ... COMPONENT name)
# makes a library that nothing is linked with, so that who needs none of it need not build
# it: it is opened when it is asked for (late_library.h). For shared libraries only; where
# the suite is static, what opens it has its sources.
function(pcl6d_add_late_library name)
  cmake_parse_arguments(ARG "" "COMPONENT" "SOURCES;LINK_PRIVATE" ${ARGN})
  _pcl6d_check_arguments("pcl6d_add_late_library(${name})")
  add_library(${name} MODULE ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  _pcl6d_compile_rules(${name})
  _pcl6d_unity(${name} "")
  target_compile_options(${name} PRIVATE ${PCL6D_COOL_OPTIMISATION})
  pcl6d_precompile(${name} cool)
  target_link_libraries(${name} PRIVATE ${ARG_LINK_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY PCL6D_LATE_LIBRARIES ${name})
  install(TARGETS ${name}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${ARG_COMPONENT})
endfunction()

# Whoever simulates may ask for any world, and no link brings the library that has them.
function(_pcl6d_need_worlds target)
  foreach(user IN ITEMS benchmarking simulation pcl_slam6d_evaluate pcl_slam6d_simulate)
    if(user IN_LIST ARGN AND TARGET pcl6d_simulation_worlds)
      add_dependencies(${target} pcl6d_simulation_worlds)
    endif()
  endforeach()
endfunction()

# pcl6d_add_pcl_classes(NAME SOURCES ... [PCL_COMPONENTS ...])
# makes pcl6d::NAME_pcl: the PCL classes of the module NAME (its headers in .../pcl/) and
# their explicit instances, so that the module's core compiles without PCL's templates.
function(pcl6d_add_pcl_classes name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PCL_COMPONENTS" ${ARGN})
  _pcl6d_check_arguments("pcl6d_add_pcl_classes(${name})")
  set(target pcl6d_${name}_pcl)
  add_library(${target} ${ARG_SOURCES}) # BUILD_SHARED_LIBS says which kind
  _pcl6d_library_rules(${name}_pcl ${name})
  # Instances are as visible as their arguments: PCL's point types, which PCL does not
  # mark. So nothing is hidden here; there are no internals, and few, heavy sources.
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET default
    VISIBILITY_INLINES_HIDDEN OFF)
  # They only convert; ten instances of each method take the optimiser most of the time.
  target_compile_options(${target} PRIVATE ${PCL6D_COOL_OPTIMISATION})
  target_include_directories(${target} PRIVATE src)
  list(TRANSFORM ARG_PCL_COMPONENTS PREPEND pcl_ OUTPUT_VARIABLE pcl_targets)
  target_link_libraries(${target} PUBLIC pcl6d_${name} ${pcl_targets})
  get_property(depends GLOBAL PROPERTY PCL6D_${name}_DEPENDS)
  foreach(module IN LISTS depends)
    if(TARGET pcl6d_${module}_pcl)
      target_link_libraries(${target} PUBLIC pcl6d_${module}_pcl)
    endif()
  endforeach()
  set_property(GLOBAL APPEND PROPERTY
    PCL6D_${name}_PCL_COMPONENTS ${ARG_PCL_COMPONENTS})
endfunction()

# pcl6d_app_rules(TARGET [BATCH n] [sources that compile alone ...])
# How the sources of programs are compiled, in a library of apps/ or in the program itself.
function(pcl6d_app_rules target)
  cmake_parse_arguments(PARSE_ARGV 1 RULES "" "BATCH" "")
  _pcl6d_compile_rules(${target})
  _pcl6d_unity(${target} "${RULES_BATCH}" ${RULES_UNPARSED_ARGUMENTS})
  # As the libraries, so that they share a precompiled header, in which Eigen's types are hidden.
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${target} PRIVATE -fPIC ${PCL6D_COOL_OPTIMISATION})
  pcl6d_precompile(${target} cool)
endfunction()

# pcl6d_add_app(NAME SOURCES ... [ALONE sources ...] [DEPENDS module ...]
#               [LINK_PRIVATE targets ...] [BATCH n])
# makes the program NAME in bin/, with the plumbing of apps/common.
function(pcl6d_add_app name)
  cmake_parse_arguments(ARG "" "BATCH" "SOURCES;ALONE;DEPENDS;LINK_PRIVATE" ${ARGN})
  _pcl6d_check_arguments("pcl6d_add_app(${name})")
  add_executable(${name} ${ARG_SOURCES})
  if(NOT ARG_BATCH)
    set(ARG_BATCH ${PCL6D_BATCH})
  endif()
  pcl6d_app_rules(${name} BATCH ${ARG_BATCH} ${ARG_ALONE})
  list(TRANSFORM ARG_DEPENDS PREPEND pcl6d:: OUTPUT_VARIABLE modules)
  target_link_libraries(${name} PRIVATE pcl6d_apps_common ${modules} ${ARG_LINK_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY PCL6D_APPS ${name})
  install(TARGETS ${name} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT apps)
endfunction()

# pcl6d_add_test(NAME SOURCES ... [DEPENDS module ...] [LINK_PRIVATE targets ...]
#                [PROGRAMS app ...] [LABELS data|slow ...] [LOCK name] [ALONE sources ...]
#                [BATCH n])
# makes a GoogleTest program, each of whose test suites is one test of ctest: what a suite sets
# up for its tests is made once, and one test alone runs by --gtest_filter. The PROGRAMS, whose
# folder is PCL6D_BIN_DIR (test/support/folders.h), are built before it.
# Tests with the same LOCK never run at the same time. BATCH sources are compiled as one,
# as the headers cost most of the time; ALONE are those that need a unit to themselves.
function(pcl6d_add_test name)
  cmake_parse_arguments(ARG "" "LOCK;BATCH"
    "SOURCES;DEPENDS;LINK_PRIVATE;PROGRAMS;LABELS;ALONE" ${ARGN})
  _pcl6d_check_arguments("pcl6d_add_test(${name})")
  if(NOT ARG_BATCH)
    set(ARG_BATCH 6)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  _pcl6d_compile_rules(${name})
  # Some packages ask for -fPIC; all tests take it, so that they share a precompiled header.
  target_compile_options(${name} PRIVATE -fPIC ${PCL6D_COOL_OPTIMISATION})
  if(PCL6D_UNITY_BUILD) # GCC takes fixtures of an included source for those of a header
    target_compile_options(${name} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(ARG_DEPENDS) # tests of programs alone see no headers of the suite
    pcl6d_precompile(${name} test)
  endif()
  set_target_properties(${name} PROPERTIES
    UNITY_BUILD ${PCL6D_UNITY_BUILD}
    UNITY_BUILD_BATCH_SIZE ${ARG_BATCH}
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/test/bin)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  list(TRANSFORM ARG_DEPENDS PREPEND pcl6d:: OUTPUT_VARIABLE modules)
  target_link_libraries(${name} PRIVATE
    ${modules} ${ARG_LINK_PRIVATE} pcl6d_test_support GTest::gtest_main)
  if(ARG_PROGRAMS)
    add_dependencies(${name} ${ARG_PROGRAMS})
  endif()
  _pcl6d_need_worlds(${name} ${ARG_DEPENDS} ${ARG_PROGRAMS})
  set(properties "TIMEOUT 1500")
  if(ARG_LABELS)
    string(APPEND properties " LABELS \"${ARG_LABELS}\"")
  endif()
  if(ARG_LOCK)
    string(APPEND properties " RESOURCE_LOCK ${ARG_LOCK}")
  endif()
  _pcl6d_discover_suites(${name} "${properties}")
endfunction()

# Asks a test program, once it is linked, for its suites.
function(_pcl6d_discover_suites name properties)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  set(script ${PROJECT_SOURCE_DIR}/cmake/test_suites.cmake)
  add_custom_command(TARGET ${name} POST_BUILD
    BYPRODUCTS ${file}
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${name}> -D NAME=${name}
      -D FILE=${file} -D "PROPERTIES=${properties}" -P ${script}
    VERBATIM)
  set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS ${script})
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
  file(CONFIGURE OUTPUT ${include} @ONLY CONTENT
"if(EXISTS \"@file@\")
  include(\"@file@\")
else()
  add_test(@name@_NOT_BUILT @name@_NOT_BUILT)
endif()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()

# pcl6d_add_benchmark(NAME SOURCES ... [DEPENDS module ...] [LINK_PRIVATE targets ...])
# makes the program NAME in bin/, beside the apps; it is not installed.
function(pcl6d_add_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LINK_PRIVATE" ${ARGN})
  _pcl6d_check_arguments("pcl6d_add_benchmark(${name})")
  add_executable(${name} ${ARG_SOURCES})
  _pcl6d_compile_rules(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  list(TRANSFORM ARG_DEPENDS PREPEND pcl6d:: OUTPUT_VARIABLE modules)
  target_link_libraries(${name} PRIVATE
    ${modules} ${ARG_LINK_PRIVATE} benchmark::benchmark)
  _pcl6d_need_worlds(${name} ${ARG_DEPENDS})
endfunction()

# Installs pcl6dConfig.cmake, which knows every module and what it needs.
function(pcl6d_install_package)
  get_property(PCL6D_MODULES GLOBAL PROPERTY PCL6D_MODULES)
  set(PCL6D_MODULE_TABLE "")
  foreach(module IN LISTS PCL6D_MODULES)
    get_property(depends GLOBAL PROPERTY PCL6D_${module}_DEPENDS)
    get_property(components GLOBAL PROPERTY PCL6D_${module}_PCL_COMPONENTS)
    if(NOT BUILD_SHARED_LIBS) # who links a static library links what it hides, too
      get_property(hidden GLOBAL PROPERTY PCL6D_${module}_PRIVATE)
    endif()
    string(APPEND PCL6D_MODULE_TABLE
      "set(_pcl6d_${module}_depends ${depends})\n"
      "set(_pcl6d_${module}_pcl ${components})\n"
      "set(_pcl6d_${module}_private ${hidden})\n")
  endforeach()
  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/pcl6d)
  configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/cmake/pcl6dConfig.cmake.in
    ${PROJECT_BINARY_DIR}/pcl6dConfig.cmake INSTALL_DESTINATION ${destination})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/pcl6dConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES
    ${PROJECT_BINARY_DIR}/pcl6dConfig.cmake
    ${PROJECT_BINARY_DIR}/pcl6dConfigVersion.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindLz4.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindOctoMap.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindZstd.cmake
    DESTINATION ${destination} COMPONENT common)
  pcl6d_install_pkg_config()
endfunction()

# Installs pcl6d.pc, with all libraries and the packages whose headers theirs include.
function(pcl6d_install_pkg_config)
  get_property(modules GLOBAL PROPERTY PCL6D_MODULES)
  set(names "")
  set(components common)
  foreach(module IN LISTS modules)
    get_property(of_module GLOBAL PROPERTY PCL6D_${module}_PCL_COMPONENTS)
    list(APPEND components ${of_module})
    list(APPEND names pcl6d_${module})
    if(TARGET pcl6d_${module}_pcl)
      list(APPEND names pcl6d_${module}_pcl)
    endif()
  endforeach()
  list(REVERSE names) # who needs a library stands before it
  list(REMOVE_DUPLICATES components)
  list(JOIN names " -l" PCL6D_LIBRARY_NAMES)
  list(JOIN components " pcl_" PCL6D_PCL_NAMES)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/pcl6d.pc.in ${PROJECT_BINARY_DIR}/pcl6d.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/pcl6d.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT common)
endfunction()

# The map of the rooms in CONTRIBUTING.md, between two comments: the target `rooms` writes
# it anew, the test house.rooms compares.
function(pcl6d_add_rooms)
  get_property(rooms GLOBAL PROPERTY PCL6D_ROOMS)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/rooms.md @ONLY CONTENT
"| floor | module | book | content | builds on |
|---|---|---|---|---|
@rooms@")
  set(script ${CMAKE_COMMAND} -D TABLE=${PROJECT_BINARY_DIR}/rooms.md
    -D DOCUMENT=${PROJECT_SOURCE_DIR}/CONTRIBUTING.md)
  add_custom_target(rooms
    COMMAND ${script} -P ${PROJECT_SOURCE_DIR}/cmake/rooms.cmake)
  if(PCL6D_BUILD_TESTS)
    add_test(NAME house.rooms
      COMMAND ${script} -D CHECK=ON -P ${PROJECT_SOURCE_DIR}/cmake/rooms.cmake)
  endif()
endfunction()
