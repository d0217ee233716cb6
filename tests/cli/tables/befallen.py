"""What befalls a farm's records: copies that break off, two commands at once, disks that fill, clocks that differ, other commits."""
import os
import re
import resource
import shutil
import tempfile

from farm import Farm, SHARDS, read
from losses import LIMIT_S, wait_for

# raster-1 has four groups of one cell, and each shard one of them.
TABLE, GROUPS = "raster-1", 4
FILES = [TABLE + form for form in (".csv", ".json", ".md", ".tex")]


def clock(runner, back_s):
    """Variables of a node whose clock is set back by so many seconds, and again whenever it is read."""
    return {"LD_PRELOAD": runner.earlier, "EARLIER_BY_S": str(back_s), "EARLIER_EVERY": "1"}


def farm(runner):
    """Each node's clock is an hour behind the one before it."""
    if not hasattr(runner, "befallen"):
        runner.befallen = Farm(runner, [TABLE], lambda i: clock(runner, 3600 * i))
    return runner.befallen


def merge(made, *folders, to, more=()):
    return made.runner.run(["merge", made.plan, *folders, "-o", to, *more])


def contents(folder):
    return {name: open(os.path.join(folder, name), "rb").read() for name in os.listdir(folder)}


def counts_all(made, done, folder):
    """Problems if the merged table lacks a cell, or has one twice."""
    rows = [cell["row"] for cell in read(folder, TABLE + ".json")["cells"]] if os.path.isdir(folder) else []
    whole = done.returncode == 0 and not done.stderr and "%d cells of %d, key " % (GROUPS, GROUPS) in done.stdout
    return [] if whole and len(rows) == GROUPS and all(rows.count(row) == 1 for row in rows) else ["%s, %s: %s" % (folder, rows, done)]


def check_clocks(runner):
    """nodes whose clocks are hours apart, and files of the future and the past, make one run"""
    made, problems = farm(runner), []
    problems += ["shard: %s" % shard for shard in made.measured if shard.returncode or not re.fullmatch(r"raster-1/\d: 1 cells, .*\n", shard.stdout)]
    with tempfile.TemporaryDirectory() as tmp:
        copy = made.copy(tmp + "/copy")
        for i, name in enumerate(sorted(os.listdir(copy))):
            os.utime(os.path.join(copy, name), (1e9 + 3e9 * (i % 2),) * 2)
        problems += counts_all(made, merge(made, copy, to=tmp + "/out"), tmp + "/out")
        there = runner.run(made.shard("1/4", copy), clock(runner, 60))
        if there.returncode or there.stdout or "shard 1 of 4: 1 of 1 groups were there" not in there.stderr:
            problems.append("again: %s" % there)
    return problems


def check_two_merges(runner):
    """two merges at once, into one folder and into two, each write what one alone writes"""
    made = farm(runner)
    with tempfile.TemporaryDirectory() as tmp:
        problems = counts_all(made, merge(made, made.records, to=tmp + "/alone"), tmp + "/alone")
        for outs in (("one", "one"), ("a", "b")):
            ways = [runner.start(["merge", made.plan, made.records, "-o", os.path.join(tmp, out)]) for out in outs]
            told = [process.communicate(timeout=LIMIT_S) for process in ways]
            problems += ["%s: %s" % (out, said) for out, process, said in zip(outs, ways, told) if process.returncode or said[1]]
            problems += [out + ": differs from a merge alone" for out in outs if contents(os.path.join(tmp, out)) != contents(tmp + "/alone")]
    return problems


def check_two_shards(runner):
    """a shard that runs twice at once leaves one record of each group, and no part of another"""
    made, problems = farm(runner), []
    with tempfile.TemporaryDirectory() as tmp:
        copy = made.copy(tmp + "/copy")
        name = sorted(os.listdir(copy))[0]
        os.remove(os.path.join(copy, name))
        number = next(i for i in range(1, SHARDS + 1) if "raster-1/1:" in made.measured[i - 1].stdout)
        both = [runner.start(made.shard("%d/4" % number, copy), clock(runner, 3600 * i)) for i in (1, 2)]
        told = [process.communicate(timeout=LIMIT_S) for process in both]
        problems += ["%s" % (said,) for process, said in zip(both, told) if process.returncode]
        if sorted(os.listdir(copy)) != sorted(made.files()):
            problems.append("left: %s" % os.listdir(copy))
        return problems + counts_all(made, merge(made, copy, to=tmp + "/out"), tmp + "/out")


