#!/usr/bin/env python3
"""Builds raingauge for arm64 on another machine and tests it under qemu: arm64.py [STEP]... [--in FOLDER], with network.

    sysroot   what the build links: Debian's packages for arm64, unpacked, not installed. No other architecture is registered.
    cross     a file for meson, FOLDER/cross.ini, and FOLDER/build
    build     all of it, on the CPU alone (-Ddrivers=false)
    pairs     the gate's cells, here and there: pictures, states and counts are the same to the bit, by NEON and by SVE
    digests   those of results/baseline.json are met
    unit      the unit suite, but what qemu lacks

Without steps all are taken, in this order, in a temporary folder. It needs the packages gcc-aarch64-linux-gnu, g++-aarch64-linux-gnu,
qemu-user-static and mmdebstrap; 77 says which one is missing. FOLDER/raingauge starts the program under qemu, as a worker too
(RG_PROGRAM). For the last two steps programs of arm64 must start each other, by binfmt_misc: a namespace of users has a registry of its own,
so that the machine's stays as it is. For that Linux must be 6.7 or later.
"""
import argparse
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAMS = {"aarch64-linux-gnu-gcc": "gcc-aarch64-linux-gnu", "aarch64-linux-gnu-g++": "g++-aarch64-linux-gnu",
            "qemu-aarch64-static": "qemu-user-static", "mmdebstrap": "mmdebstrap"}
EXTRA = ["libc6-dev", "libstdc++-12-dev", "libgomp1", "opencl-c-headers"]
MISSING = 77
LEVELS = ("plain", "sve")
# Tests that are left out: of what qemu 7.2 lacks.
QEMU_LACKS = {
    "cage": "filters of system calls",
    "mesh files": "limits of memory, in which qemu itself does not fit",
    "program": "posix_spawn's error for a program that is not there",
    "compiling beforehand": "the same",
    "workers that end": "the same, and clocks",
    "output": "posix_spawn's wait until the program runs",
    "numbers of threads": "users other than root, who are not in its namespace",
    "values that are there are found": "valgrind, which is this machine's",
    "room": "time: 9 s of this machine are many minutes",
    "sessions in workers": "the same",
    "files of older formats": "time: an atlas takes longer than a device may be silent",
}
# The first bytes of a program for arm64, and which of their bits count.
MAGIC = r"\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00"
MASK = r"\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff"
REGISTER = ("mount -t binfmt_misc none /proc/sys/fs/binfmt_misc && "
            "printf '%s' ':arm64:M::" + MAGIC + ":" + MASK + ":'\"$0\": >/proc/sys/fs/binfmt_misc/register && exec \"$@\"")
CROSS = """# Made by tests/tools/arm64.py.
[constants]
root = '{root}'
[binaries]
c = 'aarch64-linux-gnu-gcc'
cpp = 'aarch64-linux-gnu-g++'
ar = 'aarch64-linux-gnu-gcc-ar'
strip = 'aarch64-linux-gnu-strip'
pkgconfig = 'pkg-config'
exe_wrapper = ['qemu-aarch64-static', '-L', root]
[built-in options]
c_args = ['--sysroot=' + root]
cpp_args = ['--sysroot=' + root]
c_link_args = ['--sysroot=' + root, '-Wl,--allow-shlib-undefined']
cpp_link_args = ['--sysroot=' + root, '-Wl,--allow-shlib-undefined']
[properties]
sys_root = root
pkg_config_libdir = [root + '/usr/lib/aarch64-linux-gnu/pkgconfig', root + '/usr/share/pkgconfig']
[host_machine]
system = 'linux'
cpu_family = 'aarch64'
cpu = 'aarch64'
endian = 'little'
"""


def libraries():
    """Those of packages.txt, and what a compiler needs beside them."""
    lines = (ROOT / "packages.txt").read_text().splitlines()
    return [line for line in lines if line.startswith("lib") and line.endswith("-dev")] + EXTRA


