#!/usr/bin/env python3
"""Runs `watched` under ThreadSanitizer, which it was built with, or under valgrind: watch.py races|values PROGRAM ARGUMENT...

`planted` as the only argument runs what is wrong on purpose, and the same done right: each of the former must be found, and
none of the latter. Else PROGRAM gets the arguments, and what it ends with is the exit status.
"""
import ctypes
import os
import re
import subprocess
import sys

FOUND = 66
TOOLS = {
    # libgomp's own accesses are ignored; annotate.c tells the tool about its synchronization.
    "races": ([], {"OMP_NUM_THREADS": "4", "OMP_DYNAMIC": "false",
                   "TSAN_OPTIONS": f"exitcode={FOUND}:ignore_noninstrumented_modules=1:atexit_sleep_ms=0"},
              "WARNING: ThreadSanitizer: data race"),
    "values": (["valgrind", "-q", f"--error-exitcode={FOUND}", "--num-callers=20",
                # With the default of 60 guest instructions valgrind runs out of space for the kernels' loops.
                "--vex-guest-max-insns=20"],
               # Only branches reveal uninitialised values, and code without vectors has more branches.
               {"OMP_NUM_THREADS": "1", "RG_CPU_LEVEL": "plain"}, "uninitialised value"),
}
# Entry points of libgomp that do not synchronize: they hand out pieces of a loop, or choose one thread.
ORDERLESS = {"GOMP_loop_nonmonotonic_dynamic_start", "GOMP_loop_nonmonotonic_dynamic_next", "GOMP_loop_end_nowait",
             "GOMP_single_start"}
NO_RANDOM_ADDRESSES = 0x0040000


def with_fixed_addresses():
    """gcc 12's ThreadSanitizer ends where the kernel spreads addresses wider than it knows. Where that may not be asked for, it is
    tried as it is."""
    ctypes.CDLL(None).personality(NO_RANDOM_ADDRESSES)


def run(tool, program, arguments, **options):
    before, variables, _ = TOOLS[tool]
    return subprocess.run(before + [program] + arguments, env={**os.environ, **variables}, check=False,
                          preexec_fn=with_fixed_addresses if tool == "races" else None, **options)


def check_planted(tool, program, name):
    """What is wrong with how a planted piece of work was taken: nothing, it is hoped."""
    wrong = []
    for kind, status in ("right", 0), ("wrong", FOUND):
        done = run(tool, program, ["planted", name, kind], capture_output=True, text=True)
        found = TOOLS[tool][2] in done.stderr
        if done.returncode != status or found != (kind == "wrong"):
            wrong.append(f"{name}, {kind}: status {done.returncode}, {'found' if found else 'not found'}\n{done.stderr}")
    return wrong


def check_entries(program):
    """Entries of libgomp that nobody annotates."""
    symbols = subprocess.run(["nm", "-D", "--undefined-only", program], capture_output=True, text=True, check=True).stdout
    return [f"annotate.c has no {name}" for name in sorted(set(re.findall(r"\bU (GOMP_[a-z]\w+)", symbols)) - ORDERLESS)]


def main():
    tool, program, *arguments = sys.argv[1:]
    if arguments != ["planted"]:
        if tool == "values":  # things that are made once and kept are made without valgrind first
            subprocess.run([program] + arguments, check=True)
        sys.exit(run(tool, program, arguments).returncode)
    if tool == "values":
        wrong = check_planted(tool, program, "a value")
    else:
        names = run(tool, program, arguments, capture_output=True, text=True).stdout.splitlines()
        wrong = check_entries(program) + ([] if names else ["nothing is planted"])
        wrong += [fault for name in names for fault in check_planted(tool, program, name)]
    sys.exit("\n".join(wrong) or 0)


main()
