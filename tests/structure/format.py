#!/usr/bin/env python3
"""Checks that the sources have their own format (.clang-format): names each file that `make format` would change.

Versions of clang-format differ, so only one counts; another, or none, skips the test.
"""
import concurrent.futures
import os
import re
import subprocess
import sys

import tree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
VERSION, SKIP = "14.", 77


def version():
    try:
        told = subprocess.run(["clang-format", "--version"], stdout=subprocess.PIPE, text=True, check=False).stdout
    except OSError:
        return "none"
    return re.search(r"version (\S+)", told).group(1)


def unformatted(paths):
    said = subprocess.run(["clang-format", "--dry-run", *paths], cwd=ROOT, stderr=subprocess.PIPE, text=True, check=True).stderr
    return sorted(set(re.findall(r"^([^:\n]+):\d+:\d+: warning", said, re.M)))


def main():
    if not version().startswith(VERSION):
        print(f"clang-format {VERSION}x is wanted, and here is {version()}")
        return SKIP
    paths = tree.files(ROOT, re.compile(r"\.(c|h|cpp)$"))
    parts = [paths[at:at + 100] for at in range(0, len(paths), 100)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        wrong = [path for part in pool.map(unformatted, parts) for path in part]
    for path in wrong:
        print(f"{path}: not in the format of .clang-format; make format")
    print(f"{len(paths)} files looked at")
    return bool(wrong or not paths)


sys.exit(main())
