"""The tables in the repository: each record prints as the files next to it."""
import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import forms

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
KEPT = os.path.join(ROOT, "results", "tables")
KEEP = os.path.join(ROOT, "results", "keep.py")
WALK = os.path.join(ROOT, "results", "walk.py")
FIGURES = os.path.join(ROOT, "results", "figures.py")
SAME = os.path.join(ROOT, "results", "same.py")
FORMS = ("csv", "json", "md")


def read(*path):
    with open(os.path.join(*path), encoding="utf-8", newline="") as file:
        return file.read()


def python(*args):
    subprocess.run([sys.executable, "-B", *args], check=True)


def check_printed(runner):
    """each stored table has a record, from which table --from prints its other forms byte for byte"""
    tables = [table["name"] for table in json.loads(runner.run(["list", "tables", "--json"]).stdout)["tables"]]
    wanted = sorted("%s.%s" % (table, form) for table in tables for form in FORMS)
    problems = [] if sorted(os.listdir(KEPT)) == wanted else ["kept: %s" % sorted(os.listdir(KEPT))]
    for table in tables:
        record = os.path.join(KEPT, table + ".json")
        problems += [table + ": " + problem for problem in forms.problems("table", json.loads(read(record)))]
        for form in ("csv", "md"):
            printed = runner.run(["table", "--from", record, "--format", form])
            if printed.stderr or printed.stdout != read(KEPT, table + "." + form):
                problems.append("%s.%s is another: %s" % (table, form, printed.stderr))
    return problems


