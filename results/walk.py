#!/usr/bin/env python3
"""Keeps the printed tables in the README, docs/tables.md and docs/claims.md equal to what the program prints from the stored tables.

    walk.py [--check] PROGRAM [PAGE...]

In a page an indented line `$ raingauge table ... --from results/tables` is followed by that command's output, up to a
line that is not indented; the output is replaced. --check writes nothing, and exits 1 if a page shows another output.
"""
import os
import re
import shlex
import subprocess
import sys

sys.dont_write_bytecode = True  # the folder stays as it is

import script

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGES = [os.path.join(ROOT, *page.split("/")) for page in ("README.md", "docs/tables.md", "docs/claims.md")]
SHOWN = re.compile(r"^(    \$ raingauge (table [^\n|]*--from results/tables)\n)((?:    (?!\$ )[^\n]*\n|\n(?=\n*    [^$\s]))*)", re.M)


def printed(program, words):
    run = subprocess.run([program, *shlex.split(words)], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    return "".join("    " + line + "\n" if line else "\n" for line in run.stdout.rstrip("\n").split("\n"))


def renew(program, page, only_checks):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    if not SHOWN.search(text):
        sys.exit(f"{page}: shows nothing that table --from results/tables prints")
    made = SHOWN.sub(lambda shown: shown[1] + printed(program, shown[2]), text)
    if made == text:
        return
    if only_checks:
        sys.exit(f"{page}: shows what the tables do not say; results/walk.py {program} makes it anew")
    script.write(page, made)


def main():
    args = script.arguments(__doc__, "PROGRAM", "[PAGE...]", checks=True)
    for page in args.page or PAGES:
        renew(os.path.abspath(args.program), page, args.check)


if __name__ == "__main__":
    sys.exit(script.run(main))
