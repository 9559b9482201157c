"""One course laid without centering, brick by brick. Prints a CSV table.
A script, not a study: it compares runs with closed forms and with each other.

  centering.py BIN_FOLDER WORK_FOLDER runs       makes the runs of the tables, as many at once as there are processors
  centering.py BIN_FOLDER WORK_FOLDER map        least fresh cohesion over height, bond and bed friction
  centering.py BIN_FOLDER WORK_FOLDER fresh      the same with three fresh courses, and with rougher heads
  centering.py BIN_FOLDER WORK_FOLDER spirals    the same over the distance and the embedment of the uprights
  centering.py BIN_FOLDER WORK_FOLDER hands      the same over the hand of the spirals, at one height
  centering.py BIN_FOLDER WORK_FOLDER mortar     the same with mortar in the heads, at one height
  centering.py BIN_FOLDER WORK_FOLDER curing     the same with mortar that hardens from course to course, at one height
  centering.py BIN_FOLDER WORK_FOLDER arch       the force along a course between uprights, laid without cohesion
  centering.py BIN_FOLDER WORK_FOLDER figures    draws the map and a flat arch into docs/pictures, by gnuplot
  centering.py BIN_FOLDER WORK_FOLDER nubian     a Nubian course against the closed form
  centering.py BIN_FOLDER WORK_FOLDER verdicts   the conjectures of the paper, judged by the runs of map
  centering.py BIN_FOLDER WORK_FOLDER heights    height up to which a course can be laid, over the cohesion of fresh mortar

Finished runs in WORK_FOLDER are used again. Least cohesions in kPa are brackets, from the value with which the course moves to that with
which it stands: of the most demanding stage that lays a flat brick or a new upright, and `closed` of the last stage, in which
every run of bricks abuts on uprights or on the sails beyond the corners.
"""

import concurrent.futures
import csv
import math
import os
import pathlib
import subprocess
import sys

from centering_runs import BONDS, CASES, Course, FRICTIONS, HEIGHTS, MODELS, REVOLUTION, Study, run, settings, vtu_integers


def kpa(value):
    return "not found" if value is None else "0" if value == 0 else f"{value / 1000:.3f}"


def stands(least):
    """Pa: upper end of a bracket"""
    return None if least is None else least[1]


def bracket(least):
    """kPa"""
    if least is None:
        return "not found"
    return "0" if stands(least) == 0 else f"{least[0] / 1000:.3f} to {least[1] / 1000:.3f}"


def needs(course):
    """Brackets of laying a flat brick, laying an upright, and the closed course."""
    return [bracket(course.laying(0)), bracket(course.laying(1)) if 1 in course.laid() else "", bracket(course.closed)]


NEEDS = ["laying a flat brick", "laying an upright", "closed"]
RESULTS = ["free end by hand", *NEEDS, "bricks that go at once"]


def results(course, friction):
    return [kpa(course.free_end(friction, 1)), *needs(course), course.falling()]


def name_of(model):
    return model.replace("herringbone", "spirals")


# The runs of each table: positional and named arguments of Study.course().
def request(*arguments, **more):
    return arguments, more


MAP = [request(height, model, friction) for height in HEIGHTS for model in MODELS for friction in FRICTIONS]
OTHER_MORTAR = [{"courses": 3}, {"head_friction": 0.6}]
FRESH = [request(height, model, friction, **mortar) for height in HEIGHTS for model in BONDS for friction in FRICTIONS
         for mortar in OTHER_MORTAR]
MORTAR = [request("h22", model, 0.2, courses=courses, heads=heads, below=below) for model in BONDS
          for courses, heads, below in ((1, False, 0), (1, False, 2), (3, False, 2), (1, True, 0), (3, True, 2))]


def bond_of(spirals, embedment, hand=None):
    return {"spirals": spirals, "embedment": embedment, "beside": "half", **({"chirality": hand} if hand else {})}


BONDS_OF_SPIRALS = [(height, bond_of(spirals, embedment)) for height in HEIGHTS
                    for spirals in ((2, 3) if height == "h32" else (5, 10)) for embedment in (-1, 0, 1, 2)]
HANDS = [("right", bond_of(10, -1)), ("left", bond_of(10, -1, "left")), ("both", bond_of(5, -1, "both"))]


CURING = {15: "15 minutes", 30: "30 minutes", 60: "60 minutes", 4 * 1440: "4 days"}  # a course


def spiral_requests(height, bond):
    """One fresh course laid brick by brick; the same course closed, three fresh ones; on beds of friction 0.2."""
    return [request(height, "herringbone", 0.2, bond=bond), request(height, "herringbone", 0.2, bond=bond, at_once=True, courses=3)]


