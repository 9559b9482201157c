#!/usr/bin/env python3
"""Checks pages with axe-core in headless Chromium, and that every picture has a text with numbers.

    tests/postproc/accessibility.py out/*/post/report.html

AXE names axe.min.js; without it npm installs axe-core into a temporary folder. Exit code 1 if a page has a serious or
critical finding; 77 (skipped) without Chromium, or without axe-core and npm or a network.
"""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

RUN = """
<script>
(window.cupolaView || Promise.resolve()).catch(() => 0).then(() => axe.run({resultTypes: ["violations"]})).then((result) => {
  const found = result.violations.filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => [v.id, v.impact, v.nodes.length, v.nodes[0].target.join(" "), v.help]);
  const pictures = Array.from(document.images).filter((image) => !image.alt.trim()).length;
  const out = document.createElement("script");
  out.type = "application/json", out.id = "found", out.textContent = JSON.stringify({found, pictures});
  document.body.append(out);
});
</script>
"""


def findings(page, axe):
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "page.html")
        with open(page, encoding="utf-8") as source, open(copy, "w", encoding="utf-8") as out:
            out.write(source.read() + "<script>" + axe.replace("</script", "<\\/script") + "</script>" + RUN)
        dom = subprocess.run(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader",
                              "--user-data-dir=" + folder, "--virtual-time-budget=60000", "--dump-dom", "file://" + copy],
                             capture_output=True, text=True, timeout=300).stdout
    answer = re.search(r'id="found">(.*?)</script>', dom, re.S)
    return json.loads(html.unescape(answer.group(1))) if answer else None


def axe_text():
    """The text of axe-core; None if it cannot be had."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.environ.get("AXE", "")
        if not path and shutil.which("npm"):
            subprocess.run(["npm", "install", "--silent", "--prefix", folder, "axe-core"], capture_output=True, timeout=120)
            path = os.path.join(folder, "node_modules/axe-core/axe.min.js")
        if not os.path.exists(path):
            return None
        with open(path, encoding="utf-8") as file:
            return file.read()


def main():
    axe = axe_text() if shutil.which("chromium") else None
    if axe is None:
        print("skipped: needs chromium, and AXE=.../axe.min.js or npm")
        return 77
    bad = 0
    for page in sys.argv[1:]:
        result = findings(page, axe)
        if result is None:
            print(f"{page}: axe-core did not end")
        else:
            print(f"{page}: {len(result['found'])} serious findings, {result['pictures']} pictures without a text")
            for name, impact, count, target, help_text in result["found"]:
                print(f"  {impact}: {name}, {count} times, first {target}: {help_text}")
        bad += result is None or bool(result["found"]) or result["pictures"] > 0
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
