"""A run that is killed while it measures, or meets a second one, loses nothing that was measured before."""
import fcntl
import itertools
import json
import os
import re
import resource
import shutil
import signal
import tempfile
import time

import misbehaving

# After the first table, its whole result is in its journal while the second is measured.
FIRST, SECOND, ROWS = "stuppacher-2", "chin-grid", 2
TABLES = "table %s %s --quick --device cpu --work paper --rows 1-%d -o " % (FIRST, SECOND, ROWS)
JOURNAL = FIRST + "-quick.journal"
LIMIT_S = 60  # for work that takes a second


def wait_for(condition):
    """Whether a condition holds within the limit."""
    end = time.monotonic() + LIMIT_S
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    return bool(condition())


def workers_of(pid):
    """The processes that a process has started."""
    with open("/proc/%d/task/%d/children" % (pid, pid)) as file:
        return [int(word) for word in file.read().split()]


def runs(pid):
    """Whether a process exists that has not ended."""
    try:
        with open("/proc/%d/stat" % pid) as file:
            return file.read().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def rows_of(path):
    """Rows and their measurements, as text, of a result or journal, without the cells' checksums."""
    with open(path) as file:
        report = json.load(file)
    cells = {}
    for cell in report["cells"]:
        cell.pop("checksum", None)
        cells.setdefault(json.dumps(cell["row"]), []).append(json.dumps(cell, sort_keys=True))
    return cells


def begin(runner, out):
    """A run with the first table in its journal, and its workers."""
    process = runner.start((TABLES + out).split())
    path = os.path.join(out, JOURNAL)
    wait_for(lambda: os.path.exists(path) or process.poll() is not None)
    return process, workers_of(process.pid) if process.poll() is None else []


def goes_on(runner, out, held):
    """Problems of a run that follows one that left the rows `held`."""
    result = runner.run((TABLES + out).split())
    said = re.fullmatch(r"raingauge: %s: (\d) of %d rows are those of a run that was interrupted, .*\n" % (FIRST, ROWS), result.stderr)
    if result.returncode or not said or int(said.group(1)) != len(held):
        return ["again: exit status %d, %d rows held, %s" % (result.returncode, len(held), result.stderr)]
    rows, others = (rows_of(os.path.join(out, table + ".json")) for table in (FIRST, SECOND))
    problems = [] if len(rows) == len(others) == ROWS else ["%d and %d rows in the end" % (len(rows), len(others))]
    problems += ["row %s is another" % row for row in held if rows.get(row) != held[row]]
    left = sorted(os.listdir(out))
    if left != sorted(table + "." + form for table in (FIRST, SECOND) for form in ("csv", "json", "md", "tex")):
        problems.append("left: %s" % left)
    return problems


def killed(runner, kills_worker):
    """Problems after SIGKILL of the harness, and before it perhaps of cpu's worker."""
    with tempfile.TemporaryDirectory() as out:
        process, workers = begin(runner, out)
        if not workers:
            return ["no worker: %s" % (process.communicate(),)]
        for pid in workers[:1] * kills_worker:
            os.kill(pid, signal.SIGKILL)
        process.kill()
        process.communicate(timeout=LIMIT_S)
        problems = [] if wait_for(lambda: not any(map(runs, workers))) else ["a worker is left"]
        return problems + goes_on(runner, out, rows_of(os.path.join(out, JOURNAL)))


def check_harness_killed(runner):
    """a harness that is killed loses no whole row and leaves no worker, and the same command goes on"""
    return killed(runner, False)


def check_both_killed(runner):
    """no row is lost if both are killed"""
    return killed(runner, True)


def check_fallen(runner):
    """a driver that crashes while it is opened does not make the command begin anew the journal of another choice of devices"""
    with tempfile.TemporaryDirectory() as out, tempfile.TemporaryDirectory() as folder:
        process, _ = begin(runner, out)
        process.kill()
        process.communicate(timeout=LIMIT_S)
        with open(os.path.join(out, JOURNAL)) as file:
            before = file.read()
        env = misbehaving.shim(runner, folder, "vulkan", "vkCreateDevice", "fault", 0)
        result = runner.run((TABLES.replace("--device cpu", "--device all") + out).split(), env)
        with open(os.path.join(out, JOURNAL)) as file:
            stays = file.read() == before
        if result.returncode != 1 or result.stdout or not stays or "%s: a driver fell while its device was opened" % FIRST not in result.stderr:
            return ["exit status %d, stays %s, %s" % (result.returncode, stays, result.stderr)]
        return goes_on(runner, out, rows_of(os.path.join(out, JOURNAL)))


