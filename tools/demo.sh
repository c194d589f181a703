#!/bin/sh
# The main command: installs what is missing, builds the program, and plays the demonstration scene into out/demo.
# It builds nothing else, and says in one line how far it is. The compiler's own words go into build/demo/build.log.
set -eu
cd "$(dirname "$0")/.."

log=build/demo/build.log

# The last step that the build says it has finished, such as 12/31.
finished_steps() {
  sed -n 's/^\[\([0-9]*\/[0-9]*\)\].*/\1/p' "$log" | tail -n 1
}

# One line that is written over on a terminal, and a line every 15 s elsewhere.
show_progress() {
  seconds=$(($(date +%s) - began))
  steps=$(finished_steps)
  text="building graze: ${steps:-no} steps, $seconds s"
  if [ -t 1 ]; then
    printf '\r%s ' "$text"
  elif [ $((seconds % 15)) -eq 0 ]; then
    echo "$text"
  fi
}

# What went wrong is at the log's end.
give_up() {
  [ ! -t 1 ] || echo
  tail -n 40 "$log" >&2
  echo "graze could not be built; all that the compiler said is in $log" >&2
  exit 1
}

tools/install_packages.sh demo
began=$(date +%s)
mkdir -p "$(dirname "$log")"
echo "building graze: configuring"
cmake --preset demo >"$log" 2>&1 || give_up
cmake --build --preset demo >>"$log" 2>&1 &
build=$!
trap 'kill "$build" 2>/dev/null; exit 130' INT TERM
while kill -0 "$build" 2>/dev/null; do
  show_progress
  sleep 1
done
trap - INT TERM
wait "$build" || give_up
[ ! -t 1 ] || echo
echo "graze is built after $(($(date +%s) - began)) s; playing the demonstration scene into out/demo"
tools/demo/run.sh build/demo out/demo
