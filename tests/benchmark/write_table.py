"""Writes a table of measurements into a Markdown page.

    PROGRAM | write_table.py [--digits=3] PAGE.md NAME [COLUMN=HEADING ...]

Reads CSV with a header line (lines before it, and the context of Google Benchmark, are skipped) and replaces the text
between `<!-- table NAME -->` and `<!-- end -->` by a Markdown table and a line with date, version, machine and load.
With COLUMN=HEADING arguments only these columns are written, under these headings.
"""

import csv
import datetime
import os
import re
import subprocess
import sys


def context():
    def git(*arguments):
        return subprocess.run(["git", "-C", os.path.dirname(os.path.abspath(__file__)), *arguments], capture_output=True,
                              text=True, check=False).stdout.strip()
    # Pages and pictures change while their tables are written, and no result depends on them.
    changed = git("status", "--porcelain", "--untracked-files=no", "--", ":/", ":(top,exclude)*.md", ":(top,exclude)docs/pictures")
    version = git("describe", "--always") + ("-dirty" if changed else "")
    processor = "unknown processor"
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                processor = line.split(":", 1)[1].strip()
                break
    load = os.getloadavg()[0]
    return (f"Measured {datetime.date.today()} at revision {version} on {os.cpu_count()} cores of {processor}, "
            f"load average {load:.1f} at the end.")


def shown(text, digits):
    try:
        value = float(text)
    except ValueError:
        return text.replace("|", "/")
    return text if value == int(value) and abs(value) < 1e15 and "e" not in text.lower() else f"{value:.{digits}g}"


def main():
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
    text, count = re.subn(pattern, lambda match: f"{match[1]}\n{table}\n{context()}\n\n{match[2]}", text, flags=re.S)
    if count != 1:
        sys.exit(f"{page}: needs one pair of markers for the table {name}, has {count}")
    with open(page + ".tmp", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(page + ".tmp", page)
    print(table)


main()