class Target:
    """A folder with a sysroot, a file for meson and a build."""

    def __init__(self, folder, options):
        self.folder, self.options = folder, options
        self.sysroot, self.build = folder / "sysroot", folder / "build"
        self.program, self.runner = self.build / "harness/raingauge", folder / "run"

    def run(self, command, **variables):
        print("+", " ".join(map(str, command)), flush=True)
        return subprocess.run(list(map(str, command)), cwd=ROOT, env={**os.environ, **variables}, check=False).returncode == 0

    def run_there(self, command, **variables):
        """Runs a command in namespaces whose registry has programs of arm64 start by themselves, and each other, with the sysroot's
        libraries. qemu filters no system calls for a cage."""
        command = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", REGISTER, self.runner, *command]
        return self.run(command, RG_CAGE="off", **variables)

    # --- steps ---

    def make_sysroot(self):
        if (self.sysroot / "usr/include").exists():
            return True
        is_made = self.run(["mmdebstrap", "--quiet", "--variant=extract", "--architectures=arm64", "--include=" + ",".join(libraries()),
                            self.options.debian, str(self.sysroot), self.options.mirror])
        shutil.rmtree(self.sysroot / "dev", ignore_errors=True)  # qemu would open its terminals in place of this machine's
        return is_made

    def make_cross(self):
        (self.folder / "cross.ini").write_text(CROSS.format(root=self.sysroot))
        self.runner.write_text(f'#!/bin/sh\nexec qemu-aarch64-static -L {shlex.quote(str(self.sysroot))} "$@"\n')
        (self.folder / "raingauge").write_text(f'#!/bin/sh\nexec {shlex.quote(str(self.runner))} {shlex.quote(str(self.program))} "$@"\n')
        for script in (self.runner, self.folder / "raingauge"):
            script.chmod(0o755)
        if (self.build / "build.ninja").exists():
            return True
        return self.run(["meson", "setup", str(self.build), "--cross-file", str(self.folder / "cross.ini"), "-Ddrivers=false", "-Dlevels=sve"])

    def make_build(self):
        return self.run(["ninja", "-C", str(self.build), "-j", str(self.options.jobs)])

    def try_pairs(self):
        there = f"arm64=cpu@RG_PROGRAM={self.folder / 'raingauge'};RG_CAGE=off;RG_CPU_LEVEL="
        return all([self.run([self.options.native, "gate", "cpu", there + level, "--pictures"]) for level in LEVELS])

    def try_digests(self):
        gate = [self.program, "gate", "--baseline", self.options.baseline, "--device", "cpu", "--pictures"]
        return all([self.run_there(gate, RG_CPU_LEVEL=level) for level in LEVELS])

    def try_units(self):
        command = ["meson", "test", "-C", str(self.build), "--no-rebuild"]
        listed = subprocess.run(command + ["--list", "--suite", "unit"], capture_output=True, text=True, check=True).stdout.splitlines()
        names = [line.split(" / ", 1)[1] for line in listed if " / " in line]
        return self.run_there(command + ["--print-errorlogs", "--num-processes", str(self.options.jobs), "--timeout-multiplier", "100"] +
                              [name for name in names if name not in QEMU_LACKS])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    steps = {"sysroot": Target.make_sysroot, "cross": Target.make_cross, "build": Target.make_build, "pairs": Target.try_pairs,
             "digests": Target.try_digests, "unit": Target.try_units}
    parser.add_argument("steps", nargs="*", metavar="STEP", help=", ".join(steps))
    parser.add_argument("--in", dest="folder", metavar="FOLDER", help="keeps what is made there, and goes on from it")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at once; all cores without it")
    parser.add_argument("--debian", default="bookworm", help="%(default)s")
    parser.add_argument("--mirror", default="http://deb.debian.org/debian", help="%(default)s")
    parser.add_argument("--native", default="build/harness/raingauge", help="the program here; %(default)s")
    parser.add_argument("--baseline", default="results/baseline.json", help="whose digests must be met; %(default)s")
    options = parser.parse_args()
    unknown = [step for step in options.steps if step not in steps]
    if unknown:
        parser.error(f"{unknown[0]}: choose {', '.join(steps)}")
    for program, package in PROGRAMS.items():
        if not shutil.which(program):
            print(f"arm64.py: {program} is missing; install the package {package}")
            return MISSING
    folder = pathlib.Path(options.folder or tempfile.mkdtemp(prefix="arm64-")).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    target, failed = Target(folder, options), []
    try:
        for step in options.steps or steps:
            if not steps[step](target):
                failed.append(step)
                if step in ("sysroot", "cross", "build"):
                    break
    finally:
        if not options.folder:
            shutil.rmtree(folder, ignore_errors=True)
    print("arm64:", "pass" if not failed else ", ".join(failed) + " fails")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
