"""Gates and verifications in shards: all records together make what one run reports, and nothing is lost or counted twice."""
import json
import os
import re
import shutil
import signal
import tempfile

import forms
from gates import AT_ONCE, EXTRA, QUICK, KNOT, Files
from losses import wait_for
from runner import LATER
from wrong import RIGHT, TURNED

THIRD = KNOT.replace("raster/knot", "raster/third")
CELLS = QUICK + THIRD + "raster/quads raster 64x48 2 scene=quads\n"
# How each of two shards learns which it is.
WAYS = (({}, "1/2"), ({"CI_NODE_INDEX": "2", "CI_NODE_TOTAL": "2"}, "auto"))
OTHER_WAYS = (({"GTEST_SHARD_INDEX": "0", "GTEST_TOTAL_SHARDS": "2"}, "auto"),
              ({"SLURM_ARRAY_TASK_ID": "6", "SLURM_ARRAY_TASK_MIN": "5", "SLURM_ARRAY_TASK_MAX": "6", "SLURM_ARRAY_TASK_COUNT": "2"}, "auto"))


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return json.load(file)


def text(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def timeless(report):
    """A report without what differs from run to run."""
    return [{key: value for key, value in case.items() if key not in ("seconds", "ratio", "smallest_visible", "time_ms", "baseline_ms")} for case in report["gated"]]


def places(folder, count):
    return [read(folder, "gate-%d-of-%d.json" % (i, count))["places"] for i in range(1, count + 1)]


def run_shards(runner, args, folder, ways=WAYS):
    return [runner.run(args + ["--shard", shard, "-o", folder], env) for env, shard in ways]


def check_one_gate(runner):
    """two shards report what one gate does, to the byte but for times: cases, JUnit, pictures, exit status; each case is of one shard"""
    problems = []
    with Files(CELLS) as files:
        kernels = files.path("kernels")
        os.mkdir(kernels)
        runner.kernels_with(kernels, "flow_normals.glsl", RIGHT, TURNED)
        for name, other, ways, status in (("alike", "cpu:reference", WAYS, 0), ("apart", "new=gl@RG_KERNEL_DIR=" + kernels, OTHER_WAYS, 1)):
            args = ["gate", "gl" if status else "cpu", other, "--cells", files.cells, "--pictures"]
            out, one, junit = files.path(name), files.path("one"), files.path("all.xml")
            shards = run_shards(runner, args, out, ways)
            whole = runner.run(args + ["-o", one, "--junit", files.path("one.xml"), "--json"])
            merged = runner.run(["gate", "--from", out, "--junit", junit, "--json"])
            reports = [json.loads(run.stdout) for run in (whole, merged)]
            problems += forms.problems("gate", reports[1]) + [problem for i in (1, 2) for problem in forms.problems("gate", read(out, "gate-%d-of-2.json" % i))]
            for report in reports:
                for case in report["gated"]:
                    case["attachments"] = [os.path.basename(path) for path in case["attachments"]]
            if merged.returncode != whole.returncode or merged.returncode != status or timeless(reports[0]) != timeless(reports[1]) or reports[0]["passport_text"] != reports[1]["passport_text"]:
                problems.append("%s: %s, %s" % (name, whole, merged))
            units = [re.sub(r' time="[\d.]+"', "", text(path)).replace(folder, "") for path, folder in ((files.path("one.xml"), one), (junit, out))]
            if units[0] != units[1]:
                problems.append("%s: JUnit's differ: %s, %s" % (name, *units))
            if sorted(sum(places(out, 2), [])) != [0, 1, 2, 3] or sorted(run.returncode for run in shards) != [0, status] or any(run.stderr for run in shards + [merged]):
                problems.append("%s: %s, %s" % (name, places(out, 2), shards))
            pictures = sorted(name for name in os.listdir(out) if name.endswith((".png", ".exr")))
            if pictures != (sorted(name for name in os.listdir(one) if name.endswith((".png", ".exr"))) if status else []):
                problems.append("%s: pictures %s" % (name, pictures))
            shown = runner.run(["gate", "--from", out]).stdout
            if not shown.startswith("A  ") or "\n4 cases, " not in shown or shown.count("\nB  ") != 1:
                problems.append("%s: %s" % (name, shown))
    return problems


def check_timed(runner):
    """a shard finds a cell that takes several times as long, and all together say so; its launches lie in its own folder, and a page beside all"""
    with Files(KNOT + THIRD) as files:
        out = files.path("out")
        args = ["gate", "cpu", "slow=cpu@RG_PROGRAM=%s;%s" % (runner.slower, EXTRA), "--cells", files.cells]
        shards = run_shards(runner, args, out)
        merged = runner.run(["gate", "--from", out, "-o", out, "--json"])
        report = json.loads(merged.stdout)
        names = sorted(os.path.join(os.path.relpath(folder, out), name) for folder, _, names in os.walk(out) for name in names)
    problems = forms.problems("gate", report)
    if merged.returncode != 1 or [run.returncode for run in shards] != [1, 1] or [(case["name"], case["ending"]) for case in report["gated"]] != [
            ("raster/knot.slow", "regressed"), ("raster/third.slow", "regressed")]:
        problems.append("%s, %s" % (shards, merged))
    if any(case["ratio"]["value"] < 1.05 for case in report["gated"]):
        problems.append("ratios: %s" % [case["ratio"] for case in report["gated"]])
    wanted = ["./gate-1-of-2.json", "./gate-2-of-2.json", "./page.html", "1-of-2/launches.csv", "2-of-2/launches.csv"]
    return problems + ([] if names == wanted else ["left: %s" % names])


def check_divided(runner):
    """cells are divided by the time that they took in an earlier gate, or when the baseline was made, and evenly without either"""
    problems = []
    with Files(CELLS) as files:
        args = ["gate", "cpu", "cpu", "--cells", files.cells, "--pictures"]
        earlier = json.loads(runner.run(args + ["--json"]).stdout)
        for case, seconds in zip(earlier["gated"], (1, 1, 10, 1)):
            case["seconds"] = seconds
        times = files.path("times.json", json.dumps(earlier))
        for more, wanted in (([], [[0, 2], [1, 3]]), (["--times", times], [[2], [0, 1, 3]])):
            out = files.path("out%d" % len(more))
            run_shards(runner, args + more, out)
            if places(out, 2) != wanted:
                problems.append("%s: %s, not %s" % (more, places(out, 2), wanted))
        baseline = files.path("baseline.json")
        made = runner.run(["baseline", "--device", "cpu,cpu:reference", "--pictures", "--cells", files.cells, "-o", baseline])
        problems += forms.problems("baseline", read(baseline))
        seconds = [row["seconds"] for row in read(baseline)["baseline"]]
        taken, wanted = [0, 0], [[], []]
        for place in sorted(range(8), key=lambda i: -seconds[i]):
            shard = taken.index(min(taken))
            taken[shard] += seconds[place]
            wanted[shard].append(place)
        out = files.path("held")
        shards = run_shards(runner, ["gate", "--baseline", baseline, "--pictures", "--cells", files.cells], out)
        merged = runner.run(["gate", "--from", out])
        if made.returncode or min(seconds) <= 0 or places(out, 2) != [sorted(part) for part in wanted] or merged.returncode or "\n8 cases, 8 pass\n" not in merged.stdout:
            problems.append("a baseline: %s, %s, %s, %s" % (seconds, places(out, 2), shards, merged))
    return problems


def check_missing(runner):
    """a shard that is missing or damaged is named; without any record, and with shards of another gate, nothing is reported; copies are told of"""
    problems = []
    with Files(QUICK + THIRD) as files:
        out, args = files.path("out"), ["gate", "cpu", "cpu", "--cells", files.cells, "--pictures"]
        run_shards(runner, args, out)
        first, second = (os.path.join(out, "gate-%d-of-2.json" % i) for i in (1, 2))
        shutil.copytree(out, files.path("jobs/one"))
        shutil.copytree(out, files.path("jobs/two"))
        copies = runner.run(["gate", "--from", files.path("jobs")])
        if copies.returncode or copies.stderr.count("is there twice, and this record is not taken\n") != 2 or "\n3 cases, 3 pass\n" not in copies.stdout:
            problems.append("copies: %s" % copies)
        with open(second, "r+b") as file:
            file.truncate(os.path.getsize(second) // 2)
        for args_more, status, says in (([], 3, "of 2 shards are missing: 2; nothing is reported"), (["--partial"], 0, "warning: %s: of 2 shards are missing: 2\n" % out)):
            done = runner.run(["gate", "--from", out] + args_more)
            if done.returncode != status or says not in done.stderr or "gate-2-of-2.json: line " not in done.stderr or bool(done.stdout) != (status == 0):
                problems.append("cut: %s" % done)
        changed = text(first).replace('"ending": "pass"', '"ending": "skipped"', 1)
        bare = read(first)
        del bare["checksum"]
        os.makedirs(files.path("changed"))
        os.makedirs(files.path("bare"))
        files.path("changed/gate-1-of-2.json", changed)
        files.path("bare/gate-1-of-2.json", json.dumps(bare))
        os.makedirs(files.path("empty"))
        for folder, status, says in ((files.path("empty"), 4, "holds no record of a shard; name the folder of `raingauge gate --shard -o`"),
                                     (files.path("none"), 2, "none: No such file or directory; name a folder of records"), (files.path("changed"), 4, "its checksum is wrong"), (files.path("bare"), 4, "has no checksum")):
            done = runner.run(["gate", "--from", folder])
            if done.returncode != status or done.stdout or says not in done.stderr:
                problems.append("%s: %s" % (folder, done))
        os.remove(second)
        for more, differs in ((["--pictures", "--shard", "2/3"], "number of shards"), (["--pictures", "--require", "cpu", "--shard", "2/2"], "require"),
                              (["--pictures", "--gtest_filter=raster*", "--shard", "2/2"], "filter")):
            runner.run(args[:-1] + more + ["-o", out])
            done = runner.run(["gate", "--from", out])
            if done.returncode != 2 or done.stdout or not re.fullmatch(r"raingauge: \S+: its %s is not that of \S+; name the records of one gate, or run its shard again\n" % differs, done.stderr):
                problems.append("%s: %s" % (more, done))
            for name in os.listdir(out):
                if name != "gate-1-of-2.json":
                    os.remove(os.path.join(out, name))
        page = runner.run(["report", out, "-o", files.path("page.html")])
        if page.returncode != 2 or "gate-1-of-2.json: is the record of a shard; name what `raingauge gate --from --json` makes" not in page.stderr:
            problems.append("page: %s" % page)
    return problems


def check_refused(runner):
    """what makes no sense is refused in one line, before anything runs"""
    problems = []
    with Files(KNOT) as files:
        pair, out = ["cpu", "cpu", "--cells", files.cells, "--pictures"], ["-o", files.path("out")]
        for args, says in ((["gate", *pair, "--shard", "1/2"], "--shard: name the folder of its record, as -o gate"), (["gate", *pair, *out, "--shard", "3/2"], "--shard 3/2: shard 3 is none of 1 to 2"),
                           (["gate", *pair, *out, "--shard", "two"], "--shard two: write it as 1/4"), (["gate", *pair, *out, "--shard", "auto"], "--shard auto: neither SLURM_ARRAY_TASK_ID"),
                           (["gate", *pair, "--partial"], "--partial: is about the records of shards"), (["gate", *pair, "--times", files.cells], "--times: divides the cells among shards"),
                           (["gate", *pair, *out, "--shard", "1/2", "--times", files.cells], "cells.txt: line 1 is no JSON"),
                           (["gate", *pair, *out, "--shard", "1/2", "--times", files.path("other.json", "{}")], "other.json: is no record of a gate"),
                           (["gate", "cpu", "cpu", "--from", files.path("x")], "--from: the shards had their devices; leave out 'cpu'"), (["gate", "--from", files.path("x"), "--shard", "1/2"], "choose one"),
                           (["verify", "flow", "--shard", "1/2"], "--shard: name the folder of its record, as -o verified"), (["verify", "flow", *out], "is for the record of a shard; add --shard"),
                           (["verify", "flow", "--from", files.path("x")], "--from: the shards had their techniques; leave out 'flow'"), (["verify", "--partial"], "--partial: is about the records of shards")):
            done = runner.run(args)
            if done.returncode != 2 or done.stdout or done.stderr.count("\n") != 1 or says not in done.stderr or os.path.exists(files.path("out/gate-1-of-2.json")):
                problems.append("%s: %s" % (args, done))
    return problems


def check_expected(runner):
    """expectations hold in each shard, and all shards together mend their file as one gate does; a shard alone mends nothing"""
    problems = []
    with Files(CELLS) as files:
        known = files.path("known.txt", "fail *\n  device cpu\n  outcome fail\n  reason all failed once\n  since 2026-01-01\n  until %s\n" % LATER)
        out, args = files.path("out"), ["gate", "cpu", "cpu", "--cells", files.cells, "--pictures", "--expectations", known]
        shards = run_shards(runner, args, out)
        if [run.returncode for run in shards] != [1, 1] or any("is not true of this run" in run.stdout for run in shards):
            problems.append("shards: %s" % shards)
        alone = runner.run(args + ["--shard", "1/2", "-o", out, "--update"])
        if alone.returncode != 2 or "--update: a filter or a shard runs some of the cells" not in alone.stderr:
            problems.append("a shard alone: %s" % alone)
        told = runner.run(["gate", "--from", out, "--expectations", known])
        if told.returncode != 1 or "4 cases, 4 unexpected pass" not in told.stdout or "known.txt: is not true of this run; --update writes it anew" not in told.stdout:
            problems.append("told: %s" % told)
        partly = runner.run(["gate", "--from", out, "--expectations", known, "--update", "--partial"])
        if partly.returncode != 2 or "choose one" not in partly.stderr:
            problems.append("partly: %s" % partly)
        mended = runner.run(["gate", "--from", out, "--expectations", known, "--update"])
        if mended.returncode != 1 or "fail" in text(known):
            problems.append("mended: %s, %s" % (mended, text(known)))
        # What fails newly stands in the order of one gate.
        new, crashes, written = files.path("new.txt"), files.path("crashes"), []
        args = ["gate", "cpu", "new=vulkan@VK_DRIVER_FILES=" + runner.crashing_vulkan(files.folder.name)["VK_DRIVER_FILES"], "--cells", files.cells, "--pictures", "--expectations", new]
        for ways in ((), WAYS):
            files.path("new.txt", "")
            run_shards(runner, args, crashes, ways)
            runner.run((["gate", "--from", crashes, "--expectations", new] if ways else args) + ["--update"])
            written.append(text(new))
        if written[0] != written[1] or written[0].count("fail ") != 4:
            problems.append("new: %s" % written)
        again = runner.run(["gate", "--from", out, "--expectations", known])
        if again.returncode != 2 or again.stdout or "its shards had other expectations" not in again.stderr:
            problems.append("others: %s" % again)
    return problems


def check_required(runner):
    """a required device that is missing fails each shard, and all together once; one that no shard compared fails all together alone"""
    problems = []
    with Files(QUICK + THIRD) as files:
        out, args = files.path("out"), ["gate", "cpu", "vulkan@VK_DRIVER_FILES=/nonexistent", "--require", "vulkan", "--cells", files.cells, "--pictures"]
        shards = run_shards(runner, args, out)
        merged = runner.run(["gate", "--from", out, "--json"])
        if [run.returncode for run in shards] != [1, 1] or merged.returncode != 1 or [case["name"] for case in json.loads(merged.stdout)["gated"]] != ["required.vulkan"]:
            problems.append("%s, %s" % (shards, merged))
        known = files.path("known.txt", "skip *\n  reason it hangs\n  since 2026-01-01\n  until %s\n" % LATER)
        out, args = files.path("skipped"), ["gate", "cpu", "cpu", "--require", "cpu", "--cells", files.cells, "--pictures", "--expectations", known]
        shards = run_shards(runner, args, out)
        whole, merged = runner.run(args + ["--json"]), runner.run(["gate", "--from", out, "--json"])
        names = [[case["name"] for case in json.loads(run.stdout)["gated"]] for run in (whole, merged)]
        if [run.returncode for run in shards] != [4, 4] or (whole.returncode, merged.returncode) != (1, 1) or names[0] != names[1] or names[0][-1] != "required.cpu":
            problems.append("skipped: %s, %s, %s" % (shards, whole, merged))
    return problems


def check_empty(runner):
    """a shard without a cell compares nothing, says so, and leaves its record; all together pass"""
    with Files(KNOT + THIRD) as files:
        out, args = files.path("out"), ["gate", "cpu", "cpu", "--cells", files.cells, "--pictures"]
        shards = run_shards(runner, args, out, [({}, "%d/3" % i) for i in (1, 2, 3)])
        merged = runner.run(["gate", "--from", out])
    says = "raingauge: gate: shard 3 of 3 has none of 2 cases; make it 2 shards at most\n"
    good = [run.returncode for run in shards] == [0, 0, 4] and shards[2].stderr == says and merged.returncode == 0 and "\n2 cases, 2 pass\n" in merged.stdout
    return [] if good else ["%s, %s" % (shards, merged)]


def check_again(runner):
    """a shard that is killed goes on with its launches; two shards share a folder, and one shard at a time its own"""
    problems = []
    with Files(QUICK) as files:
        out, args = files.path("out"), ["gate", "cpu", "cpu", "--cells", files.cells, *AT_ONCE]
        journal = os.path.join(out, "1-of-2", "gate.journal")
        process = runner.start(args + ["--shard", "1/2", "-o", out])
        wait_for(lambda: os.path.exists(journal) or process.poll() is not None)
        process.send_signal(signal.SIGSTOP)  # it exists while the others run
        beside = runner.run(args + ["--shard", "1/2", "-o", out])
        other = runner.run(args + ["--shard", "2/2", "-o", out])
        process.send_signal(signal.SIGKILL)
        process.communicate()
        if beside.returncode != 2 or "1-of-2: another raingauge writes into it" not in beside.stderr or other.returncode not in (0, 3):
            problems.append("beside: %s, %s" % (beside, other))
        left = runner.run(["gate", "--from", out])
        again = runner.run(args + ["--shard", "1/2", "-o", out])
        merged = runner.run(["gate", "--from", out])
        if left.returncode != 3 or "of 2 shards are missing: 1" not in left.stderr or again.returncode not in (0, 3) or "of a gate that was interrupted, which goes on" not in again.stderr:
            problems.append("again: %s, %s" % (left, again))
        if merged.returncode != max(again.returncode, other.returncode) or "\n2 cases, " not in merged.stdout:
            problems.append("merged: %s" % merged)
    return problems


def checks_of(run):
    return sorted(json.dumps(check, sort_keys=True) for check in json.loads(run.stdout)["checks"])


def check_verified(runner):
    """techniques and devices are verified in shards as in one run, and nothing is lost or told twice"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        out, args = tmp + "/out", ["verify", "raster", "cartoon", "--stages", "--frame", "1", "--size", "64x48", "--device", "cpu,gl,cpu:reference"]
        whole = runner.run(args + ["--json"])
        shards = run_shards(runner, args, out, (({}, "1/3"), ({"CI_NODE_INDEX": "2", "CI_NODE_TOTAL": "3"}, "auto"), ({}, "3/3")))
        merged = runner.run(["verify", "--from", out, "--json"])
        problems += forms.problems("verify", json.loads(merged.stdout)) + forms.problems("verify", read(out, "verify-2-of-3.json"))
        if any(run.returncode for run in shards + [whole, merged]) or checks_of(whole) != checks_of(merged) or json.loads(whole.stdout)["devices"] != json.loads(merged.stdout)["devices"]:
            problems.append("%s, %s, %s" % (whole, shards, merged))
        counts = [len(read(out, "verify-%d-of-3.json" % i)["checks"]) for i in (1, 2, 3)]
        if 0 in counts or sum(counts) != len(checks_of(whole)):
            problems.append("checks: %s" % counts)
        lines = runner.run(["verify", "--from", out]).stdout
        if lines.count("gl: Mesa ") != 1 or "\n%d checks, " % sum(counts) not in lines:
            problems.append(lines)
        os.remove(out + "/verify-2-of-3.json")
        left = runner.run(["verify", "--from", out])
        part = runner.run(["verify", "--from", out, "--partial", "--json"])
        if left.returncode != 3 or left.stdout or "of 3 shards are missing: 2" not in left.stderr or part.returncode or len(checks_of(part)) != counts[0] + counts[2]:
            problems.append("left: %s, %s" % (left, part))
        runner.run(args[:-1] + ["cpu", "--shard", "2/3", "-o", out])
        done = runner.run(["verify", "--from", out])
        if done.returncode != 2 or done.stdout or "verify-2-of-3.json: its units is not that of " not in done.stderr:
            problems.append("others: %s" % done)
        empty = runner.run(["verify", "raster", "--stages", "--frame", "1", "--size", "64x48", "--device", "cpu", "--shard", "2/2", "-o", tmp + "/empty"])
        if empty.returncode != 4 or "verify: shard 2 of 2 has none of 1 units; make it 1 shards at most" not in empty.stderr or not os.path.exists(tmp + "/empty/verify-2-of-2.json"):
            problems.append("empty: %s" % empty)
    return problems


def check_verified_wrong(runner):
    """a device that is wrong fails its shard, and all together; mutants are a unit of their own, and cpu:reference is told once"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        kernels = tmp + "/kernels"
        os.mkdir(kernels)
        runner.kernels_with(kernels, "flow_normals.glsl", RIGHT, TURNED)
        args = ["verify", "flow", "--quick", "--frame", "1", "--size", "32x32", "--set", "resolution_px=32",
                "--set", "environment_px=16", "--device", "cpu,gl@RG_KERNEL_DIR=" + kernels]
        shards = run_shards(runner, args, tmp + "/out", [({}, "%d/3" % i) for i in (1, 2, 3)])
        whole, merged = runner.run(args + ["--json"]), runner.run(["verify", "--from", tmp + "/out", "--json"])
        if sorted(run.returncode for run in shards) != [0, 0, 1] or (whole.returncode, merged.returncode) != (1, 1) or checks_of(whole) != checks_of(merged):
            problems.append("%s, %s, %s" % (whole, shards, merged))
    return problems


CHECKS = [check_one_gate, check_timed, check_divided, check_missing, check_refused, check_expected, check_required, check_empty, check_again, check_verified]
LONG = [check_verified_wrong]
