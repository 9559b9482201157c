#!/usr/bin/env python3
"""Runs random cases through the three programs: tiny models with random keys of the whole schema and random values.

    random_cases.py BIN_FOLDER PIPELINES [--seed N] [--jobs 2]

A case starts from a tiny model and some keys drawn from the schema, those least often run first. What a program refuses is
taken out until the case runs or nothing is left. Checked: exit codes; one line of error that names the case or a file; no
run longer than a minute; no NaN in tables and reports; a summary; post accepts every finished run. Cases with a defect are
kept. Prints how many keys, and how many pairs of keys, took part in a complete pipeline.
"""
import argparse
import concurrent.futures
import itertools
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import threading
import time

LONGEST = 60  # s of processor time, of one program
MOST_BLOCKS = 200
SMALL = {  # values that keep a model tiny or sensible, by the end of the key; others follow from type and range
    "rings": [1, 2, 3, 4], "blocks_per_ring": [2, 3, 4, 6], "refine": [1, 1, 2], "slices_per_block": [2, 4],
    "slices_per_vertical": [1, 2], "spirals": [1, 2], "rings_per_vertical": [1, 2, 3], "verticals_per_block": [1, 2, 3],
    "sails": [3, 4, 8], "voussoir_segments": [1, 3], "base_blocks": [1, 2], "span": [4, 10, 45], "radius_ratio": [0.5, 0.8, 1],
    "crown_angle_deg": [30, 60, 80], "half_embrace_deg": [60, 90], "geometry.surface.thickness": [0.3, 1, 2.2],
    "wythes[].thickness": [0.2, 0.5, 1], "per_ring": [1, 2, 3],
    "openings[].width": [0.3, 1], "openings[].height": [0.5, 1], "sill": [0.3, 1], "lintel": [0, 0.3], "bearing": [0.1, 0.5],
    "course": [0, 1, 2], "links": [0, 3, 8], "clamp_length": [0.1, 0.3], "long_blocks": [0, 1], "window.course": [0.1, 0.5],
    "window.height": [0.5, 2], "from_deg": [-20, 0], "to_deg": [20, 60], "stage.rings": [1, 2], "duration": [0.03, 0.06], "time_step": [0.005, 0.01, 0.02],
    "frames_every": [0.01, 0.03], "window": [0, 0.02], "smallest": [1e-4, 1e-3], "largest": [0.01, 0.02],
    "path.steps": [2, 4], "path.end": [0.5, 1], "path.length": [1e-4, 1e-3], "max_iterations": [0, 5, 100],
    "robustness": [0, 1, 4], "cyclic_sectors": [1, 2, 4], "subdivide": [1, 2], "perturbations": [4, 16], "keep": [2, 4],
    "ring": [0, 1, 2], "from": [0, 1], "to": [1, 2, 3], "from_ring": [0, 1], "to_ring": [1, 2], "first_ring": [0, 1],
    "last_ring": [-1, 1, 2], "teams": [1, 2], "courses": [1, 2], "hold_below": [-1, 1, 2], "sectors": [1, 2, 4],
    "friction": [0, 0.1, 0.4, 0.8], "normal": [0, 1e-9, 1e-8], "relative": [1e-6, 1e-4], "tangential": [0, 1e-9, 1e-8], "cohesion": [0, 1e4, 2e5],
    "tension": [0, 1e4, 1e5], "compressive_strength": [1e5, 2e6], "fracture_energy.tension": [10, 100],
    "fracture_energy.shear": [50, 100], "gap": [0, 1e-5, 1e-4], "noise": [0, 1e-5], "margin": [0, 1e-3],
    "weight_fraction": [0, 0.05, 0.3], "unit_weight": [18000], "density": [1800], "pressure": [-100, 0, 500],
    "force": [[0, 0, -500], [100, 0, 0]], "traction": [[0, 0, -50], [10, 0, 0]], "displacement": [[1e-4, 0, 0], [0, 0, 1e-3], 0.5],
    "rotation_deg": [[0, 0.01, 0]], "gravity": [[0, 0, -9.81], [0, 0, -1.6], [0.5, 0, -9.81]], "sequence": [[0, 1], [1, 0]],
    "heights": [[0, 10]], "values": [[0.4, 0.6]], "times": [[0, 0.5]], "at": [[0.5], [0.25, 0.75]], "sections": [[0.5], [1, 5]],
    "blocks": [[0], [1], [0, 1], [2, 3]], "block": [0, 1, 2, 5], "block_a": [0, 1], "block_b": [2, 3, 4], "tie": [0, 1], "restraint": [0],
    "supports": [["ground"]], "import.file": ["blocks.obj"], "contact.file": ["contacts.csv"], "time.file": ["table.csv"],
    "observed": ["cracks.csv"], "friction_time.file": ["table.csv"], "dead_load_time.file": ["table.csv"], "base_motion.file": ["table.csv"],
    "relative_width": [0.1, 0.01], "tolerance": [1e-9, 1e-6, 1e-2], "wrench_error": [0.5, 0.01], "recovery_speed": [0.6],
    "limit.low": [0, 0.01], "limit.high": [0.5, 1, 2], "azimuth_deg": [0, 45], "stiffness": [1e6], "prestress": [0, 1e3],
    "yield_force": [1e4], "axial_stiffness": [1e8], "slack": [0, 1e-4], "time_error": [1e-6], "days_per_course": [1],
    "age": [1], "key": ["joints.friction"], "sweep[].values": [["0.3", "0.5"]], "embedment": [-1, 0, 1], "every": [1, 2],
    "first": [0, 1], "accuracy": ["draft", "standard"], "weld": [1e-6], "facet_angle": [1e-3], "name": ["east", "inner", "outer"],
    "member": ["", "dome", "drum", "inner"], "cyclic": [1, 2], "metres_per_unit": [0.5, 1], "fixed_below": [0.6],
}
WILD = [0, -1, 1, 0.5, 1e300, -1e300, 1e30, -1e30, 1e-300, 1e18, "text", "", True, None, [], {}, [1], "no", "1e5", 99999999999]
FILES = {
    "cracks.csv": "azimuth_deg,width_m\n0,0.001\n90,0\n",
    "table.csv": "time,value\n0,0\n0.02,0.001\n0.05,0\n",
    "contacts.csv": "block_a,block_b,x,y,z,nx,ny,nz,area\n0,1,0.5,0.5,1,0,0,1,1\n",
    "blocks.obj": "".join(
        f"o {name}\n" + "".join(f"v {x} {y} {z}\n" for z in (low, low + 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))) +
        "".join("f " + " ".join(str(8 * i + v) for v in face) + "\n" for face in
                ((4, 3, 2, 1), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)))
        for i, (name, low) in enumerate((("ground", 0), ("middle", 1), ("=top, 1", 2)))),
}


