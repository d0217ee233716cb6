"""gate in CI: the examples of docs/ci unchanged, run by stand-ins for their services, and the requests of googletest's runners."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree

import bisecting
import runners
import services
from gates import QUICK, SCHEMA, KNOT, Files
from wrong import turned_kernels

PNG = b"\x89PNG\r\n\x1a\n"
THIRD = KNOT.replace("raster/knot", "raster/third")
KNOWN = os.path.join(runners.TESTS, os.pardir, "results", "expectations.txt")


# What the examples take for files that a project lacks, and where the cells are from.
DEFAULTS = ("docs/ci/cells.txt", "results/expectations.txt", "results/baseline.json")
BUILT_IN = "harness/compare/gate/cells/cells.txt"
# Files in the folder that the examples keep.
JUNIT, METRICS, TIMES, PAGE = "gate/gate.xml", "gate/gate.json", "gate/drivers/launches.csv", "gate/drivers/page.html"


def undecided(service, runner, folder):
    """Runs a job whose budget and margin decide nothing, until the launches kept by earlier jobs suffice for a first look."""
    for _ in range(20):
        if os.path.exists(os.path.join(folder, "summary.md")):
            os.remove(os.path.join(folder, "summary.md"))
        ended = service(runner, folder, BUDGET="4s --margin 0.001")
        if "--budget: the first look" not in ended[1]:
            break
    return ended


def lint(path):
    ran = subprocess.run(["xmllint", "--noout", "--schema", SCHEMA, path], capture_output=True, text=True, check=False)
    return [ran.stderr] if ran.returncode else []


def drivers(runner, folder, new):
    """The files of a project in CI: an older driver that works, and a newer one."""
    bisecting.write(folder, "cells.txt", KNOT)
    bisecting.write_build(folder, "old/icd.json", runner.misbehaver)
    if os.path.exists(new):
        bisecting.write_build(folder, "new/icd.json", new)
    shutil.copy(KNOWN, os.path.join(folder, "expectations.txt"))


def ends_in_xml(path):
    """The ends of cells. Those of fixed functions depend on the time that is left."""
    return [next((child.tag for child in case if not child.tag.startswith("system")), "pass")
            for case in xml.etree.ElementTree.parse(path).iter("testcase") if not case.get("name").startswith("fixed.")]


def check_gitlab(runner):
    """docs/ci/gitlab-ci.yml: an open verdict is a warning, a crash fails, the named report is JUnit's, and the log ends with the page"""
    problems = []
    for new, status, ends, more in ((runner.misbehaver, "warning", ["skipped"], [TIMES, PAGE]), (runner.crasher, "failed", ["error"], [PAGE]),
                                    ("/nonexistent", "failed", ["error"], [PAGE])):  # a device that --require misses
        with tempfile.TemporaryDirectory() as folder:
            drivers(runner, folder, new)
            found, log, kept, last = undecided(runners.gitlab, runner, folder)
            junit = os.path.join(folder, JUNIT)
            problems += lint(junit)
            if (found, ends_in_xml(junit)) != (status, ends) or kept != sorted([JUNIT] + more) or ("is not there" in log) != (new == "/nonexistent") or (
                    last != "The page: %s/artifacts/browse/gate/\n" % services.URL):
                problems.append("%s: %s, %s, %s%s" % (new, found, kept, log, last))
    return problems


def check_gitlab_shards(runner):
    """docs/ci/gitlab-shards.yml: four jobs report as one, whether the driver works, crashes or is missing, and a job that is lost fails"""
    problems = []
    for new, lost, status, says in ((runner.misbehaver, (), "success", "4 cases, 4 pass"), (runner.crasher, (), "failed", "4 cases, 3 crash, 1 unsupported"),
                                    ("/nonexistent", (), "failed", "1 case, 1 error"), (runner.misbehaver, (2,), "failed", "of 4 shards are missing: 2;")):
        with tempfile.TemporaryDirectory() as folder:
            drivers(runner, folder, new)
            bisecting.write(folder, "cells.txt", QUICK + THIRD)
            found, log, kept = runners.gitlab_shards(runner, folder, lost)
            if found != status or says not in log or (JUNIT in kept) == bool(lost) or not any(name.startswith("gate/drivers/") for name in kept):
                problems.append("%s: %s, %s, %s" % (new, found, kept, log))
            elif not lost:
                problems += lint(os.path.join(folder, JUNIT))
    return problems


