#!/bin/bash
# Runs the fast tests in a build with sanitizers, one process per folder because such a program is slow to start.
#
#   sanitized_tests.sh BUILD_FOLDER [FOLDER OF TESTS ...]
set -u
build=$(realpath "$1"); shift; failed=0
# Leak detection is off: singletons of the libraries leak. The libraries run with one thread each, because ThreadSanitizer
# cannot see the synchronisation of an OpenMP runtime that was not compiled with it; the tests set our own threads.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 TSAN_OPTIONS=halt_on_error=1
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
folders=("$@"); [ $# -gt 0 ] || folders=(assembly generators solver postproc pipeline extremes)
for folder in "${folders[@]}"; do
  echo "$folder:"
  "$build/bin/test_$folder" --gtest_filter='-*Slow*' --gtest_brief=1 || failed=1
done
# Tests outside GoogleTest: fuzzing of the readers, invalid input.
[ $# -gt 0 ] || ctest --test-dir "$build" --output-on-failure -LE slow -R '^(fuzz|invalid_input)/' --timeout 1200 || failed=1
exit $failed
