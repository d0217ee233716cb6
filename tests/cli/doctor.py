"""`raingauge doctor`: its report on this machine and on broken ones."""
import json
import os
import re
import subprocess
import sys
import tempfile

import forms
import misbehaving
from runner import NO_DRIVERS


def examine(runner, args, env={}):
    """A doctor's report as JSON, its exit status and its messages, with the schema's objections."""
    result = runner.run(["doctor", "--json"] + args, env)
    report = json.loads(result.stdout)
    return report, result.returncode, result.stderr + "".join(line + "\n" for line in forms.problems("doctor", report))


def by_name(report):
    return {device["name"]: device for device in report["devices"]}


def check_devices(runner):
    """Every device that `list` names is examined, draws into three formats, and is well."""
    listed = json.loads(runner.run(["list", "devices", "--json"]).stdout)["devices"]
    report, status, errors = examine(runner, [])
    problems = []
    if report["format"] != 1 or status != 0 or errors:
        problems.append("format %s, exit status %d, stderr: %s" % (report["format"], status, errors))
    if [d["name"] for d in listed] != [d["name"] for d in report["devices"]]:
        problems.append("list and doctor name different devices")
    if [d["name"] for d in report["passport"]["devices"]] != [d["name"] for d in listed]:
        problems.append("the passport names other devices")
    for device in report["devices"]:
        if device["status"] != "ok" or any(o["different"] for o in device["operations"]):
            problems.append("%s: %s %s" % (device["name"], device["status"], device["why"]))
        if len(device["operations"]) < 40 or len(device["builtins"]) < 10 or device["timer"]["wall_ms"] <= 0:
            problems.append("%s: not examined in full" % device["name"])
        drawn = device["drawing"]
        if [(f["name"], f["different"]) for f in drawn["formats"]] != [("RGBA8", 0), ("RGBA16F", 0), ("RGBA32F", 0)]:
            problems.append("%s: %s" % (device["name"], drawn))
    return problems


def check_passport(runner):
    """The passport says where numbers come from, and has nothing that changes by itself."""
    variables = {"GOMP_SPINCOUNT": None, "LP_NUM_THREADS": "3", "RG_KERNEL_DIR": "/nonexistent"}
    passport, again = (examine(runner, ["--device", "cpu"], variables)[0]["passport"] for _ in range(2))
    problems = [] if passport == again else ["two passports of one machine differ"]
    # raingauge sets GOMP_SPINCOUNT unless the user has.
    if passport["environment"] != dict(variables, GOMP_SPINCOUNT="8000"):
        problems.append("environment: %s" % passport["environment"])
    driver, compiler = passport["devices"][0]["driver"], passport["raingauge"]["compiler"]
    if not driver.startswith(compiler):
        problems.append("driver of cpu: %s, and the compiler is %s" % (driver, compiler))
    if passport["raingauge"]["kernel_dir"] != "/nonexistent":
        problems.append("kernel_dir: %s" % passport["raingauge"]["kernel_dir"])
    if not re.match(r"[0-9a-f]{40}(-dirty)?$|unknown$", passport["raingauge"]["commit"]):
        problems.append("commit: %s" % passport["raingauge"]["commit"])
    if passport["machine"]["cores_allowed"] != len(os.sched_getaffinity(0)):
        problems.append("cores_allowed: %d" % passport["machine"]["cores_allowed"])
    return problems


def check_prologue(runner):
    """--prologue says nothing of a machine that is well, and in one line with status 75 why one that is busy, or whose driver fails, takes no cells"""
    problems = []
    spin = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count() or 1)]
    try:
        busy = runner.run(["doctor", "--prologue", "--device", "cpu"], {"RG_PROBE_S": "0.3"})
    finally:
        for process in spin:
            process.kill()
            process.wait()
    says = r"raingauge: this machine takes no cells now: others take \d+ % of its processors; end them, or measure elsewhere\n"
    if busy.returncode != 75 or busy.stdout or not re.fullmatch(says, busy.stderr):
        problems.append("busy: %s" % busy)
    well = runner.run(["doctor", "--prologue", "--device", "cpu,cpu:reference"], {"RG_PROBE_S": "0"})
    if well.returncode or well.stdout or well.stderr:
        problems.append("well: %s" % well)
    with tempfile.TemporaryDirectory() as folder:
        fails = runner.run(["doctor", "--prologue", "--device", "vulkan"], {"RG_PROBE_S": "0", **runner.crashing_vulkan(folder)})
    if fails.returncode != 75 or fails.stdout or fails.stderr.count("\n") != 1:
        problems.append("fails: %s" % fails)
    absent = runner.run(["doctor", "--prologue", "--device", "vulkan"], {"RG_PROBE_S": "0", **NO_DRIVERS})
    if absent.returncode != 77 or absent.stdout or absent.stderr.count("\n") != 1:
        problems.append("absent: %s" % absent)
    return problems


