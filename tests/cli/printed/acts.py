"""Acts of raingauge that foreign files may cause: the rows of docs/reliability.md, "What a file may do", each with hostile files.

In every place that takes a text, these files name a program, a library, a folder of kernels, a FIFO, files outside of their
folder, or characters that control a terminal. The program and the library leave a mark when they run. After each command the
changes on the disk are checked.
"""
import json
import os
import re
import shlex
import struct
import tempfile

from baselines import change

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
CELL = "raster/knot raster 64x48 2 scene=triangles triangles=1000\n"
STEERS = "\x1b]0;x\x07 \u009b31m"
CASE = "technique raster\nsize 8x8\nframes 1\nset scene=mesh\n%sbehind 1\nstage %s\nasset %s\nclass values\nexpected 30d61a86a480e7ac\nfound 8ce1cf0a188d896c\ntruth %s\ndevice %s\n"
TRIANGLE = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 4}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}]}
MESH = ["render", "raster", "--device", "cpu", "--frame", "1", "--size", "8x8", "--set", "scene=mesh", "--set"]
RAIN = ["render", "streaks", "--device", "cpu", "--frame", "1", "--size", "16x9", "--set", "atlas=small", "--set", "city=small", "--set", "depth_map_px=64",
        "--set", "shadow_map_px=16", "--set"]
PANE = ["render", "drops", "--device", "cpu", "--frame", "1", "--size", "16x16", "--set", "columns=32", "--set", "rows=32", "--set", "max_drops=700", "--set"]


class Place:
    """A folder with the targets of hostile files, and its own home. `names`: devices that would run something."""

    def __init__(self, runner):
        self.folder = tempfile.TemporaryDirectory()
        self.mark = self.path("mark")
        self.library = os.path.join(os.path.dirname(runner.crasher), "libmarking_library.so")
        self.program = self.file("evil", "#!/bin/sh\ntouch %s\n" % shlex.quote(self.mark))
        os.chmod(self.program, 0o755)
        self.secret = self.file("secret.txt", "secret\n")
        self.outside = self.file("outside.bin", struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        self.pipe = self.path("pipe")
        os.mkfifo(self.pipe)
        for folder in ("in", "out", "home", "kernels"):
            os.mkdir(self.path(folder))
        icd = self.file("icd.json", json.dumps({"file_format_version": "1.0.0", "ICD": {"library_path": self.library, "api_version": "1.3.0"}}))
        egl = self.file("egl.json", json.dumps({"file_format_version": "1.0.0", "ICD": {"library_path": self.library}}))
        self.names = ["cpu@RG_PROGRAM=" + self.program, "cpu@LD_PRELOAD=" + self.library, "vulkan@VK_DRIVER_FILES=" + icd,
                      "gl@__EGL_VENDOR_LIBRARY_FILENAMES=" + egl, "opencl@OCL_ICD_VENDORS=" + self.library, "gl@RG_KERNEL_DIR=" + self.path("kernels")]
        self.env = {"HOME": self.path("home"), "XDG_STATE_HOME": self.path("home/state"), "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME"),
                    "TMPDIR": self.path("home"), "MARK_HERE": self.mark}

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def file(self, name, content):
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode("utf-8", "surrogateescape"))
        return path

    def files(self):
        """All files here except in the home and in `out`: their type, size and time of change."""
        found = {}
        for folder, folders, names in os.walk(self.folder.name):
            folders[:] = [name for name in folders if os.path.join(folder, name) not in (self.path("home"), self.path("out"))]
            for name in names + folders:
                path = os.path.join(folder, name)
                what = os.lstat(path)
                found[path] = what.st_mode, what.st_size if name in names else 0, what.st_mtime_ns if name in names else 0
        return found


# --- hostile files: each yields command lines, the allowed exit statuses, and a pattern of the one line on stderr ---

