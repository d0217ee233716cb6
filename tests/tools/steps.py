#!/usr/bin/env python3
"""Runs a build in few lines: steps.py LOG COMMAND... keeps what the command prints in LOG.

It prints how far the command's own steps are, as ninja counts them ("[12/345] ..."): on a terminal in one line that changes, with the time
left, else a line for each quarter. If the command fails, what it said of that follows, and its status is returned.
"""
import os
import re
import subprocess
import sys
import time

MOST_LINES = 60


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.1f} min"


class Progress:
    """How far a command is. Before a tenth of the steps, the time left is not known well enough."""

    def __init__(self):
        self.begin, self.quarter, self.on_terminal = time.monotonic(), 0, sys.stdout.isatty()

    def show(self, done, total):
        passed = time.monotonic() - self.begin
        left = f", about {duration(passed * (total - done) / done)} left" if 10 * done > total and done < total else ""
        line = f"   {done} of {total} steps{left}"
        if self.on_terminal:
            print(f"\r{line}\033[K", end="", flush=True)
        elif 4 * done // total > self.quarter:
            self.quarter = 4 * done // total
            print(line, flush=True)

    def end(self):
        if self.on_terminal:
            print("\r\033[K", end="")
        print(f"   {duration(time.monotonic() - self.begin)}", flush=True)


def run(path, command):
    progress = Progress()
    with open(path, "w", encoding="utf-8") as log:
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                              env=dict(os.environ, NINJA_STATUS="[%f/%t] ")) as child:
            for line in child.stdout:
                log.write(line)
                step = re.match(r"\[(\d+)/(\d+)\] ", line)
                if step and int(step[2]):
                    progress.show(int(step[1]), int(step[2]))
    progress.end()
    if child.returncode:
        with open(path, encoding="utf-8", errors="replace") as log:
            lines = log.readlines()
        first = next((i for i, line in enumerate(lines) if line.startswith("FAILED: ")), len(lines) - MOST_LINES)
        sys.stdout.writelines(lines[max(first, 0):][:MOST_LINES])
        print(f"{command[0]} ended with {child.returncode}; {path} has all that it said")
    return child.returncode


if __name__ == "__main__":
    try:
        sys.exit(run(sys.argv[1], sys.argv[2:]))
    except KeyboardInterrupt:
        sys.exit(130)
