#!/usr/bin/env python3
"""Sums up meson's test logs: summary.py LOG... prints the slowest tests, the failed ones with their messages, and one line of sums.

A skipped test counts as not passed: set-up installs every driver, so nothing may be missing. Exits
1 if anything failed or nothing ran.
"""
import json
import os
import re
import sys

SLOWEST, SAID_LINES, SAID_COLUMNS = 10, 20, 1000


def read(path):
    """The results of a log, each with its build, because tests under sanitizers have the same names."""
    try:
        with open(path, encoding="utf-8") as log:
            tests = [json.loads(line) for line in log]
    except OSError as error:
        return [(0, path, f"missing: {error.strerror}", "")]
    build = os.path.dirname(os.path.dirname(path))
    return [(test["duration"], f"{build}: {test['name']}", test["result"], said(test)) for test in tests]


def said(test):
    """A test's messages about failures, in the format of TAP or cmocka, or else its last lines. The end of a log shows no more of
    it."""
    output = test.get("stdout", "") + test.get("stderr", "")
    failures = re.findall(r"^(?:not ok.*\n(?:#.*\n)*|\[ +(?:ERROR|LINE|FAILED) +\].*\n)", output, re.M)
    lines = ("".join(failures) or output).splitlines()
    return "".join(f"    {line[:SAID_COLUMNS]}\n" for line in (lines[:SAID_LINES] if failures else lines[-SAID_LINES:]))


def main():
    results = [result for path in sys.argv[1:] for result in read(path)]
    print(f"slowest of {sum(seconds for seconds, *_ in results):.0f} s, others at their side:")
    for seconds, name, *_ in sorted(results, reverse=True)[:SLOWEST]:
        print(f"{seconds:8.1f} s  {name}")
    failed = [(name, result, words) for _, name, result, words in results if result not in ("OK", "EXPECTEDFAIL")]
    for name, result, words in failed:
        print(f"{result}: {name}\n{words}", end="")
    print(f"{len(results) - len(failed)} passed, {len(failed)} failed")
    sys.exit(1 if failed or not results else 0)


main()