def check_compact(runner):
    """keep.py makes the same records from the files of table -o, a line a cell, and leaves nothing behind"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        runner.run(["table", "--from", KEPT, "-o", tmp + "/written"])
        again = runner.run(["table", "--from", tmp + "/written", "-o", tmp + "/again"])
        problems += [name + " is written as another" for name in os.listdir(tmp + "/written")
                     if again.returncode or read(tmp, "written", name) != read(tmp, "again", name)]
        python(KEEP, tmp + "/written", tmp + "/kept")
        if os.listdir(tmp + "/written") or sorted(os.listdir(tmp + "/kept")) != sorted(os.listdir(KEPT)):
            problems.append("left: %s, kept: %s" % (os.listdir(tmp + "/written"), os.listdir(tmp + "/kept")))
        problems += [name + " is another" for name in os.listdir(KEPT) if read(tmp, "kept", name) != read(KEPT, name)]
    for name in sorted(name for name in os.listdir(KEPT) if name.endswith(".json")):
        text = read(KEPT, name)
        lines = text.split('"cells": [\n')[1].splitlines()[:-2]
        if [json.loads(line.rstrip(",")) for line in lines] != json.loads(text)["cells"]:
            problems.append(name + ": not a line a cell")
    return problems


def of_another_commit(runner, text, folder):
    """A record as if it had been measured with another commit."""
    record = forms.unsealed(json.loads(text))
    record["passport"]["raingauge"]["commit"] = "0" * 40
    pathlib.Path(folder, "other.json").write_text(json.dumps(record), encoding="utf-8")
    runner.run(["table", "--from", folder + "/other.json", "-o", folder + "/other"])
    os.remove(folder + "/other.json")
    return json.loads(read(folder, "other", record["table"] + ".json"))


def damages(other):
    """Damage by hand or by a merge to a record of stuppacher-2, and the line about it. `other`: a record of another commit."""
    def with_cell(cell, change):
        def damage(record):
            change(record, record["cells"][cell])
        return damage

    def of_cell(i, device, what="wrong checksum"):
        return r"cells\[%d\] \(row 1, paper, full, on %s\) has (a|no) %s" % (i, device, what)

    def copied(record, cell):
        record["cells"][2] = dict(cell, device=record["cells"][2]["device"])

    head = "what stands before its cells was changed, or each of them"
    return {
        "a sample": (with_cell(0, lambda record, cell: cell["measured"]["samples_ms"].__setitem__(3, 1.5)), of_cell(0, "cpu")),
        "a count": (with_cell(1, lambda record, cell: cell["tally"].update(items=1)), of_cell(1, "cpu:reference")),
        "a pass": (with_cell(1, lambda record, cell: cell["measured"]["passes_ms"].popitem()), of_cell(1, "cpu:reference")),
        "what is in print": (with_cell(0, lambda record, cell: cell["published"].update(fps=30)), of_cell(0, "cpu")),
        "a setting": (with_cell(0, lambda record, cell: cell.update(set="resolution_px=64")), of_cell(0, "cpu")),
        "times of another device": (with_cell(0, lambda record, cell: record["cells"][2].update(measured=cell["measured"])), of_cell(2, "gl")),
        "a cell over that of another device": (with_cell(0, copied), of_cell(2, "gl")),
        "a cell of which a row says that it is its own": (with_cell(0, lambda record, cell: record["cells"].__setitem__(0, dict(record["cells"][15], row=cell["row"], row_number=1, work="paper"))), of_cell(0, "cpu")),
        "a cell without a checksum": (with_cell(0, lambda record, cell: cell.pop("checksum")), of_cell(0, "cpu", "checksum, and others have")),
        "a cell of another commit": (lambda record: record["cells"].__setitem__(0, other["cells"][0]), of_cell(0, "cpu")),
        "the cells of another commit": (lambda record: record.update(cells=other["cells"]), head),
        "the machine": (lambda record: record["passport"]["machine"].update(cpu="another"), head),
        "the commit": (lambda record: record["passport"]["raingauge"].update(commit="0" * 40), head),
        "a driver": (lambda record: record["passport"]["devices"][2].update(driver="Mesa 99"), head),
        "the length": (lambda record: record.update(length="full"), head),
        "the size": (lambda record: record.update(size_px=[64, 64]), head),
        "the order of fields": (lambda record: record.update(json.loads(json.dumps(record, sort_keys=True))), head),
    }


def check_damaged(runner):
    """a record changed by hand or in a merge is refused with one line that names the cell, and no part of it is printed"""
    problems = []
    text = read(KEPT, "stuppacher-2.json")
    with tempfile.TemporaryDirectory() as tmp:
        path = os.path.join(tmp, "record.json")
        for what, (damage, says) in damages(of_another_commit(runner, text, tmp)).items():
            record = json.loads(text)
            damage(record)
            pathlib.Path(path).write_text(json.dumps(record), encoding="utf-8")
            for more in ([], ["--claims"], ["--json"]) if what == "a sample" else ([],):
                done = runner.run(["table", "--from", tmp, *more])
                if done.returncode != 2 or done.stdout or not re.fullmatch("raingauge: .*record\\.json: %s.*; restore it, or .*\n" % says, done.stderr):
                    problems.append("%s: status %d, %s" % (what, done.returncode, done.stderr))
        # A record rewritten by another program, or with changed derived values, counts as the same.
        record = json.loads(text)
        for cell in record["cells"]:
            cell["measured"].update(fps=1, ms=1.0, passes_share={})
        record["interrupted"] = True
        for same in (json.dumps(record, indent=8), re.sub(r"(?<=[:,\[])(\d+)\.0(?=[,}\]])", r"\1", text), json.dumps(forms.unsealed(record))):
            pathlib.Path(path).write_text(same, encoding="utf-8")
            done = runner.run(["table", "--from", path, "--format", "md"])
            if done.returncode or done.stdout != read(KEPT, "stuppacher-2.md"):
                problems.append("as another program writes it: status %d, %s" % (done.returncode, done.stderr))
    return problems


def check_walk(runner):
    """the README, docs/tables.md and docs/claims.md show the stored tables as table --from prints them, and walk.py notices differences"""
    with tempfile.TemporaryDirectory() as tmp:
        page = os.path.join(tmp, "page.md")
        def walk(*words):
            return subprocess.run([sys.executable, "-B", WALK, *words], check=False, capture_output=True, text=True)
        readme, problems = read(ROOT, "README.md"), []
        for text, what in ((readme, ""), (read(ROOT, "docs", "tables.md"), ""), (read(ROOT, "docs", "claims.md"), "--claims ")):
            shown = re.findall(r"^    \$ raingauge table .*--from results/tables$", text, re.M)
            problems += [] if len(shown) == 1 and what in shown[0] else ["a page shows %s" % shown]
        problems += [] if walk("--check", runner.raingauge).returncode == 0 else ["a page shows something else"]
        pathlib.Path(page).write_text(readme.replace("    ### paper: six height maps", "    ### paper: five"), encoding="utf-8")
        problems += [] if walk("--check", runner.raingauge, page).returncode == 1 else ["another page passes"]
        if walk(runner.raingauge, page).returncode or read(page) != readme:
            problems.append("the page is not made anew")
    return problems


def check_scripts(runner):
    """a file that the scripts of results/ cannot read ends with one line that names it, and exit status 2; nothing is written"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        with open(os.path.join(tmp, "raster-1.json"), "w") as file:
            file.write("{")
        for name in ("raster-1.md", "raster-1.csv"):
            pathlib.Path(tmp, name).touch()
        os.mkdir(tmp + "/other")
        pathlib.Path(tmp, "other", "stuppacher-1.json").write_text("[]", encoding="utf-8")
        os.mkdir(tmp + "/bare")
        pathlib.Path(tmp, "bare", "raster-1.json").write_text('{"cells": [{}]}', encoding="utf-8")
        for args, says in (([KEEP, tmp + "/none", tmp + "/to"], "/none: No such file or directory"),
                           ([KEEP, tmp, tmp + "/to"], r"/raster-1\.json:1:2: .*; have raingauge write it anew"),
                           ([FIGURES, tmp + "/other"], r"/other/stuppacher-1\.json: is no record of a table; .*"),
                           ([FIGURES, tmp + "/none"], "/none/stuppacher-1.json: No such file or directory"),
                           ([SAME, tmp + "/none", KEPT], "/none: No such file or directory"),
                           ([SAME, tmp, KEPT], r"/raster-1\.json:1:2: .*; have raingauge write it anew"),
                           ([SAME, tmp + "/to", KEPT], "/to: holds no record of a table; name a folder that raingauge table -o wrote"),
                           ([SAME, tmp + "/bare", KEPT], r"/bare/raster-1\.json: is no record of a table; .*"),
                           ([SAME, KEPT, tmp + "/other"], "/other/chin-drops.json: No such file or directory"),
                           ([WALK, tmp + "/none"], "/none: No such file or directory"),
                           ([WALK, "/bin/false"], "/bin/false table .* ended with status 1")):
            done = subprocess.run([sys.executable, "-B", *args], check=False, capture_output=True, text=True)
            if done.returncode != 2 or done.stdout or not re.fullmatch(r"\S+\.py: .*%s.*\n" % says, done.stderr):
                problems.append("%s: exit status %d, %s%s" % (args, done.returncode, done.stdout, done.stderr))
        if os.path.exists(tmp + "/to") and os.listdir(tmp + "/to"):
            problems.append("written: %s" % os.listdir(tmp + "/to"))
    return problems


