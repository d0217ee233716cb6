#!/usr/bin/env python3
"""Every form of a report, with hostile texts, read back by parsers that share nothing with the writers."""
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import jsonschema

sys.dont_write_bytecode = True
import told
from told import Case, ENDINGS, NAN, WORDS, clean, tell

MEASURED = "ratio 1.052 (1.031 to 1.074), would have seen 2 %"


def same(found, wanted):
    assert found == wanted, "%r is not %r" % (found, wanted)


# --- JUnit ---


def body(case):
    return "%s: %s\n%s\n%s" % (WORDS[case.ending], clean(case.message), MEASURED, clean(case.details, line=False))


def test_junit_comes_back():
    cases = told.hostile()
    text = tell("junit", cases)
    suite = xml.etree.ElementTree.fromstring(text).find("testsuite")
    same(suite.find("properties/property").get("value"), "cpu\n<passport>")
    elements = suite.findall("testcase")
    same([element.get("name") for element in elements], told.names(cases))
    for element, case in zip(elements, cases):
        same(element.get("classname"), clean(case.technique))
        same(element.get("time"), "1.250")
        kind = ENDINGS[case.ending][1]
        same([child.tag for child in element if not child.tag.startswith("system")], [kind] if kind else [])
        inner = element.find(kind or "system-err")
        same(inner.text, body(case))
        same(inner.get("message"), clean(case.message) if kind else None)
        same(inner.get("type"), WORDS[case.ending] if kind in ("failure", "error") else None)
        path = clean(case.picture)
        same(element.find("system-out").text, "not attached, for its name: %s\n" % path if "]]" in path else "[[ATTACHMENT|%s]]\n" % path)
    for kind in ("failure", "error", "skipped"):
        same(int(suite.get({"skipped": "skipped"}.get(kind, kind + "s"))), len(suite.findall("testcase/" + kind)))
    same(int(suite.get("tests")), len(cases))


def test_junit_keeps_its_schema():
    for cases in (told.hostile(), [], [Case(b"a", seconds=NAN), Case(b"a", seconds=-1)]):
        ran = subprocess.run(["xmllint", "--noout", "--nonet", "--schema", told.SCHEMA, "-"], input=tell("junit", cases), capture_output=True,
                             check=False)
        assert ran.returncode == 0, ran.stderr[-2000:]


# --- GitHub ---


def decoded(text):
    return re.sub("%(..)", lambda code: chr(int(code[1], 16)), text)


def annotations(cases):
    """(command, title, message) of each line, as GitHub's runner reads it."""
    lines = tell("annotations", cases).decode().split("\n")
    same(lines.pop(), "")
    found = [re.fullmatch(r"::(error|warning) title=([^:,\r\n]*)::(.*)", line) for line in lines]
    assert all(found), lines
    return [(match[1], decoded(match[2]), decoded(match[3])) for match in found]


def test_annotations_come_back():
    for case in told.hostile():
        command = ENDINGS[case.ending][3]
        same(annotations([case]), [(command, clean(case.name), "%s: %s\n%s" % (WORDS[case.ending], clean(case.message), MEASURED))] if command else [])


def test_three_annotations_worst_first():
    for first in range(len(ENDINGS)):
        cases = [Case(b"c%d" % i, ending=i) for i in reversed(range(first, len(ENDINGS)))]
        wanted = [(row[3], "c%d" % i, row[0] + ": ") for i, row in enumerate(ENDINGS) if i >= first and row[3]]
        same(annotations(cases), wanted[:3])


def unescaped(text):
    return re.sub(r"\\([!-/:-@\[-`{-~])", r"\1", text)


