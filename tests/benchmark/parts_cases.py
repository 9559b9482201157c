#!/usr/bin/env python3
"""Writes the cases of `make parts`: shells of the dome of Florence, each with and without chains and drum, and variants for the
range of the thrust and the least friction. Prints their names. A script, not a study: its cases combine sections of others.

  parts_cases.py CASES FOLDER SHELL ...      reads CASES/florence_chains.yaml and florence_drum.yaml, writes to FOLDER
"""

import itertools
import pathlib
import sys


def geometry(path):
    """The keys below `geometry:`, the last section of the case."""
    return path.read_text().split("\ngeometry:\n", 1)[1]


def write(path, text):
    """Leaves a file that says so already as old as it is, so that its runs are used again."""
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


cases, folder = (pathlib.Path(argument) for argument in sys.argv[1:3])
folder.mkdir(parents=True, exist_ok=True)
parts = {name: geometry(cases / f"florence_{name}.yaml") for name in ("chains", "drum")}
variants = []
for shell, chains, drum in itertools.product(sys.argv[3:], (False, True), (False, True)):
    added = [part for part, is_there in (("chains", chains), ("drum", drum)) if is_there]
    name = "_with_".join([shell, "_and_".join(added)] if added else [shell])
    text = f"extends: cupola:{shell}\ntitle: {' '.join([shell, *added])}\n"
    if added:
        text += "geometry:\n" + "".join(parts[part] for part in added)
    write(folder / f"{name}.yaml", text)
    # Chains do not repeat by sectors: their bars begin at different azimuths. With arches a small contact is missing in some
    # sectors, which the solver refuses as not symmetric.
    sectors = "" if chains or shell == "florence_arches" else " analysis.cyclic_sectors=8"
    variants.append(f"{name}_range {name} analysis.type=range analysis.range.quantities=[thrust]{sectors}\n")
    variants.append(f"{name}_friction_limit {name} analysis.type=limit analysis.limit.parameter=friction "
                    "analysis.limit.low=0.03 analysis.limit.high=0.3\n")
    print(name)
write(folder / "variants.txt", "".join(variants))
