#!/bin/sh
# Reproduces every table and figure of the experiments: installs what is missing, builds graze, measures, and writes
# out/experiments/ and docs/experiments.md with its images. Arguments go to `graze_studies experiment all`.
set -eu
cd "$(dirname "$0")/.."

tools/install_packages.sh
cmake --preset release -DGRAZE_BUILD_TESTS=OFF >/dev/null
cmake --build --preset release --target graze_studies
build/release/tools/studies/graze_studies experiment all --out out/experiments --docs docs "$@"
