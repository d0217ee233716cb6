"""`raingauge doctor --fixed-function`: digests that hold, and what changes them."""
import json
import os
import re
import tempfile

import forms
import misbehaving
from baselines import change, gate, make
from gates import TORUS, Files, endings
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


# Draws that no specification bounds.
UNBOUNDED = ["anisotropic", "tessellation"]


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


def check_apis(runner):
    """Mesa's two APIs leave the same digests, but for the lines' ends and what one of them lacks."""
    found = draw(runner, APIS)[0]
    told = [{draw["feature"]: draw["digest"] for draw in found[api]["draws"] if draw["status"] == "ok"} for api in APIS]
    if not all(told) or "Mesa" not in passport(runner, "vulkan")["driver"]:
        return []
    differ = [feature for feature, digest in told[0].items() if told[1].get(feature, digest) != digest]
    return [] if differ in ([], ["lines"]) else ["gl and vulkan differ in %s" % differ]


def passport(runner, api):
    """A device as the passport of doctor has it."""
    report = json.loads(runner.run(["doctor", "--fixed-function", "--json", "--device", api]).stdout)
    return report["passport"]["devices"][0]


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
        for switch, feature, why in REFUSED:
            told = next(row for row in found["%s@%s" % (api, switch)]["draws"] if row["feature"] == feature)
            if told["status"] != "fail" or not re.fullmatch(why, told["why"]):
                problems.append("%s: %s: %s" % (api, switch, told))
    return problems


def check_bounds(runner):
    """All values of Mesa's drivers are within bounds, with any vector width and number of threads, but for faults that are known."""
    problems = []
    for api in APIS:
        settings = ["%s@LP_NATIVE_VECTOR_WIDTH=%d;LP_NUM_THREADS=%d" % (api, bits, threads) for bits in (128, 256) for threads in (1, 2)]
        for name, row in draw(runner, settings)[0].items():
            told = {kind: [d["feature"] for d in row["draws"] if d.get("bounds") == kind] for kind in ("within", "beyond", "none")}
            known = [d["feature"] for d in row["draws"] if "known" in d]
            if row["draws"] and (told["beyond"] != known or told["none"] != UNBOUNDED or len(told["within"]) < 40):
                problems.append("%s: %s, known %s" % (name, told, known))
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
    cases = len(found["closed"])
    known = sum("known" in row for row in found["draws"])
    told = ", %d known fault%s" % (known, "" if known == 1 else "s") if known else ""
    if not cases or "0 fail%s; %d of %d closed cases hold;" % (told, cases, cases) not in lines[0]:
        problems.append("%d closed cases: %s" % (cases, lines[0]))
    words = {"within": "within bounds", "none": "no bounds"}
    for line, row in zip(lines[1:], found["draws"]):
        told = "%s  %s" % (row["digest"], "known fault: " + row["known"] if "known" in row else words[row["bounds"]])
        if not line.startswith("  %s " % row["feature"]) or not line.endswith(told):
            problems.append("%s, %s: %s" % (row["feature"], told, line))
    return problems


def check_page(runner):
    """docs/native.md lists the features and the closed cases in their tables' order."""
    with open(os.path.join(forms.DOCS, "native.md")) as file:
        text = file.read()
    listed = re.findall(r"^\| ([^|]+?) \| [^|]+ \| `\w+` = ", text, re.M)
    closed = re.findall(r"^\| ([^|]+?) \| ([^|]+?) \|$", text.partition("## Closed cases")[2].partition("\n## ")[0], re.M)[1:]
    found = draw(runner, ["gl"])[0]["gl"]
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
    well, _, _ = draw(runner, ["vulkan"])
    with tempfile.TemporaryDirectory() as tmp:
        found, status, errors = draw(runner, ["vulkan"], misbehaving.shim(runner, tmp, "vulkan", "vkCreateGraphicsPipelines", "abort", 1))
    row, lines = found["vulkan"], errors.splitlines()
    if row["status"] == "unsupported" and not row["draws"]:
        return []
    left = sum(len(well["vulkan"][kind]) - len(row[kind]) for kind in ("draws", "closed"))
    told = r"raingauge: device 'vulkan': 2 draws of fixed functions failed, and %d more are not tried$" % left
    if len(lines) != 3 or not re.match(told, lines[-1]) or [draw["status"] for draw in row["draws"]].count("crash") != 2 or status != 1:
        return ["exit status %d, %s: %s" % (status, row["why"], lines)]
    return []


