#!/bin/sh
# Installs a build tree to a temporary prefix and builds a small program against it, by
# find_package and by pkg-config. Arguments: build folder, source folder of the program.
set -eu
build=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
"$work/prefix/bin/pleinair" --version
cmake -S "$source" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/configure.log"
cmake --build "$work/build"
"$work/build/consumer"

# The files name the prefix that was configured; pkg-config moves them to where they lie.
pc=$(dirname "$(find "$work/prefix" -name pleinair-sky.pc)")
PKG_CONFIG_PATH=$pc pkg-config --define-prefix --validate pleinair-sky pleinair-gl pleinair-shadows \
  pleinair-compositor pleinair-devices pleinair-tracker
cat >"$work/sun.cc" <<'PROGRAM'
#include "sky/sun/sun_position.h"
int main() { return pleinair::sky::ComputeSunPosition({}, {}).distance_au > 0.9 ? 0 : 1; }
PROGRAM
flags=$(PKG_CONFIG_PATH=$pc pkg-config --define-prefix --cflags --libs pleinair-sky)
# shellcheck disable=SC2086  # Flags are words.
c++ "$work/sun.cc" $flags -o "$work/sun"
"$work/sun"
