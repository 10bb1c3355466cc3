# How this project's own targets are made: warnings are errors, headers are found from the root.
include(GoogleTest)
add_library(roomwise_flags INTERFACE)
target_compile_options(roomwise_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # g++ 12 warns wrongly about "text" + std::string (PR 105651)
  # Several sources compiled as one look like headers to g++, which then minds their private structs.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>
  -ffp-contract=off)  # no fused multiply-add: the same log gives the same bytes on every machine
target_include_directories(roomwise_flags INTERFACE ${CMAKE_SOURCE_DIR})

# Sets `out` to files that each include four of the sources: most of the time goes into the headers
# they share. (CMake's own UNITY_BUILD names the sources by absolute path, so that no other checkout
# could find them in the compiler's cache.)
function(roomwise_compiled_together out name)
  if(NOT ROOMWISE_COMPILE_TOGETHER)
    set(${out} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(files)
  set(content "")
  set(count 0)
  list(LENGTH ARGN sources)
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
    string(APPEND content "#include \"${source}\"\n")
    math(EXPR count "${count} + 1")
    math(EXPR in_batch "${count} % 4")
    if(in_batch EQUAL 0 OR count EQUAL sources)
      set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_together_${count}.cpp)
      file(CONFIGURE OUTPUT ${file} CONTENT "${content}" @ONLY)
      list(APPEND files ${file})
      set(content "")
    endif()
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# roomwise_library(NAME SOURCES a.cpp ... LINKS target ...)
function(roomwise_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  roomwise_compiled_together(arg_SOURCES ${name} ${arg_SOURCES})
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PUBLIC ${arg_LINKS} PRIVATE $<BUILD_INTERFACE:roomwise_flags>)
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
endfunction()

# roomwise_program(NAME SOURCES a.cpp ... LINKS target ...)
function(roomwise_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} roomwise_flags)
endfunction()

# roomwise_test(NAME LABEL label [TIMEOUT s] [SERIAL] [WHOLE] [APART] SOURCES a_test.cpp ...
#               LINKS target ...)
# One gtest program, lightly optimised; every TEST in it becomes a ctest entry with that label.
# SERIAL: never beside another test. WHOLE: one ctest entry. APART: each file compiled on its own.
# RapidCheck's seed is fixed: a red run can be run again.
function(roomwise_test name)
  cmake_parse_arguments(arg "SERIAL;WHOLE;APART" "LABEL;TIMEOUT" "SOURCES;LINKS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  if(NOT arg_APART)
    roomwise_compiled_together(arg_SOURCES ${name} ${arg_SOURCES})
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} test_build_paths GTest::gtest GTest::gmock
                                        GTest::gtest_main roomwise_flags)
  target_compile_options(${name} PRIVATE -O1)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  set(properties LABELS "${arg_LABEL}" TIMEOUT ${arg_TIMEOUT} ENVIRONMENT "RC_PARAMS=seed=2012"
                 RUN_SERIAL ${arg_SERIAL})
  if(arg_WHOLE)
    add_test(NAME ${arg_LABEL}.${name} COMMAND ${name})
    set_tests_properties(${arg_LABEL}.${name} PROPERTIES ${properties})
  else()
    gtest_discover_tests(${name} TEST_PREFIX "${arg_LABEL}." DISCOVERY_TIMEOUT 60
                         PROPERTIES ${properties})
  endif()
endfunction()

# roomwise_fuzzer(NAME SOURCES fuzz_x.cpp LINKS target ...): only where clang builds with ROOMWISE_FUZZ.
function(roomwise_fuzzer name)
  if(NOT ROOMWISE_FUZZ)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} roomwise_flags -fsanitize=fuzzer)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
endfunction()
