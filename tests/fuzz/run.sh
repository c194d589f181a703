#!/bin/sh
# Runs fuzzers: tests/fuzz/run.sh SECONDS [target...]. Builds them (preset `fuzz`), makes the corpus, runs each for that
# long, as many at a time as there are processors, and prints what came of each. Exit code 1: there was a finding.
# A corpus grows from run to run in build/fuzz/found/TARGET/corpus; findings are in …/findings, the log in …/log.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.."
[ $# -ge 1 ] || {
  echo "usage: tests/fuzz/run.sh SECONDS [target...]" >&2
  exit 2
}
seconds=$1
shift

cmake --preset fuzz -DGRAZE_BUILD_TESTS=ON >/dev/null
cmake --build --preset fuzz
built=build/fuzz/tests/fuzz
found=build/fuzz/found
if [ $# -eq 0 ]; then
  # shellcheck disable=SC2046 # names without blanks
  set -- $(cd "$here" && printf '%s\n' *_fuzzer.cpp | sed 's|_fuzzer\.cpp$||')
fi

status=0
printf '%s\n' "$@" | xargs -P "$(nproc)" -I {} \
  "$here/run_one.sh" "$built/graze_fuzz_{}" "$built/corpus/{}" "$found/{}" "$seconds" >/dev/null || status=1

printf '%-12s %12s %9s %9s %9s\n' target executions features coverage findings
for target in "$@"; do
  log=$found/$target/log
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  features=$(sed -n 's/.* ft: \([0-9]*\).*/\1/p' "$log" | tail -n 1)
  coverage=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -n 1)
  findings=$(find "$found/$target/findings" -type f | wc -l)
  [ "$findings" -eq 0 ] || status=1
  printf '%-12s %12s %9s %9s %9s\n' "$target" "${executions:-?}" "${features:-?}" "${coverage:-?}" "$findings"
done
exit "$status"
