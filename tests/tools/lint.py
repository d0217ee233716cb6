#!/usr/bin/env python3
"""Faults in the sources of core, harness and backends that tools find by reading: lint.py BUILD TOOL...

TOOL: cppcheck (12 s of CPU time; cppcheck.txt lists its false warnings), gcc (its analyzer; 65 s) or clang-tidy (.clang-tidy
lists its checks; 5 min). Other versions warn differently: if a tool is missing or not Debian 12's, nothing is checked, and the
exit status is 77.
"""
import concurrent.futures
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS, SKIP = ("backends", "core", "harness"), 77
VERSIONS = {"cppcheck": "Cppcheck 2.10", "gcc": " 12.", "clang-tidy": "version 14."}
# EACH_SLOT: files of cases' programs (harness/compare/shrink/alone) are read one by one, and one of them defines it.
# gcc 12 gives only false warnings about memory reached through its first member (devices, images), arrays filled in a
# loop, and conditions in another file's functions. clang-tidy looks for the same errors.
ANALYZER = ["-O1", "-fanalyzer", "-Wno-maybe-uninitialized", "-Wno-analyzer-malloc-leak", "-Wno-analyzer-null-argument", "-Wno-analyzer-null-dereference",
            "-Wno-analyzer-use-of-uninitialized-value", "-c", "-o", os.devnull]
CPPCHECK = ["--enable=warning,performance,portability", "--inline-suppr", "--std=c11", "--library=posix", "-I.", "-D__GNUC__", "-DEACH_SLOT=while(0)", "--quiet", "--suppressions-list=tests/tools/cppcheck.txt",
            "--template={file}:{line}: {id}: {message}", "--error-exitcode=1", f"-j{os.cpu_count()}"]


def sources(build):
    """The compile command of each C source of the rooms, without outputs and levels of optimisation."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    commands = {}
    for entry in entries:
        path = os.path.relpath(os.path.join(entry["directory"], entry["file"]), ROOT)
        if path.split(os.sep)[0] in ROOMS and path.endswith(".c"):
            words = re.sub(r" -(?:o|MQ|MF) \S+| -(?:MD|c|Werror|O\d)(?= )", "", entry["command"])
            commands[path] = (shlex.split(words), entry["directory"])
    return commands


def run(command, folder=ROOT):
    return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def found_by_cppcheck(_, __):
    done = run(["cppcheck", *CPPCHECK, *ROOMS])
    return [done.stdout] if done.returncode else []


def analyzed(command):
    words, folder = command
    done = run(words + ANALYZER, folder)
    return done.stdout if done.stdout or done.returncode else None


def found_by_gcc(_, commands):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(filter(None, pool.map(analyzed, commands.values())))


def found_by_tidy(build, commands):
    paths = sorted(commands)
    parts = [["clang-tidy", "-p", build, "--quiet", *paths[at:at + 10]] for at in range(0, len(paths), 10)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return [done.stdout for done in pool.map(run, parts) if done.returncode]


TOOLS = {"cppcheck": found_by_cppcheck, "gcc": found_by_gcc, "clang-tidy": found_by_tidy}


def main():
    build, *tools = sys.argv[1:]
    missing = [tool for tool in tools if not shutil.which(tool) or VERSIONS[tool] not in run([tool, "--version"]).stdout]
    if missing:
        print(f"wanted: {', '.join(f'{tool} of {VERSIONS[tool]}' for tool in missing)}")
        return SKIP
    commands = sources(build)
    found = [text for tool in tools for text in TOOLS[tool](os.path.abspath(build), commands)]
    print("".join(found), end="")
    print(f"{len(commands)} sources looked at by {', '.join(tools)}")
    return bool(found or not commands or not tools)


sys.exit(main())