def make_runs(study):
    spirals = [one for height, bond in BONDS_OF_SPIRALS for one in spiral_requests(height, bond)]
    hands = [request("h22", "herringbone", 0.2, bond=bond) for _, bond in HANDS]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        done = [pool.submit(study.course, *arguments, **more) for arguments, more in [*MAP, *FRESH, *MORTAR, *spirals, *hands]]
        done += [pool.submit(curing_course, study, minutes) for minutes in CURING]
        for run_of in done:
            run_of.result()


def map_runs(study, requests=MAP):
    """(height, model, friction, course) of every run of the map, or of other runs."""
    for arguments, mortar in requests:
        course = study.course(*arguments, **mortar)
        yield course.options("height"), arguments[1], arguments[2], course


def write_map(study):
    out = csv.writer(sys.stdout)
    out.writerow(["height, m", "herringbone", "bed friction", *RESULTS])
    for height, model, friction, course in map_runs(study):
        out.writerow([f"{height:g}", name_of(model), friction, *results(course, friction)])


def write_fresh(study):
    out = csv.writer(sys.stdout)
    out.writerow(["height, m", "herringbone", "bed friction", *(f"three fresh courses, {need}" for need in NEEDS),
                  *(f"friction 0.6 in the heads, {need}" for need in NEEDS)])
    for height in HEIGHTS:
        for model in BONDS:
            for friction in FRICTIONS:
                courses = [study.course(height, model, friction, **mortar) for mortar in OTHER_MORTAR]
                out.writerow([f"{courses[0].options('height'):g}", name_of(model), friction,
                              *(need for course in courses for need in needs(course))])


def write_mortar(study):
    out = csv.writer(sys.stdout)
    out.writerow(["herringbone", "fresh courses", "heads", "courses solved below", *RESULTS])
    for arguments, mortar in MORTAR:
        course = study.course(*arguments, **mortar)
        out.writerow([name_of(arguments[1]), mortar["courses"], "mortar" if mortar["heads"] else "dry", mortar["below"],
                      *results(course, 0.2)])


def write_spirals(study):
    out = csv.writer(sys.stdout)
    out.writerow(["height, m", "spirals", "uprights of a spiral in a course", *RESULTS[:-1], "closed, three fresh courses",
                  RESULTS[-1]])
    for height, bond in BONDS_OF_SPIRALS:
        laid, three = (study.course(*arguments, **more) for arguments, more in spiral_requests(height, bond))
        embedment = bond["embedment"]
        out.writerow([f"{laid.options('height'):g}", bond["spirals"],
                      "three: 0, 6 and 12 cm deep" if embedment < 0 else f"one, {6 * embedment} cm deep", kpa(laid.free_end(0.2, 1)),
                      *needs(laid), bracket(three.closed), laid.falling()])


def write_hands(study):
    out = csv.writer(sys.stdout)
    out.writerow(["hand", "spirals", *RESULTS])
    for hand, bond in HANDS:
        out.writerow([hand, bond["spirals"], *results(study.course("h22", "herringbone", 0.2, bond=bond), 0.2)])


def curing_course(study, minutes):
    return Course(study.bin, study.work, "centering_h17_curing", {"analysis.staged.days_per_course": f"{minutes / 1440:.6f}"})


def write_curing(study):
    out = csv.writer(sys.stdout)
    out.writerow(["a course every", *NEEDS[::2]])
    for minutes, pace in CURING.items():
        course = curing_course(study, minutes)
        out.writerow([pace, bracket(course.laying(0)), bracket(course.closed)])


def write_nubian(study):
    out = csv.writer(sys.stdout)
    out.writerow(["bed angle, deg", "bed friction", "closed form, kPa", "least cohesion, kPa", "difference, %"])
    for angle in (65.0, 67.5, 70.0):
        for friction in (0.0, 0.2):
            course = Course(study.bin, study.work, "centering_nubian",
                            {"geometry.window.height": f"{1.5 * math.sin(math.radians(angle)):.9f}",
                             "analysis.staged.fresh.friction": friction})
            expected, found = course.free_end(friction, 1), course.open
            out.writerow([angle, friction, kpa(expected), bracket(course.laying(0)), f"{100 * (found / expected - 1):.2f}"])


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


HERRINGBONE = "certainly the herringbone will play the decisive role in preventing the sliding of the bricks"
RING = "Building without falsework was possible for a dome of revolution; constructed by layering one ring on the other"


