#!/usr/bin/env python3
"""Compares debian/control with packages.txt: a package is built with what every build needs."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILDING = ("build", "libraries", "D3, which `raingauge report` embeds in its page")
# What every Debian that builds packages has; and what a package alone needs: git tells the commit.
ALWAYS, PACKAGING = {"gcc", "g++"}, {"debhelper-compat", "git"}


def needed():
    """The packages below the headings of BUILDING."""
    found, heading = set(), ""
    for line in (ROOT / "packages.txt").read_text().splitlines():
        if line.startswith("#"):
            heading = line[2:]
        elif heading in BUILDING:
            found.add(line)
    return found


def main():
    control = (ROOT / "debian" / "control").read_text()
    told = set(re.findall(r"^ ([a-z0-9.+-]+)", control.split("Build-Depends:")[1].split("\nStandards-Version")[0], re.M))
    wanted = (needed() - ALWAYS) | PACKAGING
    for name in sorted(wanted ^ told):
        print("debian/control: %s is %s" % (name, "needed (packages.txt), and not among Build-Depends" if name in wanted else "not in packages.txt"))
    return 1 if wanted != told or len(told) < 20 else 0


sys.exit(main())
