#!/usr/bin/env python3
"""Adds up meson's test logs into one line: summary.py LOG...

A test that was skipped has not passed: set-up installs every driver, so nothing may be missing. Exits
1 if anything failed or nothing ran.
"""
import json
import sys


def main():
    results = []
    for path in sys.argv[1:]:
        try:
            with open(path, encoding="utf-8") as log:
                results += [(json.loads(line)["name"], json.loads(line)["result"]) for line in log]
        except OSError as error:
            results.append((path, f"missing: {error.strerror}"))
    failed = [(name, result) for name, result in results if result not in ("OK", "EXPECTEDFAIL")]
    for name, result in failed:
        print(f"{result}: {name}")
    print(f"{len(results) - len(failed)} passed, {len(failed)} failed")
    sys.exit(1 if failed or not results else 0)


main()
