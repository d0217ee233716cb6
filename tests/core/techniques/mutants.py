#!/usr/bin/env python3
"""Changes one place of the text of a room of kernels at a time, and runs the tests that ought to notice.

mutants.py ROOM SOURCE BUILD COMPILER... -- [NAME HEADER SHELL]...
mutants.py --places SOURCE ROOM...    whether the rows' places are in the texts, and nothing is run

The device opencl reads the changed text at run time (RG_KERNEL_DIR); each test compares what it
finds with a law, a case worked out by hand, or a model of its own, never with another device. A
mutant that no test notices has lived, which fails, as does a test of the text as it is. The rows
are in mutant_rows.py in the folder of the room's tests. A room is a technique, or a folder of one.
"""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time


def rows_of(tests):
    """The rows of mutant_rows.py in the folder `tests`."""
    spec = importlib.util.spec_from_file_location("mutant_rows", tests / "mutant_rows.py")
    module = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    spec.loader.exec_module(module)
    return module.ROWS


def texts_of(root, source, build, compiler, kernels, folder):
    """Flattens the kernels under `root` into `folder`."""
    subprocess.run(
        [sys.executable, source / "kernels/build/flatten.py", source / "shaders", folder / "needs.d"]
        + compiler
        + ["-I", root, "-I", build, "--", folder]
        + [word for name, header, shell in kernels for word in (shell, header, name + ".cl")],
        check=True,
    )


def first_to_notice(programs, folder, tests):
    """The first of `tests`, programs in the folder `programs` and parts of them, that fails on the texts of `folder`, or None."""
    environment = dict(os.environ, RG_KERNEL_DIR=str(folder))
    for test in tests:
        program, *parts = test.split()
        done = subprocess.run(
            [programs / program, "opencl", *parts], env=environment, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE, text=True, timeout=600, check=False,
        )
        if "clBuildProgram" in done.stderr:
            sys.exit(f"mutants.py: a changed kernel cannot be built\n{done.stderr}")
        if done.returncode:
            return test, done.stderr
    return None


def check_places(rows, kernels):
    """Ends where a row's place is not there once in a text of the folder `kernels`."""
    wrong = []
    for row in rows:
        count = (kernels / row.file).read_text(encoding="utf-8").count(row.old)
        if count != 1:
            wrong.append(f"mutants.py: {row.about}: {row.file} has {count} times: {row.old}")
    if wrong:
        sys.exit("\n".join(wrong))


def mutated(source, root, kernels, row):
    """Changes a row's place in the copy `root` of the folder `kernels`."""
    text = (source / kernels / row.file).read_text(encoding="utf-8")
    (root / kernels / row.file).write_text(text.replace(row.old, row.new), encoding="utf-8")


def run(room, source, build, compiler, forms, folder):
    tests, kernels = pathlib.Path("tests/core/techniques") / room, pathlib.Path("kernels") / room
    rows, programs = rows_of(source / tests), build / tests
    check_places(rows, source / kernels)
    root, texts = folder / "root", folder / "texts"
    shutil.copytree(source / "kernels", root / "kernels")
    (root / "tests").symlink_to(source / "tests")
    texts.mkdir()
    for text in (build / "kernels").glob("*.cl"):
        shutil.copy(text, texts)
    failed = first_to_notice(programs, texts, sorted({test for row in rows for test in row.tests}))
    if failed:
        sys.exit(f"mutants.py: {failed[0]} fails on the text as it is\n{failed[1]}")
    lived = 0
    for row in rows:
        start = time.monotonic()
        mutated(source, root, kernels, row)
        texts_of(root, source, build, compiler, forms, texts)
        found = first_to_notice(programs, texts, row.tests)
        shutil.copy(source / kernels / row.file, root / kernels / row.file)
        lived += not found
        print(f"{'killed by ' + found[0] if found else 'LIVED':24} {row.file:20} {row.about}"
              f" ({time.monotonic() - start:.1f} s)", flush=True)
    print(f"{len(rows)} mutants, {lived} lived")
    return lived


def places(source, rooms):
    for room in rooms:
        rows = rows_of(source / "tests/core/techniques" / room)
        check_places(rows, source / "kernels" / room)
        print(f"{room}: {len(rows)} mutants")


def main():
    if sys.argv[1] == "--places":
        places(pathlib.Path(sys.argv[2]), sys.argv[3:])
        return
    split = sys.argv.index("--")
    room, source, build, *compiler = sys.argv[1:split]
    words = sys.argv[split + 1 :]
    with tempfile.TemporaryDirectory() as folder:
        lived = run(room, pathlib.Path(source), pathlib.Path(build), compiler,
                    list(zip(words[::3], words[1::3], words[2::3])), pathlib.Path(folder))
    sys.exit(1 if lived else 0)


if __name__ == "__main__":
    main()
