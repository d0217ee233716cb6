"""Tables of a user's own: files of rows, axes and claims, which table and claims take as they take the papers'."""
import json
import os
import re
import tempfile

HEAD = "table panes flow 48x48\nset move=paper panes=mirror environment=sky environment_px=16 model=none\n"
ROWS = "row resolution_px=16 | fps=800 faces=12\nrow resolution_px=64 | fps=700 faces=13\nhardware A card\n"
TEXT = (HEAD + "# A comment.\nabout rate by texels\nnote of a test\n" + ROWS + "variant few drops=20\n"
        "claim falls | gets slower\n"
        'claim ratio rows=1-2 least=1000 section=4.2 | "a thousand times"\n'
        "claim faster variant=few other=full least=0.001 | few drops are not slow\n")

# Lines below HEAD (or, where they begin with "table", alone), the line that is refused, and how. 0: the file as a whole.
WRONG = (
    ("about first", 1, r"about: write 'table NAME TECHNIQUE WIDTHxHEIGHT' above it", ""),
    ("table Panes flow 8x8", 1, r"name 'Panes': write small letters", ""),
    ("table stuppacher-2 flow 8x8", 1, r"name 'stuppacher-2': .* none of a paper's tables", ""),
    ("table mine fog 8x8", 1, r"technique 'fog': unknown", ""),
    ("table mine flow 8x", 1, r"size '8x': write WIDTHxHEIGHT", ""),
    ("table mine flow", 1, r"size '': write WIDTHxHEIGHT", ""),
    ("table", 1, r"table: nothing follows it", ""),
    ("table other flow 8x8", 3, r"table: stands twice"),
    ("set drops=1", 3, r"set: stands twice"),
    ("clam falls | x", 3, r"'clam': no line begins so; the nearest is 'claim'"),
    ("row nonsense=1", 3, r"parameter 'nonsense': flow has none of that name"),
    ("row drops", 3, r"parameter 'drops': write it as KEY=VALUE"),
    ("row drops=1 drops=2", 3, r"row: sets 'drops' twice"),
    ("row drops=1\nrow seed=1", 4, r"row: sets 'seed' and the first row does not"),
    ("row drops=1 seed=1\nrow drops=2", 4, r"row: does not set 'seed', and the first row does"),
    ("row | fps=1", 3, r"row: sets no parameter"),
    ("row drops=1 | fps=fast", 3, r"fps=fast: is no number"),
    ("row drops=1\nrow drops=2 | fps=3", 4, r"row: has 'fps' printed and the first row has not"),
    ("axis drops=1,2\nrow drops=3", 4, r"row: an axis stands before it"),
    ("row drops=3\naxis drops=1,2", 4, r"axis: rows stand before it"),
    ("axis drops=1,,2", 3, r"axis drops=1,,2: write it as"),
    ("axis seed=1,2..9\naxis drops=1,2..9", 0, r"axis: 81 rows are more than 64"),
    ("variant full drops=1", 3, r"variant 'full': write a new name"),
    ("variant dry drops=x", 3, r"parameter 'drops': 'x' is no "),
    ("frames 0", 3, r"frames '0': write a whole number of 1 to 100000"),
    ("claim falls | x", 3, r"claim: no row stands before it"),
    ("row drops=1 | fps=3", 0, r"say on which machine, by a line 'hardware \.\.\.'"),
    ("row drops=1 | fps_dry=3\nhardware x", 0, r"rows have 'fps_dry', and no variant is named 'dry'"),
    ("about nothing", 0, r"has no row"),
    (ROWS + "claim fals | x", 6, r"claim 'fals': no such test; the nearest is 'falls'"),
    (ROWS + "claim falls", 6, r"claim: has no words"),
    (ROWS + "claim falls rows=1-3 | x", 6, r"rows=1-3: write it as FIRST-LAST, of rows 1-2"),
    (ROWS + "claim ratio | x", 6, r"claim ratio: needs a number; add least="),
    (ROWS + "claim falls least=2 | x", 6, r"claim falls: has no use for least="),
    (ROWS + "claim times least=3 most=2 | x", 6, r"least=3 is more than most=2"),
    (ROWS + "claim slowest rows=1-1 knee=2 | x", 6, r"its knee lies outside of its rows"),
    (ROWS + "claim faster other=dry least=1 | x", 6, r"other=dry: no variant before this line has that name"),
    (ROWS + "claim flattens knee=1 least=2 | x", 6, r"claim flattens: is about errors"),
    (ROWS + "claim falls row=1 | x", 6, r"claim: 'row' is no word of it"),
    (ROWS + "claim falls | " + "x" * 200, 6, r"claim: its words are too long"),
    ("row drops=1\nclaim order | x", 4, r"claim order: is about printed rates"),
)


