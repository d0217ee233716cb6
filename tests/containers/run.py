#!/usr/bin/env python3
"""raingauge as containers and other users have it.

    run.py SUITE RAINGAUGE

    SUITE: signals  INT, TERM and HUP, also of the first process of a container
           links    output through links that other users put into a folder for all

Prints TAP, for meson. What needs a namespace of its own is skipped where it may not have one.
"""
import os
import sys

sys.dont_write_bytecode = True  # the sources' folder stays as it is
sys.path.insert(1, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "cli"))

import links
import signals
from runner import Runner

SUITES = {"signals": signals.run, "links": links.run}


def main():
    suite, raingauge = sys.argv[1:3]
    runner = Runner(raingauge, "", "", "", "", "")
    SUITES[suite](runner)
    return runner.finish()


if __name__ == "__main__":
    sys.exit(main())
