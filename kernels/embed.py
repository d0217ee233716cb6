#!/usr/bin/env python3
"""Writes a C file that holds every kernel's code: embed.py OUTPUT FILE...

The files are NAME.glsl, NAME.spv and NAME.cl; each kernel gets `rg_code_NAME`, in the order of
enum rg_code_kind.
"""
import os
import sys

KINDS = [".glsl", ".spv", ".cl"]


def c_array(name, data):
    rows = [data[i : i + 24] for i in range(0, len(data), 24)]
    body = ",\n".join(",".join(str(byte) for byte in row) for row in rows)
    return f"_Alignas(4) static const unsigned char {name}[] = {{\n{body}}};\n"


def main():
    output, files = sys.argv[1], sys.argv[2:]
    by_kernel = {}
    for path in files:
        kernel, kind = os.path.splitext(os.path.basename(path))
        by_kernel.setdefault(kernel, {})[kind] = path
    with open(output, "w", encoding="utf-8") as out:
        out.write('#include "core/kernel.h"\n')
        for kernel, paths in by_kernel.items():
            for kind in KINDS:
                with open(paths[kind], "rb") as file:
                    out.write(c_array(f"{kernel}_{kind[1:]}", file.read()))
            entries = ", ".join(f"{{{kernel}_{k[1:]}, sizeof({kernel}_{k[1:]})}}" for k in KINDS)
            out.write(f"extern const struct rg_kernel_code rg_code_{kernel}[];\n")
            out.write(f"const struct rg_kernel_code rg_code_{kernel}[] = {{{entries}}};\n")


main()
