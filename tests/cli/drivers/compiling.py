"""A driver that cannot compile or run one kernel: the kernel is named, and the failure shrunk to a case that replays it."""
import json
import os
import re
import tempfile

from misbehaving import side_by_side

KERNEL = "flow_normals"
SMALL = "--set environment_px=16 --set resolution_px=16 --set model= --size 16x16".split()
# How the driver fails: while a kernel is compiled, while it runs, or while raingauge waits for it; and the expected
# message.
WAYS = {"compile:abort": r"crashed \(Aborted\) while compiling kernel 'KERNEL'", "compile:exit": "ended the process with status 0 while compiling kernel 'KERNEL'",
        "compile:error": "kernel 'KERNEL': .* failed", "run:fault": r"crashed \(Segmentation fault\) while .*'KERNEL'",
        "run:abort": r"crashed \(Aborted\) while .*'KERNEL'", "wait:abort": r"crashed \(Aborted\) while .*; not known to have ended: .*'KERNEL'",
        "wait:hang": "did not come back within 8 s while .*; not known to have ended: .*'KERNEL'"}
CASES = [("vulkan", "compile:abort"), ("vulkan", "compile:error"), ("vulkan", "run:fault"), ("vulkan", "wait:abort"),
         ("gl", "compile:exit"), ("gl", "run:abort"), ("gl", "wait:hang"),
         ("opencl", "compile:error"), ("opencl", "run:fault"), ("opencl", "wait:abort")]
SHRUNK = [("vulkan", "compile:error", "error"), ("gl", "run:abort", "crash"), ("opencl", "wait:abort", "crash")]


def failing(runner, folder, api, way, kernel=KERNEL):
    """The device of an API whose driver fails at a kernel."""
    library = os.path.join(os.path.dirname(runner.misbehaver), "libcompiling_driver.so")
    code = os.path.join(runner.kernels, kernel + {"vulkan": ".spv", "gl": ".glsl", "opencl": ".cl"}[api])
    loaded = "LD_PRELOAD=" + library
    if api == "vulkan":
        path = os.path.join(folder, "failing.json")
        with open(path, "w") as file:
            json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": library, "api_version": "1.1.0"}}, file)
        loaded = "VK_DRIVER_FILES=" + path
    return "%s@%s;RG_KERNEL=%s;RG_FAILS=%s" % (api, loaded, code, way)


def problems_named(runner, case):
    """Problems of how render ends."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        args = ["render", "flow", "--frame", "1", "--device", failing(runner, folder, *case), "-o", path]
        args += ["--timeout", "8" if "hang" in case[1] else "100"]  # the others get more time, since a busy machine may be slow
        result = runner.run(args + SMALL)
        lines = result.stderr.splitlines()
        says = WAYS[case[1]].replace("KERNEL", KERNEL)
        well = result.returncode == 1 and len(lines) == 1 and re.search(says, lines[0]) and not os.path.exists(path)
    return [] if well else ["%s: exit status %d, %s" % (case, result.returncode, lines)]


def check_named(runner):
    """the line names the kernel at which a driver fails, when it is compiled, run, or waited for"""
    return side_by_side(lambda case: problems_named(runner, case), CASES)


def problems_shrunk(runner, case, seconds=3):
    """Problems of the case that shrink makes of a failure within this many seconds; with many seconds it must be the least case."""
    api, way, kind = case
    with tempfile.TemporaryDirectory() as folder:
        device, path = failing(runner, folder, api, way), os.path.join(folder, "case.txt")
        args = ["shrink", "flow", "--frame", "2", "--seconds", str(seconds), "--device", device + ",cpu:reference", "-o", path]
        result = runner.run(args + SMALL + "--set drops=40 --size 32x32".split())
        if result.returncode != 0 or result.stderr or KERNEL + " alone, " not in result.stdout:
            return ["%s: exit status %d, %s%s" % (case, result.returncode, result.stdout, result.stderr)]
        with open(path, encoding="utf-8") as file:
            text = file.read()
        lines = dict(line.split(" ", 1) for line in text.splitlines() if not line.startswith(("#", "set ")))
        told = (lines["class"], lines["stage"], lines["frames"], "found" in lines)
        is_least = seconds < 60 or lines["size"] == "16x16" and "set drops" not in text and "set view=pane" in text
        problems = [] if told == (kind, KERNEL, "1", False) and KERNEL in lines["fails"] and is_least else [text]
        for other, status, says in ((device, 1, r"other: %s@.*: %s .*'%s'.*, as was found\n" % (api, kind, KERNEL)),
                                    ("cpu", 0, "same: cpu leaves ")):
            again = runner.run(["render", "--case", path, "--device", other])
            if again.returncode != status or len(again.stderr.splitlines()) != status or not re.match(says, again.stdout):
                problems.append("%s: exit status %d, %s%s" % (other, again.returncode, again.stdout, again.stderr))
    return ["%s: %s" % (case, problem) for problem in problems]


def check_shrunk(runner):
    """a driver's failure is shrunk to a case, which fails there again and passes elsewhere, and to one run of the kernel"""
    return side_by_side(lambda case: problems_shrunk(runner, case), SHRUNK)


