"""render's and diff's output about pictures, and every command whose output cannot be written."""
import json
import math
import os
import re
import shutil
import struct
import subprocess
import tempfile

import forms
from cases import DIFF, RENDER, SMALL_STAGES, SMALL_TABLE
from machine import lacking, run_json


def check_render_json(runner):
    """render --json describes its picture, with every parameter's value"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        record, status, problems = run_json(runner, RENDER + "-o %s/a.png" % tmp)
        problems += lacking("render", record, {"format": int, "settings": dict, "facts": dict, "counters": dict, "passport": dict})
        found = tuple(record.get(key) for key in ("file", "technique", "device", "width", "height", "frame"))
        if status or found != (tmp + "/a.png", "flow", "cpu", 32, 32, 1):
            problems.append("exit status %d, %s" % (status, found))
    params = json.loads(runner.run("list params flow --json".split()).stdout)["params"]
    if [param["name"] for param in params] != list(record["settings"]) or record["settings"]["resolution_px"] != "32":
        problems.append("settings: %s" % record["settings"])
    return problems


def problems_shown(runner, techniques):
    """Problems of what render draws of techniques without options."""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        shown = os.path.join(tmp, "shown.png")
        again = os.path.join(tmp, "again.png")
        for technique in techniques:
            lines = runner.run(["render", technique, "-o", shown]).stdout.splitlines()
            if len(lines) != 2 or not lines[1].startswith("  as by --"):
                problems.append("%s: %s" % (technique, lines))
                continue
            told = runner.run(["render", technique, "-o", again] + lines[1].split()[2:]).stdout.splitlines()
            if [lines[0].replace(shown, again)] != told or not same_bytes(shown, again):
                problems.append("%s: drew %s, then %s" % (technique, lines, told))
    return problems


def check_shown(runner):
    """without options render draws the picture that shows a technique, and says by which options; one of them alone is of the defaults"""
    problems = problems_shown(runner, ("raster", "cartoon"))
    with tempfile.TemporaryDirectory() as tmp:
        for args, of in ((["--frame", "3"], ", frame 3, 512x512, "), (["--size", "32x16"], ", frame 60, 32x16, "), (["--set", "seed=2"], ", frame 60, 512x512, ")):
            told = runner.run(["render", "raster", "-o", os.path.join(tmp, "picture.png")] + args).stdout.splitlines()
            if len(told) != 1 or of not in told[0]:
                problems.append("%s: %s" % (args, told))
    return problems


def check_shown_for_long(runner):
    """without options render draws the picture that shows drops, which takes many frames"""
    return problems_shown(runner, ("drops",))


def same_bytes(*paths):
    contents = set()
    for path in paths:
        with open(path, "rb") as file:
            contents.add(file.read())
    return len(contents) == 1


FOREIGN = os.fsdecode(b"cpu@N=\xff\x1b[2J")  # not UTF-8, and a sequence that clears a terminal


def check_foreign(runner):
    """a device's name that is not UTF-8 has question marks in every machine form, and controls no terminal"""
    problems, marked = [], "cpu@N=?\x1b[2J"
    with tempfile.TemporaryDirectory() as tmp:
        for args, named in ((RENDER + "-o %s/a.png" % tmp, lambda told: [told["device"], told["passport"]["devices"][0]["name"]]),
                            (SMALL_STAGES.replace("--device cpu ", ""), lambda told: [check["device"] for check in told["checks"]]),
                            (DIFF.replace("--device cpu,cpu:reference ", ""), lambda told: [told["pairs"][0]["b"]]),
                            (SMALL_TABLE.replace("--device cpu ", ""), lambda told: [cell["device"] for cell in told["cells"]])):
            both = "cpu:reference," if args.startswith("diff") else ""
            done = runner.run(args.split() + ["--json", "--device", both + FOREIGN])
            names = {name.replace("?[2J", "\x1b[2J") for name in named(json.loads(done.stdout or "null"))} if done.stdout.strip() else None
            if done.returncode or done.stderr or names != {marked}:
                problems.append("%s: exit status %d, named %s, %s" % (args, done.returncode, names, done.stderr))
        text = runner.run(RENDER.split() + ["-o", tmp + "/a.png", "--device", FOREIGN.replace(os.fsdecode(b"\xff"), "y")])
        if text.returncode or "on cpu@N=y?[2J (" not in text.stdout:
            problems.append("text: %r %s" % (text.stdout, text.stderr))
    return problems


PAIR = {"a": str, "b": str, "tier": str, "max": int, "differing": int, "mask": int, "flip_mean": float}