# A table of each technique whose first row takes little time, and the parts of it to measure.
COUNTED = {
    ("chin-grid", "creus-5.2", "feng-2", "raster-1", "stuppacher-2", "ye-1"): (),
    ("creus-5.4",): ("--work", "paper", "--variant", "no_geometry"),
}


def without_first_row(record):
    record["cells"] = [cell for cell in record["cells"] if cell["row_number"] != 1]


def check_counted(runner):
    """rows measured anew have the stored tables' counts, to the last error, and same.py names the cell that differs"""
    changes = {
        r"tally\.items is \d+, and 1 was kept": lambda record: record["cells"][0]["tally"].update(items=1),
        r"tally\.records is \d+, and null was kept": lambda record: record["cells"][0]["tally"].pop("records"),
        r"status is \"ok\", and \"fail\" was kept": lambda record: record["cells"][0].update(status="fail"),
        r"published\.fps is 480, and 30 was kept": lambda record: record["cells"][0]["published"].update(fps=30),
        r"is not kept": without_first_row,
    }
    with tempfile.TemporaryDirectory() as tmp:
        for tables, words in COUNTED.items():
            runner.run(["table", *tables, *words, "--rows", "1-1", "--quick", "--device", "cpu", "-o", tmp + "/new"])

        def same(kept):
            done = subprocess.run([sys.executable, "-B", SAME, tmp + "/new", kept], check=False, capture_output=True, text=True)
            return done.returncode, re.sub(r": \d+ cells count the same", "", done.stdout).splitlines(), done.stderr

        tables = sorted(sum(COUNTED, ()))
        problems = [] if same(KEPT) == (0, tables, "") else ["measured anew: %s" % (same(KEPT),)]
        shutil.copytree(KEPT, tmp + "/kept")
        for says, change in changes.items():
            record = json.loads(read(KEPT, "stuppacher-2.json"))
            change(record)
            pathlib.Path(tmp, "kept", "stuppacher-2.json").write_text(json.dumps(record), encoding="utf-8")
            status, lines, _ = same(tmp + "/kept")
            if status != 1 or not re.fullmatch("stuppacher-2: row 1, full, paper, cpu: " + says, lines[tables.index("stuppacher-2")]):
                problems.append("%s: status %d, %s" % (says, status, lines))
    return problems


