#!/bin/bash
# Same input, same bits. Runs five cases, hashes all files they write, and compares repeated runs, one and two threads,
# an interrupted and resumed run, and other builds (debug, release, with sanitizers).
#
#   same_bits.sh BIN_FOLDER [OTHER_BIN_FOLDER ...]
set -u
bins=$(realpath "$@") || exit 1
cd "$(dirname "$0")/../.." || exit 1
. tests/faults/common.sh
first=$(echo "$bins" | head -n 1)
# Every file contains the revision.
[ "$(for bin in $bins; do "$bin/cupola-solve" --version; done | sort -u | wc -l)" -eq 1 ] ||
  { echo "the builds are of different revisions: run cmake again in each"; exit 1; }
differ=0; compared=0

# Five cases: different bonds, three surfaces, both friction laws, static and dynamic.
settings() {
  case $1 in
    dome_circular) ;;
    octagon_planar_horizontal) echo geometry.bond.rings=20;;
    brunelleschi) ;;
    wall_herringbone) echo analysis.friction_law=coulomb;;
    dome_circular_dynamic) echo geometry.bond.rings=12 geometry.bond.blocks_per_ring=16 analysis.duration=1 output.frames_every=0.05;;
  esac
}

# run NAME BIN FOLDER [SOLVE OPTION ...]
run() {
  local name=$1 bin=$2 folder=$3 sets=() word
  for word in $(settings "$name"); do sets+=(--set "$word"); done
  mkdir -p "$folder"
  "$bin/cupola-generate" cases/"$name".yaml --quiet --output "$folder/assembly.vtu" "${sets[@]}" &&
    "$bin/cupola-solve" cases/"$name".yaml --quiet --assembly "$folder/assembly.vtu" --output "$folder/results" \
      "${sets[@]}" "${@:4}"
}
# Hash of all files, without times, memory and threads, and without the checkpoint, which a finished run may lack.
hash_of() { contents "$1" 'threads|"run.yaml"' | grep -v '/checkpoint ' | md5sum | cut -c1-16; }
# compare WHAT FOLDER
compare() {
  local hash; hash=$(hash_of "$2"); compared=$((compared + 1))
  [ "$hash" = "$expected" ] || { differ=$((differ + 1)); echo "DIFFERENT: $name, $1: $hash"; }
}

for name in dome_circular octagon_planar_horizontal brunelleschi wall_herringbone dome_circular_dynamic; do
  reference=$work/$name
  export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 # threads of libraries; those of the program are set by --threads
  run $name "$first" "$reference"; code=$?
  [ $code -eq 0 ] || [ $code -eq 3 ] || { echo "$name ended with $code"; exit 1; }
  expected=$(hash_of "$reference")
  echo "$name: $expected"
  run $name "$first" "$work/again"; compare "a second run" "$work/again"; rm -r "$work/again"
  export OMP_NUM_THREADS=2 OPENBLAS_NUM_THREADS=2
  run $name "$first" "$work/two" --threads 2; compare "two threads" "$work/two"; rm -r "$work/two"
  for bin in $(echo "$bins" | tail -n +2); do
    run $name "$bin" "$work/other"; compare "$bin" "$work/other"; rm -r "$work/other"; done
done

# The dynamic case again, interrupted five times as soon as a new frame is written, then resumed to its end.
interruptions=0; folder=$work/resumed; resume=()
while :; do
  run $name "$first" "$folder" "${resume[@]}" & pid=$!
  next=$(printf '%s/results/contacts_%04d.vtp' "$folder" $((2 * interruptions + 1)))
  if [ $interruptions -lt 5 ]; then
    until [ -e "$next" ] || ! kill -0 $pid 2> /dev/null; do sleep 0.01; done
    pkill -TERM -P $pid cupola-solve
  fi
  wait $pid; code=$?
  [ $code -eq 4 ] || break
  interruptions=$((interruptions + 1)); resume=(--resume)
done
[ $code -eq 0 ] && [ $interruptions -gt 0 ] || { differ=$((differ + 1)); echo "not resumed: code $code"; }
compare "resumed after $interruptions interruptions" "$folder"
echo "5 cases, $compared comparisons, $differ differ"
[ $differ -eq 0 ]
