"""A gate keeps each launch in its folder: one that is killed goes on, but not with wrong launches."""
import csv
import fcntl
import json
import os

from baselines import change
from gates import AT_ONCE, KNOT, Files
from losses import wait_for


def kept_launches(folder):
    """The launches that a gate has kept, as text, by case and launch; none: empty."""
    try:
        with open(os.path.join(folder, "gate.journal")) as file:
            rows = json.load(file)["rows"]
    except FileNotFoundError:
        return {}
    return {(case, launch[0]): launch[1:4] for case, launches in rows.items() for launch in launches}


def told_launches(folder):
    with open(os.path.join(folder, "launches.csv"), newline="") as file:
        return {(row["case"], int(row["launch"])): [float(row[name]) for name in ("log_ratio", "a_ms", "b_ms")] for row in csv.DictReader(file)}


def left_by_a_kill(runner, files, folder, sides=("cpu", "cpu")):
    """Kills a gate after it has kept some launches, and returns these."""
    process = runner.start(["gate", *sides, "--cells", files.cells, "-o", folder, *AT_ONCE])
    wait_for(lambda: len(kept_launches(folder)) >= 4 or process.poll() is not None)
    process.kill()
    process.communicate()
    return kept_launches(folder)


def check_killed(runner):
    """a gate that is killed goes on with all launches except the one in progress"""
    with Files() as files:
        folder = files.path("out")
        left = left_by_a_kill(runner, files, folder)
        again = runner.run(["gate", "cpu", "cpu", "--cells", files.cells, "-o", folder, *AT_ONCE])
        told = told_launches(folder)
        names = sorted(os.listdir(folder))
    problems = [] if len(left) >= 4 else ["%d launches were kept" % len(left)]
    if again.returncode not in (0, 3) or "has times of %d launches of a gate that was interrupted" % len(left) not in again.stderr:
        problems.append("exit status %d, %s" % (again.returncode, again.stderr))
    problems += ["launch %s is another" % (key,) for key, values in left.items()
                 if any(abs(a - b) > 1e-8 * abs(a) for a, b in zip(values, told.get(key, [0, 0, 0])))]
    if len(told) <= len(left):
        problems.append("it did not go on: %d launches then, %d in the end" % (len(left), len(told)))
    return problems + (["left: %s" % names] if names != ["launches.csv", "page.html"] else [])


# One cell, here and below: launches are kept alike of each. check_killed has two.
def check_kept(runner):
    """a gate takes neither another gate's launches nor damaged ones; a full disk loses nothing; one gate holds a folder"""
    problems = []
    with Files(KNOT) as files:
        folder = files.path("out")
        left_by_a_kill(runner, files, folder)
        path = os.path.join(folder, "gate.journal")
        with open(path) as file:
            whole = file.read()
        args = ["gate", "cpu", "cpu", "--cells", files.cells, "-o", folder, *AT_ONCE]
        full = runner.run(args, limit=100)
        with open(path) as file:
            after = file.read()
        if after != whole or full.stderr.count("gate.journal") != 1:
            problems.append("full disk: %s, %s" % (full.stderr, "kept" if after == whole else "lost"))
        for name, text, more, says in (("damaged", whole.replace("0.", "1.", 1), [], "is damaged or no journal"),
                                       ("of another margin", whole, ["--margin", "99"], "is of another build, machine, choice"),
                                       ("to be begun anew", whole, ["--fresh"], None)):
            with open(path, "w") as file:
                file.write(text)
            result = runner.run(args + more)
            if result.returncode not in (0, 3) or (says not in result.stderr if says else "launches" in result.stderr):
                problems.append("%s: exit status %d, %s" % (name, result.returncode, result.stderr))
        with open(path, "w") as file:
            file.write(whole)
        change(path, lambda document: document.update(format=99, rows=[]))
        result = runner.run(args)
        if result.returncode not in (0, 3) or "has format 99 of a gate's journal" not in result.stderr:
            problems.append("of another format: exit status %d, %s" % (result.returncode, result.stderr))
        holder = os.open(folder, os.O_RDONLY)
        fcntl.flock(holder, fcntl.LOCK_EX)
        result = runner.run(args)
        os.close(holder)
        if result.returncode != 2 or "another raingauge writes into it" not in result.stderr or result.stderr.count("\n") != 1:
            problems.append("held: exit status %d, %s" % (result.returncode, result.stderr))
    return problems


def check_built_anew(runner):
    """a gate does not go on with times of a build that has changed under the same path"""
    problems = []
    with Files(KNOT) as files:
        folder, path, other = files.path("out"), files.path("out/gate.journal"), files.path("other")
        sides = ["--against", other, "--device", "cpu"]
        os.symlink(runner.raingauge, other)
        left = left_by_a_kill(runner, files, folder, sides)
        for program, is_kept in ((runner.raingauge, True), (runner.slower, False)):
            with open(path) as file:
                whole = file.read()
            os.remove(other)
            os.symlink(program, other)
            result = runner.run(["gate", *sides, "--cells", files.cells, "-o", folder, *AT_ONCE])
            told = told_launches(folder)
            same = [key for key, values in left.items() if all(abs(a - b) <= 1e-8 * abs(a) for a, b in zip(values, told.get(key, [0, 0, 0])))]
            if result.returncode not in (0, 3) or ("is of another build" in result.stderr) == is_kept or len(same) != is_kept * len(left):
                problems.append("%s: exit status %d, %d of %d are the same, %s" % (program, result.returncode, len(same), len(left), result.stderr))
            with open(path, "w") as file:
                file.write(whole)
    return problems


def check_baseline(runner):
    """a gate with a baseline that was killed goes on too, but not with another baseline"""
    problems = []
    with Files(KNOT) as files:
        folder, was, path = files.path("out"), files.path("baseline.json"), files.path("out/gate.journal")
        make = ["baseline", "--device", "cpu", "--launches", "8", "--cells", files.cells, "-o", was]
        runner.run(make)
        sides = ["--baseline", was]
        left = left_by_a_kill(runner, files, folder, sides)
        if len(left) < 4:
            return ["%d launches were kept" % len(left)]
        with open(path) as file:
            whole = file.read()
        for is_kept in (True, False):
            result = runner.run(["gate", *sides, "--cells", files.cells, "-o", folder, *AT_ONCE])
            with open(os.path.join(folder, "launches.csv"), newline="") as file:
                rows = list(csv.DictReader(file))
            told = {(row["case"], int(row["launch"])): row for row in rows}
            same = [key for key, values in left.items() if key in told and abs(values[2] - float(told[key]["b_ms"])) <= 1e-8 * values[2]]
            if result.returncode not in (0, 1, 3) or len(same) != is_kept * len(left) or len(told) <= is_kept * len(left) or os.path.exists(path):
                problems.append("%s: exit status %d, %d of %d are the same, %d in the end, %s"
                                % (is_kept, result.returncode, len(same), len(left), len(told), result.stderr))
            if any(row["log_ratio"] or row["a_ms"] for row in rows):
                problems.append("a ratio of what is not there: %s" % rows[0])
            with open(path, "w") as file:
                file.write(whole)
            os.remove(was)
            runner.run(make)  # a new baseline with other times
    return problems


CHECKS = [check_killed, check_kept, check_built_anew, check_baseline]
