#!/usr/bin/env python3
"""Whether the times left that real commands tell are right: real.py BUILD [REPEATS] runs commands of many kinds, half of them while another
process keeps a core busy, and holds each line against the end of its run.

A run is right if each of its lines is right within three times. Exits with 1 if fewer than 95 % of the runs that told a time are. It is
about the clock, takes long, and is no part of `make test`.
"""
import os
import re
import subprocess
import sys
import tempfile
import threading
import time

TIMES, SHARE, LONG_S = 3, 0.95, 5
COMMANDS = (
    "table chin-timing --device cpu", "table stuppacher-2 --device cpu,gl --rows 1-2", "table creus-5.3 --device cpu --rows 1-3",
    "table creus-5.4 --device cpu --rows 2-3 --variant no_geometry", "table creus-5.5 --device cpu --rows 1-2 --work paper",
    "table feng-1 --device cpu,gl --rows 1-2", "table ye-1 --device cpu --rows 1-2", "table raster-1 --device cpu,opencl --rows 1-2",
    "sweep streaks --axis culling_radius_m=5,10,20 --device cpu", "figures creus-4.1 --device cpu -o {}", "atlas --quick -o {}/atlas",
    "verify flow --quick --device cpu", "verify drops --quick --device cpu", "verify cartoon --quick --device cpu,gl",
    "baseline --device cpu -o {}/baseline.json", "render drops --frame 900 -o {}/drops.png", "render streaks --frame 120 -o {}/rain.png",
    "render flow --frames 0-89 -o {}/flow.webm", "diff streaks --frame 60 --device cpu,cpu:reference", "diff shower --frame 60 --device cpu,gl",
)
UNITS = {"s": 1, "min": 60, "h": 3600}


def listen(process, lines):
    """Each line of stderr with the time of its arrival."""
    for line in process.stderr:
        lines.append((time.monotonic(), line))


def run(raingauge, command, folder):
    """When each time was told, how long the rest was to take, and how long it took."""
    lines, begin = [], time.monotonic()
    environment = dict(os.environ, RG_LONG_S=str(LONG_S), RG_PROBE_S="0")
    with subprocess.Popen([raingauge, *command.format(folder).split()], env=environment, text=True, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, cwd=folder) as process:
        thread = threading.Thread(target=listen, args=(process, lines))
        thread.start()
        status = process.wait()
        end = time.monotonic()
        thread.join()
    if status:
        print(f"  status {status}: {''.join(line for _, line in lines)[-300:]}")
    told = []
    for at, line in lines:
        word = re.match(r"raingauge: about ([\d.]+) (s|min|h) (in all|left)", line)
        if word:
            seconds = float(word[1]) * UNITS[word[2]]
            told.append((at - begin, seconds - (at - begin if word[3] == "in all" else 0), end - at))
    return told, end - begin


def main():
    raingauge, repeats = os.path.join(os.path.abspath(sys.argv[1]), "harness", "raingauge"), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    runs = spoke = right = lines = right_lines = 0
    for number in range(2 * repeats):
        busy = subprocess.Popen([sys.executable, "-c", "while True: pass"]) if number % 2 else None
        try:
            for command in COMMANDS:
                with tempfile.TemporaryDirectory() as folder:
                    told, seconds = run(raingauge, command, folder)
                good = [said <= TIMES * left and left <= TIMES * said for _, said, left in told]
                runs, spoke, right = runs + 1, spoke + bool(told), right + (bool(told) and all(good))
                lines, right_lines = lines + len(told), right_lines + sum(good)
                wrong = "; ".join(f"at {at:.1f} s {said:.1f} s were told, {left:.1f} s it was"
                                  for (at, said, left), is_good in zip(told, good) if not is_good)
                print(f"{'busy ' if busy else ''}{command}: {seconds:.1f} s, {len(told)} lines{', wrong: ' + wrong if wrong else ''}", flush=True)
        finally:
            if busy:
                busy.kill()
                busy.wait()
    print(f"{runs} runs, {spoke} told a time, in {right} of these each line was right within {TIMES} times; of {lines} lines {right_lines} were")
    return spoke == 0 or right < SHARE * spoke


if __name__ == "__main__":
    sys.exit(main())
