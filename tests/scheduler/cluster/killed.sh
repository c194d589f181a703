#!/bin/sh
# A rank that is killed ends the run of all within 5 seconds: PROGRAM
set -eu
start=$(date +%s)
if "$(dirname "$0")/mpirun.sh" 3 "$1" "killed"; then
  echo "the run went on without a rank"
  exit 1
fi
took=$(($(date +%s) - start))
# The run itself takes some of that time.
[ "$took" -le 5 ] || {
  echo "the run ended after $took s"
  exit 1
}
