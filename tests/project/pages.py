#!/usr/bin/env python3
"""Checks what links_test.cpp does not: widths, revisions of tables, and numbers in prose that come from tables.

    pages.py REPOSITORY            the checks
    pages.py REPOSITORY --words    words of prose, page by page: outside tables, with their footers, and code

- Lines of the documentation have at most 120 columns, except tables; its prose has at most 19,000 words.
- Every table between `<!-- table NAME -->` and `<!-- end -->` names the revision that measured it, neither unknown
  nor dirty, and a commit of this repository.
- What `make -f Makefile.cases` runs on a page is a target, a case, a variant or a study; names that begin with my_ are
  the reader's.
- A target takes as long in CONTRIBUTING.md, and in a comment behind its command, as the help of make or the title of
  the study says.
- `0.408<!--= docs/data/ranges.md ranges brunelleschi_friction0.4 "max"-->`: page, table, row and heading of the cell
  that the number before the comment quotes, rounded to its digits. Parts with spaces stand in quotes, the first
  cells of a row are joined by "|" (`\\|` in a table). A fifth part multiplies the cell, a sixth is added to it; `/ROW`
  before them divides the cell by that of another row. `114<!--= PAGE count right verdict-->` counts the rows of all
  tables of the page with that text under that heading; `refused*` is any text that begins so.
- "Ten mistakes", "eight steps", "six pictures" before the first section of a page are as many as the page has.
- No sentence says that something is not modelled which has a key of its own.
- A symbol that two pages define by a formula in brackets, `kappa = (...) / rho`, is the same on both.
- docs/site.yml lists every page of docs/; a test that a page names, `Suite.Name` or `Suite.`, exists.
"""
import fnmatch
import pathlib
import re
import shlex
import subprocess
import sys

WIDTH = 120
MOST_WORDS = 19000

BLOCK = re.compile(r"^<!-- table (\S+) -->$(.*?)^<!-- end -->$", re.S | re.M)
COMMAND = re.compile(r"make -f (?:[~\w./]*/)?Makefile\.cases((?: +[\w.=\'/-]+)+)")
TIME = re.compile(r"(?:(half an?|an?|\d+|two|three|four|five|ten) )?(second|minute|hour)s?\b")
QUOTE = re.compile(r"([-+]?\d[\d,]*\.?\d*(?:[eE][-+]?\d+)?)<!--=\s*(.*?)-->", re.S)
NUMBERS = "zero one two three four five six seven eight nine ten eleven twelve".split()
COUNTED = {"mistakes": r"^## \d+\.", "steps": r"^(?:## |\*\*)?\d+\.", "pictures": r"^!\["}
DEFINITION = re.compile(r"\b([a-z]{4,}) = (\([^()]+\) / \w+)")
MODELLED = re.compile(r"\b(cohesion|tension|tensile|compressive|dilatancy|chains|ties|wythes|cracks(?! through))\b")


def prose(text):
    """The lines outside code and tables, with their numbers; comments that quote a cell are left out."""
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith(("|", "    ")):
            yield number, re.sub(r"<!--=.*?-->", "", line)


def words(text):
    text = re.sub(r"<!--.*?-->", "", BLOCK.sub("", text), flags=re.S)
    return sum(len(line.split()) for _, line in prose(text))


def prose_pages(root):
    return sorted([*root.glob("docs/*.md"), *root.glob("docs/data/*.md")])


def words_of(root):
    return sum(words(page.read_text()) for page in prose_pages(root))


def wide_lines(name, text):
    return [f"{name}:{number}: {len(line)} columns, more than {WIDTH}" for number, line in enumerate(text.split("\n"), 1)
            if len(line) > WIDTH and not line.startswith("|") and " " in line.strip("-*> ")]


def commits_of(root):
    """Hashes of all commits; None where there is no complete repository."""
    def git(*words):
        return subprocess.run(["git", "-C", root, *words], capture_output=True, text=True, check=False).stdout.split()
    return git("rev-list", "--all") if git("rev-parse", "--is-shallow-repository") == ["false"] else None


