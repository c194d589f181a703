#!/bin/sh
# Runs one fuzzer: run_one.sh PROGRAM SEEDS FOUND SECONDS. Inputs that reach something new are kept in FOUND/corpus, an
# input that fails in FOUND/findings (of this run only), libFuzzer's output in FOUND/log. Fails where there is a finding.
set -eu
program=$1
seeds=$2
found=$3
seconds=$4

rm -rf "$found/findings"
mkdir -p "$found/corpus" "$found/findings"
folder=$(mktemp -d /dev/shm/graze-fuzz.XXXXXX 2>/dev/null || mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Seeds and generator are fixed; how far a run gets depends on the machine.
TMPDIR=$folder UBSAN_OPTIONS=print_stacktrace=1 "$program" -seed=1 -max_total_time="$seconds" -timeout=60 -report_slow_units=60 \
  -rss_limit_mb=3000 -print_final_stats=1 -artifact_prefix="$found/findings/" "$found/corpus" "$seeds" \
  >"$found/log" 2>&1 || {
  grep -v 'NEW\|REDUCE\|pulse' "$found/log" | head -n 60
  exit 1
}
tail -n 6 "$found/log"
