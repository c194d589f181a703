# WebAssembly, by Debian's Emscripten. Programs run in Node.js, on one thread.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-sALLOW_MEMORY_GROWTH=1 -sENVIRONMENT=node")
# Emscripten 3.1.6 takes a Node.js that has fetch for a browser.
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)
include(${CMAKE_CURRENT_LIST_DIR}/../../../tools/wasm/toolchain.cmake)
