#!/bin/sh
# The tests of the Python package.
#
#   tests/python/run.sh package LIBRARY       with the package as it lies in the sources, and a libgraze_c.so
#   tests/python/run.sh wheel BUILD WORK      builds a wheel of the library in BUILD, a folder of CMake's, installs it
#                                             into an environment that has numpy alone, and tests what is installed.
#                                             The folder WORK is written anew
#
# PYTHON names an interpreter. Otherwise it is the first python3 that has numpy. Without one the exit code is 77.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$here/../../tools/python
unset GRAZE_LIBRARY PYTHONPATH
export PYTHONDONTWRITEBYTECODE=1

# has INTERPRETER MODULE...: whether the interpreter has all of these.
has() {
  interpreter=$1
  shift
  for module in "$@"; do
    "$interpreter" -c "import $module" 2>/dev/null || return 1
  done
}

modules=numpy
[ "$1" != wheel ] || modules="numpy build setuptools wheel venv ensurepip"
python=
for candidate in ${PYTHON:-python3 /usr/bin/python3}; do
  # shellcheck disable=SC2086 # a list of modules
  if has "$candidate" $modules; then
    python=$candidate
    break
  fi
done
if [ -z "$python" ]; then
  echo "skipped: no python3 has $modules; tools/install_packages.sh installs them"
  exit 77
fi

if [ "$1" = package ]; then
  GRAZE_LIBRARY=$2 PYTHONPATH=$source exec "$python" -m unittest discover -s "$here" -p '*_test.py'
fi

build=$2
work=$3
rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$work/prefix" >/dev/null
library=$(find "$work/prefix" -name 'libgraze_c.so.0')
# The build writes into its folder, so it works on a copy.
cp -r "$source" "$work/source"
GRAZE_LIBRARY=$library "$python" -m build --wheel --no-isolation --outdir "$work" "$work/source" >"$work/log" 2>&1 || {
  cat "$work/log"
  exit 1
}
rm -r "$work/prefix" "$work/source"

# Of the system's packages the environment gets numpy, and no other.
"$python" -m venv "$work/venv"
packages=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
numpy=$("$python" -c 'import pathlib, numpy; print(pathlib.Path(numpy.__file__).parent)')
ln -s "$numpy" "$packages/numpy"
"$work/venv/bin/python" -m pip install --quiet --no-index --no-deps --disable-pip-version-check "$work"/graze-*.whl
"$work/venv/bin/python" -m unittest discover -s "$here" -p '*_test.py'
