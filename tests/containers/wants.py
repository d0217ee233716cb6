"""Raingauge's own wants are reported as such: they are no driver's fault, no skip and no bad usage, and make no result wrong."""
import json
import os
import random
import re
import shutil
import subprocess
import tempfile

from refusals import call, shell, within

SMALL = "--size 16x16 --frame 1 "
COMMANDS = {
    "diff": "diff raster --device cpu,cpu:reference " + SMALL + "--json",
    "verify": "verify raster --device cpu --quick --size 16x16 --frame 1 --json",
    "stages": "verify shower --stages --device cpu --quick --size 16x16 --frame 1 --json",
    "gate": "gate cpu cpu:reference --pictures --cells IN/cells.txt --json --junit OUT/report.xml",
    "table": "table stuppacher-2 --rows 1-1 --quick --device cpu --work paper --json",
    "render": "render raster --device cpu " + SMALL + "-o OUT/a.png",
    "read": "diff IN/a.tif IN/b.tif --json",
}
LACKING = 71
# Words that must not appear when raingauge itself lacks something.
BLAMES = re.compile(r"its driver|is damaged|damaged;|install|unsupported|[Aa]ssimp crashed|the Debian package")
CALLS, SAMPLE = 200, 10
OPTIONS = {13, 14, 15, 16}  # the calls that keep the options' values, of most commands


def lib(what, of="", at=0):
    """Raingauge's own calls of a kind fail."""
    return {"WANT_CALL": what, "WANT_OF": of, "WANT_AT": str(at)}


def plain(refusing):
    return []


FULL = "mount -t tmpfs -o size=4k none OUT; head -c 4096 /dev/zero >OUT/full 2>/dev/null"
# By name: the prefix of the command, and the variables of the preloaded library.
WANTS = {
    "addresses, 60 MB": (shell("ulimit -v 60000"), {}),
    "addresses, 80 MB": (shell("ulimit -v 80000"), {}),
    "addresses, 100 MB": (shell("ulimit -v 100000"), {}),
    "addresses, 150 MB": (shell("ulimit -v 150000"), {}),
    "addresses, 200 MB": (shell("ulimit -v 200000"), {}),
    "addresses, 400 MB": (shell("ulimit -v 400000"), {}),
    "data, 8 MB": (shell("ulimit -d 8000"), {}),
    "data, 16 MB": (shell("ulimit -d 16000"), {}),
    "5 descriptors": (shell("ulimit -n 5"), {}),
    "6 descriptors": (shell("ulimit -n 6"), {}),
    "8 descriptors": (shell("ulimit -n 8"), {}),
    "10 descriptors": (shell("ulimit -n 10"), {}),
    "14 descriptors": (shell("ulimit -n 14"), {}),
    "processes, EAGAIN": (call("clone,clone3", 11), {}),
    "processes, ENOMEM": (call("clone,clone3", 12), {}),
    "processes, EPERM": (call("clone,clone3", 1), {}),
    "processes of its own": (plain, lib("spawn")),
    "files of no size": (shell("ulimit -f 0"), {}),
    "files of 512 bytes": (shell("ulimit -f 1"), {}),
    "a full disk": (within(FULL), {}),
    "no memfd_create, and a full TMPDIR": (lambda refusing: shell("export TMPDIR=/proc")(refusing) + call("memfd_create", 1)(refusing), {}),
    "no file in memory": (plain, lib("memfd")),
    "no memfd_create, no O_TMPFILE, no linkat": (call("memfd_create,nameless,linkat", 1), {}),
    "no sockets": (call("socketpair", 24), {}),
    "no sockets of its own": (plain, lib("socketpair")),
    "no pages to share": (plain, lib("mmap")),
    "no pages to share in a worker": (plain, lib("mmap", "worker")),
    "no streams of descriptors": (plain, lib("fdopen")),
    "no streams in memory": (plain, lib("memstream")),
    "no pipes": (plain, lib("pipe")),
    "no threads": (plain, lib("thread")),
    "no memory in a worker": (plain, lib("malloc", "worker")),
}
# Fields that differ between two runs.
TIMES = {"passport", "passport_text", "measured", "seconds", "created", "checksum", "seal", "date", "time_ms", "shapes", "host", "id", "notes"}


def settled(value):
    """A document without the parts that differ from run to run."""
    if isinstance(value, dict):
        return {name: settled(inner) for name, inner in value.items() if name not in TIMES}
    if isinstance(value, str):
        return re.sub(r", \d+ threads?$", "", value)  # a warning names the number of threads if some are missing
    return [settled(inner) for inner in value] if isinstance(value, list) else value


