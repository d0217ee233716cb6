"""Commands that compare or measure, but have nothing left to do: none ends with status 0, and each says why."""
import concurrent.futures
import itertools
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

import misbehaving
from runner import LATER, NO_DRIVERS

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
TABLES = ("chin-timing", "creus-5.3", "feng-1", "raster-1", "stuppacher-1", "stuppacher-2", "ye-1")
KNOT = "raster/knot raster 64x48 2 scene=triangles triangles=1000\n"
DRY = "a/dry shower 64x36 1 geometry=off opacity=0\n"
DAYS = "  reason r\n  since 2026-01-01\n  until %s\n" % LATER
SETS = {"shower": "--set opacity=0 --set geometry=off", "cartoon": "", "drops": ""}
SEED, SAMPLE = 43, 60


class Inputs:
    """The commands' inputs: cells, expectations, pictures without rain, empty results, drivers that crash."""

    def __init__(self, runner, folder):
        self.runner, self.folder = runner, folder
        for name in ("empty", "state"):
            os.mkdir(self.path(name))
        self.cells, self.dry_cells = self.write("cells.txt", KNOT), self.write("dry.txt", DRY)
        self.known = {
            "skip": ["--expectations", self.write("skip.txt", "skip *\n" + DAYS)],
            "skips": ["--skips", self.write("skips.txt", ".\n")],
            "flake": ["--expectations", self.write("flake.txt", "flake *\n" + DAYS)],
            "flakes": ["--flakes", self.write("flakes.txt", ".\n")],
            "fail": ["--expectations", self.write("fail.txt", "fail *\n  outcome crash error timeout\n" + DAYS)],
            "fails": ["--fails", self.write("fails.txt", "raster/knot,Crash\n")],
        }
        self.baseline = self.path("baseline.json")
        runner.run(["baseline", "--pictures", "--device", "cpu", "--cells", self.cells, "-o", self.baseline])
        for name in ("dry.png", "dry.exr"):
            runner.run(["render", "shower", "--frame", "1", "--size", "64x36", "-o", self.path(name)] + SETS["shower"].split())
        record = json.load(open(os.path.join(ROOT, "results", "tables", "stuppacher-2.json")))
        record["cells"] = []
        os.mkdir(self.path("none"))
        self.write("none/stuppacher-2.json", json.dumps(record))
        self.falling = self.fall("vulkan", "vkCreateDevice", "abort", 0)
        self.drawing = self.fall("vulkan", "vkQueueSubmit", "abort", 0)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def fall(self, device, function, how, calls):
        """The name of a device whose driver crashes."""
        room = self.path("%s-%s" % (function, how))
        os.mkdir(room)
        env = misbehaving.shim(self.runner, room, device, function, how, calls)
        return device + "@" + ";".join("%s=%s" % pair for pair in env.items())


# --- command lines: arguments and variables ---


def of_gates(i):
    """Gates of two sides, of two builds and with a baseline, of which filters, skips and shards leave nothing."""
    kinds = (["cpu", "cpu"], ["--against", i.runner.raingauge, "--device", "cpu"], ["--baseline", i.baseline])
    nothing = [(["--gtest_filter=" + pattern], {}) for pattern in ("nosuch", "-*", "*-*knot*", "raster/rain")]
    nothing += [(i.known[name], {}) for name in ("skip", "skips")]
    nothing += [([], {"GTEST_TOTAL_SHARDS": "3", "GTEST_SHARD_INDEX": str(index)}) for index in (1, 2)]
    forms = ([], ["--json"], ["--github"], ["--junit", "{tmp}/junit.xml"])
    for kind, (more, env), form in itertools.product(kinds, nothing, forms):
        yield ["gate"] + kind + ["--pictures", "--cells", i.cells] + more + form, env