def summary(cases, before=b""):
    """(head, rows, rest) of the Markdown that is appended."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "summary.md")
        with open(path, "wb") as file:
            file.write(before)
        tell("summary", cases, path)
        with open(path, "rb") as file:
            text = file.read()
    assert text.startswith(before)
    head, _, rest = text[len(before):].decode().partition("\n\n")
    lines = rest.split("\n")
    rows = []
    while lines and lines[0].startswith("|"):
        cells = re.split(r"(?<!\\)(?:\\\\)*\|", lines.pop(0))
        rows.append([unescaped(cell).strip(" ") for cell in cells[1:-1]])
    return head, rows[2:], "\n".join(lines)


def test_markdown_comes_back():
    cases = told.hostile()
    order = sorted(range(len(cases)), key=lambda i: cases[i].ending)
    names = told.names(cases)
    head, rows, rest = summary(cases, b"# before\n")
    assert head.startswith("## raingauge gate: %d cases, " % len(cases)), head
    listed = [i for i in order if WORDS[cases[i].ending] != "pass"]
    same(rows, [[WORDS[cases[i].ending], names[i].strip(" "), clean(cases[i].message).strip(" "), MEASURED] for i in listed])
    same([unescaped(line[4:]) for line in rest.split("\n") if line.startswith("### ")], [names[i] for i in listed])
    blocks = re.findall(r"^(`{3,})text\n(.*?)\n\1\n", rest, re.M | re.S)
    same([text for _, text in blocks], [clean(cases[i].details, line=False) for i in listed])
    assert not re.search(r"(?<!\\)[<>]", re.sub(r"^(`{3,})text\n(.*?)\n\1\n", "", rest, flags=re.M | re.S))


def test_markdown_of_what_passed_is_one_line():
    same(summary([Case(b"a", details=b"x"), Case(b"b")]), ("## raingauge gate: 2 cases, 2 pass", [], ""))


# --- JSON ---


def strict(text):
    def refuse(constant):
        raise ValueError(constant)

    def once(pairs):
        assert len({name for name, _ in pairs}) == len(pairs)
        return dict(pairs)
    return json.loads(text.decode(), parse_constant=refuse, object_pairs_hook=once)


def test_bmf_comes_back():
    cases = told.hostile()
    measures = {"latency": {"value": 4.5e6, "lower_value": 4.25e6, "upper_value": 4.75e6},
                "ratio": {"value": 1.052, "lower_value": 1.031, "upper_value": 1.074}}
    same(strict(tell("bmf", cases)), {name: measures for name in told.names(cases)})


def test_bmf_leaves_out_what_is_unknown():
    cases = [Case(b"a"), Case(b"b", ratio=(1.5, NAN, float("inf"))), Case(b"c", time_ms=(2, 1, NAN))]
    same(strict(tell("bmf", cases)), {"b": {"ratio": {"value": 1.5}}, "c": {"latency": {"value": 2e6, "lower_value": 1e6}}})


def test_json_comes_back():
    cases = told.hostile() + [Case(b"unknown", seconds=NAN)]
    document = strict(tell("json", cases))
    with open(os.path.join(os.path.dirname(__file__), *[".."] * 4, "docs", "records.schema.json"), encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator(schema).validate(document)
    same(document["passport_text"], "cpu\n<passport>")
    same(document["endings"], {word: sum(WORDS[case.ending] == word for case in cases) for word in WORDS})
    for found, case, name in zip(document["gated"], cases, told.names(cases), strict=True):
        numbers = [None if number != number else number for number in (case.seconds, *case.ratio, case.smallest_visible, *case.time_ms, case.baseline_ms)]
        same(found, {"name": name, "technique": clean(case.technique), "devices": [clean(case.device)], "seconds": numbers[0],
                     "ending": WORDS[case.ending], "compared": False, "over": False, "message": clean(case.message), "details": clean(case.details, line=False),
                     "attachments": [clean(case.picture)] if case.picture else [],
                     "ratio": dict(zip(("value", "low", "high"), numbers[1:4])), "smallest_visible": numbers[4],
                     "time_ms": dict(zip(("value", "low", "high"), numbers[5:8])), "baseline_ms": numbers[8]})


def test_json_is_read_again():
    cases = told.hostile() + [Case(b"unknown", seconds=NAN)]
    same(strict(tell("again", cases)), strict(tell("json", cases)))


# --- text ---


def test_text_is_for_terminals_and_logs():
    cases = told.hostile() + [Case(b"long", ending=0, message=b"word " * 100 + b"x" * 300)]
    text = tell("text", cases).decode()
    assert max(map(len, text.split("\n"))) == 110
    assert not re.search("[\x00-\x09\x0b-\x1f\x7f-\x9f]", text)
    firsts = [line.split("  ")[0] for line in text.split("\n")[:-1] if not re.match("  [|] |[0-9]", line)]
    same(firsts, sorted((WORDS[case.ending] for case in cases), key=WORDS.index))
    assert "##[" not in text and not re.search(r"^\s*::", text, re.M)
    joined = text.replace("\n  | ", "").replace(" ", "")
    for case, name in zip(cases, told.names(cases)):
        for part in (name, clean(case.message), clean(case.details, line=False)):
            assert re.sub(r"[ \n\t]", "", part).replace("##[", "##(") in joined, part
    assert text.endswith("\n") and "%d cases, " % len(cases) in text


def test_colours_only_add_to_text():
    cases = told.hostile()
    coloured = tell("coloured", cases).decode()
    colours = re.findall("^\033\\[(3[123])m([a-z -]+)\033\\[0m", coloured, re.M)
    same({(word, code) for code, word in colours},
         {(word, {None: "32", "skipped": "33"}.get(kind, "31")) for word, kind, _, _ in ENDINGS})
    same(re.sub("\033\\[[0-9]+m", "", coloured), tell("text", cases).decode())


if __name__ == "__main__":
    told.run(globals())
