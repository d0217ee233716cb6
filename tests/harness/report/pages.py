#!/usr/bin/env python3
"""The contents of the page that `raingauge report` makes, and the records that it refuses: pages.py RAINGAUGE. It needs no browser."""
import base64
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

sys.dont_write_bytecode = True

import made

JUST = {"format": 1, "devices": [], "checks": []}


def page_of(raingauge, folder, *records):
    result = made.report(raingauge, folder, *records, "-o", "page.html")
    if result.returncode or result.stderr:
        raise AssertionError(f"{result.returncode}: {result.stderr}")
    return made.data_of(folder / "page.html")


def check_tables(raingauge, folder):
    """all tables of the repository are in one page below 5 MB, with print's rows and the verdicts that `table --claims` gives"""
    data = page_of(raingauge, folder, made.TABLES, made.ROOT / "docs" / "pictures.md")
    tables = {record["document"]["table"]: record for record in data["records"]}
    claims = json.loads(subprocess.run([raingauge, "table", "--claims", "--from", made.TABLES, "--json"], capture_output=True, check=True).stdout)
    problems = []
    if len(tables) != len(list(made.TABLES.glob("*.json"))) or (folder / "page.html").stat().st_size >= 5e6:
        problems.append(f"{len(tables)} tables, {(folder / 'page.html').stat().st_size} bytes")
    if data["claims"] != claims:
        problems.append("the claims are not those of table --claims")
    if data["rules"] != {"looks": [12, 24, 48, 96], "fall": 1.05, "reversal": 1.1}:
        problems.append(data["rules"])
    reasons = [verdict["why"] for claim in claims["claims"] if claim["test"] == "falls" for verdict in claim["verdicts"]]
    if not any("needed: at least 0.909, or 1/1.1, since a row may be 1.1 times as fast as the row before" in why for why in reasons):
        problems.append(reasons)
    printed = tables["creus-5.4"]["printed"]
    if printed["columns"][0] != "culling_radius_m" or printed["rows"][0]["values"][:2] != [5, 70303] or printed["paper"] != "creus":
        problems.append(printed)
    cells = [cell for record in tables.values() for cell in record["document"]["cells"]]
    if any("checksum" in cell or {"samples_ms", "taken", "passes_share"} & set(cell.get("measured", {})) for cell in cells):
        problems.append("samples are in the page, which shows medians and intervals alone")
    if len(data["gallery"]) != 3 or any(shown["file"] not in data["files"] or not shown["caption"].endswith(".") for shown in data["gallery"]):
        problems.append(data["gallery"])
    return problems


def check_policy(raingauge, folder):
    """a page runs one script and has one style, by their digests, and loads nothing"""
    made.write(folder / "a.json", JUST)
    page_of(raingauge, folder, "a.json")
    text = (folder / "page.html").read_text(encoding="utf-8")
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text)[1]
    digest = lambda part: "'sha256-%s'" % base64.b64encode(hashlib.sha256(part.encode()).digest()).decode()
    script, style = text.split("<script>")[1].split("</script>")[0], text.split("<style>")[1].split("</style>")[0]
    wanted = f"default-src 'none'; script-src {digest(script)}; style-src {digest(style)}; img-src data:; base-uri 'none'; form-action 'none'"
    around = text.replace(script, "").replace(style, "")
    problems = [] if policy == wanted else [policy, wanted]
    return problems + re.findall(r'(?:src|href)="(?!#|data:)[^"]*"|\son\w+="[^"]*"|\sstyle="[^"]*"', around)


def check_hostile(raingauge, folder):
    """a text that would end the page's script, or begin one, stays a text"""
    made.write(folder / "a.json", made.gate(made.case(made.HOSTILE, "differs", message=made.HOSTILE, details=made.HOSTILE, technique=made.HOSTILE,
                                                      devices=[made.HOSTILE], attachments=[made.HOSTILE]), passport_text=made.HOSTILE))
    data = page_of(raingauge, folder, "a.json")
    text = (folder / "page.html").read_text(encoding="utf-8")
    problems = [] if data["records"][0]["document"]["gated"][0]["message"] == made.HOSTILE else [data["records"]]
    if text.count("<script") != 2 or text.count("<!--") or text.count("<img"):
        problems.append("the text is more than a text")
    return problems