class Key:
    """A key of the schema: path with [] after lists, and the `type` of the maps that have it."""

    def __init__(self, path, condition, rest):
        self.path, self.condition, self.rest = path, condition, rest
        self.required = rest.endswith("required")
        self.type = re.split(r", (?:default|required|[<>])", rest)[0]
        self.is_map = self.type.endswith("map") or self.type.startswith("list of maps")
        self.name = path + (f"({condition})" if condition else "")


def read_schema(bin_folder):
    text = subprocess.run([bin_folder / "cupola-generate", "--schema"], capture_output=True, text=True, check=True).stdout
    heads, head = [], ""
    for line in text.split("\n"):
        if not line.startswith(" "):
            head = line
            heads.append(head)
        elif heads and heads[-1].endswith(",") or heads and re.search(r", default$", heads[-1]):
            heads[-1] += " " + line.strip()
    keys = []
    for head in filter(None, heads):
        path, condition, rest = re.match(r"([\w.\[\]]+)(?: \(\w+: (\w+)\))?: (.*)", head).groups()
        keys.append(Key(path, condition, rest))
    return keys


def value_for(key, rng):
    if rng.random() < 0.03:
        return rng.choice(WILD)
    for end in sorted(SMALL, key=len, reverse=True):
        if key.path == end or key.path.endswith("." + end) or key.path.endswith(end) and "[" in end:
            if not re.match(r"[a-z_]+, [a-z_]+", key.type) or isinstance(SMALL[end][0], str):
                return rng.choice(SMALL[end])
    kind = key.type.split(" in ")[0]
    if kind == "integer": return rng.choice([0, 1, 2, 3])
    if kind.startswith("3 numbers"): return [rng.choice([0, 1, -1]), rng.choice([0, 1]), rng.choice([0, 1, 0.5])]
    if kind == "numbers": return [0.25, 0.5]
    if kind == "number": return rng.choice([0, 0.1, 0.5, 1, 10, 1e-3, 1e-6])
    if kind == "texts": return ["ground"]
    if kind == "text": return rng.choice(["plain", "=1+1", 'a "quoted", text', "<b>"])
    if kind in ("block", "blocks"): return rng.choice([0, 1, 2]) if kind == "block" else [0, 1]
    if kind == "file": return rng.choice(sorted(FILES))
    if kind == "true, false" or kind.startswith("true"): return rng.random() < 0.5
    choices = [word for word in kind.split(", ") if re.fullmatch(r"[a-z_0-9]+", word)]
    return rng.choice(choices) if choices else rng.choice(WILD)


