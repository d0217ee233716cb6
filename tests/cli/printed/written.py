"""Small picture files, written byte by byte: PNG, EXR, HDR and TIFF, with their contents besides texels."""
import struct
import zlib

WIDE, HIGH = 8, 6


def code(x, y, c):
    """A code of a picture without symmetry."""
    return (x * 29 + y * 41 + c * 67 + x * y * 5) % 256


def chunk(name, content):
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def png(samples=3, depth=8, before=(), after=(), value=code, level=9):
    """`before` and `after` the rows: chunks as (name, content). `value`: a function of x, y and channel."""
    kind = {1: 0, 2: 4, 3: 2, 4: 6}[samples]
    form, times = (">B", 1) if depth == 8 else (">H", 257)
    rows = b"".join(b"\0" + b"".join(struct.pack(form, times * value(x, y, c)) for x in range(WIDE) for c in range(samples))
                    for y in range(HIGH))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDE, HIGH, depth, kind, 0, 0, 0)) +
            b"".join(chunk(*one) for one in before) + chunk(b"IDAT", zlib.compress(rows, level)) +
            b"".join(chunk(*one) for one in after) + chunk(b"IEND", b""))


def apng(seed):
    """Two frames; the second depends on `seed`."""
    def control(number):
        return struct.pack(">5IHHBB", number, WIDE, HIGH, 0, 0, 1, 10, 0, 0)

    second = zlib.compress(b"".join(b"\0" + bytes((seed * x + y) % 256 for x in range(3 * WIDE)) for y in range(HIGH)))
    return png(before=[(b"acTL", struct.pack(">II", 2, 0)), (b"fcTL", control(0))],
               after=[(b"fcTL", control(1)), (b"fdAT", struct.pack(">I", 2) + second)])


UINT, HALF, FLOAT = 0, 1, 2
FORMS = {UINT: "<I", HALF: "<e", FLOAT: "<f"}


def attribute(name, of, content):
    return name + b"\0" + of + b"\0" + struct.pack("<I", len(content)) + content


def light(x, y, c):
    """A value of a picture, exact as a half."""
    return code(x, y, c) / 256


class Part:
    """Channels are (name, type, function of x and y), windows (left, top, right, bottom), both inclusive."""

    def __init__(self, channels, data=(0, 0, WIDE - 1, HIGH - 1), display=None, more=(), name=None, sampling=1, kind=b"scanlineimage"):
        self.channels, self.data, self.display = sorted(channels), data, display or data
        self.more, self.name, self.sampling, self.kind = list(more), name, sampling, kind

    def header(self):
        listed = b"".join(name.encode() + b"\0" + struct.pack("<IIii", kind, 0, self.sampling, self.sampling)
                          for name, kind, _ in self.channels) + b"\0"
        fields = [attribute(b"channels", b"chlist", listed), attribute(b"compression", b"compression", b"\0"),
                  attribute(b"dataWindow", b"box2i", struct.pack("<4i", *self.data)),
                  attribute(b"displayWindow", b"box2i", struct.pack("<4i", *self.display)),
                  attribute(b"lineOrder", b"lineOrder", b"\0"), attribute(b"screenWindowCenter", b"v2f", bytes(8)),
                  attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)), *self.more]
        if not any(field.startswith(b"pixelAspectRatio") for field in self.more):
            fields.append(attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)))
        if self.name:
            fields += [attribute(b"name", b"string", self.name.encode()), attribute(b"type", b"string", self.kind),
                       attribute(b"chunkCount", b"int", struct.pack("<i", len(self.lines())))]
        return b"".join(fields) + b"\0"

    def lines(self):
        left, top, right, bottom = self.data
        return [struct.pack("<i", y) + struct.pack("<I", len(row)) + row for y in range(top, bottom + 1)
                for row in [b"".join(struct.pack(FORMS[kind], value(x, y)) for _, kind, value in self.channels
                                     for x in range(left, right + 1))]]


def exr(*parts):
    """An EXR without compression, of one part or of several."""
    several = len(parts) > 1
    head = struct.pack("<II", 20000630, 2 | (0x1000 if several else 0)) + b"".join(part.header() for part in parts)
    head += b"\0" if several else b""
    at, table, body = len(head) + 8 * sum(len(part.lines()) for part in parts), b"", b""
    for number, part in enumerate(parts):
        for line in part.lines():
            table += struct.pack("<Q", at + len(body))
            body += (struct.pack("<i", number) if several else b"") + line
    return head + table + body


def colours(kind=HALF, value=light, alpha=None):
    """Channels R, G and B, and A if `alpha` is a function of x and y."""
    made = [(name, kind, lambda x, y, c=c: value(x, y, c)) for c, name in enumerate("RGB")]
    return made + ([("A", kind, alpha)] if alpha else [])


def hdr(resolution="-Y %d +X %d" % (HIGH, WIDE), lines=(), texel=lambda x, y: (x, y), size=(WIDE, HIGH)):
    """An uncompressed HDR. `texel`: which of the picture's texels is at a column and a line of the file."""
    head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + "".join(line + "\n" for line in lines) + "\n" + resolution + "\n"
    places = [texel(x, y) for y in range(size[1]) for x in range(size[0])]
    return head.encode() + b"".join(bytes([128 + code(x, y, c) // 2 for c in range(3)] + [129]) for x, y in places)


SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 12: 8, 13: 4}


def tiff(*pages, end="<"):
    """Each page: (form of values such as "B", values in rows, {tag: (type, [values])}). Later tags replace those of a page."""
    out, link = (b"II*\0" if end == "<" else b"MM\0*") + bytes(4), 4
    for form, values, more in pages:
        samples = len(values) // (WIDE * HIGH)
        data = struct.pack(end + "%d%s" % (len(values), form), *values)
        bits = 8 * struct.calcsize(end + form)
        tags = {256: (3, [WIDE]), 257: (3, [HIGH]), 258: (3, [bits] * samples), 259: (3, [1]), 262: (3, [2 if samples > 2 else 1]),
                273: (4, [len(out)]), 277: (3, [samples]), 278: (3, [HIGH]), 279: (4, [len(data)]), 284: (3, [1]),
                339: (3, [3 if form in "efd" else 1] * samples)}
        tags.update(more)
        out += data + bytes(len(data) % 2)
        fields = b""
        for tag, (kind, numbers) in sorted(tags.items()):
            packed = b"".join(struct.pack(end + {1: "B", 3: "H", 4: "I", 5: "II"}[kind], *(n if kind == 5 else [n])) for n in numbers)
            fields += struct.pack(end + "HHI", tag, kind, len(numbers))
            if len(packed) > 4:
                fields += struct.pack(end + "I", len(out))
                out += packed + bytes(len(packed) % 2)
            else:
                fields += packed.ljust(4, b"\0")
        out = out[:link] + struct.pack(end + "I", len(out)) + out[link + 4:]
        out += struct.pack(end + "H", len(tags)) + fields
        link = len(out)
        out += bytes(4)
    return out


def codes(samples=3, value=code, times=1):
    return [times * value(x, y, c) for y in range(HIGH) for x in range(WIDE) for c in range(samples)]