def check_diff_json(runner):
    """diff --json has a record for every pair, of devices and of files"""
    report, status, problems = run_json(runner, DIFF)
    pair = report["pairs"][0]
    problems += lacking("pair", pair, PAIR)
    if (report["format"], len(report["pairs"]), status) != (1, 1, 0):
        problems.append("format %s, %d pairs, exit status %d" % (report["format"], len(report["pairs"]), status))
    found = tuple(pair[key] for key in ("a", "b", "tier", "max", "differing", "psnr"))
    if found != ("cpu", "cpu:reference", "T0", 0, 0, None) or not 0 < pair["mask"] < 96 * 96:
        problems.append("pair: %s, mask %s" % (found, pair["mask"]))
    with tempfile.TemporaryDirectory() as tmp:
        for name, exposure in (("a", "1"), ("b", "2")):
            runner.run((RENDER + "--exposure %s -o %s/%s.png" % (exposure, tmp, name)).split())
        report, status, messages = run_json(runner, "diff {0}/a.png {0}/b.png".format(tmp))
    pair = report["pairs"][0]
    problems += messages + lacking("files", pair, dict(PAIR, psnr=float))
    if status != 1 or pair["tier"] == "T0" or pair["max"] == 0 or pair["differing"] == 0:
        problems.append("files: exit status %d, %s" % (status, pair))
    return problems


def write_tiff(path, texels):
    """A row of grey floats: the header, the row, and its fields."""
    row = struct.pack("<%df" % len(texels), *texels)
    fields = [(256, len(texels)), (257, 1), (258, 32), (259, 1), (262, 1), (273, 8), (277, 1), (278, 1), (279, len(row)), (339, 3)]
    with open(path, "wb") as file:
        file.write(struct.pack("<2sHI", b"II", 42, 8 + len(row)) + row + struct.pack("<H", len(fields)))
        file.write(b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in fields) + bytes(4))


def check_diff_not_finite(runner):
    """diff --json has a record of pictures with a NaN, whichever is the true one, and names a file that is not UTF-8"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        whole, broken, foreign = ("%s/%s.tif" % (tmp, name) for name in ("a", "b", os.fsdecode(b"c\xff")))
        write_tiff(whole, [0.5] * 64)
        write_tiff(broken, [0.5] * 63 + [math.nan])
        shutil.copy(whole, foreign)
        for pair in ((whole, broken), (broken, whole)):
            done = runner.run(["diff", *pair, "--json"])
            report = json.loads(done.stdout or '{"pairs": []}')
            problems += forms.problems("diff", report) if report["pairs"] else ["no pair: " + done.stderr]
            found = [(told["relative_mean"], told["linear"]["nonfinite_mismatches"]) for told in report["pairs"]]
            if done.returncode != 1 or found != [(0, 1)]:
                problems.append("exit status %d, %s" % (done.returncode, found))
        done = subprocess.run([runner.raingauge, "diff", whole, foreign, "--json"], env=runner.variables({}), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", errors="replace", timeout=60, check=False)
    if done.returncode != 2 or done.stdout or not re.search(r"c\S*\.tif' is not UTF-8; give", done.stderr) or "a.tif" in done.stderr:
        problems.append("exit status %d, %s%s" % (done.returncode, done.stdout, done.stderr))
    return problems


def check_full_stdout(runner):
    """results that do not fit on standard output are an error, and a closed standard output gets nothing else"""
    problems = []
    for args in ("list techniques", DIFF + "--json"):
        closed = subprocess.run(["sh", "-c", '"$0" "$@" >&-', runner.raingauge, *args.split()], env=runner.variables({}), capture_output=True,
                                text=True, timeout=60, check=False)
        if closed.returncode != 71 or not re.fullmatch(r"raingauge: standard output: .*\n", closed.stderr):
            problems.append("%s, closed: exit status %d, stderr: %s" % (args, closed.returncode, closed.stderr))
    for args in ("--help", "--version", "render --help", "list techniques", "list params flow --json", SMALL_STAGES, DIFF + "--json"):
        with open("/dev/full", "w") as full:
            result = runner.run(args.split(), stdout=full)
        if result.returncode != 71 or not re.fullmatch(r"raingauge: standard output: .*\n", result.stderr):
            problems.append("%s: exit status %d, stderr: %s" % (args, result.returncode, result.stderr))
    return problems


CHECKS = [check_render_json, check_shown, check_diff_json, check_diff_not_finite, check_foreign, check_full_stdout]
THOROUGH = [check_shown_for_long]