def tiny_bond(rng, kind="running"):
    return {"type": kind, "rings": rng.choice([2, 4]), "blocks_per_ring": rng.choice([4, 8]), "slices_per_block": 2}


def add_companions(case, key, rng):
    """What a key requires to have an effect: the type of analysis, the shape of the model, or a property of the joints."""
    path, geometry, analysis, joints = key.path, case["geometry"], case["analysis"], case["joints"]
    kinds = {"staged": "staged", "limit": "limit", "path": "path", "range": "range", "adaptive": "dynamic", "sleep": "dynamic",
             "stop": "dynamic", "integrator": "dynamic", "thresholds": "dynamic", "duration": "dynamic", "time_error": "dynamic"}
    part = path.split(".")[1].removesuffix("[]") if "." in path else ""
    if path.startswith("analysis.") and part in kinds and analysis.get("type") != kinds[part]:
        analysis.clear()
        analysis |= small_analysis(kinds[part], rng)
    if part == "staged" and path.split(".")[2] in ("teams", "order", "sequence", "carry", "hold_below", "allow_associated"):
        analysis["friction_law"] = "coulomb"
        analysis["staged"] = {"unit": "block"}
        if path.endswith("sequence"): analysis["staged"]["order"] = "given"
    if path.startswith("geometry.import") and "import" not in geometry:
        geometry.clear()
        geometry["import"] = {"file": "blocks.obj", "supports": ["ground"]}
    vault = path.startswith(("geometry.members", "geometry.chains", "geometry.window", "geometry.base_blocks", "geometry.stage"))
    if vault and geometry.get("surface", {}).get("type") not in ("dome", "octagonal_vault"):
        geometry.clear()
        geometry |= {"surface": {"type": rng.choice(["dome", "octagonal_vault"])}, "bond": tiny_bond(rng)}
    if path.startswith("geometry.members") and "members" not in geometry:
        drum = {"type": "vault", "plan": {"type": "polygon"}, "profile": {"type": "straight", "span": 45, "height": 4}, "thickness": 3}
        geometry["members"] = [{"name": "drum", "at": {"origin": [0, 0, -4]}, "surface": drum, "bond": tiny_bond(rng) | {"rings": 4}}]
        geometry["on"] = "drum"
        if "openings" in path:
            geometry["members"][0]["openings"] = [{"per_ring": 2, "width": 1, "height": 1, "sill": 1, "lintel": 1}]
    for owner, name in ((geometry, "geometry."), (geometry.get("members", [{}])[0], "geometry.members[].")):
        if path.startswith((name + "wythes", name + "bonders")) and "wythes" not in owner:
            if name == "geometry.":
                geometry.clear()
                geometry |= {"surface": {"type": "wall", "length": 2, "height": 1}}
            owner.pop("thickness", None)
            owner.pop("bond", None)
            owner["wythes"] = [{"name": one, "thickness": 0.5, "bond": tiny_bond(rng) | {"rings": 2}} for one in ("inner", "outer")]
            if "bonders" in path: owner["bonders"] = [{"name": "h", "from": "inner", "to": "outer"}]
    if re.search(r"tension|cohesion|compressive|failure|fracture|subdivide", path): joints["compliance"] = {"per": "area"}
    if re.search(r"failure|fracture", path):
        joints |= {"failure": "softening", "tension": 1e5, "cohesion": 2e5, "fracture_energy": {"tension": 50, "shear": 100}}
        if analysis.get("type") not in ("dynamic", "path"):
            analysis.clear()
            analysis |= small_analysis("path", rng)
    if path.startswith("joints.herringbone") and "surface" in geometry:
        geometry["surface"] = {"type": "dome"}
        geometry["bond"] = {"type": "herringbone", "spirals": 2, "blocks_per_ring": 8, "rings": 4}
    if path.startswith("joints.wythe"): add_companions(case, Key("geometry.wythes[].name", None, "text"), rng)
    if re.search(r"time|moves|base_motion", path) and analysis.get("type") == "static": analysis |= small_analysis("dynamic", rng)
    if analysis.get("type") == "path": case.setdefault("loads", {}).setdefault("dead_load_time", {"type": "ramp", "from": 0.5})


