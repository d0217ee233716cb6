"""What table, diff, render and verify print: each form well-formed, the machine forms as docs/records.md has them."""
import csv
import io
import json
import math
import os
import pty
import re
import shutil
import signal
import struct
import subprocess
import tempfile
import threading
import time
import zlib

import forms
import misbehaving
from cases import DIFF, FORMATS, NO_CACHE, RENDER, SMALL, STAGES, TABLE
from runner import NO_DRIVERS


ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def run_json(runner, args, env={}, form=None):
    """What the command prints as JSON, its exit status, and its messages as a list of problems."""
    result = runner.run((args + " --json").split(), env)
    document = json.loads(result.stdout)
    problems = forms.problems(form or args.split()[0], document)
    return document, result.returncode, problems + ["stderr: " + line for line in result.stderr.splitlines()]


def lacking(where, record, fields):
    """Problems: what a record lacks of `fields`, and where a value is of another type."""
    return ["%s: %s is %r" % (where, name, record.get(name)) for name, kind in fields.items()
            if not isinstance(record.get(name), kind) or isinstance(record.get(name), bool) != (kind is bool)]


def check_table_json(runner):
    """table --json holds the passport, and for each cell what was published, measured and counted"""
    report, status, problems = run_json(runner, TABLE)
    problems += lacking("table", report, {"format": int, "table": str, "passport": dict, "cells": list})
    if (report["format"], report["table"], status, len(report["cells"])) != (1, "stuppacher-2", 0, 1):
        problems.append("format %s, table %s, exit status %d" % (report["format"], report["table"], status))
    for cell in report["cells"]:
        problems += lacking("cell", cell, {"row": dict, "set": str, "device": str, "variant": str, "status": str,
                                           "published": dict, "measured": dict, "counters": dict, "facts": dict})
        problems += lacking("measured", cell["measured"], {name: float for name in ("fps", "ms", "ms_low", "ms_high")})
        if (cell["status"], cell["device"], cell["row"], cell["published"]) != ("ok", "cpu", {"texture_px": 128}, {"fps": 480}):
            problems.append("cell: %s" % cell)
        if not cell["counters"] or not all(isinstance(n, int) and n > 0 for n in cell["counters"].values()):
            problems.append("counters: %s" % cell["counters"])
        shares, passes = cell["measured"]["passes_share"], cell["measured"]["passes_ms"]
        if list(shares) != list(passes) or abs(sum(shares.values()) - 1) > 1e-6 or "flow_mirror" not in shares:
            problems.append("passes: %s, shares: %s" % (passes, shares))
    return problems


def check_tallies(runner):
    """table --json tells the exact work of a frame, the same on two devices but for what cpu:reference alone can count"""
    report, _, problems = run_json(runner, TABLE.replace("--device cpu", "--device cpu:reference,cpu"))
    reference, cpu = (cell["tally"] for cell in report["cells"])
    alone = {name for name in reference if cpu[name] != reference[name]}
    if alone != {"fragments_kept", "texels_fetched"} or any(cpu[name] is not None for name in alone):
        problems.append("cpu:reference: %s, cpu: %s" % (reference, cpu))
    if not all(reference[name] for name in ("runs", "dispatches", "items", "records", "fragments", "texels_fetched")):
        problems.append("counted: %s" % reference)
    return problems


def check_growth(runner):
    """a table of no paper tells what counters grow by in a frame, and the exponent of its time along the rows"""
    report, status, problems = run_json(runner, "table chin-drops --rows 1-2 --device cpu")
    cells, shape = report["cells"], report["shapes"][0]
    if status or len(report["shapes"]) != 1 or shape["verdict"] != "growth" or shape["published_slope"] is not None:
        problems.append("exit status %d, shapes: %s" % (status, report["shapes"]))
    if not shape["slope_low"] <= shape["slope"] <= shape["slope_high"] < 0:
        problems.append("shape: %s" % shape)
    for cell in cells:  # it rains until the pane is full, and goes on
        drops, most = cell["counted"]["drops_stepped"], cell["row"]["max_drops"]
        if list(cell["counted"]) != ["drops_stepped", "cells_stepped", "merging_steps"] or not 0.9 * most <= drops <= most:
            problems.append("%d drops: %s" % (most, cell["counted"]))
    return problems


def check_changed(runner):
    """table --set, --variant, --work and --rows hold together, the record tells of them, and nothing changed is held against print"""
    with tempfile.TemporaryDirectory() as tmp:
        args = "table stuppacher-2 --rows 1-2 --work reading --variant full --device cpu --set drops=7 --set rain_drops_s=0"
        report, status, problems = run_json(runner, args + " -o " + tmp, form="table")
        texts = {form: open("%s/stuppacher-2.%s" % (tmp, form), encoding="utf-8").read() for form in FORMATS}
        again = runner.run(["table", "--from", tmp, "--json"]).stdout
        none = runner.run(["table", "--from", tmp, "--variant", "no_geometry"])
    if json.loads(again) != report or none.returncode != 2:
        problems.append("from the record: %s\n%s" % (again[:200], none.stderr))
    if status or report.get("changed") != "drops=7 rain_drops_s=0" or [work["name"] for work in report["works"]] != ["reading"]:
        problems.append("exit status %d, changed: %s, works: %s" % (status, report.get("changed"), report["works"]))
    for cell in report["cells"]:
        if not cell["set"].endswith("view=pane drops=7 rain_drops_s=0") or cell["counters"]["drops_landed"] != 7:
            problems.append("cell: %s, %s" % (cell["set"], cell["counters"]))
    if [shape["verdict"] for shape in report["shapes"]] != ["other work"]:
        problems.append("shapes: %s" % report["shapes"])
    if "drops=7 rain_drops_s=0" not in texts["md"] or any(row["fps / published"] for row in csv.DictReader(io.StringIO(texts["csv"]))):
        problems.append(texts["md"] + texts["csv"])
    return problems