def check_second(runner):
    """a second run into a folder is refused, and the first loses nothing"""
    problems = []
    with tempfile.TemporaryDirectory() as out:
        first, _ = begin(runner, out)
        os.kill(first.pid, signal.SIGSTOP)  # it exists while the second run takes place
        with open(os.path.join(out, JOURNAL)) as file:
            before = file.read()
        second = runner.run((TABLES + out).split())
        with open(os.path.join(out, JOURNAL)) as file:
            same = file.read() == before
        os.kill(first.pid, signal.SIGCONT)
        _, messages = first.communicate(timeout=LIMIT_S)
        if second.returncode != 2 or second.stdout or not same or not re.fullmatch(
                r"raingauge: .*: another raingauge measures into it; wait until it has ended, or name another folder\n", second.stderr):
            problems.append("second: exit status %d, %s%s" % (second.returncode, second.stdout, second.stderr))
        if first.returncode or runner.rest_of(messages) or any(len(rows_of(os.path.join(out, table + ".json"))) != ROWS for table in (FIRST, SECOND)):
            problems.append("first: exit status %d, %s" % (first.returncode, messages))
        third = runner.run((TABLES + out).split())
        if third.returncode or third.stderr:
            problems.append("third: exit status %d, %s" % (third.returncode, third.stderr))
    return problems


def check_held(runner):
    """if another run holds the folder of the user's state, a run reads and keeps no rows, and says so; otherwise it reads them"""
    problems = []
    with tempfile.TemporaryDirectory() as state:
        os.mkdir(state + "/raingauge")
        with open(state + "/raingauge/stuppacher-2-quick.journal", "w") as file:
            file.write("no journal")  # reading it would cause a message
        folder = os.open(state + "/raingauge", os.O_RDONLY)
        fcntl.flock(folder, fcntl.LOCK_EX)
        for says in (r"raingauge: .*/raingauge: another raingauge that measures keeps its rows there; this one keeps none: .*\n",
                     r"raingauge: .*stuppacher-2-quick\.journal: line 1 is no JSON: .*; remove it; the table begins anew\n"):
            result = runner.run(ROW.split(), {"XDG_STATE_HOME": state})
            if result.returncode or not re.fullmatch(says, result.stderr):
                problems.append("exit status %d, %s" % (result.returncode, result.stderr))
            fcntl.flock(folder, fcntl.LOCK_UN)
        os.close(folder)
    return problems


def lost_midway(runner, lose, restore):
    """Problems if results can no longer be written after the first table, and the command is given again later."""
    with tempfile.TemporaryDirectory() as out:
        process = runner.start((TABLES + out).split(), obeys_modes=True)
        path, last = (os.path.join(out, name) for name in (JOURNAL, FIRST + ".tex"))
        wait_for(lambda: os.path.exists(last) or process.poll() is not None)
        if process.poll() is not None:
            return ["ended before: %s" % (process.communicate(),)]
        held = rows_of(path)
        lose(process, out)
        _, messages = process.communicate(timeout=LIMIT_S)
        restore(out)
        told = (r"(raingauge: .*%s.*: cannot be written: .*\n){1,2}"
                r"raingauge: once all can be written, the same command goes on with what was measured\n" % SECOND)
        problems = []
        if process.returncode not in (2, 71) or not re.fullmatch(told, messages):
            problems.append("exit status %d, %s" % (process.returncode, messages))
        left = sorted(os.listdir(out))
        if left != [JOURNAL] + [FIRST + form for form in (".csv", ".json", ".md", ".tex")] or rows_of(path) != held:
            return problems + ["left: %s" % left]
        return problems + goes_on(runner, out, held)


def check_full(runner):
    """if the disk fills in mid-run, the journal stays unchanged, a line says so, and the same command goes on"""
    return lost_midway(runner, lambda process, out: resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (2000, 2000)),
                       lambda out: None)


def check_read_only_midway(runner):
    """nothing is lost if the folder becomes read-only in mid-run"""
    return lost_midway(runner, lambda process, out: os.chmod(out, 0o500), lambda out: os.chmod(out, 0o700))


ROW = "table %s --rows 1-1 --work paper --device cpu " % FIRST