def kept(device, **digests):
    """Edits a baseline: digests of a device by feature."""
    def edit(document):
        next(d for d in document["passport"]["devices"] if d["name"] == device)["fixed_functions"].update(digests)
    return edit


def moved(name, value):
    """Edits a baseline: a part of gl's key is another."""
    def edit(document):
        next(d for d in document["devices"] if d["name"] == "gl")["of"][name] = value
    return edit


def others(report):
    """Endings and messages of the cases of fixed functions that do not plainly pass."""
    return {case["name"]: (case["ending"], case["message"]) for case in report["gated"] if case["technique"] == "fixed" and
            case["ending"] != "pass"}


def check_kept(runner):
    """a baseline keeps the digests, and a gate tells which are others: with the feature, unless expectations name it"""
    problems = []
    with Files(TORUS) as files:
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
            result = gate(runner, files, edited, *args)
            report = json.loads(result.stdout)
            told = {name: ending for name, (ending, _) in others(report).items()}
            if result.returncode != status or told != expected or "fixed.gl" not in endings(report) or "is of no cell" in result.stderr:
                problems.append("%s: exit status %d, %s, %s" % (expected, result.returncode, others(report), result.stderr))
            return {case["name"]: case["message"] for case in report["gated"]}

        all_gl = len(devices["gl"])
        told = held(lambda document: None, 0, {})
        if told["fixed.gl"] != "%d digests are the baseline's" % all_gl:
            problems.append("same: %s" % told)
        two = kept("gl", **{"mip nearest": "0" * 16, "stencil": "1" * 16})
        told = held(two, 1, {"fixed/mip-nearest.gl": "differs", "fixed/stencil.gl": "differs"})
        if told["fixed.gl"] != "%d digests are the baseline's, and 2 are not" % (all_gl - 2) or \
                told["fixed/stencil.gl"] != "%s and not %s, which is the baseline's" % (devices["gl"]["stencil"], "1" * 16):
            problems.append("two: %s" % told)
        known = files.path("known.txt", "".join(
            "fail fixed/%s\n  device gl\n  outcome fail\n  reason it is another unit\n  since 2026-01-01\n  until %s\n" % (feature, LATER)
            for feature in ("stencil", "linear")))
        held(two, 1, {"fixed/mip-nearest.gl": "differs", "fixed/stencil.gl": "expected failure", "fixed/linear.gl": "unexpected pass"},
             "--expectations", known)
        told = held(moved("cpu", "another processor"), 0, {"fixed.gl": "skipped"})
        if not told["fixed.gl"].startswith("%d digests are not compared: cpu " % all_gl):
            problems.append("another processor: %s" % told)
        width = next(d for d in document["devices"] if d["name"] == "gl")["of"]["device"]
        held(moved("device", re.sub(r"\d+ bits", "512 bits", width)), 0, {"fixed.gl": "skipped"})
        held(moved("device", re.sub(r"LLVM [\d.]+", "LLVM 1.2", width)), 0, {})
        held(moved("driver", "another Mesa"), 0, {})
        problems += updates(runner, files, change(path, two, files.path("edited.json")))
    return problems


def updates(runner, files, path):
    """An update prints each digest that is another."""
    result = runner.run(["baseline", "--device", "cpu,gl,vulkan", "--pictures", "--cells", files.cells, "-o", path])
    lines = ["~ fixed function '%s' of gl: another digest" % feature for feature in ("mip nearest", "stencil")]
    missing = [line for line in lines if line not in result.stdout.splitlines()]
    return ["update: exit status %d, %s" % (result.returncode, result.stdout)] if missing or result.returncode != 1 else []