def check_no_rain(runner):
    """a cell whose picture is the same without rain fails on every device and has no number, in the table and before the claims"""
    problems = []
    for table, hidden in (("stuppacher-2", ["drops=0", "rain_drops_s=0"]), ("ye-1", ["opacity=0"])):
        with tempfile.TemporaryDirectory() as tmp:
            sets = [word for one in hidden for word in ("--set", one)]
            done = runner.run(["table", table, "--rows", "1-1", "--device", "cpu,cpu:reference", "-o", tmp] + sets)
            record = json.loads(open("%s/%s.json" % (tmp, table), encoding="utf-8").read())
            cells = {(cell["device"], cell["status"], "measured" in cell) for cell in record["cells"]}
            if done.closing != "raingauge: 0 of {0} cells measured on 2 devices; {0} failed\n".format(len(record["cells"])):
                problems.append("%s: %s" % (table, done.closing))
            if done.returncode != 1 or cells != {("cpu", "fail", False), ("cpu:reference", "fail", False)} or "without rain" not in done.stdout:
                problems.append("%s: exit status %d, %s\n%s" % (table, done.returncode, cells, done.stdout))
            del record["changed"]  # else claims would be about other work
            with open(tmp + "/claims.json", "w", encoding="utf-8") as file:
                json.dump(forms.unsealed(record), file)
            claims = runner.run(["table", "--claims", "--wide", "--from", tmp + "/claims.json"]).stdout
        if "has no number: its image is the same without rain" not in claims or "| reproduced" in claims or "not reproduced" in claims:
            problems.append("claims of %s:\n%s" % (table, claims))
    return problems


def check_brief(runner):
    """table prints one line a row, in colours on a terminal alone, and --wide one line a cell with all columns"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        runner.run((TABLE.replace("--work paper ", "") + "-o " + tmp).split())
        stored = ["table", "--from", tmp]
        brief, wide = runner.run(stored).stdout, runner.run(stored + ["--wide"]).stdout
        refused = runner.run(stored + ["--wide", "--json"]).returncode
        shown = on_terminal(runner, stored, {"TERM": "xterm", "NO_COLOR": None})
        claims = on_terminal(runner, ["table", "--claims", "--from", "%s/results/tables" % ROOT], {"TERM": "xterm", "NO_COLOR": None})
        plain = [on_terminal(runner, stored, env) for env in ({"TERM": "xterm", "NO_COLOR": "1"}, {"TERM": "dumb", "NO_COLOR": None})]
    lines = [line for line in brief.split("\n") if re.match(r"\| +128 \|", line)]
    if len(lines) != 3 or not re.fullmatch(r"\| +128 \| +480 \| .* \d+(\.\d+)?x \|", lines[0]):
        problems.append("brief:\n" + brief)
    if "API / wall clock" not in wide or "API / wall clock" in brief or len(re.findall(r"\n\| +128 \|", wide)) != 3:
        problems.append("wide:\n" + wide)
    if "\033" in brief or "\033[3" not in shown or re.sub(r"\033\[\d+m", "", shown) != brief or plain != [brief, brief]:
        problems.append("on a terminal: %r\n%r" % (shown, plain))
    if "\033[32myes\033[0m" not in claims or "\033[31mno\033[0m" not in claims or "reproduced" not in re.sub(r"\033\[\d+m", "", claims):
        problems.append("claims on a terminal: %r" % claims)
    return problems + ["--wide is taken with another form: %s" % refused] * (refused != 2)


SWEEP = ("sweep flow --axis resolution_px=32,64..96 --axis panes=mirror,glass --axis device=cpu,cpu:reference "
         "--set move=paper --set model=none --set environment=sky --set environment_px=16 --size 64x64 --frame 3 ")


def check_sweep(runner):
    """sweep plans, then measures each combination on each device, as a table that is printed, written and read like others"""
    problems = []
    plan = r"plan: 6 rows on cpu, cpu:reference, 12 cells; about [\d.]+ s \(cpu [\d.]+ s, cpu:reference [\d.]+ s\), about \d+ MB with .*\n"
    dry = runner.run((SWEEP + "--dry-run").split())
    if dry.returncode or dry.stderr or not re.fullmatch(plan, dry.stdout):
        problems.append("dry run: %d, %s%s" % (dry.returncode, dry.stdout, dry.stderr))
    with tempfile.TemporaryDirectory() as tmp:
        start = time.monotonic()
        run = runner.run((SWEEP + "--json -o " + tmp).split())
        took = time.monotonic() - start
        again = runner.run(["table", "--from", tmp, "--json"]).stdout
        made = sorted(os.listdir(tmp))
        brief = open(tmp + "/sweep-flow.md", encoding="utf-8").read()
    report = json.loads(run.stdout)
    problems += forms.problems("table", report)
    if run.returncode or again != run.stdout or made != ["sweep-flow." + form for form in FORMATS] or not re.fullmatch(plan, run.stderr) or \
            run.closing != "raingauge: 12 cells measured on 2 devices\n" or dry.closing:
        problems.append("exit status %d, made %s, %s%s" % (run.returncode, made, run.stderr, run.closing))
    rows = [(px, panes) for px in (32, 64, 96) for panes in ("mirror", "glass")]
    wanted = [({"resolution_px": px, "panes": panes}, device) for px, panes in rows for device in ("cpu", "cpu:reference")]
    if [(cell["row"], cell["device"]) for cell in report["cells"]] != wanted:
        problems.append("cells: %s" % [(cell["row"], cell["device"]) for cell in report["cells"]])
    for cell in report["cells"]:
        own = "resolution_px=%d panes=%s " % (cell["row"]["resolution_px"], cell["row"]["panes"])
        if cell["status"] != "ok" or cell["set"] != own + report["changed"] or "move=paper" not in report["changed"]:
            problems.append("cell: %s, %s" % (cell["status"], cell["set"]))
    if (report["hardware"], report["size_px"], report["check_frames"]) != (None, [64, 64], 3):
        problems.append("%s" % [report[name] for name in ("hardware", "size_px", "check_frames")])
    if "| resolution, px |  panes |" not in brief or max(map(len, brief.split("\n"))) > 110:
        problems.append(brief)
    told = float(re.search(r"about ([\d.]+) s", run.stderr).group(1))
    if not told / 4 < took < 4 * told + 5:  # a busy machine's speed varies as much
        problems.append("%s s were planned, and %.1f s taken" % (told, took))
    return problems


def on_terminal(runner, args, env):
    """What a command prints where its stdout is a terminal."""
    ours, its = pty.openpty()
    parts = []

    def read():
        try:
            while part := os.read(ours, 65536):
                parts.append(part)
        except OSError:  # the terminal's end
            pass

    reader = threading.Thread(target=read)  # a terminal holds some kilobytes, and its writer waits
    reader.start()
    process = runner.run(args, env, stdout=its)
    os.close(its)
    reader.join()
    os.close(ours)
    return b"".join(parts).decode("utf-8").replace("\r\n", "\n") + process.stderr


def check_forms(runner):
    """what list prints, and a table of textures, are as the schema has them, whose fields are all documented"""
    problems = ["docs/records.md does not tell of %s" % name for name in forms.undocumented()]
    for args in ("list techniques", "list tables", "list figures", "list devices", "list params raster", "table creus-5.2 --rows 1-1 --device cpu"):
        problems += [line for line in run_json(runner, args)[2] if not line.startswith("stderr: ")]
    # What is wrong is found.
    document = run_json(runner, "list techniques")[0]
    document["techniques"][0]["colour"] = "red"
    document["techniques"][1]["about"] = 1
    if not forms.problems("list", document):
        problems.append("a wrong document is taken")
    return problems


def check_tables_in_a_row(runner):
    """table with several names prints each, apart"""
    problems = []
    text = runner.run((TABLE + "stuppacher-2").split()).stdout
    if not re.fullmatch(r"## stuppacher-2\n\n.*\n\n## stuppacher-2\n\n.*", text, re.S):
        problems.append("md:\n" + text)
    parts = runner.run((TABLE + "stuppacher-2 --format csv").split()).stdout.split("\n\n")
    if len(parts) != 2:
        problems.append("csv: %s" % parts)
    for part in parts:
        problems += check_csv(part)
    return problems


def check_render_json(runner):
    """render --json says what it drew, with every parameter's value"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        record, status, problems = run_json(runner, RENDER + "-o %s/a.png" % tmp)
        problems += lacking("render", record, {"format": int, "settings": dict, "facts": dict, "counters": dict, "passport": dict})
        found = tuple(record.get(key) for key in ("file", "technique", "device", "width", "height", "frame"))
        if status or found != (tmp + "/a.png", "flow", "cpu", 32, 32, 1):
            problems.append("exit status %d, %s" % (status, found))
    params = json.loads(runner.run("list params flow --json".split()).stdout)["params"]
    if [param["name"] for param in params] != list(record["settings"]) or record["settings"]["resolution_px"] != "32":
        problems.append("settings: %s" % record["settings"])
    return problems


