"""Writes a table that a script or a benchmark printed into a Markdown page. Tables of quantities of runs are studies (cases/studies).

    PROGRAM | write_table.py --runs=FOLDER|--program=PROGRAM [--digits=3] PAGE.md NAME [COLUMN=HEADING ...]

Reads CSV with a header line (lines before it, and the context of Google Benchmark, are skipped) and replaces the text
between `<!-- table NAME -->` and `<!-- end -->` by a Markdown table and a line with date, revision, machine and load. The revision
is that of the runs below FOLDER, from their summaries, or of PROGRAM, from its --version. Nothing is written if runs carry different
revisions, or if sources were changed. With COLUMN=HEADING arguments only these columns are written, under these headings.
"""

import collections
import csv
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys


def refuse_changed_tree():
    """Pages and pictures change while their tables are written, and no result depends on them."""
    changed = subprocess.run(["git", "-C", os.path.dirname(os.path.abspath(__file__)), "status", "--porcelain",
                              "--untracked-files=no", "--", ":/", ":(top,exclude)*.md", ":(top,exclude)docs/pictures"],
                             capture_output=True, text=True, check=True).stdout
    if changed:
        sys.exit(f"no table is written while files are changed; commit first:\n{changed}")


def revision_of(source):
    """The revision in --runs=FOLDER or --program=PROGRAM; exits unless there is one, of unchanged sources."""
    kind, _, path = source.partition("=")
    versions = collections.defaultdict(list)
    if kind == "--runs":
        for file in sorted(pathlib.Path(path).rglob("summary.json")):
            if file.parent.name != "post":
                versions[json.loads(file.read_text())["program_version"]].append(str(file.parent))
    elif kind == "--program":
        versions[subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout.strip()].append(path)
    else:
        sys.exit("the first argument must be --runs=FOLDER or --program=PROGRAM")
    if len(versions) != 1:
        sys.exit(f"{path}: runs of {len(versions)} revisions; run them again:\n"
                 + "\n".join(f"  {version}: {' '.join(names)}" for version, names in versions.items()))
    revision = next(iter(versions)).partition("(")[2].partition(")")[0]
    if revision.endswith("-dirty") or revision.startswith("unknown"):
        sys.exit(f"{path}: measured with changed or unknown sources (revision {revision}); commit, build and run again")
    return revision


def context(revision):
    processor = "unknown processor"
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                processor = line.split(":", 1)[1].strip()
                break
    load = os.getloadavg()[0]
    return (f"Measured {datetime.date.today()} by the programs of revision {revision} on {os.cpu_count()} cores of {processor},\n"
            f"load average {load:.1f} at the end.")


def shown(text, digits):
    try:
        value = float(text)
    except ValueError:
        return text.replace("|", "/")
    return text if value == int(value) and abs(value) < 1e15 and "e" not in text.lower() else f"{value:.{digits}g}"


def main():
    refuse_changed_tree()
    revision = revision_of(sys.argv.pop(1))
    digits = 3
    if sys.argv[1].startswith("--digits="):
        digits = int(sys.argv.pop(1).split("=")[1])
    page, name = sys.argv[1], sys.argv[2]
    lines = [line for line in sys.stdin if "," in line]
    first = next(i for i, line in enumerate(lines) if not line.startswith(("{", " ")))
    rows = list(csv.DictReader(lines[first:]))
    if not rows:
        sys.exit(f"{name}: no rows")
    columns = dict(argument.split("=", 1) for argument in sys.argv[3:]) or {key: key for key in rows[0]}
    table = "| " + " | ".join(columns.values()) + " |\n|" + "---|" * len(columns) + "\n"
    for row in rows:
        table += "| " + " | ".join(shown(row[key] or "", digits) for key in columns) + " |\n"
    with open(page, encoding="utf-8") as file:
        text = file.read()
    pattern = rf"(<!-- table {re.escape(name)} -->\n).*?(<!-- end -->)"
    text, count = re.subn(pattern, lambda match: f"{match[1]}\n{table}\n{context(revision)}\n\n{match[2]}", text, flags=re.S)
    if count != 1:
        sys.exit(f"{page}: needs one pair of markers for the table {name}, has {count}")
    with open(page + ".tmp", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(page + ".tmp", page)
    print(table)


main()
