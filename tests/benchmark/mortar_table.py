#!/usr/bin/env python3
"""Prints a CSV table of ranges of the thrust, critical frictions and accelerations of models with joints of different
strength.

  mortar_table.py OUT MODEL ...      reads OUT/MODEL_{thrust,friction,lateral}/results/
"""

import json
import pathlib
import re
import sys


def limit(summary):
    if "critical_value" in summary:
        return f"{summary['critical_value']:.6f}"
    stands = re.search(r"stands at both ends of the bracket, (\S+) and", summary["message"])
    return f"below {stands[1]}" if stands else summary["message"].split(": ")[1].replace(",", "")


out = pathlib.Path(sys.argv[1])
print("cohesion kPa,tension kPa,compression MPa,least thrust over weight,chosen,greatest,critical friction,acceleration g,CPU s")
for model in sys.argv[2:]:
    folders = [out / f"{model}_{what}/results" for what in ("thrust", "friction", "lateral")]
    thrust, friction, lateral = (json.loads((folder / "summary.json").read_text()) for folder in folders)
    joints = {}
    for line in (folders[0] / "run.yaml").read_text().splitlines():
        key, _, value = line.strip().partition(": ")
        if key in ("cohesion", "tension", "compressive_strength"):
            joints.setdefault(key, float(value))
    span = next(r for r in thrust["ranges"] if r["quantity"] == "thrust")
    values = [span["min"].get("value"), span.get("chosen"), span["max"].get("value")]
    cells = ["" if v is None else f"{v / thrust['weight_N']:.6f}" for v in values]
    limits = [limit(friction), limit(lateral)]
    strength = [f"{joints.get('cohesion', 0) / 1e3:g}", f"{joints.get('tension', 0) / 1e3:g}",
                f"{joints['compressive_strength'] / 1e6:g}" if "compressive_strength" in joints else "unlimited"]
    seconds = sum(s["cpu_time_seconds"] for s in (thrust, friction, lateral))
    print(",".join(strength + cells + limits + [f"{seconds:.0f}"]))
