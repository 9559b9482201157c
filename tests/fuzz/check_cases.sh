#!/bin/bash
# Runs `cupola-generate CASE --check` on bad case files: random edits of the project's own cases. Each run must exit
# with code 0 or 2, print one line that names the file if refused, and stay within 10 s and 1 GB of address space
# (which exceeds resident memory).
#
#   check_cases.sh BIN_FOLDER FILES [JOBS, default 2]
set -u
bin=$(realpath "$1"); files=$2; jobs=${3:-2}
cd "$(dirname "$0")/../.." || exit 1
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
cp cases/*.yaml "$work"; cp -n tests/invalid_input/*.yaml "$work"  # which edited cases may extend
"$bin/fuzz_case" --edits "$files" --seed 3 --write "$work/edited_" cases/*.yaml tests/invalid_input/*.yaml || exit 1
cd "$work" || exit 1
ulimit -v 1048576; ulimit -c 0
export LC_ALL=C

# check_every NTH: checks files NTH, NTH + jobs, ...; writes "accepted refused defects slowest" to tally_NTH.
check_every() {
  local accepted=0 refused=0 defects=0 slowest=0 i file start code milliseconds lines
  for ((i = $1; i < files; i += jobs)); do
    file=edited_$i.yaml; start=${EPOCHREALTIME/./}
    timeout -s KILL 10 "$bin/cupola-generate" "$file" --check > "out_$1" 2> "err_$1" < /dev/null
    code=$?
    milliseconds=$(((${EPOCHREALTIME/./} - start) / 1000))
    [ $milliseconds -le $slowest ] || slowest=$milliseconds
    mapfile -t lines < "err_$1"
    if [ $code -eq 0 ]; then accepted=$((accepted + 1))
    elif [ $code -eq 2 ] && [ ${#lines[@]} -eq 1 ] && [[ ${lines[0]} == *.yaml* ]]; then refused=$((refused + 1))
    else
      defects=$((defects + 1)); cp "$file" "/tmp/cupola_bad_$i.yaml"
      echo "DEFECT: code $code: $(head -c 300 "err_$1"); kept as /tmp/cupola_bad_$i.yaml"
    fi
    echo "$accepted $refused $defects $slowest" > "tally_$1"
  done
}
for ((job = 0; job < jobs; ++job)); do check_every $job & done
wait
awk -v files="$files" '{a += $1; r += $2; d += $3; if ($4 > s) s = $4}
  END {printf "%d files: %d accepted, %d refused with one line, %d defects; slowest %d ms\n", files, a, r, d, s
       exit d > 0 || a + r != files}' tally_*
