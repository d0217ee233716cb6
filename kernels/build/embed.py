#!/usr/bin/env python3
"""Puts code for drivers into the program: embed.py OUTPUT.c OUTPUT.S NAME... -- FILE...

The files are NAME.glsl, NAME.spv, NAME.cl and so on; each kernel gets `rg_code_NAME`, in the order of
enum rg_code_kind, with nothing where it has no such file. The assembler reads their bytes, which a
compiler would need many seconds for. OUTPUT.S holds their checksum, so that it changes with them.
"""
import hashlib
import os
import sys

KINDS = ["glsl", "spv", "cl", "vert", "vert.spv", "frag", "frag.spv", "rounded.spv", "vert.rounded.spv", "frag.rounded.spv"]


def assembler(symbol, path, data):
    return (
        f"    .balign 4\n    .globl {symbol}\n"
        f'{symbol}: .incbin "{path}" /* {hashlib.sha256(data).hexdigest()} */\n'
    )


def main():
    c_path, s_path, end = sys.argv[1], sys.argv[2], sys.argv.index("--")
    by_kernel = {name: {} for name in sys.argv[3:end]}
    for path in sys.argv[end + 1:]:
        kernel, kind = os.path.basename(path).split(".", 1)
        by_kernel[kernel][kind] = path
    c = ['#include "backends/kernel.h"\n']
    s = ['    .section .note.GNU-stack,"",%progbits\n    .section .rodata\n']
    for kernel, paths in by_kernel.items():
        entries = []
        for kind in KINDS:
            if kind not in paths:
                entries.append("{NULL, 0}")
                continue
            with open(paths[kind], "rb") as file:
                data = file.read()
            symbol = f"rg_bytes_{kernel}_{kind.replace('.', '_')}"
            c.append(f"extern const unsigned char {symbol}[];\n")
            s.append(assembler(symbol, paths[kind], data))
            entries.append(f"{{{symbol}, {len(data)}}}")
        c.append(f"extern const struct rg_kernel_code rg_code_{kernel}[];\n")
        c.append(f"const struct rg_kernel_code rg_code_{kernel}[] = {{{', '.join(entries)}}};\n")
    for path, lines in ((c_path, c), (s_path, s)):
        with open(path, "w", encoding="utf-8") as out:
            out.write("".join(lines))


main()
