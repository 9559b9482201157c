"""Sums the bed-joint wrenches of bricks over the macro-blocks that they stand for. A script, not a study:
it compares each run with another.

    refinement.py FOLDER N N ...    FOLDER/N/post/joints.csv for bond.refine = N, the finest last

Prints one row per refinement and course of macro-blocks: thrust (horizontal over vertical force), distance of its
line of action outside the centre of pressure of the finest bricks, and changes of force and moment against the finest
bricks. The changes are the largest over all macro-blocks of the course.
"""

import csv
import math
import sys

RINGS, SLOTS, THICKNESS = 40, 32, 2.2  # cases/dome_circular.yaml: courses, blocks per course, m
LEVELS = (0, 10, 20, 30)  # courses whose lower bed is evaluated


def rotated(x, y, angle):
    """Components of a horizontal vector outwards and along the ring at the azimuth `angle`."""
    return (math.cos(angle) * x + math.sin(angle) * y, math.cos(angle) * y - math.sin(angle) * x)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def macro_joints(path, refine):
    """{(course, slot): joints} of the bricks' bed joints below each macro-block, as (area, point, F, M)."""
    joints = {(level, slot): [] for level in LEVELS for slot in range(SLOTS)}
    with open(path) as file:
        for row in csv.DictReader(file):
            if row["kind"] not in ("bed", "base") or int(row["ring"]) % refine:
                continue
            level = int(row["ring"]) // refine
            if level not in LEVELS:
                continue
            vector = lambda name, unit: [float(row[f"{name}{axis}{unit}"]) for axis in "xyz"]
            point = [float(row["x_m"]), float(row["y_m"]), float(row["z_m"])]
            turns = math.atan2(point[1], point[0]) / (2 * math.pi) * SLOTS - 0.5 * (level % 2)
            force, moment = vector("force_", "_N"), vector("moment_", "_Nm")
            joints[level, math.floor(turns) % SLOTS].append((float(row["area_m2"]), point, force, moment))
    return joints


def centre(joints):
    """Area-weighted mean of the centres of pressure, the points in joints.csv."""
    area = sum(joint[0] for joint in joints)
    return [sum(joint[0] * joint[1][k] for joint in joints) / area for k in range(3)]


def wrench(joints, about):
    """Force and moment about a point; components outwards, along the ring and up."""
    force, moment = [0.0] * 3, [0.0] * 3
    for _, point, f, m in joints:
        lever = cross([p - a for p, a in zip(point, about)], f)
        for k in range(3):
            force[k] += f[k]
            moment[k] += m[k] + lever[k]
    angle = math.atan2(about[1], about[0])
    return [*rotated(*force[:2], angle), force[2]], [*rotated(*moment[:2], angle), moment[2]]


def main():
    folder, refinements = sys.argv[1], [int(n) for n in sys.argv[2:]]
    runs = {n: macro_joints(f"{folder}/{n}/post/joints.csv", n) for n in refinements}
    finest = runs[refinements[-1]]
    print("level,refine,bricks_per_block,thrust,thrust_shift_m,force_change,moment_change")
    for level in LEVELS:
        for n in refinements:
            force_change = moment_change = 0.0
            for slot in range(SLOTS):
                about = centre(finest[level, slot])
                force, moment = wrench(runs[n][level, slot], about)
                exact_force, exact_moment = wrench(finest[level, slot], about)
                size = math.hypot(*exact_force)
                force_change = max(force_change, math.dist(force, exact_force) / size)
                moment_change = max(moment_change, math.dist(moment, exact_moment) / (size * THICKNESS))
            size = math.hypot(*force)
            print(f"{level},{n},{n * n},{-force[0] / force[2]:.6f},{moment[1] / size:.6f},"
                  f"{force_change:.3e},{moment_change:.3e}")


main()
