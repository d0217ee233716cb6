#!/usr/bin/env python3
"""Tries the tests: builds a copy of the source that holds every fault of rows/ behind a switch, and runs the tests that ought to
notice each.

mutants.py BUILD [AREA]...    BUILD is a build of the source; an area is a file of rows/, or a room of kernels
mutants.py --places [BUILD]   only checks that the rows' places are in the source, and that BUILD's compiler takes their faults

Without areas all are tried. The faults of kernels are those of tests/core/techniques/mutants.py, which runs them. Prints a line a
fault: the test that noticed it and its seconds, or that it lived, with its row's reason. Ends with counts. The exit status is 1
if fewer than 95 % were noticed, if one lived without a reason, or if a test fails on the unchanged source. The test that noticed
a fault is tried first the next time.
"""
import concurrent.futures
import importlib.util
import json
import os
import pathlib
import shlex
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
LEAST_SHARE = 0.95
LEAST_LIMIT_S, TIMES_AS_LONG = 240, 4  # a test's time limit, from its time without a fault; exceeding it counts as noticing

sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))


def rows_of(path):
    """A module of rows."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def areas():
    """The modules of rows, by name, in order."""
    return {path.stem: rows_of(path) for path in sorted((HERE / "rows").glob("**/*.py"))}


def numbered(modules):
    """Every fault with its area, numbered from 1: the same numbers whatever areas are tried."""
    rows = [(area, row) for area, module in modules.items() for row in module.ROWS]
    return [(number, area, row) for number, (area, row) in enumerate(rows, 1)]


# --- the copy ---


def check_places(faults):
    wrong = []
    for _, area, row in faults:
        path = SOURCE / row.file
        count = path.read_text(encoding="utf-8").count(row.around) if path.exists() else 0
        if count != 1:
            wrong.append(f"mutants.py: {area}: {row.about}: {row.file} has {count} times: {row.around}")
    if wrong:
        sys.exit("\n".join(wrong))


def check_once(faults):
    """No text and no fault stands in two rows: what was found of one would count for the other."""
    seen, wrong = {}, []
    for _, area, row in faults:
        place = row.file, row.start_in((SOURCE / row.file).read_text(encoding="utf-8")), row.old, row.new
        for what in (row.about, place):
            if seen.setdefault(what, row) is not row:
                wrong.append(f"mutants.py: {area}: {row.about}: another row has the same {'fault' if what is place else 'text'}")
    if wrong:
        sys.exit("\n".join(wrong))


def changed(path, faults):
    """A file's text with the switches of its faults."""
    text = (SOURCE / path).read_text(encoding="utf-8")
    places = {}
    for number, row in faults:
        start = row.start_in(text)
        places.setdefault((start, start + len(row.old)), []).append((number, row))
    ordered = sorted(places)
    for (_, end), after in zip(ordered, ordered[1:]):
        if end > after[0]:
            sys.exit(f"mutants.py: {path}: places overlap: {places[after][0][1].about}")
    for start, end in reversed(ordered):
        made = text[start:end]
        for number, row in places[start, end]:
            made = row.with_switch(number, made)
        text = text[:start] + made + text[end:]
    return f'#include "tests/mutants/switch.h"\n#line 1 "{path}"\n' + text


def all_changed(faults):
    """The texts of all files that have faults, by name."""
    of_file = {}
    for number, _, row in faults:
        of_file.setdefault(row.file, []).append((number, row))
    return {path: changed(path, rows) for path, rows in sorted(of_file.items())}


