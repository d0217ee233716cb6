#!/usr/bin/env python3
"""Builds and tests raingauge on other Debians, with gcc and clang: distributions.py [DEBIAN[/COMPILER]...], as root, with network.

For each Debian mmdebstrap makes a system of packages.txt in a temporary folder (--in FOLDER: there, and it stays). In it this
tree's commit is built, the unit suite run, all software devices verified, and their digests compared with results/baseline.json.
Prints a line for each step that fails and a table at the end. Exits 1 if bookworm or trixie fails; others are only told.
It takes hours, and fetches 800 MB for a Debian.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from system import System, Way, lacks

ROOT = pathlib.Path(__file__).resolve().parents[3]
DEBIANS = ("bookworm", "trixie", "forky")
COMPILERS = {"gcc": ("gcc", "g++"), "clang": ("clang", "clang++")}
BINDING = ("bookworm", "trixie")
EXTRA = ["clang", "libomp-dev", "locales"]  # libomp: OpenMP of clang
DEVICES = "cpu:reference,cpu,gl,vulkan,opencl"
# Digests of fixed functions are those of one driver's version; pictures are all drivers'.
SKIPS, SKIPPED = ".git/skips.txt", "^fixed/\n"


def packages():
    """Those that a build, its unit tests and the drivers need; what is optional, or of one test, is left out."""
    lines = (ROOT / "packages.txt").read_text().splitlines()
    return [line for line in lines if line and not line.startswith("#") and " " not in line] + EXTRA


def steps(program, build, jobs):
    """Name and command of each, in the order in which they are run."""
    return [
        ("program", ["ninja", "-j", jobs, "-C", build, "program"]),
        ("baseline", [program, "gate", "--baseline", "results/baseline.json", "--device", "cpu,gl,vulkan", "--pictures", "--skips", SKIPS]),
        ("verify", [program, "verify", "--quick", "--device", DEVICES, "--require", DEVICES]),
        ("build", ["ninja", "-j", jobs, "-k", "0", "-C", build]),
        ("unit", ["meson", "test", "-C", build, "--no-rebuild", "--suite", "unit", "--num-processes", jobs, "--print-errorlogs"]),
    ]


class Distribution(System):
    """One Debian with a compiler, and the sources in it."""

    def __init__(self, debian, folder, options):
        super().__init__(debian, folder)
        self.options = options

    def prepare(self):
        if (self.root / "usr/bin/ninja").exists():
            return True
        self.say("fetching packages")
        return self.make(self.name, packages(), "--dpkgopt=path-include=/usr/share/doc/libcgal-dev/*",
                         *("--aptopt=" + option for option in self.options.apt), mirror=self.options.mirror)

    def bring_sources(self):
        """The tree's commit: what is not committed is left out. Builds that are there go on."""
        to = self.root / "raingauge"
        if not to.exists():
            subprocess.run(["git", "clone", "--quiet", "--no-hardlinks", str(ROOT), str(to)], check=True)
        subprocess.run(["git", "-C", str(to), "fetch", "--quiet", str(ROOT), "HEAD"], check=True)
        subprocess.run(["git", "-C", str(to), "reset", "--quiet", "--hard", "FETCH_HEAD"], check=True)
        (to / SKIPS).write_text(SKIPPED)

    def try_compiler(self, compiler):
        """The name of the first step that failed; None if all passed."""
        build = "build-" + compiler
        cc, cxx = COMPILERS[compiler]
        way = Way("/raingauge", {"CC": cc, "CXX": cxx})
        program = build + "/harness/raingauge"
        setup = ("setup", ["meson", "setup", build, "-Dlevels=" + self.options.levels])
        for name, command in [setup] + steps(program, build, str(self.options.jobs)):
            self.say(f"{compiler}, {name}")
            if not self.within(command, way):
                self.say(f"{compiler}, {name} FAILS; {self.log} has what it said")
                return name
        return None


def try_debian(debian, compilers, folder, options):
    """By compiler: the step that failed, or None."""
    system = Distribution(debian, folder, options)
    if not system.prepare():
        system.say(f"no system; {system.log} says why")
        return {compiler: "packages" for compiler in compilers}
    system.bring_sources()
    return {compiler: system.try_compiler(compiler) for compiler in compilers}


def chosen(names):
    """Compilers by Debian."""
    wanted = {}
    for name in names or DEBIANS:
        debian, _, compiler = name.partition("/")
        if debian not in DEBIANS or compiler not in ("", *COMPILERS):
            sys.exit(f"distributions.py: {name}: choose {', '.join(DEBIANS)}, or one of them with /gcc or /clang")
        wanted.setdefault(debian, []).extend([compiler] if compiler else COMPILERS)
    return wanted


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", nargs="*", metavar="DEBIAN[/COMPILER]")
    parser.add_argument("--in", dest="folder", metavar="FOLDER", help="keeps systems and logs there, and uses those that are there")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at once; all cores without it")
    parser.add_argument("--levels", default="v2,v3,v4", help="of x86-64, as meson's option")
    parser.add_argument("--mirror", default="http://deb.debian.org/debian", help="%(default)s")
    parser.add_argument("--apt", action="append", default=[], metavar="OPTION", help="for apt, as 'Acquire::Check-Valid-Until \"false\"'")
    options = parser.parse_args()
    wanted = chosen(options.what)
    if lacks():
        sys.exit("distributions.py: " + lacks())
    folder = pathlib.Path(options.folder or tempfile.mkdtemp(prefix="distributions-"))
    folder.mkdir(exist_ok=True)
    found = {}
    try:
        for debian, compilers in wanted.items():
            found[debian] = try_debian(debian, compilers, folder, options)
    finally:
        if not options.folder:  # the logs stay where something failed
            for debian in wanted:
                shutil.rmtree(folder / debian, ignore_errors=True)
            if not any(step for row in found.values() for step in row.values()):
                shutil.rmtree(folder)
    for debian, compilers in found.items():
        for compiler, step in compilers.items():
            print(f"{debian:10} {compiler:6} {'pass' if not step else step + ' fails'}{'' if debian in BINDING else ', told alone'}")
    return any(step for debian in BINDING for step in found.get(debian, {}).values())


if __name__ == "__main__":
    sys.exit(main())
