#!/usr/bin/env python3
"""Prints a CSV table of what the parts of the dome of Florence do.

  parts_table.py OUT MODEL ...      reads OUT/MODEL/results/, OUT/MODEL/post/ and OUT/MODEL_range/results/
"""

import csv
import json
import pathlib
import sys

MIDDLE = 13.5  # m, mid-height of the shells; the shares are those of the nearest ring


def rows(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def shares(post):
    """Of the vertical force, in per cent: inner shell, outer shell, ribs."""
    path = post / "members.csv"
    table = rows(path) if path.exists() else []
    distance = lambda r: abs(float(r["height_m"]) - MIDDLE)
    ring = [r for r in table if distance(r) == min(map(distance, table))]
    share = {r["member"]: 100.0 * float(r["share"]) for r in ring}
    ribs = [value for name, value in share.items() if "rib" in name]
    return [f"{share[name]:.1f}" if name in share else "" for name in ("inner", "outer")] + [f"{sum(ribs):.1f}" if ribs else ""]


def tension(post):
    """Of each chain, mean over its length, kN."""
    path = post / "chains.csv"
    return " / ".join(f"{float(r['mean_force_N']) / 1e3:.0f}" for r in rows(path)) if path.exists() else ""


out = pathlib.Path(sys.argv[1])
print("model,blocks,weight MN,outward force on the base MN,least MN,greatest MN,inner shell %,outer shell %,ribs %,"
      "chains kN,largest pressure MPa,largest displacement mm,status,certified error,CPU s")
for model in sys.argv[2:]:
    results, post = (json.loads((out / model / folder / "summary.json").read_text()) for folder in ("results", "post"))
    span = json.loads((out / f"{model}_range/results/summary.json").read_text())
    thrust = next(r for r in span["ranges"] if r["quantity"] == "thrust")
    base = rows(out / model / "post/rings.csv")[0]
    ends = ["" if (v := thrust[end].get("value")) is None else f"{v / 1e6:.4g}" for end in ("min", "max")]
    error = results["certified_force_error"].get("value")
    print(",".join([model, str(post["blocks"]), f"{results['weight_N'] / 1e6:.4g}",
                    f"{float(base['radial_thrust_N']) / 1e6:.4g}", *ends, *shares(out / model / "post"),
                    tension(out / model / "post"), f"{post['largest_pressure_Pa'] / 1e6:.3g}",
                    f"{1e3 * results['max_displacement_m']:.3g}", results["status"],
                    "" if error is None else f"{error:.1e}",
                    f"{results['cpu_time_seconds'] + span['cpu_time_seconds']:.0f}"]))