def other_driver(runner, files, *settings):
    """A device whose driver is another library, in front of lavapipe."""
    path = files.path("driver.json")
    with open(path, "w") as file:
        json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": runner.misbehaver, "api_version": "1.1.0"}}, file)
    return "new=vulkan@" + ";".join(["VK_DRIVER_FILES=" + path, *settings])


def check_drivers(runner):
    """a gate of two drivers holds the digests of one against the other's: those that the APIs let differ are told and pass, unless the gate
    is strict; the others fail, unless expectations name them"""
    problems = []
    if not passport(runner, "vulkan").get("fixed_functions"):
        return problems
    with Files(TORUS) as files:
        new = other_driver(runner, files)

        def held(built, *args, status=None, device=new):
            """Gates lavapipe against itself behind another library, which may be built with a setting that its name does not tell."""
            env = {"XDG_CACHE_HOME": files.path("cache" + built)}  # Mesa keeps code of all settings side by side
            result = runner.run(["gate", "vulkan", device, "--pictures", "--json", "--cells", files.cells, *args], dict(env, RG_DRIVER_AS=built) if built else env)
            report = json.loads(result.stdout)
            told = {case["name"]: (case["ending"], case["message"]) for case in report["gated"] if case["technique"] == "fixed"}
            if result.returncode != status:
                problems.append("%s, %s: exit status %d, %s, %s" % (built, args, result.returncode, told, result.stderr))
            return told

        found = held("", status=0)
        count = len(passport(runner, "vulkan")["fixed_functions"])
        if found != {"fixed.new": ("pass", "%d digests are vulkan's" % count)}:
            problems.append("the same: %s" % found)
        found = held("LP_PERF=no_linear", status=1)
        if found["fixed/linear.new"][0] != "differs" or ", which is vulkan's" not in found["fixed/linear.new"][1] or ", and " not in found["fixed.new"][1]:
            problems.append("far: %s" % found)
        wrong = sorted(name[:-len(".new")] for name, (ending, _) in found.items() if ending == "differs")
        known = files.path("known.txt", "".join(
            "fail %s\n  device new\n  outcome fail\n  reason it does not filter\n  since 2026-01-01\n  until %s\n" % (name, LATER) for name in wrong))
        found = held("LP_PERF=no_linear", "--expectations", known, status=0)
        if not {"pass", "expected failure"} >= {ending for ending, _ in found.values()}:
            problems.append("expected: %s" % found)
        # Another way to mix texels rounds otherwise.
        other = "GALLIVM_PERF=no_aos_sampling"
        found = held(other, status=0)
        near = {name for name, (_, message) in found.items() if message == "differs from vulkan's, and both are within bounds"}
        if not {"fixed/linear.new", "fixed/array-layers.new"} <= near or any(found[name][0] != "pass" for name in near) or \
                not re.search("digests are vulkan's, %d differ as the APIs allow$" % len(near), found["fixed.new"][1]):
            problems.append("near: %s" % found)
        found = held(other, "--strict", status=1)
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
        if fallen.returncode != 1 or told != {"raster/torus.vulkan": "pass", "fixed.vulkan": "error"}:
            problems.append("a first driver that falls: exit status %d, %s, %s" % (fallen.returncode, told, fallen.stderr))
        names = runner.run(["gate", "vulkan", new, "--cells", files.cells, "--gtest_list_tests"]).stdout
        if "fixed" not in names or "fixed" in runner.run(["gate", "vulkan", "vulkan@LP_PERF=no_blend", "--cells", files.cells, "--gtest_list_tests"]).stdout:
            problems.append("listed: %s" % names)
    return problems


CHECKS = [check_digests, check_apis, check_switches, check_bounds, check_none, check_text, check_page, check_crash, check_gives_up, check_kept, check_drivers]