def write(folder, text):
    path = os.path.join(folder, "own.table")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def check_own(runner):
    """a file's rows, variants, printed values and claims are measured, printed, written, read and judged like a paper's"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        path = write(tmp, TEXT)
        done = runner.run(["table", path, "--device", "cpu", "--json", "-o", tmp + "/out"])
        again = runner.run(["table", "--from", tmp + "/out", "--json"])
        judged = runner.run(["table", path, "--from", tmp + "/out", "--claims", "--json"])
        brief = open(tmp + "/out/panes.md", encoding="utf-8").read()
        unknown = runner.run(["table", "panes", "--device", "cpu"])
    report = json.loads(done.stdout)
    if done.returncode or done.stderr or again.stdout != done.stdout:
        problems.append("exit status %d: %s" % (done.returncode, done.stderr))
    if (report["table"], report["hardware"], report["size_px"], report["note"]) != ("panes", "A card", [48, 48], "of a test"):
        problems.append("%s" % [report[name] for name in ("table", "hardware", "size_px", "note")])
    cells = [(cell["row"], cell["variant"], cell["published"], cell["status"]) for cell in report["cells"]]
    wanted = [({"resolution_px": px}, variant, {"fps": fps, "faces": faces} if variant == "full" else {"faces": faces}, "ok")
              for px, fps, faces in ((16, 800, 12), (64, 700, 13)) for variant in ("full", "few")]
    if cells != wanted:
        problems.append("cells: %s" % cells)
    if not all("environment=sky" in cell["set"] and ("drops=20" in cell["set"]) == (cell["variant"] == "few") for cell in report["cells"]):
        problems.append("sets: %s" % [cell["set"] for cell in report["cells"]])
    claims = [(claim["words"], claim["paper"], claim["section"], claim["source"], claim["test"], claim["verdicts"][0]["figures"])
              for claim in json.loads(judged.stdout)["claims"]]
    claims[0] = claims[0][:5]  # which of so small cells is faster is not known
    if claims != [("gets slower", "", "own.table", "printed", "falls"), ("a thousand times", "", "4.2", "said", "ratio", "misses"),
                  ("few drops are not slow", "", "own.table", "printed", "faster", "fits")]:
        problems.append("claims: %s%s" % (claims, judged.stderr))
    if '"a thousand times" (4.2): one launch: misses on cpu' not in brief:
        problems.append(brief)
    if unknown.returncode != 2 or "table 'panes': unknown" not in unknown.stderr:
        problems.append("without its file: %s" % unknown.stderr)
    return problems


def check_axes(runner):
    """axes make a row of each combination, with nothing to compare it with"""
    with tempfile.TemporaryDirectory() as tmp:
        path = write(tmp, HEAD + "axis resolution_px=16,32\naxis panes=glass,mirror\n")
        report = json.loads(runner.run(["table", path, "--device", "cpu", "--json"]).stdout)
    rows = [cell["row"] for cell in report["cells"]]
    wanted = [{"resolution_px": px, "panes": panes} for px in (16, 32) for panes in ("glass", "mirror")]
    return [] if rows == wanted and report["hardware"] is None else ["rows: %s, %s" % (rows, report["hardware"])]


def check_launches(runner):
    """--launches times each cell in so many processes, and its rate and interval come from them"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        path = write(tmp, TEXT)
        done = runner.run(["table", path, "--device", "cpu", "--launches", "3", "--json", "-o", tmp + "/out"])
        again = runner.run(["table", "--from", tmp + "/out", "--json"])
        brief = open(tmp + "/out/panes.md", encoding="utf-8").read()
        wrong = runner.run(["table", path, "--device", "cpu", "--launches", "1"])
    if done.returncode or done.stderr or again.stdout != done.stdout:
        problems.append("exit status %d: %s" % (done.returncode, done.stderr))
    of_launches = False
    for cell in json.loads(done.stdout)["cells"]:
        measured = cell["measured"]
        calm = sorted(ms for number, ms, stolen, others, seconds in measured["launches"] if max(stolen, others) <= 0.05)
        numbers = [launch[0] for launch in measured["launches"]]
        of_launches = of_launches or len(calm) > 1
        if numbers != list(range(1, len(numbers) + 1)) or not (len(calm) == 3 or len(numbers) == 6):
            problems.append("launches: %s" % measured["launches"])
        if len(calm) == 3 and (measured["ms"] != calm[1] or not measured["ms_low"] < calm[0] <= calm[2] < measured["ms_high"]):
            problems.append("a median of %s: %s" % (calm, measured))
    if of_launches != bool(re.search(r"Medians of [23]( to 3)? launches( or \d+( to \d+)? samples)? by wall clock", brief)):
        problems.append(brief)
    if wrong.returncode != 2 or "--launches" not in wrong.stderr:
        problems.append("one launch: %s" % wrong.stderr)
    return problems


def check_wrong(runner):
    """a file that is wrong is refused by one line with its file, the line and the mend, before a device is opened"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        for number, (text, line, told, *head) in enumerate(WRONG):
            path = write(tmp, (head[0] if head else HEAD) + text + "\n")
            for command in ("table", "claims") if number < 2 else ("table",):  # claims reads files as table does
                done = runner.run([command, path, "--device", "cpu", "-o", tmp + "/none"])
                place = "%s:%d: " % (path, line) if line else "%s: " % path
                if done.returncode != 2 or done.stdout or not re.fullmatch("raingauge: %s.*(%s).*\n" % (re.escape(place), told), done.stderr):
                    problems.append("%s: %d %s%s" % (text, done.returncode, done.stdout, done.stderr))
        if os.path.exists(tmp + "/none"):
            problems.append("a refused table left files")
        done = runner.run(["table", tmp + "/missing.table", "--device", "cpu"])
        if done.returncode != 2 or "missing.table: " not in done.stderr:
            problems.append("missing: %s" % done.stderr)
    return problems


CHECKS = [check_own, check_axes, check_launches, check_wrong]
