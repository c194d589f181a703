#!/bin/sh
# Writes the demonstration scene, plays it, and leaves a report, a picture and a page for a browser in out/demo.
# Usage: tools/demo/run.sh [BUILD FOLDER] [OUTPUT FOLDER]; more arguments go to graze run.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$root/build/release}
out=${2:-out/demo}
if [ $# -ge 2 ]; then shift 2; else shift $#; fi

for program in "$build/tools/demo/graze_demo_scene" "$build/tools/graze/graze"; do
  if [ ! -x "$program" ]; then
    echo "$program: is not there; build it with: cmake --preset release && cmake --build --preset release" >&2
    exit 2
  fi
done

scene=$("$build/tools/demo/graze_demo_scene" "$out")
graze=$build/tools/graze/graze

# A graze that was built without Node.js writes the page's data alone.
page=view.html
if "$graze" run --help | tr -s '\n ' ' ' | grep -q 'built without the viewer'; then
  page=view.grazeview
  echo "this graze was built without the viewer, which needs nodejs and npm; $out/$page has the page's data" >&2
fi
"$graze" run "$scene" --report "$out/report.jsonl" --picture "$out/frame.png" --html "$out/$page" \
  --region-distances 4096 "$@"
