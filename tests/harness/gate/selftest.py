#!/usr/bin/env python3
"""Tests the gate with real processes: identical builds must pass, and a planted slow-down of 5 % must be caught. Another process
keeps one core busy all the while.

selftest.py BUILD [--device D,...] [--same N] [--planted N] [--extra PERCENT] [--idle] [--keep DIR] [--traces FILE]

Runs `raingauge gate D D` until it has --same verdicts (300), over all built-in cells in turn, on the named devices. By default a
device has one thread, since with more a busy core keeps every frame waiting (docs/ci.md). Then it plants real work beside each
frame, --extra (5) percent of the frame's measured time, and runs the gate on that program (BUILD/tests/harness/gate/slower) until
it has --planted (59) verdicts. If frames have changed since, it sizes the work anew. --idle leaves the cores alone. --keep keeps
each run's findings in a folder, as the gate's JSON and its launches, so that an interrupted test goes on with the same build and
arguments. --traces writes all launches, for tests/harness/judge/traces.c to decide on again.

Prints both directions, the share left open, seconds a cell and the power at 2, 3 and 5 %. The exit status is 1 if more than one
of 300 identical pairs was told apart, or a planted change was missed.
"""
import argparse
import csv
import hashlib
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

MOST_WRONG_SHARE = 1 / 300
# The planted extra work is a share of frames timed earlier. MOST_OFF: largest relative change of frames since then;
# SIZINGS: how often the work is sized anew.
MOST_OFF, SIZINGS = 0.1, 3
# The process ends when its parent, the self-test, has ended for any reason.
BUSY = "import os\nwhose = os.getppid()\nwhile os.getppid() == whose: pass"


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--device", default="cpu@OMP_NUM_THREADS=1,gl@LP_NUM_THREADS=1,vulkan@LP_NUM_THREADS=1")
    parser.add_argument("--same", type=int, default=300)
    parser.add_argument("--planted", type=int, default=59)
    parser.add_argument("--extra", type=float, default=5)
    parser.add_argument("--idle", action="store_true")
    parser.add_argument("--keep")
    parser.add_argument("--traces")
    return parser.parse_args()


class Kept:
    """A folder of earlier runs' findings, by this very script with the same build and arguments. Runs found there are not repeated."""

    def __init__(self, folder, programs, asked):
        whose = {name: value for name, value in vars(asked).items() if name not in ("build", "keep", "traces")}
        whose["programs"] = [hashlib.sha256(pathlib.Path(program).read_bytes()).hexdigest() for program in programs]
        self.folder = pathlib.Path(folder, hashlib.sha256(json.dumps(whose, sort_keys=True).encode()).hexdigest()[:16])
        there = len(list(self.folder.glob("*/report.json")))
        if there:
            print("%s has %d runs of this build, which are not made again" % (self.folder, there), flush=True)

    def text(self, name, make):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            path.with_suffix(".tmp").write_text(make())
            path.with_suffix(".tmp").rename(path)
        return path.read_text()


class Gates:
    """Runs gates, and counts their verdicts."""

    def __init__(self, asked):
        self.build = pathlib.Path(asked.build).resolve()
        self.raingauge = str(self.build / "harness" / "raingauge")
        self.slower = str(self.build / "tests" / "harness" / "gate" / "slower" / "raingauge-slower")
        self.nowhere = tempfile.TemporaryDirectory()
        self.kept = Kept(asked.keep or self.nowhere.name, (self.raingauge, self.slower, __file__), asked)
        self.runs = 0
        self.traces = open(asked.traces, "w") if asked.traces else None

    def cells(self):
        """The lines of the built-in cells."""
        source = pathlib.Path(__file__).resolve().parents[3] / "harness" / "compare" / "gate" / "cells" / "cells.txt"
        return [line for line in source.read_text().splitlines() if line.strip() and not line.startswith("#")]

    def run(self, a, b, cells=None):
        """The cases of one gate, by their cells' names."""
        self.runs += 1
        run = "%03d" % self.runs
        report = json.loads(self.kept.text(run + "/report.json", lambda: self.gate(a, b, cells, self.kept.folder / run)))
        if self.traces:
            self.write_trace(a, b, report, self.kept.folder / run / "launches.csv")
        return {case["name"].split(".", 1)[0]: case for case in report["gated"]}

    def gate(self, a, b, cells, folder):
        """The report of a gate, which goes on from the launches in its folder."""
        command = [self.raingauge, "gate", a, b, "--json", "-o", str(folder)]
        if cells:
            path = folder / "cells.txt"
            path.write_text("\n".join(cells) + "\n")
            command += ["--cells", str(path)]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if not result.stdout:
            sys.exit("%s: exit status %d, %s" % (" ".join(command), result.returncode, result.stderr))
        return result.stdout

    def write_trace(self, a, b, report, path):
        """A line for the gate, and one for each of its cases."""
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        print("gate %s %s" % (a, "same" if a == b else "planted"), file=self.traces)
        for case in report["gated"]:
            logs = ["x" if row["disturbed"] == "1" else "%.6f" % float(row["log_ratio"]) for row in rows if row["case"] == case["name"]]
            print(case["name"].split(".", 1)[0], case["ending"], *logs, file=self.traces)

    def loop_ns(self):
        """Processor time of one loop of the extra work, in ns."""
        return float(self.kept.text("loop_ns", lambda: repr(self.measured_loop_ns())))

    def measured_loop_ns(self):
        loops = 400_000_000
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([str(self.build / "tests" / "harness" / "gate" / "slower" / "loops"), str(loops)], check=True)
        return (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before) * 1e9 / loops