def check_github(runner):
    """docs/ci/github.yml: annotations, a summary with drivers and a link, and files for the upload, whether the gate passes or not"""
    problems = []
    for new, status, command, head in ((runner.misbehaver, "success", ["notice", "warning"], "2 cases, (1 inconclusive, 1 pass|2 inconclusive)\n\n```text\nA  .*\nB  .*"),
                                       (runner.crasher, "failure", ["error"], "2 cases, 1 crash, 1 unsupported\n\n```text\nA  .*"),
                                       ("/nonexistent", "failure", ["error"], "1 case, 1 error\n")):
        with tempfile.TemporaryDirectory() as folder:
            drivers(runner, folder, new)
            runner.run(["baseline", "--pictures", "--device", "vulkan", "--cells", os.path.join(folder, "cells.txt"), "-o", os.path.join(folder, "baseline.json")])
            found, log, summary, uploaded = undecided(runners.github, runner, folder)
            missing = [row[2] for row in runners.annotations(log) if "--require vulkan: 'vulkan@" in row[2] and "is not there" in row[2]]
            told = sorted({row[0] for row in runners.annotations(log) if not row[1].startswith("fixed.")})  # of both gates
            if found != status or told != command or not re.match("## raingauge gate: %s\n" % head, summary) or (
                    summary.count("## raingauge gate: ") != 2 or not {JUNIT, METRICS, PAGE, "gate/baseline.xml"} <= set(uploaded) or len(missing) != (new == "/nonexistent") or "](%s)\n" % services.URL not in summary):
                problems.append("%s: %s, %s, %s, %s" % (new, found, uploaded, log, summary))
    return problems


def check_own_files(runner):
    """a project without cells, expectations and baseline is gated by the package's"""
    problems = []
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as defaults:
        bisecting.write_build(folder, "new/icd.json", runner.misbehaver)
        for path in DEFAULTS:
            shutil.copy(os.path.join(runners.TESTS, os.pardir, path), defaults)
        found, log, kept, _ = runners.gitlab(runner, folder, "raingauge-baseline", DEFAULTS=defaults)
        if found != "success" or "flow/pane.vulkan" not in log or kept != [JUNIT]:
            problems.append("%s, %s, %s" % (found, kept, log))
    return problems


def check_words(runner):
    """the examples use only options that raingauge has, and files that it installs, whose cells are built in"""
    problems = []
    for name in ("github.yml", "gitlab-ci.yml", "gitlab-shards.yml"):
        with open(os.path.join(runners.EXAMPLES, name)) as file:
            text = file.read()
        commands = re.findall(r"raingauge ([a-z]+) ((?:.*\\\n|.*\n +--)*.*)", text)
        problems += [] if commands else [name + ": has no command of raingauge"]
        for command, rest in commands:
            usage = runner.run([command, "--help"]).stdout
            options = re.findall(r"(?<= )--[a-z]+", " " + rest)
            problems += ["%s: %s has no %s" % (name, command, option) for option in options if not re.search(option + r"\b", usage)]
            problems += [] if options else ["%s: %s without options" % (name, command)]
        files = set(re.findall(r"\$DEFAULTS/(\S+)", text))
        if not files or not files <= {os.path.basename(path) for path in DEFAULTS}:
            problems.append("%s: takes %s, of %s" % (name, sorted(files), DEFAULTS))
    with open(os.path.join(runners.TESTS, os.pardir, DEFAULTS[0])) as file, open(os.path.join(runners.TESTS, os.pardir, BUILT_IN)) as known:
        lines, known = file.read().splitlines(), known.read().splitlines()
    cells = [line for line in lines if not line.startswith("#")]
    return problems + ["%s: is not in %s" % (line, BUILT_IN) for line in cells if line not in known] + ([] if len(cells) > 1 else ["too few cells"])


def check_deqp_runner(runner):
    """docs/ci/deqp-runner.sh: each listed case has one result, and a baseline of failures holds"""
    problems = []
    for new, word in ((runner.misbehaver, "Pass"), (runner.crasher, "Fail"), ("/nonexistent", "Missing")):
        with tempfile.TemporaryDirectory() as folder:
            drivers(runner, folder, new)
            bisecting.write(folder, "cells.txt", QUICK + THIRD)
            bisecting.write(folder, "failures.csv", "")
            failed, found, news = runners.deqp_runner(runner, folder, NEW="new/icd.json")
            if [row[1] for row in found] != 3 * [word] or failed != (word != "Pass") or len(news) != 3 * failed:
                problems.append("%s: %s, %s" % (new, found, news))
            bisecting.write(folder, "failures.csv", "".join("%s,%s\n" % row for row in found if row[1] == "Fail"))
            if runners.deqp_runner(runner, folder, NEW="new/icd.json")[0] != (word == "Missing"):
                problems.append("%s: the baseline" % new)
    return problems


