"""`raingauge doctor --fixed-function`: digests that hold, and what changes them."""
import functools
import json
import os
import re
import tempfile

import forms
import misbehaving
from baselines import change, gate, make
from gates import KNOT, Files, endings
from runner import LATER

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
# Draws that prove nothing any more, and how they are refused. A depth buffer that nobody clears holds whatever its memory held.
REFUSED = (("LP_PERF=no_blend", "blending RGBA8", "leaves what its neighbour does, whose blend is 1"),
           ("LP_PERF=no_depth", "depth test", "leaves a picture that is the same everywhere|colour 0 at .* is [0-9]+, not from .*"))
FAR, NEAR = "LP_PERF=no_linear", "GALLIVM_PERF=no_aos_sampling"  # beyond bounds, and within
# Vector widths, and numbers of threads: each number meets another one of the same width.
SETTINGS = ((128, 1), (128, 2), (256, 0), (256, 2))


# Draws that no specification bounds.
UNBOUNDED = ["anisotropic", "tessellation"]


def drawn(runner, devices, env={}):
    """The report of the draws of devices, with the exit status and what is wrong with messages and form."""
    result = runner.run(["doctor", "--fixed-function", "--json", "--device", ",".join(devices)], env)
    report = json.loads(result.stdout)
    return report, result.returncode, result.stderr + "".join(line + "\n" for line in forms.problems("fixed", report))


def rows(report):
    return {row["name"]: row for row in report["fixed_functions"]}


def draw(runner, devices, env={}):
    """The draws of each device by its name, and the rest as above."""
    report, status, errors = drawn(runner, devices, env)
    return rows(report), status, errors


@functools.lru_cache(maxsize=None)
def undisturbed(runner):
    """Both devices as they are, drawn once for all checks."""
    return drawn(runner, APIS)


def plain(runner):
    return rows(undisturbed(runner)[0])


def passport(runner, api):
    """A device as the passport of doctor has it."""
    return next((device for device in undisturbed(runner)[0]["passport"]["devices"] if device["name"] == api), {})


@functools.lru_cache(maxsize=None)
def with_settings(runner, api):
    names = {"%s@LP_NATIVE_VECTOR_WIDTH=%d;LP_NUM_THREADS=%d" % (api, *setting): setting for setting in SETTINGS}
    found, status, errors = draw(runner, list(names))
    return {setting: found[name] for name, setting in names.items()}, status, errors


@functools.lru_cache(maxsize=None)
def with_switches(runner, api):
    found = draw(runner, ["%s@%s" % (api, switch) for switch in SWITCHES])[0]
    return {switch: found["%s@%s" % (api, switch)] for switch in SWITCHES}


def digests(row):
    return {draw["feature"]: draw.get("digest", draw["why"]) for draw in row["draws"]}


def differing(a, b):
    return sorted(feature for feature, digest in digests(a).items() if digests(b)[feature] != digest)


def within(row):
    return {draw["feature"] for draw in row["draws"] if draw.get("bounds") == "within"}


def check_digests(runner):
    """No digest depends on the number of threads."""
    _, status, errors = undisturbed(runner)
    problems = ["exit status %d, stderr: %s" % (status, errors)] if errors or status not in (0, 77) else []
    for api, row in plain(runner).items():
        if row["status"] == "unsupported" and not row["draws"]:
            continue
        found, status, errors = with_settings(runner, api)
        if status or errors or row["status"] != "ok":
            problems.append("%s: exit status %d, %s, stderr: %s" % (api, status, row["status"], errors))
        problems += ["%s: with %d and %d bits and threads it differs in %s" % (api, *a, *b, differing(found[a], found[b]))
                     for a in SETTINGS for b in SETTINGS if a < b and a[0] == b[0] and differing(found[a], found[b])]
        problems += ["%s: with %d bits and %d threads it differs in %s" % (api, *setting, differing(row, found[setting]))
                     for setting in SETTINGS if "%d bits" % setting[0] in passport(runner, api)["device"] and differing(row, found[setting])]
    return problems


