#!/bin/sh
# Drives the page that computes in a browser. It ends with 77 where the page has no module, or there is no browser.
# Usage: tests/viewer/compute.sh GRAZE GRAZE_DEMO_SCENE VIEWER_FOLDER
set -eu

graze=$1
demo_scene=$2
GRAZE_VIEWER_FOLDER=$3
export GRAZE_VIEWER_FOLDER
CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
export CHROMIUM
if [ -z "$CHROMIUM" ] || [ ! -f "$GRAZE_VIEWER_FOLDER/module.wasm" ]; then
  echo "skipped: the module that computes in the page needs emscripten, nodejs and npm to be built, and chromium to be looked at"
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
here=$(dirname "$0")
scene=$("$demo_scene" "$folder")
node "$here/make_solids.mjs" "$folder"
node "$here/make_filtered.mjs" "$folder"
node "$here/compute_test.mjs" "$graze" "$scene" "$folder/solids.json" "$folder"
