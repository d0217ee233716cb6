"""Tables that were interrupted, are measured anew, or are printed again from stored records."""
import json
import os
import re
import signal
import tempfile

import forms
import losses
from cases import FORMATS, ROOT
from machine import run_json

ALL_WORKS = "table stuppacher-2 raster-1 --rows 1-1 --device cpu "
TWO_TABLES = ALL_WORKS + "--work paper "  # a table is one however many works it has


def check_claims_alone(runner):
    """measured tables print nothing before their claims, which JSON has as one document, and an empty line between two tables"""
    document, status, problems = run_json(runner, TWO_TABLES + "--claims", form="claims")
    about = [table["table"] for table in document["tables"]], {claim["table"] for claim in document["claims"]}
    if status or about != (["stuppacher-2"], {"stuppacher-2"}):
        problems.append("as JSON: exit status %d, of %s" % (status, about))
    claims = runner.run((TWO_TABLES + "--claims --format csv").split())
    tables = runner.run((TWO_TABLES + "--format csv").split())
    found = claims.stdout.splitlines()[:1], tables.stdout.count("\n\n"), tables.stdout[:1] == "\n"
    return problems + ([] if found == (["table,section,claim,cpu"], 1, False) else ["%s, %s" % (found, claims.stderr)])


def check_launches(runner):
    """claims takes launches for its budget, then says that the same command goes on, and it does; stored launches are judged, beside a table too"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        args = ("claims chin-timing --device cpu --budget 1s --json -o " + tmp).split()
        counts = []
        for _ in range(2):
            done = runner.run(args)
            problems += forms.problems("claims", json.loads(done.stdout))
            if done.returncode or "chin-timing: claims are open; the same command goes on (%s/chin-timing-quick.journal)" % tmp not in done.stderr:
                problems.append("exit status %d, %s" % (done.returncode, done.stderr))
            with open(tmp + "/chin-timing-quick.journal", encoding="utf-8") as file:
                launches = json.load(file)["cells"][0]["measured"].get("launches", [])
            counts.append(len(launches))
            problems += ["launches: %s" % launches for _ in range([launch[0] for launch in launches] != list(range(1, len(launches) + 1)))]
        if not 0 <= counts[0] <= counts[1] or os.listdir(tmp) != ["chin-timing-quick.journal"]:
            problems.append("%s launches, %s" % (counts, os.listdir(tmp)))
        # As if 24 launches had been taken on a machine that is fast enough.
        with open(tmp + "/chin-timing-quick.journal", encoding="utf-8") as file:
            record = forms.unsealed(json.load(file))
        for cell in record["cells"]:
            cell["measured"]["launches"] = [[i + 1, 10 + 0.01 * (i * 7 % 12), 0, 0, 1] for i in range(24)]
        del record["checksum"]  # a journal has one for the whole file
        os.remove(tmp + "/chin-timing-quick.journal")
        with open(tmp + "/chin-timing.json", "w", encoding="utf-8") as file:
            json.dump(record, file)
        judged, table = runner.run(["claims", "--from", tmp]).stdout, runner.run(["table", "--from", tmp]).stdout
        beside = json.loads(runner.run(["table", "chin-timing", "--device", "cpu", "--work", "paper", "--claims", "--json", "--kept", tmp]).stdout)
        page = runner.run(["report", os.path.join(ROOT, "results", "tables", "chin-timing.json"), "--format", "md", "--kept", tmp]).stdout
    if page.count("| cpu: reproduced, cpu:reference: one launch, ") != 2:
        problems.append("report --kept: " + page)
    told = {(one["verdict"], one["kept"], one["today"] in ("agrees", "differs"), one["launches"]) for claim in beside["claims"] for one in claim["verdicts"]}
    if "- Holds: 2 (cpu 2)." not in judged or '30fps" (5): reproduced on cpu\n' not in table or told != {("reproduced", True, True, 24)}:
        problems.append("%s\n%s\n%s" % (judged, table, told))
    return problems


def interrupt(runner, args, env):
    """Runs two tables and interrupts the second; the output, the exit status, the messages."""
    process = runner.start(args.split(), env)
    lines = []
    for line in process.stdout:
        lines.append(line)
        if line.startswith("- Full frames of a box"):  # the first table's last line
            break
    process.send_signal(signal.SIGINT)
    out, messages = process.communicate(timeout=300)
    return "".join(lines) + out, process.returncode, messages.splitlines()


def check_interrupted(runner):
    """an interrupted table says so, and the same command goes on with the missing rows"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp, tempfile.TemporaryDirectory() as state:
        env = {"XDG_STATE_HOME": state}
        for place, more in ((tmp + "/out", "-o %s/out" % tmp), (state + "/raingauge", "")):
            first, status, messages = interrupt(runner, TWO_TABLES + more, env)
            # A busy machine may take more than a second to open raster-1, or to end after the line that says so.
            away = messages[-1:] == [losses.AWAY.rstrip()]
            said = messages[:len(messages) - away]
            stopped = len(said) == 1 and re.match(r"raingauge: (raster-1: interrupted|stuppacher-2: done, and then interrupted)", said[0])
            if status != (-signal.SIGINT if away else 130) or not (stopped or (away and not said)):
                problems.append("exit status %d, stderr: %s" % (status, messages))
            if "## raster-1" in first or not first.startswith("## stuppacher-2"):
                problems.append("printed, interrupted:\n" + first)
            if "stuppacher-2-quick.journal" not in os.listdir(place):
                problems.append("%s holds %s" % (place, os.listdir(place)))
            with open(place + "/stuppacher-2-quick.journal") as file:
                problems += forms.problems("table", json.load(file))
            second = runner.run((TWO_TABLES + more).split(), env)
            if second.returncode or not re.fullmatch(r"raingauge: stuppacher-2: 1 of 1 rows .*\n(raingauge: raster-1: 0 of .* have some of .*\n)?", second.stderr):
                problems.append("again: exit status %d, stderr: %s" % (second.returncode, second.stderr))
            rows = [line for line in first.splitlines() if line.startswith("|")]
            if not rows or any(row not in second.stdout for row in rows) or "## raster-1" not in second.stdout:
                problems.append("printed, again:\n" + second.stdout)
            if any(name.endswith(".journal") for name in os.listdir(place)):
                problems.append("left behind: %s" % os.listdir(place))
        if sorted(os.listdir(tmp + "/out")) != sorted(t + "." + f for t in ("stuppacher-2", "raster-1") for f in FORMATS):
            problems.append("written: %s" % os.listdir(tmp + "/out"))
    return problems


