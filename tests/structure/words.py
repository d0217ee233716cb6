#!/usr/bin/env python3
"""Finds structs in buffers whose words are missing or wrong in `kernels/build/describe.h`."""
import glob
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LETTERS = {"float": "f", "int": "i", "uint": "u"}


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return re.sub(r"//[^\n]*", "", file.read())


def words_of(kind, structs):
    """A letter for each word of a type, in order."""
    if kind in LETTERS:
        return LETTERS[kind]
    letters = ""
    for member in filter(str.strip, structs[kind].split(";")):
        inner, names = member.split(None, 1)
        letters += words_of(inner, structs) * len(names.split(","))
    return letters


def main():
    text = "\n".join(read(os.path.relpath(path, ROOT)) for path in sorted(glob.glob(ROOT + "/kernels/**/*.h", recursive=True)))
    structs = dict(re.findall(r"\bRG_STRUCT\((\w+)\)\s*\{([^}]*)\}", text))
    told = dict(re.findall(r"(?m)^#define RG_WORDS_(\w+)\s*, \"(\w+)\"", read("kernels/build/describe.h")))
    held = set(re.findall(r"\b(?:IN|OUT|INOUT|ATOMIC)\(\s*\d+\s*,\s*(\w+)\s*,", text)) - {"T"}
    held -= {"rg_prim"}  # a builtin of each program, not an asset
    problems = ["%s: kernels hold it in a buffer; say its words" % kind for kind in sorted(held - set(told))]
    problems += ["%s: no buffer holds it; take its row out" % kind for kind in sorted(set(told) - held)]
    problems += ["%s: is told as %s, and is %s" % (kind, letters, words_of(kind, structs)) for kind, letters in sorted(told.items())
                 if letters != words_of(kind, structs)]
    print("\n".join("kernels/build/describe.h: " + problem for problem in problems))
    return 1 if problems or len(held) < 6 else 0


sys.exit(main())
