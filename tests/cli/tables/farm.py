"""A farm of four shards on one machine: plans, shards and merges, from outside."""
import atexit
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import forms

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path.append(os.path.join(ROOT, "tests", "harness", "farm"))

import expected

SAME = os.path.join(ROOT, "results", "same.py")
SLURM, PAGE = os.path.join(ROOT, "docs", "farm", "slurm.sh"), os.path.join(ROOT, "docs", "farm.md")
TABLES = ["stuppacher-2", "raster-1"]
SHARDS = 4
# How each shard learns which it is. Slurm's array begins where the plan's shards do; GTEST_SHARD_INDEX counts from 0.
WAYS = (
    lambda i: ({}, "%d/%d" % (i, SHARDS)),
    lambda i: ({"SLURM_ARRAY_TASK_ID": str(i), "SLURM_ARRAY_TASK_MIN": "1", "SLURM_ARRAY_TASK_MAX": str(SHARDS),
                "SLURM_ARRAY_TASK_COUNT": str(SHARDS)}, "auto"),
    lambda i: ({"CI_NODE_INDEX": str(i), "CI_NODE_TOTAL": str(SHARDS)}, "auto"),
    lambda i: ({"GTEST_SHARD_INDEX": str(i - 1), "GTEST_TOTAL_SHARDS": str(SHARDS)}, "auto"),
)


class Farm:
    """A plan and the records of its shards, which are measured once, each told in another way which it is. A node has variables of its own."""

    def __init__(self, runner, tables=TABLES, node=lambda i: {}):
        self.runner, self.path = runner, tempfile.mkdtemp()
        atexit.register(shutil.rmtree, self.path, True)
        self.plan, self.records = self.path + "/plan.json", self.path + "/records"
        self.planned = runner.run(["plan", *tables, "--device", "cpu", "--quick", "--shards", str(SHARDS), "-o", self.plan])
        self.measured = [self.measure(i, WAYS[i - 1], node(i)) for i in range(1, SHARDS + 1)]

    def shard(self, shard, folder):
        return ["table", "--plan", self.plan, "--shard", shard, "-o", folder]

    def measure(self, number, way=WAYS[0], more={}):
        env, shard = way(number)
        return self.runner.run(self.shard(shard, self.records), {**env, **more})

    def files(self):
        """Of each record: when it was written."""
        return {name: os.stat(os.path.join(self.records, name)).st_mtime_ns for name in sorted(os.listdir(self.records))}

    def copy(self, to):
        shutil.copytree(self.records, to)
        return to


def farm(runner):
    if not hasattr(runner, "farm"):
        runner.farm = Farm(runner)
    return runner.farm


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return json.load(file)


def check_plan(runner):
    """plan names each cell, its seconds and its device, in groups; it is said how many are guessed, and from records none is"""
    made = farm(runner)
    document, problems = read(made.plan), []
    problems += forms.problems("plan", document)
    cells = [cell for group in document["groups"] for cell in group["cells"]]
    ids = [cell["id"] for cell in cells]
    if made.planned.returncode or len(set(ids)) != len(ids) or "stuppacher-2/1/paper/full/cpu" not in ids or "raster-1/4/full/cpu" not in ids:
        problems.append("%s: %s" % (made.planned, ids))
    if [group["id"] for group in document["groups"]] != ["raster-1/%d" % row for row in range(1, 5)] + ["stuppacher-2/1-3"]:
        problems.append("groups: %s" % [group["id"] for group in document["groups"]])
    if not re.search(r"warning: (\d+) of \1 cells are in no record, so that their times are guessed by how fast", made.planned.stderr):
        problems.append("stderr: " + made.planned.stderr)
    largest = max(document["groups"], key=lambda group: sum(cell["seconds"] for cell in group["cells"]))
    says = r"%s: %d cells in 5 groups, expected .*; the largest is %s, .*\n4 shards: the longest .*, the mean .*\n" % (re.escape(made.plan), len(cells), re.escape(largest["id"]))
    if not re.fullmatch(says, made.planned.stdout):
        problems.append("stdout: " + made.planned.stdout)
    known = runner.run(["plan", *TABLES, "--device", "cpu", "--from", made.records, "-o", made.path + "/known.json"])
    seconds = [cell["seconds"] for group in read(made.path + "/known.json")["groups"] for cell in group["cells"] if cell["known"]]
    if known.returncode or known.stderr or len(seconds) != len(cells) or min(seconds) <= 0:
        problems.append("of records: %s, %s" % (known, seconds))
    return problems


