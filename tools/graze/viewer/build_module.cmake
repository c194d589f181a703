# Builds the module that computes in the viewer's page, with Emscripten, and sets `module` to its path. Where that fails `module`
# stays empty, and one line says why.
set(module_build ${WORK}/module)
set(module_log ${WORK}/module.log)
set(module_failed FALSE)
file(MAKE_DIRECTORY ${WORK})
if(NOT EXISTS ${module_build}/build.ninja)
  execute_process(
    # Flags of the environment are for the other compiler.
    COMMAND ${CMAKE_COMMAND} -E env --unset=CXXFLAGS --unset=LDFLAGS
      ${CMAKE_COMMAND} -G Ninja -S ${MODULE_SOURCE} -B ${module_build} --toolchain ${MODULE_SOURCE}/toolchain.cmake
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12
    RESULT_VARIABLE module_failed OUTPUT_FILE ${module_log} ERROR_FILE ${module_log})
endif()
if(NOT module_failed)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${module_build} --target graze_page
    RESULT_VARIABLE module_failed OUTPUT_FILE ${module_log} ERROR_FILE ${module_log})
endif()
if(module_failed)
  message("graze: the viewer's page is built without the module that computes in it, see ${module_log}")
else()
  set(module ${module_build}/graze_page.wasm)
endif()
