#!/bin/sh
# The lint step: checks how the sources are written. Nothing is left out silently: a tool that is missing is a failure.
#
#   tests/lint/run.sh [text] [order] [tidy] [paths]      (without a name: the first three)
#
# text    every C++ file is as clang-format 14 writes it; shell scripts pass shellcheck and Python scripts pyflakes;
#         lines end as .editorconfig says
# order   no folder of the sources includes one that is not above it, and sources keep the rules of source_rules.py
# tidy    clang-tidy 14 finds nothing in core and scheduler, names included (.clang-tidy)
# paths   its analyzer finds nothing on any path through them; this takes a quarter of an hour on two cores
set -eu
cd "$(dirname "$0")/../.."

build=build/lint
status=0

# Says what is wrong, and goes on with the next check.
complain() {
  echo "lint: $1" >&2
  status=1
}

# tool NAME: the path of NAME of version 14, whichever way the system calls it. Empty where there is none.
tool() {
  for candidate in "$1-14" "$1"; do
    if command -v "$candidate" >/dev/null && "$candidate" --version | grep -q 'version 14\.'; then
      echo "$candidate"
      return
    fi
  done
}

# files ENDINGS: the project's files with one of these endings (a pattern); builds and results are left out.
files() {
  find . \( -path './build*' -o -path ./out -o -path ./.git \) -prune -o -type f -print | grep -E "\.($1)\$" | sort
}

check_text() {
  if files '.*' | grep ' '; then
    complain "the files above have a space in their names"
  fi

  format=$(tool clang-format)
  if [ -n "$format" ]; then
    files 'cpp|hpp|inc' | xargs -n 50 -P "$(nproc)" "$format" --dry-run --Werror || complain "run $format -i on the files named above"
  else
    complain "clang-format 14 is missing; tools/install_packages.sh peers installs it on Debian 12"
  fi

  for script in $(files sh) .ci/run; do
    bash -n "$script" || complain "$script is no shell script"
  done
  if command -v shellcheck >/dev/null; then
    files sh | xargs shellcheck || complain "shellcheck found what is named above"
  else
    complain "shellcheck is missing; tools/install_packages.sh peers installs it"
  fi
  if command -v pyflakes3 >/dev/null; then
    files py | xargs pyflakes3 || complain "pyflakes found what is named above"
  else
    complain "pyflakes3 is missing; tools/install_packages.sh peers installs it"
  fi

  # What .editorconfig says of lines.
  if files 'cpp|hpp|inc|sh|py|cmake|json|txt' | xargs grep -nE "$(printf '[ \t\r]$|\t')"; then
    complain "the lines above have a tab, a carriage return or a space at the end"
  fi
  for file in $(files 'cpp|hpp|inc|sh|py|cmake|json|txt|md'); do
    [ -z "$(tail -c 1 "$file")" ] || complain "$file does not end with the end of a line"
  done
}

check_order() {
  python3 tests/lint/include_order.py || complain "a folder includes one that is not above it"
  python3 tests/lint/source_rules.py || complain "a rule of the sources is broken"
}

# configure ON|OFF: writes down how the sources are compiled, in batches or each by itself.
configure() {
  mkdir -p "$build"
  mpi=OFF
  if command -v mpicxx >/dev/null; then mpi=ON; fi
  cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DGRAZE_IO=OFF \
    -DGRAZE_MPI="$mpi" -DGRAZE_BUILD_TOOLS=OFF -DGRAZE_BUILD_TESTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DCMAKE_UNITY_BUILD="$1" -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 >"$build/log" 2>&1
}

# run_tidy CHECKS: clang-tidy on all that configure wrote down, with CHECKS added to those of .clang-tidy.
run_tidy() {
  list=$(sed -n 's/^ *"file": "\(.*\)",*$/\1/p' "$build/compile_commands.json")
  if [ -z "$list" ]; then
    complain "clang-tidy: there is nothing to look at"
    return
  fi
  echo "$list" | xargs -n 1 -P "$(nproc)" "$tidy" -p "$build" --quiet --checks="$1" \
    --header-filter='/(core|scheduler)/.*\.(cpp|hpp|inc)$' >"$build/found" 2>"$build/log" || {
    cat "$build/found"
    grep -E 'error:' "$build/log" || true
    complain "clang-tidy found what is named above"
  }
}

# lint_with_tidy ON|OFF CHECKS: clang-tidy on all of core and scheduler, in batches or each source by itself.
lint_with_tidy() {
  tidy=$(tool clang-tidy)
  if [ -z "$tidy" ]; then
    complain "clang-tidy 14 is missing; tools/install_packages.sh peers installs it on Debian 12"
  elif configure "$1"; then
    run_tidy "$2"
  else
    cat "$build/log" >&2
    complain "clang-tidy: the sources cannot be configured"
  fi
}

# In batches clang-tidy reads headers once, on which it spends nearly all its time. It takes the sources of a batch for
# headers, so its analyzer does not follow paths through their functions. A batch includes sources on purpose.
check_tidy() { lint_with_tidy ON -bugprone-suspicious-include; }

check_paths() { lint_with_tidy OFF '-*,clang-analyzer-*'; }

[ $# -gt 0 ] || set -- text order tidy
for check in "$@"; do
  began=$(date +%s)
  case $check in
    text) check_text ;;
    order) check_order ;;
    tidy) check_tidy ;;
    paths) check_paths ;;
    *) complain "there is no check $check; there are text, order, tidy and paths" ;;
  esac
  echo "lint: $check took $(($(date +%s) - began)) s"
done
exit "$status"