def check_one_run(runner):
    """four shards merge into what one run measures, in all but times"""
    made, problems = farm(runner), []
    for i, shard in enumerate(made.measured):
        if shard.returncode or "shard %d of %d: 0 of " % (i + 1, SHARDS) not in shard.stderr or not shard.stdout:
            problems.append("shard %d: %s" % (i + 1, shard))
    for name in made.files():
        problems += [name + ": " + problem for problem in forms.problems("table", read(made.records, name))]
    merged = runner.run(["merge", made.plan, made.records, "-o", made.path + "/merged"])
    one = runner.run(["table", *TABLES, "--device", "cpu", "--quick", "-o", made.path + "/one"])
    if merged.returncode or merged.stderr or "merged: 2 tables, 13 cells of 13, key " not in merged.stdout or one.returncode:
        problems.append("%s\n%s" % (merged, one))
    if sorted(os.listdir(made.path + "/merged")) != sorted(os.listdir(made.path + "/one")):
        problems.append("files: %s" % os.listdir(made.path + "/merged"))
    for first, second in (("merged", "one"), ("one", "merged")):
        same = subprocess.run([sys.executable, "-B", SAME, made.path + "/" + first, made.path + "/" + second], capture_output=True,
                              text=True, check=False)
        problems += [same.stdout + same.stderr for _ in range(same.returncode != 0)]
    for table in TABLES:
        heads = [read(made.path, folder, table + ".json") for folder in ("merged", "one")]
        for head in heads:
            del head["cells"], head["shapes"]
        problems += ["%s: %s is another" % (table, key) for key in heads[0].keys() | heads[1].keys() if heads[0].get(key) != heads[1].get(key)]
    return problems


def check_again(runner):
    """a shard that runs twice does nothing the second time, but tells googletest's runner that it read its number; one that is killed goes on"""
    made, problems = farm(runner), []
    before, status = made.files(), made.path + "/status"
    again = [made.measure(i, WAYS[i - 1], {"GTEST_SHARD_STATUS_FILE": status}) for i in range(1, SHARDS + 1)]
    if made.files() != before or any(shard.returncode or shard.stdout for shard in again) or not os.path.exists(status):
        problems.append("again: %s" % again)
    with tempfile.TemporaryDirectory() as tmp:
        args = ["table", "--plan", made.path + "/all.json", "-o", tmp + "/records"]
        runner.run(["plan", "raster-1", "--device", "cpu", "-o", made.path + "/all.json"])
        process = runner.start(args)
        while process.poll() is None and not (os.path.isdir(tmp + "/records") and os.listdir(tmp + "/records")):
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        process.communicate()
        left = os.listdir(tmp + "/records")
        done = runner.run(args)
        there = re.search(r"shard 1 of 1: (\d) of 4 groups were there", done.stderr)
        count = len(os.listdir(tmp + "/records"))
        if process.returncode not in (143, 0) or done.returncode or not there or int(there[1]) != len(left) or count != 4:
            problems.append("killed: %s, %s, %s" % (process.returncode, left, done))
    return problems