def of_baselines(place, runner):
    cells, kept = place.file("in/cells.txt", CELL), place.path("in/baseline.json")
    runner.run(["baseline", "--device", "cpu", "--pictures", "--cells", cells, "-o", kept], place.env)
    gate = ["gate", "--cells", cells, "--pictures", "--baseline"]
    for i, name in enumerate(place.names + ["cpu@OMP_NUM_THREADS=1", "x=cpu@OMP_NUM_THREADS=1"]):
        def rename(document):
            for device in document["devices"]:
                device["name"] = name
            for row in document["baseline"]:
                row["device"] = name
        path = change(kept, rename, place.path("in/%d.json" % i))
        for more in ([], ["--device", "all"], ["--json"], ["--gtest_list_tests"], ["-o", place.path("out")])[i and 4:]:
            yield gate + [path] + more, {2}, "sets variables, .* add --device %s$" % re.escape(shlex.quote(name))

    def steer(document):
        document["baseline"][0].update(why=STEERS, outcome="crash", picture="", states={}, counters={})
        document["passport"]["machine"] = {STEERS: STEERS}
    yield gate + [change(kept, steer, place.path("in/steering.json"))], {0}, None


def of_cases(place, _):
    for i, name in enumerate(place.names):
        path = place.file("in/%d.txt" % i, CASE % ("set model=torus\nset faces=300\n", "x", "y", name, name))
        yield ["render", "--case", path], {2}, "in/%d.txt: " % i
    place.file("in/linked.txt.files/real.obj", "")
    os.symlink(place.pipe, place.path("in/linked.txt.files/model.obj"))
    for i, setting in enumerate(("file model=../secret.txt", "file model=" + place.secret, "file model=..", "file model=", "set model=" + place.pipe,
                                 "set model=/dev/zero.obj", "set model=/dev/zero", "set RG_PROGRAM=" + place.program, "set model=x" + STEERS)):
        yield ["render", "--case", place.file("in/file%d.txt" % i, CASE % (setting + "\n", "x", "y", "cpu", "cpu"))], {2}, "in/file%d.txt|/dev/zero|pipe" % i
    yield ["render", "--case", place.file("in/linked.txt", CASE % ("file model=model.obj\n", "x", "y", "cpu", "cpu"))], {2}, "is not there"


def of_cells(place, _):
    for line in ("../../escape raster 64x48 2", "a/../../../../escape raster 64x48 2 scene=triangles triangles=1000", "a raster 64x48 2 scene=mesh model=" + place.pipe,
                 "a raster 64x48 2 scene=mesh model=/dev/zero", "a raster 64x48 2 RG_PROGRAM=" + place.program, "a\u009b raster 64x48 2"):
        yield ["gate", "cpu", "cpu", "--pictures", "--cells", place.file("in/cells.txt", line + "\n"), "-o", place.path("out")], {0, 1, 2, 4}, None


def of_expectations(place, _):
    cells = ["gate", "cpu", "cpu", "--pictures", "--cells", place.file("in/cells.txt", CELL)]
    fields = "\n  reason x\n  since 2026-11-01\n  until 2027-02-01\n"
    for name in place.names:
        own = "flake *\n  device %s\n  driver %s%s" % (name, place.library, fields)
        yield cells + ["--expectations", place.file("in/known.txt", own)], {0}, None
        yield cells + ["--fails", place.file("in/fails.txt", "raster/knot.%s,Crash\n" % name)], {0, 1}, None
    cells[-1] = place.file("in/cells.txt", CELL.replace("knot ", "aabab" * 10 + " ", 1))
    for pattern in ("(a+)+$", "((a|b|ab)*)*[YZ]", "(.*.*.*.*.*.*)*[YZ]", "(a|b)*a(a|b){200}[YZ]", "(a?b?){100}[YZ]"):
        yield cells + ["--flakes", place.file("in/flakes.txt", pattern + "\n")], {0}, None
    for pattern in ("((a?){60}){60}[YZ]", "((a|b)?(a|b)?){1000}[YZ]", "(.{0,1000}){9}[YZ]"):
        yield cells + ["--skips", place.file("in/skips.txt", "x\n" + pattern)], {2}, "skips.txt:2: regular expression: takes too long .* 'raster/aabab"
    yield cells + ["--flakes", place.file("in/flakes.txt", "((a{0,99}){0,99}){0,99}\n")], {2}, "flakes.txt:1: regular expression .* is too large"
    yield cells + ["--expectations", place.file("in/known.txt", "flake *\n  reason x\u009b31m\n")], {2}, "known.txt:2: control character 0x9b"


