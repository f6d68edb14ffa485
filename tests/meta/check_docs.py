#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Links in Markdown files lead somewhere; every picture and every page of
doc/verification is linked; the README shows a scene as it is, and the results of
a tutorial are what its test compares."""

import re
import sys

import meta

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
    """Pictures are linked from a page, pages on verification from their index."""
    index = root / "doc/verification/README.md"
    linked = {(page.parent / link).resolve() for page in pages(root)
              for link in LINK.findall(CODE.sub("", page.read_text()))}
    indexed = {(index.parent / link).resolve()
               for link in LINK.findall(index.read_text())} | {index.resolve()} \
        if index.exists() else set()
    for picture in meta.files(root, ["doc"], {".png"}):
        if picture.resolve() not in linked:
            yield f"{picture.relative_to(root)}: no page shows it"
    for page in meta.files(root, ["doc/verification"], {".md"}):
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
    complaints += check_shown(root, root / "README.md", root / SCENE)
    for output in meta.files(root, ["tests/steps"], {".output"}):
        complaints += check_shown(
            root, root / "doc/steps" / output.stem / "results.md", output)
    return complaints


GOOD = {
    "README.md": "[a](doc/a.md) [b](https://b.org)\n```\nset A = 1\n```\n",
    "doc/a.md": "[up](../README.md#top) ![b](figures/b.png)\n",
    "doc/figures/b.png": "picture\n",
    "doc/verification/README.md": "[block](block.md)\n",
    "doc/verification/block.md": "# Block\n",
    SCENE: "set A = 1\n",
    "tests/steps/step-1.output": "1 2\n",
    "doc/steps/step-1/results.md": "```\n1 2\n```\n",
}
DEFECTS = [
    {"doc/b.md": "[c](c.md)\n"},
    {"doc/figures/c.png": "picture\n"},
    {"doc/verification/ring.md": "# Ring\n"},
    {SCENE: "set A = 2\n"},
    {"tests/steps/step-1.output": "1 3\n"},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
