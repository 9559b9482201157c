#!/usr/bin/env python3
"""Prints a CSV table of the ranges of the outward thrust, over the weight, of finished range analyses.

  range_table.py RUN_FOLDER ...
"""

import json
import pathlib
import sys

print("run,friction,lantern,min,chosen,max,margin %,relative gap,CPU s")
for folder in map(pathlib.Path, sys.argv[1:]):
    summary = json.loads((folder / "results/summary.json").read_text())
    keys = {}
    for line in (folder / "results/run.yaml").read_text().splitlines():
        key, _, value = line.strip().partition(": ")
        keys.setdefault(key, value)
    weight = summary["weight_N"]
    thrust = next(r for r in summary["ranges"] if r["quantity"] == "thrust")
    ends = [thrust["min"].get("value"), thrust.get("chosen"), thrust["max"].get("value")]
    cells = ["" if v is None else f"{v / weight:.6f}" for v in ends]
    low, chosen, high = ends
    known = None not in ends and high > low
    cells.append(f"{100.0 * min(chosen - low, high - chosen) / (high - low):.2f}" if known else "")
    print(",".join([folder.name, keys["friction"], keys.get("weight_fraction", "0"), *cells,
                    f"{summary['accuracy']['worst_over_run']:.1e}", f"{summary['cpu_time_seconds']:.1f}"]))
