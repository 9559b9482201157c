#!/usr/bin/env python3
"""Imports block models of public repositories, made by others, with one case for all of them, and tabulates what came of it.

  public_models.py FOLDER GENERATOR      FOLDER holds clones of the repositories of MODELS; a model that is absent is left out

The case gives the file, `fixed_by: lowest`, and the keys in MODELS, which their authors state; there is one try. Volumes are compared with
those that the file's own polygons enclose.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

# repository, file, keys of geometry.import
MODELS = [
    ("compas_dem", "data/crossvault.obj", {}),
    ("compas_dem", "data/pavillionvault/blocks.json", {}),
    ("compas_dem", "data/armadillo.obj", {}),
    ("compas_dem", "data/dome.obj", {}),
    ("compas_dem", "data/wall.obj", {}),
    ("compas_dem", "data/ursula.obj", {}),
    ("compas_dem", "data/dem_crossvault.json", {}),
    ("compas_dem", "data/crossvault.json", {}),
    ("compas_dem", "scripts/DEM_Analysis_References/Barrel_Vault/DEM_model.json", {}),
    ("compas_assembly", "data/__temp/assembly_courses.json", {}),
    ("compas_assembly", "data/__temp/curvedwall.json", {}),
    ("compas_assembly", "data/__temp/dome.json", {}),
    ("compas_assembly", "data/__temp/polysurfaces.json", {}),
    ("compas_assembly", "data/__temp/square_crossvault.json", {}),
    ("compas_assembly", "data/__temp/stack.json", {}),
    ("compas_assembly", "data/__temp/ursula.json", {}),
    ("compas_assembly", "data/__temp/wall.json", {}),
    ("compas_assembly", "src/compas_assembly/data/samples/armadillo.json", {}),
    ("compas_assembly", "src/compas_assembly/data/samples/crossvault.json", {}),
    ("compas_cra", "src/compas_cra/data/samples/bridge.json", {}),
    ("compas_cra", "src/compas_cra/data/samples/curve-3-blocks.json", {}),
    ("compas_cra", "src/compas_cra/data/samples/shelf-stable.json", {}),
    ("compas_cra", "src/compas_cra/data/samples/snake.json", {}),
    ("compas_rbe", "data/complex/brg.json", {}),
    ("compas_rbe", "data/complex/curve_components.json", {}),
    ("compas_rbe", "data/complex/gene_vault_3support.json", {}),
    ("compas_rbe", "data/complex/genevault.json", {}),
    ("compas_rbe", "data/complex/matthias_vault_blocks.json", {}),
    ("compas_rbe", "data/simple_arch/simple_arch.json", {}),
    ("compas_rbe", "data/simple_corbelarch/corbel_blocks.json", {}),
    ("compas_rbe", "data/simple_pile/simple_pile.json", {}),
    ("Masonry", "data/colonnade_brickfile.txt", {"up": "y"}),
    ("Masonry", "data/wall_brickfile.txt", {"up": "y"}),
]


def attempt(file, keys, generator, folder):
    """Report of the generator, or the message with which it refuses the file."""
    case, report = folder / "case.yaml", folder / "report.json"
    source = ", ".join(f"{key}: {value}" for key, value in {"file": file.name, "fixed_by": "lowest", **keys}.items())
    case.write_text(f"geometry: {{import: {{{source}}}}}\n")
    run = subprocess.run([generator, str(case), "--output", str(folder / "blocks.vtu"), "--report", str(report), "--quiet"],
                         capture_output=True, text=True, check=False)
    if run.returncode == 0:
        return json.loads(report.read_text()), ""
    lines = [line for line in run.stderr.splitlines() if "error: " in line] or [run.stderr.strip() or f"exit code {run.returncode}"]
    return None, lines[0].split("error: ", 1)[-1].replace(str(folder) + "/", "")


def shortened(message):
    """A message of refusal in one phrase: how many pairs overlap, or how many blocks have which defects."""
    overlap = re.search(r"overlap by ([0-9.e+-]+) m", message)
    pairs = re.search(r"(\d+) pairs overlap", message)
    if overlap:
        return f"refused: {pairs[1] if pairs else 1} pairs overlap, by up to {1e3 * float(overlap[1]):.0f} mm"
    defects = [text for text in re.split(r"; (?=block |and )", message)]
    kinds = {re.sub(r"^block [^:]*: |, \d+ boundary edges", "", text) for text in defects if text.startswith("block ")}
    if kinds:
        more = re.search(r"and (\d+) more block", message)
        count = len(defects) + (int(more[1]) - 1 if more else 0)
        return f"refused: {count} block{'s' if count > 1 else ''}: " + "; ".join(sorted(kinds))
    return "refused: " + message.split(":")[0]


def row(repository, path, keys, generator, root):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        file = folder / pathlib.Path(path).name
        file.write_bytes((root / repository / path).read_bytes())
        report, message = attempt(file, keys, generator, folder)
    result = "at the first try" + "".join(f", {key}: {value}" for key, value in keys.items())
    cells = [repository, path.replace("src/compas_cra/data/", "").replace("src/compas_assembly/data/", "")]
    if not report:
        return cells + [""] * 6 + [shortened(message)]
    if any("metres_per_unit" in text for text in report["warnings"]):
        result += "; the unit is doubted"
    own = report["import"]
    change = 100 * (own["volume_m3"] / own["drawn_volume_m3"] - 1)
    return cells + [str(report["blocks"]), str(report["joints"]), str(own["courses"]), f"{own['drawn_volume_m3']:.5g}",
                    f"{change:.2g}" if abs(change) >= 1e-3 else "0", f"{1e3 * report['max_overlap_m']:.2g}", result]


print("repository,file,blocks,joints,courses,volume m3,change %,overlap mm,imported")
for model in MODELS:
    if (pathlib.Path(sys.argv[1]) / model[0] / model[1]).exists():
        print(",".join('"' + cell.replace('"', "'") + '"' for cell in row(*model, sys.argv[2], pathlib.Path(sys.argv[1]))), flush=True)
