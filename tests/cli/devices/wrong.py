"""A driver that draws wrongly, because its kernel differs, is found by each command."""
import json
import re
import tempfile

from cases import SMALL
from machine import run_json
from runner import NO_DRIVERS

RIGHT, TURNED, NO_GLSL = "(-slope_x * scale)", "(slope_x * scale)", "(nonsense * scale)"
TURNED_KERNELS = []  # their folder, once it is made


def turned_kernels(runner):
    """A folder of kernels that draw wrongly, one for all checks of a suite, so that a driver compiles them once."""
    if not TURNED_KERNELS:
        TURNED_KERNELS.append(tempfile.TemporaryDirectory())
        runner.kernels_with(TURNED_KERNELS[0].name, "flow_normals.glsl", RIGHT, TURNED)
    return TURNED_KERNELS[0].name


def with_normals(wrong):
    """Runs a check with kernels that are wrong on gl; without gl the check has nothing to find."""
    def decorate(check):
        def run(runner):
            devices = json.loads(runner.run(["list", "devices", "--json"]).stdout)["devices"]
            if not any(device["name"] == "gl" for device in devices):
                return []
            with tempfile.TemporaryDirectory() as tmp:
                return check(runner, runner.kernels_with(tmp, "flow_normals.glsl", RIGHT, wrong))
        run.__doc__ = check.__doc__
        return run
    return decorate


with_wrong_normals = with_normals(TURNED)


@with_normals(NO_GLSL)
def check_broken_table(runner, kernels):
    """a table reports a device whose driver refuses a kernel, measures the others, and fails"""
    report, status, messages = run_json(runner, "table stuppacher-2 --work paper --rows 1-1 --device gl,cpu", kernels)
    gl, cpu = report["cells"]
    problems = [] if len(messages) == 1 else messages + ["%d lines on stderr" % len(messages)]
    if status != 1 or gl["status"] != "error" or "measured" in gl or "flow_normals" not in gl["detail"]:
        problems.append("exit status %d, gl: %s" % (status, gl))
    if cpu["status"] != "ok" or "measured" not in cpu:
        problems.append("cpu: %s" % cpu)
    return problems


def check_crashing_driver(runner):
    """a driver that crashes when devices are listed fails list, diff, table and verify, and harms no other device"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        env = dict(NO_DRIVERS, **runner.crashing_vulkan(tmp))
        reports = {}
        for command, args in (("list", "devices"), ("diff", "flow --frame 1 " + SMALL), ("table", "stuppacher-2 --work paper --rows 1-1"),
                              ("verify", "raster --frame 1 --size 96x96")):
            reports[command], status, messages = run_json(runner, command + " " + args, env)
            crashed = [line for line in messages if "raingauge: vulkan: its driver crashed (Aborted)" in line]
            absent = [line for line in messages if re.search("warning: unsupported here: (gl|opencl): ", line)]
            if status != 1 or len(crashed) != 1 or len(absent) != 2 or len(messages) != 3:
                problems += ["%s: exit status %d" % (command, status)] + messages
    found = {"list": [device["name"] for device in reports["list"]["devices"]],
             "diff": [pair["tier"] for pair in reports["diff"]["pairs"]],
             "table": [cell["status"] for cell in reports["table"]["cells"]],
             "verify": [(c["device"], c["status"]) for c in reports["verify"]["checks"] if c["check"] == "device"]}
    if found != {"list": ["cpu", "cpu:reference"], "diff": ["T0"], "table": ["ok", "ok"],
                 "verify": [("gl", "unsupported"), ("vulkan", "crash"), ("opencl", "unsupported")]}:
        problems.append("found: %s" % found)
    return problems


@with_wrong_normals
def check_wrong_table(runner, kernels):
    """a table does not time a device whose image is wrong, and fails"""
    report, status, problems = run_json(runner, "table stuppacher-2 --work paper --rows 1-1 --device cpu,gl", kernels)
    cpu, gl = report["cells"]
    if status != 1 or cpu["status"] != "ok" or "measured" not in cpu:
        problems.append("exit status %d, cpu: %s" % (status, cpu))
    if gl["status"] != "fail" or "measured" in gl or "differs from cpu:reference" not in gl["detail"]:
        problems.append("gl: %s" % gl)
    if report["passport"]["raingauge"]["kernel_dir"] != kernels["RG_KERNEL_DIR"]:
        problems.append("the passport does not name the kernels' folder")
    return problems


@with_wrong_normals
def check_wrong_diff(runner, kernels):
    """diff fails the pairs of a device whose image is wrong, and no others"""
    report, status, problems = run_json(runner, "diff flow --frame 5 --device cpu,cpu:reference,gl " + SMALL, kernels)
    same = [(pair["a"], pair["b"]) for pair in report["pairs"] if pair["tier"] == "T0"]
    text = runner.run(("diff flow --frame 5 --device cpu,gl " + SMALL).split(), kernels).stdout
    if status != 1 or same != [("cpu", "cpu:reference")] or {pair["owed"] for pair in report["pairs"]} != {"T0"}:
        problems.append("exit status %d, identical: %s" % (status, same))
    blamed = [((pair.get("blame") or {}).get("stage"), (pair.get("blame") or {}).get("device")) for pair in report["pairs"] if pair["tier"] != "T0"]
    if blamed != [("flow_normals", "gl")] * 2 or "blame" in report["pairs"][0]:
        problems.append("blamed: %s" % blamed)
    if not re.search(r"(?m)^  gl: frame 1, stage flow_normals: normals\[\d+\] is .*; other values$", text):
        problems.append("the text blames no stage:\n" + text)
    if not re.search(r"(?m)^cpu, gl +fail ", text):
        problems.append("the text does not say so:\n" + text)
    return problems


@with_wrong_normals
def check_wrong_verify(runner, kernels):
    """verify fails the image of a device that draws wrongly, and nothing else"""
    report, status, problems = run_json(runner, "verify flow --frame 5 --device cpu,gl " + SMALL, kernels)
    failed = [(check["check"], check["device"]) for check in report["checks"] if check["status"] != "ok"]
    if status != 1 or failed != [("image", "gl")]:
        problems.append("exit status %d, failed: %s" % (status, failed))
    return problems


@with_wrong_normals
def check_wrong_stage(runner, kernels):
    """verify --stages names the wrong stage, the asset, the word, and the difference"""
    report, status, problems = run_json(runner, "verify flow --stages --device cpu,gl " + SMALL, kernels)
    checks = {device: [c for c in report["checks"] if c["device"] == device] for device in ("cpu", "gl")}
    if status != 1 or not checks["cpu"] or any(check["status"] != "ok" for check in checks["cpu"]):
        problems.append("exit status %d, cpu: %s" % (status, checks["cpu"]))
    found = r"frame 1, stage flow_normals: normals\[\d+\] is .*, not .*, off by \d.*; \d+ of \d+ words differ"
    for check in checks["gl"]:
        if check["check"] != "stages" or check["status"] != "fail" or not re.search(found, check["detail"]):
            problems.append("gl: %s" % check)
    return problems


CHECKS = [check_broken_table, check_crashing_driver, check_wrong_table, check_wrong_diff, check_wrong_verify,
          check_wrong_stage]
