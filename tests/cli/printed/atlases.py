"""atlas makes, keeps, writes and compares streaks, and textures of techniques."""
import csv
import os
import re
import struct
import tempfile
import zlib

from cases import NO_CACHE, SHOWN
from machine import lacking, run_json


def check_atlas(runner):
    """atlas makes its streaks once, then reads them; --json describes them, -o writes them"""
    problems = []
    cache = os.environ["XDG_CACHE_HOME"]
    kept = os.path.join(cache, "raingauge", "streaks-small.atlas")
    if os.path.exists(kept):
        os.unlink(kept)
    with tempfile.TemporaryDirectory() as out:
        first, status, messages = run_json(runner, "atlas --quick")
        second, again, more = run_json(runner, "atlas --quick -o " + out)
        problems += messages + more + lacking("atlas", first, {
            "format": int, "size": str, "from": str, "seconds": float, "file": str, "bytes": int, "hash": str, "images": list})
        if (status, again, first["from"], second["from"]) != (0, 0, "made", "cache") or first["hash"] != second["hash"]:
            problems.append("exit status %d and %d: %s, %s" % (status, again, first, second))
        if first["file"] != kept or not os.path.getsize(first["file"]) > first["bytes"]:
            problems.append("file: %s" % first)
        shapes = [tuple(image[k] for k in ("name", "width", "height", "layers", "levels")) for image in first["images"]]
        if shapes != [("point", 720, 901, 10, 10), ("env", 8, 901, 10, 10), ("splash", 48, 32, 84, 6)]:
            problems.append("images: %s" % shapes)
        wanted = {"factors.csv", "splash.png"} | {"sheet-%02d.png" % k for k in range(10)}
        wanted |= {"%s-%02d-level-%02d.exr" % (name, layer, level) for name, _, _, layers, levels in shapes
                   for layer in range(layers) for level in range(levels)}
        if set(os.listdir(out)) != wanted:
            problems.append("written: %s" % sorted(set(os.listdir(out)) ^ wanted))
        with open(os.path.join(out, "factors.csv")) as file:
            rows = list(csv.DictReader(file))
        if len(rows) != 10 * 5 * 91 or not all(float(row["factor"]) > 0 for row in rows):
            problems.append("factors.csv: %d rows" % len(rows))
    return problems


def check_drawn(runner):
    """a picture of rain makes the atlas of measured drops if there is none, and the next picture reads it"""
    kept, found, problems = os.path.join(os.environ["XDG_CACHE_HOME"], "raingauge", "streaks-measured-small.atlas"), [], []
    with tempfile.TemporaryDirectory() as out:
        for _ in range(2):
            drawn = runner.run((SHOWN + "-o %s/a.png" % out).split())
            problems += ["exit status %d, %s" % (drawn.returncode, drawn.stderr)] if drawn.returncode or drawn.stderr else []
            found.append(os.path.exists(kept) and (os.stat(kept).st_ino, os.stat(kept).st_mtime_ns))
    return problems if found[0] and found[0] == found[1] else problems + ["kept: %s" % found]


def write_codes(path, width, rows):
    """A grey PNG of 16 bits."""
    lines = b"".join(b"\0" + b"".join(struct.pack(">H", code) for code in row) for row in rows)
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 16, 0, 0, 0, 0)), (b"IDAT", zlib.compress(lines)), (b"IEND", b""))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)) for name, data in chunks))