def check_apis(runner):
    """Mesa's two APIs leave the same digests, but for the lines' ends and what one of them lacks."""
    told = [{draw["feature"]: draw["digest"] for draw in plain(runner)[api]["draws"] if draw["status"] == "ok"} for api in APIS]
    if not all(told) or "Mesa" not in passport(runner, "vulkan")["driver"]:
        return []
    differ = [feature for feature, digest in told[0].items() if told[1].get(feature, digest) != digest]
    return [] if differ in ([], ["lines"]) else ["gl and vulkan differ in %s" % differ]


def check_switches(runner):
    """Each switch of Mesa that turns a part off changes the digests of its features."""
    problems = []
    for api, row in plain(runner).items():
        if not row["draws"] or not row["draws"][0].get("digest"):
            continue
        found = with_switches(runner, api)
        for switch, features in SWITCHES.items():
            differ = differing(row, found[switch])
            if not features <= set(differ):
                problems.append("%s: %s changes %s" % (api, switch, differ))
        for switch, feature, why in REFUSED:
            told = next(row for row in found[switch]["draws"] if row["feature"] == feature)
            if told["status"] != "fail" or not re.fullmatch(why, told["why"]):
                problems.append("%s: %s: %s" % (api, switch, told))
    return problems


def check_bounds(runner):
    """All values of Mesa's drivers are within bounds, with any vector width and number of threads, but for faults that are known."""
    problems = []
    for api in APIS:
        for setting, row in with_settings(runner, api)[0].items():
            told = {kind: [d["feature"] for d in row["draws"] if d.get("bounds") == kind] for kind in ("within", "beyond", "none")}
            known = [d["feature"] for d in row["draws"] if "known" in d]
            if row["draws"] and (told["beyond"] != known or told["none"] != UNBOUNDED or len(told["within"]) < 40):
                problems.append("%s, %s: %s, known %s" % (api, setting, told, known))
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


def problems_of_text(row, lines):
    """What is wrong with a device's lines."""
    problems = []
    cases = len(row["closed"])
    known = sum("known" in row for row in row["draws"])
    told = ", %d known fault%s" % (known, "" if known == 1 else "s") if known else ""
    if not cases or "0 fail%s; %d of %d closed cases hold;" % (told, cases, cases) not in lines[0]:
        problems.append("%d closed cases: %s" % (cases, lines[0]))
    words = {"within": "within bounds", "none": "no bounds"}
    for line, row in zip(lines[1:], row["draws"]):
        told = "%s  %s" % (row["digest"], "known fault: " + row["known"] if "known" in row else words[row["bounds"]]) if "digest" in row else row["why"]
        if not line.startswith("  %s " % row["feature"]) or not line.endswith(told):
            problems.append("%s, %s: %s" % (row["feature"], told, line))
    return problems


def check_text(runner):
    """The text has a line a feature, with its digest or why there is none; drawn a second time, no digest differs."""
    found = {api: row for api, row in plain(runner).items() if row["draws"]}
    if not found:
        return []
    lines = runner.run(["doctor", "--fixed-function", "--device", ",".join(found)]).stdout.splitlines()
    problems = [] if len(lines) == sum(1 + len(row["draws"]) for row in found.values()) else ["%d lines" % len(lines)]
    for api, row in found.items():
        problems += problems_of_text(row, lines[:1 + len(row["draws"])])
        problems += [] if lines[0].startswith(api + ": ") else ["%s: %s" % (api, lines[0])]
        del lines[:1 + len(row["draws"])]
    return problems


def check_page(runner):
    """docs/native.md lists the features and the closed cases in their tables' order."""
    with open(os.path.join(forms.DOCS, "native.md")) as file:
        text = file.read()
    listed = re.findall(r"^\| ([^|]+?) \| [^|]+ \| `\w+` = ", text, re.M)
    closed = re.findall(r"^\| ([^|]+?) \| ([^|]+?) \|$", text.partition("## Closed cases")[2].partition("\n## ")[0], re.M)[1:]
    found = plain(runner)["gl"]
    if not found["draws"]:
        return []
    problems = [] if listed == [row["feature"] for row in found["draws"]] else ["it lists %s" % listed]
    unbounded = re.findall(r"^\| ([^|]+?) \| [^|]+ \| `\w+` = [^|]+ \| none \|$", text, re.M)
    problems += [] if unbounded == UNBOUNDED else ["unbounded: %s" % unbounded]
    return problems + ([] if closed == [(row["feature"], row["case"]) for row in found["closed"]] else ["closed: %s" % closed])


