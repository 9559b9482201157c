#!/bin/sh
# double_symbols.sh LIBRARY ...: lists the functions and variables that two of the static libraries define, and fails if there are
# any. The linker reports a double only where it needs both.
doubles=$(for library in "$@"; do nm --defined-only "$library" | awk '$2 ~ /[TDBR]/ {print $3}' | sort -u; done | sort | uniq -d | c++filt)
[ -z "$doubles" ] || { echo "defined in two libraries:"; echo "$doubles"; exit 1; }
