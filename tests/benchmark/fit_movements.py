#!/usr/bin/env python3
"""Finds the movements of the supports of a case that would leave the cracks seen. Needs numpy.
A script, not a study: what it runs next depends on what the last runs gave.

  fit_movements.py BIN_FOLDER CASE.yaml SEEN.csv [--largest METRES] [--reading METRES] [--set key.path=value ...]

SEEN.csv has the columns block_a, block_b and width_m: the widest gap of the joint between two blocks, by their numbers
(docs/columns.md, joints.csv), 0 where the joint was looked at and is closed. Joints that it does not name are not known. CASE is a path
under Coulomb's law; its first supports.moves is replaced. All supports move but the first, which takes away the six rigid motions of
the whole, each by up to LARGEST (0.2 m) along and about the axes; a rotation counts by the displacement that it gives the edge of the
support.

The response to small movements is positively homogeneous but not additive, so that each cause alone is run first, both ways, and scaled
to the widths. From the best of them Gauss-Newton follows, damped, within the bounds; each iterate is a path of its own. Its derivatives
are those at the single cause, which homogeneity makes valid at every scale, and Broyden's updates of them. It prints every local fit
within twice the noise: the error of READING (rounding to 0.5 mm) and what the widths change if friction and stiffness do by a fifth. Of
each fit it prints the movement and, by singular values, which combination of movements the cracks tell least well: by how much it can
change within the noise.
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy

AXES = ("along x", "along y", "along z", "about x", "about y", "about z")
STARTS = 3  # single causes from which a fit starts
ITERATES = 6
FIRST = 0.05  # m, of a single cause
PROBE = 0.005  # m, difference for derivatives


class Model:
    """Runs of a case for given movements of its supports. A movement has six numbers per support but the first, all in metres."""

    def __init__(self, programs, case, settings, work):
        self.programs, self.case, self.settings, self.work = programs, case, settings, work
        self.runs, self.kept, self.values = 0, {}, None
        self.assembly = work / "assembly.vtu"
        self.call("cupola-generate", self.case, "--output", self.assembly, "--export", work / "blocks.json")
        self.supports = self.read_supports()

    def call(self, program, *arguments):
        words = [self.programs / program, *map(str, arguments), "--quiet"]
        words += [word for setting in self.settings for word in ("--set", setting)]
        done = subprocess.run(words, check=False, capture_output=True, text=True)
        if done.returncode not in (0, 3):
            sys.exit(f"{program}: exit code {done.returncode}\n{done.stderr}")

    def read_supports(self):
        """(number, centre of the upper face, half of its longer side) of the supports that move."""
        nodes = json.loads((self.work / "blocks.json").read_text())["data"]["graph"]["data"]["node"]
        supports = []
        for number, node in nodes.items():
            if node["is_support"]:
                points = numpy.array([[v["x"], v["y"], v["z"]] for v in node["block"]["data"]["vertex"].values()])
                low, high = points.min(axis=0), points.max(axis=0)
                supports.append((int(number), 0.5 * (low + high), 0.5 * max(high - low)))
        return supports[1:]

    def moves(self, movement):
        entries = []
        for (number, pivot, reach), six in zip(self.supports, movement.reshape(-1, 6)):
            turn = numpy.degrees(six[3:] / reach)
            numbers = [", ".join(repr(float(x)) for x in three) for three in (six[:3], turn, pivot)]
            entries.append(f"{{blocks: [{number}], displacement: [{numbers[0]}], rotation_deg: [{numbers[1]}], "
                           f"pivot: [{numbers[2]}], time: {{type: ramp}}}}")
        return f"supports.moves=[{', '.join(entries)}]"

    def openings(self, movement, more=()):
        """{(block_a, block_b): widest gap} after the movement; none if the model falls before."""
        key = (*movement.tolist(), *more)
        if key not in self.kept:
            self.kept[key] = self.run(movement, more)
        return self.kept[key]

    def run(self, movement, more):
        self.runs += 1
        results, post = self.work / "results", self.work / "post"
        settings = [word for setting in (self.moves(movement), *more) for word in ("--set", setting)]
        self.call("cupola-solve", self.case, "--assembly", self.assembly, "--output", results, "--threads", 1, *settings)
        if not more:
            self.values = values_of(self)
        if not json.loads((results / "summary.json").read_text())["status"].startswith("stable"):
            return None
        self.call("cupola-post", "analyse", self.case, "--assembly", self.assembly, "--results", results, "--output", post,
                  "--tables", *settings)
        with open(post / "joints.csv", encoding="utf-8") as file:
            return {(int(r["block_a"]), int(r["block_b"])): float(r["opening_m"] or 0.0) for r in csv.DictReader(file)}


class Fit:
    """Least squares of the widths seen."""

    def __init__(self, model, seen, largest):
        self.model, self.largest = model, largest
        self.joints = list(seen)
        self.seen = numpy.array([seen[joint] for joint in self.joints])

    def widths(self, movement, more=()):
        found = self.model.openings(movement, more)
        return None if found is None else numpy.array([max(0.0, found.get(joint, 0.0)) for joint in self.joints])

    def error(self, widths):
        return math.inf if widths is None else float(numpy.sqrt(numpy.mean((widths - self.seen) ** 2)))

    def single_causes(self):
        """(error, scale, movement) along or about one axis, to be scaled to the widths; the best first."""
        found, count = [], 6 * len(self.model.supports)
        for k in range(count):
            for sign in (1.0, -1.0):
                movement = sign * FIRST * numpy.eye(count)[k]
                widths = self.widths(movement)
                if widths is not None and widths.any():
                    scale = min(self.seen @ widths / (widths @ widths), self.largest / FIRST)
                    found.append((self.error(scale * widths), scale, movement))
        return sorted(found, key=lambda one: one[0])

    def jacobian(self, movement, widths):
        columns = []
        for k in range(len(movement)):
            step = PROBE if movement[k] <= 0.0 else -PROBE
            there = self.widths(movement + step * numpy.eye(len(movement))[k])
            columns.append(numpy.zeros_like(widths) if there is None else (there - widths) / step)
        return numpy.array(columns).T

    def gauss_newton(self, scale, cause):
        """(error, movement, derivatives) of a local fit."""
        widths = self.widths(cause)
        derivatives = self.jacobian(cause, widths)
        movement, widths, damping = scale * cause, scale * widths, 1e-2
        for _ in range(ITERATES):
            normal = derivatives.T @ derivatives
            shift = damping * numpy.trace(normal) / len(movement)
            step = numpy.linalg.solve(normal + shift * numpy.eye(len(movement)), derivatives.T @ (self.seen - widths))
            tried = numpy.clip(movement + step, -self.largest, self.largest)
            there = self.widths(tried)
            if there is None:
                damping *= 16.0
                continue
            step = tried - movement
            derivatives = derivatives + numpy.outer(there - widths - derivatives @ step, step) / (step @ step)
            gain = self.error(widths) - self.error(there)
            if gain <= 0.0:
                damping *= 8.0
                continue
            movement, widths, damping = tried, there, damping / 4.0
            if gain < 0.02 * self.error(widths):
                break
        return self.error(self.widths(movement)), movement, derivatives

    def model_error(self, movement):
        """RMS change of the widths if friction and stiffness change by a fifth."""
        here, changes = self.widths(movement), []
        friction, compliance = self.model.values
        for factor in (0.8, 1.2):
            for more in ([f"joints.friction={factor * friction}"],
                         [f"joints.compliance.{side}={factor * value}" for side, value in compliance.items()]):
                there = self.widths(movement, more)
                if there is not None and here is not None:
                    changes.append(self.rms(there - here))
        return self.rms(numpy.array(changes)) if changes else 0.0

    @staticmethod
    def rms(values):
        return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def values_of(model):
    """Friction and compliances in force, from run.yaml."""
    import yaml
    joints = yaml.safe_load((model.work / "results/run.yaml").read_text())["joints"]
    return float(joints["friction"]), {side: float(joints["compliance"][side]) for side in ("normal", "tangential")}  # 2e-8 is text to yaml


def distinct(fits, apart):
    """The fits that differ from better ones."""
    kept = []
    for fit in sorted(fits, key=lambda one: one[0]):
        if all(numpy.linalg.norm(fit[1] - other[1]) > apart for other in kept):
            kept.append(fit)
    return kept


def fits_of(fit, reading):
    """(noise, all local fits, those within the noise)."""
    starts = fit.single_causes()[:STARTS]
    if not starts:
        sys.exit("no single movement of a support leaves an equilibrium with a crack at the joints seen")
    local = distinct([fit.gauss_newton(scale, cause) for _, scale, cause in starts], PROBE)
    noise = math.hypot(reading / math.sqrt(12.0), fit.model_error(local[0][1]))
    return noise, local, [one for one in local if one[0] <= 2.0 * noise]


def in_words(movement, supports):
    return "; ".join(f"support {number}: " + ", ".join(f"{axis} {1000 * x:+.1f} mm" for axis, x in zip(AXES, six))
                     for (number, _, _), six in zip(supports, movement.reshape(-1, 6)))


def weakest(derivatives, noise):
    """The combination that the cracks tell least well, and by how much it can change, m."""
    _, values, directions = numpy.linalg.svd(derivatives, full_matrices=True)
    values = numpy.append(values, numpy.zeros(directions.shape[0] - len(values)))
    least = values[-1]
    return directions[-1], math.inf if least == 0.0 else noise * math.sqrt(derivatives.shape[0]) / least


def read_seen(path):
    with open(path, encoding="utf-8") as file:
        return {tuple(sorted((int(r["block_a"]), int(r["block_b"])))): float(r["width_m"]) for r in csv.DictReader(file)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("seen", type=pathlib.Path)
    parser.add_argument("--largest", type=float, default=0.2)
    parser.add_argument("--reading", type=float, default=0.0005)
    parser.add_argument("--set", nargs="*", default=[], dest="settings")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        model = Model(given.programs, given.case, given.settings, pathlib.Path(folder))
        fit = Fit(model, read_seen(given.seen), given.largest)
        noise, local, within = fits_of(fit, given.reading)
        print(f"{len(local)} local fits after {model.runs} runs; noise {1000 * noise:.2f} mm")
        if not within:
            print("none lies within twice the noise: other causes, or another model. The best:")
        for error, movement, derivatives in within or local[:1]:
            direction, far = weakest(derivatives, noise)
            print(f"error {1000 * error:.2f} mm: {in_words(movement, model.supports)}")
            print(f"  least certain, by {1000 * far:.0f} mm: {in_words(direction * 1e-3, model.supports)} per mm")


if __name__ == "__main__":
    main()