def check_colours(runner):
    """on a terminal, cells faster than print and reproduced claims are green, but not those faster than ours alone; headings are plain; colours can be off"""
    args = ["table", "stuppacher-2", "--from", KEPT]
    plain = runner.run(args).stdout
    shown = runner.on_terminal(args, {"TERM": "xterm", "NO_COLOR": None}).stdout
    cells = re.findall(r"\x1b\[(\d+)m(.*?)\x1b\[0m", shown)
    problems = [] if cells and re.sub(r"\x1b\[\d+m", "", shown) == plain else ["on a terminal: %r" % shown]
    due = [("32", cell) for cell in re.findall(r"[\d.]+(?: \+-\d+%|~)? +[1-9][\d.]*x|(?<!not )reproduced", re.sub(r"### ours, times paper\n\n(\|.*\n)+", "", plain))]
    if sorted(cell for cell in cells if cell[1] not in ("not reproduced", "undecided")) != sorted(due):
        problems.append("painted: %s, due: %s" % (cells, due))
    for env in ({"TERM": "xterm", "NO_COLOR": "1"}, {"TERM": "dumb", "NO_COLOR": None}):
        if runner.on_terminal(args, env).stdout != plain:
            problems.append("%s: it has colours" % env)
    return problems


def check_failed_colours(runner):
    """on a terminal failed cells are red, in whichever way they failed, and unsupported ones yellow"""
    due = {"fail": "31", "error": "31", "crash": "31", "timeout": "31", "unsupported": "33"}
    record = forms.unsealed(json.loads(read(KEPT, "stuppacher-2.json")))
    for cell, status in zip(record["cells"], due):
        cell.update(status=status, detail="so it ended")
    with tempfile.TemporaryDirectory() as tmp:
        with open(tmp + "/record.json", "w", encoding="utf-8") as file:
            json.dump(record, file)
        shown = runner.on_terminal(["table", "--from", tmp + "/record.json"], {"TERM": "xterm", "NO_COLOR": None}).stdout
    painted = {cell: colour for colour, cell in re.findall(r"\x1b\[(\d+)m(.*?)\x1b\[0m", shown) if cell in due}
    return [] if painted == due else ["painted: %s in %r" % (painted, shown)]


def row_name(row):
    """A row's name in reasons: its values, each with its name, except a first one that is a text."""
    words = ["%s %s" % (name, value if isinstance(value, str) else "%.10g" % value) for name, value in row.items()]
    first = next(iter(row.values()))
    return ", ".join([first] + words[1:] if isinstance(first, str) else words)


def reason_problems(wide):
    """Reasons that name no device, or not a row in full, or print a rate as a power of ten."""
    problems = re.findall(r"(?m)^- .* on : .*$", wide)
    for table, reason in re.findall(r"(?m)^- ([a-z0-9.-]+), (.* fps.*)$", wide):
        rows = {row_name(cell["row"]) for cell in json.loads(read(KEPT, table + ".json"))["cells"]}
        if not any(name in reason for name in rows) or re.search(r"\de[+]\d", reason):
            problems.append("%s: %s" % (table, reason))
    return problems


