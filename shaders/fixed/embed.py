#!/usr/bin/env python3
"""Puts the shaders of fixed functions into the program: embed.py OUTPUT.c GLSLC SHADER...

A section of a shader is what `#ifdef NAME` chooses, but for VULKAN. Each becomes a row of rg_fixed_codes (fixed.h): the shader's
GLSL without its first line, and its SPIR-V.
"""
import concurrent.futures
import json
import re
import subprocess
import sys


def compile(job):
    """The SPIR-V of a section, as numbers of C."""
    glslc, path, name = job
    return subprocess.run([glslc, "--target-env=vulkan1.2", "-O", "-mfmt=num", "-D" + name, "-o", "-", path],
                          check=True, stdout=subprocess.PIPE, text=True).stdout


def main():
    out, glslc, *paths = sys.argv[1:]
    jobs, c, rows = [], ['#include "shaders/fixed/fixed.h"\n'], []
    for path in paths:
        with open(path) as file:
            text = file.read()
        stage = path.rsplit(".", 1)[1]
        lines = text.split("\n", 1)[1].splitlines()
        c.append(f"static const char {stage}[] = \n" + "\n".join(json.dumps(line + "\n") for line in lines) + ";\n")
        jobs += [(glslc, path, name) for name in dict.fromkeys(re.findall(r"^#ifdef (\w+)$", text, re.MULTILINE))]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for (_, path, name), words in zip(jobs, pool.map(compile, jobs)):
            stage = path.rsplit(".", 1)[1]
            c.append(f"static const uint32_t {stage}_{name}[] = {{{words}}};\n")
            rows.append(f'{{RG_FIXED_STAGE_{stage.upper()}, "{name}", {stage}, {stage}_{name}, sizeof({stage}_{name})}},\n')
    c += ["const struct rg_fixed_code rg_fixed_codes[] = {\n", *rows, "{0}};\n"]
    with open(out, "w") as file:
        file.write("".join(c))


if __name__ == "__main__":
    main()
