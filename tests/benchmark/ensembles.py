#!/usr/bin/env python3
"""Time and memory of ensembles of tiny members: 20 stones of an arch, statics, friction from a lognormal distribution. Prints CSV.

  ensembles.py BIN_FOLDER WORK_FOLDER [MEMBERS ...]

Every program that make starts is timed by GNU time (Debian's package time); what remains of the processor time of make and its
children is make's own share: shells, stamps, lists and hashes of inputs. `again` is a second make, which finds all members done.
"""
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASE = """\
extends: cupola:arch
title: Arches of uncertain friction
ensemble:
  members: {members}
  seed: 1
  design: monte_carlo
  keep: summary
  vary:
    - {{key: joints.friction, distribution: lognormal, mean: 0.7, deviation: 0.1}}
"""
PROGRAM = """\
#!/bin/sh
exec /usr/bin/time --append --output={log} --format='%U %S %M' {program} "$@"
"""


def timed_programs(programs, folder):
    """A folder of programs that write processor seconds and kilobytes of each call to folder/times."""
    (folder / "bin").mkdir(parents=True)
    for program in ("cupola-generate", "cupola-solve", "cupola-post"):
        script = folder / "bin" / program
        script.write_text(PROGRAM.format(log=folder / "times", program=programs / program))
        script.chmod(0o755)
    return folder / "bin"


def make(folder):
    """(elapsed, processor seconds, those of the programs, MB of the largest program) of one make."""
    (folder / "times").write_text("")
    used, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(["make", "-s", "-f", ROOT / "Makefile.run", f"BIN={folder / 'bin'}", f"FOLDER={folder}", f"OUT={folder / 'out'}",
                    "POST=", "tiny"], check=True, stdout=subprocess.DEVNULL)
    elapsed, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    calls = [line.split() for line in (folder / "times").read_text().splitlines()]
    return (elapsed, after.ru_utime + after.ru_stime - used.ru_utime - used.ru_stime,
            sum(float(user) + float(system) for user, system, _ in calls), max(int(kb) for _, _, kb in calls) / 1024)


def main():
    programs, work = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    os.environ["CUPOLA_CASES"] = str(ROOT / "cases")
    print("members,elapsed s,CPU s,CPU s a member,make's own %,again s,MB,disk MB")
    for members in [int(word) for word in sys.argv[3:]] or [200, 2000, 10000]:
        folder = work / str(members)
        shutil.rmtree(folder, ignore_errors=True)
        timed_programs(programs, folder)
        (folder / "tiny.yaml").write_text(CASE.format(members=members))
        elapsed, used, own, memory = make(folder)
        again = make(folder)
        disk = sum(file.stat().st_size for file in (folder / "out").rglob("*") if file.is_file()) / 1e6
        print(f"{members},{elapsed:.0f},{used:.0f},{used / members:.3f},{100 * (used - own) / used:.0f},{again[0]:.1f},{memory:.0f},"
              f"{disk:.0f}", flush=True)


if __name__ == "__main__":
    main()
