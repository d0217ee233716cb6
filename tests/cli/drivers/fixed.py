"""`raingauge doctor --fixed-function`: digests that hold, and what changes them."""
import json
import os
import re
import tempfile

import forms
import misbehaving

APIS = ("gl", "vulkan")
# What turns a part of llvmpipe off, and features whose digests must tell.
SWITCHES = {
    "LP_PERF=no_linear": {"linear", "trilinear", "cube seams"},
    "LP_PERF=no_mipmap": {"mip nearest", "trilinear"},
    "LP_PERF=no_mip_linear": {"trilinear"},
    "LP_PERF=no_tex": {"nearest", "linear"},
    "LP_PERF=no_depth": {"depth test", "polygon offset", "stencil"},
    "LP_PERF=no_blend": {"blending RGBA8", "blending RGBA16F", "blending RGBA32F", "dual source"},
    "GALLIVM_PERF=no_aos_sampling": {"linear"},
}


def draw(runner, devices, env={}):
    """The draws of each device by its name, with the exit status and what is wrong with messages and form."""
    result = runner.run(["doctor", "--fixed-function", "--json", "--device", ",".join(devices)], env)
    report = json.loads(result.stdout)
    return {row["name"]: row for row in report["fixed_functions"]}, result.returncode, \
        result.stderr + "".join(line + "\n" for line in forms.problems("fixed", report))


def digests(row):
    return {draw["feature"]: draw.get("digest", draw["why"]) for draw in row["draws"]}


def differing(a, b):
    return sorted(feature for feature, digest in digests(a).items() if digests(b)[feature] != digest)


def check_digests(runner):
    """No digest depends on the number of threads, or differs the second time."""
    problems = []
    for api in APIS:
        names = [api] + ["%s@LP_NUM_THREADS=%d" % (api, threads) for threads in (0, 1, 2)]
        found, status, errors = draw(runner, names)
        plain = found[api]
        if plain["status"] == "unsupported" and not plain["draws"]:
            continue
        if status or errors or plain["status"] != "ok":
            problems.append("%s: exit status %d, %s, stderr: %s" % (api, status, plain["status"], errors))
        for name in names[1:]:
            problems += ["%s: differs from %s in %s" % (name, api, feature) for feature in differing(plain, found[name])]
        again = draw(runner, [api])[0][api]
        problems += ["%s: differs the second time in %s" % (api, feature) for feature in differing(plain, again)]
    return problems


def check_switches(runner):
    """Each switch of Mesa that turns a part off changes the digests of its features."""
    problems = []
    for api in APIS:
        found = draw(runner, [api] + ["%s@%s" % (api, switch) for switch in SWITCHES])[0]
        if not found[api]["draws"] or not found[api]["draws"][0].get("digest"):
            continue
        for switch, features in SWITCHES.items():
            differ = differing(found[api], found["%s@%s" % (api, switch)])
            if not features <= set(differ):
                problems.append("%s: %s changes %s" % (api, switch, differ))
    return problems


def check_none(runner):
    """What draws by its own programs has no fixed functions, and says so in one line."""
    problems = []
    result = runner.run("doctor --fixed-function --device cpu,cpu:reference,opencl".split())
    for name in ("cpu", "cpu:reference", "opencl"):
        if not re.search("^%s: unsupported: .+$" % name, result.stdout, re.M):
            problems.append("%s: no line in %s" % (name, result.stdout))
    if result.returncode != 77 or len(result.stdout.splitlines()) != 3:
        problems.append("exit status %d, stdout: %s" % (result.returncode, result.stdout))
    result = runner.run("doctor --fixed-function --kernels all --device cpu".split())
    if result.returncode != 2 or "--kernels" not in result.stderr:
        problems.append("with --kernels: exit status %d, stderr: %s" % (result.returncode, result.stderr))
    return problems


def check_text(runner):
    """The text has a line a feature, with its digest or why there is none."""
    found = draw(runner, ["gl"])[0]["gl"]
    lines = runner.run("doctor --fixed-function --device gl".split()).stdout.splitlines()
    if not found["draws"]:
        return []
    problems = [] if len(lines) == 1 + len(found["draws"]) else ["%d lines" % len(lines)]
    for line, (feature, digest) in zip(lines[1:], digests(found).items()):
        if not line.startswith("  %s " % feature) or not line.endswith(digest):
            problems.append("%s, %s: %s" % (feature, digest, line))
    return problems


def check_page(runner):
    """docs/native.md lists the features in the table's order."""
    with open(os.path.join(forms.DOCS, "native.md")) as file:
        listed = re.findall(r"^\| ([^|]+?) \| [^|]+ \| `\w+` = ", file.read(), re.M)
    found = draw(runner, ["gl"])[0]["gl"]["draws"]
    return [] if not found or listed == [row["feature"] for row in found] else ["it lists %s" % listed]


def check_crash(runner):
    """A driver that crashes is named with the feature, and the others are drawn all the same."""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        env = misbehaving.shim(runner, tmp, "vulkan", "vkCreateGraphicsPipelines", "abort", 40)
        found, status, errors = draw(runner, ["vulkan"], env)
    row = found["vulkan"]
    if row["status"] == "unsupported" and not row["draws"]:
        return []
    crashed = [draw for draw in row["draws"] if draw["status"] == "crash"]
    if not crashed or len(crashed) > len(row["draws"]) / 4 or row["status"] != "fail" or status != 1:
        problems.append("exit status %d, %s: %s" % (status, row["why"], [d["feature"] for d in crashed]))
    problems += ["%s: %s" % (d["feature"], d["why"]) for d in crashed if "drawing feature '%s'" % d["feature"] not in d["why"]]
    if len(errors.splitlines()) != len(crashed):
        problems.append("stderr: %s" % errors)
    return problems


CHECKS = [check_digests, check_switches, check_none, check_text, check_page, check_crash]