def check_unprinted(runner):
    """results that cannot be printed are kept, the last table's too, and the same command goes on with them"""
    problems = []
    told = (r"raingauge: standard output: cannot be written; .*\n"
            r"raingauge: once all can be written, the same command goes on with what was measured\n")
    again = r"raingauge: %s: 1 of 1 rows are those of a run that was interrupted, .*\n"
    for tables, more in (([FIRST], ""), ([FIRST, SECOND], ""), ([FIRST], "--claims"), ([FIRST, SECOND], "--claims --wide")):
        with tempfile.TemporaryDirectory() as state:
            args = ROW.replace(FIRST, " ".join(tables)).split() + more.split()
            with open("/dev/full", "w") as full:
                lost = runner.run(args, {"XDG_STATE_HOME": state}, stdout=full)
            held = sorted(os.listdir(state + "/raingauge"))
            if lost.returncode != 71 or not re.fullmatch(told, lost.stderr) or held != sorted(t + "-quick.journal" for t in tables):
                problems.append("exit status %d, held %s, %s" % (lost.returncode, held, lost.stderr))
            found = runner.run(args, {"XDG_STATE_HOME": state})
            if found.returncode or not found.stdout or not re.fullmatch("".join(again % t for t in tables), found.stderr) or \
                    os.listdir(state + "/raingauge"):
                problems.append("again: exit status %d, %s" % (found.returncode, found.stderr))
    return problems


def check_sweep_unprinted(runner):
    """a sweep that could not be printed goes on with its rows, unless its axes differ or it has --fresh"""
    problems = []
    sweep = "sweep flow --axis resolution_px=%s --set environment=sky --set environment_px=16 --size 32x32 --device cpu --quick --wide"
    resumed = "2 of 2 rows are those of a run that was interrupted"
    with tempfile.TemporaryDirectory() as tmp:
        with open("/dev/full", "w") as full:
            lost = runner.run((sweep % "32,64").split(), {"XDG_STATE_HOME": tmp + "/lost"}, stdout=full)
        if lost.returncode != 71 or "the same command goes on" not in lost.stderr:
            problems.append("exit status %d, %s" % (lost.returncode, lost.stderr))
        for axes, more, goes_on in (("32,64", "", True), ("32,48", "", False), ("32,64", " --fresh", False), ("32,64", " --frame 3", False)):
            state = tmp + "/" + axes + more
            shutil.copytree(tmp + "/lost", state)
            again = runner.run((sweep % axes + more).split(), {"XDG_STATE_HOME": state})
            left = os.listdir(state + "/raingauge")
            if again.returncode or (resumed in again.stderr) != goes_on or (goes_on and left) or not re.search("combination of resolution_px=" + axes, again.stdout):
                problems.append("%s%s: exit status %d, left %s, %s%s" % (axes, more, again.returncode, left, again.stderr, again.stdout))
    return problems


def check_unread(runner):
    """a table's files are complete though nobody reads its output, which ends it"""
    with tempfile.TemporaryDirectory() as out:
        ours, its = os.pipe()
        os.close(ours)
        done = runner.run(ROW.split() + ["-o", out], stdout=its)
        os.close(its)
        left = sorted(os.listdir(out))
    if done.returncode != -signal.SIGPIPE or left != [FIRST + form for form in (".csv", ".json", ".md", ".tex")]:
        return ["exit status %d, left %s, %s" % (done.returncode, left, done.stderr)]
    return []


