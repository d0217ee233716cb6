#!/usr/bin/env python3
"""Compiles kernels' texts to SPIR-V: spirv.py FOLDER SUFFIX COMMAND... -- TEXT...

One process of COMMAND, glslc with options, compiles all, for its start takes longer than most texts. NAME.glsl becomes FOLDER/NAME.SUFFIX,
and NAME.frag, as any other text, FOLDER/NAME.frag.SUFFIX. What is newer than its text, by the same command, stays as it is.
"""
import os
import pathlib
import subprocess
import sys
import tempfile


def main():
    end = sys.argv.index("--")
    folder, suffix, command = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:end]
    made = {text: folder / f"{text.stem if text.suffix == '.glsl' else text.name}.{suffix}" for text in map(pathlib.Path, sys.argv[end + 1:])}
    told = folder / f"{next(iter(made.values())).name}.command"
    same = told.exists() and told.read_text(encoding="utf-8") == " ".join(command)
    old = [text.absolute() for text, spirv in made.items() if not same or not spirv.exists() or spirv.stat().st_mtime < text.stat().st_mtime]
    with tempfile.TemporaryDirectory(dir=folder) as work:
        if old and subprocess.run([*command, "-c", *old], cwd=work, check=False).returncode:
            sys.exit(1)
        for text, spirv in made.items():
            if text.absolute() in old:
                os.replace(pathlib.Path(work) / f"{text.stem if text.suffix == '.glsl' else text.name}.spv", spirv)
    told.write_text(" ".join(command), encoding="utf-8")


if __name__ == "__main__":
    main()