def small_analysis(kind, rng):
    return {"type": kind} | {"dynamic": {"duration": 0.04, "time_step": 0.01}, "path": {"path": {"steps": 3, "control": {"block": 1}}},
                             "range": {"range": {"quantities": [{"type": "joint", "blocks": [1, 2], "component": "normal"}]}},
                             "limit": {"limit": {"relative_width": 0.05}}}.get(kind, {})


class Schema:
    def __init__(self, keys):
        self.leaves = [k for k in keys if not k.is_map and not k.path.endswith(".type")]
        self.types = [k for k in keys if k.path.endswith(".type")]
        self.required = [k for k in keys if k.required and not k.is_map]
        self.typed = {k.path[:-5]: k for k in self.types}

    def place(self, case, key, rng, index=0):
        """Sets a key with a random value, the types of its maps and their required keys. False if its place is taken."""
        node, path = case, ""
        parts = key.path.split(".")
        for part in parts[:-1]:
            name, is_list = part.removesuffix("[]"), part.endswith("[]")
            path = f"{path}.{part}" if path else part
            fresh = name not in node
            child = node.setdefault(name, [{}] if is_list else {})
            if is_list:
                if not isinstance(child, list) or not child or not isinstance(child[0], dict): return False
                child = child[0]
            if not isinstance(child, dict): return False
            last = path == key.path.rpartition(".")[0]
            if path in self.typed:
                wanted = key.condition if key.condition and last else None
                if wanted and child.get("type", wanted) != wanted: return False
                child.setdefault("type", wanted or rng.choice(self.typed[path].type.split(", ")))
            if fresh and name == "bond":
                child |= {"rings": rng.choice([1, 2]), "blocks_per_ring": rng.choice([2, 4, 8])}
            if fresh:
                for need in self.required:
                    if need.path.rpartition(".")[0] == path and not need.path.endswith(".type") and \
                            need.condition in (None, child.get("type")):
                        child.setdefault(need.path.rpartition(".")[2], value_for(need, rng))
            node = child
        if not isinstance(node, dict): return False
        node[parts[-1]] = value_for(key, rng)
        return True


