"""bisect: finds the first bad one of several drivers, alone and inside git bisect run; its verdicts, and its refusals."""
import json
import os
import re
import signal
import shutil
import subprocess
import tempfile
import time

import forms

TESTS = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLES = os.path.join(TESTS, os.pardir, "docs", "ci")
KNOT = "raster/knot raster 64x48 2 scene=triangles triangles=1000\n"
HOSTILE = ["it's", 'a "b" c', "$HOME `id` \\", "x;exit 1", "-n", "Ü ⟨ü⟩", "two  blanks", "{good}", "{budget}", "*", "~", "#x"]


def write(folder, name, text):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write(text)


def manifest(library):
    return json.dumps({"file_format_version": "1.0.0", "ICD": {"library_path": library, "api_version": "1.1.0"}})


def write_build(folder, name, library):
    """A driver's manifest with a copy of its library beside it: a gate refuses two builds in one file."""
    copy = os.path.join(folder, os.path.dirname(name), "driver.so")
    os.makedirs(os.path.dirname(copy), exist_ok=True)
    shutil.copy(library, copy)
    write(folder, name, manifest(copy))


def shell(runner, folder, script):
    """A script of docs/ci, which docs/ci.md quotes, in a folder where raingauge is found by name."""
    with open(os.path.join(EXAMPLES, script)) as file, open(EXAMPLES + ".md") as page:
        if "\n```\n%s```\n" % file.read() not in page.read():
            raise ValueError("docs/ci.md does not quote " + script)
    env = runner.variables({"PATH": os.path.dirname(runner.raingauge) + ":" + os.environ["PATH"], "HOME": folder})
    return subprocess.run(["sh", os.path.join(EXAMPLES, script)], cwd=folder, env=env, capture_output=True, text=True, timeout=120, check=False)


def bisect(runner, line, more=(), good="1", bad="9", names="123456789"):
    """Bisects words with --json: its exit status, its report, its messages."""
    ran = runner.run(["bisect", "--good", good, "--bad", bad, "--run", line, "--json", *more, *names])
    return ran.returncode, json.loads(ran.stdout) if ran.stdout else None, ran.stderr


def check_builds(runner):
    """the first of five builds that crashes is found, and one without a driver is skipped, by the script that docs/ci.md quotes"""
    with tempfile.TemporaryDirectory() as folder:
        write(folder, "cells.txt", KNOT)
        for build, library in (("1", runner.misbehaver), ("2", runner.misbehaver), ("3", None), ("4", runner.crasher), ("5", runner.crasher)):
            if library:
                write_build(folder, "builds/%s/icd.json" % build, library)
            else:
                write(folder, "builds/%s/failed" % build, "no driver\n")
        ran = shell(runner, folder, "bisect-builds.sh")
        problems = [] if ran.returncode == 3 else ["exit status %d, %s" % (ran.returncode, ran.stderr)]
        wanted = ["good  builds/1", "bad   builds/5", "skip  builds/3", "good  builds/2", "bad   builds/4"]
        lines = ran.stdout.split("\n")
        if [line.split("  (")[0] for line in lines[:5]] != wanted or lines[5:] != [
                "builds/2 is good; the first bad one is one of these, of which the last alone was judged:", "  builds/3", "  builds/4", ""]:
            problems.append(ran.stdout)
        write_build(folder, "builds/3/icd.json", runner.misbehaver)
        ran = shell(runner, folder, "bisect-builds.sh")
        if ran.returncode or not ran.stdout.endswith("the first bad one is builds/4; builds/3 before it is good\n"):
            problems.append("exit status %d, %s%s" % (ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_git(runner):
    """git bisect run finds the commit whose driver crashes, past commits that do not build, by the script that docs/ci.md quotes"""
    with tempfile.TemporaryDirectory() as folder:
        def git(*args):
            return subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e", *args], cwd=folder, capture_output=True, text=True,
                                  env=runner.variables({"HOME": folder}), check=True).stdout.strip()

        git("init", "-q", "-b", "main")
        write(folder, ".git/info/exclude", "cells.txt\n")
        write(folder, "cells.txt", KNOT)
        commits = []
        for number in range(8):
            write(folder, "Makefile", "all:\n\t@%s\n# %d\n" % ("false" if number in (3, 4) else "true", number))
            write(folder, "icd.json", manifest(runner.crasher if number >= 6 else runner.misbehaver))
            git("add", ".")
            git("commit", "-q", "-m", "commit %d" % number)
            commits.append(git("rev-parse", "HEAD"))
        git("tag", "good", commits[0])
        ran = shell(runner, folder, "bisect-git.sh")
    found = "%s is the first bad commit" % commits[6] in ran.stdout
    return [] if found and ran.returncode == 0 else ["exit status %d, %s%s" % (ran.returncode, ran.stdout, ran.stderr)]


def check_git_stops(runner):
    """a misspelt word ends git's search, and is bad usage elsewhere"""
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        def git(*args):
            subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e", "-C", folder, *args], capture_output=True,
                           env=runner.variables({"HOME": folder}), check=True)

        git("init", "-q", "-b", "main")
        git("commit", "-q", "--allow-empty", "-m", "one")
        for command, status in ((("status",), 2), (("bisect", "start"), 128), (("bisect", "reset"), 2)):
            git(*command)
            for args in (["--runn", "true"], ["--run", "true", "--good", "a"], ["--run", "true", "--budget", "soon"], ["--run", "true", "--json"]):
                ran = runner.run(["bisect"] + args, env={"GIT_DIR": os.path.join(folder, ".git")})
                if ran.returncode != status or ran.stdout or ran.stderr.count("\n") != 1:
                    problems.append("%s, %s: exit status %d, %s%s" % (command, args, ran.returncode, ran.stdout, ran.stderr))
            stopped = runner.run(["bisect", "--good", "a", "--bad", "b", "--run", "exit 2"], env={"GIT_DIR": os.path.join(folder, ".git")})
            if stopped.returncode != 2:
                problems.append("%s: a list's command that judges nothing: exit status %d" % (command, stopped.returncode))
    return problems


