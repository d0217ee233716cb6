"""gate: compares one device with another, reports what is worse in every form, and ends with its own status."""
import json
import os
import re
import subprocess
import tempfile
import xml.etree.ElementTree

import forms
import misbehaving
from runner import LATER
from wrong import turned_kernels

TESTS = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCHEMA = os.path.join(TESTS, "harness", "gate", "report", "junit.xsd")
KNOT = "raster/knot raster 64x48 2 scene=triangles triangles=1000\n"
# Extra loops per frame for runner.slower: many times the frame's own work, even on a busy machine.
EXTRA = "RG_EXTRA_LOOPS=1000000"
AT_ONCE = ["--margin", "100"]  # decided at the first look, unless the machine is very busy
QUICK = KNOT + "flow/pane flow 64x48 2 view=pane resolution_px=64 environment_px=16\n"


class Files:
    """A folder with a file of cells in it."""

    def __init__(self, cells=QUICK):
        self.folder = tempfile.TemporaryDirectory()
        self.cells = self.path("cells.txt", cells)

    def path(self, name, text=None):
        path = os.path.join(self.folder.name, name)
        if text is not None:
            with open(path, "w") as file:
                file.write(text)
        return path

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.folder.cleanup()


def endings(report):
    return {case["name"]: case["ending"] for case in report["gated"]}


def check_same(runner):
    """a device agrees with itself, and all built-in cells run on it"""
    result = runner.run("gate cpu cpu --pictures --json".split())
    report = json.loads(result.stdout)
    problems = forms.problems("gate", report)
    if result.returncode or result.stderr or len(report["gated"]) < 6 or set(endings(report).values()) != {"pass"}:
        problems.append("exit status %d, %s, %s" % (result.returncode, result.stderr, endings(report)))
    problems += ["code: %s" % case["details"] for case in report["gated"] if "the same program, the same libraries" not in case["details"]]
    return problems


def check_slower(runner):
    """a cell that takes several times as long is found, in every form"""
    problems = []
    with Files(KNOT) as files:
        junit, bmf = files.path("junit.xml"), files.path("bmf.json")
        slower = "cpu@RG_PROGRAM=%s;%s" % (runner.slower, EXTRA)
        result = runner.run(["gate", "cpu", slower, "--cells", files.cells, "--json", "--junit", junit, "--bmf", bmf])
        report = json.loads(result.stdout)
        problems += forms.problems("gate", report)
        wanted = {"raster/knot." + slower: "regressed"}
        if result.returncode != 1 or endings(report) != wanted:
            problems.append("exit status %d, %s, %s" % (result.returncode, result.stderr, endings(report)))
        if any(case["ratio"]["value"] < 1.05 or not case["ratio"]["low"] > 1 for case in report["gated"]):
            problems.append("ratios: %s" % [case["ratio"] for case in report["gated"]])
        lint = subprocess.run(["xmllint", "--noout", "--schema", SCHEMA, junit], capture_output=True, text=True, check=False)
        if lint.returncode:
            problems.append(lint.stderr)
        with open(bmf) as file:
            measures = json.load(file)
        if set(measures) != set(wanted) or not all(m["latency"]["lower_value"] <= m["latency"]["value"] <= m["latency"]["upper_value"]
                                                   for m in measures.values()):
            problems.append("bmf: %s" % measures)
    return problems


def check_quarantined(runner):
    """a cell in quarantine is measured, and its regression is reported but fails nothing"""
    with Files(KNOT) as files:
        known = files.path("known.txt", "flake *\n  reason it comes and goes\n  since 2026-01-01\n  until " + LATER + "\n")
        result = runner.run(["gate", "cpu", "cpu@RG_PROGRAM=%s;%s" % (runner.slower, EXTRA), "--cells", files.cells, "--expectations", known, "--json"])
    case = json.loads(result.stdout)["gated"][0]
    good = result.returncode == 0 and case["ending"] == "flake" and re.match(r"flaky: a frame takes \d.* % longer \(", case["message"])
    return [] if good else ["exit status %d, %s: %s" % (result.returncode, case["ending"], case["message"])]


