#!/usr/bin/env python3
"""The command line as people and scripts meet it: exit codes, messages, files left behind.

    run.py SUITE RAINGAUGE KERNEL_DIR CRASHING_DRIVER MISBEHAVING_DRIVER EARLIER_CLOCK

    SUITE: atlas    the streak atlas is made, kept where XDG_CACHE_HOME says, and read
           cases    a table of commands and how they end: a new command adds rows
           renders  the same of `render`
           tables   the same of `table`
           drivers  the same, of devices that need a driver or lack one
           results  what table, diff, render and atlas print, and what is refused for its size, on the CPU
           clips    frames in a row, as clips and as numbered pictures, on the CPU
           stored   tables that were interrupted, or are printed again
           machines records of several machines, side by side
           farm     plans, shards and merges
           shards   a plan, two shards and a merge
           parts    gates and verifications in shards
           befallen  the same, of records that are cut, copied, of another commit, or that a full disk loses
           losses   runs that are killed, that lose their disk, folder or clock, and a second one beside one that measures
           long     what verify prints, tables that are counted, set in a row, begun or measured anew, an atlas that is not kept
           failing  drivers that are there and cannot be used, and what is absent
           all      the same, of every command
           misbehaving  drivers that crash, hang, lie about their end or lose their device
           ways     the same, in all ways, of the commands that take longer, files of pictures of all kinds, and native pictures of all switches
           vacuous  commands that are left with nothing to compare or to measure
           idle     the same, all of them
           gates    one device held against another
           baselines  a device held against what was kept of it
           reports  what gates tell, of names with any characters and of what is expected
           ci       gates as CI services and runners of googletest run them
           bisects  the first of several drivers that is bad
           acts     what a file from elsewhere may have raingauge do
           shrinking  a driver that miscompiles: blamed, and shrunk to a case
           compiling  a driver that cannot compile or run a kernel: named, and shrunk to a case
           wrong    a driver that draws wrongly is found
           named    a driver that is named wrongly is refused
           sides    a second driver in a folder runs, and keeps its code apart
           doctor   the report about this machine, and a timeline of frames
           fixed    fixed functions of drivers, what turns parts of them off, and faults planted into them
           native   devices that draw through the driver's own pipeline
           same     fixed functions and native pictures of many launches
           pages    the manual page and bash's completion
           kept     the tables that the repository keeps
           install  what meson installs

Prints TAP, for meson.
"""
import os
import signal
import sys

sys.dont_write_bytecode = True  # the sources' folder stays unchanged
for room in ("devices", "drivers", "drivers/fixed", "printed", "tables"):
    sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), room))

import acts
import atlases
import baselines
import befallen
import besides
import bisecting
import cases
import ci
import clips
import compiling
import doctor
import failing
import farm
import fixed
import gates
import installed
import kept
import limits
import losses
import machines
import misbehaving
import named
import native
import own
import pages
import pictures
import planted
import reports
import resuming
import same
import shards
import shrinking
import stored
import tables
import traces
import vacuous
import verifying
import wrong
from runner import Runner

SUITES = {
    "atlas": lambda runner: runner.check_all(atlases.FIRST),
    "cases": lambda runner: cases.run(runner, cases.COMMANDS),
    "renders": lambda runner: cases.run(runner, cases.RENDERS),
    "tables": lambda runner: cases.run(runner, cases.TABLES),
    "drivers": lambda runner: cases.run(runner, cases.WITH_DRIVERS),
    "results": lambda runner: runner.check_all(tables.CHECKS + own.CHECKS + pictures.CHECKS + besides.CHECKS + atlases.CHECKS + limits.CHECKS),
    "clips": lambda runner: runner.check_all(clips.CHECKS),
    "stored": lambda runner: runner.check_all(stored.CHECKS),
    "machines": lambda runner: runner.check_all(machines.CHECKS),
    "farm": lambda runner: runner.check_all(farm.CHECKS),
    "shards": lambda runner: runner.check_all(farm.FEW),
    "parts": lambda runner: runner.check_all(shards.CHECKS),
    "befallen": lambda runner: runner.check_all(befallen.CHECKS),
    "losses": lambda runner: runner.check_all(losses.CHECKS + resuming.CHECKS),
    "long": lambda runner: runner.check_all(tables.LONG + stored.LONG + verifying.LONG + shards.LONG + atlases.LONG + limits.LONG + kept.LONG),
    "failing": lambda runner: runner.check_all(failing.CHECKS),
    "all": lambda runner: runner.check_all(failing.THOROUGH),
    "misbehaving": lambda runner: runner.check_all(misbehaving.CHECKS),
    "ways": lambda runner: runner.check_all(misbehaving.THOROUGH + compiling.THOROUGH + besides.THOROUGH + native.THOROUGH + pictures.THOROUGH),
    "vacuous": lambda runner: runner.check_all(vacuous.CHECKS),
    "idle": lambda runner: runner.check_all(vacuous.THOROUGH),
    "gates": lambda runner: runner.check_all(gates.CHECKS),
    "baselines": lambda runner: runner.check_all(baselines.CHECKS),
    "named": lambda runner: runner.check_all(named.CHECKS),
    "sides": lambda runner: runner.check_all(named.SIDES),
    "reports": lambda runner: runner.check_all(reports.CHECKS),
    "ci": lambda runner: runner.check_all(ci.CHECKS),
    "bisects": lambda runner: runner.check_all(bisecting.CHECKS),
    "acts": lambda runner: runner.check_all(acts.CHECKS),
    "shrinking": lambda runner: runner.check_all(shrinking.CHECKS),
    "compiling": lambda runner: runner.check_all(compiling.CHECKS),
    "wrong": lambda runner: runner.check_all(wrong.CHECKS),
    "doctor": lambda runner: runner.check_all(doctor.CHECKS + traces.CHECKS),
    "fixed": lambda runner: runner.check_all(fixed.CHECKS + planted.CHECKS),
    "native": lambda runner: runner.check_all(native.CHECKS),
    "same": lambda runner: runner.check_all(same.THOROUGH),
    "pages": lambda runner: runner.check_all(pages.CHECKS),
    "kept": lambda runner: runner.check_all(kept.CHECKS),
    "install": lambda runner: runner.check_all(installed.CHECKS),
}


def main():
    # A background command of a shell ignores SIGINT, and one of nohup SIGHUP; the commands that tests interrupt would
    # inherit this.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    runner = Runner(*sys.argv[2:8])
    SUITES[sys.argv[1]](runner)
    return runner.finish()


if __name__ == "__main__":
    sys.exit(main())
