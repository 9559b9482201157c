"""One course laid without centering, brick by brick. Prints a CSV table.

  centering.py BIN_FOLDER WORK_FOLDER map        least fresh cohesion over height, bond and bed friction
  centering.py BIN_FOLDER WORK_FOLDER mortar     the same with three fresh courses, and with mortar in the heads
  centering.py BIN_FOLDER WORK_FOLDER spirals    the same over the distance and the embedment of the uprights, at one height
  centering.py BIN_FOLDER WORK_FOLDER arch       the force along a course between uprights, laid without cohesion
  centering.py BIN_FOLDER WORK_FOLDER figures    draws the map and a flat arch into docs/pictures, by gnuplot
  centering.py BIN_FOLDER WORK_FOLDER nubian     a Nubian course against the closed form
  centering.py BIN_FOLDER WORK_FOLDER verdicts   the conjectures of the paper, judged by the runs of map
  centering.py BIN_FOLDER WORK_FOLDER heights    height up to which a course can be laid, over the cohesion of fresh mortar

Finished runs in WORK_FOLDER are used again. Least cohesions in kPa: of the most demanding stage that lays a flat brick or a
new upright, and `closed` of the last stage, in which every run of bricks abuts on uprights or on the sails beyond the corners.
"""

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
    """The stages of the last course of a case with some settings."""

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
        self.stages = list(csv.DictReader((folder / "results" / "construction.csv").open()))
        failures = folder / "results" / "failures.csv"
        self.failures = list(csv.DictReader(failures.open())) if failures.exists() else []

    def least(self, stage):
        """Pa; none if the search found no value."""
        text = stage["least_stands"]
        return float(text) if text else None

    def laid(self):
        """Kinds of the blocks that the stages lay: 0 flat, 1 upright."""
        course = int(self.stages[0]["ring"])
        arrays = zip(vtu_integers(self.assembly, "block_ring"), vtu_integers(self.assembly, "block_kind"))
        return [kind for ring, kind in arrays if ring == course]

    def laying(self, kind):
        """Pa: largest least cohesion of the stages that lay blocks of a kind; none if one was not found."""
        values = [self.least(stage) for stage, laid in zip(self.stages, self.laid(), strict=True) if laid == kind]
        return None if None in values else max(values, default=0.0)

    @property
    def open(self):
        values = [self.laying(0), self.laying(1)]
        return None if None in values else max(values)

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


def settings(friction, courses=1, heads=False, below=None):
    """Dry heads of the fresh courses, or heads with the mortar of the beds; `below`: courses solved with the one laid."""
    dry = f"[{{from: {21 - courses}, to: 22, kind: laid_head, friction: 0.3, cohesion: 0, tension: 0}}]"
    staged = {"fresh.friction": friction, "fresh.courses": courses, "fresh.heads": str(heads).lower(),
              "hold_below": courses - 1 if below is None else below}
    return {**{f"analysis.staged.{key}": value for key, value in staged.items()}, "joints.rings": dry}


class Study:
    def __init__(self, bin_folder, work):
        self.bin, self.work = bin_folder, work

    def course(self, height, model, *mortar, **more):
        bond, shape = MODELS[model]
        return Course(self.bin, self.work, f"centering_{height}{BONDS[bond]}",
                      {**settings(*mortar), **shape, **{f"geometry.bond.{key}": value for key, value in more.items()}})

    def map(self):
        """(height, model, friction, course) of every run of the map."""
        for height in HEIGHTS:
            for model in MODELS:
                for friction in FRICTIONS:
                    course = self.course(height, model, friction)
                    yield course.options("height"), model, friction, course


def kpa(value):
    return "not found" if value is None else f"{value / 1000:.3f}"


RESULTS = ["free end by hand", "laying a flat brick", "laying an upright", "closed", "bricks that go at once"]


def results(course, friction):
    upright = kpa(course.laying(1)) if 1 in course.laid() else ""
    return [kpa(course.free_end(friction, 1)), kpa(course.laying(0)), upright, kpa(course.closed), course.falling()]


def write_map(study):
    out = csv.writer(sys.stdout)
    out.writerow(["height, m", "herringbone", "bed friction", *RESULTS])
    for height, model, friction, course in study.map():
        out.writerow([f"{height:g}", model.replace("herringbone", "spirals"), friction, *results(course, friction)])


