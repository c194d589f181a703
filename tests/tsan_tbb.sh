#!/bin/sh
# Builds Debian's oneTBB for the thread sanitizer into a folder, from the sources of the machine's own mirror. Of the
# library as it is packaged the sanitizer sees no synchronisation, and warns of races that are none.
#
#   tests/tsan_tbb.sh FOLDER      (does nothing where the folder has one)
set -eu

mkdir -p "$1"
prefix=$(cd "$1" && pwd)
[ ! -f "$prefix/finished" ] || exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/sources" "$work/lists/partial" "$work/tbb"

# The machine's package sources, asked for source packages in lists of their own: nothing of the machine's is changed.
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
  [ ! -f "$file" ] || sed -n 's/^deb /deb-src /p' "$file" >>"$work/sources/machine.list"
done
for file in /etc/apt/sources.list.d/*.sources; do
  [ ! -f "$file" ] || sed 's/^Types:.*/Types: deb-src/' "$file" >"$work/sources/$(basename "$file")"
done
apt_get() {
  apt-get -qq -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/sources" \
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work" -o APT::Sandbox::User=root "$@"
}
apt_get update
(cd "$work" && apt_get source --download-only onetbb)
tar -xf "$work"/onetbb_*.orig.tar.* -C "$work/tbb" --strip-components=1

cmake -S "$work/tbb" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_CXX_COMPILER=clang++ -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF >/dev/null
cmake --build "$work/build" -- --quiet
cmake --install "$work/build" >/dev/null
touch "$prefix/finished"
