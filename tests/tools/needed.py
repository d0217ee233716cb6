#!/usr/bin/env python3
"""Prints ninja's targets that tests need: needed.py BUILD [--suite NAME]... [--no-suite NAME]...

Those of the tests in one of the suites, all unless one is named, and in none of the others, as `meson test` picks them. Those of
`make thorough` are left out.
"""
import argparse
import json
import os
import subprocess


def introspect(build, what):
    told = subprocess.run(["meson", "introspect", "--" + what, build], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(told.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("--suite", action="append", default=[])
    parser.add_argument("--no-suite", action="append", default=[])
    options = parser.parse_args()
    subprocess.run(["ninja", "-C", options.build, "build.ninja"], check=True, stdout=subprocess.DEVNULL)
    files = {target["id"]: target["filename"] for target in introspect(options.build, "targets")}
    wanted = set()
    for test in introspect(options.build, "tests"):
        suites = {suite.split(":")[-1] for suite in test["suite"]}
        if not suites & {"thorough", *options.no_suite} and (not options.suite or suites & set(options.suite)):
            wanted.update(name for target in test["depends"] for name in files[target])
    print(" ".join(sorted(os.path.relpath(name, os.path.abspath(options.build)) for name in wanted)))


if __name__ == "__main__":
    main()