def revisions(name, text, commits):
    faults = []
    for block in BLOCK.finditer(text):
        table = f"{name} {block[1]}"
        found = re.search(r"^Measured .*? revision (\S+)", block[2], re.M)
        clean = found is not None and re.fullmatch(r"(v[0-9.]+-\d+-g)?[0-9a-f]{7,40}", found[1]) is not None
        clean = clean and (commits is None or any(commit.startswith(found[1].split("-g")[-1]) for commit in commits))
        if not clean:
            faults.append(f"{table}: revision {found[1] if found else 'missing'}; measure it from a commit that is kept")
    return faults


def names_of_make(root):
    names = {file.stem for folder in ("cases", "cases/studies") for file in (root / folder).glob("*.yaml")}
    names |= {line.split()[0] for line in (root / "cases/variants.txt").read_text().split("\n") if line[:1].isalnum()}
    targets = re.search(r"^TARGETS := (.*)$", (root / "Makefile.cases").read_text(), re.M)[1]
    return names | set(targets.split())


def dead_commands(name, text, known):
    words = [word for command in COMMAND.finditer(text) for word in command[1].split()]
    return [f"{name}: make {word}: no target, case, variant or study" for word in words
            if not (word.startswith(("-", "my_", "mine")) or "=" in word or word.isupper() or word.startswith("NAME")
                    or word.removesuffix("_assessment") in known)]


def seconds(text):
    """The first duration that the text names, in s; None without one."""
    found = TIME.search(text)
    if found is None:
        return None
    words = {None: 1, "a": 1, "an": 1, "half a": 0.5, "half an": 0.5, "two": 2, "three": 3, "four": 4, "five": 5, "ten": 10}
    number = words[found[1]] if found[1] in words else int(found[1])
    return number * {"second": 1, "minute": 60, "hour": 3600}[found[2]]


def durations(root):
    """Seconds of each target whose help or title names a time in brackets."""
    titles = {line[1]: line[2] for line in re.finditer(r'@echo "  ([\w-]+) .*\(([^()]*)\)"', (root / "Makefile.cases").read_text())}
    for file in (root / "cases/studies").glob("*.yaml"):
        found = re.search(r"^title:.*\(([^()]*)\)", file.read_text(), re.M)
        titles |= {file.stem: found[1]} if found else {}
    return {name: seconds(text) for name, text in titles.items() if seconds(text) is not None}


def wrong_durations(name, text, known):
    """In comments behind commands, and in rows of a table with the headings `make ...` and takes."""
    said = [(found[1], found[2]) for found in re.finditer(r"make -f Makefile\.cases ([\w-]+) +# (.*)", text)]
    for line in text.split("\n"):
        row = cells(line) if line.startswith("|") else []
        if len(row) == 4 and len(row[2].split(";")) == len(row[3].split(";")):
            said += zip((target.split()[0] for target in row[2].split(";") if target.split()), row[3].split(";"))
    return [f"{name}: {target} takes {time.strip()}, but make says {known[target]:g} s" for target, time in said
            if target in known and seconds(time) not in (None, known[target])]


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def cell_of(text, table, row, heading):
    """The number in the row that begins with the cells of `row`, under the heading."""
    block = next((block[2] for block in BLOCK.finditer(text) if block[1] == table), None)
    if block is None:
        raise LookupError(f"no table {table}")
    lines = [cells(line) for line in block.split("\n") if line.startswith("|")]
    if heading not in lines[0]:
        raise LookupError(f"table {table} has no column {heading}")
    key = cells(row.replace("\\|", "|"))
    rows = [line for line in lines[2:] if line[:len(key)] == key]
    if len(rows) != 1:
        raise LookupError(f"{len(rows)} rows of table {table} begin with {row}")
    number = re.search(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?", rows[0][lines[0].index(heading)])
    if number is None:
        raise LookupError(f"no number in row {row} of table {table}")
    return float(number[0])


def count_of(text, value, heading):
    """Number of rows of all tables whose cell under the heading matches the pattern of a shell."""
    total, header = 0, None
    for line in text.split("\n"):
        row = cells(line)
        if not line.startswith("|"):
            header = None
        elif header is None:
            header = row
        elif heading in header and not set(line) <= set("|-: ") and fnmatch.fnmatchcase(row[header.index(heading)], value):
            total += 1
    return total


def quoted_numbers(root, name, text):
    faults = []
    for quote in QUOTE.finditer(text):
        number, source = quote[1].replace(",", ""), " ".join(quote[2].split())
        try:
            page, table, row, heading, *scale = shlex.split(source)
            other = scale.pop(0)[1:] if scale and scale[0].startswith("/") else None
            factor, summand = map(float, scale + ["1", "0"][len(scale):])
            source_text = (root / page).read_text()
            value = count_of(source_text, row, heading) if table == "count" else cell_of(source_text, table, row, heading)
            value /= cell_of(source_text, table, other, heading) if other else 1
            value = value * factor + summand
        except (LookupError, OSError, ValueError) as fault:
            faults.append(f"{name}: {number} ({source}): {fault}")
            continue
        mantissa, _, power = number.lower().partition("e")
        unit = 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))
        if abs(float(number) - value) > 0.5001 * unit:
            faults.append(f"{name}: {number}, but the table has {value:g} ({source})")
    if text.count("<!--=") != len(QUOTE.findall(text)):
        faults.append(f"{name}: a comment <!--= does not follow a number")
    faults += [f"{name}: | in a comment ends the cell of its table; write \\|" for line in text.split("\n")
               if line.startswith("|") and re.search(r"<!--=(?:(?!-->).)*(?<!\\)\|.*?-->", line)]
    return faults


