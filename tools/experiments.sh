#!/bin/sh
# Reproduces every table and figure of the experiments: installs what is missing, builds graze, measures, and writes
# out/experiments/ and docs/experiments.md with its images. Arguments go to `graze experiment all`.
set -eu
cd "$(dirname "$0")/.."

tools/install_packages.sh
cmake --preset release -DGRAZE_BUILD_TESTS=OFF >/dev/null
cmake --build --preset release --target graze_program
build/release/tools/graze/graze experiment all --out out/experiments --docs docs "$@"
