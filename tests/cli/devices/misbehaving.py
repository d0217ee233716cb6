"""Drivers that misbehave: a command keeps the results of every other device, says in one line what happened to one, and ends."""
import concurrent.futures
import json
import os
import re
import subprocess
import tempfile

import forms
from runner import NO_DRIVERS

SMALL = "--set environment_px=64 --set resolution_px=96 --size 96x96 "
# The command lines, for all devices.
COMMANDS = {
    "doctor": "doctor --json",
    "diff": "diff raster --frame 1 --json --size 96x96",
    "table": "table raster-1 --rows 1-1 --quick --json",
    "verify": "verify raster --quick --json --size 96x96",
    "sweep": "sweep raster --axis billboards=20000 --quick --json --size 32x32 --device all",
}
OTHERS = {"cpu", "cpu:reference", "gl", "vulkan", "opencl"}
HOW = {
    "abort": ("crash", r"its driver crashed \(Aborted\)"),
    "fault": ("crash", r"its driver crashed \(Segmentation fault\)"),
    "exit": ("crash", r"its driver ended the process with status 0"),
    "hang": ("timeout", r"its driver did not come back within 10 s"),
    # From 1 GiB up to 1 GiB above the user's limit: the other workers use the rest.
    "swell": ("crash", r"it took more than (102[4-9]|10[3-9]\d|1[1-9]\d\d|20[0-3]\d|204[0-8]) MiB of memory and was ended"),
    "lost": ("error", r"DEVICE_LOST|CONTEXT_LOST|OUT_OF_RESOURCES"),
    "none": ("error", r"its driver tells of 0, 0 and 0 work groups"),
}
# Without the APIs that a statement about Vulkan does not need, and what is said of them.
NEITHER = {name: path for name, path in NO_DRIVERS.items() if name != "VK_DRIVER_FILES"}
UNSUPPORTED = r"(?m)^raingauge: warning: unsupported here: (gl|opencl): .*\n"
# The same when no other worker uses memory.
ALONE = dict(HOW, swell=("crash", r"it took more than 2048 MiB of memory and was ended"))


def shim(runner, folder, device, function, how, calls):
    """Variables with which a function of a device's driver misbehaves after this many calls."""
    env = {"RG_MISBEHAVE": "%s:%s:%d" % (function, how, calls)}
    if device != "vulkan":
        return dict(env, LD_PRELOAD=runner.misbehaver)
    path = os.path.join(folder, "misbehaving.json")
    with open(path, "w") as file:
        json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": runner.misbehaver, "api_version": "1.1.0"}}, file)
    return dict(env, VK_DRIVER_FILES=path)


def found_well(command, report):
    """The devices for which the command has a result, from its JSON."""
    if command == "doctor":
        return {device["name"] for device in report["devices"] if device["status"] == "ok"}
    if command == "diff":
        return {name for pair in report["pairs"] if pair["tier"] == "T0" for name in (pair["a"], pair["b"])}
    if command in ("table", "sweep"):
        return {cell["device"] for cell in report["cells"] if cell["status"] == "ok"}
    good = {check["device"] for check in report["checks"] if check["status"] == "ok" and check["check"] == "image"}
    return good | {"cpu:reference"}


# Device, function, kind of fault, number of good calls before it: each kind on each API, while opening or running.
CASES = [
    ("vulkan", "vkEnumeratePhysicalDevices", "abort", 0),
    ("vulkan", "vkGetPhysicalDeviceProperties2", "none", 0),
    ("vulkan", "vkCreateDevice", "fault", 0),
    ("vulkan", "vkCreateComputePipelines", "hang", 1),
    ("vulkan", "vkQueueSubmit", "exit", 0),
    ("vulkan", "vkQueueSubmit", "swell", 0),
    ("vulkan", "vkQueueSubmit", "lost", 0),
    ("gl", "eglInitialize", "exit", 0),
    ("gl", "glLinkProgram", "abort", 2),
    ("gl", "glLinkProgram", "swell", 2),
    ("gl", "glDispatchCompute", "fault", 3),
    ("gl", "glDispatchCompute", "hang", 3),
    ("gl", "glGetError", "lost", 4),
    ("opencl", "clGetDeviceIDs", "fault", 0),
    ("opencl", "clBuildProgram", "abort", 0),
    ("opencl", "clBuildProgram", "swell", 0),
    ("opencl", "clEnqueueNDRangeKernel", "exit", 2),
    ("opencl", "clEnqueueNDRangeKernel", "hang", 2),
    ("opencl", "clEnqueueNDRangeKernel", "lost", 2),
]
# Faults while devices are listed, when no device can be lost yet.
LISTING = [
    ("vulkan", "vkEnumeratePhysicalDevices", "abort", 0),
    ("vulkan", "vkEnumeratePhysicalDevices", "hang", 0),
    ("gl", "eglInitialize", "exit", 0),
    ("gl", "eglInitialize", "swell", 0),
    ("opencl", "clGetDeviceIDs", "fault", 0),
]


