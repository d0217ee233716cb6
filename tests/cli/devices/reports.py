"""gate's reports by the command itself: device names of any characters, and results that meet expectations or do not."""
import json
import os
import re
import subprocess
import tempfile
import xml.etree.ElementTree

import forms
import runners
from ci import KNOWN, THIRD, lint
from gates import QUICK, KNOT, Files
from runner import LATER
from wrong import RIGHT, TURNED

# Values of a variable that no driver reads, with characters that reports have to replace.
HOSTILE = ["'quotes\" and ` <failure message=\"x\">&amp;</failure> ]]> <![CDATA[", "[[ATTACHMENT|/etc/passwd]] \x1b[31m\x07\x7f a\nb\tc\rd",
           "100% : , %0A ::error title=x::y ##[error]x | a | **b** |", "[  FAILED  ] x -*?: Ü 漢 \U0001f327 two  blanks ", "x" * 200]


def shown(text):
    return "".join(chr(0x2400 + ord(c)) if c < " " else "\u2421" if c == "\x7f" else c for c in text)


def strict(text):
    def once(pairs):
        assert len({name for name, _ in pairs}) == len(pairs)
        return dict(pairs)
    return json.loads(text, object_pairs_hook=once, parse_constant=float.__new__)


def unescaped(text):
    return re.sub(r"\\([!-/:-@\[-`{-~])", r"\1", text)


def check_name(runner, value):
    device = 'cpu@RG_TEST_NOTE="%s"' % value.replace('"', '""')
    problems = []
    with Files(KNOT) as files:
        junit, bmf, summary = files.path("a.xml"), files.path("a.json"), files.path("a.md")
        args = ["gate", "cpu", device, "--cells", files.cells, "--junit", junit, "--bmf", bmf]
        ran = runner.run(args + ["--budget", "0.05s", "--json"])
        if not ran.stdout:
            return ["%r: exit status %d, %s" % (value, ran.returncode, ran.stderr)]
        report = strict(ran.stdout)
        name = report["gated"][0]["name"]
        problems += forms.problems("gate", report) + lint(junit)
        if not name.startswith("raster/knot.cpu@") or shown(value).replace('"', "") not in name.replace('"', ""):
            problems.append("%r: JSON has %r" % (value, name))
        case = xml.etree.ElementTree.parse(junit).find("testsuite/testcase")
        if case.get("name") != name or "[[ATTACHMENT" in (case.findtext("system-out") or ""):
            problems.append("%r: JUnit has %r" % (value, case.get("name")))
        with open(bmf) as file:
            if list(strict(file.read())) not in ([name], []):
                problems.append("%r: BMF" % value)
        ran = runner.run(args + ["--budget", "0.05s", "--github"], env={"GITHUB_STEP_SUMMARY": summary})
        told = [line for line in ran.stdout.split("\n") if line.startswith("::")]
        title = [re.sub("%(..)", lambda code: chr(int(code[1], 16)), re.match(r"::warning title=([^:,]*)::", line)[1]) for line in told]
        with open(summary) as file:
            cells = re.split(r"(?<!\\)(?:\\\\)*\|", file.read().split("|---|\n")[1].split("\n")[0])
        if title != [name] or unescaped(cells[2]).strip() != name.strip() or re.search("[\x00-\x09\x0b-\x1f\x7f]|^(?!::).*##\\[", ran.stdout, re.M):
            problems.append("%r: GitHub has %r and %r" % (value, told, cells))
        args = ["gate", "cpu", device, "--cells", files.cells, "--pictures"]
        listed = runners.listed(runner.run(args + ["--gtest_list_tests"]).stdout)
        ran = runner.run(args + ["--gtest_filter=" + listed[0]])
        if len(listed) != 1 or runners.results(ran.stdout) != [(listed[0], "Pass")]:
            problems.append("%r: gtest has %s and %s" % (value, listed, ran.stdout))
    return problems


def check_names(runner):
    """a device's name of any characters is read back from every form; one that is too long is refused in a line"""
    problems = [problem for value in HOSTILE for problem in check_name(runner, value)]
    ran = runner.run(["gate", "cpu", "cpu@NOTE=" + 10000 * "x"])
    if ran.returncode != 2 or ran.stdout or ran.stderr.count("\n") != 1:
        problems.append("10 kB: exit status %d, %s%s" % (ran.returncode, ran.stdout, ran.stderr))
    return problems


# --- expectations ---

FIELDS = "  device gl@*\n  reason a test\n  since 2019-01-01\n  until %s\n"
KNOWN_NAME = "what is known.txt"
UNTRUE = ": is not true of this run; --update writes it anew\n"
LATE, PAST = "2099-12-31", "2020-01-01"


