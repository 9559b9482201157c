#!/bin/bash
# Lets each call by which a program changes a file fail in turn (full disk, input/output error, no
# permission) or be its last (kill -9), and checks what the project promises:
#   1. the program ends with code 1 and one line that names a path (kill: by the signal);
#   2. every file is the whole old one or the whole new one (one that grows with the frames: a whole shorter one),
#      and the next program takes a whole set or refuses;
#   3. the same command again gives the same bytes as if nothing had happened; a motion goes on from the last
#      frame but one at the worst, so that no fault costs the checkpoint before it.
#
#   campaign.sh BIN_FOLDER SHIM.so [faults per program and kind, spread evenly; default: at every call]
set -u
bin=$(realpath "$1"); shim=$(realpath "$2"); most=${3:-1000000}
. "$(dirname "$0")/common.sh"
faults=0; defects=0

# Rewritten with every frame; a checkpoint carries its own checksum, and the second run resumes from it.
growing='^\./results/(blocks\.pvd|contacts\.pvd|history\.csv|checkpoint) '
growing_files_are_whole() {
  local file text
  for file in blocks.pvd contacts.pvd; do
    [ ! -e "$run/results/$file" ] || [ "$(tail -n 1 "$run/results/$file")" = "</VTKFile>" ] || return 1; done
  [ ! -e "$run/results/history.csv" ] && return 0
  text=$(cat "$run/results/history.csv")
  [[ "$(cat "$work/new/results/history.csv")" == "$text"* || "$(cat "$work/old/results/history.csv")" == "$text"* ]]
}
# Whether the resumed run, whose words are in the file, went on from the last frame that lay there or the one before.
goes_on() {
  local lay=$1 from
  from=$(sed -n 's/^resuming after frame \([0-9]*\) .*/\1/p' "$2")
  [ "${from:-0}" -ge $((lay - 1)) ]
}
frames_of_new_run() { # those that the faulted run wrote itself
  cmp -s "$run/results/blocks.pvd" "$start/results/blocks.pvd" && echo 0 && return
  grep -c '<DataSet' "$run/results/blocks.pvd" 2> /dev/null
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
      contents "$run" | grep -vxF -f "$work/old.txt" | grep -vxF -f "$work/new.txt" | grep -vE "$growing" > "$work/strange" &&
        defect "neither old nor new: $(cut -d' ' -f1 "$work/strange" | tr '\n' ' ')"
      growing_files_are_whole || defect "a growing file is not whole"
      # A later stage must not take a mixture: what it accepts gives the new answer.
      if [ $stage = solve ] && post "$run" > /dev/null 2>&1; then
        contents "$run/post" | cmp -s - <(contents "$work/new/post") || defect "cupola-post accepted a mixture"; fi
      again=; frames=0; [ $stage = solve ] && again=--resume && frames=$(frames_of_new_run)
      quiet=; $stage "$run" $again > "$work/said" 2> "$work/err" || defect "does not run again: $(cat "$work/err")"; unset quiet
      goes_on "$frames" "$work/said" || defect "$frames frames lay there: $(head -n 1 "$work/said")"
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