def check_kinds(raingauge, folder):
    """each kind of record is recognized, and unknown fields are kept"""
    records = {"gate": made.gate(), "verify": JUST, "diff": {"format": 1, "devices": [], "pairs": [], "failures": []},
               "doctor": {"format": 1, "passport": {}, "devices": [], "missing": [], "warnings": []},
               "baseline": {"format": 1, "devices": [], "baseline": []}, "claims": {"format": 1, "tables": [], "claims": [], "launches": 7},
               "render": {"format": 1, "file": "none.png"}, "bisect": {"format": 1, "candidates": 3}}
    for kind, document in records.items():
        made.write(folder / (kind + ".json"), document)
    data = page_of(raingauge, folder, ".")
    found = {record["kind"]: record["document"] for record in data["records"]}
    return [] if found == records else [found]


def check_older(raingauge, folder):
    """a record from before there were checksums is read, and so is one with newer fields"""
    record = json.loads((made.TABLES / "stuppacher-2.json").read_text(encoding="utf-8"))
    for cell in record["cells"]:
        del cell["checksum"]
        cell["of_tomorrow"] = [{"ms": 1}]
    record["of_tomorrow"] = {"a": 1}
    made.write(folder / "a.json", record)
    data = page_of(raingauge, folder, "a.json")
    return [] if data["records"][0]["document"]["table"] == "stuppacher-2" and data["claims"]["claims"] else [data]


def check_machines(raingauge, folder):
    """a page of several machines has each one's tables, and names the machine of each table and verdict"""
    data = page_of(raingauge, folder, made.machines(folder / "all"))
    names = [machine["name"] for machine in data["machines"]]
    tables = sorted((record["machine"], record["document"]["table"]) for record in data["records"])
    problems = [] if names == ["A", "B"] and data["machines"][1]["differs"] == "cpu Second CPU and not First CPU" else [data["machines"]]
    if tables != [(name, table) for name in names for table in ("chin-timing", "creus-5.4")]:
        problems.append(tables)
    found = {(v["machine"], v["verdict"]) for claim in data["claims"]["claims"] for v in claim["verdicts"] if claim["table"] == "chin-timing" and v["device"] == "cpu"}
    return problems + ([] if found == {("A", "reproduced"), ("B", "not reproduced")} else [found])


# Refused records: the files, the arguments, and a pattern of the one line.
TABLE = (made.TABLES / "raster-1.json").read_text(encoding="utf-8")
REFUSED = [
    ({}, [], r"report: names no records; name files or folders, such as results/tables"),
    ({}, ["none.json"], r"none\.json: cannot be read: No such file or directory; name what a command wrote"),
    ({}, ["."], r"\.: holds no \.json and no figures\.md"),
    ({"a.json": ""}, ["a.json"], r"a\.json: line 1 is no JSON: .*; name what a command wrote"),
    ({"a.json": '{"format": 1, "checks": ['}, ["a.json"], r"a\.json: line 1 is no JSON"),
    ({"a.json": '{"format": 1, "checks": [NaN]}'}, ["a.json"], r"a\.json: line 1 is no JSON"),
    ({"a.json": "[" * 100000}, ["a.json"], r"a\.json: line 1 is no JSON: maximum parsing depth"),
    ({"a.json": "[]"}, ["a.json"], r"a\.json: is no record of raingauge"),
    ({"a.json": '{"format": "1", "checks": []}'}, ["a.json"], r"a\.json: is no record of raingauge"),
    ({"a.json": '{"format": 1}'}, ["a.json"], r"a\.json: is no record of raingauge"),
    ({"a.json": '{"format": 2, "checks": []}'}, ["a.json"], r"a\.json: is of format 2, and this raingauge knows format 1; use the raingauge that wrote"),
    ({"a.json": TABLE.replace('"format":1', '"format":2').replace('"format": 1', '"format": 2')}, ["a.json"], r"a\.json: .*format"),
    ({"a.json": TABLE, "b.json": TABLE}, ["a.json", "b.json"], r"b\.json: holds table 'raster-1', which a\.json holds too; name one of them"),
    ({"a.json": re.sub(r'"samples_ms": ?\[[0-9.]+', '"samples_ms":[1', TABLE, count=1)}, ["a.json"], r"a\.json: .*checksum"),
    ({"a.json": json.dumps(JUST)}, ["a.json", "--against", "b.json"], r"b\.json: cannot be read: No such file or directory"),
    ({"a.json": json.dumps(JUST)}, ["a.json", "-o", "none/none/page.html"], r"none/none/: cannot be made: No such file or directory"),
]


