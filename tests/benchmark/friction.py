"""Coulomb's law near the critical friction of the associated law, on models of the paper. Prints a CSV table.
A script, not a study: it runs at multiples of values that other runs found.

  friction.py BIN_FOLDER WORK_FOLDER brackets WIDTH [MODEL ...]   brackets of both laws to a relative WIDTH: value and time
  friction.py BIN_FOLDER WORK_FOLDER verdicts COUNT [MODEL ...]   COUNT frictions around both critical values: verdict and time
  friction.py BIN_FOLDER WORK_FOLDER gaps COUNT [MODEL ...]       COUNT seeds of random gaps, at 1.05 and 0.95 times the value
  friction.py BIN_FOLDER WORK_FOLDER steps COUNT [MODEL ...]      times of COUNT steps of a motion and of all stages, friction 0.4

The critical friction of the associated law comes from a direct limit analysis. Times are processor seconds of one thread.
Finished runs in WORK_FOLDER are used again. Fails if a model stands below the associated critical friction: Coulomb's law
admits the same forces, so that this would be a wrong verdict.
"""

import json
import pathlib
import resource
import statistics
import subprocess
import sys

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
MODELS = ["dome_circular", "octagon_circular", "octagon_planar", "brunelleschi"]
FACTORS = 0.98, 1.094  # smallest and largest friction over the associated critical value
GAP = 2e-4  # m, largest gap of the joints
LIMIT = {"analysis.type": "limit", "analysis.limit.parameter": "friction", "analysis.limit.low": 0.03,
         "analysis.limit.high": 0.3}


def run(program, arguments):
    code = subprocess.run([program, *map(str, arguments)], stdout=subprocess.DEVNULL, check=False).returncode
    if code not in (0, 3):
        sys.exit(f"{program} {' '.join(map(str, arguments))}: exit code {code}")


class Model:
    """One case with some settings, generated once."""

    def __init__(self, bin_folder, work, name, settings=None):
        self.bin, self.case, self.settings = bin_folder, CASES / f"{name}.yaml", settings or {}
        self.folder = work / "_".join([name, *(f"{k.split('.')[-1]}{v}" for k, v in self.settings.items())])
        self.assembly = self.folder / "assembly.vtu"
        if not self.assembly.exists():
            self.folder.mkdir(parents=True, exist_ok=True)
            run(self.bin / "cupola-generate", [self.case, "--output", self.assembly, *self.options({})])

    def options(self, settings):
        pairs = {**self.settings, **settings}
        return [word for key, value in pairs.items() for word in ("--set", f"{key}={value}")]

    def solve(self, name, settings):
        """The summary of a run, with its processor time in seconds."""
        folder = self.folder / name
        time_file = folder / "seconds"
        if not time_file.exists():
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            run(self.bin / "cupola-solve", [self.case, "--assembly", self.assembly, "--output", folder, "--threads", 1,
                                            *self.options(settings)])
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            time_file.write_text(str(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime))
        summary = json.loads((folder / "summary.json").read_text())
        return summary, float(time_file.read_text())

    def static(self, law, friction):
        return self.solve(f"{law}_{friction:.6f}",
                          {"joints.friction": f"{friction:.6f}", "analysis.friction_law": law})


def bracket(model, law, width):
    """The bracket of the critical friction as text, its two values, and the processor time in seconds."""
    summary, seconds = model.solve(f"bracket_{law}_{width}", {**LIMIT, "analysis.friction_law": law,
                                                              "analysis.limit.method": "bisection",
                                                              "analysis.limit.relative_width": width})
    low, high = sorted(summary["bracket"])
    return f"{low:.4f} ... {high:.4f}", low, high, seconds


def brackets(bin_folder, work, width, models):
    print("model,associated,associated s,Coulomb,Coulomb s")
    wrong = []
    for name in models:
        model = Model(bin_folder, work, name)
        associated, coulomb = (bracket(model, law, width) for law in ("associated", "coulomb"))
        print(f"{name},{associated[0]},{associated[3]:.0f},{coulomb[0]},{coulomb[3]:.0f}")
        if coulomb[2] < associated[1]:
            wrong.append(f"{name}: the critical friction of Coulomb's law lies below the associated one")
    return wrong


