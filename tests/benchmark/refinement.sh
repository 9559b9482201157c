#!/bin/bash
# Compares the bed-joint wrench of a macro-block with the sum over the bricks that replace it, for increasing
# bond.refine: circular dome, compliance per area. Writes refinement.csv and refinement.png.
#
#   tests/benchmark/refinement.sh build/bin out/refinement [1 2 4 8]
set -euo pipefail
bin=$1 out=$2
shift 2
here=$(dirname "$0")
case=$here/../../cases/dome_circular.yaml
mkdir -p "$out"
[ $# -gt 0 ] || set -- 1 2 4 8
for n in "$@"; do
  [ -f "$out/$n/post/joints.csv" ] && continue
  mkdir -p "$out/$n"
  options=(--quiet --set geometry.bond.refine="$n" --set geometry.bond.slices_per_block=2
    --set joints.compliance.per=area --set joints.compliance.normal=1e-9 --set joints.compliance.tangential=1e-9)
  "$bin/cupola-generate" "$case" "${options[@]}" --output "$out/$n/assembly.vtu"
  "$bin/cupola-solve" "$case" "${options[@]}" --assembly "$out/$n/assembly.vtu" --output "$out/$n/results"
  "$bin/cupola-post" analyse "$case" "${options[@]}" --assembly "$out/$n/assembly.vtu" \
    --results "$out/$n/results" --output "$out/$n/post" --tables
  rm "$out/$n/assembly.vtu"
  find "$out/$n/results" -type f ! -name summary.json -delete # which names the revision
done
python3 "$here/refinement.py" "$out" "$@" | tee "$out/refinement.csv"
gnuplot -e "folder='$out'" "$here/refinement.gp"
