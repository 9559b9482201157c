"""Paths against statics near collapse: the cross vault, its weight in 30 steps. Prints a CSV table.

  paths.py BIN_FOLDER WORK_FOLDER

Times are processor seconds of cupola-solve on one thread, medians of three, path and statics by turns. The critical friction is
0.419 under the associated law (tests/pipeline/public_vaults_test.cpp).
"""
import json
import pathlib
import statistics
import subprocess
import sys

CASE = pathlib.Path(__file__).resolve().parents[2] / "cases" / "cross_vault.yaml"
STEPS = 30
PATH = ["analysis.type=path", f"analysis.path.steps={STEPS}", "loads.dead_load_time.type=ramp"]
FRICTIONS = 0.6, 0.45, 0.435


def solve(programs, folder, settings):
    """The summary of a run."""
    command = [programs / "cupola-solve", CASE, "--assembly", folder / "assembly.vtu", "--output", folder / "run", "--force",
               "--quiet", "--set", *settings]
    code = subprocess.run(list(map(str, command)), stderr=subprocess.DEVNULL, check=False).returncode
    if code != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {code}")
    return json.loads((folder / "run" / "summary.json").read_text())


def main():
    programs, folder = map(pathlib.Path, sys.argv[1:3])
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([programs / "cupola-generate", CASE, "--quiet", "--output", folder / "assembly.vtu"], check=True,
                   stderr=subprocess.DEVNULL)
    print("friction law,friction,equilibria,iterations,path s,static s,path over statics and steps")
    for law in "associated", "coulomb":
        for friction in FRICTIONS:
            case = [f"analysis.friction_law={law}", f"joints.friction={friction}"]
            pairs = [(solve(programs, folder, [*case, *PATH]), solve(programs, folder, case)) for _ in range(3)]
            path, static = ([summary["cpu_time_seconds"] for summary in runs] for runs in zip(*pairs))
            first = pairs[0][0]
            seconds = statistics.median(path), statistics.median(static)
            print(f"{law},{friction},{first['steps']},{first['iterations']},{seconds[0]:.3g},{seconds[1]:.3g},"
                  f"{seconds[0] / seconds[1] / STEPS:.2g}", flush=True)


if __name__ == "__main__":
    main()
