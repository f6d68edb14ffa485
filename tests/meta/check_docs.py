#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Links in Markdown files lead somewhere; every picture is linked from a page, every
page of doc/topics from doc/README.md; tables of pages are lines of test references;
the README shows a scene as it is, and the results of a tutorial are what its test
compares."""

import pathlib
import re
import sys

import meta

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "doc"))
import make_tables  # noqa: E402

LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
CODE = re.compile(r"```.*?```", re.DOTALL)
SCENE = "prm/boundaries/tilted-roller.prm"


def pages(root):
    found = [root / "README.md"] if (root / "README.md").exists() else []
    return found + meta.files(root, ("doc", "prm"), {".md"})


def check_links(root, page):
    for link in LINK.findall(CODE.sub("", page.read_text())):
        if "://" not in link and not (page.parent / link).exists():
            yield f"{page.relative_to(root)}: there is no {link}"


def check_linked(root):
    """Pictures are linked from a page, pages on topics from the index."""
    index = root / "doc/README.md"
    linked = {(page.parent / link).resolve() for page in pages(root)
              for link in LINK.findall(CODE.sub("", page.read_text()))}
    indexed = {(index.parent / link).resolve()
               for link in LINK.findall(index.read_text())} \
        if index.exists() else set()
    for picture in meta.files(root, ["doc"], {".png"}):
        if picture.resolve() not in linked:
            yield f"{picture.relative_to(root)}: no page shows it"
    for page in meta.files(root, ["doc/topics"], {".md"}):
        if page.resolve() not in indexed:
            yield f"{page.relative_to(root)}: not in {index.relative_to(root)}"


def check_shown(root, page, source):
    """The page shows the whole file in a block of its own."""
    if page.exists() and source.exists() and \
            f"```\n{source.read_text()}```\n" not in page.read_text():
        yield (f"{page.relative_to(root)}: does not show "
               f"{source.relative_to(root)} as it is")


def check(root):
    complaints = []
    for page in pages(root):
        complaints += check_links(root, page)
    complaints += check_linked(root)
    complaints += make_tables.complaints(root)
    complaints += check_shown(root, root / "README.md", root / SCENE)
    for output in meta.files(root, ["tests/steps"], {".output"}):
        complaints += check_shown(
            root, root / "doc/steps" / output.stem / "results.md", output)
    return complaints


GOOD = {
    "README.md": "[a](doc/a.md) [b](https://b.org)\n```\nset A = 1\n```\n",
    "doc/a.md": "[up](../README.md#top) ![b](figures/b.png)\n",
    "doc/figures/b.png": "picture\n",
    "doc/README.md": "[cuts](topics/cuts.md)\n",
    "doc/topics/cuts.md": """# Cuts
<!-- table: tests/verification/cuts.output "GIMP: tip" -->
|  | value |
|---|---|
| GIMP: tip over aligned - 1 | ≤ 0.01 |
<!-- end -->
<!-- table: tests/verification/cuts.output "*: u_*" by "u_x" "u_y" -->
|  | u_x | u_y |
|---|---|---|
| FE | 1.0 | 2.0 |
| GIMP |  | 3.0 |
<!-- end -->
""",
    "tests/verification/cuts.output": "GIMP: tip over aligned - 1 <= 0.01: yes\n"
                                      "FE: u_x 1.0\nFE: u_y 2.0\nGIMP: u_y 3.0\n",
    SCENE: "set A = 1\n",
    "tests/steps/step-1.output": "1 2\n",
    "doc/steps/step-1/results.md": "```\n1 2\n```\n",
}
DEFECTS = [
    {"doc/b.md": "[c](c.md)\n"},
    {"doc/figures/c.png": "picture\n"},
    {"doc/topics/ring.md": "# Ring\n"},
    # a value, a bound, a line that is gone, a new row, and no file
    {"tests/verification/cuts.output": "GIMP: tip over aligned - 1 <= 0.01: yes\n"
                                       "FE: u_x 1.0\nFE: u_y 2.5\nGIMP: u_y 3.0\n"},
    {"tests/verification/cuts.output": "GIMP: tip over aligned - 1 <= 0.02: yes\n"
                                       "FE: u_x 1.0\nFE: u_y 2.0\nGIMP: u_y 3.0\n"},
    {"tests/verification/cuts.output": "FE: u_x 1.0\nFE: u_y 2.0\nGIMP: u_y 3.0\n"},
    {"tests/verification/cuts.output": "GIMP: tip over aligned - 1 <= 0.01: yes\n"
                                       "FE: u_x 1.0\nFE: u_y 2.0\nGIMP: u_y 3.0\n"
                                       "MPM: u_y 3.0\n"},
    {"doc/README.md": "[cuts](topics/cuts.md)\n"
                      "<!-- table: tests/none.output \"a\" -->\n<!-- end -->\n"},
    {"doc/README.md": "[cuts](topics/cuts.md)\n"
                      "<!-- table: tests/verification/cuts.output \"GIMP\" -->\n"},
    {SCENE: "set A = 2\n"},
    {"tests/steps/step-1.output": "1 3\n"},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
