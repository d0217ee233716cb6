#!/usr/bin/env python3
"""A table of faults: each function of a driver that a command reaches fails in each way, and no command may end with success.

    faults.py RAINGAUGE FAULTS_LIBRARY FUNCTIONS [--sample N] [--seed N] [--api A] [--command C] [--how H] [--function PATTERN] [--at-once N]

A fault is a function, a way (faults.c) and a command that asks for one device. A run without a fault shows which functions a
command reaches, so that no other function is counted. Meaningless pairs are left out: the error of a Vulkan function that returns
nothing, and in `list`, which opens no device, its loss; and an error or a loss in functions that only release something
(vkDestroy..., vkFree..., glDelete..., clRelease..., eglDestroyContext, eglTerminate), after which a command asks nothing more of
the device. Prints the commands that ended with 0, in another way than with status 1, or with more than a few lines; the faults
that another command finds and doctor does not; and the counts.
"""
import argparse
import concurrent.futures
import collections
import os
import random
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from runner import CHANGES

CELL = "raster/torus raster 64x48 2 scene=mesh model=torus faces=300\n"
SMALL = "--size 32x32"
COMMANDS = {
    "doctor": "doctor --device {api}",
    "fixed": "doctor --fixed-function --device {api}",
    "list": "list devices",
    "render": "render flow --frame 2 --set environment_px=64 --set resolution_px=32 %s --device {api} -o {tmp}/a.png" % SMALL,
    "diff": "diff raster --frame 1 %s --device cpu,{api}" % SMALL,
    "verify": "verify raster --stages --frame 1 %s --device {api}" % SMALL,
    "gate": "gate cpu {api} --pictures --cells {tmp}/cells.txt",
    "table": "table stuppacher-2 --work paper --rows 1-1 --quick --device {api}",
    "sweep": "sweep raster --axis billboards=20000 --quick %s --device {api}" % SMALL,
    "baseline": "baseline --pictures --cells {tmp}/cells.txt --device {api} -o {tmp}/baseline.json",
}
DOCTORS = ("doctor", "fixed")
WAYS = ("error", "abort", "exit", "hang", "lost", "swell")
PREFIX = {"vulkan": "vk", "gl": ("gl", "egl"), "opencl": "cl"}
GIVES_BACK = re.compile("vkDestroy|vkFree|glDelete|clRelease|eglDestroyContext|eglTerminate")
MOST_LINES = {"verify": 5}  # else 4; it draws five scenes, each of which may fail with a kernel of its own
HANG_S = 3  # time after which a hanging driver is given up
PAIRS_OF_A_SAMPLE = 6  # pairs of an API and a command; each first runs once without a fault

Fault = collections.namedtuple("Fault", "api function how command")


class Faults:
    def __init__(self, raingauge, library, functions):
        self.raingauge, self.library = map(os.path.abspath, (raingauge, library))
        with open(functions) as file:
            rows = re.findall(r"FUNCTION\(\d+, (\w+), (\w+), \d+\)", file.read())
        self.kinds = dict(rows)

    def run(self, command, api, **more):
        """Runs a command on a device under the library; its status and its messages."""
        env = {name: value for name, value in os.environ.items() if not CHANGES.match(name)}
        # A process that was given up may write on while its folder goes.
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            with open(os.path.join(folder, "cells.txt"), "w") as file:
                file.write(CELL)
            env.update(GOMP_SPINCOUNT="0", RG_LONG_S="1e9", RG_PROBE_S="0", XDG_STATE_HOME=folder, LD_PRELOAD=self.library, **more)
            hangs = ":hang:" in env.get("RG_FAULT", "")
            args = COMMANDS[command].format(api=api, tmp=folder).split() + ["--timeout", str(HANG_S) if hangs else "100", "--memory", "1GiB"]
            result = subprocess.run([self.raingauge] + args, env=env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                    encoding="utf-8", errors="replace", timeout=600)
        return result.returncode, result.stderr.splitlines()

    def reached(self, command, api):
        """The functions of an API that a command calls without a fault."""
        with tempfile.NamedTemporaryFile("r") as file:
            status, lines = self.run(command, api, RG_REACHED=file.name)
            if status:
                raise SystemExit("%s of %s fails by itself, with status %d: %s" % (command, api, status, lines))
            return sorted({name for name in file.read().split() if name.startswith(PREFIX[api])})

    def means_something(self, function, how, command):
        silent = {"error", "lost"} if command == "list" else {"error"}  # list holds no device that could be lost
        return not (how in ("error", "lost") and GIVES_BACK.match(function)) and not (how in silent and self.kinds[function] == "VK_NOTHING")

    def all(self, pairs, at_once):
        """Every meaningful fault of pairs of an API and a command."""
        with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
            reached = list(pool.map(lambda pair: self.reached(pair[1], pair[0]), pairs))
        return [Fault(api, function, how, command) for (api, command), functions in zip(pairs, reached)
                for function in functions for how in WAYS if self.means_something(function, how, command)]

    def end(self, fault):
        try:
            return self.run(fault.command, fault.api, RG_FAULT="%s:%s:0" % (fault.function, fault.how))
        except (OSError, subprocess.TimeoutExpired) as error:
            return None, [str(error)]


