#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds the examples and the program, runs them all, and turns every job of examples/jobs into a result and a picture.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../test/setup.sh"
cd "$locus_root"

install_missing core example
# Tests stay as an existing build folder has them; a new one goes without, to be quick.
new=()
[[ -f build/CMakeCache.txt ]] || new=(-DLOCUS_BUILD_TESTS=OFF)
cmake --preset release -DLOCUS_BUILD_EXAMPLES=ON "${new[@]}"
cmake --build build --parallel "$jobs" --target locus_examples

out=$locus_root/build/examples-out
mkdir -p "$out"
failed=0 undecided=0 answered=0 pictures=0

shopt -s nullglob
for source in examples/*.cpp; do
  name=$(basename "$source" .cpp)
  echo "== example $name"
  (cd "$out" && "$locus_root/build/bin/example_$name") || { echo "   FAILED with status $?"; failed=$((failed + 1)); }
done

for job in examples/jobs/*.json examples/jobs/*/*.json; do
  name=$(basename "$job" .json)
  rm -f "$out/$name".{json,svg,png,ply,vtk} # an old picture must not pass for this run's
  # Of plane jobs there are pictures, of surfaces in space meshes.
  extra=(--svg "$out/$name.svg")
  if [[ $job == */space/* ]]; then
    extra=()
    grep -q '"compute": "bisector"' "$job" && extra=(--ply "$out/$name.ply" --vtk "$out/$name.vtk")
  fi
  status=0
  build/bin/locus "$job" --json "$out/$name.json" "${extra[@]}" || status=$?
  case $status in
    0) answered=$((answered + 1)); verdict=certified ;;
    1) undecided=$((undecided + 1)); verdict="answered, with something undecided (see $name.json)" ;;
    *) failed=$((failed + 1)); verdict="FAILED with status $status" ;;
  esac
  echo "== job $name: $verdict"
  if [[ -f $out/$name.svg ]]; then
    pictures=$((pictures + 1))
    if command -v rsvg-convert >/dev/null; then
      rsvg-convert --width 1000 --keep-aspect-ratio --background-color white "$out/$name.svg" --output "$out/$name.png"
    fi
  fi
done

if ((answered + undecided + failed == 0)); then
  echo "no job was run: examples/jobs/*.json is empty" >&2
  exit 1
fi
echo "$answered certified, $undecided with something undecided, $failed failed; $pictures pictures in $out"
((failed == 0))
