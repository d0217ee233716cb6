"""baseline, and gate --baseline: a baseline keeps what cells did, and later runs are compared with it."""
import ctypes
import ctypes.util
import json
import os
import re
import subprocess
import tempfile

import forms
import misbehaving
from gates import AT_ONCE, SCHEMA, KNOT, Files, endings, needed_s
from wrong import turned_kernels

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
KEPT = os.path.join(ROOT, "results", "baseline.json")
CELLS = os.path.join(ROOT, "harness", "compare", "gate", "cells", "cells.txt")

PANE = "flow/pane flow 64x48 2 view=pane resolution_px=64 environment_px=16\n"
CPU = ["--device", "cpu"]
QUICK = ["--launches", "8"]

# Factors for a baseline's times. While other tests run, a launch of a few triangles takes ten times as long, and two
# threads that wake each other take thirty times as long, so the factors are far larger.
CHANGE, YARDSTICK_CHANGE, BUSY = 1e6, 1e3, 1e2


def is_about(change, ratio):
    """Whether a ratio shows the change, however busy the machine was then and is now."""
    return change / BUSY < ratio < change * BUSY


def checksum(document):
    """The checksum by harness/record/disk/seal.c: XXH3 of the compact text with sorted names and numbers of nine digits."""
    jansson = ctypes.CDLL(ctypes.util.find_library("jansson"))
    jansson.json_loads.restype = ctypes.c_void_p
    jansson.json_dumps.restype = ctypes.c_void_p
    jansson.json_dumps.argtypes = [ctypes.c_void_p, ctypes.c_size_t]
    loaded = jansson.json_loads(json.dumps(document).encode(), ctypes.c_size_t(0), None)
    compact, sort_keys, digits = 0x20, 0x80, 9 << 11
    text = ctypes.string_at(jansson.json_dumps(loaded, compact | sort_keys | digits))
    xxhash = ctypes.CDLL(ctypes.util.find_library("xxhash"))
    xxhash.XXH3_64bits.restype = ctypes.c_uint64
    return "%016x" % xxhash.XXH3_64bits(text, ctypes.c_size_t(len(text)))


def change(path, edit, to=None):
    """Changes a baseline, and its checksum accordingly."""
    with open(path) as file:
        document = json.load(file)
    del document["checksum"]
    edit(document)
    document["checksum"] = checksum(document)
    with open(to or path, "w") as file:
        json.dump(document, file)
    return to or path