def of_records(place, _):
    with open(os.path.join(ROOT, "results", "tables", "creus-5.2.json")) as file:
        record = json.load(file)
    for cell in record["cells"]:
        del cell["checksum"]
    for name in place.names + [STEERS]:
        for device in record["passport"]["devices"]:
            device.update(driver=name, device=name)
        for cell in record["cells"]:
            cell["device"] = "cpu"
        record["passport"]["raingauge"]["kernel_dir"] = place.path("kernels")
        record["passport"]["environment"] = {"RG_PROGRAM": place.program, "LD_PRELOAD": place.library}
        record["note"] = record["hardware"] = STEERS
        path = place.file("in/record.json", json.dumps(record))
        for more in (["-o", place.path("out")], [], ["--format", "csv"], ["--claims"])[:1 if name != STEERS else 4]:
            yield ["table", "--from", path] + more, {0, 2}, None
    for table in ("../escape", "/tmp/escape", "a/b", "..", ".x"):
        record["table"] = table
        yield ["table", "--from", place.file("in/record.json", json.dumps(record)), "-o", place.path("out")], {2}, "'table' is no name|is no name"
    os.mkdir(place.path("in/folder"))
    os.mkfifo(place.path("in/folder/a.json"))
    yield ["table", "--from", place.path("in/folder")], {2}, "a.json: .*is not a regular file"
    os.remove(place.path("in/folder/a.json"))
    os.symlink("/dev/zero", place.path("in/folder/a.json"))
    yield ["table", "--from", place.path("in/folder")], {2}, "a.json: .*is not a regular file"


def of_journals(place, runner):
    cells, out, state = place.file("in/cells.txt", CELL), place.path("out"), place.path("home/state/raingauge")
    os.makedirs(state)
    with open(os.path.join(ROOT, "results", "tables", "creus-5.2.json")) as file:
        record = json.load(file)
    record["passport"]["devices"] = [dict(record["passport"]["devices"][0], name=name) for name in place.names]
    record["passport"]["environment"] = {"RG_PROGRAM": place.program, "LD_PRELOAD": place.library}
    for folder in (state, out):
        change(place.file("in/journal.json", json.dumps(dict(record, checksum=""))), lambda _: None, os.path.join(folder, "creus-5.2-quick.journal"))
    small = ["table", "creus-5.2", "--device", "cpu", "--rows", "1-1", "--set", "atlas=small", "--set", "city=small", "--set", "depth_map_px=64"]
    yield small, {0}, None
    yield small + ["-o", out], {0}, None
    os.remove(os.path.join(state, "creus-5.2-quick.journal"))
    os.mkfifo(os.path.join(state, "creus-5.2-quick.journal"))
    yield small, {0}, "is not a regular file; remove it; the table begins anew"
    key = {"program": place.program, "devices": place.names}
    change(place.file("in/kept.json", json.dumps({"format": 2, "key": key, "codes": {"../../escape": place.program}, "rows": {"../../escape": [[0, 1, 1, 1, False]]},
                                                  "checksum": ""})), lambda _: None, os.path.join(out, "gate.journal"))
    yield ["gate", "cpu", "cpu", "--cells", cells, "-o", out, "--margin", "100"], {0, 1, 3, 4}, None


