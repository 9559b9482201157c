#!/usr/bin/env python3
"""Draws the outward thrust of force states of one model inside its range over all admissible states. A script, not a table of a study:
it compares each run with another.

  thrust_states.py OUT RANGE_RUN STATE_RUN ...

Fails if a state lies outside. Runs with contact points of their own, perturbed or opened, are drawn as circles: their range
is another one.
"""

import json
import pathlib
import re
import subprocess
import sys

OTHER_POINTS = ("gjk", "gap", "area")
LABELS = {"": "as in the case", "coulomb": "Coulomb's law", "at_once": "weight at once", "ramped": "weight over 2 s",
          "per_area_soft": "per area, soft", "per_area_stiff": "per area, stiff", "area": "per area", "gap1": "gaps of up to 0.2 mm"}
SLACK = 1e-6  # of the weight: the gap of the range and the residual of a static state


def label(name):
    name = re.sub(r"^gjk(\d*)$", lambda seed: f"perturbed GJK, seed {seed[1] or 1}", name)
    return LABELS.get(name, name.replace("_", " "))


def weight_and_summary(folder):
    summary = json.loads((folder / "results/summary.json").read_text())
    return summary["weight_N"], summary


range_run, *folders = (pathlib.Path(sys.argv[1]) / name for name in sys.argv[2:])
picture = "docs/pictures/thrust_states.png"
weight, summary = weight_and_summary(range_run)
thrust = next(r for r in summary["ranges"] if r["quantity"].startswith("thrust"))
low, high = (thrust[end]["value"] / weight for end in ("min", "max"))
same, other, outside = [], [], []
for folder in folders:
    post = json.loads((folder / "post/summary.json").read_text())
    value = post["thrust_over_weight"]
    if value is None:
        sys.exit(f"{folder}: not at rest")
    name = folder.name.removeprefix("dome_circular").removeprefix("_state").removeprefix("_")
    (other if any(word in name for word in OTHER_POINTS) else same).append((label(name), value))
    if not low - SLACK <= value <= high + SLACK:
        outside.append(f"{folder.name}: {value:.6f} outside {low:.6f} ... {high:.6f}")
rows = same + other
tics = ", ".join(f'"{name}" {i}' for i, (name, _) in enumerate(rows))
points = "".join(f"{value} {i} {int(i >= len(same))}\n" for i, (_, value) in enumerate(rows))
subprocess.run(["gnuplot"], check=True, text=True, input=f"""
set terminal pngcairo size 900,{120 + 20 * len(rows)} font 'Helvetica,11' background 'white' noenhanced
set output '{picture}'
$points << EOD
{points}EOD
set ytics ({tics})
set yrange [{len(rows)}:-1]
set xrange [{low - 0.03}:{high + 0.03}]
set xlabel 'outward thrust over the weight'
set grid x
set key at screen 0.5,0.985 center top horizontal maxrows 1
set tmargin 3
set object rectangle from {low},graph 0 to {high},graph 1 fc rgb '#56B4E9' fs solid 0.25 noborder behind
plot 1/0 w boxes lc rgb '#56B4E9' fs solid 0.25 title 'all admissible states', \\
  $points using ($3 == 0 ? $1 : 1/0):2 w p pt 7 ps 1.2 lc rgb '#D55E00' title 'states found', \\
  $points using ($3 == 1 ? $1 : 1/0):2 w p pt 6 lw 2 ps 1.2 lc rgb '#D55E00' title 'with contact points of their own'
""")
print(f"{len(rows)} states between {min(v for _, v in rows):.4f} and {max(v for _, v in rows):.4f}; "
      f"range {low:.4f} ... {high:.4f}")
if outside:
    sys.exit("\n".join(outside))
