#!/usr/bin/env python3
"""Tries the tests with faults that nobody chose: drawn by seed over the functions of host code.

drawn.py BUILD [--seed N] [--count N] [--under FOLDER]... [--rows FILE] [--suite NAME]... [--seconds S] [--at-once N] [--list]

Draws functions, and in each a place and one of its faults: a comparison that is off by one or turned, an operand alone, a sum for a
difference, a number that is one more, a condition turned, a call or assignment left out. Builds one copy of the source with all of them
behind switches (switch.h), runs every test once to learn which faults its code reaches, and tries each fault with the tests that reach it,
from the quickest on, for at most S seconds. Prints a line a fault: the test that noticed it, or that it lived, with the tests for which the
time did not suffice. What was found stays in BUILD/drawn, and the same command goes on there. --list only prints the faults. --rows tries faults that somebody
planted instead, of a file like those of rows/. --suite tries only tests of these suites, for host code host, unit and cli; else it tries
all tests of `make test`.

Debian's python3-clang finds the places. What lived is for a reader to judge: a fault may change nothing that anyone needs.
"""
import argparse
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import mutants  # noqa: E402

try:
    from clang import cindex
except ImportError:
    sys.exit("drawn.py: needs Debian's package python3-clang, and Debian's python3")

KIND = cindex.CursorKind
OTHERS = {"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!="], "!=": ["=="], "+": ["-"], "-": ["+"],
          "*": ["/"], "/": ["*"], "&": ["|"], "|": ["&"], "<<": [">>"], ">>": ["<<"]}
NUMBERS = {getattr(cindex.TypeKind, name) for name in ("BOOL", "CHAR_S", "UCHAR", "USHORT", "SHORT", "INT", "UINT", "LONG", "ULONG", "LONGLONG",
                                              "ULONGLONG", "FLOAT", "DOUBLE", "ENUM")}
STATEMENTS = {KIND.COMPOUND_STMT, KIND.IF_STMT, KIND.FOR_STMT, KIND.WHILE_STMT}


@dataclasses.dataclass(frozen=True)
class Drawn:
    """A fault as mutants.py wants it: the text of its place, and the switch that replaces it."""
    file: str
    start: int
    old: str
    new: str  # "" leaves the statement out
    line: int
    function: str

    @property
    def about(self):
        return f"{self.file}:{self.line} {self.function}: {' '.join(self.old.split())} -> {' '.join(self.new.split()) or 'nothing'}"

    def start_in(self, _):
        return self.start

    def with_switch(self, number, otherwise):
        return f"(rg_mutant({number}) ? ({self.new}) : ({otherwise}))" if self.new else f"{{ if (!rg_mutant({number})) {otherwise} }}"


# --- places ---


