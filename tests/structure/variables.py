#!/usr/bin/env python3
"""Compares docs/environment.md with the sources: variables.py [ROOT].

The page has each variable that the product reads or a passport holds. The passport holds all variables of drivers on the page,
and those others of which the page says so. Prints one line for each difference, and exits 1 if there are any.
"""
import os
import re
import sys

HERE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PRODUCT = ("core", "backends", "harness")
READ = re.compile(r'\bgetenv\("(\w+)"\)')
HELD = re.compile(r'^    \{"(\w+)", (?:true|false)\},$', re.M)
NAMED = re.compile(r"`([A-Z_]{3,}[A-Z0-9_]*)(?:=\w+)?`")
# The place of a driver's code cache does not change its code; raingauge itself sets this variable.
NOT_HELD = {"MESA_SHADER_CACHE_DIR"}


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def sources(root):
    for room in PRODUCT:
        for folder, _, names in os.walk(os.path.join(root, room)):
            yield from (read(folder, name) for name in names if name.endswith((".c", ".h", ".cpp")))


def problems(root):
    page = read(root, "docs/environment.md")
    of_drivers, said = page.split("## Variables that drivers read")[1].split("\n## ")[0].split("The passport holds the variables of this section")
    held = set(HELD.findall(read(root, "harness/record/passport/variables.c")))
    read_by_us = {name for text in sources(root) for name in READ.findall(text)}
    for name in sorted((read_by_us | held) - set(NAMED.findall(page))):
        yield "%s is read or held, and not on the page" % name
    promised = set(NAMED.findall(of_drivers + said)) - NOT_HELD
    for name in sorted(promised ^ held):
        yield "%s is %s" % (name, "held by passports, which the page does not say" if name in held else "said to be held by passports, and is not")


def main():
    found = list(problems(sys.argv[1] if len(sys.argv) > 1 else HERE))
    for problem in found:
        print("docs/environment.md: " + problem)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
