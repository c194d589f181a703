# What programs around graze ask of its package: flags, libraries and build options of their own. Installs the build under
# test into a prefix of its own, compiles small programs against it, and configures projects.
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(expect text pattern what)
  if(NOT "${text}" MATCHES "${pattern}")
    message(FATAL_ERROR "${what}: ${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
file(GLOB_RECURSE pkg_config_file ${prefix}/*/graze.pc)
cmake_path(GET pkg_config_file PARENT_PATH pkg_config_folder)
set(ENV{PKG_CONFIG_PATH} ${pkg_config_folder})
execute_process(COMMAND pkg-config --cflags --libs graze OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags)

# A program without exceptions takes all headers, and runs.
run(${CXX} -std=c++20 -O1 -fno-exceptions -Werror ${SOURCES}/installed/without_exceptions.cpp
  -o ${WORK}/without_exceptions ${flags} -pthread)
run(${WORK}/without_exceptions)

# A program whose containers or strings have another form than graze's does not link, and the linker says which form.
foreach(form _GLIBCXX_DEBUG _GLIBCXX_USE_CXX11_ABI=0)
  execute_process(COMMAND ${CXX} -std=c++20 -D${form} ${SOURCES}/installed/empty.cpp -o ${WORK}/empty ${flags} -pthread
    RESULT_VARIABLE failed ERROR_VARIABLE said)
  string(REPLACE "=" "_" name ${form})
  if(NOT failed)
    message(FATAL_ERROR "a program with -D${form} links")
  endif()
  expect("${said}" "program_and_graze_both_need_${name}" "the linker does not name ${form}")
endforeach()

# Eigen's package files of version 5 refuse a request for version 3.4. This package stands for them.
function(write_eigen version)
  file(WRITE ${WORK}/eigen${version}/Eigen3Config.cmake "set(Eigen3_VERSION ${version})\n\
add_library(Eigen3::Eigen INTERFACE IMPORTED)\nset(eigen_of_test ${version})\n")
  string(REGEX MATCH "^[0-9]+" major ${version})
  file(WRITE ${WORK}/eigen${version}/Eigen3ConfigVersion.cmake "set(PACKAGE_VERSION ${version})\n\
if(NOT PACKAGE_FIND_VERSION OR PACKAGE_FIND_VERSION_MAJOR EQUAL ${major})\n  set(PACKAGE_VERSION_COMPATIBLE TRUE)\nendif()\n")
endfunction()
foreach(version 3.3.9 5.0.1)
  write_eigen(${version})
endforeach()

# Configures a project without io. `said` is what it printed, `failed` whether it stopped.
macro(configure folder)
  file(REMOVE_RECURSE ${WORK}/build)
  execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${folder} -B ${WORK}/build -DCMAKE_CXX_COMPILER=${CXX}
      "-DCMAKE_PREFIX_PATH=${prefix};${PREFIX_PATH}" -DGRAZE=${GRAZE} -DGRAZE_IO=OFF -DGRAZE_BUILD_TOOLS=OFF
      -DGRAZE_BUILD_TESTS=OFF ${ARGN}
    OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE failed)
endmacro()
macro(expect_configured what)
  if(failed)
    message(FATAL_ERROR "${what} is refused: ${said}")
  endif()
endmacro()

configure(${SOURCES}/installed)
expect_configured("a program with a FindTBB.cmake of its own")
configure(${SOURCES}/installed -DEigen3_DIR=${WORK}/eigen5.0.1)
expect_configured("an installed graze beside Eigen 5")
configure(${SOURCES}/installed -DOWN_EIGEN=${WORK}/eigen5.0.1)
expect_configured("a program with Eigen 5 of its own")
expect("${said}" "Eigen of the program: 5.0.1" "the program's own Eigen is not used")
configure(${SOURCES}/installed -DEigen3_DIR=${WORK}/eigen3.3.9)
expect("${said}" "graze needs Eigen 3.4 or later" "an old Eigen is not refused by the installed graze")

configure(${GRAZE} -DEigen3_DIR=${WORK}/eigen5.0.1)
expect_configured("Eigen 5")
configure(${GRAZE} -DEigen3_DIR=${WORK}/eigen3.3.9)
expect("${said}" "graze needs Eigen 3.4 or later" "an old Eigen is not refused")

configure(${SOURCES}/parent -DOWN_EIGEN=${WORK}/eigen5.0.1 -DGRAZE_INSTALL=ON)
expect_configured("a project that exports what links graze, with GRAZE_INSTALL")
expect("${said}" "Eigen of the program: 5.0.1" "the Eigen of the project around graze is not used")
expect("${said}" "its library is a SHARED_LIBRARY" "graze sets BUILD_SHARED_LIBS for the project around it")
