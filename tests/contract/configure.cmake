# How graze is configured by users who give no options: nothing is built. It is optimised and says so, also as a
# subproject, and warnings stop nobody but the developers.
function(configure folder output)
  file(REMOVE_RECURSE ${WORK}/${folder})
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=CXXFLAGS --unset=CMAKE_BUILD_TYPE
      ${CMAKE_COMMAND} -G Ninja -B ${WORK}/${folder} -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_PREFIX_PATH=${PREFIX_PATH}"
      -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DGRAZE_IO=OFF -DGRAZE_BUILD_TOOLS=OFF -DGRAZE_BUILD_TESTS=OFF ${ARGN}
    OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${WORK}/${folder}/compile_commands.json commands)
  set(${output} ${text} PARENT_SCOPE)
  set(commands ${commands} PARENT_SCOPE)
endfunction()

function(expect text pattern what)
  if(NOT "${text}" MATCHES "${pattern}")
    message(FATAL_ERROR "${what}")
  endif()
endfunction()

function(expect_not text pattern what)
  if("${text}" MATCHES "${pattern}")
    message(FATAL_ERROR "${what}")
  endif()
endfunction()

# The file's command in which mesh.cpp is compiled; ends at the next file.
macro(find_mesh_command)
  string(REGEX MATCH "\"command\": \"[^\n]*core/src/mesh/mesh\\.cpp" mesh_command "${commands}")
  expect("${mesh_command}" "mesh" "no command compiles mesh.cpp")
endmacro()

configure(top_level said -S ${SOURCE})
expect("${said}" "no build type was given, so it is Release" "nothing says that the build type is Release")
find_mesh_command()
expect("${mesh_command}" " -O3 " "the libraries are not optimised without a build type")
expect("${mesh_command}" " -DNDEBUG " "the libraries have assertions without a build type")
expect_not("${mesh_command}" "-Werror" "warnings are errors for users")

configure(with_type said -S ${SOURCE} -DCMAKE_BUILD_TYPE=Debug -DGRAZE_WARNINGS_AS_ERRORS=ON)
expect_not("${said}" "no build type was given" "a build type that was given is not seen")
find_mesh_command()
expect_not("${mesh_command}" " -O3 " "a debug build is optimised")
expect("${mesh_command}" " -Werror " "GRAZE_WARNINGS_AS_ERRORS does nothing")

configure(subproject said -S ${SUBPROJECT} -DGRAZE=${SOURCE} -DPROGRAM=${PROGRAM})
expect("${said}" "graze's own libraries have -O3 -DNDEBUG" "nothing says that the libraries are optimised")
find_mesh_command()
expect("${mesh_command}" " -O3 " "graze is not optimised in a subproject without a build type")
expect_not("${mesh_command}" "-Werror" "warnings are errors in a subproject")
string(REGEX MATCH "\"command\": \"[^\n]*consumer\\.cpp" own_command "${commands}")
expect("${own_command}" "consumer" "no command compiles the project's own program")
expect_not("${own_command}" " -O3 " "the project's own program is compiled in another way than it asked for")
# The program needs what the static libraries need, which were found in graze's own folder.
file(READ ${WORK}/subproject/build.ninja rules)
expect("${rules}" "LINK_LIBRARIES = [^\n]*libgraze_scheduler\\.a[^\n]*libgraze_core\\.a[^\n]*libtbb"
  "a program in a project around graze is not linked with oneTBB")

file(READ ${SOURCE}/CMakePresets.json presets)
string(JSON stops GET "${presets}" configurePresets 0 cacheVariables GRAZE_WARNINGS_AS_ERRORS)
if(NOT stops STREQUAL "ON")
  message(FATAL_ERROR "the presets let warnings pass")
endif()
