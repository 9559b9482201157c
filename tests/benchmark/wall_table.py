#!/usr/bin/env python3
"""Tabulates the shear walls of Eindhoven beside their tests and draws their forces and cracks. A script, not a table of a study: it
interpolates paths and draws a picture.

  wall_table.py OUT ...      reads OUT/WALL/ and OUT/WALL_solid/ of the walls below, and three more runs of J4D

The largest forces of the tests are second-hand: P. B. Lourenco (1996), Computational strategies for masonry structures, digitised.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys

WALLS = [("wall_j4d", "J4D", 0.30, 57), ("wall_j4d", "J5D", 0.30, 50), ("wall_j6d", "J6D", 1.21, 72), ("wall_j7d", "J7D", 2.12, 97)]
OPEN, SLID = 5e-5, 1e-4  # m: what counts as open or slid


def path(run):
    rows = list(csv.DictReader((run / "results/path.csv").open()))
    return [(1e3 * float(r["displacement_m"]), 1e-3 * float(r["force_N"])) for r in rows]


def force_at(curve, mm):
    (x0, f0), (x1, f1) = next(pair for pair in zip(curve, curve[1:]) if pair[1][0] >= mm - 1e-6)
    return f0 + (f1 - f0) * (mm - x0) / (x1 - x0)


def split(row):
    a, b = row["block_a_name"], row["block_b_name"]
    return "#" in a and a.split("#")[0] == b.split("#")[0]


def joints(run):
    return [r for r in csv.DictReader((run / "post/joints.csv").open())]


def boxes():
    """name: (x0, x1, z0, z1) of the blocks, m."""
    corners, name = {}, ""
    for line in pathlib.Path("cases/wall_j4d.obj").read_text().splitlines():
        words = line.split()
        if line.startswith("o "):
            name = line[2:].strip()
            corners[name] = []
        elif line.startswith("v "):
            corners[name].append((float(words[1]), float(words[3])))
    return {n: (min(x for x, _ in c), max(x for x, _ in c), min(z for _, z in c), max(z for _, z in c)) for n, c in corners.items()}


def crack_lines(run):
    """x, z of both ends, whether it opens, width."""
    blocks, lines = boxes(), []
    for r in joints(run):
        opening, slip = float(r["opening_m"]), float(r["slip_m"])
        if opening < OPEN and slip < SLID:
            continue
        a, b = blocks[r["block_a_name"]], blocks[r["block_b_name"]]
        common = (max(a[0], b[0]), max(a[2], b[2]), min(a[1], b[1]), min(a[3], b[3]))
        lines.append((*common, opening >= OPEN, min(6.0, 1 + 4e3 * max(opening, slip))))
    return lines


def cells(run, label, bricks, pressure, test):
    curve = path(run)
    at, largest = max(curve, key=lambda p: p[1])
    post = json.loads((run / "post/summary.json").read_text())
    broken = sum(split(r) and float(r["opening_m"]) > OPEN for r in joints(run)) if "split" in bricks else ""
    cracks = sum(math.hypot(x1 - x0, z1 - z0) for x0, z0, x1, z1, opens, _ in crack_lines(run) if opens)
    forces = [f"{force_at(curve, mm):.1f}" if curve[-1][0] >= mm - 1e-6 else "" for mm in (0.5, 1, 2, 3, 4)]
    return [label, bricks, f"{pressure:.2f}", *forces, f"{largest:.1f}", f"{at:.2f}", f"{test}", f"{largest / test:.2f}", str(broken),
            f"{cracks:.2f}", f"{1e3 * post['widest_crack_m']:.2f}"]


out, picture = pathlib.Path(sys.argv[1]), "docs/pictures/shear_walls.png"
print("wall,bricks,pressure MPa,0.5 mm,1 mm,2 mm,3 mm,4 mm,largest kN,at mm,test kN,over test,split bricks,cracks m,widest mm")
for suffix, bricks in (("", "can split"), ("_solid", "solid")):
    for run, label, pressure, test in WALLS:
        print(",".join(cells(out / (run + suffix), label, bricks, pressure, test)))
for name, change in (("fine", "can split; 41 points per joint"), ("elastic", "can split; elastic")):
    print(",".join(cells(out / f"wall_j4d_{name}", "J4D", change, 0.30, 57)))
force = json.loads((out / "wall_j4d_force/results/summary.json").read_text())["critical_value"]
print(f"J4D dry; constant vertical force,cannot split,0.30,,,,,,{force:.2f},,22.28 (closed form),{force / 22.275:.3f},,,")

drawn = [w for w in WALLS if w[1] != "J5D"]
script = [f"""set terminal pngcairo size 1200,860 font 'Helvetica,11' background 'white' noenhanced
set output '{picture}'
set multiplot
set size 1/3.,0.44
set grid
set xlabel 'displacement, mm'
set xrange [0:4]
set yrange [0:200]
set key top left"""]
for i, (run, label, pressure, test) in enumerate(drawn):
    for name, folder in (("a", run), ("b", run + "_solid")):
        script.append(f"${name}{i} << EOD\n" + "".join(f"{x} {f}\n" for x, f in path(out / folder)) + "EOD")
    script.append(f"""set origin {i}/3.,0.56
set title '{"J4D, J5D" if i == 0 else label}, {pressure:.2f} MPa'
set ylabel {"'horizontal force, kN'" if i == 0 else "''"}
plot {test} w l lw 2 dt 2 lc rgb '#666666' title 'largest of the test', {"50 w l lw 2 dt 2 lc rgb '#666666' notitle, " if i == 0 else ""}$b{i} w l lw 2 lc rgb '#56B4E9' title 'solid bricks', \\
  $a{i} w l lw 2 lc rgb '#D55E00' title 'bricks that can split'""")
script.append("unset xlabel; unset ylabel; unset tics; unset grid; unset key; set size ratio -1; set size 1/3.,0.54\n"
              "set xrange [-0.08:1.07]; set yrange [-0.08:1.08]")
for i, (run, label, _, _) in enumerate(drawn):
    script.append(f"set origin {i}/3.,0.0\nset title '{label} at 4 mm: joints that opened (red) or slid (blue)'\nunset arrow")
    for x0, x1, z0, z1 in (box for name, box in boxes().items() if name not in ("floor", "beam")):
        for line in ((x0, z0, x1, z0), (x0, z1, x1, z1), (x0, z0, x0, z1), (x1, z0, x1, z1)):
            script.append("set arrow from {},{} to {},{} nohead lc rgb '#dddddd'".format(*line))
    for x0, z0, x1, z1, opens, width in crack_lines(out / run):
        colour = "#D55E00" if opens else "#0072B2"
        script.append(f"set arrow from {x0},{z0} to {x1},{z1} nohead lw {width:.1f} lc rgb '{colour}'")
    script.append("plot NaN")
subprocess.run(["gnuplot"], check=True, text=True, input="\n".join(script))
