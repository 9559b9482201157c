#!/usr/bin/env python3
"""Finds the movements of the supports of a case that would leave the cracks seen. Needs numpy.
A script, not a study: what it runs next depends on what the last runs gave.

  fit_movements.py BIN_FOLDER CASE.yaml SEEN.csv [--largest METRES] [--reading METRES] [--set key.path=value ...]

SEEN.csv has the columns block_a, block_b and width_m: the widest gap of the joint between two blocks, by their numbers
(docs/columns.md, joints.csv), 0 where the joint was looked at and is closed. Joints that it does not name are not known. CASE is a path
under Coulomb's law; its first supports.moves is replaced. All supports move but the first, which takes away the six rigid motions of
the whole, each by up to LARGEST (0.2 m) along and about the axes; a rotation counts by the displacement that it gives the edge of the
support. Friction and stiffness are fitted with them, as factors of 1 with a standard deviation of a fifth.

The response to small movements is positively homogeneous but not additive, so that each cause alone is run first, both ways, and scaled
to the widths. From the best of them Gauss-Newton follows, damped, within the bounds, with derivatives from paths run anew at each
iterate; where none of the first starts leads to a fit, the next ones are tried. It prints every local fit within twice the noise: the
error of READING (rounding to 0.5 mm) and what the widths change in half as long steps. Of each fit it prints the movement and the
combination of movements that the cracks tell least well: by how much it can change within the noise.
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
STARTS, MOST_STARTS = 3, 6  # single causes from which fits start, and if none of them fits
ITERATES = 8
FIRST = 0.05  # m, of a single cause
PROBE = 0.005  # m, difference for derivatives
WIDTH = 0.001  # m, of a width, counts like one standard deviation of a factor
FACTOR = 0.2  # standard deviation of the logarithms of friction and stiffness
SCALE = 0.1  # m of a movement, of the size of one standard deviation of a factor


class Model:
    """Runs of a case for given movements of its supports. A movement has six numbers per support but the first, all in metres."""

    def __init__(self, programs, case, settings, work):
        self.programs, self.case, self.settings, self.work = programs, case, settings, work
        self.runs, self.kept, self.values, self.steps = 0, {}, None, 0
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

    def factors(self, two):
        """Settings for friction and stiffness, which are `two` standard deviations off."""
        if not any(two):
            return []
        friction, stiffness = numpy.exp(FACTOR * numpy.asarray(two))
        return [f"joints.friction={self.values[0] * friction}"] + [f"joints.compliance.{side}={value / stiffness}"
                                                                   for side, value in self.values[1].items()]

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
        if not self.values:
            *self.values, self.steps = values_of(self)
        if not json.loads((results / "summary.json").read_text())["status"].startswith("stable"):
            return None
        self.call("cupola-post", "analyse", self.case, "--assembly", self.assembly, "--results", results, "--output", post,
                  "--tables", *settings)
        with open(post / "joints.csv", encoding="utf-8") as file:
            return {(int(r["block_a"]), int(r["block_b"])): float(r["opening_m"] or 0.0) for r in csv.DictReader(file)}


class Fit:
    """Least squares of the widths seen. A point is a movement and SCALE times the deviations of friction and stiffness, all in metres."""

    def __init__(self, model, seen, largest):
        self.model, self.largest = model, largest
        self.joints = list(seen)
        self.seen = numpy.array([seen[joint] for joint in self.joints])

    def widths(self, movement, more=()):
        found = self.model.openings(movement, more)
        return None if found is None else numpy.array([max(0.0, found.get(joint, 0.0)) for joint in self.joints])

    def residuals(self, point):
        widths = self.widths(point[:-2], self.model.factors(point[-2:] / SCALE))
        return None if widths is None else numpy.concatenate([(widths - self.seen) / WIDTH, point[-2:] / SCALE])

    def error(self, residuals):
        """Of the widths, m."""
        return WIDTH * self.rms(residuals[:-2])

    def single_causes(self):
        """(error, movement) along or about one axis, scaled to the widths; the best first."""
        found, count = [], 6 * len(self.model.supports)
        for k in range(count):
            for sign in (1.0, -1.0):
                movement = sign * FIRST * numpy.eye(count)[k]
                widths = self.widths(movement)
                if widths is not None and widths.any():
                    scale = min(self.seen @ widths / (widths @ widths), self.largest / FIRST)
                    found.append((self.rms(scale * widths - self.seen), scale * movement))
        return sorted(found, key=lambda one: one[0])

    def jacobian(self, point, residuals):
        columns = []
        for k in range(len(point)):
            step = PROBE if point[k] <= 0.0 else -PROBE
            there = self.residuals(point + step * numpy.eye(len(point))[k])
            columns.append(numpy.zeros_like(residuals) if there is None else (there - residuals) / step)
        return numpy.array(columns).T

    def within_bounds(self, point):
        return numpy.concatenate([numpy.clip(point[:-2], -self.largest, self.largest),
                                  numpy.clip(point[-2:], -1.5 * SCALE, 1.5 * SCALE)])

    def gauss_newton(self, cause):
        """(sum of squares, error, point, derivatives) of a local fit; none if the model falls under its start."""
        point, damping = numpy.append(cause, [0.0, 0.0]), 1e-2
        residuals = self.residuals(point)
        if residuals is None:
            return None
        for _ in range(ITERATES):
            derivatives = self.jacobian(point, residuals)
            normal = derivatives.T @ derivatives
            for _ in range(4):
                shift = damping * numpy.trace(normal) / len(point) * numpy.eye(len(point))
                tried = self.within_bounds(point - numpy.linalg.solve(normal + shift, derivatives.T @ residuals))
                there = self.residuals(tried)
                if there is not None and there @ there < residuals @ residuals:
                    break
                damping *= 8.0
            else:
                break
            gain = 1.0 - (there @ there) / (residuals @ residuals)
            point, residuals, damping = tried, there, damping / 6.0
            if gain < 0.03:
                break
        return residuals @ residuals, self.error(residuals), point, derivatives

    def error_of_steps(self, point):
        """RMS change of the widths in half as long steps, m."""
        more = self.model.factors(point[-2:] / SCALE)
        coarse, fine = self.widths(point[:-2], more), self.widths(point[:-2], [*more, f"analysis.path.steps={2 * self.model.steps}"])
        return 0.0 if fine is None else self.rms(fine - coarse)

    @staticmethod
    def rms(values):
        return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def values_of(model):
    """Friction and compliances in force, and the number of steps, from run.yaml."""
    import yaml
    run = yaml.safe_load((model.work / "results/run.yaml").read_text())
    joints = run["joints"]
    compliance = {side: float(joints["compliance"][side]) for side in ("normal", "tangential")}  # 2e-8 is text to yaml
    return float(joints["friction"]), compliance, int(run["analysis"]["path"]["steps"])


def distinct(fits, apart):
    """The fits whose movements differ from those of better ones."""
    kept = []
    for fit in sorted(fits, key=lambda one: one[0]):
        if all(numpy.linalg.norm((fit[2] - other[2])[:-2]) > apart for other in kept):
            kept.append(fit)
    return kept


def fits_of(fit, reading):
    """(noise, all local fits, those within twice the noise)."""
    starts = fit.single_causes()[:MOST_STARTS]
    if not starts:
        sys.exit("no single movement of a support leaves an equilibrium with a crack at the joints seen")
    local, noise = [], 0.0
    for number, (_, cause) in enumerate(starts, 1):
        found = fit.gauss_newton(cause)
        if found:
            local = distinct([*local, found], 2.0 * PROBE)
        if number < STARTS or not local:
            continue
        noise = math.hypot(reading / math.sqrt(12.0), fit.error_of_steps(local[0][2]))
        if local[0][1] <= 2.0 * noise:
            break
    if not local:
        sys.exit("the model falls under every single movement that is scaled to the cracks")
    return noise, local, [one for one in local if one[1] <= 2.0 * noise]


def in_words(movement, supports):
    return "; ".join(f"support {number}: " + ", ".join(f"{axis} {1000 * x:+.1f} mm" for axis, x in zip(AXES, six))
                     for (number, _, _), six in zip(supports, movement.reshape(-1, 6)))


def weakest(derivatives, noise):
    """The combination of movements that the cracks tell least well, and by how much it can change, m."""
    scaled = derivatives * numpy.append(numpy.full(len(derivatives) - 2, WIDTH / noise), [1.0, 1.0])[:, None]
    spread = numpy.linalg.pinv(scaled.T @ scaled, hermitian=True)[:-2, :-2]
    values, directions = numpy.linalg.eigh(spread)
    return directions[:, -1], math.sqrt(values[-1])


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
        for _, error, point, derivatives in within or local[:1]:
            direction, far = weakest(derivatives, noise)
            friction, stiffness = numpy.exp(FACTOR * point[-2:] / SCALE)
            print(f"error {1000 * error:.2f} mm: {in_words(point[:-2], model.supports)}; "
                  f"friction x {friction:.2f}, stiffness x {stiffness:.2f}")
            print(f"  least certain, by {1000 * far:.0f} mm: {in_words(direction * 1e-3, model.supports)} per mm")


if __name__ == "__main__":
    main()