def check_cut(runner):
    """a record that was cut anywhere counts as missing, in a line; its shard measures it again, and then all are there"""
    made, problems = farm(runner), []
    with tempfile.TemporaryDirectory() as tmp:
        copy = made.copy(tmp + "/copy")
        name = sorted(os.listdir(copy))[0]
        path = os.path.join(copy, name)
        size = os.path.getsize(path)
        for kept in (size - 1, size - 2, size // 2, 100, 1, 0):
            os.truncate(path, kept)
            done = merge(made, copy, to=tmp + "/out")
            lines = done.stderr.splitlines()
            if done.returncode != 3 or len(lines) != 3 or not lines[0].startswith("raingauge: warning: " + path) or \
                    not lines[0].endswith("; measure its group again") or "raster-1/1: missing, 1 cell" not in lines[1] or os.path.exists(tmp + "/out"):
                problems.append("%d of %d bytes: %s" % (kept, size, done))
        left = runner.run(["plan", "--missing", made.plan, copy])
        again = runner.run(made.shard("%s/4" % left.stdout.strip(), copy), clock(runner, 3600))
        if left.returncode or again.returncode or "measure its group again: that is done now" not in again.stderr or "raster-1/1: 1 cells" not in again.stdout:
            problems.append("again: %s\n%s" % (left, again))
        return problems + counts_all(made, merge(made, copy, to=tmp + "/out"), tmp + "/out")


def check_half_copied(runner):
    """a folder that is half copied, as rsync and cp do, lacks cells; beside the whole one it is told which records are there twice"""
    made, problems = farm(runner), []
    with tempfile.TemporaryDirectory() as tmp:
        half = made.copy(tmp + "/half")
        names = sorted(os.listdir(half))
        os.rename(os.path.join(half, names[0]), os.path.join(half, ".%s.Xy12Z" % names[0]))
        shutil.copy(os.path.join(half, names[1]), os.path.join(half, "." + names[1]))
        os.truncate(os.path.join(half, names[2]), 2048)
        os.remove(os.path.join(half, names[3]))
        done = merge(made, half, to=tmp + "/out")
        if done.returncode != 3 or "3 of 4 cells are missing" not in done.stderr or os.path.exists(tmp + "/out"):
            problems.append("half: %s" % done)
        part = merge(made, half, to=tmp + "/part", more=["--partial"])
        if part.returncode or [cell["row"] for cell in read(tmp, "part", TABLE + ".json")["cells"]] != [read(half, names[1])["cells"][0]["row"]]:
            problems.append("part: %s" % part)
        both = merge(made, half, made.records, to=tmp + "/both")
        twice = [line for line in both.stderr.splitlines() if "is there twice; " in line]
        if both.returncode or len(twice) != 1 or names[1] not in twice[0] or len(read(tmp, "both", TABLE + ".json")["cells"]) != GROUPS:
            problems.append("both: %s" % both)
    return problems


def check_other_commit(runner):
    """a record of another commit is named and refused by all that read it, and nothing is written or measured"""
    made, problems = farm(runner), []
    with tempfile.TemporaryDirectory() as tmp:
        copy = made.copy(tmp + "/copy")
        path = os.path.join(copy, sorted(os.listdir(copy))[0])
        commit = read(path)["passport"]["raingauge"]["commit"]
        with open(path, encoding="utf-8") as file:
            text = file.read().replace('"commit":"%s"' % commit, '"commit":"%s"' % ("0" * 40))
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        number = next(i for i in range(1, SHARDS + 1) if "raster-1/1:" in made.measured[i - 1].stdout)
        for args in (["merge", made.plan, copy, "-o", tmp + "/out"], ["merge", made.plan, copy, "--partial", "-o", tmp + "/out"],
                     ["plan", "--missing", made.plan, copy], made.shard("%d/4" % number, copy)):
            done = runner.run(args)
            says = "raingauge: %s: is of commit %s, and the plan is of %s; " % (path, "0" * 40, commit)
            if done.returncode != 2 or done.stdout or says not in done.stderr:
                problems.append("%s: %s" % (args[0], done))
        if os.listdir(tmp) != ["copy"] or open(path, encoding="utf-8").read() != text:
            problems.append("left behind: %s" % os.listdir(tmp))
    return problems


def check_full(runner):
    """a disk that fills ends a shard at its first lost record and a merge before its table; the same commands then go on"""
    made, problems = farm(runner), []
    ends = r"raingauge: shard 1 of 1: ends here, .*; once they can be written, the same command goes on\n"
    with tempfile.TemporaryDirectory() as tmp:
        planned = runner.run(["plan", TABLE, "--device", "cpu", "--quick", "-o", tmp + "/plan.json"])
        args = ["table", "--plan", tmp + "/plan.json", "-o", tmp + "/records"]
        process = runner.start(args)
        wait_for(lambda: os.path.isdir(tmp + "/records") and os.listdir(tmp + "/records") or process.poll() is not None)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (2000, 2000))
        _, messages = process.communicate(timeout=LIMIT_S)
        left = os.listdir(tmp + "/records")
        if planned.returncode or process.returncode not in (2, 71) or messages.count("cannot be written: ") != 1 or not re.search(ends, messages) or \
                len(left) not in (1, 2, 3):
            problems.append("full: %d, %s, %s" % (process.returncode, left, messages))
        again = runner.run(args)
        if again.returncode or "shard 1 of 1: %d of 4 groups were there" % len(left) not in again.stderr or len(os.listdir(tmp + "/records")) != GROUPS:
            problems.append("again: %s" % again)
        lost = runner.run(["merge", tmp + "/plan.json", tmp + "/records", "-o", tmp + "/out"], limit=2000)
        there = os.listdir(tmp + "/out") if os.path.isdir(tmp + "/out") else []
        if lost.returncode not in (2, 71) or "cannot be written: " not in lost.stderr or there:
            problems.append("merge: %s, %s" % (there, lost))
        done = runner.run(["merge", tmp + "/plan.json", tmp + "/records", "-o", tmp + "/out"])
        if done.returncode or done.stderr or sorted(os.listdir(tmp + "/out")) != FILES:
            problems.append("merge again: %s" % done)
    return problems


CHECKS = [check_clocks, check_two_merges, check_two_shards, check_cut, check_half_copied, check_other_commit, check_full]