def check_crash(runner):
    """A driver that crashes is named with the feature, and the others are drawn all the same."""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        env = misbehaving.shim(runner, tmp, "vulkan", "vkCreateGraphicsPipelines", "abort", 70)
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


def check_gives_up(runner):
    """A device whose driver fails every draw is tried twice, and a line says how many are not."""
    with tempfile.TemporaryDirectory() as tmp:
        found, status, errors = draw(runner, ["vulkan"], misbehaving.shim(runner, tmp, "vulkan", "vkCreateGraphicsPipelines", "abort", 1))
    row, lines = found["vulkan"], errors.splitlines()
    if row["status"] == "unsupported" and not row["draws"]:
        return []
    left = sum(len(plain(runner)["vulkan"][kind]) - len(row[kind]) for kind in ("draws", "closed"))
    told = r"raingauge: device 'vulkan': 2 draws of fixed functions failed, and %d more are not tried$" % left
    if len(lines) != 3 or not re.match(told, lines[-1]) or [draw["status"] for draw in row["draws"]].count("crash") != 2 or status != 1:
        return ["exit status %d, %s: %s" % (status, row["why"], lines)]
    return []


def kept(device, beyond=(), **digests):
    """Edits a baseline: digests of a device by feature, and features whose pictures were not within their bounds."""
    def edit(document):
        passport = next(d for d in document["passport"]["devices"] if d["name"] == device)
        passport["fixed_functions"].update(digests)
        passport["within_bounds"] = [feature for feature in passport["within_bounds"] if feature not in beyond]
    return edit


def moved(**parts):
    """Edits a baseline: parts of gl's key are others."""
    def edit(document):
        next(d for d in document["devices"] if d["name"] == "gl")["of"].update(parts)
    return edit


def others(report):
    """Endings and messages of the cases of fixed functions that do not plainly pass."""
    return {case["name"]: (case["ending"], case["message"]) for case in report["gated"] if case["technique"] == "fixed" and
            case["ending"] != "pass"}