class Function:
    """The faults that a function's body may have."""

    def __init__(self, file, text, cursor):
        self.file, self.text, self.name = file, text, cursor.spelling
        self.result = cursor.result_type.get_canonical().kind
        self.faults = []
        body = [child for child in cursor.get_children() if child.kind == KIND.COMPOUND_STMT]
        self.size = len(body and self.source(body[0]))
        for statement in body:
            self.visit(statement, None)

    def source(self, cursor):
        return self.text[cursor.extent.start.offset:cursor.extent.end.offset].decode()

    def put(self, cursor, new):
        """Adds a fault; a statement that is left out has its semicolon."""
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        old = self.text[start:end if new else self.text.index(b";", end) + 1].decode()
        self.faults.append(Drawn(self.file, len(self.text[:start].decode()), old, new, cursor.extent.start.line, self.name))

    def visit(self, cursor, parent):
        children = list(cursor.get_children())
        if cursor.kind == KIND.DECL_STMT and re.match(r"static\b", self.source(cursor)) or cursor.kind == KIND.CASE_STMT:
            children = children[1:] if cursor.kind == KIND.CASE_STMT else []
        self.statement(cursor, parent)
        self.binary(cursor, children)
        if cursor.kind == KIND.IF_STMT:
            self.turned(children[0])
        if cursor.kind == KIND.RETURN_STMT and children and self.result == cindex.TypeKind.BOOL:
            self.turned(children[0])
        if cursor.kind == KIND.INTEGER_LITERAL and re.fullmatch(r"\d+", self.source(cursor)) and parent.kind in (
                KIND.BINARY_OPERATOR, KIND.CALL_EXPR, KIND.RETURN_STMT, KIND.UNEXPOSED_EXPR):
            self.put(cursor, f"{self.source(cursor)} + 1")
        for child in children:
            self.visit(child, cursor)

    def statement(self, cursor, parent):
        """A call or an assignment that stands alone. What frees memory is for sanitizers."""
        if parent is None or parent.kind not in STATEMENTS or cursor.kind not in (
                KIND.CALL_EXPR, KIND.COMPOUND_ASSIGNMENT_OPERATOR, KIND.BINARY_OPERATOR, KIND.UNARY_OPERATOR):
            return
        head = parent.kind == KIND.FOR_STMT and self.text[parent.extent.start.offset:cursor.extent.start.offset]
        after = self.text[cursor.extent.end.offset:].lstrip()
        before = self.text[:cursor.extent.start.offset].rstrip()
        if after.startswith(b";") and before[-1:] in (b";", b"{", b"}", b")") and not (head and head.count(b"(") > head.count(b")")) and (
                not re.match(r"\w*free\(|va_end", self.source(cursor))):
            self.put(cursor, "")

    def binary(self, cursor, children):
        if cursor.kind != KIND.BINARY_OPERATOR or len(children) != 2:
            return
        left, right = (self.source(child) for child in children)
        sign = self.text[children[0].extent.end.offset:children[1].extent.start.offset].decode().strip()
        if self.source(cursor).split() != (left + " " + sign + " " + right).split():
            return  # of a macro
        if sign in ("&&", "||"):
            self.put(cursor, left)
            self.put(cursor, right)
        elif all(child.type.get_canonical().kind in NUMBERS for child in children):
            for other in OTHERS.get(sign, []):
                whole = sign in "&|" or sign in ("<<", ">>")
                self.put(cursor, f"({left}) {other} ({right})" if whole else f"{left} {other} {right}")

    def turned(self, cursor):
        if cursor.type.get_canonical().kind in NUMBERS and self.source(cursor) and "=" not in self.source(cursor).replace("==", ""):
            self.put(cursor, f"!({self.source(cursor)})")


