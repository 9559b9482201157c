#!/bin/bash
# Gives `cupola-generate CASE --check` bad case files: random edits of the project's own. Each must end with code 0
# or 2 and, when refused, one line that names the file, within 10 s and 1 GB (of address space, which is more than
# memory).
#
#   check_cases.sh BIN_FOLDER FILES
set -u
bin=$(realpath "$1"); files=$2
cd "$(dirname "$0")/../.." || exit 1
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
cp cases/*.yaml "$work"; cp -n tests/invalid_input/*.yaml "$work"  # edited cases may still extend them
"$bin/fuzz_case" --edits "$files" --seed 3 --write "$work/edited_" cases/*.yaml tests/invalid_input/*.yaml || exit 1
cd "$work" || exit 1
ulimit -v 1048576; ulimit -c 0
accepted=0; refused=0; defects=0; longest=0
for file in edited_*.yaml; do
  start=$(date +%s%N)
  timeout -s KILL 10 "$bin/cupola-generate" "$file" --check > out 2> err < /dev/null
  code=$?
  milliseconds=$((($(date +%s%N) - start) / 1000000))
  [ $milliseconds -le $longest ] || longest=$milliseconds
  if [ $code -eq 0 ]; then accepted=$((accepted + 1))
  elif [ $code -eq 2 ] && [ "$(wc -l < err)" -eq 1 ] && grep -qa "yaml" err; then refused=$((refused + 1))
  else defects=$((defects + 1)); echo "DEFECT: code $code: $(head -c 300 err)"; cp "$file" "/tmp/cupola_bad_$defects.yaml"
    echo "  kept as /tmp/cupola_bad_$defects.yaml"; fi
done
echo "$files files: $accepted accepted, $refused refused with one line, $defects defects; slowest $longest ms"
[ $defects -eq 0 ] && [ $((accepted + refused)) -eq "$files" ]
