#!/usr/bin/env python3
"""Prints CSV tables of what chains do for a dome.

  chains_table.py compare OUT MODEL WITH_CHAINS     reads post/ and results/ of both, and of MODEL_friction_limit
  chains_table.py bars OUT WITH_CHAINS              the chains, from OUT/WITH_CHAINS/post/
"""

import csv
import json
import pathlib
import sys


def rows(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def tension(post, meridian, column):
    """Of all rings together across a meridian, MN; compressed rings do not count."""
    forces = (float(row[column]) for row in rows(post / f"hoop_{meridian}.csv"))
    return sum(-force for force in forces if force < 0.0) / 1e6


def measures(out, model):
    post = out / model / "post"
    summary = json.loads((post / "summary.json").read_text())
    limit = json.loads((out / f"{model}_friction_limit/results/summary.json").read_text())
    return {"outward thrust over weight": summary["thrust_over_weight"],
            "least friction at which it stands (associated law)": limit["critical_value"],
            "largest displacement, mm": 1e3 * summary["max_displacement_m"],
            "length of open joints, m": summary["crack_length_m"],
            "hoop tension of bed joints, all rings together, mid-sail, MN": tension(post, "mid_sail", "bed_force_N"),
            "hoop tension of bed joints, all rings together, rib, MN": tension(post, "rib", "bed_force_N"),
            "tension of chains, mid-sail, MN": tension(post, "mid_sail", "tie_force_N"),
            "tension of chains, rib, MN": tension(post, "rib", "tie_force_N")}


def compare(out, plain, chained):
    without, with_chains = measures(out, plain), measures(out, chained)
    print("quantity,without chains,with chains")
    for name, value in without.items():
        print(f'"{name}",{value:.4g},{with_chains[name]:.4g}')


def bars(out, model):
    names = {"height_m": "height m", "mean_force_N": "mean tension kN", "least_force_N": "least kN",
             "greatest_force_N": "greatest kN", "yield_force_N": "yield force kN", "bars": "bars",
             "slack_bars": "slack", "yielding_bars": "yielding"}
    print("chain," + ",".join(names.values()))
    for row in rows(out / model / "post/chains.csv"):
        values = (f"{float(row[key]) / (1e3 if key.endswith('_N') else 1.0):.4g}" for key in names)
        print(row["chain"] + "," + ",".join(values))


if __name__ == "__main__":
    {"compare": compare, "bars": bars}[sys.argv[1]](pathlib.Path(sys.argv[2]), *sys.argv[3:])
