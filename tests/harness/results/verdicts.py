#!/usr/bin/env python3
"""Verdicts on launches with a known truth: writes results as raingauge stores them, and lets `raingauge table` judge them.

    verdicts.py RAINGAUGE    the results are made after results/tables of the source

Times scatter like those of machines: most are a little longer than the shortest, and a few much longer. A verdict is wrong if it
says the opposite of the truth. launching/courses.c counts wrong verdicts by the ten thousand; this script checks that all of it
reaches the command line. Prints TAP.
"""
import copy
import csv
import io
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

KEPT = pathlib.Path(__file__).resolve().parents[3] / "results" / "tables"
FILES, DEVICES = 1, 20  # a file per command, a device per trial
TRIALS = FILES * DEVICES
MOST_WRONG = 0.05 * TRIALS
LAUNCHES = 192
YES, NO, OPEN, BOUND = "reproduced", "not reproduced", "undecided", "at the bound"


class Made:
    """A table's results on made-up devices, with every row at the given times, and the verdicts on them."""

    def __init__(self, raingauge, table):
        self.raingauge, self.table = raingauge, table
        self.record = json.loads((KEPT / (table + ".json")).read_text(encoding="utf-8"))
        self.record["works"] = [work for work in self.record.get("works", []) if work["name"] == "paper"]
        if not self.record["works"]:
            del self.record["works"]
        cells = [cell for cell in self.record["cells"] if cell.get("work", "paper") == "paper" and cell["device"] == "cpu"]
        device = next(one for one in self.record["passport"]["devices"] if one["name"] == "cpu")
        names = ["cpu:%d" % i for i in range(DEVICES)]
        self.record["passport"]["devices"] = [dict(device, name=name) for name in names]
        self.record["cells"] = [dict(copy.deepcopy(cell), device=name) for cell in cells for name in names]
        for cell in self.record["cells"]:  # with the printed number of particles
            del cell["checksum"]
            if "particles" in cell["published"]:
                cell["facts"]["particles"] = cell["published"]["particles"]

    def extend(self, rows):
        """Adds rows up to this number, as copies of the last measured one."""
        last = max(cell["row_number"] for cell in self.record["cells"])
        self.record["cells"] += [dict(copy.deepcopy(cell), row_number=row) for row in range(last + 1, rows + 1)
                                 for cell in self.record["cells"] if cell["row_number"] == last]
        self.record["rows"] = [1, rows]

    def times(self, ms_of, noise, samples, seed):
        """Sets samples about the median `ms_of(row, variant)`."""
        chance = random.Random(seed)
        middle = math.log(2)  # median of the exponential noise
        for cell in self.record["cells"]:
            ms = ms_of(cell["row_number"], cell["variant"])
            # Some are five times as far from the median, on the same side, so that the median stays.
            offs = [noise * (chance.expovariate(1) - middle) * (5 if chance.random() < 0.05 else 1) for _ in range(samples + LAUNCHES)]
            cell["measured"]["samples_ms"] = [ms * math.exp(off) for off in offs[:samples]]
            cell["measured"].pop("taken", None)  # of the samples that were there
            cell["measured"]["launches"] = [[i + 1, ms * math.exp(off), 0, 0, 0.5] for i, off in enumerate(offs[samples:])]

    def errors(self, error_of):
        for cell in self.record["cells"]:
            cell["error"]["flip_mask_mean"] = error_of(cell["row_number"])

    def run(self, *args):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / (self.table + ".json")
            path.write_text(json.dumps(self.record), encoding="utf-8")
            done = subprocess.run([self.raingauge, "table", "--from", str(path)] + list(args), encoding="utf-8",
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode or done.stderr:
            raise RuntimeError(done.stderr)
        return done.stdout

    def verdicts(self, words):
        """The verdicts on the claim that begins with these words, by device."""
        for row in csv.DictReader(io.StringIO(self.run("--claims", "--format", "csv"))):
            if row["claim"].strip('"').startswith(words):
                return list(row.values())[3:]
        raise RuntimeError("no claim '%s'" % words)

    def count(self, words, ms_of, noise, samples=15, files=FILES):
        """Counts each verdict."""
        told = []
        for seed in range(files):
            self.times(ms_of, noise, samples, "%s %s %d" % (words, noise, seed))
            told += self.verdicts(words)
        return {verdict: told.count(verdict) for verdict in (YES, NO, OPEN, BOUND)}


def settled(counts, verdict):
    """Problems if a truth that noise does not hide is not found nearly always."""
    return [] if counts[verdict] >= TRIALS - MOST_WRONG else ["settled, of %d due %s: %s" % (TRIALS, verdict, counts)]


def hidden(counts, wrong):
    """Problems if noise hides the truth, and more than one verdict of 200 is wrong."""
    return [] if sum(counts[verdict] for verdict in wrong) <= TRIALS / 200 else ["hidden, of %d wrong are %s: %s" % (TRIALS, wrong, counts)]


def at_bound(counts):
    """Problems if the truth is the bound itself, and nearly all verdicts do not say so."""
    return [] if counts[BOUND] >= TRIALS - MOST_WRONG else ["at the bound, of %d: %s" % (TRIALS, counts)]


def by_row(ms):
    return lambda row, variant: ms[row - 1]


FALLING, TURNED, LEVEL = [10, 11, 12.1, 13.3, 14.6], [10, 12, 10, 13.3, 14.6], [10, 10, 10, 10, 10]


def check_falls(raingauge):
    """rows that get slower confirm the claim, rows of which one does not refute it, and noise leaves it open"""
    made, words = Made(raingauge, "feng-2"), "varies with ... system"
    return (settled(made.count(words, by_row(FALLING), 0.02), YES) + settled(made.count(words, by_row(TURNED), 0.02), NO) +
            hidden(made.count(words, by_row(FALLING), 0.5), [NO]) + hidden(made.count(words, by_row(TURNED), 1), [YES]) +
            settled(made.count(words, by_row(LEVEL), 0.02), NO))


def check_order(raingauge):
    """rows in the order of print confirm the claim, others refute it, and noise leaves it open; rows equal in print have no order"""
    made, words = Made(raingauge, "stuppacher-1"), "rates by model"
    ordered, turned = [10, 13, 13.1, 12.5, 11], [10, 13, 13.1, 12.5, 9]  # print has Buddha and the dragon equal
    return (settled(made.count(words, by_row(ordered), 0.005), YES) + settled(made.count(words, by_row(turned), 0.02), NO) +
            hidden(made.count(words, by_row(ordered), 0.5), [NO]) + hidden(made.count(words, by_row(turned), 1), [YES]) +
            at_bound(made.count(words, by_row(LEVEL), 0.02)))


def check_ratio(raingauge):
    """a ratio that is above the claimed one, below it, or equal to it"""
    made, words = Made(raingauge, "feng-2"), "20,000 drops"
    of = lambda ratio: by_row([10, 15, 20, 30, 10 * ratio])
    return (settled(made.count(words, of(3.8), 0.02), YES) + settled(made.count(words, of(3.2), 0.02), NO) +
            hidden(made.count(words, of(3.8), 0.5), [NO]) + hidden(made.count(words, of(3.2), 0.5), [YES]) +
            at_bound(made.count(words, of(3.5), 0.02)))


def check_rate(raingauge):
    """a frame rate that is above the claimed one, below it, or equal to it"""
    made, words = Made(raingauge, "chin-timing"), "The simulation runs"
    of = lambda fps: lambda row, variant: 1000 / fps
    return (settled(made.count(words, of(32), 0.02), YES) + settled(made.count(words, of(28), 0.02), NO) +
            hidden(made.count(words, of(30.3), 0.5), [NO]) + hidden(made.count(words, of(29.7), 0.5), [YES]) +
            at_bound(made.count(words, of(30), 0.02)))


def check_size(raingauge):
    """a frame rate of smaller pictures confirms no claim about whole ones, and comparisons of rows are judged at any size"""
    rate, ratio = Made(raingauge, "chin-timing"), Made(raingauge, "feng-2")
    problems = []
    for divisor, told in ((1, {YES}), (2, {"other work"}), (4, {"other work"})):
        budget = {"seconds": 240, "size_divisor": divisor, "few_samples": False, "left_out": []}
        rate.record["budget"] = ratio.record["budget"] = budget
        rate.times(lambda row, variant: 1, 0.01, 15, "size")
        ratio.times(by_row([10, 15, 20, 30, 43]), 0.01, 15, "size")
        if set(rate.verdicts("The simulation runs")) != told or set(ratio.verdicts("20,000 drops")) != {YES}:
            problems.append("a divisor of %d: %s" % (divisor, set(rate.verdicts("The simulation runs"))))
    return problems


def check_variants(raingauge):
    """one variant a fifth faster in all rows, one that is not in the last row, and one exactly at the bound; missing rows confirm nothing"""
    made, words = Made(raingauge, "ye-1"), "generated much faster"
    of = lambda last: lambda row, variant: 10 if variant == "heap" else 7.75 if row < 2 else last
    level = lambda row, variant: 10 if variant == "heap" else 10 / 1.2
    some = made.count(words, of(7.75), 0.02)
    missing = ["two of five rows: %s" % some] if any(some.values()) else []  # not all rows are there
    made.extend(5)
    return (missing + settled(made.count(words, of(7.75), 0.02), YES) + settled(made.count(words, of(8.92), 0.02), NO) +
            hidden(made.count(words, of(7.75), 0.5), [NO]) + hidden(made.count(words, of(8.92), 0.7), [YES]) +
            at_bound(made.count(words, level, 0.02)))


def check_crossing(raingauge):
    """one variant that is faster from a row on and slower before it, one that is slower in the first or last of these rows, and equal ones"""
    made, words = Made(raingauge, "creus-5.6"), "with geometry faster"
    of = lambda first, last: lambda row, variant: 10 if variant == "no_geometry" else {4: first, 5: 9.3, 6: last}.get(row, 10.7)
    level = lambda row, variant: 10
    return (settled(made.count(words, of(9.3, 9.3), 0.02), YES) + settled(made.count(words, of(9.3, 10.7), 0.02), NO) +
            settled(made.count(words, of(10.7, 9.3), 0.02), NO) + hidden(made.count(words, of(9.3, 9.3), 0.5), [NO]) +
            at_bound(made.count(words, level, 0.02)))


def check_slowest(raingauge):
    """a row that is slower than all others, one with a slower row beside it, and equal rows"""
    made, words = Made(raingauge, "creus-5.5"), "the first row"
    of = lambda first: lambda row, variant: {1: first, 4: 10.7}.get(row, 10)
    level = lambda row, variant: 10
    return (settled(made.count(words, of(11.5), 0.02), YES) + settled(made.count(words, of(10), 0.02), NO) +
            hidden(made.count(words, of(11.5), 0.5), [NO]) + at_bound(made.count(words, level, 0.02)))


def check_optimum(raingauge):
    """a row that is faster than all others, one with a faster row beside it, and equal rows"""
    made, words = Made(raingauge, "creus-5.5"), "packets of 1,000"
    of = lambda third: lambda row, variant: {2: 9.3, 3: third}.get(row, 10)
    level = lambda row, variant: 10
    return (settled(made.count(words, of(10), 0.02), YES) + settled(made.count(words, of(8.6), 0.02), NO) +
            hidden(made.count(words, of(10), 0.5), [NO]) + at_bound(made.count(words, level, 0.02)))


def check_knee(raingauge):
    """an error that falls up to 20 m and is flat from there confirms the best compromise there, and a straight line refutes it"""
    made, words = Made(raingauge, "creus-5.4"), "20 meters come"
    told = []
    for error_of in (lambda row: 0.1 + 0.5 * math.exp(-row), lambda row: 0.5 - 0.05 * row):
        made.errors(error_of)
        told.append(set(made.verdicts(words)))
    return [] if told == [{YES}, {NO}] else ["a knee, and a line: %s" % told]


def check_few(raingauge):
    """five samples a row print no interval, if there are no launches; without launches there is no verdict, whatever the samples show; eleven launches leave it open"""
    made = Made(raingauge, "feng-2")
    problems = []
    for samples in (5, 15):
        made.times(by_row(FALLING), 1e-3, samples, "few")
        for cell in made.record["cells"]:
            del cell["measured"]["launches"]
        intervals = {row["ms, 95 %"] != "" for row in csv.DictReader(io.StringIO(made.run("--format", "csv")))}
        if intervals != {samples > 5}:
            problems.append("%d samples, intervals: %s" % (samples, intervals))
    for launches, due in ((0, "one launch: fits"), (11, OPEN), (24, YES)):
        made.times(by_row(FALLING), 1e-3, 15, "few")
        for cell in made.record["cells"]:
            cell["measured"]["launches"] = cell["measured"]["launches"][:launches]
            if not launches:
                del cell["measured"]["launches"]
        told = made.verdicts("varies with ... system")
        if told.count(due) < DEVICES / 2 or (due != YES and told.count(due) < DEVICES):
            problems.append("%d launches: %s" % (launches, told))
    return problems


def shapes(made, ms_of, noise, samples=15):
    found = []
    for seed in range(FILES):
        made.times(ms_of, noise, samples, "shape %s %d" % (noise, seed))
        found += json.loads(made.run("--json"))["shapes"]
    return found


def check_slope(raingauge):
    """a slope's interval holds the truth, and a shape is print's if the slope is, however few samples settle it"""
    made = Made(raingauge, "feng-2")
    axis, printed = [6000, 8000, 10000, 15000, 20000], [45.96, 39.44, 33.41, 22.09, 11.33]
    as_printed = by_row([1000 / fps for fps in printed])
    problems = []
    for power in (-0.5, -1.5):
        for noise, samples in ((0.05, 6), (0.05, 15), (0.3, 15)):
            found = shapes(made, by_row([10 * (x / 6000) ** -power for x in axis]), noise, samples)
            held = sum(shape["slope_low"] <= power <= shape["slope_high"] for shape in found)
            if held < TRIALS - MOST_WRONG or any(shape["verdict"] == YES for shape in found):
                problems.append("%g, %d samples of scatter %g: %d of %d hold it" % (power, samples, noise, held, TRIALS))
    told = [shape["verdict"] for shape in shapes(made, as_printed, 0.01)]
    if told.count(YES) < TRIALS - MOST_WRONG:
        problems.append("as printed: %d of %d" % (told.count(YES), TRIALS))
    told = [shape["verdict"] for shape in shapes(made, as_printed, 1)]
    if told.count(NO) > MOST_WRONG or told.count(OPEN) <= TRIALS / 2:
        problems.append("hidden by noise: %s" % {verdict: told.count(verdict) for verdict in set(told)})
    return problems


CHECKS = (check_falls, check_order, check_ratio, check_rate, check_size, check_variants, check_crossing, check_slowest, check_optimum, check_knee, check_few, check_slope)


def main(raingauge):
    failed = 0
    print("1..%d" % len(CHECKS))
    for number, check in enumerate(CHECKS, 1):
        problems = check(raingauge)
        failed += bool(problems)
        print("%s %d - %s" % ("not ok" if problems else "ok", number, check.__doc__))
        for problem in problems:
            print("# " + problem, flush=True)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