def check_expired(runner):
    """an expired expectation fails, even if its cell is faster or open; a device that is missing leaves it unchanged"""
    problems = []
    with Files(KNOT) as files:
        slower = "cpu@RG_PROGRAM=%s;%s" % (runner.slower, EXTRA)
        for sides, budget, kinds, status, ending in (([slower, "cpu"], [], ("skip",), 1, "unexpected pass"),
                                                     (["cpu", "cpu"], ["--budget", "5s"], ("flake",), 1, "unexpected pass"),
                                                     (["cpu", slower], [], ("flake",), 1, "regressed"),
                                                     (["cpu", "vulkan@VK_DRIVER_FILES=/nonexistent"], [], ("flake", "skip"), 77, "unsupported")):
            for kind in kinds:
                known = files.path("known.txt", kind + " *\n  reason it was so\n  since 2026-01-01\n  until 2026-02-01\n")
                result = runner.run(["gate", *sides, "--cells", files.cells, "--expectations", known, "--json"] + budget)
                case = json.loads(result.stdout)["gated"][0]
                less = re.search(r"a frame takes (\S+) % less \((\S+) to (\S+) %\): A [\d.]+ ms, B [\d.]+ ms$", case["message"])
                if (sides[0] == slower) != bool(less) or (less and not 0 < float(less[2]) <= float(less[1]) <= float(less[3]) < 100):
                    problems.append("%s, %s: %s" % (sides, kind, case["message"]))
                if result.returncode != status or case["ending"] != ending or case["message"].startswith("expired") != (status == 1):
                    problems.append("%s, %s: exit status %d, %s: %s" % (sides, kind, result.returncode, case["ending"], case["message"]))
    return problems


def check_without_ids(runner):
    """libraries without a build id are told apart by their code"""
    problems = []
    with Files(KNOT) as files:
        for name, value in (("one", 1), ("two", 2), ("again", 1)):
            source = files.path(name + ".c", "int rg_test(void) { return %d; }\n" % value)
            subprocess.run(["cc", "-shared", "-fPIC", "-Wl,--build-id=none", source, "-o", files.path(name + ".so")], check=True)
        for other, says in (("two", "the same program, other libraries"), ("again", "the same program, the same libraries")):
            devices = ["cpu@LD_PRELOAD=" + files.path(name + ".so") for name in ("one", other)]
            result = runner.run(["gate", *devices, "--cells", files.cells, "--pictures"])
            if result.returncode or says not in result.stdout:
                problems.append("%s: exit status %d, %s%s" % (other, result.returncode, result.stdout, result.stderr))
    return problems


def check_builds(runner):
    """another build is compared with this one on each named device, and its extra work is found"""
    problems = []
    with Files(KNOT) as files:
        args = ["gate", "--against", runner.slower, "--cells", files.cells, "--json"]
        for more, device, wanted in ((["--pictures"], "cpu,cpu:reference", {"raster/knot.cpu": "pass", "raster/knot.cpu:reference": "pass"}),
                                     ([], "cpu@" + EXTRA, {"raster/knot.cpu@" + EXTRA: "improved"})):
            result = runner.run(args + more + ["--device", device])
            report = json.loads(result.stdout) if result.stdout else {"gated": []}
            if result.returncode or result.stderr or endings(report) != wanted:
                problems.append("%s: exit status %d, %s, %s" % (device, result.returncode, result.stderr, endings(report)))
            problems += ["code: %s" % case["details"] for case in report["gated"]
                         if "another program, the same libraries" not in case["details"]]
            problems += ["devices: %s" % case["devices"] for case in report["gated"]
                         if case["devices"][0] != case["devices"][1] + ";@"["@" not in case["devices"][1]] + "RG_PROGRAM=" + runner.slower]
    return problems


def check_fallen(runner):
    """a driver that crashes while devices are listed fails a gate of builds, and every other device is compared with its own"""
    with Files(KNOT) as files:
        # OpenCL would compile everything anew for another program.
        result = runner.run(["gate", "--against", runner.slower, "--pictures", "--cells", files.cells, "--json"],
                            env=dict(runner.crashing_vulkan(files.folder.name), OCL_ICD_VENDORS="/nonexistent"))
        report = json.loads(result.stdout) if result.stdout else {"gated": []}
    wanted = {"raster/knot." + device: "pass" for device in ("cpu", "cpu:reference", "gl")}
    told = re.sub(r"(?m)^raingauge: warning: unsupported here: opencl.*\n", "", result.stderr)
    return [] if result.returncode == 1 and endings(report) == wanted and told.count("\n") == 1 else [
        "exit status %d, %s, %s" % (result.returncode, endings(report), result.stderr)]


def needed_s(result):
    """Seconds until a first look, from a gate that was refused because its budget is too short for one; 0: it was not refused."""
    said = re.fullmatch(r"raingauge: --budget: the first look, after (?:16|8) launches, comes about (\d+) s after the start, so that nothing is "
                        r"decided within ([\d.]+) s; give (\d+)s or more, or gate fewer cells\n", result.stderr)
    return float(said[1]) if result.returncode == 2 and said and float(said[1]) >= float(said[2]) and said[1] == said[3] else 0


