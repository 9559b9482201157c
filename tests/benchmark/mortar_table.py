#!/usr/bin/env python3
"""Prints a CSV table of ranges of the thrust, critical frictions and accelerations of models with joints of different
strength.

  mortar_table.py OUT MODEL ...      reads OUT/MODEL_{thrust,friction,lateral}/results/
"""

import json
import pathlib
import sys

import yaml

out = pathlib.Path(sys.argv[1])
print("cohesion kPa,tension kPa,compression MPa,least thrust over weight,chosen,greatest,critical friction,acceleration g,CPU s")
for model in sys.argv[2:]:
    folders = [out / f"{model}_{what}/results" for what in ("thrust", "friction", "lateral")]
    thrust, friction, lateral = (json.loads((folder / "summary.json").read_text()) for folder in folders)
    joints = yaml.safe_load((folders[0] / "run.yaml").read_text())["joints"]
    span = next(r for r in thrust["ranges"] if r["quantity"] == "thrust")
    values = [span["min"].get("value"), span.get("chosen"), span["max"].get("value")]
    cells = ["" if v is None else f"{v / thrust['weight_N']:.6f}" for v in values]
    limits = [f"{s['critical_value']:.6f}" if "critical_value" in s else s["message"].split(": ")[1].split(";")[0].replace(",", "")
              for s in (friction, lateral)]
    strength = [f"{joints.get('cohesion', 0) / 1e3:g}", f"{joints.get('tension', 0) / 1e3:g}",
                f"{joints['compressive_strength'] / 1e6:g}" if "compressive_strength" in joints else "unlimited"]
    seconds = sum(s["cpu_time_seconds"] for s in (thrust, friction, lateral))
    print(",".join(strength + cells + limits + [f"{seconds:.0f}"]))