def check_compared(runner):
    """atlas --compare compares the database's pictures with ours: random ones are unlike any, one of an even sky is like its own"""
    with tempfile.TemporaryDirectory() as tmp:
        os.mkdir(tmp + "/cam")
        for k in range(4):  # random pixels, from a separate generator
            codes = [[(7919 * (row * 8 + column + 1) * (k + 3) ** 2) % 65521 for column in range(8)] for row in range(262)]
            write_codes("%s/cam/cv0_v10_h%d_osc%d.png" % (tmp, 20 * k + 10, k), 8, codes)
        for k in range(2):  # even ones, which are like nothing
            write_codes("%s/cam/cv0_v30_h%d_osc0.png" % (tmp, 20 * k + 10), 8, [[0] * 8] * 262)
        chord = [max(1 - ((column - 3.5) / 2.97) ** 2, 0) ** 0.5 for column in range(8)]
        ends = [min(1, min(row, 261 - row) / 6) for row in range(262)]
        write_codes(tmp + "/cv0_osc0.png", 8, [[int(60000 * c * e) for c in chord] for e in ends])
        told, status, problems = run_json(runner, "atlas --quick --compare " + tmp, form="likeness")
        text = runner.run(["atlas", "--quick", "--compare", tmp]).stdout
    sets = {row["set"]: row for row in told["sets"]}
    if status or sets["everywhere"]["median"] < 0.95 or sets["view 0"]["pictures"] != 4 or abs(sets["view 0"]["median"]) > 0.3:
        problems.append("exit status %d, %s" % (status, told["sets"]))
    if told["flat"] != 2 or "\n2 pictures are even, theirs or ours, " not in text:
        problems.append("%d are even: %s" % (told["flat"], text))
    if len(told["pictures"]) != 7 or told["brightness"] is not None or "mean brightness: not compared" not in text:
        problems.append("%s\n%s" % (told, text))
    if not re.search(r"\nlight from everywhere +1 +0\.9\d\d +100\.0 % +0\.9\d\d  cv0_osc0\.png\n", text):
        problems.append(text)
    return problems


def check_textures(runner):
    """atlas cartoon lists its textures, and with -o writes each level, their looks, and a sheet"""
    with tempfile.TemporaryDirectory() as out:
        told, status, problems = run_json(runner, "atlas cartoon -o " + out, form="textures")
        wanted = ["drop-" + weight for weight in ("light", "middle", "heavy")]
        wanted += ["splash-%s-%d" % (pattern, age) for pattern in ("steep", "aslant", "grazing") for age in range(1, 7)]
        shapes = [(name, 64, 7) for name in wanted] + [("strokes-tone-%d" % tone, 256, 4) for tone in range(1, 7)]
        if (told["format"], told["technique"], status) != (1, "cartoon", 0):
            problems.append("exit status %d: %s" % (status, told))
        if [tuple(t[k] for k in ("name", "side_px", "levels")) for t in told["textures"]] != shapes:
            problems.append("textures: %s" % told["textures"])
        files = {"textures.csv", "sheet.png"} | {name + ".png" for name, _, _ in shapes}
        files |= {"%s-level-%d.exr" % (name, level) for name, _, levels in shapes for level in range(levels)}
        if set(os.listdir(out)) != files:
            problems.append("written: %s" % sorted(set(os.listdir(out)) ^ files))
        with open(os.path.join(out, "textures.csv")) as file:
            rows = [(row["name"], int(row["side_px"]), int(row["levels"])) for row in csv.DictReader(file)]
        if rows != shapes:
            problems.append("textures.csv: %s" % rows)
    return problems


def check_atlas_not_kept(runner):
    """an atlas that cannot be kept is made all the same, with a warning"""
    result = runner.run(["atlas", "--quick"], NO_CACHE)
    kept = runner.run(["atlas", "--quick"])
    problems = []
    if result.returncode or not re.fullmatch(r"raingauge: warning: the streak atlas is not kept: /proc/none.*\n", result.stderr):
        problems.append("exit status %d, stderr: %s" % (result.returncode, result.stderr))
    images = [text.stdout.partition("\nimage ")[2] for text in (result, kept)]
    return problems if images[0] == images[1] and images[0] else problems + ["printed:\n%s, kept:\n%s" % tuple(images)]


# Other tests read what these make.
FIRST = [check_atlas, check_compared, check_drawn]
CHECKS = [check_textures]
LONG = [check_atlas_not_kept]