def check_missing(runner):
    """what is missing is named, and its shards as sbatch takes them; merge then writes nothing, or what is there"""
    made, problems = farm(runner), []
    with tempfile.TemporaryDirectory() as tmp:
        half = made.copy(tmp + "/half")
        names = sorted(name for name in os.listdir(half) if name.startswith("raster-1"))
        os.rename(os.path.join(half, names[0]), os.path.join(half, "." + names[0] + ".Xy12Z"))  # as rsync copies
        with open(os.path.join(half, names[1]), "r+b") as file:
            file.truncate(os.path.getsize(file.name) // 2)
        merged = runner.run(["merge", made.plan, half, "-o", tmp + "/out"])
        says = ("%s: line " % names[1], "raster-1/1: missing, 1 cell\n", "raster-1/2: missing, 1 cell\n",
                "2 of 13 cells are missing, and nothing is merged")
        if merged.returncode != 3 or merged.stdout or any(words not in merged.stderr for words in says) or os.path.exists(tmp + "/out"):
            problems.append("half: %s" % merged)
        left = runner.run(["plan", "--missing", made.plan, half])
        if left.returncode or not re.fullmatch(r"\d(-\d)?(,\d)*\n", left.stdout):
            problems.append("left: %s" % left)
        part = runner.run(["merge", "--partial", made.plan, half, "-o", tmp + "/out"])
        if part.returncode or "11 cells of 13" not in part.stdout or len(read(tmp, "out", "raster-1.json")["cells"]) != 2:
            problems.append("partial: %s" % part)
        whole = runner.run(["merge", made.plan, half, made.records, "-o", tmp + "/whole"])
        if whole.returncode or whole.stderr.count("is there twice") != 3 or "13 cells of 13" not in whole.stdout:
            problems.append("twice: %s" % whole)
        os.mkdir(tmp + "/empty")
        none = runner.run(["merge", made.plan, tmp + "/empty", "-o", tmp + "/none"])
        if none.returncode != 4 or "no folder has a record of it" not in none.stderr or os.path.exists(tmp + "/none"):
            problems.append("none: %s" % none)
    nothing = runner.run(["plan", "--missing", made.plan, made.records])
    return problems + ["nothing is left: %s" % nothing for _ in range(bool(nothing.returncode or nothing.stdout or nothing.stderr))]


def check_refused(runner):
    """a plan that was edited is refused by every command, and so is a record of another plan"""
    made, problems = farm(runner), []
    with tempfile.TemporaryDirectory() as tmp:
        with open(made.plan, encoding="utf-8") as file, open(tmp + "/edited.json", "w", encoding="utf-8") as edited:
            edited.write(file.read().replace('"raster-1/4"', '"raster-1/5"', 1))
        says = r"raingauge: .*edited\.json: was changed or cut since it was made; .*\n"
        for args in (["merge", tmp + "/edited.json", made.records, "-o", tmp + "/out"], ["plan", "--missing", tmp + "/edited.json", made.records],
                     ["table", "--plan", tmp + "/edited.json", "--shard", "1/4", "-o", tmp + "/records"]):
            done = runner.run(args)
            if done.returncode != 2 or done.stdout or not re.fullmatch(says, done.stderr):
                problems.append("%s: %s" % (args[0], done))
        runner.run(["plan", *TABLES, "--device", "cpu", "--shards", "3", "-o", tmp + "/other.json"])
        for args in (["merge", tmp + "/other.json", made.records, "-o", tmp + "/out"],
                     ["table", "--plan", tmp + "/other.json", "--shard", "1/3", "-o", made.records]):
            done = runner.run(args)
            if done.returncode != 2 or done.stdout or not re.search(r"\.json: is of plan (\w{16}), and the plan is of (?!\1)\w{16}; ", done.stderr):
                problems.append("%s, another plan: %s" % (args[0], done))
        if sorted(os.listdir(tmp)) != ["edited.json", "other.json"]:
            problems.append("left behind: %s" % os.listdir(tmp))
    return problems


def check_auto(runner):
    """--shard auto says which variables it lacks, and refuses a number that the plan has not"""
    made, problems = farm(runner), []
    slurm = {"SLURM_ARRAY_TASK_ID": "5", "SLURM_ARRAY_TASK_MIN": "1", "SLURM_ARRAY_TASK_MAX": "5", "SLURM_ARRAY_TASK_COUNT": "2"}
    for env, says in (({}, "neither SLURM_ARRAY_TASK_ID, CI_NODE_INDEX nor GTEST_SHARD_INDEX is set"), (slurm, "shard 5 is none of 1 to 4"),
                      ({"CI_NODE_INDEX": "1", "CI_NODE_TOTAL": "5"}, "there are 5, and the plan is cut into 4"),
                      ({"CI_NODE_TOTAL": "4"}, "CI_NODE_INDEX '' is no whole number"),
                      ({"GTEST_SHARD_INDEX": "4", "GTEST_TOTAL_SHARDS": "4"}, "GTEST_SHARD_INDEX 4: must be below")):
        done = made.runner.run(["table", "--plan", made.plan, "--shard", "auto", "-o", made.records], env)
        if done.returncode != 2 or done.stdout or says not in done.stderr or done.stderr.count("\n") != 1:
            problems.append("%s: %s" % (env, done))
    free = made.path + "/free.json"
    runner.run(["plan", "raster-1", "--device", "cpu", "-o", free])
    gaps = runner.run(["table", "--plan", free, "--shard", "auto", "-o", made.path + "/free"], slurm)
    if gaps.returncode != 2 or "array has gaps" not in gaps.stderr:
        problems.append("gaps: %s" % gaps)
    return problems


def check_script(runner):
    """the job script for Slurm runs the shard of its task"""
    made = farm(runner)
    path = os.path.dirname(runner.raingauge) + ":" + os.environ["PATH"]
    done = subprocess.run(["bash", SLURM], cwd=made.path, env=runner.variables({"PATH": path, **WAYS[1](2)[0]}), capture_output=True, text=True,
                          check=False)
    there = re.search(r"shard 2 of 4: (\d) of (\d) groups were there", done.stderr)
    return [] if done.returncode == 0 and there and there[1] == there[2] != "0" else [str(done)]


def check_two_shards(runner):
    """two shards of one table merge into it: what sanitizers look at, for four of two tables take them minutes"""
    with tempfile.TemporaryDirectory() as tmp:
        plan, records = tmp + "/plan.json", tmp + "/records"
        runs = [runner.run(["plan", "raster-1", "--device", "cpu", "--quick", "--shards", "2", "-o", plan])]
        runs += [runner.run(["table", "--plan", plan, "--shard", shard, "-o", records]) for shard in ("1/2", "2/2")]
        runs += [runner.run(["merge", plan, records, "-o", tmp + "/merged"]), runner.run(["plan", "--missing", plan, records])]
        problems = [str(run) for run in runs if run.returncode]
        if "merged: 1 table, 4 cells of 4, key " not in runs[3].stdout or runs[4].stdout or len(os.listdir(records)) != 4:
            problems.append("merged: %s, %s" % (runs[3], runs[4]))
        return problems


# Stand-ins for runtimes of containers: each checks what it is told, and runs the rest as in the image, with the variables that it hands on.
RUNTIMES = {
    "Apptainer": ("apptainer", """[ "$1 $2 $3 $4" = "exec --bind $PWD raingauge.sif" ] || exit 9
shift 4
exec "$@"
"""),
    "Podman": ("podman", """[ "$1 $2 $3 $4 $5 $6 $7 $8 $9" = "run --rm --env SLURM_* --volume $PWD:$PWD --workdir $PWD raingauge:full" ] || exit 9
shift 9
exec env -i PATH="$PATH" RG_PROBE_S="$RG_PROBE_S" $(env | grep ^SLURM_) "$@"
"""),
}


def check_images(runner):
    """the job script runs the shard of its task from a container image, by the words that the page gives for each runtime"""
    made, problems = farm(runner), []
    with open(PAGE, encoding="utf-8") as file:
        told = dict(re.findall(r"(?m)^\| (\w+) \| `([^`]*raingauge)`", file.read()))
    if told.keys() != RUNTIMES.keys():
        return ["runtimes of the page: %s" % told]
    with tempfile.TemporaryDirectory() as tmp:
        path = tmp + ":" + os.path.dirname(runner.raingauge) + ":" + os.environ["PATH"]
        with open(made.path + "/SLURM_file", "w", encoding="utf-8"):
            pass  # which the star of a variable's name must not become
        for name, (program, script) in RUNTIMES.items():
            calls = os.path.join(tmp, name)
            with open(os.path.join(tmp, program), "w", encoding="utf-8") as file:
                file.write("#!/bin/sh\necho called >>%s\n%s" % (calls, script))
            os.chmod(file.name, 0o755)
            words = told[name].replace("$PWD", made.path)
            done = subprocess.run(["bash", SLURM], cwd=made.path, env=runner.variables({"PATH": path, "PWD": made.path, "RAINGAUGE": words, **WAYS[1](3)[0]}),
                                  capture_output=True, text=True, check=False)
            there = re.search(r"shard 3 of 4: (\d) of (\d) groups were there", done.stderr)
            with open(calls, encoding="utf-8") as file:
                called = file.read().count("called")  # for the prologue and the shard
            if done.returncode or not there or there[1] != there[2] or there[1] == "0" or called != 2:
                problems.append("%s: called %d times, %s" % (name, called, done))
    return problems


def check_two_machines(runner):
    """records of two comparison keys merge into a folder each, from which claims stand side by side"""
    made, problems = farm(runner), []
    number = next(i for i, shard in enumerate(made.measured, 1) if "stuppacher-2/" in shard.stdout)
    with tempfile.TemporaryDirectory() as tmp:
        other = runner.run(made.shard("%d/%d" % (number, SHARDS), tmp + "/other"), {"OMP_NUM_THREADS": "1"})
        merged = runner.run(["merge", made.plan, made.records, tmp + "/other", "-o", tmp + "/out"])
        keys = re.findall(r"/out/(\w{16}): ", merged.stdout)
        if other.returncode or merged.returncode or len(set(keys)) != 2 or sorted(os.listdir(tmp + "/out")) != sorted(keys):
            problems.append("%s, %s" % (other, merged))
        shown = runner.run(["table", "--claims", "--from", tmp + "/out"])
        if shown.returncode or " of 2 machines: " not in shown.stdout or "OMP_NUM_THREADS=1" not in shown.stdout:
            problems.append("%s" % shown)
    return problems


def check_expected(runner):
    """the script that holds a plan's times against real ones cuts as raingauge does, and fails where the sum or the longest shard is off"""
    made, problems = farm(runner), []
    groups = expected.groups_of(read(made.plan))
    cut = expected.shards_of(groups, SHARDS)
    for number, shard in enumerate(made.measured, 1):
        found = [group["id"] for group in groups if "\n%s: " % group["id"] in "\n" + shard.stdout]
        if sorted(found) != sorted(cut[number - 1]):
            problems.append("shard %d: %s, not %s" % (number, found, cut[number - 1]))
    even = [{"id": "t/%d" % i, "seconds": 10} for i in range(16)]
    for real, says in (({"t/%d" % i: 12.4 for i in range(16)}, None), ({"t/%d" % i: 12.6 for i in range(16)}, r"all groups took \+26 % of the expected"),
                       ({"t/%d" % i: 7.4 for i in range(16)}, "all groups took -26 %"), ({"t/%d" % i: 9 + 5.6 * (i % 8 == 0) for i in range(16)}, r"the longest shard took 1\.51 times the mean"),
                       ({"t/%d" % i: 9 + 3.4 * (i % 8 == 0) for i in range(16)}, r"the longest shard took 1\.32 times"), ({"t/%d" % i: 9 + 3 * (i % 8 == 0) for i in range(16)}, None),
                       ({"t/%d" % i: 10 for i in range(15)}, r"t/15 was not measured")):
        found = expected.judge(even, real, 8)
        if (not found) != (says is None) or (says and not re.match(says, found[0])):
            problems.append("%s: %s" % (real, found))
    large = [{"id": "t/0", "seconds": 100}] + [{"id": "t/%d" % i, "seconds": 5} for i in range(1, 15)]
    if expected.judge(large, {group["id"]: group["seconds"] for group in large}, 8):
        problems.append("a large group is a shard of its own")
    return problems


FEW = [check_two_shards]
CHECKS = [check_plan, check_one_run, check_again, check_missing, check_refused, check_auto, check_two_machines, check_script, check_images, check_expected]