def check_kept(runner):
    """a baseline keeps the digests, and a gate tells which are others: with the feature, unless expectations name it"""
    problems = []
    with Files(KNOT) as files:
        path, _ = make(runner, files, "--pictures", device="cpu,gl,vulkan")
        with open(path) as file:
            document = json.load(file)
        problems += forms.problems("baseline", document)
        devices = {device["name"]: device.get("fixed_functions", {}) for device in document["passport"]["devices"]}
        if not devices.get("gl"):
            return problems
        if devices["cpu"] or any(devices[api] != passport(runner, api)["fixed_functions"] for api in APIS):
            problems.append("kept: %s" % devices)

        def held(edit, status, expected, *args):
            """Gates against an edited baseline."""
            edited = change(path, edit, files.path("edited.json"))
            result = gate(runner, files, edited, "--device", "gl", *args)
            report = json.loads(result.stdout)
            told = {name: ending for name, (ending, _) in others(report).items()}
            if result.returncode != status or told != expected or "fixed.gl" not in endings(report) or "is of no cell" in result.stderr:
                problems.append("%s: exit status %d, %s, %s" % (expected, result.returncode, others(report), result.stderr))
            return {case["name"]: case["message"] for case in report["gated"]}

        # Another Mesa or LLVM makes no digest another.
        all_gl, of = len(devices["gl"]), next(d for d in document["devices"] if d["name"] == "gl")["of"]
        told = held(moved(driver="another Mesa", device=re.sub(r"LLVM [\d.]+", "LLVM 1.2", of["device"])), 0, {})
        if told["fixed.gl"] != "%d digests are the baseline's" % all_gl:
            problems.append("same: %s" % told)
        others_then = {"mip nearest": "0" * 16, "stencil": "1" * 16}
        two = kept("gl", beyond=list(others_then), **others_then)
        known = files.path("known.txt", "".join(
            "fail fixed/%s\n  device gl\n  outcome fail\n  reason it is another unit\n  since 2026-01-01\n  until %s\n" % (feature, LATER)
            for feature in ("stencil", "linear")))
        told = held(two, 1, {"fixed/mip-nearest.gl": "differs", "fixed/stencil.gl": "expected failure", "fixed/linear.gl": "unexpected pass"},
                    "--expectations", known)
        if told["fixed.gl"] != "%d digests are the baseline's, and 2 are not" % (all_gl - 2) or \
                told["fixed/mip-nearest.gl"] != "%s and not %s, which is the baseline's" % (devices["gl"]["mip nearest"], "0" * 16):
            problems.append("two: %s" % told)
        # Where both pictures are within their bounds the APIs allow others, and a strict gate does not.
        told = held(kept("gl", beyond=["stencil"], **others_then), 1, {"fixed/stencil.gl": "differs"})
        if told["fixed.gl"] != "%d digests are the baseline's, 1 differs as the APIs allow, and 1 is not" % (all_gl - 2) or \
                told["fixed/mip-nearest.gl"] != "differs from the baseline's, and both are within bounds":
            problems.append("allowed: %s" % told)
        held(kept("gl", **others_then), 0, {})
        held(kept("gl", **others_then), 1, {"fixed/mip-nearest.gl": "differs", "fixed/stencil.gl": "differs"}, "--strict")
        refused = runner.run(["gate", "--baseline", path, "--device", "cpu", "--strict", "--cells", files.cells, "--pictures"])
        if refused.returncode != 2 or "--strict: is about fixed functions, and this gate compares none" not in refused.stderr:
            problems.append("strict about cpu: exit status %d, %s" % (refused.returncode, refused.stderr))
        told = held(moved(cpu="another processor"), 0, {"fixed.gl": "skipped"})
        if not told["fixed.gl"].startswith("%d digests are not compared: cpu " % all_gl):
            problems.append("another processor: %s" % told)
        held(moved(device=re.sub(r"\d+ bits", "512 bits", of["device"])), 0, {"fixed.gl": "skipped"})
        problems += updates(runner, files, change(path, two, files.path("edited.json")))
    return problems


def updates(runner, files, path):
    """An update prints each digest that is another."""
    result = runner.run(["baseline", "--device", "gl", "--pictures", "--cells", files.cells, "-o", path])
    lines = ["~ fixed function '%s' of gl: another digest" % feature for feature in ("mip nearest", "stencil")]
    missing = [line for line in lines if line not in result.stdout.splitlines()]
    return ["update: exit status %d, %s" % (result.returncode, result.stdout)] if missing or result.returncode != 1 else []


def other_driver(runner, files, *settings, built=""):
    """A device whose driver is another library, in front of lavapipe. raingauge keeps the code of drivers with other paths apart."""
    path = files.path("driver%s.json" % re.sub(r"\W", "-", built))
    with open(path, "w") as file:
        json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": runner.misbehaver, "api_version": "1.1.0"}}, file)
    return "new=vulkan@" + ";".join(["VK_DRIVER_FILES=" + path, *settings])


def cell(feature):
    return "fixed/" + feature.replace(" ", "-")


