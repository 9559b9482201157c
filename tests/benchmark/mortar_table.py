#!/usr/bin/env python3
"""Prints a CSV table of models with joints of different strength.

  mortar_table.py ranges OUT MODEL ...   ranges of the thrust, critical frictions and accelerations: reads
                                         OUT/MODEL_{thrust,friction,lateral}/results/
  mortar_table.py forces OUT MODEL ...   forces that the compliances choose: reads OUT/MODEL/{results,post}/
"""

import csv
import json
import pathlib
import re
import sys


def strengths(results):
    """Cohesion and tension in kPa, compressive strength in MPa; dry joints: 0, 0, unlimited."""
    joints = {}
    for line in (results / "run.yaml").read_text().splitlines():
        key, _, value = line.strip().partition(": ")
        if key in ("cohesion", "tension", "compressive_strength"):
            joints.setdefault(key, float(value))
    return [f"{joints.get('cohesion', 0) / 1e3:g}", f"{joints.get('tension', 0) / 1e3:g}",
            f"{joints['compressive_strength'] / 1e6:g}" if "compressive_strength" in joints else "unlimited"]


def limit(summary):
    if "critical_value" in summary:
        return f"{summary['critical_value']:.6f}"
    stands = re.search(r"stands at both ends of the bracket, (\S+) and", summary["message"])
    return f"below {stands[1]}" if stands else summary["message"].split(": ")[1].replace(",", "")


def ranges(out, models):
    print("cohesion kPa,tension kPa,compression MPa,least thrust over weight,chosen,greatest,critical friction,"
          "acceleration g,CPU s")
    for model in models:
        folders = [out / f"{model}_{what}/results" for what in ("thrust", "friction", "lateral")]
        thrust, friction, lateral = (json.loads((folder / "summary.json").read_text()) for folder in folders)
        span = next(r for r in thrust["ranges"] if r["quantity"] == "thrust")
        values = [span["min"].get("value"), span.get("chosen"), span["max"].get("value")]
        cells = ["" if v is None else f"{v / thrust['weight_N']:.6f}" for v in values]
        seconds = sum(s["cpu_time_seconds"] for s in (thrust, friction, lateral))
        print(",".join(strengths(folders[0]) + cells + [limit(friction), limit(lateral), f"{seconds:.0f}"]))


def forces(out, models):
    print("cohesion kPa,tension kPa,outward thrust over weight,largest pressure MPa,joints partly open,joints under pull,"
          "joints at their tension")
    for model in models:
        summary = json.loads((out / model / "post/summary.json").read_text())
        with open(out / model / "post/joints.csv", encoding="utf-8") as file:
            joints = list(csv.DictReader(file))
        pull = [j for j in joints if float(j["normal_force_N"]) < -summary["negligible_force_N"]]
        cohesion, tension, compression = strengths(out / model / "results")
        if compression != "unlimited" and summary["largest_pressure_Pa"] > 0.99e6 * float(compression):
            sys.exit(f"{model}: crushes, so that a share of 1 of the strength is not one of the tension")
        at_tension = sum(float(j["strength_use"] or 0) > 1 - 1e-6 for j in joints)
        is_open = sum(float(j["open_share"]) > 0 for j in joints)
        print(",".join([cohesion, tension, f"{summary['thrust_over_weight']:.6f}",
                        f"{1e-6 * summary['largest_pressure_Pa']:.6f}", f"{is_open},{len(pull)},{at_tension}"]))


{"ranges": ranges, "forces": forces}[sys.argv[1]](pathlib.Path(sys.argv[2]), sys.argv[3:])