def check_budget(runner):
    """a budget too short for a first look is refused, and the line names the time needed; pictures are judged all the same"""
    problems = []
    with Files() as files:
        budget = 0.001
        for says in ("compared", ""):
            result = runner.run(["gate", "cpu", "cpu", "--cells", files.cells, "--budget", "%gs" % budget, "--require", "cpu", "--json"])
            found = json.loads(result.stdout)
            ends = {case["ending"] for case in found["gated"]}
            if not needed_s(result) or ends != {"inconclusive"} or not found["gated"][-1]["message"].startswith("the time was over before it was " + says):
                problems.append("%g s: exit status %d, %s%s" % (budget, result.returncode, result.stderr, result.stdout))
            budget = needed_s(result) / 3
        args = ["gate", "gl", "gl@RG_KERNEL_DIR=" + turned_kernels(runner), "--cells", files.cells, "--margin", "0.001", "--budget"]
        for budget in (4, 12, 36, 108):  # a slow machine needs more to compare pictures
            result = runner.run(args + ["%ds" % budget])
            if not result.stderr:
                break
        if result.returncode != 1 or result.stderr:
            problems.append("a difference: exit status %d, %s" % (result.returncode, result.stderr))
    return problems


def check_open(runner):
    """a verdict that is open when the time is over is inconclusive, with its own status; a gate that was refused before goes on"""
    with Files(KNOT) as files:
        args = ["gate", "cpu", "cpu", "--cells", files.cells, "--margin", "0.001", "-o", files.path("out"), "--budget"]
        budget = needed_s(runner.run(args + ["0.001s"])) / 3
        for _ in range(20):
            result = runner.run(args + ["%gs" % budget])
            if result.returncode != 2:
                break
    good = result.returncode == 3 and "inconclusive      raster/knot.cpu\n  | the time was over before it was decided\n" in result.stdout
    return [] if good else ["exit status %d, %s%s" % (result.returncode, result.stderr, result.stdout)]


def check_shared(runner):
    """devices of two builds share the budget: a slow device leaves less time to the next, which stays open"""
    with Files(KNOT) as files:
        slow = files.path("slow.sh", "#!/bin/sh\nsleep $RG_SLOW_S\nexec %s \"$@\"\n" % runner.raingauge)
        os.chmod(slow, 0o700)
        problems = []
        for first_s, second_s, decided in ((0, 3, [True, False]), (2, 0, [False, True])):
            devices = "cpu@RG_SLOW_S=%d,cpu:reference@RG_SLOW_S=%d" % (first_s, second_s)
            result = runner.run(["gate", "--against", slow, "--device", devices, "--cells", files.cells, "--budget", "45s", *AT_ONCE, "--json"])
            cases = json.loads(result.stdout)["gated"]
            if result.returncode != 3 or [case["ending"] == "pass" for case in cases] != decided:
                problems.append("%s: exit status %d, %s, %s" % (devices, result.returncode, endings({"gated": cases}), result.stderr))
    return problems


def check_crash(runner):
    """a driver that crashes ends its own cells; if that is expected it is no failure, but no pass either, since nothing was compared"""
    problems = []
    with Files() as files:
        driver = files.path("driver.json")
        with open(driver, "w") as file:
            json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": runner.misbehaver, "api_version": "1.1.0"}}, file)
        device = "vulkan@VK_DRIVER_FILES=%s;RG_MISBEHAVE=vkQueueSubmit:abort:0" % driver
        known = files.path("known.txt", "fail *\n  device vulkan@*\n  outcome crash\n  reason it falls\n  since 2026-11-01\n"
                           "  until " + LATER + "\n")
        # Its fixed functions are not drawn, for its settings are its own.
        for more, status, wanted in (([], 1, {"crash", "skipped"}), (["--expectations", known], 4, {"expected failure", "skipped"})):
            result = runner.run(["gate", "vulkan", device, "--cells", files.cells, "--json", "--timeout", "10"] + more)
            found = set(endings(json.loads(result.stdout)).values()) if result.stdout else set()
            if result.returncode != status or found != wanted:
                problems.append("exit status %d, %s, %s" % (result.returncode, found, result.stderr))
    return problems