def make(runner, files, *more, device="cpu", name="baseline.json"):
    path = files.path(name)
    result = runner.run(["baseline", "--device", device, "--cells", files.cells, "-o", path] + list(more))
    if result.returncode or result.stderr:
        raise ValueError("baseline: exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
    return path, result.stdout


def gate(runner, files, path, *more, env={}):
    """A gate without times, so that it gives the same every time, unless `more` has a budget or a margin."""
    args = list(more) if "--budget" in more or "--margin" in more else ["--pictures"] + list(more)
    for _ in range(4):  # a hypervisor may have taken its time from most launches
        result = runner.run(["gate", "--baseline", path, "--cells", files.cells, "--json"] + args, env)
        if not re.search("gave its time to others|launches \d+ were disturbed", result.stdout):
            break
    return result


def check_same(runner):
    """a device agrees with its baseline, which has the documented form, and its keys are printed"""
    problems = []
    with Files() as files:
        path, printed = make(runner, files, *QUICK)
        with open(path) as file:
            document = json.load(file)
        problems += forms.problems("baseline", document)
        rows = document["baseline"]
        if not re.fullmatch(r"cpu: key [0-9a-f]{16}; a launch scatters by [\d.]+ %\n.*: 2 cells on 1 device\n", printed) or len(rows) != 2:
            problems.append("%s, %d rows" % (printed, len(rows)))
        if any(len(row["launches_ms"]) != 8 or row["outcome"] != "ok" or len(row["picture"]) != 16 for row in rows):
            problems.append("rows: %s" % rows)
        if not any(row["states"] for row in rows) or not any(row["counters"] for row in rows):
            problems.append("no row has states, or none has counters")
        nothing = "2d06800538d394c2"  # XXH3 of no byte
        if any(nothing in (row["picture"], row["settings"], *row["states"].values()) for row in rows):
            problems.append("a digest is of nothing: %s" % rows)
        result = gate(runner, files, path)
        report = json.loads(result.stdout)
        problems += forms.problems("gate", report)
        if result.returncode or endings(report) != {"raster/knot.cpu": "pass", "flow/pane.cpu": "pass"}:
            problems.append("exit status %d, %s%s" % (result.returncode, result.stderr, endings(report)))
        told = runner.run(["gate", "--baseline", path, "--cells", files.cells, "--pictures"])
        key = document["devices"][0]["key"]
        if "cpu: key %s, as the baseline's\n" % key not in told.stdout:
            problems.append("told: %s" % told.stdout)
        if key not in report["passport_text"]:
            problems.append("passport: %s" % report["passport_text"])
    return problems


def check_few(runner):
    """under RG_FEW_SAMPLES a launch has three timings of a cell, which else has more"""
    def timings(name, value):
        path = files.path(name)
        runner.run(["baseline", *CPU, "--cells", files.cells, "-o", path, *QUICK], {"RG_FEW_SAMPLES": value, "OMP_NUM_THREADS": "1"})
        with open(path) as file:
            return json.load(file)["baseline"][0]["timings"]

    with Files("raster/knot raster 16x16 1 scene=triangles triangles=1000\n") as files:
        few = timings("few.json", "1")
        # A busy machine may take milliseconds for a frame, and then three timings are enough.
        more = any(timings("%d.json" % i, None) > 3 for i in range(6))
    return [] if few == 3 and more else ["timings: %d, or %s" % (few, "more" if more else "as few")]


def check_timed(runner):
    """times under the same key get verdicts; a million times slower is found, whether cells or the baseline are"""
    with Files(KNOT) as files:
        path, _ = make(runner, files, *QUICK)
        cases = {}
        for name, factor in (("same", 1), ("slower", 1 / CHANGE), ("faster", CHANGE)):
            def scale(document, factor=factor):
                for row in document["baseline"]:
                    row["launches_ms"] = [ms * factor for ms in row["launches_ms"]]
            kept = ["-o", files.path("kept")] if name == "slower" else []  # its journal changes no verdict
            result = gate(runner, files, change(path, scale, files.path("scaled.json")), "--budget", "1m", *kept)
            cases[name] = result.returncode, json.loads(result.stdout)["gated"][0]
    problems = []
    status, case = cases["same"]  # this test does not judge how fast the machine is now
    if status not in (0, 1, 3) or case["ending"] not in ("pass", "inconclusive", "regressed", "improved") or not case["ratio"]["value"]:
        problems.append("same: exit status %d, %s" % (status, case))
    if "key is another" in case["message"] or "launches" not in case["details"] or case["baseline_ms"] is None:
        problems.append("same: %s" % case)
    status, case = cases["slower"]
    if status != 1 or case["ending"] != "regressed" or not is_about(CHANGE, case["ratio"]["value"]) or not case["ratio"]["low"] > 1 or not re.search(
            r": baseline [\d.]+ ms, now [\d.]+ ms$", case["message"]):
        problems.append("slower: exit status %d, %s" % (status, case))
    status, case = cases["faster"]
    if status or case["ending"] != "improved" or not is_about(1 / CHANGE, case["ratio"]["value"]) or not case["ratio"]["high"] < 1:
        problems.append("faster: exit status %d, %s" % (status, case))
    return problems


def check_changes(runner):
    """a changed digest, counter or count of work is found and named; an ending as in the baseline is not hidden"""
    problems = []

    def state(row):
        row["states"] = {name: "0123456789abcdef" for name in row["states"]}

    def counter(row):
        row["counters"] = {name: value + 1 for name, value in row["counters"].items()}

    def work(row):
        row["work"]["items"] += 1

    def picture(row):
        row["picture"] = "0123456789abcdef"

    def elsewhere(document):
        for row in document["baseline"]:
            work(row)
        document["passport"]["raingauge"]["libraries"]["glibc"] = "2.0"

    def fell(row):
        row.update(outcome="crash", why="it fell", picture="", states={}, counters={}, launches_ms=[])

    def wrong(row):
        row.update(outcome="fail", why="the picture differs")

    with Files(PANE) as files:
        path, _ = make(runner, files, "--pictures")
        for edit, ending, says in ((state, "differs", "has digest"), (counter, "differs", "the counter '"),
                                   (work, "differs", "items"),
                                   (picture, "pass", "holds T0 against cpu:reference as it draws now"),
                                   (fell, "pass", "the baseline has it as crash"), (wrong, "pass", "")):
            edited = change(path, lambda d, edit=edit: [edit(row) for row in d["baseline"]], files.path("edited.json"))
            result = gate(runner, files, edited)
            case = json.loads(result.stdout)["gated"][0]
            if case["ending"] != ending or says not in case["message"] or result.returncode != (ending != "pass"):
                problems.append("%s: exit status %d, %s" % (edit.__name__, result.returncode, case))
            if ending == "differs" and "what raingauge computes" not in case["details"]:
                problems.append("%s: details: %s" % (edit.__name__, case["details"]))
        edited = change(path, elsewhere, files.path("edited.json"))
        case = json.loads(gate(runner, files, edited).stdout)["gated"][0]
        if "the host computes with, glibc" not in case["details"] or "and not 2.0, and not how" not in case["details"]:
            problems.append("libraries: details: %s" % case["details"])
    return problems


def check_miscompiled(runner):
    """a kernel with another constant is found by its picture, blamed on its stage, and cpu:reference's picture is kept beside it"""
    with Files() as files:
        path, _ = make(runner, files, "--pictures", device="gl,cpu")
        kernels = turned_kernels(runner)
        result = gate(runner, files, path, "-o", files.path("pictures"), env={"RG_KERNEL_DIR": kernels})
        kept = sorted(re.sub("^.*-", "", name) for name in os.listdir(files.path("pictures")) if name.startswith("flow_pane"))
        found = {case["name"]: case for case in json.loads(result.stdout)["gated"]}
        known = files.path("known.txt", "fail flow/*\n  device gl\n  outcome fail\n  reason turned\n  since 2026-11-01\n"
                           "  until 2099-01-01\n")
        expected = gate(runner, files, path, "--expectations", known, env={"RG_KERNEL_DIR": kernels})
        only = gate(runner, files, path, "--device", "cpu", env={"RG_KERNEL_DIR": kernels})
        wrong = runner.run(["baseline", "--device", "gl", "--cells", files.cells, "--pictures", "-o", files.path("wrong.json")],
                           {"RG_KERNEL_DIR": kernels})
        again = gate(runner, files, files.path("wrong.json"), env={"RG_KERNEL_DIR": kernels})
    problems = []
    if result.returncode != 1 or {n: c["ending"] for n, c in found.items()} != {
            "raster/knot.gl": "pass", "flow/pane.gl": "differs", "fixed.gl": "pass", "raster/knot.cpu": "pass", "flow/pane.cpu": "pass"}:
        problems.append("exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
    if kept != ["a.exr", "a.png", "b.exr", "b.png", "difference.png", "flip.png"]:
        problems.append("pictures: %s" % kept)
    if "stage flow_normals" not in found["flow/pane.gl"]["details"] or "picture differs" not in found["flow/pane.gl"]["message"]:
        problems.append("%s" % found["flow/pane.gl"])
    if expected.returncode or "expected failure" not in endings(json.loads(expected.stdout)).values():
        problems.append("expected: exit status %d, %s" % (expected.returncode, expected.stdout))
    if only.returncode or set(endings(json.loads(only.stdout))) != {"raster/knot.cpu", "flow/pane.cpu"}:
        problems.append("--device cpu: %s" % only.stdout)
    # A baseline by a driver that draws wrongly does not make its pictures right.
    if wrong.returncode != 1 or "flow/pane.gl: fail: the picture differs" not in wrong.stdout:
        problems.append("wrong: exit status %d, %s" % (wrong.returncode, wrong.stdout))
    if again.returncode != 1 or endings(json.loads(again.stdout))["flow/pane.gl"] != "differs":
        problems.append("again: exit status %d, %s" % (again.returncode, again.stdout))
    return problems


def wrong_advice(slower, least, most, details):
    """Problems of advice: a frame's ratio by itself, and by the yardsticks, which show how much of it is the machine's."""
    lines = re.findall(r"^(\w+) takes ([\d.]+) times as long: ([\d.]+) by it$", details, re.M)
    problems = [] if [name for name, _, _ in lines] == ["chain", "vector", "copy", "fork_join"] else ["yardsticks: %s" % details]
    for name, machine, by_it in ((name, float(machine), float(by_it)) for name, machine, by_it in lines):
        if not is_about(YARDSTICK_CHANGE, machine) or abs(by_it - slower / machine) > 0.01 + 0.01 * by_it / machine:
            problems.append("%s: %g times as long, of which the machine is %g: %g" % (name, slower, machine, by_it))
    if not is_about(CHANGE, slower) or [least, most] != sorted(float(by_it) for _, _, by_it in lines)[::3]:
        problems.append("%g times as long, %g to %g by the yardsticks: %s" % (slower, least, most, details))
    return problems


def check_advice(runner):
    """under another key, times become advice by the yardsticks, and fail nothing"""
    problems = []

    def other(document):
        for device in document["devices"]:
            device["of"]["cores"] = "64"
        for row in document["baseline"]:
            row["launches_ms"] = [ms / CHANGE for ms in row["launches_ms"]]
        for name in document["yardsticks_ms"]:
            document["yardsticks_ms"][name] = [ms / YARDSTICK_CHANGE for ms in document["yardsticks_ms"][name]]

    with Files(KNOT) as files:
        path, _ = make(runner, files, *QUICK)
        change(path, other)
        result = runner.run(["gate", "--baseline", path, "--cells", files.cells])
        if result.returncode or "so that times are advisory: cores 2" not in re.sub(r"cores \d+", "cores 2", result.stdout):
            problems.append("exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
        case = json.loads(gate(runner, files, path, "--budget", "1m").stdout)["gated"][0]
        told = re.search(r"advisory, for its key is another: a frame takes ([\d.]+) times as long \(.*\), and ([\d.]+) to ([\d.]+) "
                         r"times by the yardsticks", case["message"])
        if case["ending"] != "pass" or case["ratio"]["value"] is not None or not told:
            problems.append("%s" % case)
        else:
            problems += wrong_advice(*map(float, told.groups()), case["details"])
    return problems


def refuse(runner, args, says):
    result = runner.run(args)
    if result.returncode != 2 or result.stdout or result.stderr.count("\n") != 1 or says not in result.stderr:
        return ["%s: exit status %d, %s%s" % (args, result.returncode, result.stdout, result.stderr)]
    return []


def check_refused(runner):
    """a baseline that is missing, damaged, foreign or of another version is an error, for the gate and for updates"""
    problems = []
    with Files() as files:
        path, _ = make(runner, files, "--pictures")
        with open(path) as file:
            text = file.read()
        bad = {
            "cut.json": (text[:len(text) // 2], "cut.json: line "),
            "edited.json": (text.replace('"outcome": "ok"', '"outcome": "fail"', 1), "its checksum is wrong"),
            "more.json": (text + text, "goes on after its end"),
            "foreign.json": ('{"format": 1, "table": "creus-5.4", "cells": []}', "is no baseline"),
            "list.json": ("[1, 2]", "is no baseline"),
            "notes.txt": ("a line\n", "line 1 is no JSON"),
            "newer.json": (text.replace('"format": 1', '"format": 2', 1), "format is 2, and this raingauge reads 1"),
            "empty.json": ("", "is no JSON"),
        }
        for name, (content, says) in bad.items():
            there = files.path(name, content)
            problems += refuse(runner, ["gate", "--baseline", there, "--cells", files.cells], says)
            problems += refuse(runner, ["baseline", "--device", "cpu", "--cells", files.cells, "-o", there, "--update"], says)
            with open(there) as file:
                if file.read() != content:
                    problems.append("%s is another" % name)
        twice = change(path, lambda d: d["baseline"].append(d["baseline"][0]), files.path("twice.json"))
        problems += refuse(runner, ["gate", "--baseline", twice, "--cells", files.cells], "stands there twice")
        problems += refuse(runner, ["gate", "--baseline", files.path("none.json"), "--cells", files.cells], "none.json: ")
        problems += refuse(runner, ["gate", "--baseline", path, "--cells", files.cells, "cpu"], "--baseline has pairs of its own")
        problems += refuse(runner, ["gate", "--baseline", path, "--cells", files.cells, "--device", "gl"], "has no such device")
        problems += refuse(runner, ["gate", "cpu", "cpu", "--device", "cpu"], "--device is of --against and --baseline")
        problems += refuse(runner, ["baseline", "--device", "cpu"], "name the file to write")
        problems += refuse(runner, ["baseline", "--device", "cpu", "-o", files.path("none/b.json")], "none/b.json")
        problems += refuse(runner, ["baseline", "--device", "cpu,cpu", "--pictures", "--cells", files.cells, "-o", files.path("two.json")],
                           "--device: 'cpu' stands there twice")
        more = files.path("more.txt", KNOT + PANE + "new raster 32x32 1\n")
        problems += refuse(runner, ["gate", "--baseline", path, "--cells", more], "has no cell 'new' of ")
        fewer = files.path("fewer.txt", KNOT)
        problems += refuse(runner, ["gate", "--baseline", path, "--cells", fewer], "its cell 'flow/pane' is not in ")
        other = files.path("other.txt", KNOT.replace("=1000", "=2000") + PANE)
        result = runner.run(["gate", "--baseline", path, "--cells", other])
        if result.returncode != 2 or path not in result.stderr or "other.txt:1 has" not in result.stderr:
            problems.append("other settings: %s" % result.stderr)
    return problems


def check_update(runner):
    """an update lists its changes, a line a cell, and writes the whole file only on request"""
    problems = []
    with Files() as files:
        path, _ = make(runner, files, "--pictures")

        def run(cells, *more):
            return runner.run(["baseline", "--device", "cpu", "--pictures", "--cells", cells, "-o", path] + list(more))

        def content():
            with open(path) as file:
                return file.read()

        before = content()
        for more in ((), ("--update",)):
            result = run(files.cells, *more)
            if result.returncode or "nothing changes" not in result.stdout or content() != before:
                problems.append("same %s: exit status %d, %s" % (more, result.returncode, result.stdout))
        cells = files.path("other.txt", KNOT.replace("=1000", "=2000") + "new raster 64x48 2 scene=triangles triangles=1000\n")
        result = run(cells)
        lines = result.stdout.splitlines()
        if result.returncode != 1 or content() != before or result.stderr:
            problems.append("told: exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
        if len(lines) != 5 or not re.fullmatch(r"~ raster/knot\.cpu: other settings, another picture, .*a frame and not \d+", lines[1]) \
                or lines[2] != "+ new.cpu: new" or lines[3] != "- flow/pane.cpu: gone" or "3 changes; it is as it was" not in lines[4]:
            problems.append("lines: %s" % lines)
        full = runner.run(["baseline", "--device", "cpu", "--pictures", "--cells", cells, "-o", path, "--update"], limit=200)
        if full.returncode != 71 or content() != before:
            problems.append("full disk: exit status %d, %s" % (full.returncode, full.stderr))
        result = run(cells, "--update")
        if result.returncode or content() == before or "2 cells on 1 device" not in result.stdout:
            problems.append("written: exit status %d, %s" % (result.returncode, result.stdout))
        result = runner.run(["gate", "--baseline", path, "--cells", cells, "--pictures"])
        if result.returncode or sorted(os.listdir(files.folder.name)) != ["baseline.json", "cells.txt", "other.txt"]:
            problems.append("gate: exit status %d, %s, %s" % (result.returncode, result.stdout, os.listdir(files.folder.name)))
        for edit, says in ((lambda d: d["devices"][0]["of"].update(cores="64"), "~ cpu: another key: cores "),
                           (lambda d: d["baseline"][0].update(outcome="crash", why="it fell"), "ok and not crash"),
                           (lambda d: d["baseline"][0]["work"].update(items=7), " items a frame and not 7")):
            edited = change(path, edit, files.path("edited.json"))
            result = runner.run(["baseline", "--device", "cpu", "--pictures", "--cells", cells, "-o", edited])
            if result.returncode != 1 or says not in result.stdout:
                problems.append("%s: exit status %d, %s" % (says, result.returncode, result.stdout))
    return problems


def check_fallen(runner):
    """an update leaves the file unchanged if a driver crashes while its device is opened"""
    with Files() as files, tempfile.TemporaryDirectory() as folder:
        path, _ = make(runner, files, "--pictures", device="cpu,vulkan")
        with open(path) as file:
            before = file.read()
        env = misbehaving.shim(runner, folder, "vulkan", "vkCreateDevice", "fault", 0)
        result = runner.run(["baseline", "--pictures", "--cells", files.cells, "-o", path, "--update"], env)
        with open(path) as file:
            stays = file.read() == before
    if result.returncode != 1 or not stays or "stays as it is, for it would lose what it has of the device whose driver fell" not in result.stderr:
        return ["exit status %d, stays %s, %s%s" % (result.returncode, stays, result.stdout, result.stderr)]
    return []


def check_meanwhile(runner):
    """a file that another process writes while a baseline is made stays, since nobody was shown those changes"""
    problems = []
    with Files(KNOT) as files:
        path, _ = make(runner, files, "--pictures")
        written, worker = files.path("written.json"), files.path("worker.sh", '#!/bin/sh\ncp "$WRITTEN" "$TO"\nexec "%s" "$@"\n' % runner.raingauge)
        os.rename(path, written)
        os.chmod(worker, 0o755)
        args = ["baseline", "--device", "cpu@RG_PROGRAM=" + worker, "--pictures", "--cells", files.cells, "-o", path]
        for more in ([], ["--update"]):
            result = runner.run(args + more, {"WRITTEN": written, "TO": path})
            with open(path) as file, open(written) as other:
                stays = file.read() == other.read()
            if result.returncode != 1 or not stays or "was written by another meanwhile" not in result.stderr:
                problems.append("%s: exit status %d, stays %s, %s" % (more, result.returncode, stays, result.stderr))
    return problems


def check_forms(runner):
    """a baseline's gate has all forms for CI: JUnit, Bencher's, googletest's, GitHub's"""
    problems = []
    with Files() as files:
        path, _ = make(runner, files, *QUICK)
        args = ["gate", "--baseline", path, "--cells", files.cells]
        junit, bmf = files.path("junit.xml"), files.path("bmf.json")
        runner.run(args + ["--budget", "0.2s", "--junit", junit, "--bmf", bmf, "--github"])
        lint = subprocess.run(["xmllint", "--noout", "--schema", SCHEMA, junit], capture_output=True, text=True, check=False)
        if lint.returncode or not os.path.exists(bmf):
            problems.append(lint.stderr)
        listed = runner.run(args + ["--gtest_list_tests"])
        ran = runner.run(args + ["--pictures", "--gtest_filter=flow*"])
        if listed.returncode or not re.fullmatch(r"raster_knot\.\n  cpu_\w{16}\nflow_pane\.\n  cpu_\w{16}\n", listed.stdout):
            problems.append("listed: %s" % listed.stdout)
        if ran.returncode or not re.search(r"\[       OK \] flow_pane\.cpu_\w{16} \(", ran.stdout) or "knot" in ran.stdout:
            problems.append("ran: %s" % ran.stdout)
        if "key" in ran.stdout:
            problems.append("a runner of googletest would read: %s" % ran.stdout)
    return problems


def check_absent(runner):
    """a device that is missing differs, and one whose driver crashes fails its own cells"""
    with Files(KNOT) as files:
        path, _ = make(runner, files, "--pictures", device="cpu,vulkan")
        absent = gate(runner, files, path, env={"VK_DRIVER_FILES": "/nonexistent"})
        fallen = gate(runner, files, path, env=runner.crashing_vulkan(files.folder.name))
        kept = runner.run(["baseline", "--pictures", "--cells", files.cells, "-o", files.path("kept.json")],
                          env=runner.crashing_vulkan(files.folder.name))
    problems = []
    if kept.returncode != 1 or kept.stderr.count("\n") != 1 or "on 4 devices" not in kept.stdout:
        problems.append("made: exit status %d, %s%s" % (kept.returncode, kept.stdout, kept.stderr))
    if absent.returncode != 1 or endings(json.loads(absent.stdout)) != {"raster/knot.cpu": "pass", "raster/knot.vulkan": "differs",
                                                                    "fixed.vulkan": "unsupported"}:
        problems.append("exit status %d, %s" % (absent.returncode, absent.stdout))
    if fallen.returncode != 1 or endings(json.loads(fallen.stdout)) != {"raster/knot.cpu": "pass", "raster/knot.vulkan": "crash",
                                                                    "fixed.vulkan": "unsupported"}:
        problems.append("exit status %d, %s" % (fallen.returncode, fallen.stdout))
    return problems


def check_long(runner):
    """a baseline with many frames makes no gate longer than its budget; a budget too short to decide anything is refused"""
    def lengthen(document):
        for row in document["baseline"][-1:]:
            row["frames"], row["timings"] = 1000, 9  # 27000 frames a launch

    problems = []
    slow = "flow/slow flow 256x192 2 view=pane resolution_px=256 environment_px=16\n"
    for cells, status in ((slow, 2), (KNOT + slow, 3)):
        with Files(cells) as files:
            path, _ = make(runner, files, *QUICK)
            change(path, lengthen)
            for budget in (6, 18, 54):  # a slow machine needs more for a first look at the other cell
                result = gate(runner, files, path, "--budget", "%ds" % budget, *AT_ONCE)
                if status == 2 or not result.stderr:
                    break
        cases = json.loads(result.stdout)["gated"]
        said = needed_s(result) if status == 2 else not result.stderr
        if result.returncode != status or not said or cases[-1]["message"] != "the time was over before it was decided" or (
                "launches" in cases[-1]["details"]):
            problems.append("exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
    return problems


def check_untimed(runner):
    """a gate of times refuses a baseline without them, and compares nothing"""
    with Files(KNOT) as files:
        path, _ = make(runner, files, "--pictures")
        result = runner.run(["gate", "--baseline", path, "--cells", files.cells, "--budget", "1s"])
    said = re.fullmatch(r"raingauge: .*baseline\.json: has no times of what is asked; give --pictures, or make it anew .*\n", result.stderr)
    return [] if result.returncode == 2 and said and not result.stdout else [
        "exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]


def check_spared(runner):
    """no report of a gate replaces a file that the gate reads, by whatever name"""
    problems = []
    with Files(KNOT) as files:
        path, _ = make(runner, files, "--pictures")
        known, skips, link = files.path("known.txt", "# none\n"), files.path("skips.txt", "# none\n"), files.path("link")
        os.symlink(path, link)
        read = ["--baseline", path, "--cells", files.cells, "--expectations", known, "--skips", skips, "--pictures"]
        kept = {"-o": files.path("gate.journal", KNOT)}  # the gate's own journal in that folder
        for option, report in (("--junit", path), ("--bmf", path), ("--bmf", link), ("--junit", files.cells), ("--bmf", known), ("--junit", skips),
                               ("-o", kept["-o"])):
            with open(report, "rb") as file:
                before = file.read()
            target = os.path.dirname(report) if option in kept else report
            result = runner.run(["gate", option, target] + [kept.get(option, word) if word == files.cells else word for word in read])
            with open(report, "rb") as file:
                stays = file.read() == before
            if result.returncode != 2 or not stays or not re.fullmatch("raingauge: .*: would be overwritten with a report, .*\n", result.stderr):
                problems.append("%s %s: exit status %d, stays %s, %s" % (option, report, result.returncode, stays, result.stderr))
    return problems


def check_kept(runner):
    """built-in cells on cpu, gl and vulkan have the pictures, states and counters of the repository's baseline"""
    result = runner.run(["gate", "--baseline", KEPT, "--pictures", "--json"])
    report = json.loads(result.stdout)
    found = {case["name"]: case for case in report["gated"]}
    fixed = {name: found.pop("fixed." + name, {"ending": "missing"}) for name in ("gl", "vulkan")}
    told = ["%s: %s, %s" % (name, case["ending"], case["message"]) for name, case in found.items() if case["ending"] != "pass" or case["message"]]
    # Digests of fixed functions are compared on a processor of the same model alone.
    told += ["fixed.%s: %s" % item for item in fixed.items() if item[1]["ending"] not in ("pass", "skipped")]
    missing = [name for line in open(CELLS, encoding="utf-8") if line.strip() and not line.startswith("#")
               for device in ("cpu", "gl", "vulkan") for name in ["%s.%s" % (line.split()[0], device)] if name not in found]
    if result.returncode or told or missing:
        return ["exit status %d, %s, missing: %s, %s" % (result.returncode, told, missing, result.stderr)]
    return []


def check_short_names(runner):
    """the command line must say which device a baseline's short name means; otherwise nothing runs"""
    problems = []
    with Files(KNOT) as files:
        path, _ = make(runner, files, "--pictures", device="g=cpu@OMP_NUM_THREADS=1")
        for args in ([], ["--device", "all"]):
            result = gate(runner, files, path, *args)
            says = "its device 'g' is a short name, and the file does not say of what; add --device g=DEVICE with all that are to run\n"
            if result.returncode != 2 or result.stdout or not result.stderr.endswith(says) or result.stderr.count("\n") != 1:
                problems.append("%s: exit status %d, %s%s" % (args, result.returncode, result.stdout, result.stderr))
        result = gate(runner, files, path, "--device", "g=cpu@OMP_NUM_THREADS=1")
        if result.returncode or endings(json.loads(result.stdout)) != {"raster/knot.g": "pass"}:
            problems.append("named: exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
    return problems


CHECKS = [check_same, check_short_names, check_few, check_timed, check_changes, check_miscompiled, check_advice, check_refused, check_update, check_fallen, check_meanwhile, check_long, check_forms,
          check_absent, check_untimed, check_spared, check_kept]
