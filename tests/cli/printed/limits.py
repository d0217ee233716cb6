"""Disk, memory, time and threads: announcements beforehand, and refusals."""
import json
import os
import re
import subprocess
import sys
import tempfile

from cases import RENDER
from runner import NO_DRIVERS

# Commands that would take hours on a disk of 64 KiB, and must be refused before they begin.
TOO_LARGE = [
    ("render raster --frame 10000000 --size 1024x1024 -o a.png", "a.png: the disk has 64 KiB left, and at least 102 KiB"),
    ("render raster --frame 10000000 --size 512x512 -o a.exr", "a.exr: the disk has 64 KiB left, and at least 77 KiB"),
    ("render raster --frames 0-9999999 --size 64x64 -o a%08d.hdr", "a00000000.hdr: the disk has 64 KiB left, and at least 11"),
    ("render raster --frames 0-9999999 --size 256x256 -o a.webm", "a.webm: the disk has 64 KiB left, and at least 6"),
    ("diff raster --frame 10000000 --size 1024x1024 --device cpu,cpu:reference -o a", "a-flip.png: the disk has 64 KiB left"),
    ("table --full --device cpu -o a", "a: the disk has 64 KiB left"),
    ("figures --size 1024x1024 -o a", "a: the disk has 64 KiB left"),
    ("atlas --full -o a", "a: the disk has 64 KiB left, and at least 40"),
    ("atlas cartoon -o a", "a: the disk has 64 KiB left, and at least 256 KiB"),
]


def check_full_disk(runner):
    """results that cannot fit on the disk are refused before the work"""
    problems = []
    for args, error in TOO_LARGE:
        script = "mount -t tmpfs -o size=64k tmpfs /mnt && cd /mnt && \"$0\" %s; status=$?; ls; exit $status" % args
        done = subprocess.run(["unshare", "-rm", "sh", "-c", script, runner.raingauge], env=runner.variables({}),
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", timeout=100)
        if re.search("unshare: |mount: ", done.stderr):
            print("# not tried: no file system may be mounted here: " + done.stderr.strip())
            return []
        if done.returncode != 71 or done.stdout or error not in done.stderr or done.stderr.count("\n") != 1:
            problems.append("%s: status %d, %s%s" % (args, done.returncode, done.stdout, done.stderr))
    return problems


# Commands that take tens of MB or more. The larger of raingauge and its worker may exceed the announced memory by at
# most BESIDE_BYTES and FACTOR.
SAID = ["raster --size 2048x2048", "cartoon --size 2048x1024", "flow --size 512x512 --set resolution_px=1024",
        "drops --size 1024x1024"]

BESIDE_BYTES, FACTOR = 40e6, 1.25


# Starts a command and prints its peak memory. The kernel also counts the memory before the command was executed, which is its
# parent's: little, since this parent imports nothing.
STARTER = """import os, sys
child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=[(os.POSIX_SPAWN_OPEN, 1, "/dev/null", os.O_WRONLY, 0)])
_, status, usage = os.wait4(child, 0)
print(usage.ru_maxrss * 1024, os.waitstatus_to_exitcode(status))"""


def resident_bytes(runner, args):
    """The peak memory of a process of a command, its status, and its stderr."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, "-ISc", STARTER, runner.raingauge] + args + ["-o", os.path.join(folder, "a.exr")],
                              env=runner.variables({}), stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", timeout=600)
        most, status = map(int, done.stdout.split())
        return most, status, done.stderr


def check_memory(runner):
    """processes take the announced memory, and refused ones take little"""
    problems = []
    for args in SAID:
        width, height = map(int, re.search(r"--size (\d+)x(\d+)", args).groups())
        picture = width * height * 32
        args = ("render " + args + " --frame 1").split()
        taken, status, log = resident_bytes(runner, args)
        small, refused, line = resident_bytes(runner, args + ["--memory", "%fM" % (picture / 2**20 + 1)])
        number, unit = re.search(r"needs ([\d.]+) ([MG])iB, and 1.0 MiB of --memory are left", line).groups()
        sent = width * height * 16  # the picture on its way to raingauge; its worker holds it twice
        said = max(float(number) * {"M": 2**20, "G": 2**30}[unit] + sent, picture)
        if status or log or refused != 2 or not 0.7 * said < taken < FACTOR * said + BESIDE_BYTES:
            problems.append("%s: said %.0f, taken %.0f, status %d: %s" % (args, said, taken, status, log))
        if small > taken / 2:
            problems.append("%s: refusing it takes %.0f" % (args, small))
    return problems


def check_long(runner):
    """a long task announces its time in a line, and with every tenth the time left; a short one prints nothing"""
    problems = []
    for args, line in ((RENDER.replace("--frame 1", "--frame 100"), "flow, 100 frames"),
                       (RENDER.replace("--frame 1", "--frames 0-100") + "-o {}/a%03d.png", "flow, frames 0-100")):
        with tempfile.TemporaryDirectory() as folder:
            args = [word.replace("{}", folder) for word in args.split()]
            if args[0] == "render" and "-o" not in args:
                args += ["-o", os.path.join(folder, "a.png")]
            told, silent = (runner.run(args, {"RG_LONG_S": s}) for s in ("0.0001", "1e9"))
        lines = "raingauge: about .* in all; now: {0}\n(raingauge: about .* left; now: {0}\n){{0,12}}".format(line)
        if told.returncode or not re.fullmatch(lines, told.stderr):
            problems.append("%s: status %d, %s" % (args, told.returncode, told.stderr))
        if silent.returncode or silent.stderr:
            problems.append("%s, not long: status %d, %s" % (args, silent.returncode, silent.stderr))
    return problems


def check_threads(runner):
    """threads are at most four a processor, and a wrong number is reported once"""
    problems = []
    processors = os.sysconf("SC_NPROCESSORS_ONLN")
    most = "raingauge: warning: OMP_NUM_THREADS=%s: more than 4 threads on each of " + \
           "%d processors; %d are used\n" % (processors, 4 * processors)
    for spin in (None, "0"):
        for number, line in (("abc", r"\nlibgomp: Invalid value for environment variable OMP_NUM_THREADS.*\n"), ("100000", most % "100000"),
                             ("1", ""), ("100000,2", most % "100000,2"), (str(4 * processors), "")):
            done = runner.run(["list", "devices", "--json"], dict(NO_DRIVERS, OMP_NUM_THREADS=number, GOMP_SPINCOUNT=spin))
            first = [device["api"] for device in json.loads(done.stdout)["devices"] if device["name"] == "cpu"]
            used = len(os.sched_getaffinity(0)) if number == "abc" else min(int(number.split(",")[0]), 4 * processors)
            told = re.sub(r"(?m)^raingauge: warning: unsupported here: .*\n", "", done.stderr)
            if done.returncode or not re.fullmatch(line, told):
                problems.append("%s: status %d, %r" % (number, done.returncode, told))
            if not first or not re.search(r", %d threads?$" % used, first[0]):
                problems.append("%s: %s" % (number, first))
    with tempfile.TemporaryDirectory() as folder:
        args = RENDER.split() + ["--json", "-o", os.path.join(folder, "a.png")]
        drawn = json.loads(runner.run(args, {"OMP_NUM_THREADS": "abc"}).stdout)
    if "OMP_NUM_THREADS" in drawn["passport"]["environment"]:
        problems.append("the passport has a number that is none")
    return problems


CHECKS = [check_full_disk, check_long, check_threads]
LONG = [check_memory]