def check_meson(runner):
    """docs/ci/meson.build: meson takes a gate for a googletest, and its report has the gate's cases"""
    problems = []
    for new, status, ends in ((runner.misbehaver, 0, 2 * ["pass"]), (runner.crasher, 1, 2 * ["error"]), ("/nonexistent", 1, ["error"])):
        with tempfile.TemporaryDirectory() as folder:
            drivers(runner, folder, new)
            bisecting.write(folder, "cells.txt", QUICK)
            shutil.copy(os.path.join(runners.EXAMPLES, "meson.build"), folder)
            env = runners.environment(runner, folder, {})
            for command in (["meson", "setup", "build"], ["meson", "test", "-C", "build", "--no-rebuild"]):
                ran = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, timeout=240, check=False)
            log = os.path.join(folder, "build", "meson-logs", "testlog.junit.xml")
            if ran.returncode != status or not os.path.exists(log) or ends_in_xml(log) != ends:
                problems.append("%s: exit status %d, %s%s" % (new, ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_pictures(runner):
    """pictures that differ are written beside the JUnit report, which names them; without differences nothing is written"""
    problems = []
    with Files() as files:
        kernels = turned_kernels(runner)
        for more, folder in (([], "gate-pictures"), (["-o", files.path("]] <&>'")], "]] <&>'")):
            for device, status in (("gl", 0), ("gl@RG_KERNEL_DIR=" + kernels, 1)):
                ran = runner.run(["gate", "gl", device, "--cells", files.cells, "--pictures", "--junit", files.path("gate.xml"), "--json"] + more)
                cases = {case["name"].split(".")[0]: case["attachments"] for case in json.loads(ran.stdout)["gated"]}
                problems += lint(files.path("gate.xml"))
                told = "".join(xml.etree.ElementTree.parse(files.path("gate.xml")).getroot().itertext())
                wrong = [path for path in cases["flow/pane"] if os.path.dirname(path) != files.path(folder) or path not in told]
                if "]]" not in folder:
                    wrong += [path for path in cases["flow/pane"] if "[[ATTACHMENT|%s]]" % path not in told]
                if ran.returncode != status or len(cases["flow/pane"]) != 4 * status or cases["raster/knot"] or wrong:
                    problems.append("%s: exit status %d, %s, %s" % (device, ran.returncode, cases, ran.stderr))
                if os.path.exists(files.path(folder)) != bool(status):
                    problems.append("%s: the folder" % device)
                for path in cases["flow/pane"]:
                    with open(path, "rb") as file:
                        if file.read(8) != PNG:
                            problems.append(path + " is no picture")
        ends = sorted(path[-9:].split("-")[-1] for path in cases["flow/pane"])
        if ends != ["a.png", "b.png", "difference.png", "flip.png"] and len(set(cases["flow/pane"])) != 4:
            problems.append("%s" % ends)
        ran = runner.run(["gate", "cpu", "cpu", "--cells", files.cells, "--pictures", "-o", files.path("none/none")])
        if ran.returncode != 2 or ran.stderr.count("\n") != 1:
            problems.append("no folder: exit status %d, %s" % (ran.returncode, ran.stderr))
    return problems


def check_gtest_flags(runner):
    """the flags of googletest's runners are accepted, also with a value, and impossible requests are refused"""
    problems = []
    flags = ("--gtest_color=no --gtest_print_time=0 --gtest_brief=1 --gtest_shuffle --gtest_random_seed=7 --gtest_repeat=1 --gtest_fail_fast=false "
             "--gtest_also_run_disabled_tests --gtest_catch_exceptions=0 --gtest_break_on_failure=0 --gtest_throw_on_failure=1 "
             "--gtest_death_test_style=fast --gtest_print_utf8=yes --gtest_stack_trace_depth=100 --gtest_recreate_environments_when_repeating=0").split()
    with Files() as files:
        os.mkdir(files.path("reports"))
        args = ["gate", "cpu", "cpu", "--cells", files.cells, "--pictures"]
        for output, path in ((files.path("a.xml"), "a.xml"), (files.path("reports") + "/", "reports/raingauge.xml"),
                             (files.path("new/deep") + "/", "new/deep/raingauge.xml")):
            ran = runner.run(args + flags + ["--gtest_output=xml:" + output])
            if ran.returncode or ran.stderr or "[==========] 2 tests ran." not in ran.stdout or ends_in_xml(files.path(path)) != 2 * ["pass"]:
                problems.append("exit status %d, %s%s" % (ran.returncode, ran.stdout, ran.stderr))
        ran = runner.run(args + ["--gtest_list_tests=0", "--gtest_filter=flow*"])
        if ran.returncode or "1 test ran" not in ran.stdout:
            problems.append("=0: exit status %d, %s%s" % (ran.returncode, ran.stdout, ran.stderr))
        env, path = {"GTEST_FILTER": "flow*", "GTEST_OUTPUT": "xml:" + files.path("env.xml")}, files.path("env.xml")
        for more, tests in (([], 1), (["--gtest_filter=*"], 2), (["--gtest_output=xml:" + files.path("b.xml")], 1), (["--junit", files.path("c.xml")], 1)):
            ran = runner.run(args + more, env)
            is_own = len(more) == 0 or "filter" in more[0]
            if ran.returncode or "%d test%s ran" % (tests, "s"[:tests - 1]) not in ran.stdout or os.path.exists(path) != is_own:
                problems.append("environment, %s: exit status %d, %s%s" % (more, ran.returncode, ran.stdout, ran.stderr))
            if os.path.exists(path):
                os.remove(path)
        if len(runners.listed(runner.run(args + ["--gtest_list_tests"], {"GTEST_FILTER": "flow*"}).stdout)) != 1:
            problems.append("the list has what the environment's filter leaves out")
        ran = runner.run(args, {"GTEST_FILTER": "", "GTEST_OUTPUT": ""})
        if ran.returncode or "[" in ran.stdout:
            problems.append("empty variables: %s" % ran.stdout)
        for more, says in ((["--gtest_output=xml:" + files.cells + "/"], "cells.txt/raingauge.xml: cannot be written: Not a directory"), (["--gtest_repeat=2"], "--gtest_repeat 2"), (["--gtest_output=json:x"], "--gtest_output json:x"),
                           (["--gtest_output=xml:a", "--junit", "b"], "choose one"), (["--gtest_shuffle=maybe"], "--gtest_shuffle"),
                           (["--gtest_shuffle="], "--gtest_shuffle"), (["--gtest_stream_result_to=x:1"], "--gtest_stream_result_to")):
            ran = runner.run(args + more)
            if ran.returncode != 2 or ran.stdout or ran.stderr.count("\n") != 1 or says not in ran.stderr:
                problems.append("%s: exit status %d, %s%s" % (more, ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_shards(runner):
    """shards of googletest have each case once; an empty shard compares nothing"""
    problems = []
    with Files(QUICK + THIRD) as files:
        args = ["gate", "cpu", "cpu", "--cells", files.cells, "--pictures"]
        every = runners.listed(runner.run(args + ["--gtest_list_tests"], env={"GTEST_TOTAL_SHARDS": "2", "GTEST_SHARD_INDEX": "1"}).stdout)
        for total in (1, 2, 4):
            found = []
            for index in range(total):
                status = files.path("status")
                ran = runner.run(args, env={"GTEST_TOTAL_SHARDS": str(total), "GTEST_SHARD_INDEX": str(index), "GTEST_SHARD_STATUS_FILE": status})
                if ran.returncode != (4 if index >= len(every) else 0) or not os.path.exists(status):
                    problems.append("%d of %d: exit status %d, %s" % (index, total, ran.returncode, ran.stderr))
                os.unlink(status)
                found += [name for name, _ in runners.results(ran.stdout)]
            if total > 1 and sorted(found) != sorted(every):
                problems.append("%d shards: %s, not %s" % (total, found, every))
        for total, index, says in (("2", "2", "GTEST_SHARD_INDEX 2"), ("two", "0", "GTEST_TOTAL_SHARDS 'two'"), ("2", None, "one of them"),
                                   (None, "0", "one of them"), ("0", "0", "GTEST_SHARD_INDEX 0"), ("2", "-1", "GTEST_SHARD_INDEX '-1'")):
            ran = runner.run(args, env={"GTEST_TOTAL_SHARDS": total, "GTEST_SHARD_INDEX": index})
            if ran.returncode != 2 or ran.stdout or ran.stderr.count("\n") != 1 or says not in ran.stderr:
                problems.append("%s, %s: exit status %d, %s" % (total, index, ran.returncode, ran.stderr))
    return problems


CHECKS = [check_words, check_own_files, check_gitlab, check_gitlab_shards, check_github, check_deqp_runner, check_meson, check_pictures, check_gtest_flags, check_shards]