def check_refused(raingauge, folder):
    """a file that is no record, is damaged or has a newer format ends with 2 and one line, and leaves no page"""
    problems = []
    for files, words, line in REFUSED:
        for name in list(folder.iterdir()):
            name.unlink()
        for name, text in files.items():
            made.write(folder / name, text)
        result = made.report(raingauge, folder, *words)
        if result.returncode != 2 or result.stderr.count("\n") != 1 or not re.search(line, result.stderr) or list(folder.glob("*.html")):
            problems.append(f"{words}: {result.returncode}, {result.stderr}")
    return problems


def check_pictures(raingauge, folder):
    """pictures stand in the page once, and come only from the record's folder, the current one and those below; other files do not"""
    inside, outside = folder / "in", folder / "out"
    (inside / "pictures").mkdir(parents=True)
    outside.mkdir()
    red, blue = made.png(2, 2, lambda x, y: (255, 0, 0)), made.png(2, 2, lambda x, y: (0, 0, 255))
    (inside / "pictures" / "a.png").write_bytes(red)
    (inside / "pictures" / "again.png").write_bytes(made.png(2, 2, lambda x, y: (255, 0, 0), level=0))
    (outside / "secret.png").write_bytes(blue)
    (inside / "text.png").write_text("no picture", encoding="utf-8")
    beside = folder / "in2"
    beside.mkdir()
    (beside / "secret.png").write_bytes(blue)
    os.symlink(outside / "secret.png", inside / "link.png")
    os.mkfifo(inside / "pipe.png")
    names = ["pictures/a.png", "pictures/again.png", "text.png", "link.png", "pipe.png", "../out/secret.png", "../in2/secret.png", str(outside / "secret.png"), "none.png"]
    made.write(inside / "gate.json", made.gate(made.case("a", "differs", attachments=names)))
    made.write(inside / "figures.md", "# Figures\n\n![a](pictures/a.png)\n\n**a.** Red, `all` of\nit.\n\n> What the\npaper\n> says.\n\n    raingauge render\n\n![b](../out/secret.png)\n\nNone.\n")
    data = page_of(raingauge, inside, ".")
    problems = [] if sorted(data["files"]) == ["pictures/a.png", "pictures/again.png"] and len(data["pictures"]) == 1 else [data["files"]]
    if base64.b64decode(list(data["pictures"].values())[0].split(",")[1])[:4] != b"RIFF":
        problems.append("the picture is no WebP")
    if data["gallery"] != [{"file": "pictures/a.png", "caption": "a. Red, all of it.", "printed": "What the paper says."}, {"file": "../out/secret.png", "caption": "b"}]:
        problems.append(data["gallery"])
    return problems


def brief(raingauge, folder, form, *records):
    result = made.report(raingauge, folder, *records, "--format", form)
    assert not result.returncode and not result.stderr, result.stderr
    return result.stdout


def check_markdown(raingauge, folder):
    """Markdown has the findings, the three worst first, is below 60 kB, and takes no text for markup; the last gate stands for all"""
    endings = ["pass"] * 400 + ["regressed"] * 400 + ["differs", "crash", "inconclusive", "set-up"]
    cases = [made.case(f"{ending} {i}", ending, message="a" * 200) for i, ending in enumerate(endings)]
    made.write(folder / "a.json", made.gate(made.case("of an earlier run", "crash")))
    made.write(folder / "b.json", made.gate(*cases, made.case("| @user `x` <b>", "timeout", message=made.HOSTILE)))
    text = brief(raingauge, folder, "md", "a.json", "b.json")
    rows = [line for line in text.split("\n") if line.startswith("| ") and "---" not in line and "| found" not in line]
    problems = [] if rows[0].startswith("| crash | crash 801 |") and rows[1].startswith("| timeout |") and rows[2].startswith("| set-up |") else rows[:3]
    if "404 of 805 cases of the gate failed." not in text or "earlier" in text or "data:" in text or "lines had no room here" not in text:
        problems.append(text[:500])
    if len(text.encode()) > 60000 or re.search(r"(?<!\\)<(?!/?details|/?summary)|@", text) or len(re.findall(r"(?<!\\)\|", rows[1])) != 4:
        problems.append((len(text), rows[1]))
    text = brief(raingauge, folder, "md", made.TABLES)
    return problems + ([] if re.search(r"^Of \d+ claims that papers make, \d+ holds?, ", text, re.M) and "camera 2" in text else [text[:500]])


