# Builds the viewer's page and writes it as a C++ source, which the program is made of. The build runs this script each
# time; it does nothing where the page is of the present sources.
#
#   cmake -DSOURCE=tools/viewer -DWORK=FOLDER -DRESULT=FILE.cpp -DMODE=AUTO|ON|OFF -DMODULE=AUTO|OFF|FILE.wasm
#     -DMODULE_SOURCE=tools/wasm -P build_viewer.cmake
#
# With MODULE=AUTO the module that computes in the page is built where Emscripten is there. Without it the page is whole but
# for that.
#
# The page is built in a copy of the sources, so that the sources stay as they are. With MODE=AUTO the source has no page
# where it cannot be built, and one line says why. With MODE=ON the build stops there.
cmake_minimum_required(VERSION 3.25)

set(stamp_file ${WORK}/stamp.txt)
set(log ${WORK}/build.log)

# What the result depends on: all sources of the viewer, and which programs there are.
file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/*)
list(FILTER files EXCLUDE REGEX "^(node_modules|dist)/")
list(SORT files)
find_program(npm npm NO_CACHE)
find_program(node node NO_CACHE)
set(stamp "${MODE}\n${node}\n${npm}\n")

# The module is asked for in each build, as the libraries may have changed that it is made of.
set(module "")
if(NOT MODE STREQUAL "OFF" AND node AND npm AND NOT MODULE STREQUAL "OFF")
  if(NOT MODULE STREQUAL "AUTO")
    set(module ${MODULE})
  else()
    find_program(emscripten em++ NO_CACHE)
    if(emscripten)
      include(${CMAKE_CURRENT_LIST_DIR}/build_module.cmake)
    endif()
  endif()
endif()
if(module)
  if(NOT EXISTS ${module})
    message(FATAL_ERROR "graze: GRAZE_PAGE_MODULE: there is no ${module}")
  endif()
  file(SHA256 ${module} hash)
  string(APPEND stamp "${hash} module\n")
endif()
foreach(file ${files})
  file(SHA256 ${SOURCE}/${file} hash)
  string(APPEND stamp "${hash} ${file}\n")
endforeach()
if(EXISTS ${stamp_file} AND EXISTS ${RESULT})
  file(READ ${stamp_file} last_stamp)
  if(last_stamp STREQUAL stamp)
    return()
  endif()
endif()

# write_result(<bytes>): the C++ source. The bytes are numbers with commas, or nothing.
function(write_result bytes)
  set(text "#include \"viewer/viewer_page.hpp\"\n\nnamespace graze::tools {\n")
  if(bytes)
    string(APPEND text "namespace {\nconstexpr unsigned char bytes[] = {\n${bytes}};\n}  // namespace\n"
      "const std::span<const unsigned char> packed_viewer(bytes);\n")
  else()
    string(APPEND text "const std::span<const unsigned char> packed_viewer{};\n")
  endif()
  file(WRITE ${RESULT} "${text}}  // namespace graze::tools\n")
  file(WRITE ${stamp_file} "${stamp}")
endfunction()

# give_up(<why>): a program without a viewer, or no program.
macro(give_up why)
  if(MODE STREQUAL "ON")
    file(REMOVE ${stamp_file})
    message(FATAL_ERROR "graze: the viewer cannot be built: ${why}")
  endif()
  message("graze: built without the viewer, which `graze run --html` needs: ${why}")
  write_result("")
  file(TOUCH ${WORK}/gave_up)
  return()
endmacro()

if(MODE STREQUAL "OFF")
  write_result("")
  return()
endif()
if(NOT EXISTS ${SOURCE}/package.json)
  give_up("there is no ${SOURCE}/package.json")
endif()
if(NOT node OR NOT npm)
  give_up("install nodejs and npm and build again")
endif()

file(MAKE_DIRECTORY ${WORK}/source)
file(GLOB old ${WORK}/source/* ${WORK}/source/.*)
list(REMOVE_ITEM old ${WORK}/source/node_modules)
if(old)
  file(REMOVE_RECURSE ${old})
endif()
foreach(file ${files})
  get_filename_component(folder ${WORK}/source/${file} DIRECTORY)
  file(COPY ${SOURCE}/${file} DESTINATION ${folder})
endforeach()
if(module)
  configure_file(${module} ${WORK}/source/module.wasm COPYONLY)
endif()

# run_npm(<argument>...): one npm command, whose words go into the log.
function(run_npm)
  execute_process(COMMAND ${npm} ${ARGN} WORKING_DIRECTORY ${WORK}/source
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  file(APPEND ${log} "npm ${ARGN}\n${said}\n")
  set(npm_failed ${result} PARENT_SCOPE)
endfunction()

file(WRITE ${log} "")
run_npm(ci --include=dev --prefer-offline --no-audit --no-fund --fetch-retries=1)
if(npm_failed)
  give_up("npm ci failed, see ${log}; configure and build again to try once more")
endif()
run_npm(run build)
if(npm_failed OR NOT EXISTS ${WORK}/source/dist/viewer.html)
  give_up("npm run build failed, see ${log}; configure and build again to try once more")
endif()

file(ARCHIVE_CREATE OUTPUT ${WORK}/viewer.html.gz PATHS ${WORK}/source/dist/viewer.html FORMAT raw COMPRESSION GZip
  COMPRESSION_LEVEL 9 MTIME "2000-01-01 00:00:00 UTC")
file(READ ${WORK}/viewer.html.gz bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
write_result("${bytes}")