def of_falls(i):
    """Gates of drivers that crash in opening or drawing, as expected; and of cells without rain."""
    for device, known, required, form in itertools.product((i.falling, i.drawing), ("flake", "flakes", "fail", "fails"), ([], ["--require", "vulkan"]),
                                                           ([], ["--json"])):
        yield ["gate", "cpu", device, "--pictures", "--cells", i.cells] + i.known[known] + required + form, {}
    for sides, known in itertools.product((["cpu", "cpu"], ["cpu", "cpu:reference"]), ([],) + tuple(i.known[name] for name in ("flake", "flakes"))):
        yield ["gate", *sides, "--pictures", "--cells", i.dry_cells] + known, {}
    yield ["baseline", "--pictures", "--device", "cpu", "--cells", i.dry_cells, "-o", "{tmp}/made.json"], {}
    for known in ([], i.known["flake"], i.known["skip"]):
        yield ["gate", "cpu", "vulkan", "--pictures", "--cells", i.cells] + known, NO_DRIVERS


def of_pictures(i):
    """Frames and files without rain."""
    for technique, frame, form in itertools.product(SETS, (0, 1), ([], ["--json"])):
        if technique == "shower" or frame == 0:
            yield ["diff", technique, "--frame", str(frame), "--size", "64x36", "--device", "cpu,cpu:reference"] + SETS[technique].split() + form, {}
    for name, form, exposure in itertools.product(("dry.png", "dry.exr"), ([], ["--json"]), ([], ["--exposure", "2"])):
        yield ["diff", i.path(name), i.path(name), "--background", i.path(name)] + form + exposure, {}
    for devices in ("vulkan,gl", "cpu,vulkan", "opencl,cpu"):
        yield ["diff", "raster", "--frame", "1", "--size", "32x32", "--device", devices], NO_DRIVERS
    for device in ("cpu", "cpu:reference"):
        yield ["diff", "raster", "--device", device], {}


def of_checks(i):
    """verify without a device to compare, and shrink, doctor and bisect with nothing to find."""
    for technique, frame, form in itertools.product(("cartoon", "drops", "flow", "raster", "shower"), ("0", "1"), ([], ["--json"])):
        yield ["verify", technique, "--stages", "--frame", frame, "--size", "32x32", "--device", "cpu:reference"] + form, {}
    for device in ("vulkan", "gl", "opencl"):
        yield ["doctor", "--device", device], NO_DRIVERS
        yield ["verify", "raster", "--stages", "--device", device], NO_DRIVERS
        yield ["table", "raster-1", "--rows", "1-1", "--device", device], NO_DRIVERS
        yield ["shrink", "raster", "--device", "cpu," + device, "-o", "{tmp}/case.txt"], NO_DRIVERS
    for technique in ("raster", "shower"):
        yield ["shrink", technique, "--frame", "1", "--size", "32x32", "--device", "cpu,cpu:reference", "-o", "{tmp}/case.txt"], {}
    for status in (0, 1, 77, 125, 4):
        yield ["bisect", "--good", "A", "--bad", "B", "--run", "exit %d" % status, "X"], {}


def of_tables(i):
    """Tables without anything stored, chosen, drawn or compiled."""
    kept = os.path.join(ROOT, "results", "tables")
    forms = ([], ["--json"], ["--format", "csv"], ["--claims"])
    for table, form in itertools.product(TABLES, forms):
        yield ["table", table, "--from", i.path("empty")] + form, {}
    for more, form in itertools.product((["--rows", "90-99"], ["--variant", "nosuch"], ["--work", "queries"]), forms):
        yield ["table", "stuppacher-2", "--from", kept] + more + form, {}
    for form in forms:
        yield ["table", "--from", i.path("none")] + form, {}
    for table in TABLES:
        yield ["table", table, "--compile", "--device", "cpu,cpu:reference"], {}
        yield ["table", table, "--rows", "90-99", "--device", "cpu"], {}
    for form in ([], ["--json"], ["-o", "{tmp}/made"]):
        yield ["sweep", "shower", "--axis", "opacity=0", "--set", "geometry=off", "--quick", "--size", "32x32", "--frame", "1"] + form, {}
    yield ["atlas", "--quick", "--compare", i.path("empty")], {}


def lines_of(i):
    return [line for make in (of_gates, of_falls, of_pictures, of_checks, of_tables) for line in make(i)]


# --- running them ---