def names_of_tests(root):
    found = (re.findall(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", file.read_text()) for file in root.glob("tests/**/*.cpp"))
    return {f"{suite}.{test}" for pairs in found for suite, test in pairs}


def dead_tests(name, text, tests):
    said = re.findall(r"`([A-Z][A-Za-z0-9]+\.(?:[A-Z]\w*)?)`", text)
    return [f"{name}: {test}: no such test" for test in said if not any(known.startswith(test) for known in tests)]


def counted_lists(name, text):
    said = re.findall(rf"\b({'|'.join(NUMBERS)})\s+(?:\w+\s+){{0,2}}({'|'.join(COUNTED)})\b", text.partition("\n## ")[0], re.I)
    counts = [(number, what, len(re.findall(COUNTED[what], text, re.M))) for number, what in said]
    return [f"{name}: {number} {what}, but the page has {count}" for number, what, count in counts
            if NUMBERS.index(number.lower()) != count]


def modelled_after_all(name, text):
    said = [sentence for sentence in re.split(r"\.\s|\n\n|\n\|", text) if "not modelled" in sentence.lower()]
    return [f"{name}: not modelled, but has keys: {found[0]}" for sentence in said for found in MODELLED.finditer(sentence)]


def unlike_definitions(texts):
    """Symbols with several formulas; `texts` is the text of each page by its name."""
    said = {}
    for name, text in texts.items():
        for symbol, formula in DEFINITION.findall(text):
            said.setdefault(symbol, {}).setdefault(formula, name)
    return [f"{symbol} is {' but '.join(f'{formula} in {name}' for formula, name in formulas.items())}"
            for symbol, formulas in said.items() if len(formulas) > 1]


def faults_of(root):
    faults, known, times, commits = [], names_of_make(root), durations(root), commits_of(root)
    site, tests = (root / "docs/site.yml").read_text(), names_of_tests(root)
    pages = sorted([*prose_pages(root), root / "tests/benchmark/README.md", root / "assembly/FORMAT.md",
                    *(root / folder / "README.md" for folder in (".", "cases", "generators", "solver", "postproc"))])
    for page in pages:
        name, text = str(page.relative_to(root)), page.read_text()
        faults += wide_lines(name, text) + revisions(name, text, commits) + quoted_numbers(root, name, text)
        faults += dead_commands(name, text, known) + wrong_durations(name, text, times)
        faults += counted_lists(name, text) + modelled_after_all(name, text) + dead_tests(name, text, tests)
        faults += [f"{name}: not in docs/site.yml"] if name.startswith("docs/") and name not in site else []
    count = words_of(root)
    faults += [f"docs: {count} words of prose, more than {MOST_WORDS}"] if count > MOST_WORDS else []
    faults += unlike_definitions({str(page.relative_to(root)): page.read_text() for page in pages})
    name = "CONTRIBUTING.md"
    return faults + wrong_durations(name, (root / name).read_text(), times)


def check_the_checks(root):
    """Each check sees its fault."""
    table = "<!-- table t -->\n\n| run | max |\n|---|---|\n| a | 0.408 |\n\nMeasured 2026 at revision {}\n\n<!-- end -->"
    assert not wide_lines("p", "a " * 60) and wide_lines("p", "a " * 61) and not wide_lines("p", "| " + "a " * 90)
    assert not revisions("p", table.format("fffe37b"), None) and not revisions("p", table.format("fffe37b"), ["fffe37b0"])
    assert not revisions("p", table.replace("at revision", "by the programs of revision").format("v0.2.0-13-g02420a8"), ["02420a8"])
    assert all(revisions("p", table.format(bad), ["fffe37b0"]) for bad in ("unknown", "fffe37b-dirty", "fffe37c"))
    assert cell_of(table, "t", "a", "max") == 0.408
    assert dead_commands("p", "`make -f Makefile.cases dome`", {"arch"})
    assert not dead_commands("p", "`make -f ~/c/Makefile.cases -j2 A=1 arch my_b`, make -f Makefile.cases NAME", {"arch"})
    assert words(table + "\ntwo words<!--= a b-->\n| no |\n```\nno\n```\n    no\n") == 2
    assert seconds("half an hour, 8 GB") == 1800 and seconds("four minutes") == 240 and seconds("8 GB") is None
    assert wrong_durations("p", "| p | t | arch; b | 3 minutes; 1 minute |", {"arch": 60})
    assert not wrong_durations("p", "    make -f Makefile.cases arch   # a minute", {"arch": 60})
    assert count_of(table, "*", "max") == 1 and count_of(table, "a*", "run") == 1 and count_of(table, "b", "run") == 0
    assert dead_tests("p", "`Arch.Stands`", {"Arch.Falls"}) and not dead_tests("p", "`Arch.`, `Arch.Stands`", {"Arch.Stands"})
    assert counted_lists("p", "# Two likely mistakes\n## 1. a") and not counted_lists("p", "# A page\nTwo pictures\n![\n![\n")
    assert modelled_after_all("p", "Not modelled: creep, cohesion. a") and not modelled_after_all("p", "Not modelled: soil. Ties")
    assert unlike_definitions({"p": "kappa = (a + b) / c", "q": "kappa = (a - b) / c"})
    assert not unlike_definitions({"p": "kappa = (a + b) / c", "q": "so kappa = (a + b) / c, here"})
    page = 'docs/data/ranges.md ranges brunelleschi_friction0.4 max'
    assert not quoted_numbers(root, "p", f"0.41<!--= {page}-->") and quoted_numbers(root, "p", f"0.42<!--= {page}-->")
    assert not quoted_numbers(root, "p", f"-59<!--= {page} 100 -100-->") and quoted_numbers(root, "p", f"-59<!--= {page} 100-->")
    ratio = f"{page} /octagon_circular_friction0.4"
    assert not quoted_numbers(root, "p", f"1.0<!--= {ratio}-->") and quoted_numbers(root, "p", f"1.1<!--= {ratio}-->")
    assert not quoted_numbers(root, "p", f"0<!--= {ratio} 100 -100-->") and quoted_numbers(root, "p", f"1.0<!--= {page} /x-->")
    cell = '| 2560<!--= docs/data/ranges.md proportions "40{}|0" blocks--> |'
    assert not quoted_numbers(root, "p", cell.format("\\")) and quoted_numbers(root, "p", cell.format(""))
    assert quoted_numbers(root, "p", f"0.41<!--= {page} x-->") and quoted_numbers(root, "p", "word<!--= x-->")


if __name__ == "__main__":
    repository = pathlib.Path(sys.argv[1])
    if "--words" in sys.argv:
        for page in prose_pages(repository):
            print(f"{words(page.read_text()):6} {page.relative_to(repository)}")
        print(f"{words_of(repository):6} in all")
        sys.exit()
    check_the_checks(repository)
    found = faults_of(repository)
    print("\n".join(found))
    sys.exit(1 if found else 0)
