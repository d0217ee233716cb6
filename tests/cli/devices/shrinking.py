"""A driver that miscompiles a shader: blamed, shrunk to a case, and the case replayed."""
import json
import os
import re
import shutil
import struct
import subprocess
import tempfile

import misbehaving

MOST_LINES = 190  # of the program that runs one kernel
MOST_BYTES = 4096  # bytes in slots that one item needs
SMALL = "--set environment_px=64 --set resolution_px=96 --size 96x96 "
STAGE, RIGHT, WRONG = "flow_normals", "44ffe000", "44ff0000"  # 2047 and 2040


def miscompiling(runner, folder, stage=STAGE, right=RIGHT, wrong=WRONG):
    """The device vulkan with a driver that changes a constant of one shader."""
    env = misbehaving.shim(runner, folder, "vulkan", "none", "none", 0)
    size = os.path.getsize(os.path.join(runner.kernels, stage + ".spv"))
    return "vulkan@VK_DRIVER_FILES=%s;RG_MISCOMPILE=%d:%s:%s" % (env["VK_DRIVER_FILES"], size, right, wrong)


def variables(device):
    """The variables that a device's name sets for its driver."""
    return dict(pair.split("=", 1) for pair in device.split("@", 1)[1].split(";"))


def check_blamed(runner):
    """diff blames only the stage whose shader a driver miscompiled, and says which tier would not notice"""
    with tempfile.TemporaryDirectory() as folder:
        device = miscompiling(runner, folder)
        args = ["diff", "flow", "--frame", "3", "--mutants", "--device", "cpu," + device]
        result = runner.run(args + SMALL.split())
        told = json.loads(runner.run(args + ["--json"] + SMALL.split()).stdout)["pairs"][0]["accepts"]
    found = re.findall(r"(?m)^  vulkan.*: frame (\d+), stage (\w+): (\w+)\[\d+\] is .*; other values$", result.stdout)
    cost = "  T2 would hold; of %d mutants it accepts %s\n" % (told["mutants"], ", ".join(told["accepted"]))
    known = {"1 % less rain", "refraction 1 % weaker"} <= set(told["accepted"]) and told["mutants"] > len(told["accepted"])
    good = result.returncode == 1 and found == [("1", STAGE, "normals")] and told["tier"] == "T2" and known and cost in result.stdout
    return [] if good else ["told %s" % told,
        "exit status %d, %s\n%s%s" % (result.returncode, found, result.stdout, result.stderr)]


def check_shrunk(runner):
    """shrink makes a case below 40 lines, smaller in every size, which each device replays"""
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        device, path = miscompiling(runner, folder), os.path.join(folder, "case.txt")
        args = ["shrink", "flow", "--frame", "3", "--seconds", "600", "--device", device + ",cpu:reference", "-o", path]
        args += "--set environment_px=32 --set resolution_px=48 --set drops=40 --set slide_gain_mm_s=31 --size 48x48".split()
        result = runner.run(args)
        if result.returncode != 0 or result.stderr or "stage " + STAGE not in result.stdout:
            return ["exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
        case = dict(line.split(" ", 1) for line in lines if not line.startswith(("#", "set ")))
        settings = dict(line[4:].split("=", 1) for line in lines if line.startswith("set "))
        if len(lines) >= 40 or (case["size"], case["frames"], case["stage"]) != ("1x1", "1", STAGE):
            problems.append("%d lines: %s" % (len(lines), case))
        least = {"resolution_px": "16", "environment_px": "16", "model": "", "view": "pane"}
        if {name: settings.get(name) for name in least} != least or {"seed", "slide_gain_mm_s", "fresnel_power"} & set(settings):
            problems.append("settings: %s" % settings)
        for other, status, says in ((device, 1, "other: .*, as was found"), ("cpu", 0, "same: cpu "), ("vulkan", 0, "same: vulkan ")):
            result = runner.run(["render", "--case", path, "--device", other])
            if result.returncode != status or result.stderr or not re.match(says, result.stdout):
                problems.append("%s: exit status %d, %s%s" % (other, result.returncode, result.stdout, result.stderr))
        text = "\n".join(lines)
        for right, wrong, says in (
                ("size 1x1", "size 1x", r"line 4: size '1x' is no value of a case here"),
                ("set environment_px", "set nonsense_px", r"line \d+: .*nonsense_px"),
                ("frames ", "frame ", r"line \d+: 'frame' is no line of a case here"),
                ("asset normals", "", r"lacks its technique, size, .*asset, class, expected digest or devices"),
                ("behind ", "# ", r"lacks its .*what it is behind"),
                ("frames ", "# ", r"lacks its .*frames"),
                ("frames ", "frames 1\nframes ", r"line \d+: 'frames' is there twice"),
                ("set view=pane", "set view=pane\nset view=box", r"line \d+: 'view' is set twice; leave one out"),
                ("stage %s" % STAGE, "stage flow_water", r"stage \d+ is '%s' here, and not 'flow_water'" % STAGE),
                ("behind ", "behind 9", r"there are fewer than 9\d+ stages here; write one anew"),
                ("asset normals", "asset nonsense", r"there is no asset 'nonsense' here; write one anew"),
                ("class values", "class nothing", r"line \d+: class 'nothing' is no value of a case here"),
                ("technique flow", "technique nonsense", r"line 3: technique 'nonsense' is no value of a case here")):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text.replace(right, wrong))
            result = runner.run(["render", "--case", path])
            if result.returncode != 2 or len(result.stderr.splitlines()) != 1 or not re.search(says, result.stderr):
                problems.append("%s: exit status %d, %s" % (wrong, result.returncode, result.stderr))
    return problems


