"""The output of table and sweep, for one table or several: each form is well-formed, and cells are counted and told apart."""
import csv
import io
import json
import os
import re
import subprocess
import tempfile
import time

import forms
import misbehaving
from cases import FORMATS, SMALL_TABLE, TABLE
from machine import lacking, run_json


ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))


def check_table_json(runner):
    """table --json has the passport, and for each cell the published, measured and counted values"""
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
    """table --json has the exact work of a frame, the same on two devices except for counts that only cpu:reference has"""
    report, _, problems = run_json(runner, TABLE.replace("--device cpu", "--device cpu:reference,cpu"))
    reference, cpu = (cell["tally"] for cell in report["cells"])
    alone = {name for name in reference if cpu[name] != reference[name]}
    if alone != {"fragments_kept", "texels_fetched"} or any(cpu[name] is not None for name in alone):
        problems.append("cpu:reference: %s, cpu: %s" % (reference, cpu))
    if not all(reference[name] for name in ("runs", "dispatches", "items", "records", "fragments", "texels_fetched")):
        problems.append("counted: %s" % reference)
    return problems


def check_growth(runner):
    """a table of no paper has the counters' growth in a frame, and the exponent of its time along the rows"""
    report, status, problems = run_json(runner, "table chin-drops --rows 1-2 --device cpu")
    cells, shape = report["cells"], report["shapes"][0]
    if status or len(report["shapes"]) != 1 or shape["verdict"] != "growth" or shape["published_slope"] is not None:
        problems.append("exit status %d, shapes: %s" % (status, report["shapes"]))
    if not shape["slope_low"] <= shape["slope"] <= shape["slope_high"] < 0:
        problems.append("shape: %s" % shape)
    for cell in cells:  # the rain builds up until the pane is full, and then goes on
        drops, most = cell["counted"]["drops_stepped"], cell["row"]["max_drops"]
        if list(cell["counted"]) != ["drops_stepped", "cells_stepped", "merging_steps"] or not 0.9 * most <= drops <= most:
            problems.append("%d drops: %s" % (most, cell["counted"]))
    return problems


def check_changed(runner):
    """table --set, --variant, --work and --rows work together, the record names them, and no changed cell is compared with print"""
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


def check_few_samples(runner):
    """a quick cell has more than 6 samples where its frames are short, and 6 under RG_FEW_SAMPLES"""
    problems = []
    sweep = "sweep flow --axis resolution_px=32 --set environment=sky --set environment_px=16 --size 32x32 --device cpu --quick --json --fresh".split()
    # On a busy machine frames may be long in a run, but hardly in five.
    for value, wanted, tries in ((None, range(7, 16), 5), ("1", (6,), 1)):
        told = []
        for _ in range(tries):
            run = runner.run(sweep, {"RG_FEW_SAMPLES": value})
            counts = [len(cell["measured"]["samples_ms"]) for cell in json.loads(run.stdout)["cells"]]
            if not run.returncode and len(counts) == 1 and counts[0] in wanted:
                break
            told.append("%s: exit status %d, %s, %s" % (value, run.returncode, counts, run.stderr))
        else:
            problems += told
    return problems


def check_budget(runner):
    """table with a budget for everything measures everything, in turns, and leaves nothing out; its record is read like others"""
    with tempfile.TemporaryDirectory() as tmp:
        run = runner.run(["table", "creus-5.2", "--device", "cpu,cpu:reference", "--budget", "9h", "--json", "-o", tmp], {"RG_FEW_SAMPLES": None})
        again = runner.run(["table", "--from", tmp, "--json"]).stdout
    report = json.loads(run.stdout)
    problems = forms.problems("table", report)
    wanted = {"seconds": 32400, "size_divisor": 1, "few_samples": False, "left_out": []}
    cells = [(cell["row"]["level"], cell["device"]) for cell in report["cells"]]
    if run.returncode or again != run.stdout or report.get("budget") != wanted or \
            cells != [(level, device) for level in range(6) for device in ("cpu", "cpu:reference")]:
        problems.append("exit status %d, %s, %s" % (run.returncode, report.get("budget"), cells))
    if not re.search(r"the first rows of each table\n.*: cpu:reference\ntook \d+ s, of a budget of 32400 s; left out, for time:\n  nothing\n", run.stderr):
        problems.append(run.stderr)
    return problems