def steps(bin_folder, work, count, models):
    motion = {"analysis.type": "dynamic", "analysis.tolerance": 1e-6, "analysis.time_step": 0.02,
              "analysis.duration": 0.02 * count, "joints.friction": 0.4}
    stages = {"analysis.type": "staged", "joints.friction": 0.4}
    print("model,analysis,associated s,Coulomb s,ratio")
    for name in models:
        model = Model(bin_folder, work, name)
        for label, settings in ((f"{count} steps of a motion", motion), ("stages by ring", stages)):
            times = [model.solve(f"{label}_{law}".replace(" ", "_"), {**settings, "analysis.friction_law": law})[1]
                     for law in ("associated", "coulomb")]
            print(f"{name},{label},{times[0]:.1f},{times[1]:.1f},{times[1] / times[0]:.2f}")
    return []


def verdicts(bin_folder, work, count, models):
    first, last = FACTORS
    factors = [round(first + (last - first) * k / (count - 1), 3) for k in range(count)]
    columns, wrong = [], []
    for name in models:
        model = Model(bin_folder, work, name)
        limit = model.solve("limit", LIMIT)[0]
        critical, moving = limit["critical_value"], limit["bracket"][1]
        cells, stands = [f"mu {critical:.5f}"], []
        for factor in factors:
            summary, seconds = model.static("coulomb", factor * critical)
            stands.append(summary["status"].startswith("stable"))
            cells.append(f"{summary['status']}; {seconds:.1f} s")
            if stands[-1] and factor * critical < moving:
                wrong.append(f"{name} stands at {factor} times the critical friction of the associated law")
        cells.append(str(sum(a != b for a, b in zip(stands, stands[1:]))))
        columns.append(cells)
    print("friction over the associated critical value," + ",".join(models))
    for label, *cells in zip(["critical value (associated)", *factors, "changes of the verdict"], *columns):
        print(",".join(map(str, [label, *cells])))
    return wrong


def gaps(bin_folder, work, count, models):
    print("model,critical friction (associated),stand at 1.05,associated at 1.05 s,Coulomb at 1.05 s,largest ratio,"
          "move at 0.95,Coulomb at 0.95 s (largest)")
    wrong = []
    for name in models:
        critical = Model(bin_folder, work, name).solve("limit", LIMIT)[0]["critical_value"]
        above, ratios, below = [], [], []
        for seed in range(1, count + 1):
            model = Model(bin_folder, work, name, {"imperfections.gap": GAP, "imperfections.seed": seed})
            associated = model.static("associated", 1.05 * critical)
            above.append((associated, model.static("coulomb", 1.05 * critical)))
            ratios.append(above[-1][1][1] / associated[1])
            below.append(model.static("coulomb", 0.95 * critical))
            if below[-1][0]["status"].startswith("stable"):
                wrong.append(f"{name}, seed {seed}, stands at 0.95 times the critical friction of the associated law")
        stand = sum(coulomb[0]["status"].startswith("stable") for _, coulomb in above)
        move = sum(summary["status"].startswith("moving") for summary, _ in below)
        print(f"{name},mu {critical:.5f},{stand} of {count},"
              f"{statistics.median(a[1] for a, _ in above):.2f},{statistics.median(c[1] for _, c in above):.2f},"
              f"{max(ratios):.1f},{move} of {count},{max(seconds for _, seconds in below):.2f}")
    return wrong


def main():
    bin_folder, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    tables = {"brackets": (brackets, float), "verdicts": (verdicts, int), "gaps": (gaps, int), "steps": (steps, int)}
    table, number = tables[sys.argv[3]]
    wrong = table(bin_folder, work, number(sys.argv[4]), sys.argv[5:] or MODELS)
    if wrong:
        sys.exit("\n".join(wrong))


main()
