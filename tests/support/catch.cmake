# graze_add_test_program(<name> [BATCH] <source>... [BATCH <source>...]...): a Catch2 program, v2 or v3, with one ctest test for each test case.
# A test that prints a line "skipped: <why>" counts as skipped.

find_package(Catch2 REQUIRED)
list(APPEND CMAKE_MODULE_PATH ${Catch2_DIR})
include(Catch)

set(GRAZE_SHARED_DATA "${CMAKE_SOURCE_DIR}/../shared/data" CACHE PATH
  "Real meshes that some tests read; those tests are skipped where it is missing")

set(catch_options ${GRAZE_TEST_OPTIONS})
if(GRAZE_HAS_SANITIZERS)
  set(catch_options -fno-sanitize=all)  # its own sources need none, and are compiled and run in half the time
endif()

if(Catch2_VERSION VERSION_GREATER_EQUAL 3)
  set(GRAZE_CATCH_MAIN Catch2::Catch2WithMain)
else()
  set(GRAZE_CATCH_MAIN graze_catch_main)
  add_library(graze_catch_main STATIC ${CMAKE_CURRENT_LIST_DIR}/catch_main.cpp)
  target_compile_features(graze_catch_main PUBLIC cxx_std_20)  # it knows string views only then
  target_compile_options(graze_catch_main PRIVATE ${catch_options})
  target_link_libraries(graze_catch_main PUBLIC Catch2::Catch2)
endif()

# The headers and compiler options of all test programs, in one place since headers are precompiled once for all.
add_library(graze_test_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)
target_compile_options(graze_test_headers PRIVATE ${GRAZE_TEST_OPTIONS})
target_link_libraries(graze_test_headers PRIVATE graze_options Catch2::Catch2)
set_target_properties(graze_test_headers PROPERTIES UNITY_BUILD ON)  # the options of a batch, as those of the programs
graze_precompile_headers(graze_test_headers ${CMAKE_CURRENT_LIST_DIR}/catch.hpp)

# The files between one BATCH and the next are compiled as one: to read Catch2, Eigen and graze's headers takes longer
# than the tests themselves. So within a batch no two files give different things the same name.
function(graze_add_test_program name)
  set(batch 0)
  set(sources)
  foreach(argument ${ARGN})
    if(argument STREQUAL "BATCH")
      math(EXPR batch "${batch} + 1")
    else()
      list(APPEND sources ${argument})
      set_source_files_properties(${argument} PROPERTIES UNITY_GROUP batch_${batch})
    endif()
  endforeach()
  add_executable(${name} ${sources})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  target_compile_definitions(${name} PRIVATE
    GRAZE_SHARED_DATA="${GRAZE_SHARED_DATA}" GRAZE_TEST_EFFORT=${GRAZE_TEST_EFFORT})
  target_compile_options(${name} PRIVATE $<TARGET_PROPERTY:graze_test_headers,COMPILE_OPTIONS>)
  target_precompile_headers(${name} REUSE_FROM graze_test_headers)
  target_link_libraries(${name} PRIVATE graze_options ${GRAZE_CATCH_MAIN} Eigen3::Eigen)
  catch_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: ")
endfunction()
