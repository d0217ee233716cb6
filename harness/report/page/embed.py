#!/usr/bin/env python3
"""Makes the page's text of its parts: embed.py OUTPUT.S OUTPUT.head OUTPUT.tail -- PAGE.html STYLE.css SCRIPT.js...

The page runs nothing and loads nothing but what stands in it: its Content-Security-Policy allows one style and one script, by
their SHA-256. Its data goes between head and tail, where PAGE.html has {data}. The assembler reads both files, for a compiler would
need long for so many bytes.
"""
import base64
import hashlib
import sys


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def digest(text):
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def main():
    s_path, head_path, tail_path, end, page_path, style_path, *script_paths = sys.argv[1:]
    assert end == "--"
    style, script = read(style_path), "\n".join(read(path) for path in script_paths)
    if "</script" in script or "<!--" in script or "</style" in style:
        sys.exit("embed.py: a script or style would end its own element; write the text in two parts")
    page = read(page_path)
    for name, text in (("style_digest", digest(style)), ("script_digest", digest(script)), ("style", style), ("script", script)):
        assert page.count("{%s}" % name) == 1
        page = page.replace("{%s}" % name, text)
    head, tail = page.split("{data}")
    for path, text in ((head_path, head), (tail_path, tail)):
        with open(path, "wb") as out:
            out.write(text.encode() + b"\0")
    with open(s_path, "w", encoding="utf-8") as out:
        out.write('    .section .note.GNU-stack,"",%progbits\n    .section .rodata\n')
        for symbol, path, text in (("rg_page_head", head_path, head), ("rg_page_tail", tail_path, tail)):
            sha = hashlib.sha256(text.encode()).hexdigest()
            out.write(f'    .globl {symbol}\n{symbol}: .incbin "{path}" /* {sha} */\n')


if __name__ == "__main__":
    main()
