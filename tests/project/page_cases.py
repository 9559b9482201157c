#!/usr/bin/env python3
"""The reader accepts every case in the pages of docs/: no page shows a key that does not exist.

    page_cases.py REPOSITORY CUPOLA_SOLVE

A case is a YAML block whose outermost keys are sections of a case. One without a geometry extends a dome. Pages of
mistakes are left out: tests/pipeline/mistakes_test.cpp repeats them.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SECTIONS = {"title", "extends", "geometry", "imperfections", "material", "joints", "contact", "loads", "supports", "analysis",
            "output", "postproc", "sweep", "ensemble"}
BLOCK = re.compile(r"^```yaml\n(.*?)^```", re.S | re.M)


def cases_of(text):
    for block in BLOCK.findall(text):
        keys = set(re.findall(r"^(\w+):", block, re.M))
        if keys and keys <= SECTIONS:
            whole = "extends" in keys or re.search(r"\b(surface|import|members):", block)
            yield block if whole else "extends: dome_circular.yaml\n" + block


def refusal(program, folder, case):
    """What the program says against the case; empty if it accepts it."""
    (folder / "block_of_a_page.yaml").write_text(case)
    run = subprocess.run([program, "--check", "--quiet", "block_of_a_page.yaml"], cwd=folder, text=True, capture_output=True,
                         check=False)
    return run.stderr.strip() if run.returncode else ""


def main(root, program):
    assert list(cases_of("```yaml\ngeometry: {surface: 1}\n```\n```yaml\nruns: 1\n```")) == ["geometry: {surface: 1}\n"]
    os.environ["CUPOLA_CASES"] = str(root / "cases")
    count, faults = 0, []
    with tempfile.TemporaryDirectory() as parent:
        folder = pathlib.Path(shutil.copytree(root / "cases", parent + "/cases"))
        assert "unknown key" in refusal(program, folder, "extends: dome_circular.yaml\njoints: {frictoin: 1}\n")
        for page in [root / "README.md", *sorted(root.glob("docs/*.md"))]:
            for case in cases_of(page.read_text()) if page.name != "mistakes.md" else ():
                count += 1
                said = refusal(program, folder, case)
                faults += [f"{page.relative_to(root)}: {said}\n{case}"] if said else []
    print("\n".join(faults) or f"{count} cases of pages accepted")
    return bool(faults) or count < 10


sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]))
