#!/usr/bin/env python3
"""Holds a plan's expected times against real ones: expected.py RAINGAUGE [TABLE...] [--device D,...] [--shards N] [--folder DIR].

Plans the quick tables, all without names, by the records of results/tables, and measures all shards one after the other, alone on this machine.
Fails if the groups take more than 25 % longer or shorter in all than the plan says, or if the longest shard takes more than 1.3 times the mean and
more than the largest group. Prints a line for each shard and table, and the groups that are farthest off. With --folder DIR plan and records stay
there, and the same command goes on after an interruption; --plan alone prints how long it will take. It ends with 75 if the machine is busy.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
MOST_OFF, MOST_UNEVEN, WORST = 0.25, 1.3, 10


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def groups_of(plan):
    """The groups of a plan's document, with the seconds that each is expected to take."""
    return [{"id": group["id"], "seconds": sum(cell["seconds"] for cell in group["cells"])} for group in plan["groups"]]


def shards_of(groups, count):
    """The ids of each shard's groups: the longest group first, each to the shard that has least, as raingauge cuts."""
    taken, shards = [0.0] * count, [[] for _ in range(count)]
    for group in sorted(groups, key=lambda group: -group["seconds"]):
        least = taken.index(min(taken))
        taken[least] += group["seconds"]
        shards[least].append(group["id"])
    return shards


def judge(groups, real, count):
    """Problems of a plan's groups, of which `real` has the seconds that each took, by its id."""
    expected = {group["id"]: group["seconds"] for group in groups}
    problems = ["%s was not measured" % name for name in expected if name not in real]
    if problems:
        return problems
    off = sum(real.values()) / sum(expected.values()) - 1
    if abs(off) > MOST_OFF:
        problems.append("all groups took %+.0f %% of the expected time, of which %.0f %% are allowed" % (100 * off, 100 * MOST_OFF))
    shards = [sum(real[name] for name in shard) for shard in shards_of(groups, count)]
    mean, longest, largest = sum(shards) / count, max(shards), max(real.values())
    if longest > MOST_UNEVEN * mean and longest > largest * (1 + 1e-9):
        problems.append("the longest shard took %.2f times the mean, of which %.1f are allowed, and the largest group %.2f times" % (
            longest / mean, MOST_UNEVEN, largest / mean))
    return problems


def tell(groups, real, walls, count):
    expected = {group["id"]: group["seconds"] for group in groups}
    told = lambda name, names: print("%-20s %9.1f %9.1f %7.2f" % (name, sum(expected[n] for n in names), sum(real.get(n, 0) for n in names),
                                                                 sum(real.get(n, 0) for n in names) / max(sum(expected[n] for n in names), 1e-9)))
    print("%-20s %9s %9s %7s" % ("", "expected", "real, s", "ratio"))
    for number, shard in enumerate(shards_of(groups, count), 1):
        told("shard %d" % number, shard)
    for table in sorted({name.split("/")[0] for name in expected}):
        told(table, [name for name in expected if name.split("/")[0] == table])
    told("all", list(expected))
    print("the groups that change the sum most:")
    for name in sorted(expected, key=lambda name: -abs(real.get(name, 0) - expected[name]))[:WORST]:
        told("  " + name, [name])
    if walls:
        print("shards took %.1f s by the wall clock, %.1f s of it outside of their groups" % (sum(walls), sum(walls) - sum(real.values())))


def measure(raingauge, plan, records, count):
    """Measures all shards in turn; the wall time of each that measured all of its groups now."""
    walls = []
    for number in range(1, count + 1):
        begin = time.monotonic()
        done = subprocess.run([raingauge, "table", "--plan", plan, "--shard", "%d/%d" % (number, count), "-o", records], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1, 4, 77):  # cells that fail, show no rain or are unsupported take their time, too
            sys.exit("expected.py: shard %d: status %d, %s" % (number, done.returncode, done.stderr))
        if ": 0 of " in done.stderr:
            walls.append(time.monotonic() - begin)
        print("shard %d of %d: %.0f s" % (number, count, time.monotonic() - begin), flush=True)
    return walls if len(walls) == count else []


def run(options, folder):
    plan, records = os.path.join(folder, "plan.json"), os.path.join(folder, "records")
    if not os.path.exists(plan):
        subprocess.run([options.raingauge, "plan", *options.tables, "--quick", "--device", options.device, "--from", options.records, "--shards",
                        str(options.shards), "-o", plan], check=True)
    document = read(plan)
    groups, count = groups_of(document), document["shards"]
    print("%d groups, expected to take %.0f min in all" % (len(groups), sum(group["seconds"] for group in groups) / 60), flush=True)
    if options.plan:
        return 0
    if subprocess.run([options.raingauge, "doctor", "--prologue", "--device", options.device], check=False).returncode:
        return 75
    walls = measure(options.raingauge, plan, records, count)
    found = [read(os.path.join(records, name))["group"] for name in sorted(os.listdir(records)) if name.endswith(".json")]
    real = {group["id"]: group["seconds"] for group in found}
    tell(groups, real, walls, count)
    problems = judge(groups, real, count)
    print("\n".join(problems) or "the plan's times hold: within %.0f %% in all, and %.1f times the mean" % (100 * MOST_OFF, MOST_UNEVEN))
    return 1 if problems else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("raingauge", type=os.path.abspath)
    parser.add_argument("tables", nargs="*")
    parser.add_argument("--device", default="cpu", help="those of the plan; without it cpu, which takes minutes where all take hours")
    parser.add_argument("--shards", type=int, default=8)
    parser.add_argument("--records", default=str(ROOT / "results" / "tables"))
    parser.add_argument("--folder", type=os.path.abspath)
    parser.add_argument("--plan", action="store_true")
    options = parser.parse_args()
    if options.folder:
        os.makedirs(options.folder, exist_ok=True)
        return run(options, options.folder)
    with tempfile.TemporaryDirectory() as folder:
        return run(options, folder)


if __name__ == "__main__":
    sys.exit(main())