def expectation(line, until=LATE, outcome="fail"):
    return line + "\n" + FIELDS % until + ("  outcome %s\n" % outcome if outcome else "")


def gate(runner, folder, more):
    """A gate of right and wrong kernels: its exit status, each case's ending and message, its output."""
    args = [runner.raingauge, "gate", "gl", "gl@RG_KERNEL_DIR=kernels", "--cells", "cells.txt", "--pictures"] + more
    ran = subprocess.run(args, cwd=folder, env=runner.variables({}), capture_output=True, text=True, timeout=240, check=False)
    endings = {cell: ending for ending, cell in re.findall(r"^(\S.*?)  +(\w+/\w+)\.gl@", ran.stdout, re.M)}
    return ran.returncode, endings, ran.stdout


def check_expectations(runner):
    """expected, fixed, fails differently, expired, flaky and skipped: each has its ending, and --update makes the file true"""
    rows = [(expectation("fail flow/*"), 0, "expected failure", "", False), (expectation("fail flow/*", outcome="crash"), 1, "differs", "fails differently", True),
            (expectation("fail *"), 1, "expected failure", "", True), (expectation("fail flow/*", until=PAST), 1, "differs", "expired", True),
            (expectation("flake flow/*", outcome=None), 0, "flake", "the picture differs", False), (expectation("skip flow/*", outcome=None), 0, "skipped", "", False),
            (expectation("skip flow/*", until=PAST, outcome=None), 1, "differs", "expired", True), ("# nothing\n", 1, "differs", "", True)]
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "kernels"))
        runner.kernels_with(os.path.join(folder, "kernels"), "flow_normals.glsl", RIGHT, TURNED)
        with open(os.path.join(folder, "cells.txt"), "w") as file:
            file.write(QUICK)
        for text, status, ending, says, is_untrue in rows:
            path = os.path.join(folder, KNOWN_NAME)
            with open(path, "w") as file:
                file.write(text)
            found, endings, told = gate(runner, folder, ["--expectations", KNOWN_NAME])
            wanted = {"flow/pane": ending, "raster/knot": "unexpected pass" if text.startswith("fail *") else "pass"}
            with open(path) as file:
                is_as_before = file.read() == text
            if (found, endings) != (status, wanted) or says not in told or (KNOWN_NAME + UNTRUE in told) != is_untrue or not is_as_before:
                problems.append("%s: exit status %d, %s\n%s" % (text, found, endings, told))
            found, again, told = gate(runner, folder, ["--update", "--expectations", KNOWN_NAME])
            with open(path) as file:
                is_as_before = file.read() == text
            if (found, again) != (status, wanted) or UNTRUE in told or is_as_before == is_untrue:
                problems.append("%s: exit status %d, %s, with --update\n%s" % (text, found, again, told))
            if not is_untrue:
                continue
            found, endings, told = gate(runner, folder, ["--expectations", KNOWN_NAME])
            now = ("differs", 1) if text.startswith("skip") else ("expected failure", 0)  # without its skip the cell runs
            if (endings["flow/pane"], found) != now:
                problems.append("%s: updated: exit status %d, %s\n%s" % (text, found, endings, told))
    return problems


def check_unseen(runner):
    """--update keeps expectations of devices that are missing or not asked for, and is refused for a part of the cells"""
    problems = []
    with Files(KNOT) as files:
        path, gone = files.path("baseline.json"), {"VK_DRIVER_FILES": "/nonexistent"}
        runner.run(["baseline", "--device", "cpu,vulkan", "--pictures", "--cells", files.cells, "-o", path])
        apart, builds = ["--baseline", path], ["--against", runner.slower]
        for args, env, left in ((apart, {}, []), (apart + ["--device", "cpu"], {}, ["vulkan"]), (apart, gone, ["vulkan"]),
                                (builds + ["--device", "cpu,vulkan"], gone, ["cpu:reference", "gl", "opencl", "vulkan"]),
                                (builds + ["--device", "cpu,gl@NOTE=1"], {}, ["cpu:reference", "opencl", "vulkan"]),
                                (["cpu", "cpu"], {}, [])):
            known = files.path("known.txt", "fail raster/*\n  driver ?*\n  outcome fail\n  reason r\n  since 2026-01-01\n  until " + LATER + "\n")
            result = subprocess.run([runner.raingauge, "gate", *args, "--pictures", "--cells", files.cells, "--expectations", "known.txt", "--update"], cwd=files.folder.name,
                                    env=runner.variables(env), capture_output=True, text=True, timeout=240, check=False)
            with open(known) as file:
                text = file.read()
            is_written = "raingauge: known.txt: written anew; `git diff` shows what changed\n" in result.stderr
            if result.returncode != 1 or not is_written or sorted(re.findall(r"^  device +(.*)$", text, re.M)) != left:
                problems.append("%s, %s: exit status %d, %s%s" % (args, env, result.returncode, result.stdout, result.stderr))
    return problems