FOREIGN = os.fsdecode(b"cpu@N=\xff\x1b[2J")  # no UTF-8, and what clears a terminal


def check_foreign(runner):
    """a device's name that is no UTF-8 has question marks in every machine form, and steers no terminal"""
    problems, marked = [], "cpu@N=?\x1b[2J"
    with tempfile.TemporaryDirectory() as tmp:
        for args, named in ((RENDER + "-o %s/a.png" % tmp, lambda told: [told["device"], told["passport"]["devices"][0]["name"]]),
                            (STAGES.replace("--device cpu ", ""), lambda told: [check["device"] for check in told["checks"]]),
                            (DIFF.replace("--device cpu,cpu:reference ", ""), lambda told: [told["pairs"][0]["b"]]),
                            (TABLE.replace("--device cpu ", ""), lambda told: [cell["device"] for cell in told["cells"]])):
            both = "cpu:reference," if args.startswith("diff") else ""
            done = runner.run(args.split() + ["--json", "--device", both + FOREIGN])
            names = {name.replace("?[2J", "\x1b[2J") for name in named(json.loads(done.stdout or "null"))} if done.stdout.strip() else None
            if done.returncode or done.stderr or names != {marked}:
                problems.append("%s: exit status %d, named %s, %s" % (args, done.returncode, names, done.stderr))
        text = runner.run(RENDER.split() + ["-o", tmp + "/a.png", "--device", FOREIGN.replace(os.fsdecode(b"\xff"), "y")])
        if text.returncode or "on cpu@N=y?[2J (" not in text.stdout:
            problems.append("text: %r %s" % (text.stdout, text.stderr))
    return problems


