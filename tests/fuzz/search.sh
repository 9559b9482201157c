#!/bin/bash
# Lets every libFuzzer program search for some seconds and prints one line each; the inputs it keeps go to
# BUILD_FOLDER/corpus, a reader's crash to BUILD_FOLDER/corpus/NAME/crash-*.
#
#   search.sh BUILD_FOLDER SECONDS_EACH
set -u
cd "$(dirname "$0")/../.." || exit 1
source=$PWD; build=$(realpath "$1"); seconds=$2; failed=0
for fuzzer in "$build"/bin/fuzz_*; do
  name=$(basename "$fuzzer" | sed 's/^fuzz_//')
  case $name in
    case) seeds="$source/cases $source/tests/invalid_input";;
    assembly|frame) seeds=$source/tests/fuzz/seeds/noise;;
    *) seeds=$source/tests/fuzz/seeds/$name;;
  esac
  mkdir -p "$build/corpus/$name"; log=$build/corpus/$name.log
  # Leaks of VTK's singletons are not ours to mend. -timeout and -rss_limit_mb are the promises of the project.
  (cd "$build/corpus/$name" && ASAN_OPTIONS=detect_leaks=0 "$fuzzer" . $seeds -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=1024 -max_len=65536 -print_final_stats=1 > "$log" 2>&1)
  code=$?
  [ $code -eq 0 ] || failed=1
  echo "$name: $(awk '/number_of_executed_units/ {n = $2} /peak_rss_mb/ {m = $2} /slowest_unit/ {s = $2} END {
    printf "%d inputs, slowest %d s, %d MB", n, s, m}' "$log")$([ $code -eq 0 ] || echo "; FAILED, see $log")"
done
exit $failed
