#!/bin/bash
# Lets each call by which a program changes a file fail in turn (full disk, input/output error, no
# permission) or be its last (kill -9), and checks what the project promises:
#   1. the program ends with code 1 and one line that names a path (kill: by the signal);
#   2. every file is the whole old one or the whole new one, and the next program takes a whole set or refuses;
#   3. the same command again gives the same bytes as if nothing had happened.
#
#   campaign.sh BIN_FOLDER SHIM.so [faults per program and kind, spread evenly; default: at every call]
set -u
bin=$(realpath "$1"); shim=$(realpath "$2"); most=${3:-1000000}
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
case_file=$work/small.yaml; cp "$here/small.yaml" "$case_file"
faults=0; defects=0

generate() { "$bin/cupola-generate" "$case_file" --quiet --output "$1/assembly.vtu" "${@:2}"; }
solve() { "$bin/cupola-solve" "$case_file" --quiet --assembly "$1/assembly.vtu" --output "$1/results" "${@:2}"; }
post() { "$bin/cupola-post" analyse "$case_file" --quiet --assembly "$1/assembly.vtu" --results "$1/results" --output "$1/post" "${@:2}"; }

# One line per file: name and checksum, without wall times and memory, which no two runs share.
contents() {
  (cd "$1" && find . -type f ! -name '*.part*' | sort | while read -r file; do
    echo "$file $(sed -E '/wall_time|solve_time|peak_memory/d' "$file" | md5sum | cut -c1-32)"; done)
}
defect() { defects=$((defects + 1)); echo "DEFECT: $stage, $kind at call $at: $1"; }

# The whole pipeline as it was (old: other friction, other length) and as it must become (new).
mkdir "$work/old" "$work/new"
generate "$work/old" --set geometry.surface.length=3 && solve "$work/old" --set geometry.surface.length=3 &&
  post "$work/old" --set geometry.surface.length=3 && generate "$work/new" && solve "$work/new" && post "$work/new" || exit 1
contents "$work/old" > "$work/old.txt"; contents "$work/new" > "$work/new.txt"

for stage in generate solve post; do
  # What the stage finds: the earlier stages are new, its own output and the later ones are old.
  start=$work/start; rm -rf "$start"; cp -r "$work/old" "$start"
  [ $stage = generate ] || cp "$work/new/assembly.vtu" "$start/"
  [ $stage = post ] && { rm -rf "$start/results"; cp -r "$work/new/results" "$start/"; }
  run=$work/run; rm -rf "$run"; cp -r "$start" "$run"
  ( export LD_PRELOAD=$shim FAULT_FOLDER=$run FAULT_COUNT=$work/count; $stage "$run" )
  calls=$(cat "$work/count")
  echo "$stage: $calls calls change files"
  stride=$(( calls > most ? (calls + most - 1) / most : 1 ))
  for kind in ENOSPC EIO EACCES KILL; do
    for at in $(seq 1 "$stride" "$calls"); do
      rm -rf "$run"; cp -r "$start" "$run"; faults=$((faults + 1))
      ( export LD_PRELOAD=$shim FAULT_FOLDER=$run FAULT_AT=$at FAULT_KIND=$kind; $stage "$run" ) > /dev/null 2> "$work/err"
      code=$?
      if [ $kind = KILL ]; then [ $code -eq 137 ] || defect "exit code $code, not 137"
      elif [ $code -ne 1 ]; then defect "exit code $code, not 1: $(cat "$work/err")"
      elif [ "$(wc -l < "$work/err")" -ne 1 ] || ! grep -q "$run" "$work/err"; then
        defect "not one line with a path: $(cat "$work/err")"; fi
      contents "$run" | grep -vxF -f "$work/old.txt" | grep -vxF -f "$work/new.txt" > "$work/strange" &&
        defect "neither old nor new: $(cut -d' ' -f1 "$work/strange" | tr '\n' ' ')"
      # A later stage must not take a mixture: what it accepts gives the new answer.
      if [ $stage = solve ] && post "$run" > /dev/null 2>&1; then
        contents "$run/post" | cmp -s - <(contents "$work/new/post") || defect "cupola-post accepted a mixture"; fi
      again=; [ $stage = solve ] && again=--resume
      $stage "$run" $again > /dev/null 2> "$work/err" || defect "does not run again: $(cat "$work/err")"
      for part in assembly.vtu results post; do
        case $stage$part in generateresults|generatepost|solvepost) continue;; esac
        [ -e "$run/$part" ] && ! diff -q <(cd "$run"; contents . | grep "^./$part") <(grep "^./$part" "$work/new.txt") > /dev/null &&
          defect "$part differs after the second run"
      done
    done
  done
done
echo "$faults faults injected, $defects defects"
[ "$defects" -eq 0 ]
