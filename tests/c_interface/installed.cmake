# The C interface as it is installed: the page's program by pkg-config, and a project of CMake.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(GLOB_RECURSE pkg_config_file ${WORK}/prefix/*/graze-c.pc)
cmake_path(GET pkg_config_file PARENT_PATH pkg_config_folder)
cmake_path(GET pkg_config_folder PARENT_PATH library_folder)
set(ENV{PKG_CONFIG_PATH} ${pkg_config_folder})
execute_process(COMMAND pkg-config --cflags --libs graze-c OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags)
run(${PYTHON} ${SOURCE}/page_program.py ${PAGE} ${WORK}/program ${CC} ${flags} -Wl,-rpath,${library_folder})

run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/project -B ${WORK}/build -DCMAKE_CXX_COMPILER=${CXX} -DPROGRAM=${WORK}/program/main.c
  "-DCMAKE_PREFIX_PATH=${WORK}/prefix;${PREFIX_PATH}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/crate)
