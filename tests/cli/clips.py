"""render --frames: clips, which are parsed and decoded again, and numbered pictures."""
import glob
import json
import os
import re
import signal
import struct
import subprocess
import tempfile
import time
import zlib

import forms
from cases import FRAMES, RAIN

# The box spins fast enough that each frame differs; the width is odd.
FIRST, COUNT, WIDTH, HEIGHT, FPS = 3, 6, 75, 64, 25
SPIN = ("render flow --set environment=sky --set environment_px=16 --set resolution_px=32 --set model=none "
        "--set spin_yaw_deg_s=900 --size %dx%d " % (WIDTH, HEIGHT))
CLIP = SPIN + "--frames %d-%d --fps %d " % (FIRST, FIRST + COUNT - 1, FPS)
# Largest mean difference of Y, Cb or Cr between a frame and its picture, in codes. Coding changes them by 0.5; another
# picture differs by 2.
BOUND = 0.8


# --- pictures ---

def read_png(path):
    """(width, height, pixels as (red, green, blue)) of a PNG of 8-bit RGB."""
    with open(path, "rb") as file:
        data = file.read()
    chunks, at = {}, 8
    while at < len(data):
        length, = struct.unpack_from(">I", data, at)
        name = data[at + 4:at + 8]
        chunks[name] = chunks.get(name, b"") + data[at + 8:at + 8 + length]
        at += 12 + length
    width, height, depth, kind = struct.unpack_from(">IIBB", chunks[b"IHDR"])
    if (depth, kind) != (8, 2):
        raise ValueError("%s: depth %d, type %d" % (path, depth, kind))
    raw, before, pixels = zlib.decompress(chunks[b"IDAT"]), bytes(3 * width), []
    for y in range(height):
        row = unfilter(raw[y * (3 * width + 1)], bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)]), before)
        pixels += zip(row[0::3], row[1::3], row[2::3])
        before = row
    return width, height, pixels


