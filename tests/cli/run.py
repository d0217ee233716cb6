#!/usr/bin/env python3
"""The command line as people and scripts meet it: exit codes, messages, files left behind.

    run.py SUITE RAINGAUGE KERNEL_DIR CRASHING_DRIVER

    SUITE: cases    a table: a new command adds rows
           drivers  the same, of devices that need a driver or lack one
           results  what table, diff and verify print, on the CPU
           wrong    a driver that draws wrongly is found
           doctor   the report about this machine
           pages    the manual page and bash's completion
           install  what meson installs

Prints TAP, for meson.
"""
import sys

sys.dont_write_bytecode = True  # the sources' folder stays as it is

import cases
import doctor
import installed
import pages
import results
from runner import Runner

SUITES = {
    "cases": lambda runner: cases.run(runner, cases.ON_CPU),
    "drivers": lambda runner: cases.run(runner, cases.WITH_DRIVERS),
    "results": lambda runner: runner.check_all(results.CHECKS),
    "wrong": lambda runner: runner.check_all(results.WRONG),
    "doctor": lambda runner: runner.check_all(doctor.CHECKS),
    "pages": lambda runner: runner.check_all(pages.CHECKS),
    "install": lambda runner: runner.check_all(installed.CHECKS),
}


def main():
    runner = Runner(*sys.argv[2:5])
    SUITES[sys.argv[1]](runner)
    return runner.finish()


if __name__ == "__main__":
    sys.exit(main())
