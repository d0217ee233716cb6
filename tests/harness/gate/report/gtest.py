#!/usr/bin/env python3
"""googletest's protocol: the filter as gtest defines it, and lists and results as deqp-runner reads them."""
import itertools
import random
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import told
from told import WORDS, Case, ENDINGS, clean, tell

SAFE = re.compile(r"[A-Za-z0-9_=@+]+\.[A-Za-z0-9_=@+/]+")


# --- the filter ---


def oracle(text, name):
    """gtest's rule, by regular expressions."""
    def one(patterns):
        return any(re.fullmatch("".join({"*": ".*", "?": "."}.get(c, re.escape(c)) for c in pattern), name, re.S)
                   for pattern in patterns.split(":"))
    positive, minus, negative = text.partition("-")
    return bool(one(positive or "*" if minus else positive) and not (minus and one(negative)))


def matches(pairs):
    ran = subprocess.run([told.TELL, "matches", "-"], input=b"".join(text.encode() + b"\0" for pair in pairs for text in pair),
                         capture_output=True, check=True)
    return [digit == "1" for digit in ran.stdout.decode()]


def test_filters_by_hand():
    rows = [("*", "a.b", True), ("", "a.b", False), ("-", "a.b", True), ("-a.b", "a.b", False), ("a.*:c.*", "c.d", True),
            ("a.*-*.q", "a.q", False), ("a.*-*.q", "a.d", True), ("a.?", "a.bc", False), ("*a*b*", "xaxbx", True), ("*ab", "aab", True),
            ("a.b-c-d", "a.b", True), ("*-c-d", "c-d", False), ("*-a:b:c", "b", False), ("a.b:", "a.b", True), ("?", "", False), (":", "a", False)]
    found = matches([row[:2] for row in rows])
    assert found == [row[2] for row in rows], list(zip(rows, found))
    assert [oracle(*row[:2]) for row in rows] == found


def test_filters_are_gtests():
    chance = random.Random(16)
    names = ["".join(word) for size in range(5) for word in itertools.product("ab.", repeat=size)]
    pairs = [("".join(chance.choices("ab.*?:-", k=chance.randrange(9))), chance.choice(names)) for _ in range(20000)]
    found = matches(pairs)
    wrong = [pair for pair, is_found in zip(pairs, found, strict=True) if oracle(*pair) != is_found]
    assert not wrong, wrong[:5]
    assert 2000 < sum(found) < 18000


# --- deqp-runner ---


def deqp_list(text):
    """The tests of a list. deqp-runner takes a line with a point for a suite."""
    suite, found = None, []
    for line in text.decode().split("\n")[:-1]:
        is_suite, test = re.search(r"(\S*\.)", line), re.search(r"\s+(\S+)", line)
        assert is_suite or (suite and test), line
        if is_suite:
            suite = is_suite[1]
        else:
            found.append(suite + test[1])
    return found


def deqp_results(text):
    """(name, word) of the results; fails where deqp-runner would refuse."""
    running, found = None, []
    for line in text.decode().split("\n"):
        status, run = re.search(r"\[\s*(\S*)\s*\]\s(\S*)", line), re.search(r"\[\sRUN\s*\]\s(.*)", line)
        if running and status:
            assert status[1] in ("OK", "FAILED", "SKIPPED"), line
            assert status[2] == running, line
            found.append((running, status[1]))
            running = None
        elif not running and run:
            running = run[1]
    assert not running
    return found


def made_names(cases):
    return tell("names", cases).decode().split("\n")[:-1]


def every():
    return told.hostile() + [Case(b"streaks.small." + device) for device in (b"cpu", b"gl", b"cpu")] + [
        Case(b"drops.a"), Case(b"drops.a,b"), Case(b"drops.a_b"), Case(b"streaks.late"), Case(b"n" * 10000), Case(b"n" * 10000 + b"m"), Case(b"x."), Case(b".x"), Case(b"y." + b"z" * 159),
        Case(b"w" * 160 + b".v")]


def test_names_are_plain_and_no_two_the_same():
    names = made_names(every())
    assert len(set(names)) == len(names) == len(every())
    assert all(SAFE.fullmatch(name) and len(name) < 256 for name in names), names


def test_usual_names_are_kept():
    cases = [Case(name) for name in (b"streaks.small.vulkan@VK_DRIVER_FILES=new.json", b"a.b", b"a.b/c", b"a.b_c")]
    names = made_names(cases)
    assert names[0] == "streaks.small/vulkan@VK_DRIVER_FILES=new/json" and names[1] == "a.b" and names[3] == "a.b_c", names
    assert re.fullmatch("raingauge.a/b_c_[0-9a-f]{16}", names[2]) or re.fullmatch("a.b_c_[0-9a-f]{16}", names[2]), names


def test_lists_hold_each_case_once():
    listed = deqp_list(tell("list", every(), "*"))
    names = made_names(every())
    assert sorted(listed) == sorted(names)
    suites = [suite for suite, _ in itertools.groupby(name.split(".")[0] for name in listed)]
    assert len(set(suites)) == len(suites) and suites[0] == names[0].split(".")[0]


def test_each_name_as_a_filter_lists_itself():
    names = made_names(every())
    for name in names:
        assert deqp_list(tell("list", every(), name)) == [name], name
    three = names[3:6]
    assert sorted(deqp_list(tell("list", every(), ":".join(three)))) == sorted(three)
    assert tell("list", every(), "") == b""


def test_results_are_read_by_deqp_runner():
    cases = every() + [Case(b"e.%d" % i, ending=i) for i in range(len(ENDINGS))]
    text = tell("gtest", cases)
    wanted = [(name, ENDINGS[case.ending][2]) for name, case in zip(made_names(cases), cases, strict=True)]
    assert deqp_results(text) == wanted
    lines = text.decode().split("\n")
    for case in told.hostile():
        for line in clean(case.details, line=False).split("\n"):
            assert "| " + line.replace("[", "(") in lines, line
    assert not any(re.match(r"\s*::", line) or "##[" in line for line in lines)


def test_lines_are_gtests():
    text = tell("gtest", [Case(b"a.b", seconds=0.0115), Case(b"a.q", ending=WORDS.index("regressed"), message=b"slow"),
                          Case(b"a.d", ending=WORDS.index("unsupported"), seconds=float("nan"))])
    assert text.decode() == """[==========] Running 3 tests.
[ RUN      ] a.b
| a.b
| pass
[       OK ] a.b (12 ms)
[ RUN      ] a.q
| a.q
| regressed
| slow
[  FAILED  ] a.q (1250 ms)
[ RUN      ] a.d
| a.d
| unsupported
[  SKIPPED ] a.d (0 ms)
[==========] 3 tests ran. (1262 ms total)
[  PASSED  ] 1 test.
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] a.d
[  FAILED  ] 1 test, listed below:
[  FAILED  ] a.q
""", text.decode()


if __name__ == "__main__":
    told.run(globals())
