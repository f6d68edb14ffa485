#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Constants that sources keep to themselves have names of their own: which sources
share a unit of the build changes with each file that comes."""

import re
import sys

import meta

UNNAMED = re.compile(r"^  namespace\n  \{\n(.*?)^  \} // namespace\n",
                     re.MULTILINE | re.DOTALL)
CONSTANT = re.compile(r"^    (?:constexpr|const) [^;()={]*?(\w+)\s*[={]",
                      re.MULTILINE)
FUNCTION = re.compile(r"^    (\w+)\(", re.MULTILINE)


def check(root):
    constants, functions = {}, {}
    complaints = []
    for path in meta.files(root, ["source"], {".cc"}):
        text = "".join(UNNAMED.findall(path.read_text()))
        name = path.relative_to(root).as_posix()
        for function in FUNCTION.findall(text):
            functions.setdefault(function, name)
        for constant in CONSTANT.findall(text):
            first = constants.setdefault(constant, name)
            if first != name:
                complaints.append(f"{name}: '{constant}' is in {first} too")
    return complaints + [f"{name}: '{constant}' is a function in "
                         f"{functions[constant]}"
                         for constant, name in constants.items()
                         if functions.get(constant, name) != name]


SOURCE = """namespace moraine
{{
  namespace
  {{
    {}
  }} // namespace
}} // namespace moraine
"""
GOOD = {
    "source/run/a.cc": SOURCE.format("constexpr double told = 2;"),
    "source/run/b.cc": SOURCE.format("const std::string other = \"b\";"),
}
DEFECTS = [
    {"source/run/b.cc": SOURCE.format("constexpr unsigned int told = 2;")},
    {"source/core/c.cc": SOURCE.format("const std::string told{\"c\"};")},
    {"source/core/c.cc": SOURCE.format("void\n    told(const double x)\n    {}")},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