def write_mortar(study):
    out = csv.writer(sys.stdout)
    out.writerow(["bond", "fresh courses", "heads", "courses solved below", *RESULTS])
    for bond in BONDS:
        for courses, heads, below in ((1, False, 0), (1, False, 2), (3, False, 2), (1, True, 0), (3, True, 2)):
            course = study.course("h22", bond, 0.2, courses, heads, below)
            out.writerow([bond, courses, "mortar" if heads else "dry", below, *results(course, 0.2)])


def write_spirals(study):
    out = csv.writer(sys.stdout)
    out.writerow(["spirals", "hand", "uprights of a spiral in a course", *RESULTS])
    rows = [(spirals, "right", embedment) for spirals in (5, 10) for embedment in (-1, 0, 1, 2)]
    for spirals, hand, embedment in rows + [(10, "left", -1), (5, "both", -1)]:
        more = {} if hand == "right" else {"chirality": hand}
        course = study.course("h22", "herringbone", 0.2, spirals=spirals, embedment=embedment, beside="half", **more)
        name = "three: 0, 6 and 12 cm deep" if embedment < 0 else f"one, {6 * embedment} cm deep"
        out.writerow([spirals, hand, name, *results(course, 0.2)])


def write_nubian(study):
    out = csv.writer(sys.stdout)
    out.writerow(["bed angle, deg", "bed friction", "closed form, kPa", "least cohesion, kPa", "difference, %"])
    for angle in (65.0, 67.5, 70.0):
        for friction in (0.0, 0.2):
            course = Course(study.bin, study.work, "centering_nubian",
                            {"geometry.window.height": f"{1.5 * math.sin(math.radians(angle)):.9f}",
                             "analysis.staged.fresh.friction": friction})
            expected, found = course.free_end(friction, 1), course.open
            out.writerow([angle, friction, kpa(expected), kpa(found), f"{100 * (found / expected - 1):.2f}"])


def shares(runs, model, without, value):
    """Per height: largest ratio of a cohesion to the one that the open course of the model `without` needs, over the frictions."""
    without = {(height, friction): course.open for height, other, friction, course in runs if other == without}
    found = {}
    for height, other, friction, course in runs:
        if other == model and without[height, friction]:
            need = value(course)
            share = math.inf if need is None else need / without[height, friction]
            found[height] = max(found.get(height, 0.0), share)
    return found


def lowest_decisive(found):
    """Lowest height from which on all shares are at most a half; none if that of the highest is not."""
    lowest = None
    for height in sorted(found, reverse=True):
        if found[height] > 0.5:
            break
        lowest = height
    return lowest


def verdict(while_open, closed, held):
    for found, condition in ((while_open, ""), (closed, f"if the bricks {held}")):
        lowest = lowest_decisive(found)
        if lowest is None:
            continue
        where = "" if lowest == min(found) else f"from {lowest:g} m on"
        limits = " and ".join(part for part in (where, condition) if part)
        return f"true only {limits}" if limits else "reproduced"
    return "not reproduced"


def write_verdicts(study):
    """The herringbone is called decisive if it halves the cohesion that the course needs, at every friction of the map."""
    runs = list(study.map())
    out = csv.writer(sys.stdout)
    out.writerow(["sentence of the paper", "verdict", "share, a brick being laid: smallest and largest over the heights",
                  "share, closed, by height"])
    for sentence, model, without, held in (
            ("certainly the herringbone will play the decisive role in preventing the sliding of the bricks", "herringbone",
             "none", "of a run are held until it is closed"),
            ("Building without falsework was possible for a dome of revolution; constructed by layering one ring on the other",
             REVOLUTION, REVOLUTION, "are held until the ring is closed")):
        opened, closed = (shares(runs, model, without, value)
                          for value in (lambda course: course.open, lambda course: course.closed))
        out.writerow([sentence, verdict(opened, closed, held), f"{min(opened.values()):.2f} to {max(opened.values()):.2f}",
                      "; ".join(f"{height:g} m: {share:.2f}" for height, share in sorted(closed.items()))])


def height_reached(points, cohesion):
    """Height at which the need rises above a cohesion, between the heights of the cases; none if it does not."""
    for (z, need), (next_z, next_need) in zip(points, points[1:]):
        if need <= cohesion < next_need:
            return f"{z + (cohesion - need) / (next_need - need) * (next_z - z):.1f}"
    return f"below {points[0][0]:g}" if points[0][1] > cohesion else f"above {points[-1][0]:g}"


