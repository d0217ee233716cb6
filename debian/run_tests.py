#!/usr/bin/python3
"""Runs raingauge's own tests as installed: raingauge-tests [--list] [--jobs N] [WORD]...

Runs the tests whose names have all words; without words every test. Prints a line for each, what a failed one said, and how many passed.
Exits 1 if one fails, 2 if no name has the words. What tests write goes into a temporary folder.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(os.environ.get("RG_TESTS") or "@tests@")
SKIPPED, LIMIT_S = 77, 1200
# As `make test` sets them: tests run side by side, on machines of any speed.
VARIABLES = {"GOMP_SPINCOUNT": "0", "RG_LONG_S": "1e9", "RG_PROBE_S": "0"}


def run(test, temporary):
    """Exit status and output."""
    command = [word.replace("{tests}", str(TESTS)).replace("{temporary}", temporary) for word in test["command"]]
    variables = {**os.environ, **VARIABLES, "XDG_CACHE_HOME": temporary + "/cache", **test["environment"]}
    try:
        done = subprocess.run(command, cwd=temporary, env=variables, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              encoding="utf-8", errors="replace", timeout=LIMIT_S, check=False)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired as end:
        return None, (end.stdout or b"").decode(errors="replace") + f"\nit did not end within {LIMIT_S} s"
    except OSError as error:
        return None, str(error)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("words", nargs="*", metavar="WORD", help="runs the tests whose names have all words")
    parser.add_argument("--list", action="store_true", help="only prints their names")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="tests at once (default: one a processor)")
    options = parser.parse_args()
    chosen = [test for test in json.loads((TESTS / "tests.json").read_text()) if all(word in test["name"] for word in options.words)]
    if not chosen:
        print(f"raingauge-tests: no test's name has '{' '.join(options.words)}'; --list prints the names", file=sys.stderr)
        return 2
    if options.list:
        print("\n".join(test["name"] for test in chosen))
        return 0
    counts = {"ok": 0, "skipped": 0, "FAILED": 0}
    with tempfile.TemporaryDirectory(prefix="raingauge-tests-") as temporary, concurrent.futures.ThreadPoolExecutor(max(options.jobs, 1)) as pool:
        ends = {pool.submit(run, test, temporary): test["name"] for test in chosen}
        for end in concurrent.futures.as_completed(ends):
            status, output = end.result()
            word = {0: "ok", SKIPPED: "skipped"}.get(status, "FAILED")
            counts[word] += 1
            print(f"{word:7} {ends[end]}", flush=True)
            if word == "FAILED":
                print("\n".join("  | " + line for line in output.splitlines()[-40:]), flush=True)
    print(f"{counts['ok']} passed, {counts['FAILED']} failed, {counts['skipped']} skipped")
    return 1 if counts["FAILED"] else 0


if __name__ == "__main__":
    sys.exit(main())
