#!/bin/sh
# The main command: installs what is missing, builds graze, and plays the demonstration scene into out/demo.
set -eu
cd "$(dirname "$0")/.."

tools/install_packages.sh
cmake --preset release -DGRAZE_BUILD_TESTS=OFF -DGRAZE_STUDIES=OFF >/dev/null
cmake --build --preset release --target graze_program graze_demo_scene
tools/demo/run.sh build/release out/demo