def slots_of(folder):
    """The slots of a kernel's folder, by number: type, bytes, file before, file expected."""
    with open(os.path.join(folder, "kernel.txt"), encoding="utf-8") as file:
        rows = re.findall(r"(?m)^slot (\d+) type (\d+) .* bytes (\d+) (\S+) (\S+) # ", file.read())
    return {int(row[0]): (int(row[1]), int(row[2]), row[3], row[4]) for row in rows}


def read(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def whole(folder, name, under):
    """A slot's contents: the parts of a file over the contents before."""
    held, parts = bytearray(under), read(folder, name)
    while parts:
        at, size = struct.unpack_from("=II", parts)
        if at + size > len(held) or len(parts) < 8 + size:
            raise ValueError("%s: a part from %d on of %d bytes" % (name, at, size))
        held[at:at + size], parts = parts[8:8 + size], parts[8 + size:]
    return bytes(held)


def folder_problems(runner, folder):
    """Problems of the files of a kernel's folder, before any program has changed them."""
    problems, slots = [], slots_of(folder)
    named = {name for slot in slots.values() for name in slot[2:] if name != "-"}
    there = set(os.listdir(folder))
    if there != named | {"README", "kernel.txt", "kernel.spv", "kernel.comp", "kernel.cl", "run.c"}:
        problems.append("files: %s" % sorted(there))
    if {at: slot[0] for at, slot in slots.items()} != {0: 6, 1: 7, 2: 7} or slots[1][3] != "-" or slots[2][3] == "-":
        problems.append("slots: %s" % slots)
    needed = sum(len(read(folder, name)) for name in named)
    if needed > MOST_BYTES or slots[1][1] <= MOST_BYTES:
        problems.append("%d bytes for one item, of slots of %s" % (needed, [slot[1] for slot in slots.values()]))
    before = whole(folder, slots[2][2], bytes(slots[2][1]))
    due = whole(folder, slots[2][3], before)
    changed = {i // 12 for i in range(0, len(due), 4) if before[i:i + 4] != due[i:i + 4]}
    if len(changed) > 1:
        problems.append("%d elements are due to change, of one item's" % len(changed))
    problems += ["%s is another kernel's" % name for name, code in (("kernel.spv", ".spv"), ("kernel.comp", ".glsl"), ("kernel.cl", ".cl"))
                 if read(folder, name) != read(runner.kernels, STAGE + code)]
    return problems


def check_alone(runner):
    """a kernel's folder, copied anywhere, can be built and run with Vulkan alone, and tells the two drivers apart"""
    problems = []
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as elsewhere:
        device, path = miscompiling(runner, folder), os.path.join(folder, "a 'case'\n\x1b[2J;$(false).txt")
        args = ["shrink", "flow", "--frame", "3", "--seconds", "1", "--device", device + ",cpu:reference", "-o", path] + SMALL.split()
        result = runner.run(args)
        says = STAGE + r" alone, 1 of its \d+ items, is in .*\.kernel: cc run\.c -lvulkan -o run && \./run"
        if result.returncode != 0 or result.stderr or "\x1b" in result.stdout or not re.search(says, result.stdout):
            return ["exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]
        problems += folder_problems(runner, path + ".kernel")
        alone = shutil.copytree(path + ".kernel", os.path.join(elsewhere, "sent"))
        with open(os.path.join(alone, "run.c"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        if len(lines) > MOST_LINES:
            problems.append("run.c has %d lines" % len(lines))
        built = subprocess.run("cc -std=c11 -Wall -Wextra -Werror run.c -lvulkan -o run".split(), cwd=alone,
                               stderr=subprocess.PIPE, encoding="utf-8")
        if built.returncode:
            return problems + [built.stderr]

        def run(args, env={}):
            ran = subprocess.run(["./run"] + args, cwd=alone, env=runner.variables(env), stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, encoding="utf-8")
            return ran.returncode, ran.stdout + ran.stderr

        for args, env, status, says in (
                ([], {}, 0, "it is the same\n"),
                (["--device", "0"], {}, 0, "it is the same\n"),
                ([], variables(device), 1, r"slot 2: byte \d+ is [0-9a-f]{2}, not [0-9a-f]{2} as in 02-normals\.expected\nit differs\n"),
                (["--device", "15"], {}, 77, "there is no Vulkan device 15\n"),
                (["--device", "one"], {}, 2, r"\./run \[--device N\]\n"),
                (["--devices"], {}, 2, r"\./run \[--device N\]\n"),
                ([], {"VK_DRIVER_FILES": "/nonexistent"}, 77, "there is no Vulkan device 0\n")):
            got = run(args, env)
            if got[0] != status or not re.fullmatch(says, got[1]):
                problems.append("run %s %s: exit status %d, %s" % (args, env, *got))
        # An edited kernel has another size.
        compiled = subprocess.run("glslc -fshader-stage=compute --target-env=vulkan1.2 -O0 -g kernel.comp -o kernel.spv".split(),
                                  cwd=alone, stderr=subprocess.PIPE, encoding="utf-8")
        if compiled.returncode or read(alone, "kernel.spv") == read(path + ".kernel", "kernel.spv") or run([]) != (0, "it is the same\n"):
            problems.append("another kernel.spv: %s%s" % (compiled.stderr, run([])))
        slots = slots_of(alone)
        first = whole(alone, slots[2][3], whole(alone, slots[2][2], bytes(slots[2][1])))[0]
        with open(os.path.join(alone, slots[2][3]), "ab") as file:
            file.write(struct.pack("=IIB", 0, 1, first ^ 1))
        if run([])[0] != 1:
            problems.append("another first byte is not noticed")
        for cut in (struct.pack("=I", 0), struct.pack("=IIB", 0, 2, 0), struct.pack("=IIB", slots[1][1], 1, 0)):
            with open(os.path.join(alone, slots[1][2]), "wb") as file:
                file.write(cut)
            if run([]) != (2, "01-blurred.before: a part of it is cut off, or ends after the slot\n"):
                problems.append("a short file: %s" % (run([]),))
    return problems


QUADS = "".join("v -1 -1 %d\nv 1 -1 %d\nv 1 1 %d\nv -1 1 %d\n" % (z, z, z, z) for z in (0, 1, -1))
QUADS += "f 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\n"


def check_files(runner):
    """a user's mesh is made smaller, goes with the case, and is replayed from there; for a draw the case is its packing kernel"""
    problems = []
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as elsewhere:
        device = miscompiling(runner, folder, "raster_mesh_emit", "43800000", "43810000")  # 256 and 258
        mesh, path = os.path.join(folder, "a 'mesh'\n$(false).obj"), os.path.join(folder, "case.txt")
        with open(mesh, "w", encoding="utf-8") as file:
            file.write(QUADS)
        args = ["shrink", "raster", "--frame", "1", "--size", "32x32", "--seconds", "600", "--set", "scene=mesh",
                "--set", "model=" + mesh, "--device", device + ",gl", "-o", path]
        result = runner.run(args, {"TMPDIR": elsewhere})
        if result.returncode != 0 or result.stderr or "raster_mesh_emit alone, 1 of its 1 items" not in result.stdout:
            return ["exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]
        left = os.listdir(elsewhere)
        sent = [shutil.copy(path, elsewhere), shutil.copytree(path + ".files", os.path.join(elsewhere, "case.txt.files"))]
        text = read(sent[1], "model.obj").decode()
        if left or sorted(line[0] for line in text.splitlines()) != ["f", "v", "v", "v", "v"]:
            problems.append("%s, %s" % (left, text))
        shutil.rmtree(path + ".files")
        os.remove(mesh)
        for other, status, says in ((device, 1, "other: .*, as was found"), ("gl", 0, "same: gl "), ("cpu", 0, "same: cpu ")):
            result = runner.run(["render", "--case", sent[0], "--device", other])
            if result.returncode != status or result.stderr or not re.match(says, result.stdout):
                problems.append("%s: exit status %d, %s%s" % (other, result.returncode, result.stdout, result.stderr))
        for name, says in (("model.obj", None), ("../model.obj", "names no file beside the case"), ("none.obj", "send the folder along")):
            with open(sent[0], encoding="utf-8") as file:
                case = file.read()
            with open(path, "w", encoding="utf-8") as file:
                file.write(case.replace("file model=model.obj", "file model=" + name))
            os.makedirs(path + ".files", exist_ok=True)
            shutil.copy(os.path.join(sent[1], "model.obj"), path + ".files")
            result = runner.run(["render", "--case", path, "--device", "cpu"])
            if result.returncode != (2 if says else 0) or (says and not re.fullmatch("raingauge: .*line \\d+: .*%s.*\n" % says, result.stderr)):
                problems.append("%s: exit status %d, %s" % (name, result.returncode, result.stderr))
    return problems


def check_nothing_to_shrink(runner):
    """shrink of two devices that agree fails, shrink without enough memory is refused, and neither writes anything"""
    problems = []
    for options, status, says in ((SMALL, 1, "leaves the same bits as"), (SMALL + " --memory 1M", 2, "of --memory are left")):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "case.txt")
            result = runner.run(["shrink", "flow", "--frame", "1", "--device", "cpu,cpu:reference", "-o", path] + options.split())
            if result.returncode != status or os.path.exists(path) or says not in result.stderr or result.stderr.count("\n") != 1:
                problems.append("%s: exit status %d, %s" % (options, result.returncode, result.stderr))
    return problems


def check_native(runner):
    """a native draw that differs keeps its stage and class while its case shrinks, and runs alone with Vulkan or OpenGL, on few items"""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    return native_problems(runner, "vulkan", "-lvulkan", ["--size", "64x64"]) + native_problems(runner, "gl", "-lEGL -lGL", ["--size", "16x16"])


def native_problems(runner, api, links, size):
    """Problems of a case of an API's native device, whose program is linked with these libraries."""
    problems, switch, plain = [], "LP_PERF=no_blend", api + ":native"
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as elsewhere:
        path = os.path.join(folder, "case.txt")
        args = ["--set", "scene=quads", *size, "--frame", "1", "--seconds", "5"]
        result = runner.run(["shrink", "raster", *args, "--device", "%s@%s,%s" % (plain, switch, plain), "-o", path])
        says = r"raster_quads alone, (\d+) of its \d+ items, is in .*\.kernel: cc run\.c " + links + r" -o run && \./run"
        alone = re.search(says, result.stdout)
        if result.returncode != 0 or result.stderr or not alone or int(alone.group(1)) > 4:
            return ["exit status %d, %s%s" % (result.returncode, result.stdout, result.stderr)]
        with open(path, encoding="utf-8") as file:
            case = dict(line.split(" ", 1) for line in file.read().splitlines() if not line.startswith(("#", "set ")))
        if max(map(int, case["size"].split("x"))) > 16 or (case["stage"], case["class"]) != ("raster_quads", "values"):
            problems.append("case: %s" % case)
        for other, status, told in ((plain + "@" + switch, 1, "other: .*, as was found"), (plain, 0, "same: ")):
            result = runner.run(["render", "--case", path, "--device", other])
            if result.returncode != status or not re.match(told, result.stdout):
                problems.append("%s: exit status %d, %s%s" % (other, result.returncode, result.stdout, result.stderr))
        sent = shutil.copytree(path + ".kernel", os.path.join(elsewhere, "sent"))
        built = subprocess.run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", "run.c", *links.split(), "-o", "run"], cwd=sent, stderr=subprocess.PIPE, encoding="utf-8")
        validated = {"VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation"}
        for env, status, told in ((validated, 0, "it is the same\n"),
                                  (dict([switch.split("=")], MESA_SHADER_CACHE_DISABLE="1"), 1, r"slot 13: byte .*\.expected\nit differs\n")):
            ran = subprocess.run(["./run"], cwd=sent, env=runner.variables(env), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
            if built.returncode or ran.returncode != status or not re.fullmatch(told, ran.stdout):
                problems.append("run %s: %s exit status %d, %s" % (env, built.stderr, ran.returncode, ran.stdout))
    return problems


CHECKS = [check_blamed, check_shrunk, check_alone, check_files, check_native, check_nothing_to_shrink]