def check_missing(runner):
    """If drivers are absent, the report names the package that has them, or the variable that hides them."""
    hidden = {name: value for name, value in NO_DRIVERS.items() if name != "VK_DRIVER_FILES"}
    result = runner.run(["doctor"], dict(hidden, XDG_DATA_DIRS="/nonexistent"))
    text = " ".join(result.stdout.split())
    problems = [mend + " is not named" for mend in ["the Debian package mesa-vulkan-drivers"] + [
        "%s=%s names no driver" % variable for variable in hidden.items()] if mend not in text]
    problems += ["%d columns: %s" % (len(line), line) for line in result.stdout.splitlines() if len(line) > 100]
    if result.returncode != 0 or result.stderr:
        problems.append("exit status %d, stderr: %s" % (result.returncode, result.stderr))
    return problems


def check_warnings(runner):
    """Differing thread variables, and a kernel folder, cause warnings."""
    report = examine(runner, ["--device", "cpu"], {"LP_NUM_THREADS": "1", "POCL_MAX_PTHREAD_COUNT": "2", "OMP_NUM_THREADS": "2",
                                                   "RG_KERNEL_DIR": "/nonexistent"})[0]
    warnings = "\n".join(report["warnings"])
    problems = []
    for expected in (r"different numbers of threads: cpu on 2 \(OMP_NUM_THREADS\), gl and vulkan on 1 \(LP_NUM_THREADS\), "
                     r"opencl on 2 \(POCL_MAX_PTHREAD_COUNT\)", r"RG_KERNEL_DIR=/nonexistent: .*cannot be read"):
        if not re.search(expected, warnings):
            problems.append("no warning matches %s in:\n%s" % (expected, warnings))
    return problems


def check_crash(runner):
    """A driver that crashes is named, and harms no other device."""
    with tempfile.TemporaryDirectory() as tmp:
        report, status, errors = examine(runner, ["--device", "cpu,vulkan"], runner.crashing_vulkan(tmp))
    devices = by_name(report)
    problems = []
    if devices["cpu"]["status"] != "ok":
        problems.append("cpu: " + devices["cpu"]["status"])
    if devices["vulkan"]["status"] != "crash" or "its driver crashed (Aborted) while loading drivers of 'VK_DRIVER_FILES=" not in devices["vulkan"]["why"]:
        problems.append("vulkan: %s, %s" % (devices["vulkan"]["status"], devices["vulkan"]["why"]))
    if not any(line.startswith("vulkan: its driver crashed (Aborted)") for line in report["missing"]):
        problems.append("missing: %s" % report["missing"])
    if status != 1 or len(errors.splitlines()) != 1:
        problems.append("exit status %d, stderr: %s" % (status, errors))
    return problems


def check_wrong_arithmetic(runner):
    """One wrong operation on one device is found and named, and the exit status is 1."""
    right, wrong = "floatBitsToUint(a *b)", "(floatBitsToUint(a *b) ^ 1u)"
    with tempfile.TemporaryDirectory() as tmp:
        kernels = runner.kernels_with(tmp, "probe_ops.glsl", right, wrong)
        report, status, errors = examine(runner, ["--device", "gl"], kernels)
        text = runner.run(["doctor", "--device", "gl"], kernels).stdout
    device = by_name(report)["gl"]
    if device["status"] == "unsupported":
        return []
    different = [o for o in device["operations"] if o["different"]]
    problems = []
    if [(o["name"], o["different"], o["largest_ulps"]) for o in different] != [("multiply", 65536, 1)]:
        problems.append("different: %s" % different)
    if device["status"] != "fail" or status != 1 or "'gl': 1 of" not in errors:
        problems.append("%s, exit status %d, stderr: %s" % (device["status"], status, errors))
    if not re.search(r"FAIL multiply: 65536 of 65536 results differ from C, the largest by 1 ulp", text):
        problems.append("the text does not say so:\n" + text)
    return problems


