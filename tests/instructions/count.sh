#!/bin/sh
# Counts the instructions of the steps in baseline.txt and compares: `count.sh PROGRAM [--update]`. More than 3 % off in
# either direction fails, so that every change of speed is a change of that file, made knowingly with --update. Counts do
# not see memory: what waits for it is measured by `graze_studies bench`.
#
# Valgrind knows SSE2 and AVX2 and not AVX-512: the kernels for AVX-512 are not seen. They are the same source, and their
# results are compared with the others' by the tests. Where the processor has no AVX2 its rows are left out. Exits 77,
# which is skipped, without valgrind and with another compiler than the one that the baseline is of.
set -eu
program=$1
baseline=$(dirname "$0")/baseline.txt
tolerance=3

# How the C library copies memory depends on the processor, and some ways count as one instruction however much it is.
export GLIBC_TUNABLES=glibc.cpu.hwcaps=-ERMS,-FSRM:glibc.cpu.x86_non_temporal_threshold=0x10000000

command -v valgrind >/dev/null || { echo "skipped: no valgrind"; exit 77; }

# Instructions inside of Scene::step, or nothing where the instruction set is not there.
count() {
  status=0
  log=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='graze::Scene::step(unsigned long)' \
    "$program" "$1" "$2" "$3" 2>&1) || status=$?
  [ "$status" -ne 77 ] || return 0
  [ "$status" -eq 0 ] || { echo "$log" >&2; return 1; }
  echo "$log" | sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}

if [ "${2:-}" = --update ]; then
  grep '^#' "$baseline" >"$baseline.new"
  grep -v '^#' "$baseline" | while read -r scene detail set _; do
    echo "$scene $detail $set $(count "$scene" "$detail" "$set")"
  done >>"$baseline.new"
  mv "$baseline.new" "$baseline"
  exit 0
fi

table=$(mktemp)
trap 'rm -f "$table"' EXIT
grep -v '^#' "$baseline" | while read -r scene detail set expected; do
  counted=$(count "$scene" "$detail" "$set")
  echo "$scene $detail $set $expected ${counted:-absent}"
done >"$table"
awk -v tolerance="$tolerance" '
  $5 == "absent" { print $1, $2, $3 ": not on this processor"; next }
  {
    change = 100 * ($5 / $4 - 1)
    off = change > tolerance || change < -tolerance
    failed += off
    counted += 1
    printf "%s %s %s: %d instructions, %+.2f %%%s\n", $1, $2, $3, $5, change, off ? "  <- not as in the baseline" : ""
  }
  END { exit counted == 0 || failed > 0 }' "$table"