def check_drivers(runner):
    """a gate of two drivers holds the digests of one against the other's: those that the APIs let differ are told and pass, unless the gate
    is strict; the others fail, unless expectations name them"""
    problems = []
    if not passport(runner, "vulkan").get("fixed_functions"):
        return problems
    with Files(KNOT) as files:
        new = other_driver(runner, files)

        def held(built, *args, status=None, device=None):
            """Gates lavapipe against itself behind another library, which may be built with a setting that its name does not tell."""
            env = {"XDG_CACHE_HOME": files.path("cache")}
            device = device or other_driver(runner, files, built=built)
            result = runner.run(["gate", "vulkan", device, "--pictures", "--json", "--cells", files.cells, *args], dict(env, RG_DRIVER_AS=built) if built else env)
            report = json.loads(result.stdout)
            told = {case["name"]: (case["ending"], case["message"]) for case in report["gated"] if case["technique"] == "fixed"}
            if result.returncode != status:
                problems.append("%s, %s: exit status %d, %s, %s" % (built, args, result.returncode, told, result.stderr))
            return told

        row, count = plain(runner)["vulkan"], len(passport(runner, "vulkan")["fixed_functions"])
        # One that does not filter leaves other digests, beyond bounds; each but one is expected.
        wrong = differing(row, with_switches(runner, "vulkan")[FAR])
        known = files.path("known.txt", "".join(
            "fail %s\n  device new\n  outcome fail\n  reason it does not filter\n  since 2026-01-01\n  until %s\n" % (cell(feature), LATER)
            for feature in wrong if feature != "linear"))
        found = held(FAR, "--expectations", known, status=1)
        if {name: ending for name, (ending, _) in found.items()} != \
                {"fixed.new": "pass", **{cell(feature) + ".new": "expected failure" for feature in wrong}, "fixed/linear.new": "differs"} or \
                ", which is vulkan's" not in found["fixed/linear.new"][1] or \
                found["fixed.new"][1] != "%d digests are vulkan's, and %d are not" % (count - len(wrong), len(wrong)):
            problems.append("far from %s: %s" % (wrong, found))
        # Another way to mix texels rounds otherwise.
        other = with_switches(runner, "vulkan")[NEAR]
        near = {cell(feature) + ".new" for feature in differing(row, other) if feature in within(row) & within(other)}
        found = held(NEAR, status=0)
        if not {"fixed/linear.new", "fixed/array-layers.new"} <= near or found != {
                "fixed.new": ("pass", "%d digests are vulkan's, %d differ as the APIs allow" % (count - len(near), len(near))),
                **{name: ("pass", "differs from vulkan's, and both are within bounds") for name in near}}:
            problems.append("near, %s: %s" % (near, found))
        found = held(NEAR, "--strict", status=1)
        if {name for name, (ending, _) in found.items() if ending == "differs"} != near:
            problems.append("strict: %s" % found)
        # With other settings only the cell is compared.
        for settings, said in ((("LP_PERF=no_blend",), "LP_PERF no_blend and not unset"), (("LP_NATIVE_VECTOR_WIDTH=128",), "128 bits")):
            found = held("", status=0, device=other_driver(runner, files, *settings).replace("new=", "other%d=" % len(said)))
            [(ending, message)] = found.values()
            if ending != "skipped" or not message.startswith("48 digests are not compared: ") or said not in message:
                problems.append("%s: %s" % (settings, found))
        # A first driver that falls while it draws them leaves nothing to compare with, which is no pass.
        fallen = runner.run(["gate", new.replace("new=", "old="), "vulkan", "--pictures", "--json", "--cells", files.cells],
                            {"RG_MISBEHAVE": "vkCreateGraphicsPipelines:abort:24"})
        told = endings(json.loads(fallen.stdout))
        if fallen.returncode != 1 or told != {"raster/knot.vulkan": "pass", "fixed.vulkan": "crash"}:
            problems.append("a first driver that falls: exit status %d, %s, %s" % (fallen.returncode, told, fallen.stderr))
        names = runner.run(["gate", "vulkan", new, "--cells", files.cells, "--gtest_list_tests"]).stdout
        if "fixed" not in names or "fixed" in runner.run(["gate", "vulkan", "vulkan@LP_PERF=no_blend", "--cells", files.cells, "--gtest_list_tests"]).stdout:
            problems.append("listed: %s" % names)
    return problems


CHECKS = [check_digests, check_apis, check_switches, check_bounds, check_none, check_text, check_page, check_crash, check_gives_up, check_kept, check_drivers]
