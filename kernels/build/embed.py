#!/usr/bin/env python3
"""Puts code for drivers into the program: embed.py OUTPUT.c OUTPUT.S OUTPUT.bin NAME... -- FILE...

The files are NAME.glsl, NAME.spv, NAME.cl and so on; each kernel gets `rg_code_NAME`, in the order of
RG_CODE_KINDS in backends/kernel.h, with nothing where it has no such file. They are compressed one by
one, side by side in OUTPUT.bin, which the assembler reads: a compiler would need many seconds for its bytes.
OUTPUT.S holds their checksum, so that it changes with them.
"""
import hashlib
import multiprocessing
import os
import re
import sys
import zlib

HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../backends/kernel.h")


def pack(path):
    with open(path, "rb") as file:
        data = file.read()
    return zlib.compress(data, 6), len(data)


def main():
    with open(HEADER, encoding="utf-8") as file:
        kinds = re.findall(r'X\(\w+, "([\w.]+)"\)', file.read())
    c_path, s_path, bin_path, end = *sys.argv[1:4], sys.argv.index("--")
    paths = sys.argv[end + 1:]
    by_kernel = {name: {} for name in sys.argv[4:end]}
    with multiprocessing.Pool() as pool:
        for path, packed in zip(paths, pool.map(pack, paths, chunksize=16)):
            kernel, kind = os.path.basename(path).split(".", 1)
            by_kernel[kernel][kind] = packed
    symbol = "rg_bytes_" + os.path.basename(bin_path).replace(".", "_")
    c = [f'#include "backends/kernel.h"\nextern const unsigned char {symbol}[];\n']
    packed = bytearray()
    for kernel, forms in by_kernel.items():
        entries = []
        for kind in kinds:
            data, size = forms.get(kind, (b"", 0))
            entries.append(f"{{{symbol} + {len(packed)}, {len(data)}, {size}}}")
            packed += data
        c.append(f"extern const struct rg_embedded_code rg_code_{kernel}[];\n")
        c.append(f"const struct rg_embedded_code rg_code_{kernel}[] = {{{', '.join(entries)}}};\n")
    s = (
        '    .section .note.GNU-stack,"",%progbits\n    .section .rodata\n'
        f"    .globl {symbol}\n"
        f'{symbol}: .incbin "{bin_path}" /* {hashlib.sha256(packed).hexdigest()} */\n'
    )
    for path, content in ((c_path, "".join(c).encode()), (s_path, s.encode()), (bin_path, packed)):
        with open(path, "wb") as out:
            out.write(content)


if __name__ == "__main__":
    main()