def keys_of(node, schema_names, path="", kind=None):
    """Names of the leaf keys that a case contains, as the schema writes them."""
    found = set()
    if isinstance(node, dict):
        kind = node.get("type")
        for name, child in node.items():
            found |= keys_of(child, schema_names, f"{path}.{name}" if path else name, kind)
        return found
    if isinstance(node, list) and node and isinstance(node[0], dict):
        return set().union(*(keys_of(child, schema_names, path + "[]") for child in node))
    for name in (f"{path}({kind})", path):
        if name in schema_names: found.add(name)
    if path.endswith(".type"): found.add(f"{path}={node}")
    return found


def base_case(rng):
    surface = rng.choice(["dome", "octagonal_vault", "arch", "wall", "wall", "dome", None])
    case = {"joints": {"compliance": rng.choice([{"per": "point"}, {"per": "area"}, {}])},
            "analysis": {"type": rng.choice(["static", "static", "dynamic", "dynamic", "staged", "limit", "range", "path"])}}
    if surface is None:
        case["geometry"] = {"import": {"file": "blocks.obj", "supports": ["ground"]}}
    else:
        size = {"type": surface}
        if surface == "wall": size |= {"length": 2, "height": 1, "thickness": 0.5}
        if surface == "octagonal_vault": size |= {"sails": rng.choice([4, 8])}
        bond = {"type": rng.choice(["running", "running", "stack", "herringbone", "fill"]), "rings": rng.choice([2, 3]),
                "blocks_per_ring": rng.choice([4, 8]) if surface != "wall" else 2}
        if bond["type"] in ("running", "stack"): bond["slices_per_block"] = 2
        if bond["type"] == "herringbone": bond |= {"spirals": 2, "blocks_per_ring": 8, "rings": 4}
        if surface == "arch": bond = {"type": "stack", "rings": rng.choice([3, 5]), "blocks_per_ring": 1, "slices_per_block": 1}
        case["geometry"] = {"surface": size, "bond": bond}
    case["analysis"] = small_analysis(case["analysis"]["type"], rng)
    if case["analysis"]["type"] == "range" and surface in ("dome", "octagonal_vault", "arch"):
        case["analysis"]["range"] = {"quantities": ["thrust"]}
    return case


def remove_key(case, path):
    """Removes the key that a message names, or the map that holds it. False if the case has no such key."""
    parts = [p for p in re.split(r"[.\[\]]+", path) if p]
    node, owners = case, []
    for part in parts:
        if isinstance(node, list):
            index = int(part) if part.isdigit() else 0
            if index >= len(node): break
            node = node[index]
            if part.isdigit(): continue
        if not isinstance(node, dict) or part not in node: break
        owners.append((node, part))
        node = node[part]
    if not owners: return False
    owner, part = owners[-1]
    if part in ("geometry", "surface", "bond", "analysis") and len(owners) <= 2: return False
    del owner[part]
    return True