def refused(command, text, build):
    """What a compiler says of a changed file that it does not take."""
    with tempfile.NamedTemporaryFile("w", suffix=pathlib.Path(command["file"]).suffix, encoding="utf-8") as file:
        file.write(text)
        file.flush()
        words = [file.name if word == command["file"] else word for word in shlex.split(command["command"])]
        # An older gcc only warns of a function that is declared nowhere.
        words += ["-fsyntax-only", "-Wno-error", "-Werror=implicit-function-declaration", "-I", str(SOURCE)]
        done = subprocess.run(words, cwd=build, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    return done.stderr if done.returncode else ""


def check_compiles(build, texts):
    """All faults of a file compile together, by the first command that compiles it."""
    commands = {}
    for command in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        commands.setdefault(os.path.relpath(build / command["file"], SOURCE), command)
    tried = [path for path in texts if path in commands]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        wrong = list(filter(None, pool.map(lambda path: refused(commands[path], texts[path], build), tried)))
    if wrong or not tried:
        sys.exit("mutants.py: faults that do not compile:\n" + "\n".join(wrong))
    print(f"{len(tried)} files with faults compile")


def write_changed(path, text):
    """Writes a file unless it is the same, so that it is not built again."""
    data = text if isinstance(text, bytes) else text.encode("utf-8")
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def copy_source(copy, faults):
    texts = all_changed(faults)
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=SOURCE,
                            check=True, stdout=subprocess.PIPE, text=True).stdout
    names = [name for name in listed.split("\0") if name and (SOURCE / name).is_file()]
    for name in names:
        write_changed(copy / name, texts[name] if name in texts else (SOURCE / name).read_bytes())
        (copy / name).chmod((SOURCE / name).stat().st_mode)


def tests_of(build):
    """The tests of a build, by name."""
    told = json.loads(subprocess.run(["meson", "introspect", "--tests", build], check=True, stdout=subprocess.PIPE, text=True).stdout)
    tests = {test["name"]: dict(test, workdir=test["workdir"] or build) for test in told}
    if len(tests) < len(told):
        sys.exit("mutants.py: two tests have one name")
    return tests


