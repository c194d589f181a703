#!/bin/sh
# The test command: installs what is missing, builds and runs all tests as users build graze, and once more under the
# address and undefined-behaviour sanitizers with the structure validators on; then those with threads under the thread
# sanitizer, and each fuzzer for a short time. Ends with a line of counts.
set -eu
cd "$(dirname "$0")/.."

tools/install_packages.sh peers
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
status=0

# A locale with a decimal comma, for the tests that must not notice it.
mkdir "$results/locales"
localedef -i de_DE -f UTF-8 "$results/locales/de_DE.UTF-8"
LOCPATH="$results/locales"
export LOCPATH

# Builds a preset and runs its tests; "$@" are more arguments for ctest.
run_preset() {
  preset=$1
  shift
  echo "== $preset"
  cmake --preset "$preset" -DGRAZE_BUILD_TESTS=ON >/dev/null
  cmake --build --preset "$preset"
  ctest --preset "$preset" --output-junit "$results/$preset.xml" "$@" || status=1
}

run_preset release --parallel "$(nproc)"
# Without what measures graze, which runs the library as the other programs do, but takes a third of the build.
# Without undefined behaviour's checks of null, of object sizes and of virtual tables, with which the build takes a
# tenth to a fifth longer: the address sanitizer sees what such accesses do, and the fuzzers have them.
# The contract's programs build libraries of their own: one run of them is enough. An allocation is remembered with two of its callers: with
# thirty, what the exact oracles allocate takes a third of all tests' time.
run_preset asan-ubsan --parallel "$(nproc)" --exclude-regex '^contract_'

# The tests with threads once more under the thread sanitizer.
tests/tsan_tbb.sh build/tsan-tbb
run_preset tsan --parallel "$(nproc)"

# Each fuzzer for a short time, from its seeds (docs/fuzzing.md).
run_preset fuzz --parallel "$(nproc)"

# ctest counts in each results file's first element.
count() {
  sed -n "s/.*[^a-z]$1=\"\([0-9]*\)\".*/\1/p" "$results"/*.xml | awk '{ sum += $1 } END { print sum + 0 }'
}
tests=$(count tests)
failed=$(count failures)
skipped=$(count skipped)
disabled=$(count disabled)
echo "$((tests - failed - skipped - disabled)) passed, $failed failed, $skipped skipped"
[ "$tests" -gt 0 ] || status=1
exit "$status"
