#!/bin/sh
# Installs the Debian packages of graze on a fresh Debian 12, by apt-get and with all that they depend on, and uses them.
#
#   tests/packages/fresh.sh PACKAGES ROOT [MIRROR]
#
# PACKAGES is a folder with the four packages, of one version. ROOT is written by debootstrap, or is a fresh Debian that is
# there already. This needs root and the network, and takes some minutes. tests/run.sh does not run it.
# shellcheck disable=SC2016 # the shell in the root expands what it runs
set -eu
packages=$1
root=$2
mirror=${3:-http://deb.debian.org/debian}
source=$(cd "$(dirname "$0")/../.." && pwd)

[ -e "$root/bin/sh" ] || debootstrap --variant=minbase bookworm "$root" "$mirror"
mkdir -p "$root/graze"
cp "$packages"/*.deb "$root/graze"
cp -r "$source/tests/contract/program" "$source/tests/contract/io_component" "$root/graze"
cp "$source/tests/c_interface/page_program.py" "$source/docs/c_interface.md" "$source/docs/python.md" "$root/graze"

in_root() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 sh -euc "$1"; }
in_root 'apt-get update -qq && apt-get install -y -qq /graze/*.deb >/dev/null'
echo "== the program and the Python package, with what the packages brought"
in_root 'graze --version
  python3 - <<"END"
import re
program = re.search(r"```python\n(.*?)```", open("/graze/python.md").read(), flags=re.DOTALL)[1]
exec(program)
END'
echo "== programs, with compilers and CMake"
in_root 'apt-get install -y -qq --no-install-recommends g++ cmake ninja-build pkg-config man-db >/dev/null
  cd /graze
  for program in program io_component; do
    cmake -G Ninja -S "$program" -B "build_$program" -DCMAKE_BUILD_TYPE=Release >/dev/null
    cmake --build "build_$program" >/dev/null
  done
  build_program/consumer
  (cd build_io_component && ./io_component)
  python3 page_program.py c_interface.md page cc $(pkg-config --cflags --libs graze-c)
  c++ -std=c++20 io_component/main.cpp -o by_pkg_config $(pkg-config --cflags --libs graze-io)
  (cd page && ../by_pkg_config)
  man graze | head -5'
echo "== removed"
in_root 'apt-get purge -y -qq libgraze-c0 libgraze-dev graze-tools python3-graze >/dev/null
  left=$(find /usr -name "*graze*" -not -path "/graze/*")
  [ -z "$left" ] || { echo "left: $left"; exit 1; }'
echo "the packages install, work and go"
