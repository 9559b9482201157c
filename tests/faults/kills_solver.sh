#!/bin/bash
# Kills cupola-solve (kill -9) at random times while a wall falls, resumes it each time, and compares the final files
# bit by bit with those of an undisturbed run. kills.sh does the same with all three programs under make.
#
#   kills_solver.sh BIN_FOLDER KILLS
set -u
bin=$(realpath "$1"); kills=$2
. "$(dirname "$0")/common.sh"
cp "$here/motion.yaml" "$case_file"
mkdir "$work/whole" "$work/killed"

generate "$work/killed" || exit 1
cp "$work/killed/assembly.vtu" "$work/whole"
start=$(date +%s%N)
solve "$work/whole" || exit 1
milliseconds=$(( ($(date +%s%N) - start) / 1000000 ))
contents "$work/whole" > "$work/expected"

RANDOM=1; done_kills=0; finished=0; resumed=0
while [ $done_kills -lt "$kills" ]; do
  [ ! -e "$work/killed/results/checkpoint" ] || resumed=$((resumed + 1))
  "$bin/cupola-solve" "$case_file" --quiet --assembly "$work/killed/assembly.vtu" --output "$work/killed/results" --resume \
    2> "$work/err" &
  solver=$!
  sleep "$(awk -v r=$RANDOM -v ms=$milliseconds 'BEGIN {print r / 32768 * ms / 1000}')"
  kill -9 $solver 2> /dev/null
  wait $solver 2> /dev/null
  case $? in
    137) done_kills=$((done_kills + 1));;
    0) finished=$((finished + 1))
       contents "$work/killed" | diff "$work/expected" - || { echo "differs after $done_kills kills"; exit 1; }
       rm -rf "$work/killed/results";;
    *) cat "$work/err"; echo "fails to resume after $done_kills kills"; exit 1;;
  esac
done
solve "$work/killed" --resume || exit 1
contents "$work/killed" | diff "$work/expected" - || { echo "differs at the end"; exit 1; }
echo "$done_kills kills over $((finished + 1)) runs, $resumed of them resumed from a checkpoint: all results bit-identical"
[ "$resumed" -gt $((kills / 4)) ]
