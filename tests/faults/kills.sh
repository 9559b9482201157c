#!/bin/bash
# Kills make and all its child processes (kill -9) at random times while it runs the three programs on a case, starts
# it again each time, and compares the final files bit by bit with those of an undisturbed run.
#
#   kills.sh BUILD_FOLDER KILLS [SECONDS OF MOTION, default 3, which takes a few seconds to compute]
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
  moment=$RANDOM # not inside the command below: a subshell has its own sequence
  seconds=$(awk -v r=$moment -v ms=$milliseconds 'BEGIN {print r / 32768 * ms / 1000}')
  # timeout kills the whole process group, itself included; the message of the shell goes to the log.
  { timeout -s KILL "$seconds" make -f Makefile.cases small BUILD="$build" FOLDER="$work/cases" OUT="$work/killed"; } \
    > "$work/log" 2>&1
  code=$?
  if [ $code -eq 137 ]; then done_kills=$((done_kills + 1))
  elif [ $code -ne 0 ]; then cat "$work/log"; echo "fails to resume after $done_kills kills"; exit 1; fi
  # The case is complete: compare it and start again.
  if [ -e "$work/killed/small/.drawn" ]; then
    finished=$((finished + 1))
    diff <(contents "$work/reference") <(contents "$work/killed") || { echo "differs after $done_kills kills"; exit 1; }
    rm -rf "$work/killed"
  fi
done
run killed || { cat "$work/log"; exit 1; }
diff <(contents "$work/reference") <(contents "$work/killed") || { echo "differs at the end"; exit 1; }
echo "$done_kills kills over $((finished + 1)) runs: all results bit-identical to those of the undisturbed run"
