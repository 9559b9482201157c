#!/bin/bash
# For every analysis: makes each call with which a program changes a file fail in turn (disk full, input/output error, no permission), or
# kills the program there (kill -9), and checks three promises:
#   1. the program exits with code 1 and prints one line that names a path (kill: it ends by the signal);
#   2. every file is either the complete old one or the complete new one (files that grow with the frames: a complete
#      shorter one), and the next program accepts only a complete set;
#   3. the same command, run again, gives the same bytes as an undisturbed run. Motions, paths and buildings resume at worst
#      from the last frame but one, so that no fault destroys the previous checkpoint.
#
#   campaign.sh BIN_FOLDER SHIM.so [faults per program and kind, spread evenly; default: at every call]
set -u
bin=$(realpath "$1"); shim=$(realpath "$2"); most=${3:-1000000}
. "$(dirname "$0")/common.sh"
faults=0; defects=0

# Rewritten with every frame; a checkpoint carries its own checksum, and the second run resumes from it.
growing_tables="history path stages construction failures"
# The folder in which gnuplot draws belongs to the running program; the next run takes it over and removes it.
growing="^\\./(results/(blocks\\.pvd|contacts\\.pvd|(${growing_tables// /|})\\.csv|checkpoint)|post/figures/\\.drawing/.*) "
growing_files_are_whole() {
  local file text
  for file in blocks.pvd contacts.pvd; do
    [ ! -e "$run/results/$file" ] || [ "$(tail -n 1 "$run/results/$file")" = "</VTKFile>" ] || return 1; done
  for file in $growing_tables; do
    file=results/$file.csv
    [ -e "$run/$file" ] || continue
    text=$(cat "$run/$file")
    [[ "$(cat "$work/new/$file")" == "$text"* || "$(cat "$work/old/$file")" == "$text"* ]] || return 1
  done
}
# resumes FRAMES LOG: true if the resumed run continued from the last of FRAMES existing frames or the one before.
resumes() {
  local existing=$1 from
  [ -e "$work/new/results/checkpoint" ] || return 0 # nothing to resume from
  from=$(sed -n 's/^resuming after frame \([0-9]*\) .*/\1/p' "$2")
  [ "${from:-0}" -ge $((existing - 1)) ]
}
frames_of_new_run() { # frames written by the disturbed run itself
  cmp -s "$run/results/blocks.pvd" "$start/results/blocks.pvd" && echo 0 && return
  grep -c '<DataSet' "$run/results/blocks.pvd" 2> /dev/null
}
defect() { defects=$((defects + 1)); echo "DEFECT: $analysis, $stage, $kind at call $at: $1"; }

for analysis in $analyses; do
write_case $analysis
# Results of the whole pipeline before (old: a different length) and after (new).
rm -rf "$work/old" "$work/new"; mkdir "$work/old" "$work/new"
generate "$work/old" --set geometry.surface.length=3 && solve "$work/old" --set geometry.surface.length=3 &&
  post "$work/old" --set geometry.surface.length=3 && generate "$work/new" && solve "$work/new" && post "$work/new" || exit 1
contents "$work/old" > "$work/old.txt"; contents "$work/new" > "$work/new.txt"

for stage in generate solve post; do
  # Initial state of the stage: the output of earlier stages is new, its own and that of later stages is old.
  start=$work/start; rm -rf "$start"; cp -r "$work/old" "$start"
  [ $stage = generate ] || cp "$work/new/assembly.vtu" "$start/"
  [ $stage = post ] && { rm -rf "$start/results"; cp -r "$work/new/results" "$start/"; }
  run=$work/run; rm -rf "$run"; cp -r "$start" "$run"
  ( export LD_PRELOAD=$shim FAULT_FOLDER=$run FAULT_COUNT=$work/count; $stage "$run" )
  calls=$(cat "$work/count")
  echo "$analysis, $stage: $calls calls change files"
  stride=$(( calls > most ? (calls + most - 1) / most : 1 ))
  for kind in ENOSPC EIO EACCES KILL; do
    for at in $(seq 1 "$stride" "$calls"); do
      rm -rf "$run"; cp -r "$start" "$run"; faults=$((faults + 1))
      ( export LD_PRELOAD=$shim FAULT_FOLDER=$run FAULT_AT=$at FAULT_KIND=$kind; $stage "$run" ) > /dev/null 2> "$work/err"
      code=$?
      if [ $kind = KILL ]; then [ $code -eq 137 ] || defect "exit code $code, expected 137"
      elif [ $code -ne 1 ]; then defect "exit code $code, expected 1: $(cat "$work/err")"
      elif [ "$(wc -l < "$work/err")" -ne 1 ] || ! grep -q "$run" "$work/err"; then
        defect "expected one line with a path: $(cat "$work/err")"; fi
      contents "$run" | grep -vxF -f "$work/old.txt" | grep -vxF -f "$work/new.txt" | grep -vE "$growing" > "$work/strange" &&
        defect "file is neither the old nor the new one: $(cut -d' ' -f1 "$work/strange" | tr '\n' ' ')"
      growing_files_are_whole || defect "a growing file is incomplete"
      # A later stage must refuse a mixture of old and new files: if it accepts them, its answer must be the new one.
      if [ $stage = solve ] && post "$run" > /dev/null 2>&1; then
        contents "$run/post" | cmp -s - <(contents "$work/new/post") || defect "cupola-post accepted a mixture"; fi
      again=; frames=0; [ $stage = solve ] && again=--resume && frames=$(frames_of_new_run)
      quiet=; $stage "$run" $again > "$work/said" 2> "$work/err" || defect "fails when run again: $(cat "$work/err")"; unset quiet
      resumes "$frames" "$work/said" || defect "$frames frames existed, but the run reports: $(head -n 1 "$work/said")"
      for part in assembly.vtu results post; do
        case $stage$part in generateresults|generatepost|solvepost) continue;; esac
        [ -e "$run/$part" ] && ! diff -q <(cd "$run"; contents . | grep "^./$part") <(grep "^./$part" "$work/new.txt") > /dev/null &&
          defect "$part differs after the second run"
      done
    done
  done
done
done
echo "$faults faults injected, $defects defects"
[ "$defects" -eq 0 ]
