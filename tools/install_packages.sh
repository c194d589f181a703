#!/bin/sh
# Installs the Debian packages that graze is built, run and tested with. With the argument `demo` these are only the
# packages that the demonstration needs. With the argument `peers` they are also the libraries that `graze_studies bench`
# compares graze with, and the programs that measure and check the sources and the Debian packages. With `platforms` they
# are also the compilers and emulators of other platforms, and with `packages` what tries the Debian packages on a fresh
# system, and the shells whose completions are tried. Run it as root, or where sudo asks for no password.
set -eu

packages="g++ cmake ninja-build pkg-config libeigen3-dev libtbb-dev libassimp-dev assimp-testmodels libspdlog-dev
  nlohmann-json3-dev libcli11-dev libpng-dev zlib1g-dev"
[ "${1:-}" = demo ] || packages="$packages libtinyobjloader-dev catch2 libgmp-dev clang libclang-rt-dev locales gnuplot-nox
  libmd4c-html0-dev libmd4c-dev chromium libopenmpi-dev openmpi-bin
  python3 python3-numpy python3-venv python3-build python3-setuptools python3-wheel"
[ "${1:-}" != platforms ] || packages="$packages g++-aarch64-linux-gnu qemu-user g++-mingw-w64-x86-64-posix wine64
  emscripten"
[ "${1:-}" != peers ] || packages="$packages libfcl-dev libbullet-dev libembree-dev libcgal-dev libnanoflann-dev
  libbenchmark-dev valgrind clang-format clang-tidy shellcheck pyflakes3 doxygen doxygen-awesome-css dpkg-dev man-db lintian"
[ "${1:-}" != packages ] || packages="$packages dpkg-dev man-db lintian debootstrap zsh fish"

# The viewer's page is built with Node.js and npm. They may be there without these packages.
command -v node >/dev/null || packages="$packages nodejs"
command -v npm >/dev/null || packages="$packages npm"

missing=""
for package in $packages; do
  state=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$state" = "install ok installed" ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
[ "$(id -u)" -eq 0 ] || as_root="sudo"
echo "installing:$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
# shellcheck disable=SC2086 # a list of names
$as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
