#!/bin/bash
# The tests of seconds in a build with sanitizers, one process per folder: such a program takes long to start.
#
#   sanitized_tests.sh BUILD_FOLDER [FOLDER OF TESTS ...]
set -u
build=$(realpath "$1"); shift; failed=0
# Leaks of the libraries' singletons are theirs to mend. The libraries' own threads are not what is looked at, and
# OpenMP's meet in ways that a sanitizer which has not seen them compiled takes for none; ours are set by the tests.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 TSAN_OPTIONS=halt_on_error=1
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
folders=("$@"); [ $# -gt 0 ] || folders=(assembly generators solver postproc pipeline extremes)
for folder in "${folders[@]}"; do
  echo "$folder:"
  "$build/bin/test_$folder" --gtest_filter='-*Slow*' --gtest_brief=1 || failed=1
done
# What is no GoogleTest: the readers under random edits, invalid input.
[ $# -gt 0 ] || ctest --test-dir "$build" --output-on-failure -LE slow -R '^(fuzz|invalid_input)/' --timeout 1200 || failed=1
exit $failed