def check_table_files(runner):
    """table -o writes what table prints: csv of equal lines, balanced tex, an md table of equal columns"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        runner.run(TABLE.split() + ["-o", tmp])
        texts = {}
        for name in os.listdir(tmp):
            with open(os.path.join(tmp, name)) as file:
                texts[name.split(".")[-1]] = file.read()
    if json.loads(texts["json"])["table"] != "stuppacher-2":
        problems.append("json: " + texts["json"])
        for form, check in (("csv", check_csv), ("tex", check_tex), ("md", check_md)):
            problems += check(texts[form]) + check(runner.run(["table", "--from", tmp, "--format", form]).stdout)
    problems += check_md(runner.run(TABLE.split()).stdout)
    return problems


def check_csv(text):
    lines = list(csv.reader(io.StringIO(text), strict=True))
    equal = len(lines) == 2 and len({len(line) for line in lines}) == 1 and len(lines[0]) > 5
    return [] if equal and lines[1][:4] == ["128", "480", "paper", "cpu"] else ["csv:\n" + text]


def check_tex(text):
    open_environments = []
    for kind, name in re.findall(r"\\(begin|end)\{(\w+)\}", text):
        if kind == "begin":
            open_environments.append(name)
        elif not open_environments or open_environments.pop() != name:
            return ["tex: \\end{%s} ends nothing:\n%s" % (name, text)]
    columns = len(re.search(r"\\begin\{tabular\}\{(\w+)\}", text).group(1))
    rows = [line for line in text.splitlines() if line.endswith(r"\\")]
    bare = re.findall(r"(?<!\\)[%#_$]", text)
    if open_environments or bare or len(rows) != 2 or any(len(re.findall(r"(?<!\\)&", row)) != columns - 1 for row in rows):
        return ["tex: unbalanced, or a bare %s:\n%s" % (bare, text)]
    return []


def check_md(text):
    rows = [line for line in text.splitlines() if line.startswith("|")]
    equal = len(rows) == 3 and len({row.count("|") for row in rows}) == 1 and len({len(row) for row in rows}) == 1
    return [] if equal and set(rows[1]) <= set("|-:") else ["md:\n" + text]


PAIR = {"a": str, "b": str, "tier": str, "max": int, "differing": int, "mask": int, "flip_mean": float}


def check_diff_json(runner):
    """diff --json has a record for every pair, of devices and of files"""
    report, status, problems = run_json(runner, DIFF)
    pair = report["pairs"][0]
    problems += lacking("pair", pair, PAIR)
    if (report["format"], len(report["pairs"]), status) != (1, 1, 0):
        problems.append("format %s, %d pairs, exit status %d" % (report["format"], len(report["pairs"]), status))
    found = tuple(pair[key] for key in ("a", "b", "tier", "max", "differing", "psnr"))
    if found != ("cpu", "cpu:reference", "T0", 0, 0, None) or not 0 < pair["mask"] < 96 * 96:
        problems.append("pair: %s, mask %s" % (found, pair["mask"]))
    with tempfile.TemporaryDirectory() as tmp:
        for name, exposure in (("a", "1"), ("b", "2")):
            runner.run((RENDER + "--exposure %s -o %s/%s.png" % (exposure, tmp, name)).split())
        report, status, messages = run_json(runner, "diff {0}/a.png {0}/b.png".format(tmp))
    pair = report["pairs"][0]
    problems += messages + lacking("files", pair, dict(PAIR, psnr=float))
    if status != 1 or pair["tier"] == "T0" or pair["max"] == 0 or pair["differing"] == 0:
        problems.append("files: exit status %d, %s" % (status, pair))
    return problems


def write_tiff(path, texels):
    """A row of grey floats: the header, the row, and the fields that say what it is."""
    row = struct.pack("<%df" % len(texels), *texels)
    fields = [(256, len(texels)), (257, 1), (258, 32), (259, 1), (262, 1), (273, 8), (277, 1), (278, 1), (279, len(row)), (339, 3)]
    with open(path, "wb") as file:
        file.write(struct.pack("<2sHI", b"II", 42, 8 + len(row)) + row + struct.pack("<H", len(fields)))
        file.write(b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in fields) + bytes(4))


def check_diff_not_finite(runner):
    """diff --json has a record of pictures with a NaN, whichever is the true one, and names a file that is not UTF-8"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        whole, broken, foreign = ("%s/%s.tif" % (tmp, name) for name in ("a", "b", os.fsdecode(b"c\xff")))
        write_tiff(whole, [0.5] * 64)
        write_tiff(broken, [0.5] * 63 + [math.nan])
        shutil.copy(whole, foreign)
        for pair in ((whole, broken), (broken, whole)):
            done = runner.run(["diff", *pair, "--json"])
            report = json.loads(done.stdout or '{"pairs": []}')
            problems += forms.problems("diff", report) if report["pairs"] else ["no pair: " + done.stderr]
            found = [(told["relative_mean"], told["linear"]["nonfinite_mismatches"]) for told in report["pairs"]]
            if done.returncode != 1 or found != [(0, 1)]:
                problems.append("exit status %d, %s" % (done.returncode, found))
        done = subprocess.run([runner.raingauge, "diff", whole, foreign, "--json"], env=runner.variables({}), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", errors="replace", timeout=60, check=False)
    if done.returncode != 2 or done.stdout or not re.search(r"c\S*\.tif' is not UTF-8; give", done.stderr) or "a.tif" in done.stderr:
        problems.append("exit status %d, %s%s" % (done.returncode, done.stdout, done.stderr))
    return problems


def check_full_stdout(runner):
    """results that do not fit on standard output are an error, and nothing else is written to where it was closed"""
    problems = []
    for args in ("list techniques", DIFF + "--json"):
        closed = subprocess.run(["sh", "-c", '"$0" "$@" >&-', runner.raingauge, *args.split()], env=runner.variables({}), capture_output=True,
                                text=True, timeout=60, check=False)
        if closed.returncode != 2 or not re.fullmatch(r"raingauge: standard output: .*\n", closed.stderr):
            problems.append("%s, closed: exit status %d, stderr: %s" % (args, closed.returncode, closed.stderr))
    for args in ("--help", "--version", "render --help", "list techniques", "list params flow --json", STAGES, DIFF + "--json"):
        with open("/dev/full", "w") as full:
            result = runner.run(args.split(), stdout=full)
        if result.returncode != 2 or not re.fullmatch(r"raingauge: standard output: .*\n", result.stderr):
            problems.append("%s: exit status %d, stderr: %s" % (args, result.returncode, result.stderr))
    return problems


TWO_TABLES = "table stuppacher-2 raster-1 --rows 1-1 --device cpu "


def check_claims_alone(runner):
    """measured tables leave nothing before their claims, which JSON alone has as one document, and an empty line between two tables"""
    document, status, problems = run_json(runner, TWO_TABLES + "--claims", form="claims")
    about = [table["table"] for table in document["tables"]], {claim["table"] for claim in document["claims"]}
    if status or about != (["stuppacher-2"], {"stuppacher-2"}):
        problems.append("as JSON: exit status %d, of %s" % (status, about))
    claims = runner.run((TWO_TABLES + "--claims --format csv").split())
    tables = runner.run((TWO_TABLES + "--format csv").split())
    found = claims.stdout.splitlines()[:1], tables.stdout.count("\n\n"), tables.stdout[:1] == "\n"
    return problems + ([] if found == (["table,section,claim,cpu"], 1, False) else ["%s, %s" % (found, claims.stderr)])


def interrupt(runner, args, env):
    """Runs two tables and interrupts the second; what was printed, the exit status, the messages."""
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
    """a table that is interrupted says so, and the same command goes on with what is missing"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp, tempfile.TemporaryDirectory() as state:
        env = {"XDG_STATE_HOME": state}
        for place, more in ((tmp + "/out", "-o %s/out" % tmp), (state + "/raingauge", "")):
            first, status, messages = interrupt(runner, TWO_TABLES + more, env)
            if status != 130 or len(messages) != 1 or not re.match(r"raingauge: (raster-1: interrupted|stuppacher-2: done, and then interrupted)", messages[0]):
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
    """What is wrong with a part of what is stored, written where it is stored, by any of the folder's names."""
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
    """table --from prints what was measured as it was printed then, in every format, and opens no device"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        out = tmp + "/out"
        printed = runner.run((TWO_TABLES + "-o " + out).split()).stdout
        env = runner.crashing_vulkan(tmp)  # whoever lists Vulkan's devices says so on stderr
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
    """table --fresh takes nothing from an interrupted run; nor does a run of other devices"""
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


def check_atlas(runner):
    """atlas makes its streaks once, then reads them; --json describes them, -o writes them"""
    problems = []
    cache = os.environ["XDG_CACHE_HOME"]
    kept = os.path.join(cache, "raingauge", "streaks-small.atlas")
    if os.path.exists(kept):
        os.unlink(kept)
    with tempfile.TemporaryDirectory() as out:
        first, status, messages = run_json(runner, "atlas --quick")
        second, again, more = run_json(runner, "atlas --quick -o " + out)
        problems += messages + more + lacking("atlas", first, {
            "format": int, "size": str, "from": str, "seconds": float, "file": str, "bytes": int, "hash": str, "images": list})
        if (status, again, first["from"], second["from"]) != (0, 0, "made", "cache") or first["hash"] != second["hash"]:
            problems.append("exit status %d and %d: %s, %s" % (status, again, first, second))
        if first["file"] != kept or not os.path.getsize(first["file"]) > first["bytes"]:
            problems.append("file: %s" % first)
        shapes = [tuple(image[k] for k in ("name", "width", "height", "layers", "levels")) for image in first["images"]]
        if shapes != [("point", 720, 901, 10, 10), ("env", 8, 901, 10, 10), ("splash", 48, 32, 84, 6)]:
            problems.append("images: %s" % shapes)
        wanted = {"factors.csv", "splash.png"} | {"sheet-%02d.png" % k for k in range(10)}
        wanted |= {"%s-%02d-level-%02d.exr" % (name, layer, level) for name, _, _, layers, levels in shapes
                   for layer in range(layers) for level in range(levels)}
        if set(os.listdir(out)) != wanted:
            problems.append("written: %s" % sorted(set(os.listdir(out)) ^ wanted))
        with open(os.path.join(out, "factors.csv")) as file:
            rows = list(csv.DictReader(file))
        if len(rows) != 10 * 5 * 91 or not all(float(row["factor"]) > 0 for row in rows):
            problems.append("factors.csv: %d rows" % len(rows))
    return problems


def write_codes(path, width, rows):
    """A grey PNG of 16 bits."""
    lines = b"".join(b"\0" + b"".join(struct.pack(">H", code) for code in row) for row in rows)
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 16, 0, 0, 0, 0)), (b"IDAT", zlib.compress(lines)), (b"IEND", b""))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)) for name, data in chunks))


def check_compared(runner):
    """atlas --compare lays pictures of the database beside ours: those of chance are like none, one of an even sky is like its own"""
    with tempfile.TemporaryDirectory() as tmp:
        os.mkdir(tmp + "/cam")
        for k in range(4):  # pixels of chance, by a generator of their own
            codes = [[(7919 * (row * 8 + column + 1) * (k + 3) ** 2) % 65521 for column in range(8)] for row in range(262)]
            write_codes("%s/cam/cv0_v10_h%d_osc%d.png" % (tmp, 20 * k + 10, k), 8, codes)
        chord = [max(1 - ((column - 3.5) / 2.97) ** 2, 0) ** 0.5 for column in range(8)]
        ends = [min(1, min(row, 261 - row) / 6) for row in range(262)]
        write_codes(tmp + "/cv0_osc0.png", 8, [[int(60000 * c * e) for c in chord] for e in ends])
        told, status, problems = run_json(runner, "atlas --quick --compare " + tmp, form="likeness")
        text = runner.run(["atlas", "--quick", "--compare", tmp]).stdout
    sets = {row["set"]: row for row in told["sets"]}
    if status or sets["everywhere"]["median"] < 0.95 or sets["view 0"]["pictures"] != 4 or abs(sets["view 0"]["median"]) > 0.3:
        problems.append("exit status %d, %s" % (status, told["sets"]))
    if len(told["pictures"]) != 5 or told["brightness"] is not None or "mean brightness: not compared" not in text:
        problems.append("%s\n%s" % (told, text))
    if not re.search(r"\nlight from everywhere +1 +0\.9\d\d +100\.0 % +0\.9\d\d  cv0_osc0\.png\n", text):
        problems.append(text)
    return problems


def check_textures(runner):
    """atlas cartoon lists what it generates, and with -o writes each level of it, looks of it, and a sheet"""
    with tempfile.TemporaryDirectory() as out:
        told, status, problems = run_json(runner, "atlas cartoon -o " + out, form="textures")
        wanted = ["drop-" + weight for weight in ("light", "middle", "heavy")]
        wanted += ["splash-%s-%d" % (pattern, age) for pattern in ("steep", "aslant", "grazing") for age in range(1, 7)]
        shapes = [(name, 64, 7) for name in wanted] + [("strokes-tone-%d" % tone, 256, 4) for tone in range(1, 7)]
        if (told["format"], told["technique"], status) != (1, "cartoon", 0):
            problems.append("exit status %d: %s" % (status, told))
        if [tuple(t[k] for k in ("name", "side_px", "levels")) for t in told["textures"]] != shapes:
            problems.append("textures: %s" % told["textures"])
        files = {"textures.csv", "sheet.png"} | {name + ".png" for name, _, _ in shapes}
        files |= {"%s-level-%d.exr" % (name, level) for name, _, levels in shapes for level in range(levels)}
        if set(os.listdir(out)) != files:
            problems.append("written: %s" % sorted(set(os.listdir(out)) ^ files))
        with open(os.path.join(out, "textures.csv")) as file:
            rows = [(row["name"], int(row["side_px"]), int(row["levels"])) for row in csv.DictReader(file)]
        if rows != shapes:
            problems.append("textures.csv: %s" % rows)
    return problems


# What would take hours, so that a refusal comes before the work: on a disk of 64 KiB.
TOO_LARGE = [
    ("render raster --frame 10000000 --size 1024x1024 -o a.png", "a.png: the disk has 64 KiB left, and at least 102 KiB"),
    ("render raster --frame 10000000 --size 512x512 -o a.exr", "a.exr: the disk has 64 KiB left, and at least 77 KiB"),
    ("render raster --frames 0-9999999 --size 64x64 -o a%08d.hdr", "a00000000.hdr: the disk has 64 KiB left, and at least 11"),
    ("render raster --frames 0-9999999 --size 256x256 -o a.webm", "a.webm: the disk has 64 KiB left, and at least 6"),
    ("diff raster --frame 10000000 --size 1024x1024 --device cpu,cpu:reference -o a", "a-flip.png: the disk has 64 KiB left"),
    ("table --full --device cpu -o a", "a: the disk has 64 KiB left"),
    ("figures --size 1024x1024 -o a", "a: the disk has 64 KiB left"),
    ("atlas --full -o a", "a: the disk has 64 KiB left, and at least 40"),
    ("atlas cartoon -o a", "a: the disk has 64 KiB left, and at least 256 KiB"),
]


def check_full_disk(runner):
    """what cannot fit on the disk is refused before the work"""
    problems = []
    for args, error in TOO_LARGE:
        script = "mount -t tmpfs -o size=64k tmpfs /mnt && cd /mnt && \"$0\" %s; status=$?; ls; exit $status" % args
        done = subprocess.run(["unshare", "-rm", "sh", "-c", script, runner.raingauge], env=runner.variables({}),
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", timeout=100)
        if re.search("unshare: |mount: ", done.stderr):
            print("# not tried: no file system may be mounted here: " + done.stderr.strip())
            return []
        if done.returncode != 2 or done.stdout or error not in done.stderr or done.stderr.count("\n") != 1:
            problems.append("%s: status %d, %s%s" % (args, done.returncode, done.stdout, done.stderr))
    return problems


# What takes tens of MB or more: the larger of raingauge and its worker takes at most so much beside what is said.
SAID = ["raster --size 2048x2048", "cartoon --size 2048x1024", "flow --size 512x512 --set resolution_px=1024",
        "drops --size 1024x1024"]
BESIDE_BYTES, FACTOR = 40e6, 1.25


def resident_bytes(runner, args):
    """The most memory that a process of a command had, its status and what it printed to stderr."""
    with tempfile.TemporaryFile("w+") as log, tempfile.TemporaryDirectory() as folder:
        child = subprocess.Popen([runner.raingauge] + args + ["-o", os.path.join(folder, "a.exr")], stderr=log,
                                 env=runner.variables({}), stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        log.seek(0)
        return usage.ru_maxrss * 1024, os.waitstatus_to_exitcode(status), log.read()


def check_memory(runner):
    """processes take what is said that they need, and what is refused takes little"""
    problems = []
    for args in SAID:
        width, height = map(int, re.search(r"--size (\d+)x(\d+)", args).groups())
        picture = width * height * 32
        args = ("render " + args + " --frame 1").split()
        taken, status, log = resident_bytes(runner, args)
        small, refused, line = resident_bytes(runner, args + ["--memory", "%fM" % (picture / 2**20 + 1)])
        number, unit = re.search(r"needs ([\d.]+) ([MG])iB, and 1.0 MiB of --memory are left", line).groups()
        sent = width * height * 16  # the picture on its way to raingauge, twice in its worker
        said = max(float(number) * {"M": 2**20, "G": 2**30}[unit] + sent, picture)
        if status or log or refused != 2 or not 0.7 * said < taken < FACTOR * said + BESIDE_BYTES:
            problems.append("%s: said %.0f, taken %.0f, status %d: %s" % (args, said, taken, status, log))
        if small > taken / 2:
            problems.append("%s: refusing it takes %.0f" % (args, small))
    return problems


def check_long(runner):
    """what lasts long says how long, in a line, and where that was off by half again; what does not says nothing"""
    problems = []
    for args, line in ((RENDER.replace("--frame 1", "--frame 400"), r"about .* in all; now: flow, 400 frames"),
                       (RENDER.replace("--frame 1", "--frames 0-300") + "-o {}/a%03d.png", r"about .* in all; now: flow, frames 0-300")):
        with tempfile.TemporaryDirectory() as folder:
            args = [word.replace("{}", folder) for word in args.split()]
            if args[0] == "render" and "-o" not in args:
                args += ["-o", os.path.join(folder, "a.png")]
            told, silent = (runner.run(args, {"RG_LONG_S": s}) for s in ("0.0001", "1e9"))
        if told.returncode or not re.fullmatch("(raingauge: %s\n){1,9}" % line, told.stderr):
            problems.append("%s: status %d, %s" % (args, told.returncode, told.stderr))
        if silent.returncode or silent.stderr:
            problems.append("%s, not long: status %d, %s" % (args, silent.returncode, silent.stderr))
    return problems


def check_threads(runner):
    """threads are at most four a processor, and what is wrong with their number is said once"""
    problems = []
    processors = os.sysconf("SC_NPROCESSORS_ONLN")
    most = "raingauge: warning: OMP_NUM_THREADS=%s: more than 4 threads on each of " + \
           "%d processors; %d are used\n" % (processors, 4 * processors)
    for spin in (None, "0"):
        for number, line in (("abc", r"\nlibgomp: Invalid value for environment variable OMP_NUM_THREADS.*\n"), ("100000", most % "100000"),
                             ("1", ""), ("100000,2", most % "100000,2"), (str(4 * processors), "")):
            done = runner.run(["list", "devices", "--json"], dict(NO_DRIVERS, OMP_NUM_THREADS=number, GOMP_SPINCOUNT=spin))
            first = [device["api"] for device in json.loads(done.stdout)["devices"] if device["name"] == "cpu"]
            used = len(os.sched_getaffinity(0)) if number == "abc" else min(int(number.split(",")[0]), 4 * processors)
            told = re.sub(r"(?m)^raingauge: warning: unsupported here: .*\n", "", done.stderr)
            if done.returncode or not re.fullmatch(line, told):
                problems.append("%s: status %d, %r" % (number, done.returncode, told))
            if not first or not re.search(r", %d threads?$" % used, first[0]):
                problems.append("%s: %s" % (number, first))
    with tempfile.TemporaryDirectory() as folder:
        args = RENDER.split() + ["--json", "-o", os.path.join(folder, "a.png")]
        drawn = json.loads(runner.run(args, {"OMP_NUM_THREADS": "abc"}).stdout)
    if "OMP_NUM_THREADS" in drawn["passport"]["environment"]:
        problems.append("the passport has a number that is none")
    return problems


CHECKS = [check_textures, check_forms, check_table_json, check_table_files, check_render_json, check_diff_json, check_diff_not_finite, check_foreign,
          check_full_stdout, check_full_disk, check_long, check_threads]
STORED = [check_claims_alone, check_interrupted, check_stored]


# --- what takes long and leads sanitizers nowhere else: verify's mutants have a scene of their own ---

VERIFY = "verify raster --frame 5 --device cpu --size 96x96 "


def check_compile(runner):
    """what tables draw with is compiled and kept, once, and nothing is measured; a driver that falls is told of"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        def kept():
            return {name: os.path.getmtime(os.path.join(at, name)) for at, _, names in os.walk(tmp + "/cache") for name in names
                    if name != "index"}  # of when what was used

        args = ["table", "raster-1", "--compile", "--device"]
        env = {"XDG_CACHE_HOME": tmp + "/cache"}
        first = runner.run(args + ["cpu,vulkan,gl"], env)
        made = kept()
        again = runner.run(args + ["cpu,vulkan,gl"], env)
        for result in first, again:
            if result.returncode or result.stdout or not re.fullmatch(
                    r"raingauge: 2 openings .*\nraingauge: what 1 technique draws with is compiled on 2 devices, in \d.*\n", result.stderr):
                problems.append("exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr))
        if not made or {name: time for name, time in kept().items() if name in made} != made:
            problems.append("%d files were kept, and %d after another run" % (len(made), len(kept())))
        with tempfile.TemporaryDirectory() as folder:
            fell = runner.run(args + ["vulkan,gl"], dict(env, **misbehaving.shim(runner, folder, "vulkan", "vkQueueSubmit", "exit", 0)))
        if fell.returncode != 1 or not re.fullmatch(
                r"raingauge: 2 openings .*\nraingauge: warning: vulkan: what raster needs is not compiled beforehand: device 'vulkan': its driver ended the process with status 0.*\n",
                fell.stderr):
            problems.append("fell: exit status %d, %s" % (fell.returncode, fell.stderr))
    return problems


def check_verify_json(runner):
    """verify --json has a record for every check on every device"""
    report, status, problems = run_json(runner, VERIFY)
    for check in report["checks"]:
        problems += lacking("check", check, dict.fromkeys(("technique", "check", "device", "status", "detail"), str))
    named = {(check["check"], check["device"], check["status"]) for check in report["checks"]}
    if (report["format"], status) != (1, 0) or not {("state", "cpu", "ok"), ("image", "cpu", "ok"), ("mutants", "cpu", "ok")} <= named:
        problems.append("format %s, exit status %d, checks %s" % (report["format"], status, sorted(named)))
    return problems


def check_verify_dry(runner):
    """verify fails an image without rain, which proves nothing, and no other check"""
    result = runner.run((VERIFY + "--set share=0").split())
    lines = result.stdout.splitlines()
    failed = [line for line in lines[:-1] if not line.startswith("ok ")]
    problems = ["stderr: " + line for line in result.stderr.splitlines()]
    if result.returncode != 1 or len(lines) != 6 or len(failed) != 1 or lines[-1] != "5 checks, 4 ok, 1 fail":
        problems.append("exit status %d, printed:\n%s" % (result.returncode, result.stdout))
    if not re.match(r"fail +raster +image +cpu .*: no rain in the image, which therefore proves nothing$", failed[0] if failed else ""):
        problems.append("failed: %s" % failed)
    return problems


def check_atlas_not_kept(runner):
    """atlas that cannot be kept is made all the same, with a warning"""
    result = runner.run(["atlas", "--quick"], NO_CACHE)
    kept = runner.run(["atlas", "--quick"])
    problems = []
    if result.returncode or not re.fullmatch(r"raingauge: warning: the streak atlas is not kept: /proc/none.*\n", result.stderr):
        problems.append("exit status %d, stderr: %s" % (result.returncode, result.stderr))
    images = [text.stdout.partition("\nimage ")[2] for text in (result, kept)]
    return problems if images[0] == images[1] and images[0] else problems + ["printed:\n%s, kept:\n%s" % tuple(images)]


LONG = [check_compile, check_tallies, check_growth, check_changed, check_no_rain, check_brief, check_sweep, check_tables_in_a_row, check_fresh, check_verify_json, check_verify_dry, check_atlas_not_kept,
        check_memory]


# --- a driver that draws wrongly: its kernel is another ---

RIGHT, TURNED, NO_GLSL = "(-slope_x * scale)", "(slope_x * scale)", "(nonsense * scale)"


def with_normals(wrong):
    """Runs a check with kernels that are wrong on gl; a machine without gl has nothing to show."""
    def decorate(check):
        def run(runner):
            devices = json.loads(runner.run(["list", "devices", "--json"]).stdout)["devices"]
            if not any(device["name"] == "gl" for device in devices):
                return []
            with tempfile.TemporaryDirectory() as tmp:
                return check(runner, runner.kernels_with(tmp, "flow_normals.glsl", RIGHT, wrong))
        run.__doc__ = check.__doc__
        return run
    return decorate


with_wrong_normals = with_normals(TURNED)


@with_normals(NO_GLSL)
def check_broken_table(runner, kernels):
    """a table reports a device whose driver refuses a kernel, measures the others, and fails"""
    report, status, messages = run_json(runner, "table stuppacher-2 --work paper --rows 1-1 --device gl,cpu", kernels)
    gl, cpu = report["cells"]
    problems = [] if len(messages) == 1 else messages + ["%d lines on stderr" % len(messages)]
    if status != 1 or gl["status"] != "error" or "measured" in gl or "flow_normals" not in gl["detail"]:
        problems.append("exit status %d, gl: %s" % (status, gl))
    if cpu["status"] != "ok" or "measured" not in cpu:
        problems.append("cpu: %s" % cpu)
    return problems


def check_crashing_driver(runner):
    """a driver that crashes when it is asked for devices fails list, diff, table and verify, and harms no other device"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        env = dict(NO_DRIVERS, **runner.crashing_vulkan(tmp))
        reports = {}
        for command, args in (("list", "devices"), ("diff", "flow --frame 1 " + SMALL), ("table", "stuppacher-2 --work paper --rows 1-1"),
                              ("verify", "raster --frame 1 --size 96x96")):
            reports[command], status, messages = run_json(runner, command + " " + args, env)
            crashed = [line for line in messages if "raingauge: vulkan: its driver crashed (Aborted)" in line]
            absent = [line for line in messages if re.search("warning: unsupported here: (gl|opencl): ", line)]
            if status != 1 or len(crashed) != 1 or len(absent) != 2 or len(messages) != 3:
                problems += ["%s: exit status %d" % (command, status)] + messages
    found = {"list": [device["name"] for device in reports["list"]["devices"]],
             "diff": [pair["tier"] for pair in reports["diff"]["pairs"]],
             "table": [cell["status"] for cell in reports["table"]["cells"]],
             "verify": [(c["device"], c["status"]) for c in reports["verify"]["checks"] if c["check"] == "device"]}
    if found != {"list": ["cpu", "cpu:reference"], "diff": ["T0"], "table": ["ok", "ok"],
                 "verify": [("gl", "unsupported"), ("vulkan", "crash"), ("opencl", "unsupported")]}:
        problems.append("found: %s" % found)
    return problems


@with_wrong_normals
def check_wrong_table(runner, kernels):
    """a table does not time a device whose image is wrong, and fails"""
    report, status, problems = run_json(runner, "table stuppacher-2 --work paper --rows 1-1 --device cpu,gl", kernels)
    cpu, gl = report["cells"]
    if status != 1 or cpu["status"] != "ok" or "measured" not in cpu:
        problems.append("exit status %d, cpu: %s" % (status, cpu))
    if gl["status"] != "fail" or "measured" in gl or "differs from cpu:reference" not in gl["detail"]:
        problems.append("gl: %s" % gl)
    if report["passport"]["raingauge"]["kernel_dir"] != kernels["RG_KERNEL_DIR"]:
        problems.append("the passport does not name the kernels' folder")
    return problems


@with_wrong_normals
def check_wrong_diff(runner, kernels):
    """diff fails the pairs of a device whose image is wrong, and no others"""
    report, status, problems = run_json(runner, "diff flow --frame 5 --device cpu,cpu:reference,gl " + SMALL, kernels)
    same = [(pair["a"], pair["b"]) for pair in report["pairs"] if pair["tier"] == "T0"]
    text = runner.run(("diff flow --frame 5 --device cpu,gl " + SMALL).split(), kernels).stdout
    if status != 1 or same != [("cpu", "cpu:reference")]:
        problems.append("exit status %d, identical: %s" % (status, same))
    blamed = [(pair.get("blame") or {}).get("stage") for pair in report["pairs"] if pair["tier"] != "T0"]
    if blamed != ["flow_normals"] * 2 or "blame" in report["pairs"][0]:
        problems.append("blamed: %s" % blamed)
    if not re.search(r"(?m)^  gl: frame 1, stage flow_normals: normals\[\d+\] is .*; other values$", text):
        problems.append("the text blames no stage:\n" + text)
    if not re.search(r"(?m)^cpu, gl +fail ", text):
        problems.append("the text does not say so:\n" + text)
    return problems


@with_wrong_normals
def check_wrong_verify(runner, kernels):
    """verify fails the image of a device that draws wrongly, and nothing else"""
    report, status, problems = run_json(runner, "verify flow --frame 5 --device cpu,gl " + SMALL, kernels)
    failed = [(check["check"], check["device"]) for check in report["checks"] if check["status"] != "ok"]
    if status != 1 or failed != [("image", "gl")]:
        problems.append("exit status %d, failed: %s" % (status, failed))
    return problems


@with_wrong_normals
def check_wrong_stage(runner, kernels):
    """verify --stages names the stage that is wrong, the asset, the word, and by how much"""
    report, status, problems = run_json(runner, "verify flow --stages --device cpu,gl " + SMALL, kernels)
    checks = {device: [c for c in report["checks"] if c["device"] == device] for device in ("cpu", "gl")}
    if status != 1 or not checks["cpu"] or any(check["status"] != "ok" for check in checks["cpu"]):
        problems.append("exit status %d, cpu: %s" % (status, checks["cpu"]))
    found = r"frame 1, stage flow_normals: normals\[\d+\] is .*, not .*, off by \d.*; \d+ of \d+ words differ"
    for check in checks["gl"]:
        if check["check"] != "stages" or check["status"] != "fail" or not re.search(found, check["detail"]):
            problems.append("gl: %s" % check)
    return problems


WRONG = [check_broken_table, check_crashing_driver, check_wrong_table, check_wrong_diff, check_wrong_verify,
         check_wrong_stage]
