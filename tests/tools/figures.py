#!/usr/bin/env python3
"""Tests results/figures.py: the repository's page agrees with its tables, and a known table makes known lines."""
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = "before\n<!-- figures: rain:2 printed -->\nold\n<!-- end of figures -->\nbehind\n"
DUE = """before
<!-- figures: rain:2 printed -->

| table, row | published | cpu | gl |
|---|---:|---:|---:|
| rain, radius_m 20 | 40 | 2.5 | 1235 |
| rain, radius_m 20, no geometry |  | 0.123 | fail |

<!-- end of figures -->
behind
"""
PASSES = """<!-- passes: rain:2,1 -->

| pass | rain, radius_m 10 | rain, radius_m 20 |
|---|---:|---:|
| move | 0.50 | 1.00 |
| draw |  | 2.35 |

<!-- end of figures -->
"""


def cell(row, device, samples, **more):
    measured = {"measured": {"samples_ms": samples, "passes_ms": {"move": row / 2, **({"draw": 2.345} if row == 2 else {})}}} if samples else {"status": "fail"}
    return {"row": {"radius_m": 10 * row}, "row_number": row, "device": device, "variant": "full", "status": "ok",
            "published": {"fps": 25}, **measured, **more}


CELLS = [cell(1, "cpu", [9]), cell(2, "gl", [1234.6]), cell(2, "cpu", [3, 2, 99, 1]),
         cell(2, "cpu", [7], work="ours"), cell(2, "cpu", [0.12345], variant="no_geometry", published={}),
         cell(2, "gl", [], variant="no_geometry", published={})]


def run(*words):
    return subprocess.run([sys.executable, os.path.join(ROOT, "results", "figures.py"), *words], check=False,
                          stderr=subprocess.DEVNULL).returncode


def main():
    assert run("--check") == 0, "docs/performance.md says other figures than results/tables: run results/figures.py"
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "page.md")
        with open(os.path.join(folder, "rain.json"), "w", encoding="utf-8") as file:
            json.dump({"cells": CELLS}, file)
        with open(page, "w", encoding="utf-8") as file:
            file.write(PAGE)
        assert run("--check", folder, page) == 1, "another table is taken for this one"
        with open(page, encoding="utf-8") as file:
            assert file.read() == PAGE, "--check writes"
        assert run(folder, page) == 0
        with open(page, encoding="utf-8") as file:
            text = file.read()
        assert text == DUE, text
        assert run("--check", folder, page) == 0
        with open(page, "w", encoding="utf-8") as file:
            file.write(PAGE.replace("rain:2", "rain:3"))
        assert run(folder, page) != 0, "a row that no table has is passed over"
        with open(page, "w", encoding="utf-8") as file:
            file.write(PASSES.replace("0.50", "0.60"))
        assert run("--check", folder, page) == 1, "other passes are taken for these"
        assert run(folder, page) == 0
        with open(page, encoding="utf-8") as file:
            text = file.read()
        assert text == PASSES, text
        with open(page, "w", encoding="utf-8") as file:
            file.write(PASSES.replace("rain:2,1", "rain:2,3"))
        assert run(folder, page) != 0, "a row that no table has is passed over"
        with open(page, "w", encoding="utf-8") as file:
            file.write("no figures\n")
        assert run("--check", folder, page) == 1, "a page without figures passes"


main()
