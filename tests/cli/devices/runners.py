"""Programs that run gates in CI, as far as they are available: how GitLab's and GitHub's runners and deqp-runner treat docs/ci."""
import csv
import os
import re
import subprocess
import sys

TESTS = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLES = os.path.join(TESTS, os.pardir, "docs", "ci")
sys.path.insert(1, os.path.join(TESTS, "tools", "systems"))

import services


def environment(runner, folder, variables):
    """An environment in which raingauge, and stand-ins for a runner's programs, are found by name."""
    path = ":".join((os.path.join(folder, "bin"), os.path.dirname(runner.raingauge), os.environ["PATH"]))
    return runner.variables({"PATH": path, "HOME": folder, "CI": "true", **variables})


class Place:
    """A project's folder, in which a service runs the steps of an example by the programs of this machine."""

    def __init__(self, runner, folder):
        self.runner, self.project, self.temporary = runner, folder, folder

    def at(self, path):
        return path

    def check_out(self):
        pass

    def run(self, script, variables):
        ran = subprocess.run([*services.BASH, "-c", script], cwd=self.project, capture_output=True, text=True, timeout=240,
                             env=environment(self.runner, self.project, variables), check=False)
        return ran.returncode, ran.stdout + ran.stderr


def gitlab(runner, folder, name="raingauge", example="gitlab-ci.yml", **variables):
    """Runs a job of an example: its status as GitLab shows it, its log, the files that it keeps, what it says last."""
    ended = services.gitlab(os.path.join(EXAMPLES, example), name, Place(runner, folder), variables)
    return ended.status, ended.log, ended.kept, ended.summary


def gitlab_shards(runner, folder, lost=()):
    """Runs the jobs of gitlab-shards.yml but those that are lost, then the report: its status, its log, the files that it keeps."""
    count = services.read(os.path.join(EXAMPLES, "gitlab-shards.yml"))["raingauge"]["parallel"]
    for number in range(1, count + 1):
        if number not in lost:
            gitlab(runner, folder, "raingauge", "gitlab-shards.yml", CI_NODE_INDEX=str(number), CI_NODE_TOTAL=str(count))
    return gitlab(runner, folder, "report", "gitlab-shards.yml")[:3]


def github(runner, folder, **variables):
    """Runs the steps of github.yml: the status, the log, the summary, and the files for the upload."""
    return services.github(os.path.join(EXAMPLES, "github.yml"), Place(runner, folder), {}, variables)


def annotations(log):
    """(command, title, message) of each line that GitHub's runner takes for a command."""
    found = [re.fullmatch(r"::(error|warning|notice) title=([^:,]*)::(.*)", line) for line in log.split("\n") if line.startswith("::")]
    return [match.groups() for match in found]


# --- deqp-runner ---

WORDS = {"OK": "Pass", "FAILED": "Fail", "SKIPPED": "Skip"}


def listed(text):
    """The tests of a list; a line with a point is a suite."""
    suite, found = None, []
    for line in text.splitlines():
        is_suite, test = re.search(r"(\S*\.)", line), re.search(r"\s+(\S+)", line)
        if is_suite:
            suite = is_suite[1]
        elif suite and test:
            found.append(suite + test[1])
        else:
            raise ValueError("list: " + line)
    return found


def results(text):
    """(test, status) from a process's output; a test that began and did not end has crashed."""
    running, found = None, []
    for line in text.splitlines():
        begins, ends = re.search(r"\[\sRUN\s*\]\s(.*)", line), re.search(r"\[\s*(\S*)\s*\]\s(\S*)", line)
        if running and ends:
            found.append((running, WORDS[ends[1]]))  # deqp-runner stops at an unknown word
            running = None
        elif not running and begins:
            running = begins[1]
    return found + ([(running, "Crash")] if running else [])


def gtest_runner(args, env, folder, group=2):
    """`gtest-runner run ARGS`: compares each test's one result with the baseline. Returns the exit status and the new results."""
    options, rest = args[:args.index("--")], args[args.index("--") + 1:]
    taken = dict(zip(options[0::2], options[1::2]))
    command = [taken["--bin"]] + rest

    def call(flag):
        return subprocess.run(command + [flag], cwd=folder, env=env, capture_output=True, text=True, timeout=240, check=False)

    names, found = listed(subprocess.run(command + ["--gtest_list_tests"], cwd=folder, env=env, capture_output=True, text=True, check=True).stdout), []
    for i in range(0, len(names), group):
        asked = names[i:i + group]
        got = dict(results(call("--gtest_filter=" + ":".join(asked)).stdout))
        found += [(name, got.get(name, "Missing")) for name in asked]
    os.makedirs(os.path.join(folder, taken["--output"]), exist_ok=True)
    with open(os.path.join(folder, taken["--output"], "results.csv"), "w", newline="") as file:
        csv.writer(file).writerows(found)
    with open(os.path.join(folder, taken["--baseline"]), newline="") as file:
        known = dict(csv.reader(file))
    new = [(name, status) for name, status in found if status != known.get(name, "Pass") and not (status == "Skip" and name not in known)]
    return bool(new), found, new


def deqp_runner(runner, folder, **variables):
    """Runs deqp-runner.sh with a stand-in for its program that passes its arguments on."""
    stand_in = os.path.join(folder, "bin", "gtest-runner")
    os.makedirs(os.path.dirname(stand_in), exist_ok=True)
    with open(stand_in, "w") as file:
        file.write("#!/bin/sh\nprintf '%s\\n' \"$@\" >handed\n")
    os.chmod(stand_in, 0o755)
    env = environment(runner, folder, variables)
    subprocess.run(["sh", os.path.join(EXAMPLES, "deqp-runner.sh")], cwd=folder, env=env, check=True)
    with open(os.path.join(folder, "handed")) as file:
        args = file.read().split("\n")[:-1]
    if args[0] != "run":
        raise ValueError(args)
    return gtest_runner(args[1:], env, folder)
