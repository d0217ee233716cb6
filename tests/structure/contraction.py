#!/usr/bin/env python3
"""Whether a build compiles all C and C++ without contraction: contraction.py BUILD.

A fused product and sum rounds once, so that a device's bits depend on the processor. Prints the files whose last word on it is
another than -ffp-contract=off, or that ask for arithmetic that is not C's, and exits 1.
"""
import json
import os
import shlex
import sys

LOOSE = ("-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-fassociative-math", "-freciprocal-math", "-march=native")


def fault(command):
    words = shlex.split(command)
    contracting = [word for word in words if word.startswith("-ffp-contract=")]
    loose = [word for word in words if word in LOOSE]
    return loose[0] if loose else "" if contracting[-1:] == ["-ffp-contract=off"] else (contracting or ["no -ffp-contract=off"])[-1]


def check_itself():
    """What the check must find, and what it must let pass."""
    assert not fault("cc -O3 -ffp-contract=fast -ffp-contract=off -c a.c")
    assert fault("cc -O3 -c a.c") and fault("cc -ffp-contract=off -ffp-contract=fast -c a.c") and fault("cc -ffp-contract=off -Ofast -c a.c")


def main():
    check_itself()
    with open(os.path.join(sys.argv[1], "compile_commands.json")) as file:
        commands = [row for row in json.load(file) if row["file"].endswith((".c", ".cpp"))]
    faults = {row["file"]: fault(row["command"]) for row in commands if fault(row["command"])}
    for name, word in sorted(faults.items()):
        print(f"{name}: {word}")
    if not commands:
        print("nothing is compiled")
    return bool(faults) or not commands


if __name__ == "__main__":
    sys.exit(main())