def check_claims(runner):
    """table --claims judges the papers' claims about the stored tables, on each device and on one alone; --wide has every reason"""
    printed = runner.run(["table", "--claims", "--from", KEPT, "--format", "csv"])
    rows = list(csv.DictReader(io.StringIO(printed.stdout)))
    verdicts = {verdict for row in rows for verdict in list(row.values())[3:] if verdict}
    problems = [] if not printed.stderr and not printed.returncode else ["claims: " + printed.stderr]
    if not verdicts <= set(MARKS) or len(verdicts) < 3:
        problems.append("verdicts: %s" % verdicts)
    alone = runner.run(["table", "stuppacher-2", "--claims", "--from", KEPT, "--format", "csv"])
    about = [row["table"] for row in csv.DictReader(io.StringIO(alone.stdout))]
    if set(about) != {"stuppacher-2"} or len(about) != [row["table"] for row in rows].count("stuppacher-2"):
        problems.append("of one table: %s" % about)
    wide = runner.run(["table", "--claims", "--wide", "--from", KEPT]).stdout
    return problems + reason_problems(wide) + page_problems(runner, rows) + json_problems(runner, rows, wide)


# The words for verdicts on the page that fits on one screen; figures of one launch are in brackets.
MARKS = {"reproduced": "yes", "not reproduced": "no", "at the bound": "bound", "undecided": "open", "other work": "other", "not seen": "unseen",
         "one launch: fits": "(yes)", "one launch: misses": "(no)", "one launch: near the bound": "(near)", "": ""}
OF_ONE_LAUNCH = {"fits": "one launch: fits", "misses": "one launch: misses", "near": "one launch: near the bound"}


def page_problems(runner, rows):
    """The page says the same as the wide one, in as many lines and columns as a screen has."""
    page = runner.run(["table", "--claims", "--from", KEPT]).stdout
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in page.splitlines() if line.startswith("|")]
    lead = [line for line in page.splitlines()[:12] if line.startswith("- ")]
    due = [[row["table"], row["claim"]] + [MARKS[verdict] for verdict in list(row.values())[3:]] for row in rows]
    widest = max(len(line) for line in page.splitlines())
    problems = ["the page: %s, due: %s" % (cells[2:], due)] if cells[2:] != due else []
    if widest > 110 or page.count("\n") > 60 or " on cpu" in page:
        problems.append("%d columns, %d lines:\n%s" % (widest, page.count("\n"), page))
    told = [int(re.match(r"- %s: (\d+)" % name, line).group(1)) for name, line in zip(("Holds", "Does not hold", "Open"), lead[1:4])]
    verdicts = [verdict for row in rows for verdict in list(row.values())[3:]]
    if told != [verdicts.count(verdict) for verdict in ("reproduced", "not reproduced", "undecided")]:
        problems.append("totals: %s" % lead)
    return problems


# The bounds of each test.
BOUNDS = {"ratio": ["least"], "apart": ["least"], "faster": ["least"], "rate": ["least"], "flattens": ["least"], "alike": ["most"],
          "exponent": ["least", "most"], "times": ["least", "most"]}


def json_problems(runner, rows, wide):
    """One JSON document has the rows of CSV, with the reasons of the wide page and the judged values, and nothing else is printed."""
    done = runner.run(["table", "--claims", "--json", "--from", KEPT])
    if done.returncode or done.stderr or done.stdout != runner.run(["table", "--claims", "--format", "json", "--from", KEPT]).stdout:
        return ["as JSON: status %d, %s" % (done.returncode, done.stderr)]
    document = json.loads(done.stdout)
    problems = forms.problems("claims", document)
    ids = [claim["id"] for claim in document["claims"]]
    if len(set(ids)) != len(ids) or "creus-5.3/20-meters-good-compromise-camera-1" not in ids or "creus-5.5/has-a-subtle-effect-1000-to-100000" not in ids:
        problems.append("ids: %s" % ids)
    due, told = [], []
    for row in rows:
        due += [(row["table"], row["section"], row["claim"], device, verdict) for device, verdict in list(row.items())[3:] if verdict]
    for claim in document["claims"]:
        quote = '"' * (claim["source"] == "said")
        title = quote + claim["words"] + quote + (", " + claim["part"] if claim["part"] else "")
        told += [(claim["table"], claim["section"], title, one["device"],
                  OF_ONE_LAUNCH[one["figures"]] if one["verdict"] == "one launch" else one["verdict"]) for one in claim["verdicts"]]
        problems += [one["why"] + " is no reason of the page" for one in claim["verdicts"] if ": %s.\n" % one["why"] not in wide]
        if [name for name in ("least", "most") if claim[name] is not None] != BOUNDS.get(claim["test"], []):
            problems.append("%s: %s from %s to %s" % (claim["id"], claim["test"], claim["least"], claim["most"]))
        problems += [claim["id"] + ": of another paper" for _ in range(not claim["table"].startswith(claim["paper"]))]
    if sorted(told) != sorted(due):
        problems.append("told: %s, due: %s" % (told, due))
    for table in document["tables"]:
        record = json.loads(read(KEPT, table["table"] + ".json"))
        if any(record[name] != table[name] for name in ("length", "quick", "passport")) or table["size_divisor"] != 1:
            problems.append("%s: judged of something else" % table["table"])
    if [table["table"] for table in document["tables"]] != sorted({row["table"] for row in rows}):
        problems.append("tables: %s" % [table["table"] for table in document["tables"]])
    return problems