def check_unused(runner):
    """an expectation of a device or driver that a gate lacks is reported in a line; the patterns of the pages hold"""
    problems = []
    root = os.path.dirname(TESTS)
    with Files(KNOT) as files:
        path = files.path("baseline.json")
        runner.run(["baseline", "--device", "vulkan", "--pictures", "--cells", files.cells, "-o", path])
        driver = json.loads(runner.run(["list", "devices", "--json"]).stdout)
        driver = next(device["driver"] for device in driver["devices"] if device["name"] == "vulkan")
        with open(os.path.join(root, "docs", "expectations.md")) as page, open(os.path.join(root, "results", "expectations.txt")) as own:
            shown = [re.search(r"^(?:#| )  +driver +(\S.*)$", text.read(), re.M)[1].replace("22.3", re.search(r"Mesa (\d+\.\d+)", driver)[1]) for text in (page, own)]
        for args in (["cpu", "vulkan"], ["--baseline", path]):
            rows = (("vulkan*", shown[0], None), ("vulkan*", "Mesa 22.3.*", "'Mesa 22.3.*' is of no driver"), ("vulkan*", shown[1], None),
                    ("vulcan*", "*", "'vulcan*' is of no device"))
            for device, name, of in rows[:2] if path in args else rows:  # a baseline's gate draws fixed functions, too
                known = files.path("known.txt", "flake *\n  device %s\n  driver %s\n  reason r\n  since 2026-01-01\n  until %s\n" % (device, name, LATER))
                result = runner.run(["gate", *args, "--pictures", "--cells", files.cells, "--expectations", known])
                if result.returncode or (of or "") not in result.stderr or result.stderr.count("\n") != bool(of) or ("\nflake " in "\n" + result.stdout) == bool(of):
                    problems.append("%s, %s, %s: exit status %d, %s%s" % (args, device, name, result.returncode, result.stdout, result.stderr))
    return problems


def check_sides(runner):
    """a failure of A does not meet an expectation about B, whether the two are compared or timed, and no file blames B for it"""
    problems = []
    with Files(KNOT) as files:
        known = files.path("known.txt", "fail *\n  device vulkan*\n  outcome crash\n  reason it falls\n  since 2026-11-01\n  until " + LATER + "\n")
        fails, empty = files.path("fails.txt", "raster/knot,Crash\n"), files.path("empty.txt", "")
        # Two launches compare pictures; the device's driver crashes after a given number of them.
        count = files.path("count")
        env = misbehaving.shim(runner, files.folder.name, "vulkan", "vkQueueSubmit", "abort", 0)
        other = files.path("other.sh", "#!/bin/sh\necho >> %s\ntest $(wc -l < %s) -gt ${RG_TEST_GOOD} && export RG_MISBEHAVE=%s\nexec %s \"$@\"\n" % (
            count, count, env["RG_MISBEHAVE"], runner.raingauge))
        os.chmod(other, 0o700)
        for good, more in ((0, ["--expectations", known]), (0, ["--fails", fails]), (0, ["--expectations", empty]), (4, ["--expectations", known])):
            device = "vulkan@RG_PROGRAM=%s;RG_TEST_GOOD=%d;VK_DRIVER_FILES=%s" % (other, good, env["VK_DRIVER_FILES"])
            for a, b, is_met in ((device, "vulkan", False), ("vulkan", device, empty not in more)):
                files.path("count", "")
                result = runner.run(["gate", a, b, "--cells", files.cells] + more)
                is_told, is_untrue = "expected failure" in result.stdout, "is not true of this run" in result.stdout
                if result.returncode != (1 if not is_met else 0 if good else 4) or is_told != is_met or is_untrue != (a == "vulkan" and not is_met) or "crash" not in result.stdout + result.stderr:
                    problems.append("%s, %s, %s: exit status %d, %s%s" % (a, b, more, result.returncode, result.stdout, result.stderr))
    return problems


