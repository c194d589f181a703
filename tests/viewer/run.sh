#!/bin/sh
# Drives the viewer's page in a browser: first with pages of its own, then with the page and the report of the
# demonstration, whose numbers have to agree to the last digit, then with a scene of impacts and a surface that meets itself, and
# with a recording of solids and its exported tables. It ends with 77 where there is no viewer or no browser.
# Usage: tests/viewer/run.sh GRAZE GRAZE_DEMO_SCENE VIEWER_FOLDER
set -eu

graze=$1
demo_scene=$2
GRAZE_VIEWER_FOLDER=$3
export GRAZE_VIEWER_FOLDER
CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
export CHROMIUM
if [ -z "$CHROMIUM" ] || [ ! -f "$GRAZE_VIEWER_FOLDER/dist/viewer.html" ]; then
  echo "skipped: the viewer's page needs nodejs and npm to be built, and chromium to be looked at"
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
scene=$("$demo_scene" "$folder")
"$graze" run "$scene" --report "$folder/report.jsonl" --html "$folder/view.html" --region-distances 4096 >/dev/null
# How long things take is printed here: a machine that builds and tests beside this says nothing of it. By hand, without
# TIMES, the limits are asserted.
TIMES=print node "$(dirname "$0")/viewer_test.mjs"
node "$(dirname "$0")/viewer_test.mjs" "$folder/view.html" "$folder/report.jsonl"

here=$(dirname "$0")
node "$here/make_swept.mjs" "$folder"
"$graze" run "$folder/swept.json" --report "$folder/swept.jsonl" --html "$folder/swept.html" >/dev/null
node "$here/viewer_test.mjs" "$folder/swept.html" "$folder/swept.jsonl" swept

node "$here/make_solids.mjs" "$folder"
"$graze" run "$folder/solids.json" --record "$folder/solids.rec" >/dev/null
"$graze" export "$folder/solids.rec" --csv "$folder/contacts.csv" --distances "$folder/rows.csv" >/dev/null
"$graze" view "$folder/solids.rec" -o "$folder/solids.html" >/dev/null
node "$here/viewer_test.mjs" "$folder/solids.html" "$folder/contacts.csv" "$folder/rows.csv"
