#!/bin/bash
# Runs every libFuzzer program for a given CPU time and prints one line for each. Inputs that it keeps go to
# BUILD_FOLDER/corpus, inputs that crash a reader to BUILD_FOLDER/corpus/NAME/crash-*.
#
#   search.sh BUILD_FOLDER CPU_SECONDS_EACH [NAME ...]
set -u
cd "$(dirname "$0")/../.." || exit 1
source=$PWD; build=$(realpath "$1"); seconds=$2; shift 2; failed=0
# Uses all lines of a log: on a busy machine a search takes several rounds.
total() { awk -v key="$1" -v how="$2" '$1 ~ key {x = how == "sum" ? x + $2 : ($2 > x ? $2 : x)} END {print x + 0}' "$log"; }
# VTK's singletons leak by design. Undefined behaviour ends a search, as a bad address does.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
TIMEFORMAT='%U %S'; spent=0; inputs=0
for fuzzer in "$build"/bin/fuzz_*; do
  name=$(basename "$fuzzer" | sed 's/^fuzz_//')
  [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
  seeds=$source/tests/fuzz/seeds/$name
  [ -d "$seeds" ] || seeds= # some readers have no seeds
  [ "$name" != case ] || seeds="$source/cases $source/tests/invalid_input"
  mkdir -p "$build/corpus/$name"; log=$build/corpus/$name.log; : > "$log"; cpu=0; code=0
  while [ $code -eq 0 ] && [ "$cpu" -lt $((1000 * seconds)) ]; do
    # -timeout and -rss_limit_mb are the limits that the project promises.
    used=$( { time (cd "$build/corpus/$name" && "$fuzzer" . $seeds \
      -max_total_time=$((seconds - cpu / 1000 + 1)) -timeout=10 -rss_limit_mb=1024 -max_len=65536 -print_final_stats=1 \
      >> "$log" 2>&1 || echo failed >> "$log"); } 2>&1 | awk '{printf "%d", 1000 * ($1 + $2)}') # ms
    [ "$(tail -n 1 "$log")" != failed ] || code=1
    cpu=$((cpu + used))
  done
  [ $code -eq 0 ] || failed=1
  cpu=$(((cpu + 500) / 1000)); spent=$((spent + cpu)); inputs=$((inputs + $(total executed_units sum)))
  echo "$name: $(total executed_units sum) inputs in $cpu CPU s, slowest $(total slowest_unit max) s," \
    "$(total peak_rss max) MB$([ $code -eq 0 ] || echo "; FAILED, see $log")"
done
echo "$inputs inputs in $spent CPU s, $([ $failed -eq 0 ] && echo no defects || echo DEFECTS) found"
exit $failed
