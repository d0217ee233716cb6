#!/usr/bin/env python3
"""What flattening refuses, and what it makes anew: flattening.py FLATTEN SHADERS COMPILER...

A kernel with a name that one of the languages reserves is refused in one line, whatever text is made of it, and leaves no
text; with another name it is taken. The words are tried as a local, a member, a parameter and a function. A text is made
anew where a file that it was made of is younger than the last time, and only then.
"""
import os
import subprocess
import sys
import tempfile

KERNEL = """#include "kernels/dialect/lang.h"
RG_STRUCT(tried_params)
{
    int count;
};
RG_STRUCT_SIZE(tried_params, 1)
RG_STRUCT(tried)
{
    float %(member)s;
};
RG_FN float %(function)s(float %(parameter)s)
{
    return %(parameter)s + 1.0f;
}
#define RG_PARAMS tried_params
#define RG_SLOTS  OUT(1, float, heights)
#include "kernels/dialect/slots/slots.h"
RG_GRID_KERNEL(tried)
{
    tried t;
    t.%(member)s = 1.0f;
    float %(local)s = %(function)s(t.%(member)s);
    heights_put(rg, x, %(local)s);
}
"""
PLACES = {"member": "height", "function": "raised", "parameter": "from", "local": "sum"}
RESERVED = {
    "GLSL": ["sample", "input", "output", "filter", "in", "out", "buffer", "flat", "vec3", "sampler2D", "gl_x", "patch"],
    "OpenCL C": ["kernel", "global", "local", "constant", "private", "float4", "uchar", "quad"],
}


def flatten(folder, names):
    """The exit status and message of flattening a kernel with these names, and which texts it left."""
    if names:
        with open(os.path.join(folder, "tried.h"), "w", encoding="utf-8") as file:
            file.write(KERNEL % names)
    program, shaders, *compiler = sys.argv[1:]
    jobs = ["grid.glsl", "tried.h", "tried.glsl", "grid.cl", "tried.h", "tried.cl"]
    run = subprocess.run([program, shaders, os.path.join(folder, "tried.d"), *compiler, "-I", folder, "--", folder, *jobs],
                         stderr=subprocess.PIPE, text=True, check=False)
    left = [name for name in ("tried.glsl", "tried.cl", "tried.d") if os.path.exists(os.path.join(folder, name))]
    return run.returncode, run.stderr, left


def check(what, is_right, found):
    if not is_right:
        sys.exit(f"{what}: {found}")


def check_what_is_made():
    """A text that flattening should make is spoiled first: it is whole again where it was made."""
    spoiled, header = "spoiled", "tried.h"
    with tempfile.TemporaryDirectory() as folder:
        text = os.path.join(folder, "tried.cl")

        def remade(names):
            with open(text, "w", encoding="utf-8") as file:
                file.write(spoiled)
            status, said, _ = flatten(folder, names)
            check("flattened again", (status, said) == (0, ""), (status, said))
            with open(text, encoding="utf-8") as file:
                return file.read()

        flatten(folder, PLACES)
        check("nothing is younger", remade(None) == spoiled, "made anew")
        check("a header is younger", "raised" in remade(PLACES), "left as it was")
        check("another header", "lowered" in remade({**PLACES, "function": "lowered"}), "left as it was")
        os.remove(text)
        flatten(folder, None)
        check("a text that is gone", os.path.exists(text), "left out")
        os.remove(text + ".d")
        check("it is not known what it was made of", "lowered" in remade(None), "left as it was")
        os.remove(os.path.join(folder, header))
        status, _, _ = flatten(folder, None)
        check("a header that is gone", status, "taken")


def main():
    check_what_is_made()
    with tempfile.TemporaryDirectory() as folder:
        status, said, left = flatten(folder, PLACES)
        check("plain names", (status, said, len(left)) == (0, "", 3), (status, said, left))
    tries = [({language: words[at:at + 4]}, words[at:at + 4])
             for language, words in RESERVED.items() for at in range(0, len(words), 4)]
    tries.append(({"GLSL": ["half", "out"], "OpenCL C": ["half", "kernel"]}, ["half", "out", "kernel", "plain"]))
    for wrong, words in tries:
        with tempfile.TemporaryDirectory() as folder:
            status, said, left = flatten(folder, dict(zip(PLACES, words)))
        says = [f"tried.h: {language} reserves {', '.join(sorted(names))}: use other names (docs/dialect.md)"
                for language, names in wrong.items()]
        check(words, status == 1 and said.splitlines() == says and "tried.d" not in left, (status, said, left))


main()
