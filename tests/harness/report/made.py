"""Records and pictures for the tests of the page, and how these run `raingauge report`."""
import json
import pathlib
import struct
import subprocess
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
TABLES = ROOT / "results" / "tables"
# Text that would end an element, begin one, or run, if it were taken for markup.
HOSTILE = "</script><script>window.hacked = 1</script><img src=x onerror=\"window.hacked = 2\"><!--'\"&amp;\u2028\u202e${1}`"


def report(raingauge, folder, *words):
    return subprocess.run([raingauge, "report", *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)


def data_of(page):
    """The data of a page, as its script reads it."""
    text = pathlib.Path(page).read_text(encoding="utf-8")
    begin = '<script type="application/json" id="data">'
    assert text.count(begin) == 1
    return json.loads(text.split(begin)[1].split("</script>")[0])


def png(width, height, colour, level=6):
    """A picture whose pixels are `colour(x, y)`, three numbers to 255; `level` is zlib's."""
    rows = b"".join(b"\0" + bytes(code for x in range(width) for code in colour(x, y)) for y in range(height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + chunk(
        b"IDAT", zlib.compress(rows, level)) + chunk(b"IEND", b"")


def linear(code):
    """The light of an sRGB code."""
    x = code / 255
    return x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4


def exr(width, height, light):
    """A picture whose texels are `light(x, y)`, three floats of linear light: an OpenEXR file without compression."""
    attribute = lambda name, kind, data: name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(data)) + data
    channels = b"".join(name + b"\0" + struct.pack("<iIii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = b"\x76\x2f\x31\x01\x02\0\0\0" + attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0") + attribute(
        "dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0") + attribute(
        "pixelAspectRatio", "float", struct.pack("<f", 1)) + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)) + attribute(
        "screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    size = 8 + 12 * width
    lines = b"".join(struct.pack("<iI", y, 12 * width) + b"".join(struct.pack("<f", light(x, y)[channel]) for channel in (2, 1, 0) for x in range(width)) for y in range(height))
    return head + struct.pack(f"<{height}Q", *(len(head) + 8 * height + size * y for y in range(height))) + lines


def diff(raingauge, folder, a, b, *words):
    """What `raingauge diff` says of two files of pictures."""
    text = subprocess.run([raingauge, "diff", a, b, "--json", *words], cwd=folder, capture_output=True, text=True, check=False).stdout
    return json.loads(text)["pairs"][0]


def machines(folder):
    """Records of two machines, in folders that comparison keys name: on the first one's cpu Chin's frame is fast enough, on the second's it is not."""
    for key, cpu, frame_ms in (("a" * 16, "First CPU", 10), ("b" * 16, "Second CPU", 50)):
        (folder / key).mkdir(parents=True)
        for table in ("chin-timing", "creus-5.4"):
            record = json.loads((TABLES / f"{table}.json").read_text(encoding="utf-8"))
            record["passport"]["machine"]["cpu"] = cpu
            for cell in record["cells"]:
                del cell["checksum"]
                if (table, cell["device"]) == ("chin-timing", "cpu"):
                    cell["measured"]["launches"] = [[i + 1, frame_ms + 0.01 * (i * 7 % 12), 0, 0, 1] for i in range(24)]
            write(folder / key / f"{table}.json", record)
    return folder


def bounded(value=None, width=0.01):
    return {"value": value, "low": value and value * (1 - width), "high": value and value * (1 + width)}


def case(name, ending="pass", ratio=None, width=0.01, **more):
    return {"name": name, "technique": name.split("/")[0] if "/" in name else "flow", "devices": ["vulkan", "new"], "seconds": 2.5, "ending": ending, "message": "", "details": "",
            "attachments": [], "ratio": bounded(ratio, width), "smallest_visible": None, "time_ms": bounded(4.0 if ratio else None), "baseline_ms": ratio and 4.0 / ratio,
            **more}


def gate(*cases, **more):
    return {"format": 1, "passport_text": "", "endings": {}, "gated": list(cases), **more}


def write(path, document):
    path.write_text(document if isinstance(document, str) else json.dumps(document), encoding="utf-8")
    return path


def run(checks, *args):
    """Prints TAP: each check is a function that returns its problems, and is named by its docstring."""
    print("1..%d" % len(checks))
    failed = False
    for number, check in enumerate(checks, 1):
        problems = check(*args)
        failed = failed or bool(problems)
        print("%sok %d - %s" % ("not " if problems else "", number, check.__doc__))
        for problem in problems:
            print("# " + str(problem).replace("\n", "\n# "))
    return 1 if failed else 0