def configure(copy, *options):
    """The folder of a copy's build."""
    build = copy / "build"
    if not (build / "build.ninja").exists():
        subprocess.run(["meson", "setup", build, copy, *options], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", build, "build.ninja"], check=True, stdout=subprocess.DEVNULL)
    return build


def build_copy(copy, modules, wanted):
    build = configure(copy)
    known = tests_of(build)
    names = {name for area in wanted for name in modules[area].TESTS}
    names |= {name for area in wanted for row in modules[area].ROWS for name in row.tests}
    absent = sorted(names - set(known))
    if absent:
        sys.exit(f"mutants.py: no such tests: {', '.join(absent)}")
    subprocess.run(["ninja", "-C", build], check=True, stdout=subprocess.DEVNULL)
    return {name: known[name] for name in names}


# --- trying ---


def notices(test, number, cache, limit_s=None):
    """The message of a test that fails with a fault, or exceeds its time limit; "" if it passes. Processes that it leaves running
    are ended."""
    own = {"GOMP_SPINCOUNT": "0", "RG_LONG_S": "1e9", "RG_PROBE_S": "0", "XDG_CACHE_HOME": str(cache), "RG_MUTANT": str(number)}
    env = {**os.environ, **test["env"], **own}
    with tempfile.TemporaryFile() as told:
        run = subprocess.Popen(test["cmd"], cwd=test["workdir"], env=env, stdin=subprocess.DEVNULL, stdout=told,
                               stderr=subprocess.STDOUT, start_new_session=True)
        try:
            code = run.wait(timeout=limit_s)
        except subprocess.TimeoutExpired:
            code = -1
        finally:  # also if this tool is interrupted
            try:
                os.killpg(run.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            run.wait()
        told.seek(0)
        text = told.read().decode(errors="replace")
        return "exit status %d\n%s" % (code, text) if code != 0 or "\nnot ok" in text else ""


def try_unchanged(tests, cache):
    """Each test's time limit, in seconds."""
    limits_s = {}
    for name, test in tests.items():
        start = time.monotonic()
        if said := notices(test, 0, cache):
            sys.exit(f"mutants.py: {name} fails on the source as it is, {said}")
        limits_s[name] = max(LEAST_LIMIT_S, TIMES_AS_LONG * (time.monotonic() - start))
    return limits_s


class Found:
    """The test that noticed a fault the last time."""

    def __init__(self, path):
        self.path = path
        self.rows = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}

    def first(self, row):
        return [self.rows[row.about]] if row.about in self.rows else []

    def put(self, row, name):
        self.rows[row.about] = name
        self.path.write_text(json.dumps(self.rows, indent=1), encoding="utf-8")


def try_fault(number, row, module, tests, limits_s, found, scratch):
    """The test that notices a fault, or None."""
    order = found.first(row) + list(row.tests) + list(module.TESTS)
    with tempfile.TemporaryDirectory(dir=scratch) as own:
        cache = own if getattr(module, "OWN_CACHE", False) else scratch / "cache"
        for name in dict.fromkeys(name for name in order if name in tests):
            if notices(tests[name], number, cache, limits_s[name]):
                found.put(row, name)
                return name
    return None


def try_host(modules, wanted, scratch):
    """Tries the faults of areas. Returns the counts of each, and the number that lived without a reason."""
    faults = numbered(modules)
    check_places(faults)
    copy_source(scratch / "source", faults)
    (scratch / "cache").mkdir(exist_ok=True)
    tests = build_copy(scratch / "source", modules, wanted)
    limits_s = try_unchanged(tests, scratch / "cache")
    found, counts, unexplained = Found(scratch / "found.json"), {}, 0
    for number, area, row in faults:
        if area not in wanted:
            continue
        start = time.monotonic()
        name = try_fault(number, row, modules[area], tests, limits_s, found, scratch)
        seconds = time.monotonic() - start
        lived = f"LIVED: {row.lives or 'no reason is known'}"
        print(f"{area:10} {row.about}  [{row.file}]  {'noticed by ' + name if name else lived}  ({seconds:.1f} s)",
              flush=True)
        total, killed = counts.get(area, (0, 0))
        counts[area] = (total + 1, killed + bool(name))
        unexplained += not name and not row.lives
    return counts, unexplained


def try_kernels(build, room, test):
    """Runs a room's own tool on the texts of its kernels."""
    run = subprocess.Popen(test["cmd"], cwd=test["workdir"], env=dict(os.environ, **test["env"]), text=True,
                           stdout=subprocess.PIPE)
    total = lived = 0
    for line in run.stdout:
        total += line.startswith(("killed by ", "LIVED"))
        lived += line.startswith("LIVED")
        print(f"{room:10} {line}", end="", flush=True)
    if run.wait() and not lived:
        sys.exit(f"mutants.py: the faults of {room} could not be tried")
    return total, total - lived


def report(counts, unexplained):
    print()
    for area, (total, killed) in sorted(counts.items()):
        print(f"{area:16} {killed:4} of {total:4}")
    total, killed = (sum(column) for column in zip(*counts.values()))
    share = killed / total
    print(f"{'all':16} {killed:4} of {total:4} noticed, {100 * share:.1f} %; {unexplained} lived without a reason")
    return share >= LEAST_SHARE and not unexplained


def main():
    modules = areas()
    if sys.argv[1] == "--places":
        faults = numbered(modules)
        check_places(faults)
        check_once(faults)
        texts = all_changed(faults)
        for build in sys.argv[2:]:
            check_compiles(pathlib.Path(build).resolve(), texts)
        print(f"{len(faults)} faults of host code in {len(modules)} areas")
        return
    build, wanted = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    end = ", mutants"
    rooms = {name[: -len(end)].replace(" ", "/"): test for name, test in tests_of(build).items() if name.endswith(end)}
    unknown = [name for name in wanted if name not in modules and name not in rooms]
    if unknown:
        sys.exit(f"mutants.py: no area {', '.join(unknown)}; there are {', '.join([*modules, *rooms])}")
    wanted = wanted or [*modules, *rooms]
    scratch = build / "mutants"
    scratch.mkdir(exist_ok=True)
    counts, unexplained = {}, 0
    host = [name for name in wanted if name in modules]
    if host:
        counts, unexplained = try_host(modules, host, scratch)
    for room in [name for name in wanted if name in rooms]:
        total, killed = counts[room] = try_kernels(build, room, rooms[room])
        unexplained += total - killed
    sys.exit(0 if report(counts, unexplained) else 1)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    main()
