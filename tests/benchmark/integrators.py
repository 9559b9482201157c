"""Compares the time integrators on motions of the paper. Prints a CSV table. Needs python3-vtk9 and numpy.
A script, not a study: it compares frames of several runs.

  integrators.py BIN_FOLDER WORK_FOLDER error       displacements of the swinging dome after 0.2 s against the time step
  integrators.py BIN_FOLDER WORK_FOLDER orders      errors on scenes of one block (integrator_benchmark) and on the dome
  integrators.py BIN_FOLDER WORK_FOLDER collapse    time at which the collapsing dome has moved by 0.5 m

Errors are relative to the displacements of all blocks, extrapolated from the two finest runs of the generalized alpha method
with its observed order. Times are processor seconds of one thread. Finished runs in WORK_FOLDER are used again.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
SCHEMES = {"euler": "implicit Euler", "generalized_alpha": "generalized alpha"}
STEPS = [0.02, 0.01, 0.005, 0.0025, 0.00125]


class Runs:
    def __init__(self, bin_folder, work, case, settings):
        self.bin, self.case, self.settings = bin_folder, CASES / f"{case}.yaml", settings
        self.folder = work / case
        self.assembly = self.folder / "assembly.vtu"
        if not self.assembly.exists():
            self.folder.mkdir(parents=True, exist_ok=True)
            self.call("cupola-generate", "--output", self.assembly)

    def call(self, program, *arguments):
        code = subprocess.run([self.bin / program, self.case, "--quiet", *map(str, arguments)], check=False).returncode
        if code not in (0, 3):
            sys.exit(f"{program} {self.case} {' '.join(map(str, arguments))}: exit code {code}")

    def run(self, scheme, step):
        """The folder of a run and its summary."""
        folder = self.folder / f"{scheme}_{step}"
        if not (folder / "summary.json").exists():
            pairs = {**self.settings, "analysis.integrator": scheme, "analysis.time_step": step}
            self.call("cupola-solve", "--assembly", self.assembly, "--output", folder, "--threads", 1,
                      *(word for key, value in pairs.items() for word in ("--set", f"{key}={value}")))
        return folder, json.loads((folder / "summary.json").read_text())


def displacements(folder):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(sorted(folder.glob("blocks_*.vtp"))[-1]))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("displacement_m")).copy()


def dome_errors(bin_folder, work):
    """For each scheme and step: folder, summary and relative error of the displacements."""
    import numpy
    duration = 0.2
    runs = Runs(bin_folder, work, "dome_circular", {
        "analysis.type": "dynamic", "analysis.duration": duration, "analysis.tolerance": 1e-8,
        "output.frames_every": duration})
    fine = [displacements(runs.run("generalized_alpha", STEPS[-1] / factor)[0]) for factor in (1, 2, 4)]
    ratio = numpy.linalg.norm(fine[1] - fine[0]) / numpy.linalg.norm(fine[2] - fine[1])
    exact = fine[2] + (fine[2] - fine[1]) / (ratio - 1)
    for scheme in SCHEMES:
        for step in STEPS:
            folder, summary = runs.run(scheme, step)
            off = numpy.linalg.norm(displacements(folder) - exact) / numpy.linalg.norm(exact)
            yield scheme, step, folder, summary, off


def error(bin_folder, work):
    print("integrator,step ms,relative error,order,processor time s,energy lost by the scheme over the weight's work")
    before = {}
    for scheme, step, folder, summary, off in dome_errors(bin_folder, work):
        with open(folder / "history.csv", encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        lost = float(last["scheme_loss_J"]) / -float(last["potential_energy_J"])
        order = f"{math.log2(before[scheme] / off):.2f}" if scheme in before else ""
        print(f"{SCHEMES[scheme]},{1000 * step:g},{off:.2e},{order},{summary['cpu_time_seconds']:.1f},{lost:.4f}")
        before[scheme] = off


def orders(bin_folder, work):
    print(subprocess.run(bin_folder / "integrator_benchmark", check=True, capture_output=True, text=True).stdout, end="")
    for scheme, step, _, _, off in dome_errors(bin_folder, work):
        print(f"swinging dome,{scheme},{1000 * step:g},{off:.3e}")


def time_to(folder, distance):
    before = (0.0, 0.0)
    with open(folder / "history.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            now = float(row["time_s"]), float(row["max_displacement_m"])
            if now[1] >= distance:
                share = (distance - before[1]) / (now[1] - before[1])
                return before[0] + share * (now[0] - before[0])
            before = now
    return math.nan


def collapse(bin_folder, work):
    runs = Runs(bin_folder, work, "brunelleschi_collapse", {
        "analysis.tolerance": 1e-6, "analysis.stop.collapsed": "true", "analysis.thresholds.displacement": 0.5, "output.frames_every": 100})
    print("step ms," + ",".join(f"{name} s,{name} processor s" for name in SCHEMES.values()))
    times = {scheme: [] for scheme in SCHEMES}
    for step in STEPS:
        cells = [f"{1000 * step:g}"]
        for scheme in SCHEMES:
            folder, summary = runs.run(scheme, step)
            times[scheme].append(time_to(folder, 0.5))
            cells += [f"{times[scheme][-1]:.4f}", f"{summary['cpu_time_seconds']:.0f}"]
        print(",".join(cells), flush=True)
    # The difference of the last two steps, halved at each further step, is the sum of the changes that remain at first order.
    cells = ["extrapolated to 0"]
    for values in times.values():
        rest = values[-1] - values[-2]
        cells += [f"{values[-1] + rest:.4f} +- {abs(rest):.4f}", ""]
    print(",".join(cells))


def main():
    bin_folder, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    {"error": error, "orders": orders, "collapse": collapse}[sys.argv[3]](bin_folder, work)


main()
