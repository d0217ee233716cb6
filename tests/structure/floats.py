#!/usr/bin/env python3
"""Finds the C library's functions of floats that it does not round to the last bit: its versions differ.
What a host computes is of double precision, rounded once."""
import glob
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NAMES = "|".join("a?sinh? a?cosh? a?tanh? atan2 exp exp2 expm1 log log2 log10 log1p pow cbrt hypot erfc? [lt]gamma".split())
CALL = re.compile(r"\b(?:%s)f\(|#include <cglm/" % NAMES)


def main():
    paths = [path for room in ("backends", "core", "harness") for path in sorted(glob.glob("%s/%s/**/*.*" % (ROOT, room), recursive=True))
             if path.endswith((".c", ".h", ".cpp"))]
    problems = 0
    for path in paths:
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                if CALL.search(line.split("//")[0]):
                    problems += 1
                    print("%s:%d: %s: write the function of doubles, and round it once" % (os.path.relpath(path, ROOT), number, line.strip()))
    return 1 if problems or len(paths) < 500 else 0


sys.exit(main())