def check_ours(runner):
    """a want of a file, of memory or of rain is no failure of a driver that could be expected, also against a baseline"""
    problems = []
    bad = "a/file raster 64x48 1 scene=mesh model=%s\nb/dry shower 64x36 1 geometry=off opacity=0\nc/large raster 1024x1024 1 billboards=10\n"
    with Files() as files:
        model, path = files.path("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), files.path("baseline.json")
        cells = files.path("bad.txt", bad % model)
        more = ["--cells", cells, "--pictures"]
        runner.run(["baseline", "--device", "cpu", "-o", path] + more)
        os.remove(model)
        fails = files.path("fails.txt", "a/file,Fail\nb/dry,Fail\nc/large,Fail\n")
        flakes, empty = files.path("flakes.txt", "a\nb\nc\n"), files.path("empty.txt", "")
        for args in (["cpu", "cpu"], ["--baseline", path]):
            for known in (["--fails", fails], ["--flakes", flakes], ["--expectations", empty]):
                result = runner.run(["gate"] + args + more + ["--memory", "95M"] + known)
                told = re.findall(r"^(\S.*?)  +[abc]/\w+\.cpu", result.stdout, re.M)
                if result.returncode != 1 or len(told) != 3 or set(told) != {"error", "nothing measured"} or "--- " in result.stdout:
                    problems.append("%s, %s: exit status %d, %s%s" % (args, known, result.returncode, result.stdout, result.stderr))
    return problems


def check_falling(runner):
    """a side that cannot be started any more fails the gate, whatever was measured by then, and is no failure that could be expected"""
    problems = []
    expected = "fail raster/*\n  outcome error\n  reason it stops\n  since 2026-01-01\n  until " + LATER + "\n"
    with Files(KNOT) as files:
        count, known = files.path("count"), files.path("known.txt", expected)
        for device, falls, more, says in (("cpu", "exit 1", [], "is no raingauge that this one can ask"),
                                          ("cpu", "exit 1", ["--expectations", known], "is no raingauge that this one can ask"),
                                          ("vulkan", "export VK_DRIVER_FILES=/nonexistent", [], "no Vulkan driver")):
            other = files.path("other.sh", "#!/bin/sh\necho >> %s\ntest $(wc -l < %s) -gt 5 && %s\nexec %s \"$@\"\n" % (count, count, falls, runner.raingauge))
            os.chmod(other, 0o700)
            files.path("count", "")
            result = runner.run(["gate", device, device + "@RG_PROGRAM=" + other, "--cells", files.cells, "--json"] + more)
            case = json.loads(result.stdout)["gated"][0]
            if result.returncode != 1 or case["ending"] != "error" or says not in case["message"]:
                problems.append("%s, %s: exit status %d, %s: %s" % (falls, more, result.returncode, case["ending"], case["message"]))
    return problems


WAYS = (("vulkan", "vkCreateComputePipelines", "hang", 1), ("gl", "glDispatchCompute", "fault", 3), ("gl", "glLinkProgram", "swell", 2),
        ("opencl", "clEnqueueNDRangeKernel", "exit", 2), ("opencl", "clEnqueueNDRangeKernel", "lost", 2))


def check_ways(runner):
    """B's cells end as its driver misbehaves, in each other way too, in one line"""
    problems = []
    for case in WAYS:
        with Files(KNOT) as files:
            env = misbehaving.shim(runner, files.folder.name, *case)
            device = case[0] + "@" + ";".join("%s=%s" % pair for pair in env.items())
            result = runner.run(["gate", case[0], device, "--cells", files.cells, "--json"] + misbehaving.bounds(case[2]))
        gated = json.loads(result.stdout)["gated"] if result.stdout else []
        found = {case["ending"] for case in gated if case["technique"] != "fixed"}  # whose settings are B's own
        outcome, said = misbehaving.HOW[case[2]]
        if result.returncode != 1 or found != {outcome} or result.stderr.count("\n") != 1 or not re.search(said, result.stderr):
            problems.append("%s: exit status %d, %s, %s" % (case, result.returncode, found, result.stderr))
    return problems


def check_miscompiled(runner):
    """a kernel with another constant is found before anything is timed, and blamed on its stage"""
    with Files() as files:
        result = runner.run(["gate", "gl", "gl@RG_KERNEL_DIR=" + turned_kernels(runner), "--cells", files.cells, "--json", *AT_ONCE])
        report = json.loads(result.stdout)
    found = {case["name"].split(".")[0]: case for case in report["gated"]}
    problems = []
    if result.returncode != 1 or found["flow/pane"]["ending"] != "differs" or found["raster/knot"]["ending"] == "differs":
        problems.append("exit status %d, %s" % (result.returncode, endings(report)))
    if "; no tier would hold: " not in found["flow/pane"]["message"] or "raingauge diff" in found["flow/pane"]["details"]:
        problems.append("what would hold: %s" % found["flow/pane"])
    if "stage flow_normals" not in found["flow/pane"]["details"] or found["flow/pane"]["ratio"]["value"] is not None:
        problems.append("%s" % found["flow/pane"])
    for cell, is_same in (("raster/knot", True), ("flow/pane", False)):
        passes = re.search(r"the same program, the same libraries; compiled passes (\w{8}) and (\w{8}), ", found[cell]["details"])
        if not passes or (passes[1] == passes[2]) != is_same:
            problems.append("code of %s: %s" % (cell, found[cell]["details"]))
    return problems


def check_cached(runner):
    """code from a cache of more cells is the same as newly compiled code, though Mesa numbered its programs otherwise"""
    with Files("shower/rain shower 64x48 2 geometry=off particles=100\n" + KNOT) as files:
        env = {"XDG_CACHE_HOME": files.path("cache")}
        alone = files.path("alone.txt", KNOT)
        runner.run(["gate", "gl", "gl@X=1", "--cells", files.cells, "--pictures"], env)
        result = runner.run(["gate", "gl", "gl@X=2", "--cells", alone, "--pictures", "--json"], env)
        details = json.loads(result.stdout)["gated"][0]["details"]
    passes = re.search(r"the same program, the same libraries; compiled passes (\w{8}) and (\w{8}), ", details)
    return [] if passes and passes[1] == passes[2] else ["exit status %d, %s" % (result.returncode, details)]


def check_cost(runner):
    """if pictures differ, the tier that would hold is named, with a command that says so and the mutants it accepts; with a baseline, too"""
    problems = []
    with Files("flow/box flow 32x32 2 environment_px=16 resolution_px=32\n") as files:
        kernels, path = files.path("it's of $HOME"), files.path("baseline.json")
        os.mkdir(kernels)
        variables = runner.kernels_with(kernels, "flow_normals.glsl", "* 2047.0f + 2048.5f", "* 2040.0f + 2048.5f")
        runner.run(["baseline", "--device", "gl", "--pictures", "--cells", files.cells, "-o", path])
        for args, env in ((["gl", "gl@RG_KERNEL_DIR=" + kernels], {}), (["--baseline", path], variables)):
            result = runner.run(["gate", *args, "--pictures", "--cells", files.cells, "--json"], env)
            case = json.loads(result.stdout)["gated"][0]
            tier = re.fullmatch(r"the picture differs: (\d+) values differ; (T\d) would hold", case["message"])
            command = re.search(r"(?m)^which mutants (T\d) would let live: (raingauge diff .*)$", case["details"])
            if result.returncode != 1 or not tier or not command or tier[2] != command[1]:
                problems.append("%s: exit status %d, %s\n%s" % (args, result.returncode, case["message"], case["details"]))
                continue
            env = runner.variables({"PATH": os.path.dirname(runner.raingauge) + ":" + os.environ["PATH"], **env})
            mutants = "" if "--baseline" in args else "; of \\d+ mutants it accepts "
            ran = subprocess.run(["sh", "-c", command[2] if mutants else command[2].replace(" --mutants", "")], env=env, capture_output=True, text=True, timeout=240, check=False)
            if ran.returncode != 1 or ran.stderr or not re.search(r" fail +%s +%s .*\n(  .*\n)*  %s would hold%s" % (
                    tier[2], tier[1], tier[2], mutants), ran.stdout):
                problems.append("%s: exit status %d, %s%s" % (command[2], ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_gtest(runner):
    """googletest's protocol: names are listed, a filter selects some, and each has a result"""
    with Files() as files:
        args = ["gate", "cpu", "cpu", "--cells", files.cells, "--pictures"]
        listed = runner.run(args + ["--gtest_list_tests"])
        ran = runner.run(args + ["--gtest_filter=flow*"])
    problems = []
    if listed.returncode or not re.fullmatch(r"raster_knot\.\n  cpu_\w{16}\nflow_pane\.\n  cpu_\w{16}\n", listed.stdout):
        problems.append("listed: %s" % listed.stdout)
    if ran.returncode or not re.search(r"\[       OK \] flow_pane\.cpu_\w{16} \(", ran.stdout) or "knot" in ran.stdout:
        problems.append("ran: %s" % ran.stdout)
    return problems


def check_required(runner):
    """a device that is missing skips its cells; named by --require, it fails the gate, with an error a cell in every report"""
    problems = []
    with Files(KNOT) as files:
        path, env = files.path("baseline.json"), {"VK_DRIVER_FILES": "/nonexistent"}
        runner.run(["baseline", "--device", "cpu,vulkan", "--pictures", "--cells", files.cells, "-o", path])
        pair, apart = ["gate", "vulkan", "cpu", "--pictures"], ["gate", "--baseline", path, "--pictures"]
        for args, require, missing, status in ((apart + ["--device", "cpu"], None, [], 0), (apart, "cpu,vulkan", ["vulkan"], 1), (apart, "opencl", ["opencl"], 1),
                                               (pair, None, [], 77), (pair, "cpu", [], 77), (pair, "vulkan", ["vulkan"], 1), (pair, "gl,vulkan,cpu", ["gl", "vulkan"], 1),
                                               (["gate", "--against", runner.slower, "--device", "cpu,vulkan", "--pictures"], "vulkan", ["vulkan"], 1)):
            junit, bmf = files.path("junit.xml", "before"), files.path("bmf.json", "before")
            more = ["--require", require] if require else []
            result = runner.run(args + ["--cells", files.cells, "--json", "--junit", junit, "--bmf", bmf] + more, env)
            report = json.loads(result.stdout)
            problems += forms.problems("gate", report)
            cases = xml.etree.ElementTree.parse(junit).getroot().findall(".//testcase")
            names = [(case.get("name"), error.get("message")) for case in cases for error in case.findall("error")]
            lint = subprocess.run(["xmllint", "--noout", "--schema", SCHEMA, junit], capture_output=True, text=True, check=False)
            with open(bmf) as file:
                measured = json.load(file)
            wanted = ["required." + name for name in missing]
            said = all("--require %s: " % name in text and "--require %s: " % name in result.stderr for name, (_, text) in zip(missing, names))
            if result.returncode != status or [name for name, _ in names] != wanted or not said or lint.returncode or measured or (
                    missing and endings(report) != dict.fromkeys(wanted, "error")):
                problems.append("%s --require %s: exit status %d, %s, %s%s%s" % (args, require, result.returncode, names, lint.stderr, result.stdout, result.stderr))
        files.path("junit.xml", "before")
        result = runner.run(["gate", "nonsense", "cpu", "--pictures", "--cells", files.cells, "--junit", files.path("junit.xml")])
        with open(files.path("junit.xml")) as file:
            if result.returncode != 2 or file.read() != "before":
                problems.append("a name that is none: exit status %d, or a report" % result.returncode)
    return problems


def check_missing(runner):
    """a missing device that ran for the baseline fails its cells, with a report, whatever is expected, unless --device leaves it out"""
    problems = []
    with Files(KNOT) as files:
        path, env = files.path("baseline.json"), {"VK_DRIVER_FILES": "/nonexistent"}
        runner.run(["baseline", "--device", "cpu,vulkan", "--pictures", "--cells", files.cells, "-o", path])
        known = files.path("known.txt", "fail *\n  device vulkan\n  outcome fail\n  reason r\n  since 2026-01-01\n  until " + LATER + "\n")
        both = {"raster/knot.cpu": "pass", "raster/knot.vulkan": "differs", "fixed.vulkan": "unsupported"}
        for more, status, wanted in (([], 1, both), (["--require", "cpu"], 1, both), (["--device", "cpu,vulkan"], 1, both), (["--device", "cpu"], 0, {"raster/knot.cpu": "pass"}),
                                     (["--expectations", known], 1, both)):
            result = runner.run(["gate", "--baseline", path, "--pictures", "--cells", files.cells, "--json"] + more, env)
            report = json.loads(result.stdout)
            said = [case["message"] for case in report["gated"] if "it ran when the baseline was made: " in case["message"]]
            if result.returncode != status or endings(report) != wanted or len(said) != ("raster/knot.vulkan" in wanted):
                problems.append("%s: exit status %d, %s%s" % (more, result.returncode, endings(report), result.stderr))
    return problems


def check_no_rain(runner):
    """a cell whose picture is the same without rain compares nothing, with a device and with a baseline"""
    problems = []
    with Files("dry shower 64x36 1 geometry=off opacity=0\n") as files:
        for args in (["cpu", "cpu"], ["cpu", "gl"]):
            result = runner.run(["gate", *args, "--pictures", "--cells", files.cells, "--json"])
            case = json.loads(result.stdout)["gated"][0]
            if result.returncode != 4 or case["ending"] != "nothing measured" or "no rain at frame 1, nor at 60 and 240" not in case["message"]:
                problems.append("%s: exit status %d, %s" % (args, result.returncode, case))
    return problems


def check_beside(runner):
    """another build in the current folder is found by its file name alone"""
    with Files(KNOT) as files:
        os.symlink(runner.slower, files.path("rg"))
        result = subprocess.run([runner.raingauge, "gate", "--against", "rg", "--device", "cpu", "--pictures", "--cells", files.cells],
                                cwd=files.folder.name, env=runner.variables({}), capture_output=True, text=True, timeout=120, check=False)
    return [] if result.returncode == 0 and not result.stderr else ["exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]


def check_unwritten(runner):
    """a report that cannot be written ends the gate like unprinted output, so that no bisect takes a full disk for a regression"""
    problems = []
    with Files(KNOT) as files:
        junit = files.path("junit.xml", "before")
        for more, name, status in ((["--pictures", "--junit", junit], "junit.xml", 71),
                                   ([*AT_ONCE, "-o", files.path("out")], "launches.csv", 71)):
            result = runner.run(["gate", "cpu", "cpu", "--cells", files.cells] + more, limit=100)
            if result.returncode != status or name + ": cannot be written: " not in result.stderr or "raster/knot.cpu" not in result.stdout:
                problems.append("%s: exit status %d, %s%s" % (more, result.returncode, result.stdout, result.stderr))
        with open(junit) as file:
            if file.read() != "before":
                problems.append("what was in junit.xml is lost")
    return problems


def check_apart(runner):
    """two reports, GitHub's summary included, need a file each, by whatever name; nor may the summary be a file that the gate reads"""
    problems = []
    with Files(KNOT) as files:
        a, other = files.path("a"), os.path.join(files.folder.name, "..", os.path.basename(files.folder.name), "a")
        link, cells = files.path("link"), os.path.join(files.folder.name, ".", "cells.txt")
        os.symlink(files.folder.name, link)
        os.mkdir(files.path("apart"))
        rows = [(["--junit", one, "--bmf", two], None) for one in (a, other) for two in (a, other, os.path.join(link, "a"))]
        rows += [([option, a, "--github"], other) for option in ("--junit", "--bmf")] + [(["--github"], cells)]
        rows += [(["--github", "-o", files.folder.name], files.path("launches.csv"))]
        rows += [([option, files.path(name), "-o", files.folder.name], None) for option in ("--junit", "--bmf") for name in ("launches.csv", "gate.journal")]
        for more, summary in rows:
            result = runner.run(["gate", "cpu", "cpu", "--pictures", "--cells", files.cells] + more, {"GITHUB_STEP_SUMMARY": summary})
            if result.returncode != 2 or result.stderr.count("\n") != 1 or "would be overwritten with a report" not in result.stderr or os.path.exists(a):
                problems.append("%s, %s: exit status %d, %s%s" % (more, summary, result.returncode, result.stdout, result.stderr))
        result = runner.run(["gate", "cpu", "cpu", "--pictures", "--cells", files.cells, "--junit", a, "--bmf", files.path("apart/a")],
                            {"GITHUB_STEP_SUMMARY": cells})
        if result.returncode or result.stderr or not os.path.getsize(a):
            problems.append("apart: exit status %d, %s" % (result.returncode, result.stderr))
    return problems


def check_refused(runner):
    """bad input is refused in one line, before anything is measured"""
    problems = []
    with Files() as files:
        bad = files.path("bad.txt", "flow/pane flow 64x48 2 no_such_key=1\n")
        for args, says in ((["cpu"], "name two devices"), (["--against", "none"], "--against 'none'"),
                           (["--against", runner.slower, "--device", "cpu,cpu"], "--device: 'cpu' stands there twice; name it once"),
                           (["--against", "/bin/true", "--device", "cpu"], "RG_PROGRAM=/bin/true is no raingauge"),
                           (["cpu", "cpu", "--against", runner.slower], "--against has pairs of its own; name devices by --device"),
                           (["cpu", "cpu", "--device", "cpu"], "--device"), (["cpu", "none"], "none"), (["cpu", "cpu", "--cells", bad], "bad.txt:1: "),
                           (["cpu@=x", "cpu"], "'=x' does not set a variable; write it as KEY=value"),
                           (["cpu", "cpu", "--gtest_repeat", "2"], "--gtest_repeat 2: must be 1\n"),
                           (["cpu", "cpu", "--budget", "soon"], "--budget 'soon': is no time"),
                           (["cpu", "cpu", "--margin", "0"], "--margin"),
                           (["cpu", "cpu", "--expectations", files.path("none.txt")], "none.txt"),
                           (["cpu", "cpu", "--junit", files.path("none/junit.xml")], "none/junit.xml")):
            result = runner.run(["gate"] + args)
            if result.returncode != 2 or result.stdout or result.stderr.count("\n") != 1 or says not in result.stderr:
                problems.append("%s: exit status %d, %s%s" % (args, result.returncode, result.stdout, result.stderr))
    return problems


def check_room(runner):
    """pictures that do not fit into the remaining memory are not compared, but the other cells are"""
    with Files("large raster 1024x1024 1 billboards=10\nsmall raster 64x48 2 scene=triangles triangles=1000\n") as files:
        result = runner.run(["gate", "cpu", "cpu", "--pictures", "--memory", "95M", "--json", "--cells", files.cells])
    report = json.loads(result.stdout)
    said = [case["message"] for case in report["gated"] if case["name"] == "large.cpu"]
    if result.returncode != 1 or endings(report) != {"large.cpu": "error", "small.cpu": "pass"} or "a comparison of 1024x1024 pixels needs" not in said[0]:
        return ["exit status %d, %s, %s, %s" % (result.returncode, endings(report), said, result.stderr)]
    return []


CHECKS = [check_same, check_slower, check_quarantined, check_expired, check_without_ids, check_builds, check_fallen, check_budget, check_open, check_shared, check_crash, check_unused, check_sides, check_ours, check_falling, check_ways, check_miscompiled, check_cached, check_cost, check_gtest, check_required, check_missing, check_no_rain, check_beside,
          check_unwritten, check_apart, check_refused, check_room]