def check_busy(runner):
    """table reports a busy machine before it measures, and marks cells of which others took more than 5 %"""
    problems = []
    loops = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(2 * os.cpu_count())]
    try:
        for args in ("table raster-1 --rows 1-1 --device cpu --json", BUSY + "--json"):
            ran = runner.run(args.split(), env={"RG_PROBE_S": "0.3"})
            cells = [cell["measured"] for cell in json.loads(ran.stdout)["cells"]]
            if not re.match("raingauge: warning: others take [0-9]+ % of this machine's processors, .*; end them, or measure later\n", ran.stderr):
                problems.append("not told first: %s" % ran.stderr)
            problems += ["not noticed: %s" % cell for cell in cells
                         if len(cell["taken"]) != len(cell["samples_ms"]) or cell["disturbed"] != sum(share > 0.05 for share in cell["taken"])]
            if not all(sum(cell[name] for cell in cells) for name in ("disturbed", "retaken")):
                problems.append("no cell is disturbed, or none was taken again: %s" % cells)
        told = runner.run(BUSY.split(), env={"RG_PROBE_S": "0"}).stderr
        problems += ["told without a probe: %s" % told] if "others take" in told else []
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()
    return problems


def check_no_rain(runner):
    """a cell whose picture is the same without rain proves nothing on any device and has no number, in the table and before the claims"""
    problems = []
    for table, hidden in (("stuppacher-2", ["drops=0", "rain_drops_s=0"]), ("ye-1", ["opacity=0"])):
        with tempfile.TemporaryDirectory() as tmp:
            sets = [word for one in hidden for word in ("--set", one)]
            done = runner.run(["table", table, "--rows", "1-1", "--device", "cpu,cpu:reference", "-o", tmp] + sets)
            record = json.loads(open("%s/%s.json" % (tmp, table), encoding="utf-8").read())
            cells = {(cell["device"], cell["status"], "measured" in cell) for cell in record["cells"]}
            if done.closing != "raingauge: 0 of {0} cells measured on 2 devices; {0} failed\n".format(len(record["cells"])):
                problems.append("%s: %s" % (table, done.closing))
            if done.returncode != 4 or cells != {("cpu", "nothing", False), ("cpu:reference", "nothing", False)} or "without rain" not in done.stdout:
                problems.append("%s: exit status %d, %s\n%s" % (table, done.returncode, cells, done.stdout))
            del record["changed"]  # otherwise claims would not apply to this work
            with open(tmp + "/claims.json", "w", encoding="utf-8") as file:
                json.dump(forms.unsealed(record), file)
            claims = runner.run(["table", "--claims", "--wide", "--from", tmp + "/claims.json"]).stdout
        if "has no number: its image is the same without rain" not in claims or "| reproduced" in claims or "not reproduced" in claims:
            problems.append("claims of %s:\n%s" % (table, claims))
    return problems


