# Installs graze into a prefix of its own. Builds and runs programs against it. By its CMake package: the contract's
# program and one that hands graze many types, for several instruction sets. By pkg-config: the contract's program.
#
# `static` is the build under test, as users build it. Against it there are two more: one that responds to contacts, and
# one whose boxes stand on boxes. `shared` is core and scheduler alone, of which it is asked only that they work. They are
# built as a subproject, with a program in that project, and installed from there. So both questions take one build;
# configure.cmake has a subproject with static ones.

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Built sooner: what is asked is whether they work, not how fast.
set(quick "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16)
set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${prefix})
if(KIND STREQUAL "static")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
else()
  run(${CMAKE_COMMAND} -G Ninja -S ${SUBPROJECT} -B ${WORK}/subproject -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${CXX} -DGRAZE=${SOURCE} -DPROGRAM=${PROGRAM} -DBUILD_SHARED_LIBS=ON -DGRAZE_INSTALL=ON
    -DGRAZE_IO=OFF -DCMAKE_INSTALL_PREFIX=${prefix} ${quick})
  run(${CMAKE_COMMAND} --build ${WORK}/subproject)
  run(${WORK}/subproject/embedded)
  run(${CMAKE_COMMAND} --install ${WORK}/subproject)
endif()
file(GLOB_RECURSE pkg_config_file ${prefix}/*/graze.pc)
cmake_path(GET pkg_config_file PARENT_PATH pkg_config_folder)
cmake_path(GET pkg_config_folder PARENT_PATH library_folder)

set(flag_sets plain native)
set(flags_plain "")
set(flags_native "-march=native")
file(STRINGS /proc/cpuinfo avx2 REGEX "^flags.* avx2( |$)" LIMIT_COUNT 1)
if(avx2)
  list(APPEND flag_sets avx2)
  set(flags_avx2 "-mavx2")
else()
  message(STATUS "-mavx2 is left out: this processor cannot run it")
endif()
function(build_and_run source program flags)
  set(build ${WORK}/${program}_${flags})
  run(${CMAKE_COMMAND} -G Ninja -S ${source} -B ${build} -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX}
    "-DCMAKE_CXX_FLAGS=${flags_${flags}}" "-DCMAKE_PREFIX_PATH=${prefix};${PREFIX_PATH}")
  run(${CMAKE_COMMAND} --build ${build})
  run(${build}/${program})
endfunction()
if(KIND STREQUAL "shared")
  set(flag_sets native)  # what differs most from the library's own flags
else()
  build_and_run(${RESPONSE} response plain)
  build_and_run(${STANDING} standing plain)
endif()
foreach(flags ${flag_sets})
  build_and_run(${PROGRAM} consumer ${flags})
  build_and_run(${INPUTS} inputs ${flags})
endforeach()

if(KIND STREQUAL "shared")  # installed without io: a program that needs it is told why it is not there
  file(WRITE ${WORK}/without_io/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(without_io CXX)\n\
find_package(graze CONFIG REQUIRED COMPONENTS io)\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${WORK}/without_io -B ${WORK}/without_io/build
    -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_PREFIX_PATH=${prefix};${PREFIX_PATH}" RESULT_VARIABLE failed ERROR_VARIABLE said
    OUTPUT_QUIET)
  if(NOT failed OR NOT said MATCHES "graze was installed without its component io")
    message(FATAL_ERROR "a component that was not installed is not said to be missing: ${said}")
  endif()
endif()

set(ENV{PKG_CONFIG_PATH} ${pkg_config_folder})
execute_process(COMMAND pkg-config --cflags --libs graze OUTPUT_VARIABLE pkg_flags OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(pkg_flags)
run(${CXX} -std=c++20 -O1 ${PROGRAM}/consumer.cpp -o ${WORK}/consumer_by_pkg_config ${pkg_flags} -pthread)
set(ENV{LD_LIBRARY_PATH} ${library_folder})
run(${WORK}/consumer_by_pkg_config)
unset(ENV{LD_LIBRARY_PATH})
