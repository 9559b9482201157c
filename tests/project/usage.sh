#!/bin/bash
# A program that measures for minutes does not start when asked for help or given words that it does not know.
#
#   usage.sh BIN_FOLDER
set -u
for program in {contact,detection,feature,generation,integrator,siconos}_benchmark extremes_{search,table,verdicts} \
    verification_table; do
  [ -x "$1/$program" ] || continue
  timeout 5 "$1/$program" --help > /dev/null 2>&1
  [ $? -ne 124 ] || { echo "$program --help: measures"; failed=1; }
  timeout 5 "$1/$program" a b c d > /dev/null 2>&1
  case $? in 0 | 124) echo "$program a b c d: is not refused"; failed=1 ;; esac
done
exit ${failed:-0}