def bounds(how):
    """Options. Only a hang has a short timeout, since a busy machine may delay the others."""
    return ["--memory", "1GiB", "--timeout", "10" if how == "hang" else "100"]


def compile_once(runner, command):
    """Has drivers compile and keep what a command runs: else several would at the same time, and for longer than a hang may take."""
    runner.run(command.split())


def one_of_each_way(turn):
    """A case of each way, each on another API, beginning with another API each turn."""
    apis = ("vulkan", "gl", "opencl")
    return [case for way, how in enumerate(HOW) for case in CASES if case[2] == how and case[0] == apis[(turn + way) % 3]]


def side_by_side(check, *lists):
    """The problems of all checks, in order. Most hanging cases wait, so several run at once."""
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        return [problem for problems in pool.map(check, *lists) for problem in problems]


def outcomes_of(command, report, device):
    """The outcomes that the command's JSON reports of a device."""
    rows, name = {"doctor": ("devices", "name"), "table": ("cells", "device"), "sweep": ("cells", "device"), "verify": ("checks", "device"),
                  "diff": ("failures", "device")}[command]
    return {row["status"] for row in report[rows] if row[name] == device}


def outcomes_wanted(command, case):
    """The outcomes that it must report. doctor has a row for each listed device, tables have cells of those that opened, and the
    other commands report each requested API."""
    without = {function for _, function, _, _ in LISTING} if command in ("doctor", "table", "sweep") else set()
    if command in ("table", "sweep"):
        without |= {"vkGetPhysicalDeviceProperties2", "vkCreateDevice"}
    return set() if case[1] in without else {HOW[case[2]][0]}


def problems_of(runner, command, case):
    """Problems of a command that ends while a device misbehaves."""
    device, function, how, calls = case
    with tempfile.TemporaryDirectory() as folder:
        env = dict(shim(runner, folder, *case), XDG_STATE_HOME=folder)
        result = runner.run(COMMANDS[command].split() + bounds(how), env)
    about = "%s, %s:%s:%d: " % (command, function, how, calls)
    try:
        report = json.loads(result.stdout)
    except ValueError:
        return [about + "exit status %d, no JSON: %s %s" % (result.returncode, result.stdout[:200], result.stderr)]
    problems = forms.problems("table" if command == "sweep" else command, report)
    if result.returncode != 1:
        problems.append("exit status %d" % result.returncode)
    kept = found_well(command, report) & OTHERS
    if kept != OTHERS - {device}:
        problems.append("results of %s" % sorted(kept))
    if outcomes_of(command, report, device) != outcomes_wanted(command, case):
        problems.append("outcomes: %s" % outcomes_of(command, report, device))
    lines = result.stderr.splitlines()
    if not lines or len(set(lines)) != len(lines) or len(lines) > 4:
        problems.append("%d lines" % len(lines))
    if not any(re.search(device + ".*" + HOW[how][1], line) for line in lines):
        problems.append("it is not said how")
    if any(device not in line for line in lines):
        problems.append("a line names another device")
    return [about + problem for problem in problems] + ([about + result.stderr] if problems else [])


def check_comparisons(runner):
    """diff keeps the pairs of every other device, in whatever way a device of any API misbehaves"""
    compile_once(runner, COMMANDS["diff"])
    return side_by_side(lambda case: problems_of(runner, "diff", case), CASES)


SLOW = ("doctor", "table", "verify")


def check_commands(runner):
    """doctor, table and verify do the same, in one way each, and sweep in all"""
    asked = list(zip(SLOW, [("gl", "glDispatchCompute", "fault", 3), ("vulkan", "vkQueueSubmit", "exit", 0), ("opencl", "clEnqueueNDRangeKernel", "lost", 2)]))
    asked += [("sweep", case) for case in one_of_each_way(0)]
    compile_once(runner, COMMANDS["sweep"])
    return side_by_side(lambda pair: problems_of(runner, *pair), asked)


def check_all_ways(runner):
    """doctor, table and verify keep the results of every other device, in whatever way a device of any API misbehaves"""
    asked = [(command, case) for command in SLOW for case in CASES]
    return side_by_side(lambda pair: problems_of(runner, *pair), asked)


