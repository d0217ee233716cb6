#!/usr/bin/env python3
"""Turns one kernel header into the text that a driver compiles.

flatten.py LANGUAGE KERNEL SHELL OUTPUT -- COMPILER...

Runs the C preprocessor over SHELL (shaders/*.glsl, shaders/*.cl), which includes the kernel, so that
what is embedded is one flat file without includes or macros. For GLSL it then makes every float
`precise`, which forbids a driver to contract or reorder: the one thing that the dialect cannot say
in C and OpenCL C alike.
"""
import re
import subprocess
import sys


def preprocess(language, kernel, shell, compiler):
    command = compiler + [
        "-E", "-P", "-undef", "-nostdinc", "-x", "c",
        f"-DRG_{language.upper()}=1",
        f'-DRG_KERNEL_HEADER="{kernel}.h"',
        shell,
    ]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def end_of_block(text, start):
    """The index behind the brace that closes the one at `start`."""
    depth = 0
    for at in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at + 1
    raise ValueError("a brace is not closed")


def make_returns_precise(text, types):
    """Each result passes through a precise local: GLSL lets no function's type be qualified."""
    function = re.compile(rf"\b({types})\s+\w+\s*\([^()]*\)\s*(?=\{{)")
    returned = re.compile(r"\breturn\b([^;]*);")
    done, at = [], 0
    while match := function.search(text, at):
        end = end_of_block(text, match.end())
        local = rf"{{ {match.group(1)} rg_result =\1; return rg_result; }}"
        done += [text[at : match.end()], returned.sub(local, text[match.end() : end])]
        at = end
    return "".join(done) + text[at:]


def make_precise(text):
    """`precise` before every local that holds floats, results of functions included."""
    structs = re.findall(r"\bstruct\s+(\w+)\s*\{", text)
    types = "|".join(["float"] + [s for s in structs if s != "rg_ctx"])
    local = re.compile(rf"(^|[;{{}}(]\s*)((?:{types})\s+\w+\s*[=;])", re.M)
    parts = re.split(
        r"(struct\s+\w+\s*\{[^}]*\};|buffer\s+\w+\s*\{[^}]*\}|uniform\s+\w+\s*\{[^}]*\})",
        make_returns_precise(text, types),
    )
    return "".join(
        part if index % 2 else local.sub(r"\1precise \2", part)
        for index, part in enumerate(parts)
    )


def main():
    language, kernel, shell, output = sys.argv[1:5]
    text = preprocess(language, kernel, shell, sys.argv[6:])
    if language == "glsl":
        text = "#version 450 core\n" + make_precise(text)
    with open(output, "w", encoding="utf-8") as file:
        file.write(text)


main()