def functions_of(build, under):
    """Every function that has places, of the files in these folders, in order."""
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    index, found = cindex.Index.create(), []
    system = subprocess.run(["gcc", "-print-file-name=include"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    seen = set()
    for command in commands:
        path = (build / command["file"]).resolve()
        name = str(path.relative_to(mutants.SOURCE)) if path.is_relative_to(mutants.SOURCE) else ""
        if path.suffix != ".c" or name in seen or not any(name.startswith(folder.rstrip("/") + "/") for folder in under):
            continue
        seen.add(name)
        flags = [word for word in command["command"].split() if word.startswith(("-I", "-D", "-std"))]
        unit = index.parse(str(path), [f"-I{build / flag[2:]}" if flag.startswith("-I") else flag for flag in flags] + ["-isystem", system])
        wrong = [said for said in unit.diagnostics if said.severity >= cindex.Diagnostic.Fatal]  # gcc takes more than clang
        if wrong:
            sys.exit(f"drawn.py: {wrong[0]}")
        text = path.read_bytes()
        for cursor in unit.cursor.get_children():
            if cursor.kind == KIND.FUNCTION_DECL and cursor.is_definition() and cursor.location.file.name == str(path):
                function = Function(name, text, cursor)
                if function.faults:
                    found.append(function)
    return sorted(found, key=lambda function: (function.file, function.name))


def draw(functions, seed, count):
    """Faults of as many functions; a function of twice the text is drawn twice as often. No two overlap, as they are of different ones."""
    drawing = random.Random(seed)
    left, faults = list(functions), []
    while left and len(faults) < count:
        function = drawing.choices(left, [one.size for one in left])[0]
        left.remove(function)
        faults.append(drawing.choice(function.faults))
    return faults


# --- trying ---


def is_tried(test, wanted):
    """By its suites, of which `wanted` are any."""
    suites = {suite.split(":")[-1] for suite in test["suite"]}
    return "thorough" not in suites and (not wanted or bool(suites & set(wanted)))


def reached_by(tests, scratch, at_once):
    """The seconds of each test on the source as it is, and the numbers of the faults that it reaches."""
    path = scratch / "reached.json"
    known = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}

    def look(name):
        told = scratch / "reached" / re.sub(r"\W", "-", name)
        told.write_text("", encoding="utf-8")
        start = time.monotonic()
        said = mutants.notices(dict(tests[name], env=dict(tests[name]["env"], RG_MUTANTS_REACHED=str(told))), 0, scratch / "cache")
        numbers = sorted({int(word) for word in told.read_text(encoding="utf-8").split()})
        return name, {"seconds": time.monotonic() - start, "reached": numbers, "fails": said[-600:]}

    (scratch / "reached").mkdir(exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
        for done in concurrent.futures.as_completed([pool.submit(look, name) for name in tests if name not in known]):
            name, row = done.result()
            known[name] = row
            path.write_text(json.dumps(known, indent=1), encoding="utf-8")
            print(f"{len(known)} of {len(tests)}: {name}: {row['seconds']:.1f} s, {len(row['reached'])} faults"
                  + (" -- FAILS on the source as it is, and is not asked" if row["fails"] else ""), flush=True)
    return {name: row for name, row in known.items() if name in tests and not row["fails"]}


def try_fault(number, tests, reached, scratch, seconds):
    """What became of a fault: the test that noticed it, how many were tried, and which were left out."""
    order = sorted((name for name, row in reached.items() if number in row["reached"]), key=lambda name: reached[name]["seconds"])
    start, tried = time.monotonic(), 0
    for place, name in enumerate(order):
        if time.monotonic() - start + reached[name]["seconds"] > seconds:
            return {"noticed": "", "tried": tried, "left": order[place:]}
        limit_s = 30 + mutants.TIMES_AS_LONG * reached[name]["seconds"]
        cache = scratch / "cache" / str(number)
        if mutants.notices(tests[name], number, cache, limit_s):
            return {"noticed": name, "tried": tried + 1, "left": []}
        tried += 1
    return {"noticed": "", "tried": tried, "left": []}


def try_all(faults, tests, reached, scratch, options):
    path = scratch / "found.json"
    found = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}

    def finished(fault):
        row = found.get(fault.about)
        return row and (row["noticed"] or not row["left"] or row["seconds"] >= options.seconds)

    with concurrent.futures.ThreadPoolExecutor(options.at_once) as pool:
        runs = {pool.submit(try_fault, number, tests, reached, scratch, options.seconds): fault
                for number, fault in enumerate(faults, 1) if not finished(fault)}
        for run in concurrent.futures.as_completed(runs):
            found[runs[run].about] = dict(run.result(), seconds=options.seconds)
            path.write_text(json.dumps(found, indent=1), encoding="utf-8")
            print("%d of %d tried" % (len(found), len(faults)), file=sys.stderr, flush=True)
    return found


def report(faults, found):
    for number, fault in enumerate(faults, 1):
        row = found[fault.about]
        said = "noticed by " + row["noticed"] if row["noticed"] else "LIVED, reached by no test" if not row["tried"] + len(row["left"]) else (
            f"LIVED {row['tried']} tests" + (f", untried: {', '.join(row['left'])}" if row["left"] else ""))
        print(f"{number:4} {fault.about}: {said}")
    noticed = sum(bool(found[fault.about]["noticed"]) for fault in faults)
    print(f"{noticed} of {len(faults)} noticed, {100 * noticed / len(faults):.1f} %")


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n")[1], description=__doc__.split("\n\n")[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--under", action="append")
    parser.add_argument("--rows", type=pathlib.Path)
    parser.add_argument("--suite", action="append")
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--at-once", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    build = options.build.resolve()
    if options.rows:
        faults = mutants.rows_of(options.rows).ROWS
        mutants.check_places([(0, options.rows, fault) for fault in faults])
    else:
        faults = draw(functions_of(build, options.under or ["harness"]), options.seed, options.count)
    if options.list:
        print("\n".join(f"{number:4} {fault.about}" for number, fault in enumerate(faults, 1)))
        return
    scratch = build / "drawn"
    scratch.mkdir(exist_ok=True)
    drawn = scratch / "faults.txt"
    told = "\n".join(fault.about for fault in faults)
    if drawn.exists() and drawn.read_text(encoding="utf-8") != told:
        for name in ("reached.json", "found.json"):
            (scratch / name).unlink(missing_ok=True)
    drawn.write_text(told, encoding="utf-8")
    mutants.copy_source(scratch / "source", [(number, "", fault) for number, fault in enumerate(faults, 1)])
    copy = mutants.configure(scratch / "source", "-Dlevels=v3", "-Dwerror=false")
    subprocess.run(["ninja", "-C", copy], check=True)
    tests = {name: test for name, test in mutants.tests_of(copy).items() if is_tried(test, options.suite)}
    shutil.rmtree(scratch / "cache", ignore_errors=True)
    (scratch / "cache").mkdir()
    report(faults, try_all(faults, tests, reached_by(tests, scratch, options.at_once), scratch, options))


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    main()