def check_drawing(runner):
    """A device of any API that makes no pipeline, or draws another picture, is found."""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        for device, function, how, status, says in (
                ("vulkan", "vkCreateGraphicsPipelines", "lost", "error", "vkCreateGraphicsPipelines"),
                ("vulkan", "vkCreateGraphicsPipelines", "none", "fail", "pixels drawn into RGBA8, with depth and blending"),
                ("gl", "glBlendFunc", "none", "fail", "pixels drawn into RGBA8")):
            env = misbehaving.shim(runner, tmp, device, function, how, 0)
            problems += problems_drawn(runner, device, env, status, says)
        wrong = runner.kernels_with(tmp, "raster_quads.cl", "make(r.colour, r.depth)", "make(r.colour, r.depth * 0.5f)")
        problems += problems_drawn(runner, "opencl", wrong, "fail", "pixels drawn into RGBA8")
    return problems


def problems_drawn(runner, device, env, wanted, says):
    report, status, errors = examine(runner, ["--device", device], env)
    found = by_name(report)[device]
    well = status == 1 and found["status"] == wanted and says in found["why"] and "'%s'" % device in errors and "operations" in found
    return [] if well else ["%s: %s: %s, exit status %d, %s" % (env, found["status"], found["why"], status, errors)]


def check_own_rounding(runner):
    """gl and vulkan run the programs that round quotients themselves on request, and no others"""
    problems = []
    own = {"RG_ROUNDING": "own"}
    with tempfile.TemporaryDirectory() as tmp:
        kernels = runner.kernels_with(tmp, "probe_ops.glsl", "(quotient & 0x7fffffu)", "(quotient & 0x7fff0fu)")
        os.remove(os.path.join(tmp, "probe_ops.rounded.spv"))
        of_drivers, status, errors = examine(runner, ["--device", "gl,vulkan"], kernels)
        if status not in (0, 77):
            problems.append("the drivers' own rounding: exit status %d, stderr: %s" % (status, errors))
        report, status, errors = examine(runner, ["--device", "gl,vulkan"], {**kernels, **own})
    devices, as_drivers = by_name(report), by_name(of_drivers)
    if as_drivers["gl"]["status"] == "unsupported" or as_drivers["vulkan"]["status"] == "unsupported":
        return problems
    wrong = {o["name"] for o in devices["gl"].get("operations", []) if o["different"]}
    if "divide" not in wrong or "sqrt" in wrong:
        problems.append("gl: wrong are %s" % sorted(wrong))
    if "probe_ops.rounded.spv" not in errors + json.dumps(devices["vulkan"]):
        problems.append("vulkan: %s, stderr: %s" % (devices["vulkan"]["status"], errors))
    for name in ("gl", "vulkan"):
        if ", own rounding" in as_drivers[name]["api"] or ", own rounding" not in devices[name].get("api", ", own rounding"):
            problems.append("%s is called %s, and %s with its own rounding" % (name, as_drivers[name]["api"], devices[name].get("api")))
    return problems


def check_own_blending(runner):
    """programs of gl and vulkan blend on request, draw what the driver draws, and doctor names the variable"""
    problems = []
    report, status, errors = examine(runner, ["--device", "gl,vulkan"], {"RG_BLENDING": "program"})
    for name, device in by_name(report).items():
        if device["status"] == "unsupported":
            continue
        if ", own blending" not in device["api"] or device["status"] != "ok":
            problems.append("%s: %s, %s" % (name, device["api"], device["status"]))
    if status not in (0, 77) or not any("RG_BLENDING=program" in warning for warning in report["warnings"]):
        problems.append("exit status %d, warnings %s, stderr: %s" % (status, report["warnings"], errors))
    return problems


def check_full(runner):
    """a report that does not fit on standard output is an error of its own, also for a device that is not supported"""
    with open("/dev/full", "w") as full:
        result = runner.run("doctor --device vulkan".split(), NO_DRIVERS, stdout=full)
    if result.returncode != 71 or not re.fullmatch(r"raingauge: .*no Vulkan driver.*\nraingauge: standard output: .*\n", result.stderr):
        return ["exit status %d, stderr: %s" % (result.returncode, result.stderr)]
    return []


CHECKS = [check_devices, check_passport, check_prologue, check_missing, check_warnings, check_crash, check_wrong_arithmetic, check_drawing, check_own_rounding, check_own_blending, check_full]
