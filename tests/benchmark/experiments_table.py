#!/usr/bin/env python3
"""Tabulates predictions of tests on dry or cracked masonry, with their range over what was not measured, beside the measured values of
experiments.csv. A script, not a table of a study: it interpolates paths and takes the range of a quantity over several runs.

  experiments_table.py OUT RUN ...      reads OUT/wall_griffith_*/results and OUT/experiments/*/results

The measured values are those that the public repositories named in docs/experiments.md give: of Griffith et al. digitised there to five
digits, of the dry walls the largest force Vmax,+ of the database.
"""

import csv
import json
import pathlib
import sys

OUT = pathlib.Path(sys.argv[1])
THICKNESS = 0.11  # m, of the wall of Griffith et al.
AT = (0.0303, 0.0752, 0.189, 0.271, 0.362, 0.551)  # displacement at mid-height over thickness
BEAMS = {"sandstone": 800, "granite": 1000}  # N, weight of the beam
PRESSED = {"sandstone": {30: "SW.30", 100: "SW.100", 200: "SW.200", 250: "SW.250"},
           "granite": {40: "WS.40", 100: "WS.100", 175: "WS.175", 250: "WS.250"}}  # kN


def path(run):
    """(displacement at mid-height over thickness, load over weight) of each equilibrium."""
    rows = csv.DictReader((OUT / run / "results/path.csv").open())
    return [(0.0, 0.0)] + [(2 * float(r["displacement_m"]) / THICKNESS, float(r["time_s"])) for r in rows]


def at(points, x):
    for (x0, f0), (x1, f1) in zip(points, points[1:]):
        if x0 < x <= x1:
            return f0 + (f1 - f0) * (x - x0) / (x1 - x0)
    sys.exit(f"the path ends before d/t = {x}")


def limit(run):
    return json.loads((OUT / run / "results/summary.json").read_text())["critical_value"]


def predictions():
    """(test, quantity, values): the first value is the prediction, all of them its range."""
    curves = [path(f"wall_griffith_{mortar}") for mortar in ("mortar", "soft", "stiff")]
    yield "Griffith 12", "largest F/W", [max(f for _, f in curve) for curve in curves]
    for x in AT:
        yield "Griffith 12", f"F/W at d/t {x}", [at(curve, x) for curve in curves]
    for stone, walls in PRESSED.items():
        for pressed, name in walls.items():
            weight = 1000 * pressed - BEAMS[stone]
            yield name, "largest force kN", [limit(f"experiments/wall_dry_{stone}_weight{weight}_friction{friction}")
                                             for friction in ("0.62", "0.5", "0.75")]


def measured():
    """{test: {quantity: [(specimen, value)]}} of experiments.csv."""
    values = {}
    for r in csv.DictReader(pathlib.Path(__file__).with_name("experiments.csv").open()):
        values.setdefault(r["test"], {}).setdefault(r["quantity"], []).append((r["specimen"], float(r["measured"])))
    return values


def disagreement(row):
    """Share by which the measured value lies outside the range, the largest first; 0 inside."""
    _, _, _, least, greatest, value = row
    return -max(least / value, value / greatest, 1.0)


rows, tests = [], measured()
for test, quantity, values in predictions():
    for specimen, value in tests[test][quantity]:
        rows.append((test if specimen in test else specimen, quantity, values[0], min(values), max(values), value))
print("test,quantity,prediction,least,greatest,measured,measured over prediction,in the range")
for row in sorted(rows, key=disagreement):
    test, quantity, prediction, least, greatest, value = row
    print(f"{test},{quantity},{prediction:.4g},{least:.4g},{greatest:.4g},{value:.4g},{value / prediction:.3f},"
          f"{'yes' if disagreement(row) == -1.0 else 'no'}")
