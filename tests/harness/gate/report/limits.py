#!/usr/bin/env python3
"""Reports that exceed a form's limits say what they cut or leave out, and keep the worst."""
import os
import re
import stat
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.dont_write_bytecode = True
import told
from told import Case, PASS, WORDS, tell

DIFFERS, REGRESSED = WORDS.index("differs"), WORDS.index("regressed")
JUNIT, SUMMARY = 30 * 1000 * 1000, 1024 * 1024


def bodies(text):
    return {case.get("name"): case.find("failure").text for case in xml.etree.ElementTree.fromstring(text).iter("testcase")}


def test_junit_cuts_the_longest_details():
    sizes = {"short": 1000, "middle": 9000000, "long": 15000000, "longer": 20000000}
    cases = [Case(name.encode(), ending=DIFFERS, message=b"m", details=b"<" * 100 + b"\xc3\xa9" * ((size - 100) // 2)) for name, size in sizes.items()]
    text = tell("junit", cases)
    assert JUNIT - 1000 < len(text) < JUNIT, len(text)
    found = {name: body.split("\n", 1)[1] for name, body in bodies(text).items()}
    for name, size in sizes.items():
        details = "<" * 100 + "é" * ((size - 100) // 2)
        if name in ("short", "middle"):
            assert found[name] == details, name
            continue
        kept, more = re.fullmatch(r"(.*)\n\.\.\. \((\d+) bytes more: the file would exceed 30 MB\)", found[name], re.S).groups()
        assert details.startswith(kept) and len(kept.encode()) + int(more) == len(details.encode())
        assert 9000000 < len(kept.encode()) < 11000000


def test_junit_that_fits_is_whole():
    details = "<é&" * 2700000
    body = bodies(tell("junit", [Case(b"a", ending=DIFFERS, details=details.encode())]))["a"]
    assert body == "differs: \n" + details


def test_junit_too_large_without_details_is_refused():
    told_too_much = [Case(b"%d" % i + b"\"" * 900, ending=DIFFERS, message=b"\"" * 4000) for i in range(700)]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "junit.xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write("before")
        error = tell("junit", told_too_much, path, status=1).decode()
        assert "700 cases exceed 30 MB without their details; gate fewer at once" in error and error.count("\n") == 1, error
        with open(path, encoding="utf-8") as file:
            assert file.read() == "before"
        assert os.listdir(folder) == ["junit.xml"]


def test_files_are_whole_or_as_before():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "report.json")
        tell("json", [Case(b"a")], path)
        with open(path, "rb") as file:
            assert file.read() == tell("json", [Case(b"a")])
        error = tell("json", [Case(b"a")], os.path.join(folder, "absent", "x"), status=1).decode()
        assert "absent/x" in error and error.count("\n") == 1, error
        assert os.listdir(folder) == ["report.json"]
        error = tell("summary", [Case(b"a")], os.path.join(folder, "summary.md"), status=1, is_full=True).decode()
        assert "summary.md: cannot be written" in error and error.count("\n") == 1, error
    error = tell("summary", [Case(b"a")], "/dev/full", status=1).decode()
    assert "/dev/full: cannot be opened: is not a regular file" in error and error.count("\n") == 1, error


def summary(cases, before):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "summary.md")
        with open(path, "wb") as file:
            file.write(b"x" * before)
        tell("summary", cases, path)
        with open(path, "rb") as file:
            return file.read()[before:]


def test_summary_leaves_out_the_least_bad():
    cases = [Case(b"n%d" % i, ending=REGRESSED if i % 2 else DIFFERS, message=b"m" * 500, details=b"d" * 50) for i in range(3000)]
    for before in (0, 500000):
        text = summary(cases, before)
        assert SUMMARY - 1500 < before + len(text) <= SUMMARY, len(text)
        rows = re.findall(rb"^\| (differs|regressed) \| n(\d+) ", text, re.M)
        order = [b"%d" % i for i in range(0, 3000, 2)] + [b"%d" % i for i in range(1, 3000, 2)]
        assert [number for _, number in rows] == order[:len(rows)] and 500 < len(rows) < 2500
        left = re.search(rb"\nLeft out, for GitHub takes no more: (\d+) cases, and the details of (\d+)\.\n\Z", text)
        assert int(left[1]) == 3000 - len(rows) and int(left[2]) == 3000 - text.count(b"\n### "), left


def test_summary_cuts_long_details():
    for before, kept, lost in (("", 5000, 4000), ("x", 4999, 4002)):
        text = summary([Case(b"a", ending=DIFFERS, details=(before + "é" * 7000).encode())], 0).decode()
        assert "\n" + before + "é" * kept + "\n... (%d bytes more)\n```\n" % lost in text, before


def test_summary_tells_no_better_case_in_the_place_of_a_worse():
    text = summary([Case(b"a", ending=DIFFERS, details=b"d" * 9000), Case(b"b", ending=REGRESSED, details=b"d")], SUMMARY - 8000)
    assert b"| a |" in text and b"| b |" in text and b"###" not in text
    assert text.endswith(b"takes no more: 0 cases, and the details of 2.\n"), text


def test_summary_without_room_is_left_alone():
    assert summary([Case(b"a", ending=DIFFERS)], SUMMARY) == b""
    assert summary([Case(b"a", ending=DIFFERS)], SUMMARY + 5) == b""


def test_long_texts_say_what_they_lost():
    long = "é".encode() * 5000
    cases = [Case(long, ending=DIFFERS, message=long), Case(long + b"x", ending=DIFFERS), Case(long), Case(b"k" * 1000), Case(b"k" * 1001, message=b"m" * 4000)]
    found = [case.get("name") for case in xml.etree.ElementTree.fromstring(tell("junit", cases)).iter("testcase")]
    for name in (found[0], found[1], found[4]):
        assert re.fullmatch(r"(é{484}|k{968})\.\.\.[0-9a-f]{16}", name), name
    assert found[2] == found[0] + " (2)" and found[0] != found[1] and found[3] == "k" * 1000
    body = bodies(tell("junit", cases[:2]))[found[0]]
    assert body == "differs: " + "é" * 1980 + "... (6040 bytes more)", body[-40:]
    assert "m" * 4000 + "<" in tell("junit", cases).decode()


if __name__ == "__main__":
    told.run(globals())
