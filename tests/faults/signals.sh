#!/bin/bash
# Sends SIGTERM or SIGINT at random moments to runs of every analysis. Each must end within two seconds with exit code 4,
# leave interrupted.json and no summary, and complete when it is started again.
#
#   signals.sh BIN_FOLDER SIGNALS
set -u
bin=$(realpath "$1"); signals=$2
cd "$(dirname "$0")/../.." || exit 1
. tests/faults/common.sh

fail() { cat "$work/log"; echo "$1"; exit 1; }

# Analyses of one dome that take seconds: the friction of the first two is far below the critical value.
"$bin/cupola-generate" cases/dome_circular.yaml --output "$work/assembly.vtu" > "$work/log" 2>&1 || fail "no assembly"
static="--set joints.friction=0.03"
coulomb="--set joints.friction=0.085 --set analysis.friction_law=coulomb"
limit="--set analysis.type=limit --set analysis.limit.parameter=friction --set analysis.limit.low=0.07 \
  --set analysis.limit.high=0.12"
range="--set analysis.type=range --set analysis.range.quantities=[thrust]"
dynamic="--set analysis.type=dynamic --set analysis.duration=0.4 --set analysis.time_step=0.02 --set joints.friction=0.06"
staged="--set analysis.type=staged --set analysis.staged.first_ring=30 --set analysis.staged.least=friction --set analysis.staged.relative_width=0.1"
path="--set analysis.type=path --set analysis.path.steps=10 --set analysis.path.control.block=40
  --set loads.dead_load_time.type=ramp --set loads.dead_load_time.duration=1"
runs="static coulomb limit range dynamic staged path"

solve() { # NAME SETTINGS
  exec "$bin/cupola-solve" cases/dome_circular.yaml --assembly "$work/assembly.vtu" --output "$work/$1" $2
}

RANDOM=1; interrupted=0; completed=0; slowest=0
while [ $interrupted -lt "$signals" ]; do
  for name in $runs; do
    moment=$RANDOM; signal=TERM; [ $((RANDOM % 2)) -eq 0 ] && signal=INT
    (solve $name "${!name}") > "$work/log" 2>&1 &
    run=$!
    sleep "$(awk -v r=$moment 'BEGIN {print 0.1 + 4 * r / 32768}')"
    sent=$(date +%s%N)
    kill -s $signal $run 2> "$work/kill"
    wait $run; code=$?
    took=$(( ($(date +%s%N) - sent) / 1000000 ))
    if [ $code -eq 4 ]; then
      interrupted=$((interrupted + 1)); [ $took -gt $slowest ] && slowest=$took
      [ $took -le 2000 ] || fail "$name: ended $took ms after SIG$signal"
      [ -e "$work/$name/interrupted.json" ] || grep -q "before the analysis" "$work/log" || fail "$name: no interrupted.json"
      [ ! -e "$work/$name/summary.json" ] || fail "$name: a summary of an interrupted run"
    elif [ $code -eq 0 ] || [ $code -eq 3 ]; then
      completed=$((completed + 1))
      [ ! -e "$work/$name/interrupted.json" ] || fail "$name: interrupted.json beside a summary"
    else fail "$name: exit code $code after SIG$signal"; fi
  done
done
for name in $runs; do
  (solve $name "${!name}") > "$work/log" 2>&1 || fail "$name: does not complete after interruptions"
done
echo "$interrupted runs interrupted, each within $slowest ms; $completed had ended; all complete when started again"
