#!/usr/bin/env python3
"""Writes a C file that holds every kernel's code: embed.py OUTPUT FILE...

The files are NAME.glsl, NAME.spv, NAME.cl and so on; each kernel gets `rg_code_NAME`, in the order of
enum rg_code_kind, with nothing where it has no such file.
"""
import os
import sys

KINDS = ["glsl", "spv", "cl", "vert", "vert.spv", "frag", "frag.spv"]


def c_array(name, data):
    rows = [data[i : i + 24] for i in range(0, len(data), 24)]
    body = ",\n".join(",".join(str(byte) for byte in row) for row in rows)
    return f"_Alignas(4) static const unsigned char {name}[] = {{\n{body}}};\n"


def main():
    output, files = sys.argv[1], sys.argv[2:]
    by_kernel = {}
    for path in files:
        kernel, kind = os.path.basename(path).split(".", 1)
        by_kernel.setdefault(kernel, {})[kind] = path
    with open(output, "w", encoding="utf-8") as out:
        out.write('#include "core/device/kernel.h"\n')
        for kernel, paths in by_kernel.items():
            entries = []
            for kind in KINDS:
                if kind not in paths:
                    entries.append("{NULL, 0}")
                    continue
                name = f"{kernel}_{kind.replace('.', '_')}"
                with open(paths[kind], "rb") as file:
                    out.write(c_array(name, file.read()))
                entries.append(f"{{{name}, sizeof({name})}}")
            out.write(f"extern const struct rg_kernel_code rg_code_{kernel}[];\n")
            out.write(f"const struct rg_kernel_code rg_code_{kernel}[] = {{{', '.join(entries)}}};\n")


main()
