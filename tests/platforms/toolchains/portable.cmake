# This machine's compiler without its extensions, as for a compiler that is neither GCC nor clang, and with an Eigen that
# has no vector registers.
set(GRAZE_PORTABLE ON)
set(CMAKE_CXX_FLAGS_INIT
  "-DEIGEN_DONT_VECTORIZE -isystem /usr/include/eigen3 -include ${CMAKE_CURRENT_LIST_DIR}/../../../tools/wasm/sums_of_three.hpp")
