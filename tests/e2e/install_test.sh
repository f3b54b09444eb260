#!/bin/bash
# Installs a build tree to a temporary prefix, builds the example against it by find_package and by
# pkg-config, and holds what it composes against what `pleinair replay` does with the same recording.
# Arguments: build folder, source folder of the examples, recording.
set -euo pipefail
build=$1
examples=$2
recording=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
pleinair=$work/prefix/bin/pleinair
"$pleinair" --version

# None of what is installed may ask for these libraries' headers.
if grep -rnE '#include [<"](glm|GL|EGL|epoxy|opencv2|Eigen|ceres)/' "$work/prefix/include"; then
  echo "An installed header includes a library that stays inside." >&2
  exit 1
fi

cmake -S "$examples" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/configure.log"
cmake --build "$work/build"

# The files name the prefix that was configured; pkg-config moves them to where they lie.
PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name pleinair.pc)")
export PKG_CONFIG_PATH
pkg-config --define-prefix --validate pleinair
read -r -a flags <<<"$(pkg-config --define-prefix --cflags --libs pleinair)"
c++ "$examples/track_and_compose.cc" "${flags[@]}" -o "$work/track_and_compose"

"$pleinair" replay "$recording" -o "$work/replay" --frames --no-video
"$work/build/track_and_compose" "$recording" "$work/by_cmake" >"$work/by_cmake.txt"
"$work/track_and_compose" "$recording" "$work/by_pkg_config" >"$work/by_pkg_config.txt"
cmp "$work/by_cmake.txt" "$work/by_pkg_config.txt"
for frames in by_cmake by_pkg_config; do
  diff -r "$work/replay/frames" "$work/$frames"
done
[ -n "$(ls "$work/by_cmake")" ]

# Poses: detections.jsonl has a line a frame, with the pose in full digits.
python3 - "$work/replay/detections.jsonl" "$work/by_cmake.txt" <<'PROGRAM'
import json, sys
replayed = []
for line in open(sys.argv[1]):
    frame = json.loads(line)
    for marker in frame["markers"][:1]:
        t = marker["camera_from_marker"]["translation_m"]
        replayed.append("frame %d: the marker lies at %.6f %.6f %.6f m" % (frame["frame"], *t))
printed = open(sys.argv[2]).read().splitlines()
if not replayed or printed != replayed:
    sys.exit("The example's poses are not those of replay: %d and %d" % (len(printed), len(replayed)))
PROGRAM
