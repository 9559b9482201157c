#!/bin/bash
# Kills make and everything it started (kill -9) at random moments of a case's three programs, starts it again
# each time, and compares the final files with those of an undisturbed run, bit by bit.
#
#   kills.sh BUILD_FOLDER KILLS [SECONDS OF MOTION, default 3: some seconds of computing]
set -u
build=$1; kills=$2; motion=${3:-3}
cd "$(dirname "$0")/../.." || exit 1
. tests/faults/common.sh
mkdir "$work/cases"; cp tests/faults/small.yaml "$work/cases/small.yaml"
sed -i "s/duration: .*}/duration: $motion}/" "$work/cases/small.yaml"

run() { make -f Makefile.cases small BUILD="$build" FOLDER="$work/cases" OUT="$work/$1" > "$work/log" 2>&1; }

start=$(date +%s%N)
run reference || { cat "$work/log"; exit 1; }
milliseconds=$(( ($(date +%s%N) - start) / 1000000 ))
RANDOM=1; done_kills=0; finished=0
while [ $done_kills -lt "$kills" ]; do
  moment=$RANDOM # not in the line below: a subshell has numbers of its own
  seconds=$(awk -v r=$moment -v ms=$milliseconds 'BEGIN {print r / 32768 * ms / 1000}')
  # timeout kills the whole process group, itself too; the shell's word about that goes to the log.
  { timeout -s KILL "$seconds" make -f Makefile.cases small BUILD="$build" FOLDER="$work/cases" OUT="$work/killed"; } \
    > "$work/log" 2>&1
  code=$?
  if [ $code -eq 137 ]; then done_kills=$((done_kills + 1))
  elif [ $code -ne 0 ]; then cat "$work/log"; echo "does not go on after $done_kills kills"; exit 1; fi
  # A finished case has nothing left to kill: compare it and begin anew.
  if [ -e "$work/killed/small/.drawn" ]; then
    finished=$((finished + 1))
    diff <(contents "$work/reference") <(contents "$work/killed") || { echo "differs after $done_kills kills"; exit 1; }
    rm -rf "$work/killed"
  fi
done
run killed || { cat "$work/log"; exit 1; }
diff <(contents "$work/reference") <(contents "$work/killed") || { echo "differs at the end"; exit 1; }
echo "$done_kills kills over $((finished + 1)) runs: every result bit-identical to the undisturbed one"