def try_all(faults, asked, at_once):
    """The end of each fault. Hanging ones wait, so that more of them run at once."""
    ends, problems = {}, []
    with concurrent.futures.ThreadPoolExecutor(at_once) as pool, concurrent.futures.ThreadPoolExecutor(3 * at_once) as waiting:
        started = {(waiting if fault.how == "hang" else pool).submit(faults.end, fault): fault for fault in asked}
        for done in concurrent.futures.as_completed(started):
            fault, (status, lines) = started[done], done.result()
            ends[fault] = status
            if status != 1 or not lines or len(lines) > MOST_LINES.get(fault.command, 4):
                problems.append("%s %s in %s: status %s, %d lines: %s" % (fault.function, fault.how, fault.command, status, len(lines), lines[:2]))
                print(problems[-1], flush=True)
            if len(ends) % 100 == 0:
                print("%d of %d tried, %d amiss" % (len(ends), len(asked), len(problems)), flush=True)
    return ends, problems


def missed_by_doctor(ends):
    """Faults (a function and a way) that another command finds and doctor does not, with --fixed-function or without, and the number that
    doctor was asked about."""
    found = {(fault.function, fault.how) for fault, status in ends.items() if status and fault.command not in DOCTORS}
    found_there = {(fault.function, fault.how) for fault, status in ends.items() if status and fault.command in DOCTORS}
    return sorted(found - found_there), len(found)


def print_counts(ends):
    for title, key in (("API", "api"), ("way", "how"), ("command", "command")):
        counts = collections.Counter((getattr(fault, key), status) for fault, status in ends.items())
        print("%s: %s" % (title, ", ".join("%s: %d ended with %d" % (name, count, status) for (name, status), count in sorted(counts.items()))))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("raingauge", "library", "functions"):
        parser.add_argument(name)
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at-once", type=int, default=2)
    parser.add_argument("--api", action="append", choices=PREFIX)
    parser.add_argument("--command", action="append", choices=COMMANDS)
    parser.add_argument("--how", action="append", choices=WAYS)
    parser.add_argument("--function", default="")
    options = parser.parse_args()
    faults = Faults(options.raingauge, options.library, options.functions)
    pairs = [(api, command) for api in options.api or PREFIX for command in options.command or COMMANDS
             if (api, command) != ("opencl", "fixed")]  # it has no fixed functions
    chance = random.Random(options.seed)
    if options.sample:
        pairs = chance.sample(pairs, min(PAIRS_OF_A_SAMPLE, len(pairs)))
    asked = [fault for fault in faults.all(pairs, options.at_once)
             if (not options.how or fault.how in options.how) and re.search(options.function, fault.function)]
    if options.sample:
        asked = chance.sample(asked, min(options.sample, len(asked)))
    print("seed %d, %d faults of %s" % (options.seed, len(asked), ", ".join("%s %s" % pair for pair in pairs)), flush=True)
    ends, problems = try_all(faults, asked, options.at_once)
    print_counts(ends)
    complete = not options.sample and not options.command
    missed, found = missed_by_doctor(ends)
    if complete:
        print("doctor finds %d of %d faults that others find; not %s" % (found - len(missed), found, missed))
        if len(missed) > 0.05 * found:
            problems.append("doctor misses more than 5 %")
    print("%d faults tried, %d ended amiss" % (len(ends), len(problems)))
    return 1 if problems or not ends else 0


if __name__ == "__main__":
    sys.exit(main())
