#!/usr/bin/env python3
"""Writes the binary seeds of the fuzz targets of parsers: `seeds.py FOLDER`, with a folder in it for each target.

They are generated, not stored, so that the corpus can be read. Each is as small as its format allows.
"""
import struct
import sys
import zlib
from pathlib import Path

WIDE, HIGH = 5, 3


def chunk(name, content):
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def png(kind, depth, samples, interlaced=False, more=b""):
    def rows(width, height):
        line = (width * depth * samples + 7) // 8
        return b"".join(bytes([y % 5]) + bytes((37 * (x + y * line)) % 256 for x in range(line)) for y in range(height))

    passes = [(1, 1), (1, 1), (1, 1), (3, 1), (2, 2), (5, 1)] if interlaced else [(WIDE, HIGH)]
    data = b"".join(rows(*size) for size in passes)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDE, HIGH, depth, kind, 0, 0, interlaced)) +
            more + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


def palette_png():
    return png(3, 2, 1, more=chunk(b"PLTE", bytes(range(12))) + chunk(b"tRNS", b"\0\x80") + chunk(b"gAMA", b"\0\0\xb1\x8f"))


def exr(names, kind, compression, tile=None):
    """Scan lines, or tiles of one level; `kind` 0: whole numbers, 1: halves, 2: floats."""
    def attribute(name, of, content):
        return name + b"\0" + of + b"\0" + struct.pack("<I", len(content)) + content

    window = struct.pack("<4i", 0, 0, WIDE - 1, HIGH - 1)
    channels = b"".join(n + b"\0" + struct.pack("<IIii", kind, 0, 1, 1) for n in sorted(names)) + b"\0"
    header = (attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", bytes([compression])) +
              attribute(b"dataWindow", b"box2i", window) + attribute(b"displayWindow", b"box2i", window) +
              attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
              attribute(b"screenWindowCenter", b"v2f", bytes(8)) + attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)))
    if tile:
        header += attribute(b"tiles", b"tiledesc", struct.pack("<IIB", tile, tile, 0))
    head = struct.pack("<II", 20000630, 2 | (0x200 if tile else 0)) + header + b"\0"

    def packed(raw):
        if compression == 0:
            return raw
        mixed = raw[0::2] + raw[1::2]
        changed = bytes([mixed[0]]) + bytes((b - a + 128) % 256 for a, b in zip(mixed, mixed[1:]))
        small = zlib.compress(changed)
        return small if len(small) < len(raw) else raw

    def values(count):
        coded = {0: struct.pack("<I", 7), 1: struct.pack("<e", 0.75), 2: struct.pack("<f", 0.75)}[kind]
        return coded * count * len(names)

    chunks = []
    if tile:
        for y in range(0, HIGH, tile):
            for x in range(0, WIDE, tile):
                data = packed(values(min(tile, WIDE - x) * min(tile, HIGH - y)))
                chunks.append(struct.pack("<4iI", x // tile, y // tile, 0, 0, len(data)) + data)
    else:
        lines = 16 if compression == 3 else 1
        for y in range(0, HIGH, lines):
            data = packed(values(WIDE * min(lines, HIGH - y)))
            chunks.append(struct.pack("<iI", y, len(data)) + data)
    at, table = len(head) + 8 * len(chunks), b""
    for one in chunks:
        table += struct.pack("<Q", at)
        at += len(one)
    return head + table + b"".join(chunks)


def hdr():
    return (b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HIGH, WIDE) +
            bytes([128, 64, 32, 129]) * (WIDE * HIGH))


def tiff(bits=8, samples=3, form=1, tiled=False):
    """A TIFF without compression; `form` 1: whole numbers, 3: floats."""
    side = 16
    pixels = side * side if tiled else WIDE * HIGH
    data = bytes((11 * i) % 256 for i in range(pixels * samples * bits // 8))
    tags = [(256, 4, WIDE), (257, 4, HIGH), (258, 3, bits), (259, 3, 1), (262, 3, 2 if samples > 2 else 1), (277, 3, samples),
            (284, 3, 1), (339, 3, form)]
    tags += [(322, 4, side), (323, 4, side), (324, 4, 8), (325, 4, len(data))] if tiled else [
        (273, 4, 8), (278, 4, HIGH), (279, 4, len(data))]
    data += b"\0" * (len(data) % 2)
    entries = b"".join(struct.pack("<HHII", tag, kind, 1, value) for tag, kind, value in sorted(tags))
    return b"II*\0" + struct.pack("<I", 8 + len(data)) + data + struct.pack("<H", len(tags)) + entries + bytes(4)


def ktx(side, key_values=b""):
    face = struct.pack("<I", side * side * 4) + bytes((91 * i) % 256 for i in range(side * side * 4 * 6))
    return (b"\xabKTX 11\xbb\r\n\x1a\n" + struct.pack("<13I", 0x04030201, 0x8C3B, 4, 0x1907, 0x8C3A, 0x1907, side, side, 0, 0, 6,
                                                      1, len(key_values)) + key_values + face)


def reply(width, height, channels, decoded, how, extras=b"", more=0):
    head = struct.pack("<IIiiiiII", 0x50524732, decoded, width, height, channels, how, channels == 4, len(extras) + more)
    return b"\x01" + head + bytes(480) + struct.pack("<f", 0.5) * (width * height * channels) + extras


# The first byte chooses the kind of value: one of six techniques' settings, or an option of one of seven kinds.
OPTIONS = ["rain=heavy clip_planes=2", "count=100 wind_m_s=2.5", "model=teapot", "width=32", "drops_m2_s=1e3 time=night",
           "lights=3 shadows=on lights_file=a.json", "12", "1.5", "json", "1280x720", "2-4", "cpu,gl", "seed=7"]

SEEDS = {
    "options": {f"{number:02}": bytes([number]) + text.encode() for number, text in enumerate(OPTIONS)},
    "picture": {
        "rgb.png": png(2, 8, 3), "rgba.png": png(6, 8, 4), "grey.png": png(0, 1, 1), "wide.png": png(2, 16, 3),
        "interlaced.png": png(6, 8, 4, True), "palette.png": palette_png(),
        "half.exr": exr([b"R", b"G", b"B", b"A"], 1, 3), "float.exr": exr([b"Y"], 2, 0),
        "line.exr": exr([b"B", b"G", b"R"], 2, 2), "tiles.exr": exr([b"R", b"G", b"B"], 1, 3, 2),
        "frames.png": png(2, 8, 3, more=chunk(b"acTL", struct.pack(">II", 2, 0)) + chunk(b"fcTL", bytes(26)) + chunk(b"fdAT", bytes(30)) +
                          chunk(b"cICP", b"\x09\x10\0\1") + chunk(b"cHRM", bytes(range(32))) + chunk(b"pHYs", bytes(range(9))) + chunk(b"iCCP", b"") + chunk(b"oFFs", b"")),
        "profile.png": png(6, 8, 4, more=chunk(b"iCCP", b"any\0\0" + zlib.compress(bytes(50))) + chunk(b"gAMA", b"\0\1\x86\xa0") +
                           chunk(b"eXIf", b"MM\0*" + struct.pack(">IHHHIHHI", 8, 1, 0x112, 3, 1, 6, 0, 0)) + chunk(b"oFFs", bytes(range(9)))),
    },
    "caged": {
        "whole.exr": exr([b"V", b"A"], 0, 0, 4), "depth.exr": exr([b"R", b"G", b"B", b"Z"], 2, 0),
        "exposed.hdr": hdr().replace(b"\n\n", b"\nEXPOSURE=2\nCOLORCORR=1 2 1\n\n", 1),
        "flat.hdr": hdr(), "bytes.tif": tiff(), "words.tif": tiff(16, 4), "floats.tif": tiff(32, 1, 3),
        "tiles.tif": tiff(8, 4, 1, True), "signed.tif": tiff(8, 4, 2, True),
    },
    "reply": {"small": reply(3, 2, 3, 0, 1), "codes": reply(4, 4, 4, 1, 1), "wrong": reply(2, 2, 2, 0, 0),
              "extras": reply(2, 2, 1, 0, 2, b"channel Z\tXXH3 1\n!ICC profile\t5 bytes\n"),
              "cut": reply(2, 2, 1, 0, 0, b"channel Z\t1\n", 1), "without end": reply(2, 2, 1, 0, 0, b"a\tb", 0x7fffffff),
              "large": reply(2, 2, 1, 0, 0, b"a\t" + b"b" * (1 << 18))},
    "cube": {"small.ktx": ktx(2), "keys.ktx": ktx(1, struct.pack("<I", 4) + b"a\0b\0")},
}


def main():
    for target, files in SEEDS.items():
        folder = Path(sys.argv[1]) / target
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in files.items():
            (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