class Campaign:
    def __init__(self, bin_folder, pipelines, seed):
        self.bin, self.pipelines, self.seed = bin_folder, pipelines, seed
        keys = read_schema(bin_folder)
        self.schema = Schema(keys)
        self.names = {k.name for k in self.schema.leaves} | {k.path for k in self.schema.leaves}
        self.lock = threading.Lock()
        self.complete = self.refused = self.defects = 0
        self.endings, self.times = {}, []
        self.runs_of_key = {k.name: 0 for k in self.schema.leaves}
        self.pairs = set()

    def run(self, folder, *words):
        """Exit code, output and error of a program."""
        done = subprocess.run([self.bin / words[0], *words[1:]], cwd=folder, capture_output=True, text=True, errors="replace",
                              stdin=subprocess.DEVNULL, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST)))
        return done.returncode, done.stdout, done.stderr

    def draw(self, rng):
        case = base_case(rng)
        with self.lock: weights = [1 / (1 + self.runs_of_key[k.name]) for k in self.schema.leaves]
        for key in rng.choices(self.schema.leaves, weights, k=rng.choice([1, 2, 3, 4, 5, 6, 8])):
            add_companions(case, key, rng)
            self.schema.place(case, key, rng)
        # Rigid or Coulomb statics by a first-order method take 500,000 iterations a step and more, see docs/data/accuracy.md.
        if case["analysis"].get("method") in ("nsgs", "spg", "apgd", "admm"):
            case["analysis"].setdefault("max_iterations", 1000)
        return case

    def defect_of(self, code, error, wanted=(0, 2)):
        """What is wrong with how a program ended; "" if nothing is."""
        if code not in wanted: return f"exit code {code}"
        lines = [line for line in error.splitlines() if "warning:" not in line]
        if code == 2 and len(lines) != 1: return f"{len(lines)} lines of error"
        if code == 2 and not re.search(r"error: [a-z_]+:|block \d+|\.(yaml|vtu|csv|obj|json)|results|[a-z_]+\.[a-z_]+|--", lines[0]): return "neither file nor key is named"
        if code in (0, 3) and lines: return "an error without its exit code"
        return ""

    def output_defect(self, folder, full):
        for path in sorted((folder / "post").rglob("*")):
            if path.suffix not in (".csv", ".html", ".json"): continue
            text = path.read_text(errors="replace")
            if path.suffix == ".html": text = re.sub(r"<script.*?</script>", "", text, flags=re.S)
            if found := re.search(r"(?<![\w-])-?nan(?!\w)", text): return f"{path.name} contains {found[0]}"
        for path in (folder / "results" / "summary.json", folder / "post" / "summary.json"):
            try: json.loads(path.read_text())
            except (OSError, ValueError) as error: return f"{path.name}: {error}"
        return "" if not full or (folder / "post" / "report.html").exists() else "no report"

    def stages(self, folder, rng):
        """Runs the programs. Returns (stage, code, message, defect); the stage is `done` after all three."""
        full = rng.random() < 0.1
        code, said, error = self.run(folder, "cupola-generate", "case.yaml", "--output", "assembly.vtu")
        if (defect := self.defect_of(code, error)) or code: return "generate", code, error, defect
        if int(said.split()[0].replace(",", "")) > MOST_BLOCKS: return "size", code, error, ""
        code, _, error = self.run(folder, "cupola-solve", "case.yaml", "--assembly", "assembly.vtu", "--output", "results")
        solved = code
        if (defect := self.defect_of(code, error, (0, 2, 3))) or code == 2: return "solve", code, error, defect
        post = ["--assembly", "assembly.vtu", "--results", "results", "--output", "post"] + ([] if full else ["--tables"])
        code, _, error = self.run(folder, "cupola-post", "analyse", "case.yaml", *post)
        if code == 2 and solved == 3 and "found no state" in error: return "unsolved", code, error, ""
        if defect := self.defect_of(code, error, (0,)): return "post", code, error, defect
        return "done", solved, "", self.output_defect(folder, full)

    def pipeline(self, number):
        """One case, reduced until it runs through."""
        rng = random.Random(f"{self.seed}/{number}")
        folder = pathlib.Path(tempfile.mkdtemp(prefix="cupola_random_"))
        for name, text in FILES.items(): (folder / name).write_text(text)
        case, started = self.draw(rng), time.monotonic()
        for attempt in range(60):
            if attempt % 12 == 11: case = self.draw(rng)
            (folder / "case.yaml").write_text(json.dumps(case, indent=1) + "\n")
            for old in ("results", "post"): shutil.rmtree(folder / old, ignore_errors=True)
            stage, code, error, defect = self.stages(folder, rng)
            if defect: self.keep(folder, number, stage, defect, error)
            if stage == "done" or defect: break
            if stage in ("size", "unsolved"):
                case = self.draw(rng)
                continue
            with self.lock: self.refused += 1
            named = re.search(r"error: ([a-z_]+(?:\.[a-z_]+|\[\d*\])*)", error)
            if not (named and remove_key(case, named[1])) :
                optional = [key for key in case if key not in ("geometry", "joints", "analysis")]
                inner = [(part, key) for part in ("geometry", "joints", "analysis") if isinstance(case.get(part), dict)
                         for key in case[part] if (part, key) not in (("geometry", "surface"), ("geometry", "bond"),
                                                                     ("geometry", "import"), ("analysis", "type"))]
                pick = rng.choice(optional + inner) if optional + inner else None
                if pick is None: case = self.draw(rng)
                elif isinstance(pick, tuple): del case[pick[0]][pick[1]]
                else: del case[pick]
        with self.lock:
            if stage == "done":
                self.complete += 1
                self.times.append(time.monotonic() - started)
                ending = (case["analysis"] or {}).get("type", "static") if isinstance(case.get("analysis"), dict) else "static"
                self.endings[ending] = self.endings.get(ending, 0) + 1
                keys = sorted(keys_of(case, self.names))
                for key in keys:
                    if key in self.runs_of_key: self.runs_of_key[key] += 1
                self.pairs |= set(itertools.combinations(keys, 2))
            if self.complete and self.complete % 100 == 0 and stage == "done":
                print(f"{self.complete} pipelines, {self.refused} refusals, {self.defects} defects", flush=True)
        shutil.rmtree(folder)

    def keep(self, folder, number, stage, defect, error):
        kept = pathlib.Path(tempfile.gettempdir()) / f"cupola_random_{self.seed}_{number}"
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(folder, kept, ignore=shutil.ignore_patterns("results", "post"))
        with self.lock: self.defects += 1
        print(f"DEFECT: {stage}: {defect}: {error.strip()[:300]}; kept in {kept}", flush=True)

    def report(self, seconds):
        if not self.times: return print(f"seed {self.seed}: no complete pipeline, {self.refused} refusals, {self.defects} defects")
        reached = sum(count > 0 for count in self.runs_of_key.values())
        all_keys = len(self.runs_of_key)
        self.times.sort()
        print(f"seed {self.seed}: {self.complete} complete pipelines in {seconds:.0f} s (median {self.times[len(self.times) // 2]:.2f} s, "
              f"slowest {self.times[-1]:.1f} s), {self.refused} refusals, each with one line; {self.defects} defects")
        print("analyses: " + ", ".join(f"{count} {name}" for name, count in sorted(self.endings.items(), key=str)))
        print(f"keys that ran: {reached} of {all_keys}; pairs of keys: {len(self.pairs)} of at most {all_keys * (all_keys - 1) // 2}")
        never = [name for name, count in self.runs_of_key.items() if count == 0]
        if never: print(f"never ran: {', '.join(never)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("pipelines", type=int)
    parser.add_argument("--seed", type=int, default=time.time_ns() // 1000000 % 100000000, help="default: new each time")
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    campaign, started = Campaign(asked.bin.resolve(), asked.pipelines, asked.seed), time.monotonic()
    print(f"seed {asked.seed}", flush=True)
    for ending in (signal.SIGINT, signal.SIGTERM): signal.signal(ending, signal.default_int_handler)  # in the background too
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        runs = [pool.submit(campaign.pipeline, number) for number in range(asked.pipelines)]
        try:
            for run in runs: run.result()
        except KeyboardInterrupt:  # of both signals: then the report covers what ran so far
            pool.shutdown(cancel_futures=True)
    campaign.report(time.monotonic() - started)
    return 1 if campaign.defects or campaign.complete < asked.pipelines else 0


if __name__ == "__main__":
    raise SystemExit(main())
