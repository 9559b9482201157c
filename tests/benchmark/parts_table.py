#!/usr/bin/env python3
"""Prints a CSV table of what the parts of a dome do. A script, not a table of a study: it chooses the ring nearest to mid-height and lists
several chains in a cell.

  parts_table.py OUT MODEL ...      reads OUT/MODEL/results/ and post/, OUT/MODEL_range/results/ and, if it is there,
                                    OUT/MODEL_friction_limit/results/
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


def least_friction(out, model):
    path = out / f"{model}_friction_limit/results/summary.json"
    return f"{json.loads(path.read_text())['critical_value']:.4g}" if path.exists() else ""


def row(out, model):
    results, post = (json.loads((out / model / folder / "summary.json").read_text()) for folder in ("results", "post"))
    span = json.loads((out / f"{model}_range/results/summary.json").read_text())
    thrust = next(r for r in span["ranges"] if r["quantity"].startswith("thrust"))
    least, greatest = ("" if (v := thrust[end].get("value")) is None else f"{v / 1e6:.4g}" for end in ("min", "max"))
    inner, outer, ribs = shares(out / model / "post")
    base = rows(out / model / "post/rings.csv")[0]
    error = results["certified_force_error"].get("value")
    return {"model": model.replace("_", " "), "blocks": str(post["blocks"]), "weight MN": f"{results['weight_N'] / 1e6:.4g}",
            "outward force on the base MN": f"{float(base['radial_thrust_N']) / 1e6:.4g}", "least MN": least, "greatest MN": greatest,
            "inner shell %": inner, "outer shell %": outer, "ribs %": ribs, "chains kN": tension(out / model / "post"),
            "least friction": least_friction(out, model), "largest pressure MPa": f"{post['largest_pressure_Pa'] / 1e6:.3g}",
            "largest displacement mm": f"{1e3 * results['max_displacement_m']:.3g}", "status": results["status"],
            "certified error": "" if error is None else f"{error:.1e}",
            "CPU s": f"{results['cpu_time_seconds'] + span['cpu_time_seconds']:.0f}"}


models = [name for name in sys.argv[2:] if not name.endswith(("_range", "_friction_limit"))]
table = [row(pathlib.Path(sys.argv[1]), model) for model in models]
columns = [key for key in table[0] if any(entry[key] for entry in table)]  # without chains no column of chains
print(",".join(columns))
for entry in table:
    print(",".join(entry[key] for key in columns))
