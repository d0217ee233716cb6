#!/usr/bin/env python3
"""Changes one place of the text of cartoon's scene at a time, and runs the tests that ought to notice.

mutants.py SOURCE BUILD COMPILER... -- [NAME HEADER SHELL]...

The tool is that of drops; the rows are in mutant_rows.py beside this, which is found before those of drops.
"""
import importlib.util
import pathlib

DROPS = pathlib.Path(__file__).resolve().parents[2] / "drops" / "mutants.py"


def main():
    spec = importlib.util.spec_from_file_location("drops_mutants", DROPS)
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    tool.TESTS = "tests/core/techniques/cartoon/scene"
    tool.KERNELS = "kernels/cartoon/scene"
    tool.main()


if __name__ == "__main__":
    main()
