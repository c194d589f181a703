#!/bin/sh
# The test command. It installs what is missing and checks how the sources are written. It builds graze as users do and
# runs all tests. It runs them once more under the address and undefined-behaviour sanitizers, with the structure
# validators on, and with each fuzzer for a short time. It runs those with threads under the thread sanitizer. The last
# line counts tests.
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

# How the sources are written; counts as one test.
echo "== lint"
lint_failed=0
tests/lint/run.sh || lint_failed=1

run_preset release --parallel "$(nproc)"
# The sanitizers' builds leave out and change what would take long and says nothing new:
# - What measures graze is left out. It runs the library as the other programs do, and takes a third of the build.
# - Undefined behaviour's checks of null, of object sizes and of virtual tables are left out. With them the build takes
#   a tenth to a fifth longer. The address sanitizer sees what such accesses do, and the preset `fuzz` has them.
# - The contract's programs are left out, since they build libraries of their own. So are the checks of pages and
#   of includes, which run nothing of graze.
# - An allocation is remembered with two of its callers. With thirty, what the exact oracles allocate takes a third of
#   all tests' time.
# - The libraries' sources are compiled in batches, as those of the demonstration are.
# - The fuzzers are built here, with counters of what they reach. A build of their own took a fifth of all the time. The
#   preset `fuzz` is for long runs: there comparisons guide them too (docs/fuzzing.md).
run_preset asan-ubsan --parallel "$(nproc)" --exclude-regex '^contract_|^docs_pages|^docs_reference|^lint_'

# The tests with threads once more under the thread sanitizer.
tests/tsan_tbb.sh build/tsan-tbb
run_preset tsan --parallel "$(nproc)"

# ctest counts in each results file's first element.
count() {
  sed -n "s/.*[^a-z]$1=\"\([0-9]*\)\".*/\1/p" "$results"/*.xml | awk '{ sum += $1 } END { print sum + 0 }'
}
tests=$(($(count tests) + 1))
failed=$(($(count failures) + lint_failed))
skipped=$(count skipped)
disabled=$(count disabled)
echo "$((tests - failed - skipped - disabled)) passed, $failed failed, $skipped skipped"
[ "$tests" -gt 1 ] && [ "$lint_failed" -eq 0 ] || status=1
exit "$status"
