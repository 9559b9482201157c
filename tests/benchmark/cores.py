#!/usr/bin/env python3
"""Time of runs on one core and on two, and an estimate for more. Prints CSV. Needs two idle cores.

  cores.py BIN_FOLDER WORK_FOLDER

Each work runs on one thread, on two, and twice at once on one thread each. Times are elapsed seconds of cupola-solve, medians of
three, of the 82,048 blocks of one run each.
Two at once take c times as long as one, because they share memory and caches. So, with the time s that threads do not share,

  T(2) = s + c (T(1) - s) / 2,    T(p) = s + c_p (T(1) - s) / p.

The estimate assumes that s stays, and, for a machine whose memory grows with its cores, c_p = c; for the memory of this one,
c_p = 1 + (c - 1) (p - 1), as if each run more cost the others as much as the second did.
"""
import pathlib
import statistics
import subprocess
import sys
import time

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
STATIC = ["analysis.tolerance=1e-6"]
WORKS = [
    ("statics, 11,568 blocks", 3, "brunelleschi", [*STATIC, "geometry.bond.refine=3"]),
    ("statics, 82,048 blocks", 1, "brunelleschi", [*STATIC, "geometry.bond.refine=8"]),
    ("motion, 1,296 blocks, 1 s", 3, "brunelleschi_collapse",
     ["joints.friction=0.4", "analysis.type=dynamic", "analysis.tolerance=1e-4", "analysis.duration=1", "output.frames_every=1"]),
    ("stages, 40 courses", 3, "octagon_circular", ["analysis.type=staged"]),
    ("ranges of all joints, 512 blocks", 3, "dome_circular",
     ["geometry.bond.rings=8", "geometry.bond.blocks_per_ring=64", "analysis.type=range",
      "analysis.range.quantities=[{type: all_joints}]"]),
]


def elapsed(commands):
    """Seconds until all of the commands, started together, have ended."""
    start = time.monotonic()
    processes = [subprocess.Popen(command, stdout=subprocess.DEVNULL) for command in commands]
    for process in processes:
        if process.wait() not in (0, 3):
            sys.exit(f"failed: {' '.join(process.args)}")
    return time.monotonic() - start


def measure(programs, folder, repetitions, case, sets):
    """Medians of the times on one thread, on two, and of two runs at once."""
    options = [CASES / f"{case}.yaml", "--quiet", *(word for value in sets for word in ("--set", value))]
    assembly = folder / "assembly.vtu"
    subprocess.run([programs / "cupola-generate", *options, "--output", assembly], check=True)

    def run(threads, output="a"):
        return list(map(str, [programs / "cupola-solve", *options, "--assembly", assembly, "--threads", threads, "--force",
                              "--output", folder / output]))

    times = [(elapsed([run(1)]), elapsed([run(2)]), elapsed([run(1), run(1, "b")])) for _ in range(repetitions)]
    return [statistics.median(column) for column in zip(*times)]


def main():
    programs, folder = map(pathlib.Path, sys.argv[1:3])
    folder.mkdir(parents=True, exist_ok=True)
    print("work,1 thread s,2 threads s,two runs at once s,ratio on 2,not shared s,ratio on 16 (estimate),ratio on 64 (estimate),"
          "ratio on 64 with this memory (estimate)")
    for work, *inputs in WORKS:
        one, two, both = measure(programs, folder, *inputs)
        c = min(max(both / one, 1.0), 1.9)  # noise below 1; at 2 two threads could gain nothing, and s were unknown
        rest = min(max((two - c * one / 2) / (1 - c / 2), 0.0), one)

        def faster(p, slower):
            return f"{one / (rest + slower * (one - rest) / p):.1f}"

        print(f'"{work}",{one:.2f},{two:.2f},{both:.2f},{one / two:.2f},{rest:.2f},{faster(16, c)},{faster(64, c)},'
              f"{faster(64, 1 + (c - 1) * 63)}", flush=True)


if __name__ == "__main__":
    main()
