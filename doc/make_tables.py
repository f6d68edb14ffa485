#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Fills the tables of the pages with lines of test references.

A page has a block, whose comments are lines of their own:

    <!-- table: tests/verification/ring.output "ring, * cells: l2_u" by "20 cells" "40 cells" -->
    <!-- end -->

Each text in quotes is how lines of the file begin; '*' stands for anything.
These lines become a table of label and value between the two comments. With
'by' the texts after it become columns: a line whose label has the text as
words of its own goes to that column, and to the row of what is left of its
label, without the words that all rows end with; other lines are left out. A
line 'x <= 1e-10: yes' has the value '≤ 1e-10'.

  doc/make_tables.py [ROOT]          rewrites all pages below ROOT/doc
  doc/make_tables.py --check [ROOT]  exits with 1 if a page would change
"""

import pathlib
import re
import sys

START = re.compile(r"^<!-- table: ", re.MULTILINE)
BLOCK = re.compile(r"^<!-- table: (?P<head>[^\n]*?) -->\n(?:\|[^\n]*\n)*<!-- end -->",
                   re.MULTILINE)
BOUND = re.compile(r"^(.*?)\s*(<=|>=) (\S+): yes$")


def split(line):
    """Label and value of a line of a reference."""
    bound = BOUND.match(line)
    if bound:
        sign = "≤" if bound[2] == "<=" else "≥"
        return bound[1].rstrip(":"), f"{sign} {bound[3]}"
    label, _, value = line.rpartition(" ")
    return label.rstrip(":"), value


def begins(pattern):
    return re.compile(".*?".join(re.escape(part) for part in pattern.split("*")))


def without(label, word):
    """The label without the word, or None if it does not have it."""
    found = re.search(rf"(?<![\w.]){re.escape(word)}(?![\w.])", label)
    if not found:
        return None
    left = label[:found.start()] + label[found.end():]
    left = re.sub(r"\s*([,:])(\s*[,:])+", r"\1", left)
    return re.sub(r"\s+", " ", left).strip(" ,:")


def row(cells):
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"


def shortened(labels):
    """Labels without the last words that all of them have."""
    words = [label.split() for label in labels]
    while len(words) > 1 and min(map(len, words)) > 1 and \
            len({each[-1] for each in words}) == 1:
        words = [each[:-1] for each in words]
    return [" ".join(each).rstrip(",:") for each in words]


def plain(entries):
    return row(["", "value"]) + "|---|---|\n" + "".join(map(row, entries))


def pivoted(entries, columns):
    rows = {}
    for label, value in entries:
        for column in columns:
            left = without(label, column)
            if left is not None:
                values = rows.setdefault(left, {})
                if column in values:
                    raise ValueError(f"two lines for '{left}', '{column}'")
                values[column] = value
                break
    for column in columns:
        if not any(column in values for values in rows.values()):
            raise ValueError(f"no line has the words '{column}'")
    return (row([""] + columns) + "|---" * (len(columns) + 1) + "|\n" +
            "".join(row([label] + [values.get(column, "") for column in columns])
                    for label, values in zip(shortened(rows), rows.values())))


def table(root, head):
    """The lines between the two comments. ValueError if they cannot be made."""
    name, _, rest = head.partition(" ")
    prefixes, _, columns = rest.partition(" by ")
    prefixes, columns = (re.findall(r'"([^"]*)"', text) for text in (prefixes, columns))
    if not prefixes:
        raise ValueError(f"table of {name}: no text in quotes")
    if not (root / name).is_file():
        raise ValueError(f"there is no {name}")
    lines = [line.strip() for line in (root / name).read_text().splitlines()]
    entries = []
    for prefix in prefixes:
        found = [line for line in lines if begins(prefix).match(line)]
        if not found:
            raise ValueError(f"no line of {name} begins with '{prefix}'")
        entries += map(split, found)
    return pivoted(entries, columns) if columns else plain(entries)


def filled(root, text):
    def fill(block):
        return f"<!-- table: {block['head']} -->\n{table(root, block['head'])}<!-- end -->"
    return BLOCK.sub(fill, text)


def complaints(root, rewrite=False):
    """Pages whose tables are not those of the references."""
    found = []
    for page in sorted((root / "doc").rglob("*.md")):
        text = page.read_text()
        name = page.relative_to(root)
        try:
            if len(START.findall(text)) != len(BLOCK.findall(text)):
                raise ValueError("a table has no end")
            new = filled(root, text)
        except ValueError as error:
            found.append(f"{name}: {error}")
            continue
        if new != text and rewrite:
            page.write_text(new)
            print("rewritten:", name)
        elif new != text:
            found.append(f"{name}: a table is old, run doc/make_tables.py")
    return found


def main(words):
    check = "--check" in words
    roots = [word for word in words if word != "--check"]
    root = pathlib.Path(roots[0] if roots else pathlib.Path(__file__).parents[1])
    found = complaints(root.resolve(), rewrite=not check)
    print("".join(line + "\n" for line in found), end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
