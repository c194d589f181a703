# Installs the build under test into a prefix of its own, builds a program against its component io by CMake and by
# pkg-config, and runs the installed graze.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/io_component -B ${WORK}/build -DCMAKE_CXX_COMPILER=${CXX}
  "-DCMAKE_PREFIX_PATH=${WORK}/prefix;${PREFIX_PATH}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/io_component WORKING_DIRECTORY ${WORK})

file(GLOB_RECURSE pkg_config_file ${WORK}/prefix/*/graze-io.pc)
cmake_path(GET pkg_config_file PARENT_PATH pkg_config_folder)
set(ENV{PKG_CONFIG_PATH} ${pkg_config_folder})
execute_process(COMMAND pkg-config --cflags --libs graze-io OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags)
run(${CXX} -std=c++20 ${SOURCE}/io_component/main.cpp -o ${WORK}/by_pkg_config ${flags} -pthread)
run(${WORK}/by_pkg_config WORKING_DIRECTORY ${WORK})

# The program; it reads the triangle that the ones before have written.
if(HAS_PROGRAM)
  execute_process(COMMAND ${WORK}/prefix/bin/graze --version OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
  if(NOT version MATCHES "^graze [0-9]+\\.[0-9]+\\.[0-9]+\n$")
    message(FATAL_ERROR "the installed program says ${version}")
  endif()
  execute_process(COMMAND ${WORK}/prefix/bin/graze run triangle.obj WORKING_DIRECTORY ${WORK} OUTPUT_VARIABLE said
    COMMAND_ERROR_IS_FATAL ANY)
  if(NOT said MATCHES "1 frame, 1 object, 0 pairs\n")
    message(FATAL_ERROR "the installed program says ${said}")
  endif()
endif()