def write_verdicts(study):
    """The herringbone is called decisive if it halves the cohesion that the course needs, at every friction of the map."""
    out = csv.writer(sys.stdout)
    out.writerow(["sentence of the paper", "mortar", "verdict", "share, a brick being laid: smallest and largest over the heights",
                  "share, closed, by height"])
    one, (three, rough) = MAP, ([one for one in FRESH if one[1] == mortar] for mortar in OTHER_MORTAR)
    for sentence, mortar, requests, model, without, held in (
            (HERRINGBONE, "one fresh course, head friction 0.3", one, "herringbone", "none", "of a run are held until it is closed"),
            (HERRINGBONE, "one fresh course, head friction 0.6", rough, "herringbone", "none", "of a run are held until it is closed"),
            (HERRINGBONE, "three fresh courses, head friction 0.3", three, "herringbone", "none", "of a run are held until it is closed"),
            (RING, "one fresh course, head friction 0.3", one, REVOLUTION, REVOLUTION, "are held until the ring is closed")):
        runs = list(map_runs(study, requests))
        opened, closed = (shares(runs, model, without, value)
                          for value in (lambda course: course.open, lambda course: stands(course.closed)))
        out.writerow([sentence, mortar, verdict(opened, closed, held), f"{min(opened.values()):.2f} to {max(opened.values()):.2f}",
                      "; ".join(f"{height:g} m: {share:.2f}" for height, share in sorted(closed.items()))])


def height_reached(points, cohesion):
    """Height at which the need rises above a cohesion, between the heights of the cases; none if it does not."""
    for (z, need), (next_z, next_need) in zip(points, points[1:]):
        if need <= cohesion < next_need:
            return f"{z + (cohesion - need) / (next_need - need) * (next_z - z):.1f}"
    return f"below {points[0][0]:g}" if points[0][1] > cohesion else f"above {points[-1][0]:g}"


def write_heights(study):
    runs = list(map_runs(study))
    out = csv.writer(sys.stdout)
    out.writerow(["fresh cohesion, kPa", "bed friction", "without herringbones, m", "with, laying flat bricks, m",
                  "with, laying uprights, m", "with, every run held until it is closed, m"])
    columns = (("none", lambda course: course.open), ("herringbone", lambda course: stands(course.laying(0))),
               ("herringbone", lambda course: stands(course.laying(1))), ("herringbone", lambda course: stands(course.closed)))
    for cohesion in (300.0, 500.0, 1000.0):
        for friction in FRICTIONS:
            cells = []
            for wanted, need in columns:
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
    """One panel per bed friction."""
    runs = list(map_runs(study))
    missing = lambda value: "NaN" if value is None else value / 1000
    data, panels = {}, ""
    for number, friction in enumerate(FRICTIONS):
        at = [(height, model, course) for height, model, mu, course in runs if mu == friction]
        data[f"none{number}"] = [(height, missing(course.open), course.free_end(friction, 1) / 1000, missing(stands(course.closed)))
                                 for height, model, course in at if model == "none"]
        data[f"spirals{number}"] = [(height, *(missing(stands(need)) for need in (course.laying(0), course.laying(1), course.closed)))
                                    for height, model, course in at if model == "herringbone"]
        panels += f"""
set title 'bed friction {friction}'
{"set key left top" if number == len(FRICTIONS) - 1 else "unset key"}
{"set ylabel 'least cohesion of the fresh mortar, kPa'" if number == 0 else "unset ylabel"}
plot $none{number} using 1:3 with lines lc rgb '#888888' dt 2 title 'a brick with a free end, by hand', \\
     $none{number} using 1:2 with linespoints lc rgb '#1f3f66' pt 7 title 'no herringbones, laying', \\
     $none{number} using 1:4 with linespoints lc rgb '#6f9fd8' pt 6 title 'no herringbones, closed', \\
     $spirals{number} using 1:2 with linespoints lc rgb '#d9784b' pt 5 title 'spirals, laying a flat brick', \\
     $spirals{number} using 1:3 with linespoints lc rgb '#8c4a2f' pt 9 title 'spirals, laying an upright', \\
     $spirals{number} using 1:4 with linespoints lc rgb '#3a8a4a' pt 11 title 'spirals, closed'
"""
    plot(picture, "1200,480", """
set xlabel 'height above the springing, m'
set xrange [5:34]
set yrange [0:3]
set grid
set multiplot layout 1,3
""" + panels + "unset multiplot\n", data)


def write_figures(study):
    draw_map(study, CASES.parent / "docs" / "pictures" / "centering_map.png")


TABLES = {"runs": make_runs, "map": write_map, "fresh": write_fresh, "spirals": write_spirals, "hands": write_hands,
          "mortar": write_mortar, "curing": write_curing, "arch": write_arch, "figures": write_figures, "nubian": write_nubian,
          "verdicts": write_verdicts, "heights": write_heights}

if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[3] not in TABLES:
        sys.exit(__doc__)
    TABLES[sys.argv[3]](Study(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