def check_read_only(runner):
    """a folder that is read-only is refused before anything is measured"""
    with tempfile.TemporaryDirectory() as out:
        os.chmod(out, 0o500)
        result = runner.run((TABLES + out).split(), obeys_modes=True)
        if result.returncode != 2 or result.stdout or not re.fullmatch(r"raingauge: .*ermission denied.*\n", result.stderr):
            return ["exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]
    return []


def check_earlier(runner):
    """a clock that is set back changes nothing: later measurements are taken up, and durations are right"""
    with tempfile.TemporaryDirectory() as out:
        process, workers = begin(runner, out)
        if not workers:
            return ["no worker: %s" % (process.communicate(),)]
        process.kill()
        process.communicate(timeout=LIMIT_S)
        path = os.path.join(out, JOURNAL)
        os.utime(path, (time.time() + 1e8, time.time() + 1e8))
        problems = goes_on(runner, out, rows_of(path))
        result = runner.run((TABLES + out + " --fresh").split(),
                            {"LD_PRELOAD": runner.earlier, "EARLIER_BY_S": "3600", "EARLIER_EVERY": "7"})
        samples = [sample for table in (FIRST, SECOND) for cells in rows_of(os.path.join(out, table + ".json")).values()
                   for cell in cells for sample in json.loads(cell)["measured"]["samples_ms"]]
        if result.returncode or result.stderr or len(samples) < 6 * 2 * ROWS or not all(0 < ms < 1e5 for ms in samples):
            problems.append("set back: exit status %d, %s, %s" % (result.returncode, result.stderr, samples))
    return problems


# Commands that write files and run for longer than a test waits.
WRITING = {
    "render": "render flow --frame 100000 -o {}/a.png",
    "pictures": "render flow --frames 0-100000 --size 64x64 -o {}/%d.png",
    "clip": "render flow --frames 0-100000 --size 64x64 -o {}/a.webm",
    "diff": "diff flow --device cpu,cpu:reference --frame 100000 -o {}/heat",
    "table": "table chin-grid --quick --device cpu -o {}/table",
    "sweep": "sweep flow --axis seed=1,2..9 --size 64x64 --device cpu -o {}/sweep",
    "figures": "figures creus-4.1 -o {}/figures",
    "atlas": "atlas cartoon -o {}/atlas",
    "baseline": "baseline --device cpu -o {}/baseline.json",
    "gate": "gate cpu cpu:reference --junit {0}/junit.xml --bmf {0}/bmf.json",
    "shrink": "shrink flow --device cpu,cpu:reference --frame 1000 -o {}/case.txt",
}
AT_WORK_S = 0.4
AWAY = "raingauge: what it was at did not stop within a second, and is not waited for\n"


def check_signals(runner):
    """SIGINT, SIGTERM and SIGHUP leave no temporary file and no folder of any command, and no worker"""
    problems = []
    for (name, command), number in itertools.product(WRITING.items(), (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)):
        with tempfile.TemporaryDirectory() as out, tempfile.TemporaryDirectory() as tried:
            process = runner.start(command.format(out).split(), {"XDG_STATE_HOME": out, "TMPDIR": tried})
            time.sleep(AT_WORK_S)
            workers = workers_of(process.pid) if process.poll() is None else []
            process.send_signal(number)
            _, messages = process.communicate(timeout=LIMIT_S)
            left = [file for _, _, files in os.walk(out) for file in files if file.startswith(".") or ".tmp" in file]
            left += os.listdir(tried)
            if left or not wait_for(lambda: not any(map(runs, workers))):
                problems.append("%s, %s: %s" % (name, number.name, left or "a worker is left"))
            wanted = (0, 1, 128 + number, -number) if name != "shrink" else (128 + number, -number)
            if process.returncode not in wanted or (name == "shrink" and messages not in ("", AWAY)):
                problems.append("%s, %s: exit status %d, %s" % (name, number.name, process.returncode, messages))
    return problems


def check_signal_at_hang(runner):
    """SIGINT ends a command whose driver hangs, long before --timeout"""
    problems = []
    for command, said in (("diff flow --size 64x64 --frame 1", ""), ("table raster-1 --rows 2-2 --quick -o {}/tables", AWAY)):
        with tempfile.TemporaryDirectory() as out:
            env = dict(misbehaving.shim(runner, out, "vulkan", "vkCreateComputePipelines", "hang", 1), XDG_STATE_HOME=out, RG_HANGS=os.path.join(out, "hangs"))
            process = runner.start(command.format(out).split() + ["--device", "cpu,vulkan", "--timeout", "86400"], env)
            wait_for(lambda: os.path.exists(env["RG_HANGS"]) or process.poll() is not None)
            workers = workers_of(process.pid)
            process.send_signal(signal.SIGINT)
            _, messages = process.communicate(timeout=LIMIT_S)
            if process.returncode != -signal.SIGINT or messages != said:
                problems.append("%s: exit status %d, %s" % (command, process.returncode, messages))
            left = [file for _, _, files in os.walk(out) for file in files if ".tmp" in file]
            if left or not wait_for(lambda: not any(map(runs, workers))):
                problems.append("%s: %s" % (command, left or "a worker is left"))
    return problems


def check_nothing_measured(runner):
    """a table without a measured cell replaces no measured one"""
    command = ["table", "raster-1", "--rows", "2-2", "--quick", "--device", "cpu", "-o"]
    with tempfile.TemporaryDirectory() as out:
        first = runner.run(command + [out])
        whole = {name: open(os.path.join(out, name)).read() for name in os.listdir(out)}
        again = runner.run(command + [out, "--memory", "1M"])
        after = {name: open(os.path.join(out, name)).read() for name in os.listdir(out)}
        fresh = runner.run(command + [os.path.join(out, "new"), "--memory", "1M"])
        told = os.path.exists(os.path.join(out, "new", "raster-1.json"))
    problems = [] if first.returncode == 0 and len(whole) == 4 else ["first: exit status %d, %s" % (first.returncode, first.stderr)]
    if again.returncode != 1 or after != whole or "is kept, for no cell of raster-1 was measured now" not in again.stderr:
        problems.append("again: exit status %d, %s, %s" % (again.returncode, after == whole, again.stderr))
    return problems if fresh.returncode == 1 and told else problems + ["fresh: exit status %d, %s" % (fresh.returncode, fresh.stderr)]


CHECKS = [check_nothing_measured, check_signals, check_signal_at_hang, check_harness_killed, check_both_killed, check_fallen, check_second, check_held, check_full,
          check_read_only_midway, check_read_only, check_unprinted, check_sweep_unprinted, check_unread, check_earlier]
