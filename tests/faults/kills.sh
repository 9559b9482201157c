#!/bin/bash
# Kills make and all its child processes (kill -9) at random times while it runs every type of analysis and a sweep through
# the three programs, starts it again each time, and compares the final files bit by bit with those of an undisturbed run.
#
#   kills.sh BUILD_FOLDER KILLS
set -u
build=$1; kills=$2
cd "$(dirname "$0")/../.." || exit 1
. tests/faults/common.sh
targets="dome dome_motion dome_adaptive dome_range dome_limit dome_staged dome_carried wall_path wall_sweep"

run() { make -f Makefile.run $targets BIN="$build/bin" FOLDER=tests/net OUT="$work/$1" POST=--tables > "$work/log" 2>&1; }
# The table of a sweep and its page contain processor times.
files_of() { contents "$work/$1" | grep -v -e wall_sweep/sweep -e wall_sweep/study.html; }

start=$(date +%s%N)
run reference || { cat "$work/log"; exit 1; }
milliseconds=$(( ($(date +%s%N) - start) / 1000000 ))
RANDOM=1; done_kills=0; finished=0
while [ $done_kills -lt "$kills" ]; do
  moment=$RANDOM # not inside the command below: a subshell has its own sequence
  seconds=$(awk -v r=$moment -v ms=$milliseconds 'BEGIN {print r / 32768 * ms / 1000}')
  # timeout kills the whole process group, itself included; the message of the shell goes to the log.
  { timeout -s KILL "$seconds" make -f Makefile.run $targets BIN="$build/bin" FOLDER=tests/net OUT="$work/killed" POST=--tables; } \
    > "$work/log" 2>&1
  code=$?
  if [ $code -eq 137 ]; then done_kills=$((done_kills + 1)); continue
  elif [ $code -ne 0 ]; then cat "$work/log"; echo "fails to resume after $done_kills kills"; exit 1; fi
  finished=$((finished + 1))
  diff <(files_of reference) <(files_of killed) || { echo "differs after $done_kills kills"; exit 1; }
  rm -rf "$work/killed"
done
run killed || { cat "$work/log"; exit 1; }
diff <(files_of reference) <(files_of killed) || { echo "differs at the end"; exit 1; }
[ -z "$(find "$work/killed" -name '*.part*')" ] || { find "$work/killed" -name '*.part*'; echo "temporary files remain"; exit 1; }
echo "$done_kills kills over $((finished + 1)) runs of $(echo $targets | wc -w) cases: all results bit-identical to those of the undisturbed run"
