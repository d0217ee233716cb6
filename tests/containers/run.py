#!/usr/bin/env python3
"""raingauge as containers, limits and other users have it.

    run.py SUITE RAINGAUGE REFUSING WANTING

    SUITE: signals       INT, TERM and HUP, also of the first process of a container
           refusals      some calls and limits that are refused, for commands that take below a second
           all refusals  all of them, for all commands
           wants         what raingauge itself lacks: memory, descriptors, processes, disk; a sample
           all wants     all of it
           links         output through links that other users put into a folder for all

Prints TAP, for meson. A test that needs its own namespace is skipped if it may not have one.
"""
import os
import sys

sys.dont_write_bytecode = True  # the sources' folder stays unchanged
sys.path.insert(1, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "cli"))

import links
import refusals
import signals
import wants
from runner import Runner

SUITES = {"signals": signals.run, "refusals": refusals.run_some, "all refusals": refusals.run_all, "links": links.run}
WANTS = {"wants": wants.run_some, "all wants": wants.run_all}


def main():
    suite, raingauge, refusing, wanting = sys.argv[1:5]
    runner = Runner(raingauge, "", "", "", "", "")
    if suite in WANTS:
        WANTS[suite](runner, os.path.abspath(refusing), wanting)
    else:
        SUITES[suite](runner, os.path.abspath(refusing))
    return runner.finish()


if __name__ == "__main__":
    sys.exit(main())
