#!/usr/bin/env python3
"""Copies the tests that need no source tree, and their list: copy_tests.py BUILD FOLDER. `raingauge-tests` runs them from there.

These are the tests of devices, techniques and arithmetic that are programs. Scripts of the tree are left out, and tests of host code, which
depend on no machine. Programs keep their places relative to the library that they share, so that they find it. FOLDER is `tests` in the
folder of raingauge's readers, which tests find by links in `core`.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBRARY = "tests/libtested.so"
READERS = ("raingauge_importer", "raingauge_oiio.so", "raingauge_picture_reader")
# Beginnings of names of tests that look at what only a source tree or a build has.
NEED_THE_TREE = ("fuzz ",)


def introspect(build):
    told = subprocess.run(["meson", "introspect", "--tests", str(build)], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(told.stdout)


class Copies:
    """What was copied into the folder, by the paths of a test's command."""

    def __init__(self, build, folder):
        self.build, self.folder = build, folder

    def bring(self, path, to):
        target = self.folder / to
        if not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if path.is_dir() else shutil.copy2)(path, target)
        return "{tests}/" + str(to)

    def argument(self, text):
        """As the runner understands it: a copy, a file that is written, or the text itself."""
        path = pathlib.Path(os.path.normpath(text))
        if not path.is_absolute():
            return text
        if self.build in path.parents:
            return "{temporary}/" + path.name
        return self.bring(path, pathlib.Path("data") / path.relative_to(ROOT))

    def command(self, words):
        program = pathlib.Path(words[0])
        first = "raingauge" if program.name == "raingauge" else self.bring(program, program.relative_to(self.build))
        return [first] + [self.argument(word) for word in words[1:]]


def is_wanted(test, build):
    suites = {suite.split(":")[-1] for suite in test["suite"]}
    is_program = build in pathlib.Path(test["cmd"][0]).parents
    return is_program and not suites & {"host", "thorough", "watched"} and not test["name"].startswith(NEED_THE_TREE)


def main():
    build, folder = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    copies = Copies(build, folder)
    copies.bring(build / LIBRARY, LIBRARY)
    (folder / "core").mkdir()
    for name in READERS:
        (folder / "core" / name).symlink_to("../../" + name)
    tests = [{"name": test["name"], "command": copies.command(test["cmd"]),
              "environment": {name: value for name, value in test["env"].items() if name != "LD_LIBRARY_PATH"}}
             for test in introspect(build) if is_wanted(test, build)]
    (folder / "tests.json").write_text(json.dumps(tests, indent=1) + "\n")
    print(f"{len(tests)} tests in {folder}")


if __name__ == "__main__":
    main()
