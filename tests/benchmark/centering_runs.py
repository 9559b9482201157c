"""Runs of one course laid brick by brick, for centering.py. A script, not a study: it reads frames."""

import base64
import csv
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import zlib

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
HEIGHTS = ["h7", "h14", "h17", "h22", "h28", "h32"]
FRICTIONS = [0.0, 0.2, 0.4]
BONDS = {"none": "", "herringbone": "_herringbone"}
REVOLUTION = "none, dome of revolution"
DOME = {"geometry.surface.type": "dome", "geometry.surface.thickness": 0.34, "geometry.surface.crown_angle_deg": 66}
MODELS = {"none": ("none", {}), REVOLUTION: ("none", DOME), "herringbone": ("herringbone", {})}


def run(program, arguments):
    code = subprocess.run([program, *map(str, arguments)], stdout=subprocess.DEVNULL, check=False).returncode
    if code not in (0, 3):
        sys.exit(f"{program} {' '.join(map(str, arguments))}: exit code {code}")


def vtu_integers(path, name):
    """An integer array of a VTK XML file with appended, compressed data."""
    text = path.read_bytes()
    header, data = text.split(b"<AppendedData", 1)
    data = data[data.index(b"_") + 1:]
    attributes = next(m[1] for m in re.finditer(rb"<DataArray([^>]*)>", header) if b'Name="' + name.encode() + b'"' in m[1])
    size, code = (8, "q") if b"Int64" in attributes else (4, "i") if b"Int32" in attributes else (1, "b")
    data = data[int(re.search(rb'offset="(\d+)"', attributes)[1]):]
    word = 8 if b'header_type="UInt64"' in header else 4
    encoded = lambda count: -(-count // 3) * 4
    kind = "Q" if word == 8 else "I"
    blocks = struct.unpack_from("<" + kind, base64.b64decode(data[:encoded(word)]))[0]
    head = base64.b64decode(data[:encoded((3 + blocks) * word)])
    sizes = struct.unpack_from(f"<{blocks}{kind}", head, 3 * word)
    start = encoded((3 + blocks) * word)
    raw, content = base64.b64decode(data[start:start + encoded(sum(sizes))]), b""
    for length in sizes:
        content += zlib.decompress(raw[:length])
        raw = raw[length:]
    return struct.unpack(f"<{len(content) // size}{code}", content)


class Course:
    """The stages that lay the last course of a case with some settings."""

    def __init__(self, bin_folder, work, case, settings=None):
        self.case, self.settings = case, settings or {}
        settings = self.settings
        words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        folder = work / re.sub(r"[^\w.-]+", "", "_".join([case, *(f"{k.split('.')[-1]}{v}" for k, v in settings.items())]))
        if not (folder / "results" / "summary.json").exists():
            folder.mkdir(parents=True, exist_ok=True)
            path = CASES / f"{case}.yaml"
            run(bin_folder / "cupola-generate", [path, "--output", folder / "assembly.vtu", *words])
            run(bin_folder / "cupola-solve", [path, "--assembly", folder / "assembly.vtu", "--output", folder / "results",
                                              "--threads", 1, *words])
        self.folder, self.assembly = folder, folder / "assembly.vtu"
        self.summary = json.loads((folder / "results" / "summary.json").read_text())
        options = (folder / "results" / "run.yaml").read_text()
        self.options = lambda key: float(re.search(rf"^ *{key}: *([-0-9.e]+)", options, re.M)[1])
        stages = list(csv.DictReader((folder / "results" / "construction.csv").open()))
        self.stages = [stage for stage in stages if stage["ring"] == stages[-1]["ring"]]
        failures = folder / "results" / "failures.csv"
        self.failures = list(csv.DictReader(failures.open())) if failures.exists() else []

    @staticmethod
    def least(stage):
        """Pa, values with which the stage moves and stands, 0 and 0 if it stands without cohesion; none if none was found."""
        text = stage["least_stands"]
        return (float(stage["least_moves"] or 0), float(text)) if text else None

    def laid(self):
        """Kinds of the blocks that the stages lay: 0 flat, 1 upright."""
        course = int(self.stages[0]["ring"])
        arrays = zip(vtu_integers(self.assembly, "block_ring"), vtu_integers(self.assembly, "block_kind"))
        return [kind for ring, kind in arrays if ring == course]

    def laying(self, kind):
        """The largest least() of the stages that lay blocks of a kind; none if one was not found."""
        values = [self.least(stage) for stage, laid in zip(self.stages, self.laid(), strict=True) if laid == kind]
        return None if None in values else max(values, key=lambda bracket: bracket[1], default=(0.0, 0.0))

    @property
    def open(self):
        """Pa, with which every stage stands."""
        values = [self.laying(0), self.laying(1)]
        return None if None in values else max(stands for _, stands in values)

    @property
    def closed(self):
        return self.least(self.stages[-1])

    def falling(self):
        """Largest number of bricks of the last course that go at once, of all stages, a little below the least cohesion."""
        count = {}
        for row in self.failures:
            count[row["stage"]] = count.get(row["stage"], 0) + 1
        return max(count.values(), default=0)

    def bed_angle(self):
        radius = self.options("radius_ratio") * self.options("span")
        return math.asin(self.options("height") / radius)

    def free_end(self, friction, courses):
        """Pa: gamma h (sin theta - mu cos theta), for each fresh course."""
        theta = self.bed_angle()
        load = self.options("unit_weight") * self.options("course")
        return max(0.0, courses * load * (math.sin(theta) - friction * math.cos(theta)))


def settings(friction, courses=1, heads=False, below=None, head_friction=0.3):
    """Dry heads of the fresh courses, or heads with the mortar of the beds; `below`: courses solved with the one laid."""
    dry = f"[{{from: {21 - courses}, to: 22, kind: laid_head, friction: {head_friction}, cohesion: 0, tension: 0}}]"
    staged = {"fresh.friction": friction, "fresh.courses": courses, "fresh.heads": str(heads).lower(),
              "hold_below": courses - 1 if below is None else below}
    return {**{f"analysis.staged.{key}": value for key, value in staged.items()}, "joints.rings": dry}


class Study:
    def __init__(self, bin_folder, work):
        self.bin, self.work = bin_folder, work

    def course(self, height, model, friction, bond=None, at_once=False, **mortar):
        """`at_once`: only the last stage, the closed course."""
        pattern, shape = MODELS[model]
        return Course(self.bin, self.work, f"centering_{height}{BONDS[pattern]}",
                      {**settings(friction, **mortar), **shape, **{f"geometry.bond.{key}": value for key, value in (bond or {}).items()},
                       **({"analysis.staged.unit": "ring"} if at_once else {})})