def check_lengths(runner):
    """table --claims names the length of the judged tables, and refuses a table that is given twice"""
    kept = forms.unsealed(json.loads(read(KEPT, "feng-2.json")))
    small = {"budget": {"seconds": 240, "size_divisor": 4, "few_samples": False, "left_out": []}}
    lengths = {"full": {"length": "full"}, "quick": {"length": "quick"}, "quick, with 1/4 of the width and height": dict(small, length="quick")}
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        for one, change in lengths.items():
            pathlib.Path(tmp, "a.json").write_text(json.dumps(dict(kept, **change)), encoding="utf-8")
            printed = runner.run(["table", "--claims", "--from", tmp]).stdout
            if "\n- %s: feng-2.\n" % one not in printed or len(re.findall(r"\n- (?:quick|full)\b", printed)) != 1:
                problems.append("%s: %s" % (one, printed))
            for other, also in lengths.items():
                pathlib.Path(tmp, "b.json").write_text(json.dumps(dict(kept, **also)), encoding="utf-8")
                mixed = runner.run(["table", "--claims", "--from", tmp])
                says = "holds table 'feng-2' twice" if one == other else "measured %s, and %s, which no verdict mixes" % (one, other)
                if mixed.returncode != 2 or mixed.stdout or mixed.stderr.count("\n") != 1 or says not in mixed.stderr:
                    problems.append("%s and %s: %s" % (one, other, mixed.stderr))
            os.remove(tmp + "/b.json")
    return problems


def check_dirty_tree(runner):
    """make results refuses a tree with uncommitted changes, with one line, before it builds"""
    git = ["git", "-c", "user.name=a", "-c", "user.email=a", "-c", "commit.gpgsign=false"]
    with tempfile.TemporaryDirectory() as tmp:
        tools, tree = tmp + "/tools", tmp + "/tree"
        os.makedirs(tools)
        os.makedirs(tree)
        for tool in ("git", "make", "sh"):  # tools that cannot install or build anything
            os.symlink(shutil.which(tool), os.path.join(tools, tool))
        shutil.copy(os.path.join(ROOT, "Makefile"), tree)
        subprocess.run(git + ["init", "-q"], cwd=tree, check=True)

        def make(target):
            return subprocess.run(["make", target], cwd=tree, env={"PATH": tools, "HOME": tmp},
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  encoding="utf-8")

        dirty = make("results")
        subprocess.run(git + ["add", "-A"], cwd=tree, check=True)
        subprocess.run(git + ["commit", "-qm", "a"], cwd=tree, check=True)
        clean = make("committed")
    lines = [line for line in dirty.stderr.splitlines() if not line.startswith("make: ***")]
    problems = [] if not clean.returncode and not clean.stderr else ["clean: %s" % clean]
    if dirty.returncode != 2 or dirty.stdout or len(lines) != 1 or "commit them" not in lines[0]:
        problems.append("dirty: %s" % dirty)
    return problems


CHECKS = [check_printed, check_compact, check_damaged, check_walk, check_scripts, check_colours, check_failed_colours, check_claims, check_lengths, check_dirty_tree]
LONG = [check_counted]
