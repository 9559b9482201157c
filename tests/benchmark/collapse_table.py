#!/usr/bin/env python3
"""Prints a CSV table of what motions of many blocks cost: collapse_table.py OUT/RUN ..."""

import csv
import json
import pathlib
import sys

MOVED = 0.5  # m

table = []
for run in map(pathlib.Path, sys.argv[1:]):
    summary = json.loads((run / "results/summary.json").read_text())
    with (run / "results/history.csv").open() as file:
        steps = [row for row in csv.DictReader(file) if float(row["time_s"]) > 0.0]
    moved = [f"{float(row['time_s']):.3g}" for row in steps if float(row["max_displacement_m"]) >= MOVED]
    table.append({
        "blocks": str(summary["free_blocks"]), "contacts, first": steps[0]["contacts"], "contacts, last": steps[-1]["contacts"],
        "duration s": f"{float(steps[-1]['time_s']):.3g}", "steps": str(len(steps)), "threads": str(summary["threads"]),
        "iterations per step": f"{summary['iterations'] / len(steps):.1f}",
        "CPU s per step": f"{summary['cpu_time_seconds'] / len(steps):.3g}", "CPU s": f"{summary['cpu_time_seconds']:.0f}",
        "elapsed min": f"{summary['wall_time_seconds'] / 60:.1f}", "GB": f"{summary['peak_memory_bytes'] / 1e9:.2f}",
        "worst momentum residual": f"{summary['momentum_residual']:.1e}", "energy error": f"{summary['energy_error']:.0e}",
        f"time to {MOVED} m s": moved[0] if moved else ""})

writer = csv.DictWriter(sys.stdout, table[0].keys())
writer.writeheader()
writer.writerows(table)
