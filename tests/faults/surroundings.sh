#!/bin/bash
# External faults: too little memory, a folder without write permission, an input that is missing, empty or truncated.
# Each run must either give the answer of an undisturbed run, or exit with the right code (1 for the system, 2 for the
# input) and print one line that names the path (or memory). Existing files must stay unchanged, and the same command
# must succeed afterwards.
#
#   surroundings.sh BIN_FOLDER [memory limits per program, default 10]
set -u
bin=$(realpath "$1"); limits=${2:-10}
. "$(dirname "$0")/common.sh"
ulimit -c 0
faults=0; defects=0
good=$work/good; run=$work/run; mkdir "$good"
generate "$good" && solve "$good" && post "$good" || exit 1
contents "$good" > "$work/good.txt"

defect() { defects=$((defects + 1)); echo "DEFECT: $stage, $what: $1"; }
prepare() { chmod -R u+w "$run" 2> /dev/null; rm -rf "$run"; cp -r "$good" "$run"; faults=$((faults + 1)); }
# Figures that lack of memory leaves out are warnings; all tables are there.
tables_unchanged() { diff <(grep '\.csv ' "$work/good.txt") <(contents "$run" | grep '\.csv ') > /dev/null; }
unchanged() { contents "$run" | cmp -s - "$work/good.txt"; }
# check CODE PHRASE: checks how the stage ended and that it changed nothing.
check() {
  if [ "$code" -eq 0 ] && grep -q 'was not drawn: .*memory' "$work/err"; then
    tables_unchanged || defect "tables differ without a figure"
  elif [ "$code" -eq 0 ]; then unchanged || defect "succeeded with a different answer"
  elif [ "$code" -ne "$1" ]; then defect "exit code $code, expected $1: $(head -c 300 "$work/err")"
  elif [ "$(wc -l < "$work/err")" -ne 1 ] || ! grep -qE "$2" "$work/err"; then
    defect "expected one line with '$2': $(head -c 300 "$work/err")"; fi
}

# --- memory: equal steps of address space, from the minimum that starts the program to what it needs
# The limit on CPU seconds ends a run that hangs.
needs() { # kB; the smallest multiple of 8 MB with which "$@" succeeds
  local low=0 high=512 middle
  while [ $((high - low)) -gt 1 ]; do
    middle=$(((low + high) / 2))
    if (ulimit -v $((middle * 8192)); ulimit -t 5; "$@") > /dev/null 2>&1; then high=$middle; else low=$middle; fi
  done
  echo $((high * 8192))
}
program_of() { case $1 in generate) echo cupola-generate;; solve) echo cupola-solve;; post) echo cupola-post;; esac; }
for stage in generate solve post; do
  prepare; starts=$(needs "$bin/$(program_of $stage)" --version); enough=$(needs $stage "$run")
  echo "$stage: starts with $((starts / 1024)) MB of address space, needs $((enough / 1024)) MB"
  for i in $(seq 0 $((limits - 1))); do
    limit=$((starts + (enough - starts) * i / limits)); what="$((limit / 1024)) MB"
    prepare
    (ulimit -v $limit; ulimit -t 20; $stage "$run") > /dev/null 2> "$work/err"; code=$?
    check 1 'memory|Cannot allocate'
    $stage "$run" > /dev/null 2> "$work/err" && unchanged || defect "fails when run again: $(cat "$work/err")"
  done
done

# --- a folder without write permission; root may write anywhere, so the tests then run as nobody
as_user() { if [ "$(id -u)" -eq 0 ]; then setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; else "$@"; fi; }
export bin case_file; export -f generate solve post
chmod a+rx "$work"
for stage in generate solve post; do
  for state in present absent; do
    what="read-only folder, output $state"
    prepare
    case $stage in generate) output=assembly.vtu;; solve) output=results;; post) output=post;; esac
    [ $state = present ] || rm -rf "${run:?}/$output"
    chmod -R a-w,a+rX "$run" "$case_file"
    as_user bash -c "$stage '$run'" > /dev/null 2> "$work/err"; code=$?
    [ $code -ne 0 ] || defect "wrote into a read-only folder"
    check 1 "$run"
    chmod -R u+w "$run"
    $stage "$run" > /dev/null 2>&1 && unchanged || defect "fails when run again"
  done
done

# --- inputs that are missing, empty or truncated to half
for stage in solve post; do
  inputs=assembly.vtu
  [ $stage = solve ] || inputs="assembly.vtu $(cd "$good" && find results -type f | sort)"
  for input in $inputs; do
    for state in gone empty cut; do
      what="$input $state"
      prepare
      case $state in
        gone) rm "$run/$input";;
        empty) : > "$run/$input";;
        cut) truncate -s $(($(stat -c %s "$run/$input") / 2)) "$run/$input";; esac
      cp "$run/$input" "$work/damaged" 2> /dev/null
      $stage "$run" > /dev/null 2> "$work/err"; code=$?
      # A program need not notice a fault in a file that it does not read, but its answer must then be right.
      if [ $code -eq 0 ]; then
        diff <(grep -v "^./$input " "$work/good.txt") <(contents "$run" | grep -v "^./$input ") > /dev/null ||
          defect "succeeded with a different answer"
      else check 2 "$input|results"; fi
    done
  done
done
echo "$faults faults, $defects defects"
[ $defects -eq 0 ]
