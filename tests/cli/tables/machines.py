"""Records of several machines, as merges leave them: a table a machine, claims side by side, and which verdicts differ."""
import json
import os
import re
import tempfile

import forms

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
KEPT = os.path.join(ROOT, "results", "tables")
TABLES = ("chin-timing", "creus-5.4", "raster-1")
FOLDERS = ("a" * 16, "b" * 16)  # named by comparison keys, whichever


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return json.load(file)


def write(document, *path):
    with open(os.path.join(*path), "w", encoding="utf-8") as file:
        json.dump(document, file)


def record(table, cpu, frame_ms):
    """A kept record as if it were of another machine, on whose cpu 24 launches of Chin's frame took this time."""
    document = forms.unsealed(read(KEPT, table + ".json"))
    document["passport"]["machine"]["cpu"] = cpu
    for cell in document["cells"]:
        if table == "chin-timing" and cell["device"] == "cpu":
            cell["measured"]["launches"] = [[i + 1, frame_ms + 0.01 * (i * 7 % 12), 0, 0, 1] for i in range(24)]
    return document


def two_machines(folder, tables=TABLES):
    for name, cpu, frame_ms in zip(FOLDERS, ("First CPU", "Second CPU"), (10, 50)):
        os.makedirs(os.path.join(folder, name))
        for table in tables:
            write(record(table, cpu, frame_ms), folder, name, table + ".json")


def check_side_by_side(runner):
    """claims of two machines stand side by side, counted a machine each, with the verdicts that differ; claims and the page say the same"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        two_machines(tmp)
        shown = runner.run(["table", "--claims", "--from", tmp])
        says = ("- 5 claims on 5 devices of 2 machines: 2 hold, 12 do not,", "- Holds: 2 (cpu 2 of 5 on A, 0 of 5 on B).",
                "(cpu 1 of 5 on A, 3 of 5 on B; cpu:reference 1 of 5 on A, 1 of 5 on B;", "- A: First CPU, 2 cores, key ",
                "; not as A: cpu Second CPU and not First CPU.", "- 25 verdicts compared between machines: 2 differ.",
                "- Differs: chin-timing, a frame takes at most 31.8 ms on cpu: yes on A, no on B.")
        if shown.returncode or shown.stderr or any(words not in shown.stdout for words in says) or shown.stdout.count("- Differs: ") != 2:
            problems.append("table: %s" % shown)
        rows = re.findall(r"(?m)^\| *chin-timing \| +\"The simulation runs well at 30fps\" \| +(\w) \| +(\w+) \|", shown.stdout)
        if rows != [("A", "yes"), ("B", "no")]:
            problems.append("rows: %s" % rows)
        document = json.loads(runner.run(["table", "--claims", "--json", "--from", tmp]).stdout)
        problems += forms.problems("claims", document)
        found = [(v["machine"], v["verdict"]) for v in document["claims"][0]["verdicts"] if v["device"] == "cpu"]
        machines = [(machine["name"], machine["differs"]) for machine in document["machines"]]
        if found != [("A", "reproduced"), ("B", "not reproduced")] or machines != [("A", None), ("B", "cpu Second CPU and not First CPU")]:
            problems.append("json: %s, %s" % (found, machines))
        for args in (["claims", "--from", tmp], ["table", "--claims", "--wide", "--from", tmp]):
            other = runner.run(args)
            if other.returncode or any(words not in other.stdout.replace("\n  ", " ") for words in says):
                problems.append("%s: %s" % (args, other))
        if "on cpu:reference of A, cpu:reference of B: " not in other.stdout:
            problems.append("reasons: %s" % other.stdout)
        page = runner.run(["report", tmp, "--format", "md"]).stdout
        told = ("- On A (First CPU, 2 cores), of 5: 2 hold, 1 does not hold,", "- On B (Second CPU, 2 cores), of 5: 3 do not hold,",
                "| chin-timing | a frame takes at most 31.8 ms | cpu on A: reproduced, cpu on B: not reproduced |\n")
        if any(words not in page for words in told) or page.count("| cpu on A: reproduced, cpu on B: not reproduced |") != 2:
            problems.append("page: %s" % page)
        one = runner.run(["table", "--claims", "--from", os.path.join(tmp, FOLDERS[0])]).stdout
        if "machine" in one or "| on |" in one or "- Holds: 2 (cpu 2).\n" not in one:
            problems.append("one machine: %s" % one)
    return problems


def check_a_table_each(runner):
    """each machine has its own tables, printed below its name and written into its own folder; none of its files is replaced"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        two_machines(tmp + "/all")
        shown = runner.run(["table", "raster-1", "--from", tmp + "/all", "-o", tmp + "/out"])
        heads = re.findall(r"(?m)^# ([AB]): (\w+ CPU), 2 cores, key (\w{16})\n\n## raster-1$", shown.stdout)
        keys = [key for _, _, key in heads]
        if shown.returncode or shown.stderr or [head[:2] for head in heads] != [("A", "First CPU"), ("B", "Second CPU")] or sorted(os.listdir(tmp + "/out")) != sorted(keys):
            problems.append("%s, %s" % (shown, os.listdir(tmp + "/out")))
        again = runner.run(["table", "--from", tmp + "/out"])
        if sorted(re.findall("(?m)^# .*", again.stdout)) != sorted(re.findall("(?m)^# .*", shown.stdout)) and len(set(keys)) != 2:
            problems.append("again: %s" % again)
        cpus = {read(tmp, "out", key, "raster-1.json")["passport"]["machine"]["cpu"] for key in keys}
        if cpus != {"First CPU", "Second CPU"}:
            problems.append("cpus: %s" % cpus)
        if runner.run(["table", "raster-1", "--from", tmp + "/all", "--format", "tex"]).stdout.count("\n% B: Second CPU, 2 cores, key ") != 1:
            problems.append("tex")
        for source, folder in ((tmp + "/out", tmp + "/out"), (tmp + "/out", os.path.join(tmp, "out", keys[0])), (tmp + "/out", tmp + "/out/" + keys[1] + "/.")):
            done = runner.run(["table", "raster-1", "--rows", "1-1", "--from", source, "-o", folder])
            if done.returncode != 2 or done.stdout or "holds what --from reads, which would be replaced" not in done.stderr:
                problems.append("-o %s: %s" % (folder, done))
    return problems