def check_least(runner):
    """with enough time, a failure is shrunk to the least settings, frames and pixels"""
    return side_by_side(lambda case: problems_shrunk(runner, case, 600), SHRUNK)


def check_other(runner):
    """a truth that fails is no difference, and neither is an absent driver"""
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        device, path = failing(runner, folder, "opencl", "compile:abort"), os.path.join(folder, "case.txt")
        for pair, status in (("cpu," + device, 1), ("cpu,cpu:reference", 1)):
            result = runner.run(["shrink", "flow", "--frame", "1", "--device", pair, "-o", path] + SMALL)
            if result.returncode != status or len(result.stderr.splitlines()) != 1 or os.path.exists(path):
                problems.append("%s: exit status %d, %s" % (pair, result.returncode, result.stderr))
    return problems


def check_compiled(runner):
    """doctor lists the kernels that a driver cannot compile or run, each by itself, and goes on with the others"""
    kernels, problems = ["flow_copy", KERNEL, "flow_level"], []
    with tempfile.TemporaryDirectory() as folder:
        devices = [failing(runner, folder, *case) for case in (("vulkan", "compile:abort"), ("gl", "run:fault"), ("opencl", "wait:abort"))]
        args = ["doctor", "--kernels", ",".join(kernels), "--device"]
        result = runner.run(args + [",".join(devices + ["cpu"])])
        told = re.findall(r"(?m)^(\w+)\S*: (\d) kernels compile, an item of (\d) of them was run, and (\d) fail\n((?:  .*\n)*)", result.stdout)
        line = "  %s: crash\n" % KERNEL
        wanted = [("vulkan", "2", "2", "1", line), ("gl", "3", "2", "1", line), ("opencl", "3", "2", "1", line), ("cpu", "3", "3", "0", "")]
        if result.returncode != 1 or told != wanted or len(re.findall(r"(?m)^raingauge: .*crashed.*'%s'$" % KERNEL, result.stderr)) != 3:
            problems.append("exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
        report = json.loads(runner.run(args + [devices[0], "--json"]).stdout)
        if [(row["compiled"], row["ran"], [(one["kernel"], one["status"]) for one in row["failed"]]) for row in report] != [(2, 2, [(KERNEL, "crash")])]:
            problems.append("%s" % report)
        for which, device, status in (("flow_copy", "cpu", 0), ("flow_copy,nonsense", "cpu", 2), ("", "cpu", 2), ("flow_copy", "nonsense", 2)):
            result = runner.run(["doctor", "--kernels", which, "--device", device])
            if result.returncode != status or len(result.stderr.splitlines()) != (status > 0):
                problems.append("%s on %s: exit status %d, %s" % (which, device, result.returncode, result.stderr))
    return problems


THOROUGH = [check_least]
CHECKS = [check_named, check_shrunk, check_other, check_compiled]
