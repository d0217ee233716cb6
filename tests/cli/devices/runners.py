"""Programs that run gates in CI, as far as they are available: how GitLab's and GitHub's runners and deqp-runner treat docs/ci."""
import csv
import glob
import os
import re
import subprocess

import yaml  # the Debian package python3-yaml

TESTS = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLES = os.path.join(TESTS, os.pardir, "docs", "ci")


def environment(runner, folder, variables):
    """An environment in which raingauge, and stand-ins for a runner's programs, are found by name."""
    path = ":".join((os.path.join(folder, "bin"), os.path.dirname(runner.raingauge), os.environ["PATH"]))
    return runner.variables({"PATH": path, "HOME": folder, "CI": "true", **variables})


def read(name):
    with open(os.path.join(EXAMPLES, name)) as file:
        return yaml.safe_load(file)


# --- GitLab ---


def gitlab(runner, folder, **variables):
    """Runs the job of gitlab-ci.yml: its status as GitLab shows it, its log, the files that it keeps, and the JUnit report."""
    job = read("gitlab-ci.yml")["raingauge"]
    ran = subprocess.run(["bash", "-eo", "pipefail", "-c", "\n".join(job["script"])], cwd=folder, capture_output=True, text=True, timeout=240,
                         env=environment(runner, folder, {**job["variables"], "CI_PROJECT_DIR": folder, **variables}), check=False)
    status = "success" if ran.returncode == 0 else "warning" if ran.returncode in job["allow_failure"]["exit_codes"] else "failed"
    kept = [os.path.relpath(path, folder) for root in job["artifacts"]["paths"]
            for path in [os.path.join(folder, root)] + glob.glob(os.path.join(folder, root, "**"), recursive=True) if os.path.isfile(path)]
    return status, ran.stdout + ran.stderr, kept, os.path.join(folder, job["artifacts"]["reports"]["junit"])


def gitlab_shards(runner, folder, lost=()):
    """Runs the jobs of gitlab-shards.yml but those that are lost, then the report: its exit status, its log, the files that it keeps."""
    jobs = read("gitlab-shards.yml")
    for number in range(1, jobs["raingauge"]["parallel"] + 1):
        node = {"CI_NODE_INDEX": str(number), "CI_NODE_TOTAL": str(jobs["raingauge"]["parallel"])}
        if number not in lost:
            subprocess.run(["bash", "-eo", "pipefail", "-c", "\n".join(jobs["raingauge"]["script"])], cwd=folder, capture_output=True, timeout=240,
                           env=environment(runner, folder, {**jobs["raingauge"]["variables"], **node}), check=False)
    ran = subprocess.run(["bash", "-eo", "pipefail", "-c", "\n".join(jobs["report"]["script"])], cwd=folder, capture_output=True, text=True, timeout=240,
                         env=environment(runner, folder, {}), check=False)
    return ran.returncode, ran.stdout + ran.stderr, [name for name in jobs["report"]["artifacts"]["paths"] if os.path.exists(os.path.join(folder, name))]


# --- GitHub ---


def github(runner, folder, **variables):
    """Runs the command steps of github.yml: the status, the log, the summary, and the files for the upload."""
    job = read("github.yml")["jobs"]["gate"]
    summary = os.path.join(folder, "summary.md")
    env = environment(runner, folder, {**job["env"], "GITHUB_ACTIONS": "true", "GITHUB_STEP_SUMMARY": summary, **variables})
    status, log, uploaded = "success", "", []
    for step in job["steps"]:
        if "run" in step and status == "success":
            script = os.path.join(folder, "step.sh")
            with open(script, "w") as file:
                file.write(step["run"])
            ran = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", script], cwd=folder, env=env, capture_output=True,
                                 text=True, timeout=240, check=False)
            log += ran.stdout + ran.stderr
            status = "success" if ran.returncode == 0 else "failure"
        elif step.get("uses", "").startswith("actions/upload-artifact") and (status == "success" or step.get("if") == "always()"):
            uploaded += [name for name in step["with"]["path"].split() if os.path.exists(os.path.join(folder, name))]
    if not os.path.exists(summary):
        return status, log, "", uploaded
    with open(summary) as file:
        return status, log, file.read(), uploaded


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
