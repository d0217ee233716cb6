#!/usr/bin/env python3
"""Puts texts into the program: texts.py OUTPUT.c [-- NAME FILE...]... makes `const char rg_text_NAME[]` of each, its files
one after the other."""
import sys


def main():
    lines = []
    for name, *paths in (part.split("\n") for part in "\n".join(sys.argv[1:]).split("\n--\n")[1:]):
        text = b""
        for path in paths:
            with open(path, "rb") as file:
                text += file.read()
        text += b"\0"
        lines.append(f"extern const char rg_text_{name}[];\nconst char rg_text_{name}[] = {{")
        lines += ["    " + " ".join(f"{byte}," for byte in text[i:i + 20]) for i in range(0, len(text), 20)]
        lines.append("};")
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


main()