def problems_alone(runner, case):
    """Problems of render on the one device that misbehaves."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        args = ("render flow --frame 2 --device %s -o %s %s" % (case[0], path, SMALL)).split()
        result = runner.run(args + bounds(case[2]), shim(runner, folder, *case))
        lines = result.stderr.splitlines()
        if result.returncode != 1 or len(lines) != 1 or not re.search(ALONE[case[2]][1], result.stderr) or os.path.exists(path):
            return ["%s: exit status %d, %s" % (case, result.returncode, lines)]
    return []


def check_alone(runner):
    """render on a device that crashes fails, with one line, and writes nothing"""
    compile_once(runner, "diff flow --frame 2 --device gl,vulkan,opencl " + SMALL)
    return side_by_side(lambda case: problems_alone(runner, case), one_of_each_way(1))


def problems_listed(runner, case):
    """Problems of a list of devices while a backend misbehaves."""
    with tempfile.TemporaryDirectory() as folder:
        result = runner.run(["list", "devices", "--json"] + bounds(case[2]), shim(runner, folder, *case))
    names = {device["name"] for device in json.loads(result.stdout)["devices"]}
    lines = result.stderr.splitlines()
    if names != OTHERS - {case[0]} or result.returncode != 1 or len(lines) != 1 or not re.search(ALONE[case[2]][1], lines[0]):
        return ["%s: %s, exit status %d, %s" % (case, sorted(names), result.returncode, lines)]
    return []


def check_listed(runner):
    """list devices names the rest, and says of a backend that crashes that it crashed"""
    return side_by_side(lambda case: problems_listed(runner, case), LISTING)


def check_required(runner):
    """--require fails a command if a device that it names is missing, and otherwise changes nothing"""
    problems = []
    for named, required, status in (("all", "cpu,gl", 0), ("all", "vulkan", 1), ("all", "opencl", 0),
                                    ("cpu,vulkan", "vulkan", 1), ("vulkan,cpu", "cpu", 77), ("cpu,gl", "vulkan", 1),
                                    ("cpu,vulkan", None, 77)):
        args = COMMANDS["diff"].split() + ["--device", named] + (["--require", required] if required else [])
        result = runner.run(args, {"VK_DRIVER_FILES": "/nonexistent"})
        said = re.search("--require vulkan: (it is not among --device|.*no Vulkan driver)", result.stderr)
        if result.returncode != status or bool(said) != (status == 1):
            problems.append("--device %s --require %s: exit status %d, %s" % (named, required, result.returncode, result.stderr))
    return problems


def check_ignored_ends(runner):
    """raingauge reports how a driver ended, even if its parent made it ignore the ends of children"""
    with tempfile.TemporaryDirectory() as folder:
        args = ["sh", "-c", "trap '' CHLD; exec \"$@\"", "sh", runner.raingauge] + COMMANDS["diff"].split()
        env = shim(runner, folder, "vulkan", "vkQueueSubmit", "abort", 0)
        result = subprocess.run(args, env=runner.variables(env), stdin=subprocess.DEVNULL, timeout=300,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    well = re.search("vulkan.*" + HOW["abort"][1], result.stderr) and result.returncode == 1
    return [] if well else ["exit status %d, %s" % (result.returncode, result.stderr)]


def problems_closing(runner, command):
    """Problems of a command whose device crashes when it is closed, after all work is done."""
    with tempfile.TemporaryDirectory() as folder:
        cells, made = (os.path.join(folder, name) for name in ("cells.txt", "made.png"))
        with open(cells, "w") as file:
            file.write("raster/knot raster 64x48 2 scene=triangles triangles=1000\n")
        env = dict(shim(runner, folder, "vulkan", "vkDestroyDevice", "abort", 0), XDG_STATE_HOME=folder)
        result = runner.run(command.format(cells=cells, made=made).split(), env)
        is_made = "{made}" not in command or os.path.exists(made)
    crashed = re.search("vulkan.*" + HOW["abort"][1], result.stderr)
    return [] if result.returncode == 1 and crashed and result.stdout and is_made else [
        "%s: exit status %d, %s%s" % (command, result.returncode, result.stdout, result.stderr)]


def check_closing(runner):
    """a driver that crashes while its device is closed fails a command, but no result is lost"""
    commands = [COMMANDS[name] + " --device cpu,vulkan" for name in ("diff", "table")] + [
        "render raster --frame 1 --size 32x32 --device vulkan --json -o {made}",
        "sweep raster --axis billboards=20000 --quick --json --size 32x32 --device cpu,vulkan",
        "baseline --pictures --cells {cells} --device vulkan -o {made}",
        "gate cpu vulkan --pictures --cells {cells}"]
    return side_by_side(lambda command: problems_closing(runner, command), commands)


def check_gone(runner):
    """a device that is listed but gone when it is opened is an error of its own, and every other is examined and compared"""
    def problems_gone(command):
        with tempfile.TemporaryDirectory() as folder:
            env = shim(runner, folder, "vulkan", "none", "none", 0)
            first = os.path.join(folder, "first.json")
            with open(first, "w") as file:
                json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": "libvulkan_lvp.so", "api_version": "1.1.0"}}, file)
            env.update(NEITHER, VK_DRIVER_FILES=first + ":" + env["VK_DRIVER_FILES"], RG_VANISH=os.path.join(folder, "asked") + ":1")
            result = runner.run(COMMANDS[command].split() + ["--device", "all"], env)
        report = json.loads(result.stdout) if result.stdout else {"devices": [], "pairs": []}
        whys = [device["why"] for device in report.get("devices", []) if device["name"] == "vulkan:1" and device["status"] == "error"]
        told = re.fullmatch("raingauge: device 'vulkan:1': vulkan has no such device; .*\n", re.sub(UNSUPPORTED, "", result.stderr))
        kept = found_well(command, report)
        well = kept == {"cpu", "cpu:reference", "vulkan"} and result.returncode == 1 and told and (command != "doctor" or whys and "was listed, and is gone now: device" in whys[0])
        return [] if well else ["%s: kept %s, %s, exit status %d, %s" % (command, sorted(kept), whys, result.returncode, result.stderr)]
    return side_by_side(problems_gone, ["doctor", "diff"])


def check_named(runner):
    """a driver that crashes while a named device is opened ends the command before any work"""
    def problems_named(command):
        with tempfile.TemporaryDirectory() as folder:
            env = shim(runner, folder, "vulkan", "vkCreateDevice", "fault", 0)
            result = runner.run(COMMANDS[command].split() + ["--device", "cpu,vulkan,cpu:reference"], env)
        well = result.returncode == 1 and not result.stdout and result.stderr.count("\n") == 1 and re.search(HOW["fault"][1], result.stderr)
        return [] if well else ["%s: exit status %d, %s, %s" % (command, result.returncode, result.stdout, result.stderr)]
    return side_by_side(problems_named, ["diff", "table", "verify"])


def check_opened(runner):
    """a listed device whose driver crashes while it is opened counts as a crash, and every other is verified"""
    with tempfile.TemporaryDirectory() as folder:
        env = dict(shim(runner, folder, "vulkan", "vkCreateDevice", "fault", 0), **NEITHER)
        result = runner.run(COMMANDS["verify"].split() + ["--device", "all"], env)
    report = json.loads(result.stdout)
    fallen = [(check["device"], check["status"]) for check in report["checks"] if check["check"] == "device"]
    well = result.returncode == 1 and fallen == [("gl", "unsupported"), ("opencl", "unsupported"), ("vulkan", "crash")] and found_well("verify", report) == {"cpu", "cpu:reference"}
    return [] if well else ["exit status %d, %s, %s" % (result.returncode, fallen, result.stderr)]


def check_environments(runner):
    """two settings and two drivers of one API run side by side, told apart by their names"""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "other.json")
        shim(runner, folder, "vulkan", "none", "none", 0)
        os.rename(os.path.join(folder, "misbehaving.json"), path)
        names = ["vulkan", "vulkan@LP_NUM_THREADS=1", "vulkan@VK_DRIVER_FILES=" + path,
                 'gl@LP_NATIVE_VECTOR_WIDTH=128;RG_NOTE="a,b;c"']
        result = runner.run(COMMANDS["diff"].split() + ["--device", ",".join(names)])
    report = json.loads(result.stdout)
    found = [(pair["a"], pair["b"], pair["tier"]) for pair in report["pairs"]]
    wanted = [(a, b, "T0") for i, a in enumerate(names) for b in names[i + 1:]]
    return [] if found == wanted and result.returncode == 0 and not result.stderr else [
        "%s, exit status %d, %s" % (found, result.returncode, result.stderr)]


def check_caches(runner):
    """code that a driver kept for one width of vectors never runs for another"""
    kept = []
    with tempfile.TemporaryDirectory() as folder:
        for device in ("gl@LP_NATIVE_VECTOR_WIDTH=128", "vulkan@LP_NATIVE_VECTOR_WIDTH=256", "gl"):
            path = os.path.join(folder, "a.png")
            result = runner.run(("render raster --frame 1 --size 32x32 --device %s -o %s" % (device, path)).split(),
                                {"XDG_CACHE_HOME": folder, "MESA_SHADER_CACHE_DIR": None, "MESA_SHADER_CACHE_DISABLE": None})
            sides = os.path.join(folder, "raingauge", "sides")
            kept.append((result.returncode, len(os.listdir(sides)), os.path.exists(os.path.join(folder, "mesa_shader_cache"))))
    return [] if kept == [(0, 1, False), (0, 2, False), (0, 2, True)] else ["%s" % kept]


THOROUGH = [check_all_ways]
CHECKS = [check_comparisons, check_commands, check_alone, check_listed, check_required, check_ignored_ends, check_closing, check_gone, check_named, check_opened, check_environments, check_caches]
