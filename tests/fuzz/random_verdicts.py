#!/usr/bin/env python3
"""Searches random vaults whose verdicts contradict each other.

    random_verdicts.py BIN_FOLDER VAULTS [--seed N] [--jobs 2]

Each vault of at most 200 blocks is pushed to its limit under the associated law. Then statics and the range of the thrust
just below and above that acceleration must agree with what limit analysis proves:

- statics under the associated law: it stands below and moves above;
- range: admissible forces exist below, and none above;
- statics under Coulomb's law, which admits the same forces: it moves above;
- the limit under Coulomb's law, found by bisection, is no larger.

`unconverged` and `moving_unproven` contradict nothing; they are counted. Prints every contradiction with its case, every
run longer than SLOW seconds, and how often each analysis ended how. Exit code 1 if there is a contradiction, or if a run
leaves no summary.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys
import tempfile

LONGEST, SLOW = 120, 20  # s of elapsed time of one run: at most; printed
NEAR = 0.03              # distance from the limit, relative; limits are 1e-4 wide
G = 9.81                 # m/s2


def vault_of(rng):
    def bond(rings, per_ring): return {"type": rng.choice(["stack", "running"]), "rings": rings, "blocks_per_ring": per_ring, "slices_per_block": 2}
    thickness = rng.choice([0.2, 0.3, 0.5, 0.8])
    kind = rng.choice(["arch", "barrel", "groin", "dome", "wall"])
    if kind == "arch":
        return {"surface": {"type": "arch", "span": rng.choice([3, 6, 10]), "radius_ratio": rng.choice([0.5, 0.6, 0.8, 1.5]), "thickness": thickness},
                "bond": {"type": "stack", "rings": rng.choice([6, 8, 12, 22]), "blocks_per_ring": 1}}
    if kind in ("barrel", "groin"):
        plan = {"type": "line", "length": 4} if kind == "barrel" else {"type": "groin"}
        return {"surface": {"type": "vault", "plan": plan, "profile": {"type": "semicircle", "span": 6}, "thickness": thickness},
                "bond": bond(rng.choice([7, 11]), 3)}
    if kind == "dome":
        return {"surface": {"type": "dome", "span": rng.choice([8, 20]), "radius_ratio": rng.choice([0.5, 0.8]), "thickness": thickness * rng.choice([1, 2]),
                            "crown_angle_deg": rng.choice([30, 60])}, "bond": bond(rng.choice([5, 8]), rng.choice([8, 12]))}
    rows = rng.choice([["ccddddcc", "aaaabbbb"], ["aabb", "ccdd"], ["aabb", "cddc"]])
    return {"surface": {"type": "wall", "length": 2.4, "height": rng.choice([1.2, 2.4]), "thickness": thickness},
            "bond": {"type": "drawn", "rings": rng.choice([5, 10]), "letter_length": 0.12, "rows": rows}}


def joints_of(rng):
    compliance = rng.choice([{"per": "area"}, {"relative": 1e-4}, {"normal": 0, "tangential": 0, "per": "point"},
                             {"normal": 10 ** rng.uniform(-12, -7), "tangential": 10 ** rng.uniform(-12, -7), "per": "point"}])
    joints = {"friction": round(10 ** rng.uniform(-1, 0.1), 3), "compliance": compliance}
    if compliance == {"per": "area"}:
        if rng.random() < 0.3: joints |= {"cohesion": rng.choice([1e3, 1e4]), "tension": rng.choice([0, 1e3])}
        if rng.random() < 0.2: joints["compressive_strength"] = rng.choice([1e6, 5e6])
    return joints


class Vault:
    def __init__(self, bin_folder, seed, folder):
        rng = random.Random(seed)
        self.bin, self.seed, self.folder = bin_folder, seed, folder
        self.case = {"geometry": vault_of(rng), "material": {"unit_weight": 20000}, "joints": joints_of(rng)}
        self.push = rng.choice([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0.6, 0.8, 0]])
        self.bisects = rng.random() < 0.2
        self.endings, self.said = collections.Counter(), []

    def solve(self, name, law, analysis, gravity=(0, 0, -G)):
        """The summary; one with the status alone if the program took too long or failed."""
        case = self.case | {"analysis": analysis | {"friction_law": law}, "loads": {"gravity": list(gravity)}}
        path, results = self.folder / f"{name}.yaml", self.folder / name
        path.write_text(json.dumps(case))
        try:
            run = subprocess.run([self.bin / "cupola-solve", path, "--assembly", self.folder / "vault.vtu", "--output", results, "--quiet"],
                                 capture_output=True, text=True, timeout=LONGEST)
            summary = json.loads((results / "summary.json").read_text())
        except subprocess.TimeoutExpired: summary = {"status": f"longer than {LONGEST} s", "wall_time_seconds": LONGEST}
        except OSError: summary = {"status": "failed", "message": run.stderr, "wall_time_seconds": 0.0}
        self.endings[f"{name}, {law}", summary["status"]] += 1
        if summary["wall_time_seconds"] > SLOW or summary["status"] == "failed":
            self.said.append(f"seed {self.seed}: {name}, {law}: {summary['status']} in {summary['wall_time_seconds']:.0f} s {summary.get('message', '')}")
        return summary

    def limit(self, law, relative_width):
        options = {"parameter": "acceleration", "direction": self.push, "low": 0, "high": 5, "relative_width": relative_width}
        return self.solve("limit", law, {"type": "limit", "limit": options})

    def contradictions(self):
        (self.folder / "vault.yaml").write_text(json.dumps(self.case | {"analysis": {"type": "static"}}))
        subprocess.run([self.bin / "cupola-generate", self.folder / "vault.yaml", "--output", self.folder / "vault.vtu", "--quiet"], check=True)
        at_rest, limit = self.solve("own weight", "associated", {"type": "static"}), self.limit("associated", 1e-4)
        stands, falls = limit.get("bracket", [None, None])
        if stands is None or falls is None:
            if at_rest["status"] == "stable" and limit["status"] == "moving": yield f"stands under its weight, but: {limit['message']}"
            return
        if at_rest["status"] == "moving": yield f"moves under its weight, but stands pushed by {stands:g} g"
        static, thrust = {"type": "static"}, {"type": "range", "range": {"quantities": ["thrust"]}}
        asked = [("statics", static, "associated"), ("statics", static, "coulomb")]
        if self.case["geometry"]["surface"]["type"] != "wall": asked.append(("range", thrust, "associated"))
        for what, analysis, law in asked:
            for place, share, wrong in (("below", (1 - NEAR) * stands, "moving"), ("above", (1 + NEAR) * falls, "stable")):
                gravity = [G * share * x - G * (k == 2) for k, x in enumerate(self.push)]
                found = self.solve(f"{what} {place}", law, analysis, gravity)
                if found["status"] == wrong and (law, place) != ("coulomb", "below"):
                    yield f"{what}, {law}: {wrong} at {share:g} g, but the limit lies between {stands:g} and {falls:g} g"
        if self.bisects:
            stands_coulomb = (self.limit("coulomb", 1e-2).get("bracket") or [None])[0]
            if stands_coulomb is not None and stands_coulomb > falls: yield f"stands at {stands_coulomb:g} g under Coulomb's law, falls at {falls:g} g under the associated one"


def try_vault(bin_folder, seed):
    with tempfile.TemporaryDirectory() as folder:
        vault = Vault(bin_folder, seed, pathlib.Path(folder))
        found = [f"seed {seed}: CONTRADICTION: {text}\n  {json.dumps(vault.case)}" for text in vault.contradictions()]
        failed = sum(count for (_, status), count in vault.endings.items() if status == "failed")
        return vault.endings, vault.said + found, len(found) + failed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin_folder", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("vaults", type=int)
    parser.add_argument("--seed", type=int, default=random.randrange(10 ** 8))
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    endings, wrong = collections.Counter(), 0
    print(f"{options.vaults} vaults from seed {options.seed}", flush=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for more, said, found in pool.map(lambda k: try_vault(options.bin_folder, options.seed + k), range(options.vaults)):
            endings, wrong = endings + more, wrong + found
            for line in said: print(line, flush=True)
    for (what, status), count in sorted(endings.items()): print(f"{what}: {status} {count}")
    print(f"{wrong} contradictions and failures")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
