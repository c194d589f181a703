# graze_add_test_program(<name> <source>...): a Catch2 program, v2 or v3, with one ctest test for each test case.
# A test that prints a line "skipped: <why>" counts as skipped.

find_package(Catch2 REQUIRED)
list(APPEND CMAKE_MODULE_PATH ${Catch2_DIR})
include(Catch)

set(GRAZE_SHARED_DATA "${CMAKE_SOURCE_DIR}/../shared/data" CACHE PATH
  "Real meshes that some tests read; those tests are skipped where it is missing")

if(Catch2_VERSION VERSION_GREATER_EQUAL 3)
  set(GRAZE_CATCH_MAIN Catch2::Catch2WithMain)
else()
  set(GRAZE_CATCH_MAIN graze_catch_main)
  add_library(graze_catch_main STATIC ${CMAKE_CURRENT_LIST_DIR}/catch_main.cpp)
  target_link_libraries(graze_catch_main PUBLIC Catch2::Catch2)
endif()

function(graze_add_test_program name)
  add_executable(${name} ${ARGN})
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  target_compile_definitions(${name} PRIVATE GRAZE_SHARED_DATA="${GRAZE_SHARED_DATA}")
  target_compile_options(${name} PRIVATE ${GRAZE_TEST_OPTIONS})
  target_link_libraries(${name} PRIVATE graze_options ${GRAZE_CATCH_MAIN})
  list(LENGTH ARGN source_count)
  if(source_count GREATER 4)  # fewer are built before the headers would be
    # What nearly every test includes: reading it takes longer than compiling most tests.
    target_link_libraries(${name} PRIVATE Eigen3::Eigen)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      # What it sees in the standard library's strings (GCC bug 105651) it does not take for a system header's then.
      target_compile_options(${name} PRIVATE -Wno-array-bounds)
    endif()
    target_precompile_headers(${name} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/catch.hpp
      <Eigen/Geometry> <algorithm> <array> <cmath> <memory> <string> <vector>)
  endif()
  catch_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: ")
endfunction()