def problems_of(runner, inputs, line):
    args, env = line
    with tempfile.TemporaryDirectory() as tmp:
        args = [arg.replace("{{", "{").replace("}}", "}").replace("{tmp}", tmp) for arg in args]
        ran = runner.run(args, dict(env, XDG_STATE_HOME=tmp))
    told = "%s %s" % (" ".join("%s=%s" % pair for pair in env.items()), " ".join(args))
    if ran.returncode not in (1, 2, 3, 4, 77):
        return ["%s: exit status %d, %s%s" % (told, ran.returncode, ran.stdout[-300:], ran.stderr)]
    says = ran.stderr or ran.closing or "no rain at frame" in ran.stdout
    return [] if says else ["%s: does not say why: %s" % (told, ran.stdout)]


def problems_of_all(runner, count):
    """The problems of a seeded sample of commands, or of all."""
    with tempfile.TemporaryDirectory() as folder:
        inputs = Inputs(runner, folder)
        lines = lines_of(inputs)
        problems = [] if len(lines) >= 200 else ["%d command lines" % len(lines)]
        chosen = random.Random(SEED).sample(lines, count or len(lines))
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            problems += [problem for found in pool.map(lambda line: problems_of(runner, inputs, line), chosen) for problem in found]
    return problems


def check_sample(runner):
    """no command that has nothing left to compare or measure ends with status 0, and each says why"""
    return problems_of_all(runner, SAMPLE)


def check_all(runner):
    """none of all 200 and more such command lines ends with status 0"""
    return problems_of_all(runner, 0)


def check_something(runner):
    """the same commands pass if something is left, and say how much"""
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        i = Inputs(runner, folder)
        for args, says in ((["gate", "cpu", "cpu", "--pictures", "--cells", i.cells] + i.known["flake"], "1 case, 1 flake\n"),
                           (["gate", "--baseline", i.baseline, "--pictures", "--cells", i.cells], "1 case, 1 pass\n"),
                           (["diff", "drops", "--frame", "60", "--size", "64x48", "--device", "cpu,cpu:reference"], "1 pair of 2 devices compared\n"),
                           (["verify", "raster", "--stages", "--frame", "1", "--size", "32x32", "--device", "cpu"], "6 checks, 6 ok\n")):
            ran = runner.run(args)
            if ran.returncode or not ran.stdout.endswith(says):
                problems.append("%s: exit status %d, %s%s" % (args, ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_frame(runner):
    """a frame without rain is reported with one that has rain, if one is found"""
    problems = []
    for args, says in (("diff drops --frame 0 --size 64x48 --device cpu,cpu:reference", "diff drops: no rain at frame 0, so that nothing is compared; take --frame 60\n"),
                       ("diff shower --frame 60 --size 64x36 --device cpu,cpu:reference " + SETS["shower"],
                        "diff shower: no rain at frame 60, nor at 240, so that nothing is compared; give another size or setting\n")):
        ran = runner.run(args.split())
        lines = r"cpu: \S.*, .*raingauge, \S.*\ncpu:reference: \S.*, .*raingauge, \S.*\n0 pairs of 2 devices compared\n"
        if ran.returncode != 4 or ran.stderr != "raingauge: " + says or not re.fullmatch(lines, ran.stdout):
            problems.append("%s: exit status %d, %s%s" % (args, ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_same(runner):
    """records that hold no cell are not the same as others"""
    with tempfile.TemporaryDirectory() as folder:
        i = Inputs(runner, folder)
        script = os.path.join(ROOT, "results", "same.py")
        ran = [subprocess.run([sys.executable, script, i.path(name), os.path.join(ROOT, "results", "tables")], capture_output=True, text=True, check=False)
               for name in ("none", "empty")]
        shutil.copy(os.path.join(ROOT, "results", "tables", "stuppacher-2.json"), i.path("empty"))
        well = subprocess.run([sys.executable, script, i.path("empty"), os.path.join(ROOT, "results", "tables")], capture_output=True, text=True, check=False)
    problems = ["%d, %s%s" % (one.returncode, one.stdout, one.stderr) for one in ran if one.returncode == 0 or not one.stderr]
    return problems + ([] if well.returncode == 0 else [well.stdout + well.stderr])


CHECKS = [check_sample, check_something, check_frame, check_same]
THOROUGH = [check_all]
