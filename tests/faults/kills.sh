#!/bin/bash
# Kills make and everything it started (kill -9) at random moments of a case's three programs, starts it again
# each time, and compares the final files with those of an undisturbed run, bit by bit.
#
#   kills.sh BUILD_FOLDER KILLS [SECONDS OF MOTION, default 10: about a second of computing]
set -u
build=$1; kills=$2; motion=${3:-10}
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
  setsid make -f Makefile.cases small BUILD="$build" FOLDER="$work/cases" OUT="$work/killed" > "$work/log" 2>&1 &
  group=$!
  sleep "$(awk -v r=$RANDOM -v ms=$milliseconds 'BEGIN {print r / 32768 * ms / 1000}')"
  if kill -9 -- "-$group" 2> /dev/null; then done_kills=$((done_kills + 1)); fi
  wait $group 2> /dev/null
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