def replaces_stored(runner, out, tmp):
    """Problems of storing a part of a stored table in the same place, by any of the folder's names."""
    problems = []
    os.symlink(out, tmp + "/link")
    os.symlink(out + "/raster-1.json", tmp + "/link.json")
    before = {name: os.stat(os.path.join(out, name)).st_ino for name in os.listdir(out)}
    for source, folder in ((out, out), (out, tmp + "/link"), (tmp + "/link", out + "/."), (out + "/raster-1.json", out), (tmp + "/link.json", out)):
        done = runner.run(["table", "raster-1", "--rows", "1-1", "--from", source, "-o", folder])
        said = r"raingauge: .*: holds what --from reads, which would be replaced; name another folder with -o, or leave it out\n"
        if done.returncode != 2 or done.stdout or not re.fullmatch(said, done.stderr):
            problems.append("--from %s -o %s: exit status %d, stderr: %s" % (source, folder, done.returncode, done.stderr))
    after = {name: os.stat(os.path.join(out, name)).st_ino for name in os.listdir(out)}
    return problems + ["what was stored is replaced"] * (after != before)


def check_stored(runner):
    """table --from prints stored measurements as they were printed then, in every format, and opens no device"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        out = tmp + "/out"
        printed = runner.run((ALL_WORKS + "-o " + out).split()).stdout
        env = runner.crashing_vulkan(tmp)  # any command that lists Vulkan's devices then writes to stderr
        again = runner.run(["table", "--from", out], env)
        if again.returncode or again.stderr:
            problems.append("exit status %d, stderr: %s, printed:\n%s" % (again.returncode, again.stderr, again.stdout))
        for table in ("stuppacher-2", "raster-1"):
            for form in FORMATS:
                with open("%s/%s.%s" % (out, table, form)) as file:
                    written = file.read()
                one = runner.run(["table", table, "--from", out + "/%s.json" % table, "--format", form], env)
                if one.returncode or one.stdout != written or (form == "md" and written.strip() not in printed):
                    problems.append("%s, %s:\n%s" % (table, form, one.stdout))
        problems += replaces_stored(runner, out, tmp)
        both = runner.run(["table", "--from", out, "--json", "-o", tmp + "/again"], env)
        with open(tmp + "/both.json", "w") as file:
            file.write(both.stdout)
        joined = runner.run(["table", "--from", tmp + "/both.json"], env)
        if joined.stdout != again.stdout or sorted(os.listdir(tmp + "/again")) != sorted(os.listdir(out)):
            problems.append("several in a file:\n" + joined.stdout)
        with open(out + "/raster-1.json", "a") as file:
            file.write("{")
        for args, says in (("--from " + out, r"raster-1\.json: line \d+ is no JSON: .*; name a file .*"),
                           ("--from %s/none" % tmp, r".*/none: cannot be read: No such file or directory; name .*"),
                           ("--from " + tmp + "/both.json --rows 7-8", r".*both\.json: holds nothing of the .*; .*"),
                           ("creus-5.1 --from %s/both.json" % tmp, r".*both\.json: holds nothing of the .*; .*"),
                           ("--from %s --device cpu" % out, r"--from and --device: choose one"),
                           ("--from %s --full" % out, r"--from and --full: choose one")):
            refused = runner.run(["table"] + args.split(), env)
            if refused.returncode != 2 or refused.stdout or not re.fullmatch(r"raingauge: .*" + says + r"\n", refused.stderr):
                problems.append("%s: exit status %d, stderr: %s" % (args, refused.returncode, refused.stderr))
    return problems


def check_fresh(runner):
    """table --fresh takes nothing from an interrupted run, and neither does a run on other devices"""
    problems = []
    with tempfile.TemporaryDirectory() as state:
        env = {"XDG_STATE_HOME": state}
        interrupt(runner, TWO_TABLES, env)
        other = runner.run(TWO_TABLES.replace("--device cpu", "--device cpu:reference").split(), env)
        if other.returncode or not re.fullmatch(
                r"raingauge: .*stuppacher-2-quick\.journal: is of another .*\n(raingauge: .*raster-1-quick\.journal: is of another .*\n)?", other.stderr):
            problems.append("other: exit status %d, stderr: %s" % (other.returncode, other.stderr))
        interrupt(runner, TWO_TABLES, env)
        fresh = runner.run((TWO_TABLES + "--fresh").split(), env)
        if fresh.returncode or fresh.stderr or "interrupted" in fresh.stdout:
            problems.append("fresh: exit status %d, stderr: %s" % (fresh.returncode, fresh.stderr))
    return problems


CHECKS = [check_claims_alone, check_launches, check_interrupted, check_stored]
LONG = [check_fresh]
