#!/usr/bin/env python3
"""Writes the binary seeds of the fuzz targets of meshes into a folder: `seeds.py FOLDER`.

They are generated, not stored, so that the corpus can be read. Each is one triangle or two.
"""
import struct
import sys
from pathlib import Path

CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 1, 2), (0, 3, 1)]


def ply():
    header = ("ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
              "property float y\nproperty float z\nelement face 2\n"
              "property list uchar int vertex_indices\nend_header\n")
    return (header.encode() + b"".join(struct.pack("<3f", *c) for c in CORNERS) +
            b"".join(struct.pack("<B3i", 3, *f) for f in FACES))


def stl():
    facets = (struct.pack("<12fH", 0, 0, 0, *(x for i in f for x in CORNERS[i]), 0) for f in FACES)
    return b"STL".ljust(80) + struct.pack("<I", len(FACES)) + b"".join(facets)


def chunk(kind, content):
    return struct.pack("<HI", kind, 6 + len(content)) + content


def three_ds():
    vertices = struct.pack("<H", 4) + b"".join(struct.pack("<3f", *c) for c in CORNERS)
    faces = struct.pack("<H", 2) + b"".join(struct.pack("<4H", *f, 0) for f in FACES)
    mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces))
    return chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"m\0" + mesh)))


def glb():
    scene = (b'{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],'
             b'"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView"'
             b':0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,'
             b'"byteLength":36}],"buffers":[{"byteLength":36}]}')
    scene += b" " * (-len(scene) % 4)
    data = b"".join(struct.pack("<3f", *c) for c in CORNERS[:3])
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(scene) + len(data)) +
            struct.pack("<I4s", len(scene), b"JSON") + scene +
            struct.pack("<I4s", len(data), b"BIN\0") + data)


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in {"two.ply": ply, "two.stl": stl, "two.3ds": three_ds, "one.glb": glb}.items():
        (folder / name).write_bytes(make())


if __name__ == "__main__":
    main()
