# Debian packages the project stands on; scripts/setup installs them.
find_package(PkgConfig REQUIRED)
pkg_check_modules(LCM REQUIRED IMPORTED_TARGET lcm)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(TURBOJPEG REQUIRED IMPORTED_TARGET libturbojpeg)
pkg_check_modules(SODIUM REQUIRED IMPORTED_TARGET libsodium)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs)
find_package(embree 3.13 REQUIRED)
find_package(GTest REQUIRED)
find_package(tomlplusplus 3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(benchmark REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
find_package(ZLIB REQUIRED)
find_package(Ceres 2.1 REQUIRED)

# RapidCheck: Debian ships headers and a library, no CMake package of its own.
find_path(RAPIDCHECK_INCLUDE_DIR rapidcheck.h REQUIRED)
find_library(RAPIDCHECK_LIBRARY rapidcheck REQUIRED)
add_library(rapidcheck INTERFACE)
target_include_directories(rapidcheck SYSTEM INTERFACE ${RAPIDCHECK_INCLUDE_DIR})
target_link_libraries(rapidcheck INTERFACE ${RAPIDCHECK_LIBRARY})

# Peers to measure against; benchmarks only, never needed.
find_package(mrpt-slam QUIET)
pkg_check_modules(PCL_FEATURES QUIET IMPORTED_TARGET pcl_features)
foreach(peer mrpt-slam PCL_FEATURES)
  if(NOT ${peer}_FOUND)
    message(STATUS "${peer} is not installed: measured against others only (scripts/setup --peers)")
  endif()
endforeach()

find_program(CCACHE ccache)
if(CCACHE)
  # Paths are taken relative to the tree, so that two checkouts share what was compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}
                                  CCACHE_NOHASHDIR=1 ${CCACHE})
endif()

# OpenNI2 looks for drivers beside the library as it was loaded. Ours is a folder of links, so that
# our drivers stand beside the stock ones; programs find it by their RUNPATH (BUILD_RPATH).
pkg_check_modules(OPENNI2 REQUIRED libopenni2)
find_library(OPENNI2_LIBRARY OpenNI2 REQUIRED)
add_library(openni2_headers INTERFACE)
target_include_directories(openni2_headers SYSTEM INTERFACE ${OPENNI2_INCLUDE_DIRS})
add_library(openni2_client INTERFACE)
target_link_libraries(openni2_client INTERFACE openni2_headers ${OPENNI2_LIBRARY})
if(CMAKE_CXX_FLAGS_DEBUG MATCHES "sanitize=.*address")
  target_sources(openni2_client INTERFACE $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:
    ${CMAKE_SOURCE_DIR}/tests/support/openni2_leaks.cpp>)
endif()
get_filename_component(openni2_folder ${OPENNI2_LIBRARY} DIRECTORY)
set(ROOMWISE_OPENNI2_RPATH "\$ORIGIN/../openni2")
set(ROOMWISE_OPENNI2_DRIVERS ${CMAKE_BINARY_DIR}/openni2/OpenNI2/Drivers)
file(MAKE_DIRECTORY ${ROOMWISE_OPENNI2_DRIVERS})
file(CREATE_LINK ${openni2_folder}/libOpenNI2.so.0 ${CMAKE_BINARY_DIR}/openni2/libOpenNI2.so.0
     SYMBOLIC)
foreach(driver PS1080 PSLink OniFile)
  file(CREATE_LINK ${openni2_folder}/OpenNI2/Drivers/lib${driver}.so.0
       ${ROOMWISE_OPENNI2_DRIVERS}/lib${driver}.so.0 SYMBOLIC)
endforeach()
pkg_check_modules(FREENECT REQUIRED IMPORTED_TARGET libfreenect)