def told(text):
    try:
        return settled(json.loads(text))
    except ValueError:
        return re.sub(r"\d+(\.\d+)?(e[-+]\d+)? m?s\b", "", text)


class Trial:
    def __init__(self, runner, refusing, wanting, folder):
        self.runner, self.refusing, self.wanting, self.folder = runner, refusing, os.path.abspath(wanting), folder
        self.well, self.lacking = {}, 0  # each command's result when nothing is lacking; number of commands that lacked something
        for name in ("a.tif", "b.tif"):
            runner.run(("render raster --device cpu " + SMALL + "-o " + os.path.join(folder, name)).split())
        with open(os.path.join(folder, "cells.txt"), "w") as file:
            file.write("raster/torus raster 16x16 1 scene=mesh model=torus faces=300\n")

    def run(self, name, wrap, variables):
        """Exit status, the findings, stderr, and JUnit's report."""
        out = tempfile.mkdtemp(dir=self.folder)
        words = [word.replace("OUT", out).replace("IN/", self.folder + "/") for word in COMMANDS[name].split()]
        before = [word.replace("OUT", out) for word in wrap(self.refusing)]
        env = dict(self.runner.variables({}), **variables)
        if variables:
            before += ["env", "LD_PRELOAD=" + self.wanting]
        done = subprocess.run(before + [self.runner.raingauge] + words, env=env, timeout=300, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", errors="replace")
        files = {}
        for path, _, names in os.walk(out):
            for file in names:
                with open(os.path.join(path, file), "rb") as inner:
                    files[file] = inner.read()
        shutil.rmtree(out)
        report = files.pop("report.xml", b"").decode()
        found = [told(done.stdout.replace(out, "OUT")), sorted(files.items())]
        return done.returncode, found, done.stderr, report

    def problems(self, name, wrap, variables):
        """Problems of a command under a want; None if it cannot be tried."""
        if name not in self.well:
            self.well[name] = self.run(name, plain, {})
        if self.well[name][0]:
            return ["fails without a want: status %d, %s" % (self.well[name][0], self.well[name][2])]
        status, found, err, report = self.run(name, wrap, variables)
        if re.match("unshare: |sh: .*mount|mount: ", err) or status in (98, 99, 127):
            return None
        problems = []
        self.lacking += status == LACKING
        if status not in (0, LACKING):
            problems.append("status %d" % status)
        if status == 0 and found != self.well[name][1]:
            problems.append("another result")
        if status == LACKING and not err:
            problems.append("no line")
        if status == LACKING and BLAMES.search(err):
            problems.append("another is blamed")
        if re.search("<failure|<skipped", report):
            problems.append("a failure or a skip in JUnit's report")
        return problems and [", ".join(problems) + ": " + err[-600:]]


def run_wants(trial, wants, commands):
    for want in wants:
        problems, tried = [], 0
        for name in commands:
            found = trial.problems(name, *WANTS[want])
            tried += found is not None
            problems += ["%s: %s" % (name, line) for line in found or []]
        trial.runner.report("want of " + want + ("" if tried else " # SKIP"), problems)


def run_calls(trial, commands, numbers):
    """The Nth call for memory fails, in raingauge and then in its workers."""
    for name in commands:
        for of in ("harness", "worker"):
            problems, trial.lacking = [], 0
            for number in numbers:
                found = trial.problems(name, plain, lib("malloc", of, number))
                problems += ["call %d: %s" % (number, line) for line in found or []]
            if not trial.lacking:
                problems.append("no call failed")
            trial.runner.report("want of memory in %s, %s: %d of %d" % (name, of, trial.lacking, len(numbers)), problems)


def run(runner, refusing, wanting, wants, commands, of_calls, numbers):
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        trial = Trial(runner, refusing, wanting, folder)
        run_wants(trial, wants, commands)
        run_calls(trial, of_calls, numbers)


def run_some(runner, refusing, wanting):
    seed = int(os.environ.get("WANT_SEED", "44"))
    numbers = sorted(OPTIONS | set(random.Random(seed).sample(range(1, CALLS + 1), SAMPLE)))
    print("# calls %s, of seed %d" % (numbers, seed))
    run(runner, refusing, wanting, ["addresses, 200 MB", "6 descriptors", "processes, EAGAIN", "files of no size", "a full disk",
                                    "no pages to share", "no memory in a worker"], ["diff", "render"], ["diff", "stages", "gate", "table"], numbers)


def run_all(runner, refusing, wanting):
    run(runner, refusing, wanting, list(WANTS), list(COMMANDS), ["diff", "verify", "stages", "gate", "table"], range(1, CALLS + 1))
