#!/bin/sh
# The test command. It installs what is missing, builds graze with its tests, and runs them. The last line counts tests.
#
#   tests/run.sh          the libraries as users build them, and all tests of them, of the program and of the pages
#   tests/run.sh --all    what a change must pass: also what measures graze, clang-tidy, the installed package, each test
#                         under the address and undefined-behaviour sanitizers with the structure validators on, each fuzzer
#                         for a short time, and tests with threads under the thread sanitizer
#   tests/run.sh --platforms   core and scheduler on other platforms, under emulators, and the page that computes
#                         (docs/platforms.md)
set -eu
cd "$(dirname "$0")/.."

case "$*" in
  '') runs=check ;;
  --all) runs=all ;;
  --platforms) runs=platforms ;;
  *)
    echo "usage: tests/run.sh [--all | --platforms]" >&2
    exit 2
    ;;
esac

if [ "$runs" = platforms ]; then tools/install_packages.sh platforms; else tools/install_packages.sh peers; fi
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
status=0

# A locale with a decimal comma, for the tests that must not notice it.
mkdir "$results/locales"
localedef -i de_DE -f UTF-8 "$results/locales/de_DE.UTF-8"
LOCPATH="$results/locales"
export LOCPATH

# Builds a preset; "$@" are more settings of it. The module that computes in the page is left out, whatever is installed: it is
# a build of its own, which --platforms does.
build_preset() {
  preset=$1
  shift
  echo "== $preset"
  cmake --preset "$preset" -DGRAZE_BUILD_TESTS=ON -DGRAZE_PAGE_MODULE=OFF "$@" >/dev/null
  cmake --build --preset "$preset"
}

# Runs a preset's tests; "$@" are more arguments for ctest.
test_preset() {
  preset=$1
  shift
  ctest --preset "$preset" --parallel "$(nproc)" --output-junit "$results/$preset.xml" "$@" || status=1
}

# How the sources are written; counts as one test. "$@" are the checks.
lint_failed=0
lint_tests=0
run_lint() {
  lint_tests=1
  echo "== lint"
  tests/lint/run.sh "$@" || lint_failed=1
}

# The sanitizers' builds leave out and change what would take long and says nothing new:
# - What measures graze is left out. It runs the library as the other programs do, and takes a third of the build.
# - Undefined behaviour's checks of null, of object sizes and of virtual tables are left out. With them the build takes
#   a tenth to a fifth longer. The address sanitizer sees what such accesses do, and the preset `fuzz` has them.
# - The contract's programs are left out, since they build libraries of their own. So are the checks of includes, which
#   run nothing of graze, and the pages' programs.
# - The examples are left out. They step small scenes many thousand times, and call nothing that tests do not.
# - The oracles and what makes models have no sanitizer, and the tests of them are left out.
# - An allocation is remembered with two of its callers. With thirty, what the exact oracles allocate takes a third of
#   all tests' time.
# - The libraries' sources are compiled in batches, as those of the demonstration are.
# - The fuzzers are built here, with counters of what they reach. A build of their own took a fifth of all the time. The
#   preset `fuzz` is for long runs: there comparisons guide them too (docs/fuzzing.md). Tests and programs count nothing:
#   with counters their compilation takes a third longer.
run_sanitizers() {
  build_preset asan-ubsan
  test_preset asan-ubsan --exclude-regex '^contract_|^lint_'
  # The tests with threads once more under the thread sanitizer.
  tests/tsan_tbb.sh build/tsan-tbb
  build_preset tsan
  test_preset tsan
}

if [ "$runs" = platforms ]; then
  tests/platforms/run.sh "$results" || status=1
elif [ "$runs" = all ]; then
  run_lint text order tidy
  # In batches, which takes half as long. The libraries take as many instructions as compiled one by one.
  build_preset release -DGRAZE_MPI=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 -DGRAZE_TEST_OPTIONS=-O1
  test_preset release
  run_sanitizers
else
  run_lint text order
  # One test builds graze once more, as shared libraries, and two build many programs against what is installed. To count
  # instructions takes two minutes.
  build_preset check -DGRAZE_MPI=ON
  test_preset check --exclude-regex '^contract_(static|shared)$|^instructions$'
fi

# ctest counts in each results file's first element.
count() {
  sed -n "s/.*[^a-z]$1=\"\([0-9]*\)\".*/\1/p" "$results"/*.xml | awk '{ sum += $1 } END { print sum + 0 }'
}
tests=$(($(count tests) + lint_tests))
failed=$(($(count failures) + lint_failed))
skipped=$(count skipped)
disabled=$(count disabled)
# What failed once more, since the log is long.
[ "$lint_failed" -eq 0 ] || echo "== failed: lint, at the start of this output"
python3 tests/failed_tests.py "$results"/*.xml || status=1
echo "$((tests - failed - skipped - disabled)) passed, $failed failed, $skipped skipped"
[ "$tests" -gt "$lint_tests" ] && [ "$lint_failed" -eq 0 ] || status=1
exit "$status"
