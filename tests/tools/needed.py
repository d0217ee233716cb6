#!/usr/bin/env python3
"""Prints ninja's targets that tests need: needed.py BUILD [--suite NAME]... [--no-suite NAME]...

All that a build makes but what is of other tests alone: of those in none of the suites, if any is named, or in one of the others, as
`meson test` picks them. Those of `make thorough` are left out.
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
    wanted, unwanted = set(), set()
    for test in introspect(options.build, "tests"):
        suites = {suite.split(":")[-1] for suite in test["suite"]}
        is_picked = not suites & {"thorough", *options.no_suite} and (not options.suite or suites & set(options.suite))
        (wanted if is_picked else unwanted).update(test["depends"])
    names = [name for target in introspect(options.build, "targets") if target["build_by_default"] and target["id"] not in unwanted - wanted
             for name in target["filename"]]
    print(" ".join(sorted(os.path.relpath(name, os.path.abspath(options.build)) for name in names)))


if __name__ == "__main__":
    main()
