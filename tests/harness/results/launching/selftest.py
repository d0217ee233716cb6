#!/usr/bin/env python3
"""Tests claims' verdicts with real processes: the number of panes gives each cell's truth. Another process keeps one core busy.

    selftest.py BUILD [--device D] [--repeats N] [--idle]

Cells draw panes over the whole picture (BUILD/tests/harness/results/launching/launching), with one thread, so that a busy core
leaves them another. N (60) courses each: equal cells, which must be alike within 10 %; cells 5, 10 and 30 % apart, of which the
first must not be the slower; and six cells, each 5 % slower than the one before. Prints each verdict. The exit status is 1 if
more than one verdict of 100 is false, or if fewer than 95 % of those 10 and 30 % apart, or fewer than 90 % of equal ones, are
decided.
"""
import argparse
import collections
import subprocess
import sys

BUSY = "import os\nwhose = os.getppid()\nwhile os.getppid() == whose: pass"
PANES = 400
# Name, the claim with its cells' panes, the false verdict, the least share of decided courses.
KINDS = [("equal", ["alike", "1.1", PANES, PANES], "not reproduced", 0.9),
         ("5 % apart", ["ratio", "1", PANES, PANES * 1.05], "not reproduced", 0),
         ("10 % apart", ["ratio", "1", PANES, PANES * 1.1], "not reproduced", 0.95),
         ("30 % apart", ["ratio", "1", PANES, PANES * 1.3], "not reproduced", 0.95),
         ("a trend", ["falls"] + [PANES * 1.05 ** i for i in range(6)], "not reproduced", 0)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--device", default="cpu@OMP_NUM_THREADS=1")
    parser.add_argument("--repeats", type=int, default=60)
    parser.add_argument("--idle", action="store_true")
    asked = parser.parse_args()
    busy = None if asked.idle else subprocess.Popen([sys.executable, "-c", BUSY])
    wrong, all_verdicts, failed = 0, 0, False
    try:
        for name, words, false, least in KINDS:
            words = [word if isinstance(word, str) else str(round(word)) for word in words]
            told = collections.Counter()
            for _ in range(asked.repeats):
                done = subprocess.run([asked.build + "/tests/harness/results/launching/launching", asked.device] + words,
                                      stdout=subprocess.PIPE, encoding="utf-8", check=True)
                print("%s: %s" % (name, done.stdout.strip()), flush=True)
                told[done.stdout.split(",")[0]] += 1
            wrong += told[false]
            all_verdicts += asked.repeats
            decided = (told["reproduced"] + told["not reproduced"]) / asked.repeats
            failed = failed or decided < least
            print("%s: %s" % (name, dict(told)), flush=True)
    finally:
        if busy:
            busy.kill()
    print("%d of %d are false" % (wrong, all_verdicts))
    return failed or wrong > all_verdicts / 100


if __name__ == "__main__":
    sys.exit(main())