def unfilter(kind, row, above):
    """A row of a PNG without its filter."""
    for i in range(len(row)):
        left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
        guess = left + above[i] - corner
        paeth = min((left, above[i], corner), key=lambda value: abs(guess - value))
        row[i] = row[i] + (0, left, above[i], (left + above[i]) // 2, paeth)[kind] & 255
    return row


def yuv(path):
    """The Y, Cb and Cr of a PNG by BT.709's formula: three lists of numbers, the last two of squares of 2 x 2 pixels."""
    width, height, pixels = read_png(path)

    def light(c):
        return .2126 * c[0] + .7152 * c[1] + .0722 * c[2]

    def mean(x, y):
        near = [pixels[min(y + j, height - 1) * width + min(x + i, width - 1)] for i in (0, 1) for j in (0, 1)]
        return [sum(c[k] for c in near) / 4 for k in range(3)]

    squares = [mean(x, y) for y in range(0, height, 2) for x in range(0, width, 2)]
    return ([16 + 219 / 255 * light(c) for c in pixels],
            [128 + 224 / 255 * (c[2] - light(c)) / 1.8556 for c in squares],
            [128 + 224 / 255 * (c[0] - light(c)) / 1.5748 for c in squares])


def distance(a, b):
    """The largest of the three mean differences of two frames."""
    return max(sum(abs(p - q) for p, q in zip(one, other)) / len(one) for one, other in zip(a, b))


# --- clips ---

MASTERS = {0x18538067: "Segment", 0x1654AE6B: "Tracks", 0xAE: "Track", 0xE0: "Video", 0x1F43B675: "Cluster"}


def elements(data, at=0, end=None):
    """(id, content) of each element of WebM that holds no others, in order."""
    end = len(data) if end is None else end
    while at < end:
        wide = 9 - data[at].bit_length()
        name = int.from_bytes(data[at:at + wide], "big")
        at += wide
        wide = 9 - data[at].bit_length()
        size = int.from_bytes(data[at:at + wide], "big") & (1 << 7 * wide) - 1
        at += wide
        if at + size > end:
            raise ValueError("element %x ends behind its parent" % name)
        if name in MASTERS:
            yield from elements(data, at, at + size)
        else:
            yield name, data[at:at + size]
        at += size


def take_apart(path):
    """(codec, width, height, milliseconds of each frame, first frame's data) of a clip."""
    with open(path, "rb") as file:
        found = list(elements(file.read()))
    one = dict(found)
    times, blocks, cluster = [], [], 0
    for name, content in found:
        if name == 0xE7:  # Timecode
            cluster = int.from_bytes(content, "big")
        elif name == 0xA3:  # SimpleBlock: the track, the time in the cluster, flags
            times.append(cluster + struct.unpack_from(">h", content, 1)[0])
            blocks.append(content[4:])
    return one[0x86].decode(), int.from_bytes(one[0xB0], "big"), int.from_bytes(one[0xBA], "big"), times, blocks[0]


def decode(path, width, height):
    """The frames of a clip as vpxdec gives them back: three lists of codes each."""
    done = subprocess.run(["vpxdec", "--i420", "-o", "-", path], stdout=subprocess.PIPE, check=True)
    sizes = [width * height] + 2 * [(width + 1) // 2 * ((height + 1) // 2)]
    frames, at = [], 0
    while at < len(done.stdout):
        planes = []
        for size in sizes:
            planes.append(done.stdout[at:at + size])
            at += size
        frames.append(planes)
    return frames


def check_clip(runner):
    """a clip has all its frames in order, as `render --frame` draws them, and its size, speed and colour space"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        result = runner.run((CLIP + "-o %s/a.webm --json" % tmp).split())
        if result.returncode or result.stderr or os.listdir(tmp) != ["a.webm"]:
            return ["exit status %d, %s, stderr: %s" % (result.returncode, os.listdir(tmp), result.stderr)]
        record = json.loads(result.stdout)
        problems += forms.problems("render", record)
        if [record.get(key) for key in ("file", "frame", "frames", "fps", "width", "height")] != [
                tmp + "/a.webm", FIRST + COUNT - 1, [FIRST, FIRST + COUNT - 1], FPS, WIDTH, HEIGHT]:
            problems.append("--json: %s" % record)
        codec, width, height, times, first = take_apart(tmp + "/a.webm")
        if (codec, width, height, times) != ("V_VP9", WIDTH, HEIGHT, [1000 * i // FPS for i in range(COUNT)]):
            problems.append("the clip: %s %dx%d, frames at %s ms" % (codec, width, height, times))
        # A key frame of profile 0, its mark, then 3 bits: BT.709, and 1: the limited range.
        if first[0] & 0xf4 != 0x80 or first[1:4] != b"\x49\x83\x42" or first[4] >> 4 != 2 << 1:
            problems.append("its first frame: %s" % first[:5].hex())
        pictures = []
        for i in range(COUNT):
            path = "%s/%d.png" % (tmp, i)
            runner.run((SPIN + "--frame %d -o %s" % (FIRST + i, path)).split())
            pictures.append(yuv(path))
        problems += compare(decode(tmp + "/a.webm", WIDTH, HEIGHT), pictures)
    return problems


def compare(frames, pictures):
    """Problems: frames that are not their own picture, or are another's."""
    problems = [] if len(frames) == len(pictures) else ["%d frames, not %d" % (len(frames), len(pictures))]
    for i, frame in enumerate(frames):
        far = [distance(frame, picture) for picture in pictures]
        if not all(d < BOUND if j == i else d > 2 * BOUND for j, d in enumerate(far)):
            problems.append("frame %d is this far from each picture: %s" % (i, ", ".join("%.2f" % d for d in far)))
    return problems


def read(path):
    with open(path, "rb") as file:
        return file.read()


def check_same_bytes(runner):
    """the same command makes the same clip again, at another time"""
    texts = []
    with tempfile.TemporaryDirectory() as tmp:
        for name in "ab":
            texts.append(runner.run((CLIP + "-o %s/%s.webm" % (tmp, name)).split()).stdout)
            now = int(time.time())
            wait_until(lambda: int(time.time()) > now)  # otherwise vpxenc would derive the track's number from the same second
        same = read(tmp + "/a.webm") == read(tmp + "/b.webm")
    said = re.match(r".*/a\.webm: flow, frames 3-8, 25 a second, 75x64, on cpu ", texts[0])
    return [] if same and said else ["the same: %s, printed: %s" % (same, texts[0])]


def check_series(runner):
    """pictures of --frames, of every technique, are those that `render --frame` draws, to the byte"""
    problems = []
    for args in (FRAMES.replace("--frames 1-2", ""), RAIN.replace("--frame 1", ""), "render raster --size 32x18 "):
        with tempfile.TemporaryDirectory() as tmp:
            result = runner.run((args + "--frames 2-4 --json -o %s/a-%%02d.png" % tmp).split())
            record = json.loads(result.stdout or "{}")
            problems += forms.problems("render", record)
            if record.get("frames") != [2, 4] or "fps" in record or record.get("frame") != 4:
                problems.append("exit status %d, %s, stderr: %s" % (result.returncode, record, result.stderr))
            if sorted(os.listdir(tmp)) != ["a-02.png", "a-03.png", "a-04.png"]:
                problems.append("written: %s" % os.listdir(tmp))
            for frame in (2, 3, 4):
                runner.run((args + "--frame %d -o %s/b.png" % (frame, tmp)).split())
                if read(tmp + "/b.png") != read("%s/a-%02d.png" % (tmp, frame)):
                    problems.append("%s: frame %d is another picture" % (args, frame))
    return problems


# --- failures ---

def with_encoder(folder, script):
    """Variables with which raingauge takes this script for vpxenc."""
    path = os.path.join(folder, "vpxenc")
    with open(path, "w") as file:
        file.write("#!/bin/sh\n" + script)
    os.chmod(path, 0o755)
    return {"PATH": folder + ":" + os.environ["PATH"]}


FAILURES = {
    "echo started >&2; echo no memory for it >&2; exit 3": r"vpxenc ended with status 3: no memory for it; nothing was written",
    "cat > /dev/null; echo too late >&2; exit 1": r"vpxenc ended with status 1: too late; nothing was written",
    "kill -KILL $$": r"vpxenc was ended by a signal \(Killed\); nothing was written",
    "head -c 50 > /dev/null; kill -SEGV $$": r"vpxenc was ended by a signal \(Segmentation fault\); nothing was written",
    "head -c 50 > /dev/null; sleep 0.5; echo webm >&1": r"vpxenc ended before it had coded all frames; nothing was written",
    "exit 0": r"vpxenc ended before it had coded all frames; nothing was written",
    "cat > /dev/null": r"vpxenc ended before it had coded all frames; nothing was written",
}


def check_failing_encoder(runner):
    """a vpxenc that fails, crashes or makes nothing is reported in one line, and leaves nothing"""
    problems = []
    for script, says in FAILURES.items():
        with tempfile.TemporaryDirectory() as tmp, tempfile.TemporaryDirectory() as fake:
            result = runner.run((FRAMES + "-o %s/a.webm" % tmp).split(), with_encoder(fake, script))
            if result.returncode != 1 or result.stdout or os.listdir(tmp) or not re.fullmatch(
                    r"raingauge: .*/a\.webm: " + says + r"\n", result.stderr):
                problems.append("%s: exit status %d, %s, stderr: %s" % (script, result.returncode, os.listdir(tmp), result.stderr))
    return problems


def check_hanging_encoder(runner):
    """a vpxenc that takes nothing, codes nothing or stops is ended and reported in one line; a slow one is waited for"""
    problems = []
    slow = "for i in 1 2 3 4 5 6; do sleep 0.4; echo webm >&1; done; cat > /dev/null"
    for script in ("exec sleep 1000", "cat > /dev/null; exec sleep 1000", "exec <&-; exec sleep 1000", "kill -STOP $$", slow):
        with tempfile.TemporaryDirectory() as tmp, tempfile.TemporaryDirectory() as fake:
            result = runner.run((FRAMES + "--timeout 2 -o %s/a.webm" % tmp).split(), with_encoder(fake, script))
            told = re.fullmatch(r"raingauge: .*/a\.webm: vpxenc did nothing for 2 s and was ended; nothing was written; .*\n", result.stderr)
            ended_well = script == slow and result.returncode == 0 and not result.stderr
            if not ended_well and (script == slow or result.returncode != 1 or os.listdir(tmp) or not told):
                problems.append("%s: exit status %d, %s, stderr: %s" % (script, result.returncode, os.listdir(tmp), result.stderr))
    return problems


def children(process):
    """The processes that a process has started and not waited for."""
    found = []
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            fields = read(path).rsplit(b")", 1)[1].split()
        except OSError:  # the process has ended
            continue
        if int(fields[1]) == process:
            found.append(int(path.split("/")[2]))
    return found


def wait_until(holds, limit_s=60):
    end = time.monotonic() + limit_s
    while not holds() and time.monotonic() < end:
        time.sleep(0.01)


def interrupted(runner, args, env, ready, number=signal.SIGINT):
    """Sends a signal to a command once it is `ready`. Returns its exit status, its messages, and the children that outlive it. A
    command that does not end is killed."""
    process = runner.start(args.split(), env)
    wait_until(lambda: process.poll() is not None or ready(process.pid))
    encoders = children(process.pid)
    process.send_signal(number)
    try:
        messages = process.communicate(timeout=60)[1]
    except subprocess.TimeoutExpired:
        for running in [process.pid] + encoders:
            os.kill(running, signal.SIGKILL)
        messages = "it does not end: " + process.communicate()[1]
    return process.returncode, messages, [child for child in encoders if os.path.exists("/proc/%d" % child)]


def check_interrupted_clip(runner):
    """Ctrl-C ends a clip and its vpxenc, even one that hangs, and leaves no file"""
    problems = []
    for number, frames, script in ((signal.SIGINT, "0-1000000", None), (signal.SIGINT, "0-1000000", "exec sleep 1000"),
                                   (signal.SIGTERM, "0-1", "cat > /dev/null; touch $0.end; exec sleep 1000")):
        with tempfile.TemporaryDirectory() as tmp, tempfile.TemporaryDirectory() as fake:
            env = with_encoder(fake, script) if script else {}
            end = fake + "/vpxenc.end"
            status, messages, left = interrupted(
                runner, SPIN + "--frames %s -o %s/a.webm" % (frames, tmp), env,
                lambda pid: os.path.exists(end) if number == signal.SIGTERM else len(children(pid)) > 1, number)
            said = messages == "raingauge: %s/a.webm: interrupted; nothing was written\n" % tmp
            if status != 128 + number or left or os.listdir(tmp) or not said:
                problems.append("%s: exit status %d, left: %s %s, stderr: %s" % (script, status, left, os.listdir(tmp), messages))
    return problems


def check_interrupted_series(runner):
    """Ctrl-C ends numbered pictures between two frames, and a line names the written ones"""
    with tempfile.TemporaryDirectory() as tmp:
        status, messages, _ = interrupted(runner, SPIN + "--frames 5-1000000 -o %s/%%d.png" % tmp, {},
                                          lambda pid: os.path.exists(tmp + "/8.png"))
        names = sorted(os.listdir(tmp), key=lambda name: int(name.split(".")[0]))
        wanted = ["%d.png" % frame for frame in range(5, 5 + len(names))]
        said = re.fullmatch(r"raingauge: .*/%%d\.png: interrupted; frames 5-%d are written\n" % (4 + len(names)), messages)
        whole = [read_png(os.path.join(tmp, name))[:2] == (WIDTH, HEIGHT) for name in names]
    if status == 130 and said and names == wanted and len(names) > 3 and all(whole):
        return []
    return ["exit status %d, %s, stderr: %s" % (status, names, messages)]


CHECKS = [check_clip, check_same_bytes, check_series, check_failing_encoder, check_hanging_encoder, check_interrupted_clip, check_interrupted_series]