def write_heights(study):
    runs = list(study.map())
    out = csv.writer(sys.stdout)
    out.writerow(["fresh cohesion, kPa", "bed friction", "without herringbones, m", "with, laying flat bricks, m",
                  "with, laying uprights, m", "with, every run held until it is closed, m"])
    needs = (("none", lambda course: course.open), ("herringbone", lambda course: course.laying(0)),
             ("herringbone", lambda course: course.laying(1)), ("herringbone", lambda course: course.closed))
    for cohesion in (300.0, 500.0, 1000.0):
        for friction in FRICTIONS:
            cells = []
            for wanted, need in needs:
                points = [(height, need(course)) for height, model, mu, course in runs if (model, mu) == (wanted, friction)]
                cells.append("not found" if None in (p[1] for p in points) else height_reached(points, cohesion))
            out.writerow([cohesion / 1000, friction, *cells])


ONCE = {"analysis.staged.unit": "ring", "analysis.staged.least": "none", "analysis.staged.fresh.cohesion": 0,
        "analysis.staged.carry": "true"}  # the course is laid at once, in mortar without cohesion


class FlatArch:
    """The heads of the flat bricks of one run between two uprights, nearest to the middle of the sail, from right to left."""

    def __init__(self, study, height, friction):
        self.course = course = Course(study.bin, study.work, f"centering_{height}_herringbone", {**settings(friction), **ONCE})
        post = course.folder / "post"
        if not (post / "joints.csv").exists():
            words = [word for key, value in course.settings.items() for word in ("--set", f"{key}={value}")]
            run(study.bin / "cupola-post", ["analyse", CASES / f"{course.case}.yaml", "--assembly", course.assembly, "--results",
                                            course.folder / "results", "--output", post, "--tables", *words])
        kind, ring = (vtu_integers(course.assembly, name) for name in ("block_kind", "block_ring"))
        laid = max(ring)
        flat = lambda block: kind[int(block)] == 0 and ring[int(block)] == laid
        upright = lambda block: kind[int(block)] == 1
        runs, heads = [], []
        joints = [row for row in csv.DictReader((post / "joints.csv").open())
                  if row["kind"] == "head" and (flat(row["block_a"]) or flat(row["block_b"]))]
        for row in sorted(joints, key=self.azimuth):
            heads.append(row)
            if upright(row["block_a"]) or upright(row["block_b"]):
                if len(heads) > 1 and (upright(heads[0]["block_a"]) or upright(heads[0]["block_b"])):
                    runs.append(heads)
                heads = [] if len(heads) > 1 else heads
        self.heads = min(runs, key=lambda run: abs(self.azimuth(run[0]) + self.azimuth(run[-1]) - math.pi / 4))

    @staticmethod
    def azimuth(row):
        return math.atan2(float(row["y_m"]), float(row["x_m"]))

    @staticmethod
    def axis_distance(row):
        return math.hypot(float(row["x_m"]), float(row["y_m"]))

    def thrust(self):
        """N: mean of the normal forces of the heads."""
        return sum(float(row["normal_force_N"]) for row in self.heads) / len(self.heads)

    def length(self):
        return (self.azimuth(self.heads[-1]) - self.azimuth(self.heads[0])) * self.axis_distance(self.heads[0])

    def by_hand(self, friction, head_friction=0.3):
        """N: force that the flat arch needs, and that of a ring of this radius without uprights."""
        theta, depth = self.course.bed_angle(), self.course.options("thickness")
        load = self.course.options("unit_weight") * depth * self.course.options("course")
        load *= math.sin(theta) - friction * math.cos(theta)
        bend = (math.cos(theta) + friction * math.sin(theta)) / self.axis_distance(self.heads[0])
        length = self.length()
        return load / (bend + min(2 * head_friction / length, 8 * depth / length ** 2)), load / bend


def write_arch(study):
    out = csv.writer(sys.stdout)
    out.writerow(["height, m", "clear length, m", "status", "force along the course, N", "needed by hand, N",
                  "ring without uprights by hand, N"])
    for height in HEIGHTS[1:]:
        arch = FlatArch(study, height, 0.2)
        out.writerow([f"{arch.course.options('height'):g}", f"{arch.length():.2f}", arch.course.summary["status"],
                      f"{arch.thrust():.0f}", *(f"{force:.0f}" for force in arch.by_hand(0.2))])