def check_updates(runner):
    """--update adds new failures to the first file, in every form of report; a file that changes meanwhile, or cannot be written, stays"""
    problems = []
    args = ["gate", "cpu", "cpu@RG_CPU_LEVEL=reference", "--pictures", "--update"]
    with Files(KNOT) as files:
        args += ["--cells", files.cells]
        own, fails, fifo = files.path("own.txt", ""), files.path("fails.txt", "# fails\n"), files.path("none/own.txt")
        link = files.path("link.txt")
        os.symlink("own.txt", link)
        refused = [([], {}, "--update: there is no file to write"), (["--flakes", own], {}, "--update: there is no file to write"),
                   (["--fails", fails, "--gtest_filter=*"], {}, "'--update' and '--gtest_filter'|--gtest_filter"), (["--fails", fails], {"GTEST_FILTER": "*"}, "a filter or a shard"),
                   (["--fails", fails], {"GTEST_TOTAL_SHARDS": "2", "GTEST_SHARD_INDEX": "0"}, "a filter or a shard"), (["--fails", fails, "--expectations", fifo], {}, "none/own.txt: "),
                   (["--fails", fails, "--junit", fails], {}, "would be overwritten with a report")]
        for more, env, says in refused:
            ran = runner.run(args + more, env)
            if ran.returncode != 2 or not re.search(says, ran.stderr) or ran.stderr.count("\n") != 1:
                problems.append("%s, %s: exit status %d, %s%s" % (more, env, ran.returncode, ran.stdout, ran.stderr))
        kernels = files.path("kernels")
        os.mkdir(kernels)
        runner.kernels_with(kernels, "flow_normals.glsl", RIGHT, TURNED)
        files.path("cells.txt", QUICK)

        def differing(of, more):
            for path in (own, fails):
                open(path, "w").close()
            ran = runner.run(["gate", "gl", "gl@%sRG_KERNEL_DIR=%s" % (of, kernels)] + args[3:] + more)
            with open(own) as first, open(fails) as second:
                return ran, first.read(), second.read()

        for form in ([], ["--json"], ["--github"], ["--gtest_output=xml:" + files.path("out.xml")]):
            ran, first, second = differing("", ["--fails", fails, "--expectations", link] + form)
            if ran.returncode != 1 or not re.match("fail flow/pane\n  device +gl@.*\n  driver.*\n  outcome +fail\n", first) or second or not os.path.islink(link):
                problems.append("%s: exit status %d, %s%s%s%s" % (form, ran.returncode, first, second, ran.stdout, ran.stderr))
        # Another process writes to the file whenever B starts.
        other = files.path("other.sh", "#!/bin/sh\necho '# mine' >> %s\nexec %s \"$@\"\n" % (own, runner.raingauge))
        os.chmod(other, 0o700)
        ran, first, _ = differing("RG_PROGRAM=%s;" % other, ["--expectations", own])
        if ran.returncode != 2 or "own.txt: was changed while the gate ran, and stays" not in ran.stderr or set(first.split("\n")) != {"# mine", ""}:
            problems.append("changed: exit status %d, %s%s%s" % (ran.returncode, first, ran.stdout, ran.stderr))
    return problems


def check_own(runner):
    """results/expectations.txt can be read, and so can the example in its head, which is about a cell that is not run here"""
    with open(KNOWN) as file:
        own = file.read()
    example = "".join(line[4:] for line in own.splitlines(True) if line.startswith("#   "))
    problems = []
    with Files(THIRD) as files:
        for text, lines in (("", 0), (example, 1)):
            known = files.path("known.txt", own + text)
            ran = runner.run(["gate", "cpu", "cpu", "--cells", files.cells, "--pictures", "--expectations", known])
            said = "'streaks/rain' is of no cell of this gate; mend" if lines else ""
            if ran.returncode or ran.stderr.count("\n") != lines or said not in ran.stderr:
                problems.append("exit status %d, %s" % (ran.returncode, ran.stderr))
    return problems if example.startswith("fail ") else problems + [example]


CHECKS = [check_names, check_expectations, check_unseen, check_updates, check_own]
