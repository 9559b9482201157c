#!/usr/bin/env python3
"""Prints a CSV table of limit analyses of several models: critical friction, acceleration and lantern.

  limit_table.py OUT MODEL ...      reads OUT/MODEL_{friction,lateral,lantern}_limit/results/summary.json
"""

import json
import pathlib
import sys

LIMITS = {"friction": "critical friction", "lateral": "acceleration g", "lantern": "lantern over weight"}

out = pathlib.Path(sys.argv[1])
print("model," + ",".join(f"{name},{limit} gap,{limit} CPU s" for limit, name in LIMITS.items()))
for model in sys.argv[2:]:
    cells = [model]
    for limit in LIMITS:
        summary = json.loads((out / f"{model}_{limit}_limit/results/summary.json").read_text())
        value = f"{summary['critical_value']:.6f}" if "critical_value" in summary else summary["message"].split(": ")[1]
        found = "critical_value" in summary
        cells += [value, f"{summary['accuracy']['reached']:.0e}" if found else "", f"{summary['cpu_time_seconds']:.1f}"]
    print(",".join(cells))