def check_brief(runner):
    """table prints one line a row, in colours only on a terminal, and --wide one line a cell with all columns"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        runner.run((TABLE.replace("--work paper ", "") + "-o " + tmp).split())
        stored = ["table", "--from", tmp]
        brief, wide = runner.run(stored).stdout, runner.run(stored + ["--wide"]).stdout
        refused = runner.run(stored + ["--wide", "--json"]).returncode
        judged = ["table", "creus-5.4", "--from", "%s/results/tables" % ROOT]  # it has a verdict, which has a colour
        uncoloured = runner.run(judged).stdout
        told = [runner.on_terminal(args, env) for args, env in (
            (judged, {"TERM": "xterm", "NO_COLOR": None}),
            (["table", "--claims", "--from", "%s/results/tables" % ROOT], {"TERM": "xterm", "NO_COLOR": None}),
            (stored, {"TERM": "xterm", "NO_COLOR": "1"}), (stored, {"TERM": "dumb", "NO_COLOR": None}))]
        shown, claims, *plain = [result.stdout + result.stderr for result in told]
    lines = [line for line in brief.split("\n") if re.match(r"\| +128 \|", line)]
    if len(lines) != 3 or not re.fullmatch(r"\| +128 \| +480 \| .* \d+(\.\d+)?x \|", lines[0]):
        problems.append("brief:\n" + brief)
    if "API / wall clock" not in wide or "API / wall clock" in brief or len(re.findall(r"\n\| +128 \|", wide)) != 3:
        problems.append("wide:\n" + wide)
    if "\033" in brief or "\033[3" not in shown or re.sub(r"\033\[\d+m", "", shown) != uncoloured or plain != [brief, brief]:
        problems.append("on a terminal: %r\n%r" % (shown, plain))
    if "\033[32myes\033[0m" not in claims or "\033[31mno\033[0m" not in claims or "reproduced" not in re.sub(r"\033\[\d+m", "", claims):
        problems.append("claims on a terminal: %r" % claims)
    return problems + ["--wide is taken with another form: %s" % refused] * (refused != 2)


# Two cells: on a busy machine each sample is taken up to three times.
BUSY = ("sweep flow --axis resolution_px=32 --axis panes=mirror,glass --axis device=cpu "
        "--set move=paper --set model=none --set environment=sky --set environment_px=16 --size 64x64 --frame 3 ")
SWEEP = ("sweep flow --axis resolution_px=32,64..96 --axis panes=mirror,glass --axis device=cpu,cpu:reference "
         "--set move=paper --set model=none --set environment=sky --set environment_px=16 --size 64x64 --frame 3 ")


def check_sweep(runner):
    """a dry run of sweep plans; otherwise it measures each combination on each device, as a table to print, write and read like others"""
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
    if run.returncode or again != run.stdout or made != ["sweep-flow." + form for form in FORMATS] or run.stderr or \
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
    told = float(re.search(r"about ([\d.]+) s", dry.stdout).group(1))
    if not told / 4 < took < 4 * told + 5:  # a busy machine's speed varies as much
        problems.append("%s s were planned, and %.1f s taken" % (told, took))
    return problems


def check_forms(runner):
    """list's output, and a table of textures, fit the schema, all of whose fields are documented"""
    problems = ["docs/records.schema.json does not describe, or docs/records.md not name, %s" % name for name in forms.undocumented()]
    for args in ("list techniques", "list tables", "list figures", "list devices", "list params raster", "table creus-5.2 --rows 1-1 --quick --device cpu"):
        problems += [line for line in run_json(runner, args)[2] if not line.startswith("stderr: ")]
    # The check itself must find an error.
    document = run_json(runner, "list techniques")[0]
    document["techniques"][0]["colour"] = "red"
    document["techniques"][1]["about"] = 1
    if not forms.problems("list", document):
        problems.append("a wrong document is taken")
    return problems


def check_tables_in_a_row(runner):
    """table with several names prints each one separately"""
    problems = []
    text = runner.run((SMALL_TABLE + "stuppacher-2").split()).stdout
    if not re.fullmatch(r"## stuppacher-2\n\n.*\n\n## stuppacher-2\n\n.*", text, re.S):
        problems.append("md:\n" + text)
    parts = runner.run((SMALL_TABLE + "stuppacher-2 --format csv").split()).stdout.split("\n\n")
    if len(parts) != 2:
        problems.append("csv: %s" % parts)
    for part in parts:
        problems += check_csv(part)
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
    problems += check_md(runner.run(SMALL_TABLE.split()).stdout)
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


def check_compile(runner):
    """the programs that tables draw with are compiled and kept, once, and nothing is measured; a driver that crashes is reported"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        def kept():
            return {name: os.path.getmtime(os.path.join(at, name)) for at, _, names in os.walk(tmp + "/cache") for name in names
                    if name != "index"}  # its time changes whenever the cache is used

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


CHECKS = [check_few_samples, check_forms, check_table_json, check_table_files]
LONG = [check_compile, check_budget, check_busy, check_tallies, check_growth, check_changed, check_no_rain, check_brief, check_sweep, check_tables_in_a_row]
