#!/usr/bin/env python3
"""The functions of Vulkan, OpenCL, EGL and OpenGL, from their headers: a row for each, for faults.c.

    functions.py OUTPUT COMPILER...

A row is FUNCTION(number, name, kind, parameters). The kind is that of the result: an API's own codes, a handle next to a written
code, another value, or nothing.
"""
import re
import subprocess
import sys

HEADERS = """
#define CL_TARGET_OPENCL_VERSION 300
#define GL_GLEXT_PROTOTYPES
#define EGL_EGLEXT_PROTOTYPES
#include <vulkan/vulkan.h>
#include <CL/cl.h>
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
"""
PROTOTYPE = re.compile(r"([A-Za-z_][\w \*]*?[ \*])((?:vk|cl|egl|gl)[A-Z]\w*)\s*\(((?:[^();{}]|\([^()]*\))*)\)\s*;")


def kind(returned, name, parameters):
    if name.startswith("vk"):
        return {"VkResult": "VK_CODE", "void": "VK_NOTHING"}.get(returned, "VK_VALUE")
    if name.startswith("cl"):
        if returned == "cl_int":
            return "CL_CODE"
        return "CL_HANDLE" if parameters[-1:] and re.match(r"cl_int\s*\*", parameters[-1]) else "CL_VALUE"
    return "EGL_VALUE" if name.startswith("egl") else "GL_VALUE"


def main():
    text = subprocess.run(sys.argv[2:] + ["-E", "-P", "-"], input=HEADERS, stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout
    text = re.sub(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)", " ", text)
    text = " ".join(text.split())
    found = {}
    for returned, name, parameters in PROTOTYPE.findall(text):
        words = [word for word in returned.replace("*", " * ").split() if word not in ("extern", "const")]
        taken = [part.strip() for part in re.sub(r"\([^()]*\)", "()", parameters).split(",") if part.strip() != "void"]
        if "typedef" not in words:
            found[name] = (kind(" ".join(words), name, taken), len(taken))
    with open(sys.argv[1], "w") as file:
        for number, (name, (what, count)) in enumerate(sorted(found.items())):
            print("FUNCTION(%d, %s, %s, %d)" % (number, name, what, count), file=file)


if __name__ == "__main__":
    main()
