#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""No class outside of parameter structs has more than 20 data members: such a
class does more than one thing."""

import re
import sys

import meta

MOST = 20
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"', re.DOTALL)
DIRECTIVE = re.compile(r"^\s*#(?:[^\n\\]|\\.|\\\n)*", re.MULTILINE)
CLASS = re.compile(r"\b(class|struct)\s+(\w+)(?:\s+final)?\s*"
                   r"(?::[^:;{}][^;{}]*)?\{")
NO_MEMBER = re.compile(r"^(using|typedef|friend|static|template|enum|class|"
                       r"struct|public|private|protected|operator)\b")


def end_of_block(text, start):
    """Behind the brace that closes the one before start."""
    depth = 1
    while depth:
        depth += {"{": 1, "}": -1}.get(text[start], 0)
        start += 1
    return start


def without(text, opening, closing):
    """The text without what stands between innermost pairs, and the pairs."""
    pair = re.compile(f"\\{opening}[^\\{opening}\\{closing}]*\\{closing}")
    while pair.search(text):
        text = pair.sub("@", text)
    return text


def statements(body):
    """The statements of a class; a body or an initialiser in braces is '@'."""
    flat = re.sub(r"\b(public|private|protected)\s*:(?!:)", ";",
                  without(body, "{", "}"))
    # A function ends with its body, a member with its semicolon.
    flat = re.sub(r"(\)[\w\s]*(?::[^;@]*(?:@[^;@]*)*)?)@", r"\1;", flat)
    return [part.strip() for part in flat.split(";")]


def n_members(body):
    count = 0
    for statement in statements(body):
        if not statement or NO_MEMBER.match(statement):
            continue
        plain = without(statement.split("=")[0], "<", ">")
        if "(" not in plain and re.search(r"[\w@>&*]\s+[\w&*]", plain):
            count += 1 + plain.count(",")
    return count


def classes(text):
    """Name and body of each class, also of those in others."""
    text = NOT_CODE.sub(" ", DIRECTIVE.sub("", text))
    for found in CLASS.finditer(text):
        if re.search(r"enum\s+$", text[:found.start()]):
            continue
        end = end_of_block(text, found.end())
        yield found[2], text[found.end():end - 1]


def check(root):
    complaints = []
    for path in meta.files(root, ("include", "source"), {".h", ".cc"}):
        for name, body in classes(path.read_text()):
            n = n_members(body)
            if n > MOST and not name.endswith("Parameters"):
                complaints.append(f"{path.relative_to(root)}: {name} has {n} "
                                  f"data members, allowed: {MOST}")
    return complaints


def class_with(n, member="std::map<int, std::vector<A>> a{N} = {{}};"):
    return ("template <int dim>\nclass Big : public Base<dim>\n{\npublic:\n"
            "  Big(const int a, int b = 3)\n    : a1(a)\n    , a2{b}\n  {}\n"
            "  int f() const { return 1; }\n  void g(int) = 0;\n"
            "  using T = int;\n  struct Part\n  {\n    int a, b;\n  };\n"
            "private:\n" +
            "".join(f"  {member.replace('{N}', str(i))} // int a;\n"
                    for i in range(n)) + "};\n")


GOOD = {
    "include/moraine/a/big.h": class_with(20),
    "include/moraine/a/data.h":
    class_with(40).replace("class Big", "struct BigParameters"),
    "source/a/functions.cc": class_with(
        20, "std::function<int(const A &, B)> f{N};"),
}
DEFECTS = [
    {"include/moraine/a/c.h": class_with(21)},
    {"source/a/c.cc": class_with(21, "const A<dim> &a{N};")},
    {"source/a/c.cc": class_with(21, "std::function<int(A, B)> f{N};")},
    {"source/a/c.cc": class_with(21, "bool b{N} = false;")},
    {"source/a/c.cc": class_with(11, "double a{N}, b{N};")},
    {"source/a/c.cc":
     "namespace\n{\nclass Outer\n{\n" + class_with(21) + "int a;\n};\n}\n"},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
