#!/usr/bin/env python3
"""Prints a CSV table of the factor on the lantern at which a dome on a drum falls, beside published values.

  drum_table.py OUT MODEL ...      reads OUT/MODEL/results/summary.json

The published values are those of Anselmi, Galizia and Saetta, Frattura ed Integrita Strutturale 51 (2020), pp. 495-501.
"""

import json
import pathlib
import sys

LANTERN = 8 * 100e3  # N, factor 1
DRUMS = {"pavilion": "1.5 m without window", "pavilion_window": "1.5 m with window", "pavilion_window_thick": "2.5 m with window"}
PUBLISHED = {"pavilion": ("", "24.1"), "pavilion_window": ("about 3", "14.2"), "pavilion_window_thick": ("13.0", "")}

out = pathlib.Path(sys.argv[1])
print("drum,blocks,weight MN,ours,relative width of the bracket,CPU s,theirs with ribs that may fail,theirs with ribs that cannot")
for model in sys.argv[2:]:
    results, post = (json.loads((out / model / folder / "summary.json").read_text()) for folder in ("results", "post"))
    factor = results["critical_value"] * results["weight_N"] / LANTERN
    print(",".join([DRUMS[model], str(post["blocks"]), f"{results['weight_N'] / 1e6:.4g}", f"{factor:.4g}",
                    f"{results['accuracy']['reached']:.0e}", f"{results['cpu_time_seconds']:.0f}", *PUBLISHED[model]]))
