# WebAssembly, by Debian's Emscripten 3.1.6 with clang 14. Eigen, which is headers alone, is the system's.
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_CXX_FLAGS_INIT
  "-fwasm-exceptions -msimd128 -isystem /usr/include/eigen3 -include ${CMAKE_CURRENT_LIST_DIR}/missing_std.hpp")
# Debian has the packages of Node.js where only its own Node.js looks for them.
set(CMAKE_CXX_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs)
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
