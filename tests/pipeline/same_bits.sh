#!/bin/bash
# Same input, same bits. Runs every case, variant and sweep member of tests/net (static, dynamic, staged, limit, range and
# path analyses) through the three programs, and compares all files, of repeated runs, one and two
# threads, and other builds (debug, release, with sanitizers). Then interrupts and resumes a motion, a path and a building.
#
#   same_bits.sh BIN_FOLDER [OTHER_BIN_FOLDER ...]
set -u
bins=$(realpath "$@") || exit 1
cd "$(dirname "$0")/../.." || exit 1
. tests/faults/common.sh
first=$(echo "$bins" | head -n 1)
export CUPOLA_CASES=$PWD/cases
# Every file contains the revision.
[ "$(for bin in $bins; do "$bin/cupola-solve" --version; done | sort -u | wc -l)" -eq 1 ] ||
  { echo "the builds are of different revisions: run cmake again in each"; exit 1; }
differ=0; compared=0

# NAME CASE key.path=value ..., one run per line.
runs() {
  local file name
  for file in tests/net/*.yaml; do
    name=$(basename "$file" .yaml)
    [ "$name" = wall_sweep ] || echo "$name $name"
  done
  grep '^[a-z]' tests/net/variants.txt
  "$first/cupola-post" study tests/net/wall_sweep.yaml --members "$work/members.txt" && cat "$work/members.txt"
}

# run BIN FOLDER CASE "SETTINGS" [SOLVE OPTION ...]
run() {
  local bin=$1 folder=$2 file=tests/net/$3.yaml sets=() word
  for word in $4; do sets+=(--set "$word"); done
  mkdir -p "$folder"
  "$bin/cupola-generate" "$file" --quiet --output "$folder/assembly.vtu" "${sets[@]}" || return
  "$bin/cupola-solve" "$file" --quiet --assembly "$folder/assembly.vtu" --output "$folder/results" "${sets[@]}" "${@:5}"
  local code=$?
  [ $code -eq 0 ] || [ $code -eq 3 ] || return $code
  "$bin/cupola-post" analyse "$file" --quiet --tables --assembly "$folder/assembly.vtu" --results "$folder/results" \
    --output "$folder/post" "${sets[@]}"
}
# compare WHAT FOLDER: all files, without the lines of times, memory and threads. The hash of run.yaml covers its line of threads.
compare() {
  compared=$((compared + 1))
  contents "$2" 'threads|"run.yaml"' | cmp -s - "$work/expected" && return
  differ=$((differ + 1)); echo "DIFFERENT: $name, $1:"
  contents "$2" 'threads|"run.yaml"' | diff - "$work/expected" | head -n 60
}
# Threads of libraries; those of the program are set by --threads.
library_threads() { export OMP_NUM_THREADS=$1 OPENBLAS_NUM_THREADS=$1; }

runs > "$work/runs.txt" || exit 1; count=0
while read -r name case settings <&3; do
  count=$((count + 1))
  library_threads 1
  run "$first" "$work/reference" "$case" "$settings" 2> "$work/err" || { cat "$work/err"; echo "$name fails"; exit 1; }
  contents "$work/reference" 'threads|"run.yaml"' > "$work/expected"
  run "$first" "$work/run" "$case" "$settings" 2> "$work/err"; compare "a second run" "$work/run"; rm -r "$work/run"
  library_threads 2
  run "$first" "$work/run" "$case" "$settings" --threads 2 2> "$work/err"; compare "two threads" "$work/run"; rm -r "$work/run"
  for bin in $(echo "$bins" | tail -n +2); do
    run "$bin" "$work/run" "$case" "$settings" 2> "$work/err"; compare "$bin" "$work/run"; rm -r "$work/run"; done
  # Interrupted as soon as a new frame is written, and resumed, until it ends.
  interruptions=0; resume=()
  case $name in dome_motion|dome_adaptive|dome_carried|arch_path|wall_path) ;; *) rm -r "$work/reference"; continue ;; esac
  while :; do
    run "$first" "$work/run" "$case" "$settings" "${resume[@]}" 2> "$work/err" & pid=$!
    next=$(printf '%s/results/contacts_%04d.vtp' "$work/run" $((interruptions + 1)))
    until [ -e "$next" ] || ! kill -0 $pid 2> /dev/null; do sleep 0.002; done
    pkill -TERM -P $pid cupola-solve
    wait $pid; code=$?
    [ $code -eq 4 ] || break
    interruptions=$((interruptions + 1)); resume=(--resume)
  done
  [ $code -eq 0 ] || { differ=$((differ + 1)); echo "$name: not resumed: code $code"; }
  compare "resumed after $interruptions interruptions" "$work/run"
  resumed="${resumed-}$name after $interruptions interruptions, "; rm -r "$work/run" "$work/reference"
done 3< "$work/runs.txt"
echo "$count runs, ${resumed}$compared comparisons, $differ differ"
[ $differ -eq 0 ]
