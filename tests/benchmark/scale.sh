#!/bin/bash
# Time, memory and residual of cupola-solve for the static Brunelleschi model, from macro-blocks to bricks.
# Writes scale.csv and scale.png. Each argument is a value of `bond.refine`; a trailing c solves one of eight
# sectors only. 16 needs 13 GB, 28c (a million blocks) 17 GB.
#
#   tests/benchmark/scale.sh build/bin out/scale [1 3 8 16 8c 16c 28c]
set -euo pipefail
bin=$1 out=$2
shift 2
[ $# -gt 0 ] || set -- 1 3 8 16 8c 16c 28c
here=$(dirname "$0")
case=$here/../../cases/brunelleschi.yaml
mkdir -p "$out"
for n in "$@"; do
  [ -f "$out/$n/summary.json" ] && continue
  options=(--quiet --set geometry.bond.refine="${n%c}" --set analysis.tolerance=1e-6)
  [ "$n" = "${n%c}" ] || options+=(--set analysis.cyclic_sectors=8)
  "$bin/cupola-generate" "$case" "${options[@]}" --output "$out/$n.vtu"
  "$bin/cupola-solve" "$case" "${options[@]}" --assembly "$out/$n.vtu" --output "$out/$n" --threads "$(nproc)"
  rm "$out/$n.vtu" "$out/$n"/*.vtp
done
python3 - "$out" "$@" > "$out/scale.csv" <<'PYTHON'
import json, math, sys

last = None
print("refine,sectors,blocks,contacts,solve_s,cpu_s,GB,equilibrium_residual,time_exponent,memory_exponent")
for n in sys.argv[2:]:
    s = json.load(open(f"{sys.argv[1]}/{n}/summary.json"))
    now = [s["free_blocks"], s["cpu_time_seconds"], s["peak_memory_bytes"]]
    exponents = ["", ""]
    cyclic = n.endswith("c")
    if last and not cyclic:
        exponents = [f"{math.log(now[k] / last[k]) / math.log(now[0] / last[0]):.2f}" for k in (1, 2)]
    print(n.rstrip("c"), 8 if cyclic else 1, s["free_blocks"], s["contacts"], f"{s['solve_time_seconds']:.2f}", f"{now[1]:.2f}",
          f"{now[2] / 1e9:.2f}", f"{s['equilibrium_residual']:.1e}", *exponents, sep=",")
    last = last if cyclic else now
PYTHON
gnuplot -e "folder='$out'" "$here/scale.gp"
column -s, -t "$out/scale.csv"