def check_one_each(runner):
    """a table that a machine has twice, or that another machine measured at another length, is refused; other folders are not read"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        two_machines(tmp, ("chin-timing",))
        os.makedirs(tmp + "/aside")
        write(record("chin-timing", "Third CPU", 10), tmp, "aside", "chin-timing.json")
        if "of 2 machines" not in runner.run(["table", "--claims", "--from", tmp]).stdout:
            problems.append("another folder is read")
        write(record("chin-timing", "First CPU", 10), tmp, FOLDERS[1], "twice.json")
        full = record("chin-timing", "Third CPU", 10)
        full["length"] = "full"
        for path, document, says in ((FOLDERS[1] + "/twice.json", record("chin-timing", "First CPU", 10), "holds table 'chin-timing' twice"),
                                     (FOLDERS[1] + "/twice.json", full, "holds table 'chin-timing' measured quick, and full, which no verdict mixes")):
            write(document, tmp, path)
            for command in (["table", "--claims"], ["claims"]):
                done = runner.run(command + ["--from", tmp])
                if done.returncode != 2 or done.stdout or done.stderr.count("\n") != 1 or says not in done.stderr:
                    problems.append("%s: %s" % (says, done))
            page = runner.run(["report", tmp, "-o", tmp + "/page.html"])
            if page.returncode != 2 or page.stderr.count("\n") != 1 or "holds table 'chin-timing'" not in page.stderr or os.path.exists(tmp + "/page.html"):
                problems.append("page, %s: %s" % (says, page))
    return problems


def check_kept(runner):
    """kept launches give the verdicts of their own machine, and of no other one that is shown beside it"""
    with tempfile.TemporaryDirectory() as tmp:
        two_machines(tmp + "/kept", ("chin-timing",))
        os.makedirs(tmp + "/now/" + FOLDERS[0])
        os.makedirs(tmp + "/now/" + FOLDERS[1])
        for folder, cpu in zip(FOLDERS, ("First CPU", "Second CPU")):
            document = record("chin-timing", cpu, 10)
            for cell in document["cells"]:
                cell["measured"].pop("launches", None)
            write(document, tmp, "now", folder, "chin-timing.json")
        verdicts = {}
        for name, kept in (("both", tmp + "/kept"), ("first", os.path.join(tmp, "kept", FOLDERS[0]))):
            done = runner.run(["table", "--claims", "--json", "--from", tmp + "/now", "--kept", kept])
            claim = json.loads(done.stdout)["claims"][0]
            verdicts[name] = [(v["machine"], v["verdict"]) for v in claim["verdicts"] if v["device"] == "cpu"]
    wanted = {"both": [("A", "reproduced"), ("B", "not reproduced")], "first": [("A", "reproduced"), ("B", "one launch")]}
    return [] if verdicts == wanted else ["%s" % verdicts]


def check_unseen(runner):
    """a verdict that is not seen on a machine is compared with no other"""
    with tempfile.TemporaryDirectory() as tmp:
        two_machines(tmp, ("chin-timing",))
        document = record("chin-timing", "Second CPU", 50)
        for cell in document["cells"]:
            if cell["device"] == "cpu":
                cell.update(status="fail", detail="its image differed")
                del cell["measured"]
        write(document, tmp, FOLDERS[1], "chin-timing.json")
        shown = runner.run(["table", "--claims", "--from", tmp]).stdout
        page = runner.run(["report", tmp, "--format", "md"]).stdout
    told = "- 8 verdicts compared between machines: 0 differ.\n" in shown and "Differs" not in shown and "| cpu on A: reproduced, cpu on B: " not in page.split("<details>")[0]
    return [] if told else [shown + page]


CHECKS = [check_side_by_side, check_a_table_each, check_one_each, check_kept, check_unseen]
