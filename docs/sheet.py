#!/usr/bin/env python3
"""Puts pictures of one size side by side.

sheet.py OUT.png COLUMNS PICTURE.png... : pictures of 8-bit RGB or RGBA as `raingauge render` writes them, row by row, each
at half its size, with a white rim. Needs nothing but Python.
"""
import struct
import sys
import zlib

RIM = 4


def unfiltered(data, width, height, size):
    """The bytes of a PNG's rows, without their filters."""
    rows, before, step = [], bytes(width * size), width * size + 1
    for y in range(height):
        kind, row = data[y * step], bytearray(data[y * step + 1:(y + 1) * step])
        for i, value in enumerate(row):
            left = row[i - size] if i >= size else 0
            above, corner = before[i], before[i - size] if i >= size else 0
            if kind == 4:
                guess = left + above - corner
                off = [(abs(guess - near), k) for k, near in enumerate((left, above, corner))]
                value += (left, above, corner)[min(off)[1]]
            else:
                value += (0, left, above, (left + above) // 2)[kind]
            row[i] = value & 255
        rows.append(row)
        before = row
    return rows


def read(path):
    """A PNG's rows of RGB bytes."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed, size = 8, b"", 0
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
            size = {2: 3, 6: 4}.get(colours, 0)
            if depth != 8 or not size:
                sys.exit(f"sheet.py: {path}: is not of 8-bit RGB; render it as PNG")
        if kind == b"IDAT":
            packed += body
        at += length + 12
    rows = unfiltered(zlib.decompress(packed), width, height, size)
    return [bytes(row[i] for i in range(len(row)) if i % size < 3) for row in rows]


def halved(rows):
    """The mean of each four pixels, in steps of 4 codes, which take half the space."""
    return [bytes(min((a[i] + a[i + 3] + b[i] + b[i + 3] + 8) // 16 * 4, 252)
                  for x in range(0, len(a) - 5, 6) for i in range(x, x + 3))
            for a, b in zip(rows[::2], rows[1::2])]


def filtered(rows):
    """Each row less the one above, which suits skies, or less its left neighbours."""
    out, before = b"", bytes(len(rows[0]))
    for row in rows:
        up = bytes((a - b) & 255 for a, b in zip(row, before))
        sub = row[:3] + bytes((a - b) & 255 for a, b in zip(row[3:], row))
        cost = [sum(min(v, 256 - v) for v in kind) for kind in (sub, up)]
        out += b"\2" + up if cost[1] <= cost[0] else b"\1" + sub
        before = row
    return out


def write(path, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                   + chunk(b"IDAT", zlib.compress(filtered(rows), 9)) + chunk(b"IEND", b""))


def main():
    out, columns, paths = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    pictures = [halved(read(path)) for path in paths]
    side, rows = b"\xff" * 3 * RIM, []
    for first in range(0, len(pictures), columns):
        line = pictures[first:first + columns]
        rows += [side + side.join(p[y] for p in line) + side for y in range(len(line[0]))]
        rows += [b"\xff" * len(rows[0])] * RIM
    write(out, [b"\xff" * len(rows[0])] * RIM + rows)


if __name__ == "__main__":
    main()