def check_statuses(runner):
    """inside git bisect run each exit status of a command becomes git's, and an inconclusive one is tried with twice the time"""
    problems = []
    rows = [("exit 0", 0), ("exit 1", 1), ("exit 3", 125), ("exit 4", 125), ("exit 77", 125), ("exit 125", 125), ("kill -SEGV $$", 125),
            ("exit 134", 125), ("exit 2", 128), ("exit 127", 128), ("exit 5", 128), ("exit 128", 128), ("no-such-command", 128), ("exit 130", 128)]
    for line, status in rows:
        ran = runner.run(["bisect", "--run", line])
        if ran.returncode != status:
            problems.append("%s: exit status %d, %s" % (line, ran.returncode, ran.stderr))
    ran = runner.run(["bisect", "--crash", "bad", "--run", "kill -SEGV $$"])
    if ran.returncode != 1:
        problems.append("--crash bad: exit status %d" % ran.returncode)
    ran = runner.run("bisect --tries 4 --budget 5s --run".split() + ["echo $RG_BUDGET {}; test $RG_BUDGET = 20s && exit 1; exit 3"])
    if ran.returncode != 1 or ran.stdout != "5s {}\n10s {}\n20s {}\n" or "3 tries" not in ran.stderr:
        problems.append("tries: exit status %d, %s%s" % (ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_lists(runner):
    """a list is halved between its ends, which are judged first; each way to end has its status"""
    problems = []
    for line, ends, status, end, first_bad, judged in (
            ("test $RG_CANDIDATE -lt 6", ("1", "9"), 0, "found", ["6"], "19576"), ("test $RG_CANDIDATE -gt 4", ("9", "1"), 0, "found", ["4"], "91534"),
            ("test $RG_CANDIDATE -lt 2", ("1", "2"), 0, "found", ["2"], "12"),
            ("case $RG_CANDIDATE in [4-6]) exit 4;; [1-3]) ;; *) exit 1; esac", ("1", "9"), 3, "one of several", list("4567"), None),
            ("test $RG_CANDIDATE -lt 1", ("1", "9"), 1, "good is not good", [], "1"), ("test $RG_CANDIDATE -lt 10", ("1", "9"), 1, "bad is not bad", [], "19"),
            ("exit 77", ("1", "9"), 4, "good is not good", [], "1"), ("test $RG_CANDIDATE -lt 5 || exit 2", ("1", "9"), 2, "stopped", [], "1")):
        found, report, said = bisect(runner, line, good=ends[0], bad=ends[1])
        problems += forms.problems("bisect", report)
        order = "".join(row["candidate"] for row in report["judged"])
        if (found, report["end"], report["first_bad"]) != (status, end, first_bad) or judged not in (None, order):
            problems.append("%s: exit status %d, %s in order %s, %s" % (line, found, report, order, said))
    return problems


def check_names(runner):
    """a command gets a candidate of any characters unchanged, by a variable, and so does JSON"""
    problems = []
    for name in HOSTILE:
        for line in ("test \"$RG_CANDIDATE\" = good", "# it's\ntest \"$RG_CANDIDATE\" = \"$RG_GOOD\" <<EOF\n'\nEOF\n", "sh -c 'test \"$RG_CANDIDATE\" = good'"):
            ran = runner.run(["bisect", "--good", "good", "--bad", name, "--run", line, "--json"])
            if ran.returncode or json.loads(ran.stdout)["first_bad"] != [name]:
                problems.append("%r, %s: exit status %d, %s%s" % (name, line, ran.returncode, ran.stdout, ran.stderr))
    with tempfile.TemporaryDirectory() as folder:
        write(folder, "list.txt", "\ufeff%s\r\n# oldest first\n\n" % "good" + "".join("  %s  \r\n" % name for name in HOSTILE[:-1]))
        ran = runner.run(["bisect", "--list", os.path.join(folder, "list.txt"), "--good", "good", "--bad", "~", "--json", "--run", "test \"$RG_CANDIDATE\" = good"])
        if ran.returncode or json.loads(ran.stdout)["first_bad"] != HOSTILE[:1]:
            problems.append("list: exit status %d, %s%s" % (ran.returncode, ran.stdout, ran.stderr))
    return problems


def check_interrupted(runner):
    """an interrupted bisect ends its command, and names the two candidates between which it would go on; nothing is kept"""
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        env = {"XDG_STATE_HOME": folder}
        # No child in the background: it may lose a signal between fork and exec, and then holds stderr open.
        line = "test $RG_CANDIDATE -ne %s || { trap 'touch %s/ended; exit' TERM; touch %s/waits; while :; do sleep 0.1; done; }; test $RG_CANDIDATE -lt 7"
        for names, at, ends, lines in (("123456789", 5, "--good '1' --bad '9'", 2), ("12345678", 6, "--good '4' --bad '8'", 3)):
            process = runner.start(["bisect", "--good", names[0], "--bad", names[-1], "--run", line % (at, folder, folder), *names], env=env)
            end = time.monotonic() + 60
            while not os.path.exists(os.path.join(folder, "waits")) and time.monotonic() < end:
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            output, said = process.communicate(timeout=60)
            if process.returncode != 130 or output.count("\n") != lines or "interrupted; %s go on from here\n" % ends not in said or sorted(os.listdir(folder)) != ["ended", "waits"]:
                problems.append("exit status %d, %s%s%s" % (process.returncode, os.listdir(folder), output, said))
            for name in os.listdir(folder):
                os.remove(os.path.join(folder, name))
    return problems


def check_unprinted(runner):
    """a result that cannot be printed is raingauge's own failure, like a full disk, and no verdict"""
    problems = []
    for more in ([], ["--json"]):
        with open("/dev/full", "w") as full:
            lost = runner.run(["bisect", "--good", "1", "--bad", "9", "--run", "test $RG_CANDIDATE -lt 6", *more, *"123456789"], stdout=full)
        if lost.returncode != 71 or not re.fullmatch(r"(raingauge: \d candidates? left, .*\n)*raingauge: standard output: .*\n", lost.stderr):
            problems.append("exit status %d, %s" % (lost.returncode, lost.stderr))
    return problems


def check_refused(runner):
    """an impossible bisect is refused in one line"""
    problems = []
    for args, says in ((["--good", "a", "--bad", "b"], "--run names the command"), (["--run", "true", "--good", "a"], "--bad is missing"),
                       (["--run", "true", "a", "b"], "--good is missing"),
                       (["--run", "test {} = a", "--good", "a", "--bad", "b"], "'test {} = a': {} stands for nothing; write \"$RG_CANDIDATE\""),
                       (["--run", "test '{good}' = a", "--good", "a", "--bad", "b"], "{good} stands for nothing; write \"$RG_GOOD\""),
                       (["--run", "echo {budget}"], "{budget} stands for nothing; write \"$RG_BUDGET\""),
                       (["--run", "true", "--fresh"], "--fresh"), (["--run", "true", "--dry-run"], "--dry-run"),
                       (["--run", "true", "--good", "a", "--bad", "a"], "both 'a'"), (["--run", "true", "--json"], "leave out"),
                       (["--run", "true", "--good", "a", "--bad", "x", "a", "b"], "--bad 'x' is not among"),
                       (["--run", "true", "--good", "a", "--bad", "b", "a", "b", "a"], "'a' is there twice"),
                       (["--run", "true", "--good", "a", "--bad", "b\n"], "control character"), (["--run", "true", "--good", "a", "--bad", ""], "--bad '': is empty"),
                       (["--run", "true", "--good", "a", "--bad", "b", "--list", "/nonexistent"], "/nonexistent"),
                       (["--run", "true", "--good", "a", "--bad", "b", "--list", "/dev/null"], "/dev/null"),
                       (["--run", "true", "--good", "a", "--bad", 70000 * "b"], "has more than 65536 bytes; rename it"),
                       (["--run", "true", "--good", "a", "--bad", "b"] + 65 * ["c"], "more than 64 arguments; name fewer, or a file of them by --list"),
                       (["--run", "true", "--budget", "soon"], "--budget 'soon'"), (["--run", "true", "--tries", "0"], "--tries 0")):
        ran = runner.run(["bisect"] + args, env={"GIT_DIR": "/nonexistent"})
        if ran.returncode != 2 or ran.stdout or ran.stderr.count("\n") != 1 or says not in ran.stderr:
            problems.append("%s: exit status %d, %s%s" % (args, ran.returncode, ran.stdout, ran.stderr))
    return problems


CHECKS = [check_builds, check_git, check_git_stops, check_statuses, check_lists, check_names, check_interrupted, check_unprinted, check_refused]
