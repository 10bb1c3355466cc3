# How this project's own targets are made: warnings are errors, headers are found from the root.
include(GoogleTest)
add_library(roomwise_flags INTERFACE)
target_compile_options(roomwise_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # g++ 12 warns wrongly about "text" + std::string (PR 105651)
  # Several sources compiled as one look like headers to g++, which then minds their private structs.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-subobject-linkage>
  -ffp-contract=off)  # no fused multiply-add: the same log gives the same bytes on every machine
target_include_directories(roomwise_flags INTERFACE ${CMAKE_SOURCE_DIR})

# roomwise_library(NAME SOURCES a.cpp ... LINKS target ...)
function(roomwise_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
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

# roomwise_test(NAME LABEL label [TIMEOUT s] [SERIAL] SOURCES a_test.cpp ... LINKS target ...)
# One gtest program; every TEST in it becomes a ctest entry with that label. Compiled a few files at
# a time and lightly optimised: most of the time goes into the headers of gtest and RapidCheck.
# SERIAL: never beside another test. RapidCheck's seed is fixed: a red run can be run again.
function(roomwise_test name)
  cmake_parse_arguments(arg "SERIAL" "LABEL;TIMEOUT" "SOURCES;LINKS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} GTest::gtest GTest::gmock GTest::gtest_main
                                        roomwise_flags)
  target_compile_definitions(${name} PRIVATE
    ROOMWISE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" ROOMWISE_BIN_DIR="${CMAKE_BINARY_DIR}/bin")
  target_compile_options(${name} PRIVATE -O1)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests
                                           UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
  gtest_discover_tests(${name} TEST_PREFIX "${arg_LABEL}." DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS "${arg_LABEL}" TIMEOUT ${arg_TIMEOUT}
                                  ENVIRONMENT "RC_PARAMS=seed=2012" RUN_SERIAL ${arg_SERIAL})
endfunction()

# roomwise_fuzzer(NAME SOURCES fuzz_x.cpp LINKS target ...): only in the fuzz preset.
function(roomwise_fuzzer name)
  if(NOT ROOMWISE_FUZZ)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} roomwise_flags -fsanitize=fuzzer)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
endfunction()