def of_lists(place, _):
    names = ["$(touch %s)" % place.mark, "`touch %s`" % place.mark, "';touch %s;'" % place.mark, "\";touch %s;\"" % place.mark, place.names[0], "b"]
    path = place.file("in/list.txt", "a\n" + "\n".join(names) + "\n")
    for line in ("test \"$RG_CANDIDATE\" = a", "# it's\ntest \"$RG_CANDIDATE\" = a"):
        yield ["bisect", "--list", path, "--good", "a", "--bad", "b", "--run", line], {0}, None
    yield ["bisect", "--list", path, "--good", "a", "--bad", "b", "--run", "test {} = a"], {2}, "write \"\\$RG_CANDIDATE\""
    for name in (place.pipe, "/dev/zero", place.file("in/steering.txt", "a\n\u009b31m\n")):
        yield ["bisect", "--list", name, "--good", "a", "--bad", "b", "--run", "true"], {2}, "is not a regular file|control character 0x9b"


def of_lights(place, _):
    light = {"type": "sun", "direction": [0, -1, 0], "colour": [1, 1, 1]}
    for text in (json.dumps({"lights": [light], "RG_PROGRAM": place.program}), json.dumps({"lights": [dict(light, file=place.pipe)]}),
                 json.dumps({"lights": [dict(light, type=place.names[0] + STEERS)]}), json.dumps({STEERS: []}), "[" * 100000):
        yield RAIN + ["lights_file=" + place.file("in/lights.json", text)], {2}, "lights.json"
    yield RAIN + ["lights_file=" + place.pipe], {2}, "is not a regular file"


def of_winds(place, _):
    for text in ("include %s\n" % place.pipe, "1 2 `touch %s`\n" % place.mark, STEERS + "\n"):
        yield ["render", "cartoon", "--device", "cpu", "--frame", "1", "--size", "8x8", "--set", "wind=script", "--set",
               "wind_script=" + place.file("in/winds.txt", text)], {2}, "winds.txt"


def of_meshes(place, _):
    corners = "mtllib %s\nmtllib ../outside.mtl\nusemtl x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" % place.pipe
    yield MESH + ["model=" + place.file("in/mesh.obj", corners), "-o", place.path("out/obj.png")], {0}, None
    for uri in ("../outside.bin", "x/../../outside.bin", place.outside, "..//outside.bin", "pipe.bin"):
        mesh = place.file("in/mesh.gltf", json.dumps(dict(TRIANGLE, buffers=[{"uri": uri, "byteLength": 36}])))
        if uri == "pipe.bin":
            os.mkfifo(place.path("in/pipe.bin"))
        yield MESH + ["model=" + mesh, "-o", place.path("out/gltf.png")], {2}, "mesh.gltf"
    place.file("in/below/inside.bin", struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
    mesh = place.file("in/mesh.gltf", json.dumps(dict(TRIANGLE, buffers=[{"uri": "below/inside.bin", "byteLength": 36}])))
    yield MESH + ["model=" + mesh, "-o", place.path("out/gltf.png")], {0}, None


def of_pictures(place, _):
    for name in ("a.png", "a.exr", "a.hdr", "a.tif", "a.ktx"):
        path = place.file("in/" + name, "#!/bin/sh\ntouch %s\n%s" % (place.mark, STEERS))
        yield PANE + ["environment=" + path], {2}, "in/" + name
        if name != "a.ktx":
            yield RAIN + ["density_map=" + path], {2}, "in/" + name
            yield ["diff", path, path], {2}, "in/" + name
    os.symlink(place.pipe, place.path("in/b.png"))
    yield ["diff", place.path("in/b.png"), place.path("in/b.png")], {2}, "is not a regular file"


def of_databases(place, _):
    os.mkdir(place.path("in/database"))
    os.mkfifo(place.path("in/database/cv0_v10_h90_osc1.png"))
    os.symlink("..", place.path("in/database/again"))
    place.file("in/database/dcam00_point_max.txt", "include %s\n" % place.pipe)
    yield ["atlas", "--compare", place.path("in/database")], {2}, "in"


HOSTILE = {"baseline": of_baselines, "case": of_cases, "cells": of_cells, "expectations": of_expectations, "record": of_records, "journal": of_journals,
           "candidates": of_lists, "lights": of_lights, "winds": of_winds, "mesh": of_meshes, "picture": of_pictures, "streak database": of_databases}


def rows_of_page():
    """The first cells of the table of docs/reliability.md."""
    with open(os.path.join(ROOT, "docs", "reliability.md")) as file:
        section = file.read().split("\n## What a file may do\n")[1].split("\n## ")[0]
    return [line.split("|")[1].strip() for line in section.split("\n") if line.startswith("| ")][1:]


def problems_of(runner, kind):
    place, problems, count = Place(runner), [], 0
    with place.folder:
        for args, statuses, says in HOSTILE[kind](place, runner):
            before = place.files()
            ran = runner.run(args, place.env)
            told = [line for line in ran.stderr.split("\n") if not re.match("raingauge: (warning: |.* left, about)", line)]
            count += 1
            if ran.returncode not in statuses or (2 in statuses and len(statuses) == 1 and len(told) != 2):
                problems.append("%s: exit status %d, %s%s" % (args, ran.returncode, ran.stdout[:500], ran.stderr))
            if says and not re.search(says, ran.stderr, re.M):
                problems.append("%s: %s" % (args, ran.stderr))
            if re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f]", ran.stdout + ran.stderr):
                problems.append("%s: steers a terminal: %r" % (args, ran.stdout + ran.stderr))
            after = place.files()
            if after != before:
                problems.append("%s: changed %s" % (args, [path for path in before.keys() | after.keys() if before.get(path) != after.get(path)]))
            if os.path.exists(place.mark):
                os.remove(place.mark)
                problems.append("%s: ran what the file names" % args)
    return problems or ([] if count else ["no hostile file"])