class Tally:
    """Verdicts of one kind of run."""

    def __init__(self, name):
        self.name, self.cases = name, []

    def add(self, device, cases):
        for cell, case in cases.items():
            self.cases.append((device, case))
            print("%s  %-24s %-16s %-12s ratio %s  %.1f s" % (time.strftime("%H:%M:%S"), device, cell, case["ending"],
                                                             case["ratio"] and case["ratio"]["value"], case["seconds"]), flush=True)

    def count(self, ending):
        return sum(case["ending"] == ending for _, case in self.cases)

    def median(self, device, value):
        values = sorted(v for d, case in self.cases if d == device for v in [value(case)] if v is not None)
        return values[len(values) // 2] if values else float("nan")

    def tell(self):
        endings = sorted({case["ending"] for _, case in self.cases})
        print("%s: %d verdicts: %s" % (self.name, len(self.cases), ", ".join("%d %s" % (self.count(e), e) for e in endings)))
        for device in dict.fromkeys(d for d, _ in self.cases):
            mine = [case for d, case in self.cases if d == device]
            print("  %-24s %d verdicts, %.1f s a cell in median, %.1f in all; a launch scatters by %.1f %% in median; %d left open; ratio %.4f" % (
                device, len(mine), self.median(device, lambda c: c["seconds"]), sum(c["seconds"] for c in mine) / len(mine),
                self.median(device, scatter), sum(c["ending"] == "inconclusive" for c in mine),
                self.median(device, lambda c: c["ratio"]["value"])))
            print("           of changes it would have found, in mean: %s" % ", ".join(
                "%d %% with %.0f %%" % (change, sum(power(c, change) for c in mine) / len(mine)) for change in (2, 3, 5)))


def scatter(case):
    found = re.search(r"scatters by ([\d.]+) %", case["details"])
    return float(found[1]) if found else None


def power(case, change):
    found = re.search(r"\b%d %% with (\d+) %%" % change, case["details"])
    return float(found[1]) if found else 0.0


def plan(devices, count, cells):
    """Runs of all cells for each device: half of the verdicts are the first device's."""
    runs = -(-count // cells)
    others = max(1, runs // (2 * len(devices) - 2)) if len(devices) > 1 else 0
    return {device: runs - others * (len(devices) - 1) if i == 0 else others for i, device in enumerate(devices)}


def run_same(gates, devices, count, tally):
    for device, runs in plan(devices, count, len(gates.cells())).items():
        for _ in range(runs):
            tally.add(device, gates.run(device, device))


def frame_ms(same, device, cell):
    times = sorted(case["baseline_ms"] for d, case in same.cases if d == device and case["name"].startswith(cell + "."))
    return times[len(times) // 2]


def slower(gates, device, loops):
    return "%s%sRG_PROGRAM=%s;RG_EXTRA_LOOPS=%d" % (device, ";" if "@" in device else "@", gates.slower, loops)


def loop_ns(gates, device, line, frame):
    """Time of one loop of the extra work beside frames, in ns, by a gate on twice the work."""
    loops = round(frame * 1e6 / gates.loop_ns())
    case = gates.run(device, slower(gates, device, loops), [line])[line.split()[0]]
    return case["baseline_ms"] * 1e6 * (case["ratio"]["value"] - 1) / loops


def planted_case(gates, device, line, frame, extra, a_loop_ns):
    """A gate on a frame that takes `extra` percent longer. If the machine's speed has changed since frames were timed, the extra
    work is sized by this gate's frames and the gate runs again, whatever its verdict."""
    for _ in range(SIZINGS):
        loops = round(extra / 100 * frame * 1e6 / a_loop_ns)
        cases = gates.run(device, slower(gates, device, loops), [line])
        found = cases[line.split()[0]]["baseline_ms"]
        if not found or abs(frame / found - 1) <= MOST_OFF:
            break
        frame = found
    return cases


def run_planted(gates, devices, count, extra, same, tally):
    cells = gates.cells()
    for device, runs in plan(devices, count, len(cells)).items():
        a_loop_ns = loop_ns(gates, device, cells[0], frame_ms(same, device, cells[0].split()[0]))
        for _ in range(runs):
            for line in cells:
                frame = frame_ms(same, device, line.split()[0])
                tally.add(device, planted_case(gates, device, line, frame, extra, a_loop_ns))


def main():
    asked = options()
    gates, devices = Gates(asked), asked.device.split(",")
    same, planted = Tally("the same"), Tally("%g %% more" % asked.extra)
    busy = None if asked.idle else subprocess.Popen([sys.executable, "-c", BUSY])
    try:
        run_same(gates, devices, asked.same, same)
        run_planted(gates, devices, asked.planted, asked.extra, same, planted)
    finally:
        if busy:
            busy.kill()
    same.tell()
    planted.tell()
    wrong = same.count("regressed") + same.count("improved")
    bad = wrong > max(1, MOST_WRONG_SHARE * len(same.cases)) or planted.count("regressed") < len(planted.cases)
    bad = bad or any(case["ending"] not in ("pass", "inconclusive", "regressed", "improved") for _, case in same.cases)
    print("%s: %d of %d that are the same were told apart; %d of %d that were planted were found" % (
        "failed" if bad else "passed", wrong, len(same.cases), planted.count("regressed"), len(planted.cases)))
    return int(bad)


if __name__ == "__main__":
    os.environ.setdefault("GOMP_SPINCOUNT", "8000")
    sys.exit(main())
