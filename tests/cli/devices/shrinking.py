"""A driver that miscompiles a shader: blamed, shrunk to a case, and the case replayed."""
import os
import re
import tempfile

import misbehaving

SMALL = "--set environment_px=64 --set resolution_px=96 --size 96x96 "
STAGE, RIGHT, WRONG = "flow_normals", "44ffe000", "44ff0000"  # 2047 and 2040


def miscompiling(runner, folder):
    """The device vulkan with a driver that has another constant in one shader."""
    env = misbehaving.shim(runner, folder, "vulkan", "none", "none", 0)
    size = os.path.getsize(os.path.join(runner.kernels, STAGE + ".spv"))
    return "vulkan@VK_DRIVER_FILES=%s;RG_MISCOMPILE=%d:%s:%s" % (env["VK_DRIVER_FILES"], size, RIGHT, WRONG)


def check_blamed(runner):
    """diff blames the stage whose shader a driver has miscompiled, and no other"""
    with tempfile.TemporaryDirectory() as folder:
        device = miscompiling(runner, folder)
        result = runner.run(["diff", "flow", "--frame", "3", "--device", "cpu," + device] + SMALL.split())
    found = re.findall(r"(?m)^  vulkan.*: frame (\d+), stage (\w+): (\w+)\[\d+\] is .*; other values$", result.stdout)
    return [] if result.returncode == 1 and found == [("1", STAGE, "normals")] else [
        "exit status %d, %s\n%s%s" % (result.returncode, found, result.stdout, result.stderr)]


def check_shrunk(runner):
    """shrink makes a case below 40 lines of it, smaller in every size, which each device replays"""
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        device, path = miscompiling(runner, folder), os.path.join(folder, "case.txt")
        args = ["shrink", "flow", "--frame", "3", "--device", device + ",cpu:reference", "-o", path] + SMALL.split()
        result = runner.run(args)
        if result.returncode != 0 or result.stderr or "stage " + STAGE not in result.stdout:
            return ["exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
        case = dict(line.split(" ", 1) for line in lines if not line.startswith(("#", "set ")))
        settings = dict(line[4:].split("=", 1) for line in lines if line.startswith("set "))
        if len(lines) >= 40 or (case["size"], case["frames"], case["stage"]) != ("16x16", "1", STAGE):
            problems.append("%d lines: %s" % (len(lines), case))
        if int(settings["resolution_px"]) >= 96 or int(settings["environment_px"]) != 16 or "seed" in settings:
            problems.append("settings: %s" % settings)
        for other, status, says in ((device, 1, "other: .*, as was found"), ("cpu", 0, "same: cpu "), ("vulkan", 0, "same: vulkan ")):
            result = runner.run(["render", "--case", path, "--device", other])
            if result.returncode != status or result.stderr or not re.match(says, result.stdout):
                problems.append("%s: exit status %d, %s%s" % (other, result.returncode, result.stdout, result.stderr))
        text = "\n".join(lines)
        for right, wrong, says in (
                ("size 16x16", "size 16x", r"line 4: 'size' is no line of a case here"),
                ("set environment_px", "set nonsense_px", r"line \d+: .*nonsense_px"),
                ("asset normals", "", r"lacks its technique, size, asset or expected digest"),
                ("technique flow", "technique nonsense", r"line 3: 'technique' is no line")):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text.replace(right, wrong))
            result = runner.run(["render", "--case", path])
            if result.returncode != 2 or len(result.stderr.splitlines()) != 1 or not re.search(says, result.stderr):
                problems.append("%s: exit status %d, %s" % (wrong, result.returncode, result.stderr))
    return problems


def check_nothing_to_shrink(runner):
    """shrink of two devices that agree fails, and writes nothing"""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "case.txt")
        result = runner.run(["shrink", "flow", "--frame", "1", "--device", "cpu,cpu:reference", "-o", path] + SMALL.split())
        made = os.path.exists(path)
    return [] if result.returncode == 1 and not made and "leaves in every asset" in result.stderr else [
        "exit status %d, made: %s, %s" % (result.returncode, made, result.stderr)]


CHECKS = [check_blamed, check_shrunk, check_nothing_to_shrink]