def check_verified(raingauge, folder):
    """Markdown lists verify's checks that fail, the three worst first, and no others"""
    statuses = ["ok", "fail", "unsupported", "error", "nothing", "timeout", "crash"]
    checks = [{"technique": "flow", "check": "image", "device": f"of {status}", "status": status, "detail": ""} for status in statuses]
    made.write(folder / "a.json", {"format": 1, "devices": [], "checks": checks})
    found = re.findall(r"(?m)^\| (\w+) \| flow, image on of \w+ \|", brief(raingauge, folder, "md", "a.json"))
    worst = ["crash", "timeout", "error"]
    return [] if found == worst + worst + ["fail"] else [found]


def check_many(raingauge, folder):
    """the page has the last thirty of a thousand gates, and says how many it leaves out"""
    for i in range(1000):
        made.write(folder / f"{i:04}.json", made.gate(made.case(str(i), "pass", 1.0)))
    data = page_of(raingauge, folder, ".")
    names = [record["document"]["gated"][0]["name"] for record in data["records"]]
    return [] if names == [str(i) for i in range(970, 1000)] and data["gates_left_out"] == 970 else [names, data["gates_left_out"]]


def check_stands(raingauge, folder):
    """claims are counted by their standing: verdicts go before figures of one launch, which are no verdict"""
    def claim(*verdicts):
        return {"id": str(verdicts), "table": "a", "paper": "b", "words": "c", "part": None, "verdicts": [
            {"device": str(i), "verdict": verdict, "figures": figures} for i, (verdict, figures) in enumerate(verdicts)]}
    yes, no, fits, misses, none = ("reproduced", None), ("not reproduced", None), ("one launch", "fits"), ("one launch", "misses"), ("undecided", None)
    claims = [claim(yes, misses), claim(yes, none), claim(yes, no), claim(no, fits), claim(fits, none), claim(fits, misses), claim(misses, none), claim(none, none)]
    made.write(folder / "a.json", {"format": 1, "tables": [], "claims": claims})
    wanted = ("Of 8 claims that papers make, 2 hold, 1 holds on some devices only, 1 does not hold, 1 fits by one launch alone, 2 miss by one launch alone, "
              "1 is open. One launch is no verdict.")
    text = brief(raingauge, folder, "md", "a.json")
    return [] if wanted in text else [text]


def check_badge(raingauge, folder):
    """a badge is an SVG that says how many claims of a paper hold, or how many cases fail"""
    made.write(folder / "a.json", made.gate(made.case("a", "crash"), made.case("b")))
    made.write(folder / "b.json", {"format": 1, "devices": [], "checks": []})
    claims = [{"id": paper, "table": "a", "paper": paper, "words": "c", "part": None, "verdicts": [{"device": "0", "verdict": "reproduced", "figures": None}]}
              for paper in ("ye", "chin", "chin")]
    made.write(folder / "c.json", {"format": 1, "tables": [], "claims": claims[:2]})
    made.write(folder / "d.json", {"format": 1, "tables": [], "claims": claims})
    made.write(folder / "e.json", {"format": 1, "tables": [], "claims": claims[1:]})
    titles = [ElementTree.fromstring(brief(raingauge, folder, "badge", record)).findtext("{http://www.w3.org/2000/svg}title")
              for record in ("a.json", "b.json", "c.json", "d.json", "e.json", made.TABLES / "creus-5.6.json", made.TABLES)]
    wanted = [r"raingauge: 1 of 2 fail", r"raingauge: nothing measured", "raingauge: 2 of 2 claims hold", "raingauge: 3 of 3 claims hold", "chin: 2 of 2 claims hold", r"creus: \d+ of \d+ claims hold", r"raingauge: \d+ of \d+ claims hold"]
    return [] if all(map(re.fullmatch, wanted, titles)) else [titles]


def main():
    raingauge = str(pathlib.Path(sys.argv[1]).resolve())

    def in_folder(check):
        def checked():
            with tempfile.TemporaryDirectory() as folder:
                try:
                    return check(raingauge, pathlib.Path(folder))
                except AssertionError as error:
                    return [error]
        checked.__doc__ = check.__doc__
        return checked
    return made.run([in_folder(check) for check in (check_tables, check_policy, check_hostile, check_kinds, check_older, check_machines, check_refused, check_pictures, check_markdown, check_verified, check_many, check_stands, check_badge)])


if __name__ == "__main__":
    sys.exit(main())