def make_check(kind):
    def check(runner):
        return problems_of(runner, kind)
    check.__doc__ = "a hostile file of this kind runs, opens, sets and writes nothing: " + kind
    return check


def check_marks(runner):
    """a program that the command line names runs and leaves its mark, so that one that a file names would be seen"""
    place, problems = Place(runner), []
    with place.folder:
        for name in place.names[:4]:
            runner.run(["diff", "raster", "--size", "16x16", "--frame", "1", "--device", "cpu," + name], place.env)
            if not os.path.exists(place.mark):
                problems.append("%s leaves no mark" % name)
            else:
                os.remove(place.mark)
    return problems


def check_named(runner):
    """a device with a baseline's variables runs if the command line names it; others need no name"""
    place, problems = Place(runner), []
    with place.folder:
        cells, kept, name = place.file("in/cells.txt", CELL), place.path("in/baseline.json"), "cpu@OMP_NUM_THREADS=1"
        made = runner.run(["baseline", "--device", "cpu," + name, "--pictures", "--cells", cells, "-o", kept], place.env)
        gate = ["gate", "--pictures", "--cells", cells, "--baseline", kept]
        refused = runner.run(gate, place.env)
        option = re.search(r"add (--device .*)\n|$", refused.stderr).group(1) or "none"
        for args, status in ((shlex.split(option), 0), (["--device", name], 0), (["--device", "cpu"], 0), (["--device", "all"], 2)):
            ran = runner.run(gate + args, place.env)
            if ran.returncode != status:
                problems.append("%s: exit status %d, %s%s" % (args, ran.returncode, ran.stdout, ran.stderr))
        if made.returncode or refused.returncode != 2 or option != "--device cpu," + name:
            problems.append("%s%s" % (made.stderr, refused.stderr))
    return problems


def check_rows(_):
    """each row of the page has hostile files here, and the reverse"""
    rows = rows_of_page()
    return [] if sorted(rows) == sorted(HOSTILE) else ["the page has %s, and here are %s" % (rows, list(HOSTILE))]


CHECKS = [check_rows, check_marks, check_named] + [make_check(kind) for kind in HOSTILE]
