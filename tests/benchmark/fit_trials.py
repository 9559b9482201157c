#!/usr/bin/env python3
"""Twenty trials of fit_movements.py on cases/barrel_cracked.yaml, whose hidden movements are drawn blind. Prints a CSV table of how far
the answers lie from the hidden movements, and writes WORK_FOLDER/trials.csv with a row per trial.

  fit_trials.py BIN_FOLDER WORK_FOLDER [TRIALS] [--first NUMBER] [--whole]

Each trial draws six numbers of one support at random, scales them until the widest crack has 20 to 40 mm, runs them with friction
and compliance a fifth above or below those of the case, in the moved geometry, rounds the widest gaps of the open
joints to 0.5 mm, and deletes half of the joints that are still open (with --whole: half of the cracks of cracks.csv, with all their
joints). The fit knows the rest and the case. Said before the first run: a trial succeeds if its best fit lies within 20 % of the hidden
movement, by the norm of the six numbers. Guessing is a random movement scaled to the widths. Finished trials in WORK_FOLDER are
used again.
"""

import argparse
import csv
import json
import pathlib
import sys

import numpy

import fit_movements

CASE = pathlib.Path(__file__).resolve().parents[2] / "cases/barrel_cracked.yaml"
MOVED = ["analysis.path.steps=8", "analysis.path.geometry=end"]
LARGEST = 0.2  # m
READING = 0.0005  # m
SUCCESS = 0.2


def others(rng):
    """Friction and compliances a fifth off."""
    friction, compliance = (float(1.0 + 0.2 * sign) for sign in rng.choice([-1, 1], 2))
    return [f"joints.friction={0.7 * friction}", f"joints.compliance.normal={2e-8 * compliance}",
            f"joints.compliance.tangential={5e-8 * compliance}"]


def rounded(openings):
    widths = {joint: round(width / READING) * READING for joint, width in openings.items()}
    return {joint: width for joint, width in widths.items() if width > 0.0}


def draw(model, rng):
    """(hidden movement, openings) with a widest crack of 20 to 40 mm."""
    while True:
        direction, asked, more = rng.normal(size=6), rng.uniform(0.022, 0.038), MOVED + others(rng)
        movement = 0.05 * direction / numpy.linalg.norm(direction)
        openings = model.openings(movement)
        if openings is None or max(openings.values()) == 0.0:
            continue
        movement = movement * asked / max(openings.values())
        openings = model.openings(movement, more) if numpy.abs(movement).max() <= LARGEST else None
        if openings is not None and 0.02 <= max(openings.values()) <= 0.04:
            return movement, openings


def unseen(model, openings, rng, whole):
    """The joints still open after rounding without half of them."""
    widths = rounded(openings)
    if not whole:
        names = [sorted(widths)[k] for k in rng.permutation(len(widths))]
        return {joint: widths[joint] for joint in names[: (len(names) + 1) // 2]}
    # The joints of one crack lie in one course: a hinge line.
    with open(model.work / "post/joints.csv", encoding="utf-8") as file:
        course = {(int(r["block_a"]), int(r["block_b"])): (r["kind"] != "head", int(r["ring"])) for r in csv.DictReader(file)}
    cracks = sorted({course[joint] for joint in widths})
    kept = {cracks[k] for k in rng.permutation(len(cracks))[: (len(cracks) + 1) // 2]}
    return {joint: width for joint, width in widths.items() if course[joint] in kept}


def hide(model, folder, seed, whole):
    """Writes truth.json and seen.csv; the fit reads only the second."""
    rng = numpy.random.default_rng(seed)
    movement, openings = draw(model, rng)
    seen = unseen(model, openings, rng, whole)
    (folder / "truth.json").write_text(json.dumps({"movement": movement.tolist(), "widest": max(openings.values()),
                                                   "open": len(rounded(openings)), "kept": len(seen)}))
    with open(folder / "seen.csv", "w", encoding="utf-8") as file:
        print("block_a,block_b,width_m", file=file)
        for (a, b), width in sorted(seen.items()):
            print(f"{a},{b},{width:.4f}", file=file)


def find(model, folder, seed):
    fit = fit_movements.Fit(model, fit_movements.read_seen(folder / "seen.csv"), LARGEST)
    noise, local, within = fit_movements.fits_of(fit, READING)
    _, single = fit.single_causes()[0]
    guess = numpy.random.default_rng(10_000 + seed).normal(size=6)
    guess *= 0.05 / numpy.linalg.norm(guess)
    widths = fit.widths(guess)
    guess *= 0.0 if widths is None or not widths.any() else (fit.seen @ widths) / (widths @ widths)
    (folder / "found.json").write_text(json.dumps({
        "noise": noise, "runs": model.runs, "single": single.tolist(), "guess": guess.tolist(),
        "local": [{"error": error, "movement": point[:-2].tolist()} for _, error, point, _ in local],
        "within": [k for k, one in enumerate(local) if any(one is other for other in within)]}))


def row(folder, number):
    truth, found = (json.loads((folder / name).read_text()) for name in ("truth.json", "found.json"))
    hidden = numpy.array(truth["movement"])
    off = lambda movement: 100.0 * float(numpy.linalg.norm(numpy.array(movement) - hidden) / numpy.linalg.norm(hidden))
    within = [off(found["local"][k]["movement"]) for k in found["within"]]
    return {"trial": number, "movement mm": 1000 * numpy.linalg.norm(hidden), "widest crack mm": 1000 * truth["widest"],
            "joints seen": truth["kept"], "noise mm": 1000 * found["noise"], "misfit mm": 1000 * found["local"][0]["error"],
            "runs": found["runs"], "fits within": len(within), "best": off(found["local"][0]["movement"]),
            "nearest": min(within, default=numpy.nan), "single": off(found["single"]), "guess": off(found["guess"])}


def summary(rows):
    """(answer, errors in %) of all trials and of some."""
    return [("the best fit", [row["best"] for row in rows]),
            ("where it alone is within the noise", [row["best"] for row in rows if row["fits within"] == 1]),
            ("where several are", [row["best"] for row in rows if row["fits within"] > 1]),
            ("the nearest of these", [row["nearest"] for row in rows if row["fits within"] > 1]),
            ("the best where none is", [row["best"] for row in rows if row["fits within"] == 0]),
            ("a movement along or about one axis, scaled to the cracks", [row["single"] for row in rows]),
            ("a random movement, scaled to the cracks", [row["guess"] for row in rows])]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("trials", type=int, nargs="?", default=20)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--whole", action="store_true")
    given = parser.parse_args()
    given.work.mkdir(parents=True, exist_ok=True)
    model, rows = fit_movements.Model(given.programs, CASE, [], given.work), []
    for number in range(given.first, given.first + given.trials):
        folder = given.work / f"{'whole' if given.whole else 'trial'}_{number:02}"
        folder.mkdir(parents=True, exist_ok=True)
        if not (folder / "seen.csv").exists():
            hide(model, folder, 100 + number, given.whole)
        if not (folder / "found.json").exists():
            model.runs = 0
            find(model, folder, number)
        rows.append(row(folder, number))
        print(rows[-1], file=sys.stderr, flush=True)
    with open(given.work / "trials.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, rows[0])
        table.writeheader()
        table.writerows(rows)
    print(f"answer,trials,within {100 * SUCCESS:g} %,median error %,largest error %")
    for answer, errors in summary(rows):
        if errors:
            print(f'"{answer}",{len(errors)},{sum(e <= 100 * SUCCESS for e in errors)},{numpy.median(errors):.3g},{max(errors):.3g}')


if __name__ == "__main__":
    main()