def plot(picture, size, commands, data):
    """Runs gnuplot with named inline tables."""
    tables = "".join(f"${name} << EOD\n" + "\n".join(" ".join(map(str, row)) for row in rows) + "\nEOD\n"
                     for name, rows in data.items())
    script = f"set terminal pngcairo size {size} font 'Helvetica,11' background 'white'\nset output '{picture}'\n"
    subprocess.run(["gnuplot"], input=script + tables + commands, text=True, check=True)


def draw_map(study, picture):
    runs = [(height, model, course) for height, model, friction, course in study.map() if friction == 0.2]
    missing = lambda value: "NaN" if value is None else value / 1000
    data = {"none": [(height, missing(course.open), course.free_end(0.2, 1) / 1000) for height, model, course in runs
                     if model == "none"],
            "spirals": [(height, missing(course.laying(0)), missing(course.laying(1)), missing(course.closed))
                        for height, model, course in runs if model == "herringbone"]}
    plot(picture, "900,560", """
set xlabel 'height above the springing, m'
set ylabel 'least cohesion of the fresh mortar, kPa'
set yrange [0:*]
set key left top
set grid
plot $none using 1:3 with lines lc rgb '#888888' dt 2 title 'a brick with a free end, by hand', \\
     $none using 1:2 with linespoints lc rgb '#1f3f66' pt 7 title 'without herringbones, open', \\
     $spirals using 1:2 with linespoints lc rgb '#d9784b' pt 5 title 'with, laying a flat brick', \\
     $spirals using 1:3 with linespoints lc rgb '#8c4a2f' pt 9 title 'with, laying an upright', \\
     $spirals using 1:4 with linespoints lc rgb '#3a8a4a' pt 11 title 'with, every run closed'
""", data)


def draw_arch(study, picture):
    """The centres of pressure of the heads over the depth of the course, m; a brick is straight between two heads."""
    arch = FlatArch(study, "h22", 0.2)
    half, radius = math.pi / 8, arch.course.options("radius_ratio") * arch.course.options("span")
    offset = radius - arch.course.options("span") / 2
    points = []
    for row in arch.heads:
        x, y, z = (float(row[key]) for key in ("x_m", "y_m", "z_m"))
        corner = (x * math.cos(half) + y * math.sin(half)) / math.cos(half)  # distance from the axis at the corner
        tau = math.atan2(z, corner + offset)
        gradient = math.hypot(math.cos(tau) / math.cos(half), math.sin(tau))
        points.append(((arch.azimuth(row) - arch.azimuth(arch.heads[0])) * arch.axis_distance(row),
                       (math.hypot(corner + offset, z) - radius) / gradient, float(row["normal_force_N"])))
    depth = arch.course.options("thickness")
    plot(picture, "900,420", f"""
set xlabel 'along the course, m'
set ylabel 'from the intrados, m'
set xrange [-0.1:{arch.length() + 0.1}]
set yrange [-0.06:{depth + 0.06}]
set size ratio -1
unset key
set object 1 rectangle from -0.06,0 to 0,{depth} fc rgb '#d9784b'
set object 2 rectangle from {arch.length()},0 to {arch.length() + 0.06},{depth} fc rgb '#d9784b'
plot $heads using 1:(0):(0):({depth}) with vectors nohead lc rgb '#3a3a3a', \\
     [0:{arch.length()}] 0 lc rgb '#3a3a3a', {depth} lc rgb '#3a3a3a', \\
     $heads using 1:2 with linespoints lc rgb '#1f3f66' lw 2 pt 7, \\
     $heads using 1:($2+0.03):(sprintf('%.0f N', $3)) with labels
""", {"heads": points})


def write_figures(study):
    pictures = CASES.parent / "docs" / "pictures"
    draw_map(study, pictures / "centering_map.png")
    draw_arch(study, pictures / "centering_arch.png")


TABLES = {"map": write_map, "mortar": write_mortar, "spirals": write_spirals, "arch": write_arch, "figures": write_figures,
          "nubian": write_nubian, "verdicts": write_verdicts, "heights": write_heights}

if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[3] not in TABLES:
        sys.exit(__doc__)
    TABLES[sys.argv[3]](Study(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
