#!/bin/sh
# Builds core and scheduler for other platforms, and for a compiler without extensions, and runs the programs that say whether they answer as here:
#
#   tests/platforms/run.sh RESULTS [PLATFORM...]    by default portable, arm64, windows and wasm
#
# RESULTS is a folder for the results of ctest. docs/platforms.md says what is compared.
set -eu
results=$1
shift
cd "$(dirname "$0")/../.."

# The program with the page that has the module in it, which the tests of WebAssembly drive in a browser.
build_page() {
  cmake --preset demo -B build/wasm-program -DGRAZE_PAGE_MODULE="$PWD/build/wasm/page/graze_page.wasm" >/dev/null
  cmake --build build/wasm-program --target graze_program graze_demo_scene
}

status=0
[ "$#" -gt 0 ] || set -- portable arm64 windows wasm
for name in "$@"; do
  echo "== $name"
  cmake -G Ninja -S tests/platforms -B "build/$name" --toolchain "$PWD/tests/platforms/toolchains/$name.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DGRAZE_WARNINGS_AS_ERRORS=ON -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 >/dev/null
  cmake --build "build/$name"
  [ "$name" != wasm ] || build_page
  ctest --test-dir "build/$name" --verbose --timeout 900 --output-junit "$results/$name.xml" || status=1
done
exit "$status"
