"""The contents of picture files besides their texels: none is ignored."""
import json
import os
import struct
import tempfile
import zlib

import written as w

ONE = w.png()
P3 = struct.pack(">8I", 31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000)
SRGB = struct.pack(">8I", 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000)


def profile(content, level=9):
    return (b"iCCP", b"any\0\0" + zlib.compress(content * 40, level))


def exif(orientation):
    return (b"eXIf", b"MM\0*" + struct.pack(">IHHHIHHI", 8, 1, 0x112, 3, 1, orientation, 0, 0))


def gama(value):
    return (b"gAMA", struct.pack(">I", value))


def alpha_png(x, y, c):
    return w.code(x, y, c) if c < 3 else 128 + x


def beauty(**more):
    return w.Part(w.colours(), **more)


def depth(value):
    return w.Part(w.colours() + [("Z", w.FLOAT, lambda x, y: value * (x + y))])


def named(name, times, value=w.light):
    return w.Part(w.colours(value=lambda x, y, c: times * value(x, y, c)), name=name)


def whole(more):
    """Whole numbers that a float holds, plus `more`."""
    return w.Part(w.colours(w.UINT, lambda x, y, c: 2 ** 24 + 2 * x + more))


INSIDE = (3, 2, 3 + w.WIDE - 1, 2 + w.HIGH - 1)
SCREEN = (0, 0, 19, 14)


def placed(x, y, c):
    return w.light(x - 3, y - 2, c)


def in_screen(x, y, c):
    return placed(x, y, c) if INSIDE[0] <= x <= INSIDE[2] and INSIDE[1] <= y <= INSIDE[3] else 0


def chromaticities(red):
    return w.attribute(b"chromaticities", b"chromaticities", struct.pack("<8f", red, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329))


def aspect(ratio):
    return w.attribute(b"pixelAspectRatio", b"float", struct.pack("<f", ratio))


def turned(orientation, samples=3):
    """A TIFF whose codes are those of `code` after a turn by `orientation`."""
    across, down = orientation in (2, 3), orientation in (3, 4)
    return w.tiff(("B", w.codes(samples, lambda x, y, c: w.code(w.WIDE - 1 - x if across else x, w.HIGH - 1 - y if down else y, c)),
                   {274: (3, [orientation])}))


def tiff(form="B", values=None, **more):
    return w.tiff((form, values or w.codes(), {int(tag[1:]): value for tag, value in more.items()}))


def doubles(more):
    return w.tiff(("d", [n / 256 + more for n in w.codes()], {}))


LONG = w.codes(times=16843009)  # the same shares of the largest code

# Label, endings, two files, status, and the expected difference other than texels, if any.
PAIRS = [
    ("a curve that is linear", "png png", ONE, w.png(before=[gama(100000)]), 1, None),
    ("another power", "png png", w.png(before=[gama(50000)]), w.png(before=[gama(55000)]), 1, None),
    ("sRGB, as many programs say it", "png png", ONE, w.png(before=[gama(45455), (b"cHRM", SRGB)]), 0, None),
    ("sRGB by its chunk, whose place is before gAMA's", "png png", ONE, w.png(before=[gama(100000), (b"sRGB", b"\0")]), 0, None),
    ("a curve of television", "png png", ONE, w.png(before=[(b"cICP", b"\x09\x12\0\1")]), 1, "colours (cICP)"),
    ("sRGB by cICP", "png png", ONE, w.png(before=[(b"cICP", b"\1\x0d\0\1"), gama(100000)]), 0, None),
    ("linear by cICP", "png png", w.png(before=[gama(100000)]), w.png(before=[(b"cICP", b"\1\x08\0\1")]), 0, None),
    ("a profile", "png png", ONE, w.png(before=[profile(b"one")]), 1, "ICC profile"),
    ("another profile", "png png", w.png(before=[profile(b"two")]), w.png(before=[profile(b"one")]), 1, "ICC profile"),
    ("a profile compressed otherwise", "png png", w.png(before=[profile(b"two")]), w.png(before=[profile(b"two", 0)]), 0, None),
    ("other primaries", "png png", ONE, w.png(before=[gama(45455), (b"cHRM", P3)]), 1, "primaries"),
    ("the second frame", "png png", w.apng(3), w.apng(5), 1, "animation"),
    ("an animation and its first frame", "png png", ONE, w.apng(3), 1, "animation"),
    ("pixels that are not square", "png png", ONE, w.png(before=[(b"pHYs", struct.pack(">IIB", 2, 3, 0))]), 1, "pixel aspect ratio"),
    ("square pixels", "png png", ONE, w.png(before=[(b"pHYs", struct.pack(">IIB", 2835, 2835, 1))]), 0, None),
    ("an offset", "png png", ONE, w.png(before=[(b"oFFs", struct.pack(">iiB", -4, 5, 0))]), 1, "offset"),
    ("Exif's orientation", "png png", ONE, w.png(before=[exif(6)]), 1, "orientation (eXIf)"),
    ("Exif that is upright", "png png", ONE, w.png(before=[exif(1)]), 0, None),
    ("words and dates", "png png", ONE, w.png(before=[(b"tEXt", b"Author\0me")], after=[(b"tIME", bytes([7, 234, 1, 1, 1, 1, 1]))]), 0, None),
    ("another compression", "png png", ONE, w.png(level=0), 0, None),
    ("16 bits", "png png", ONE, w.png(depth=16), 0, None),
    ("opaque alpha", "png png", ONE, w.png(4, value=lambda x, y, c: w.code(x, y, c) if c < 3 else 255), 0, None),
    ("alpha that is not opaque", "png png", ONE, w.png(4, value=alpha_png), 1, None),
    ("grey", "png png", w.png(1), w.png(3, value=lambda x, y, c: w.code(x, y, 0)), 0, None),
    ("grey, and a colour", "png png", w.png(1), w.png(3, value=lambda x, y, c: w.code(x, y, c // 2)), 1, None),

    ("halves and floats", "exr exr", w.exr(beauty()), w.exr(w.Part(w.colours(w.FLOAT))), 0, None),
    ("a channel of depth", "exr exr", w.exr(depth(1)), w.exr(depth(2)), 1, "channel Z"),
    ("the same channel of depth", "exr exr", w.exr(depth(1)), w.exr(depth(1)), 0, None),
    ("a channel in one of them", "exr exr", w.exr(beauty()), w.exr(depth(2)), 1, "channel Z"),
    ("a layer", "exr exr", w.exr(beauty()), w.exr(w.Part(w.colours() + [("fog.R", w.HALF, lambda x, y: 0.5)])), 1, "channel fog.R"),
    ("whole numbers beside it", "exr exr", *(w.exr(w.Part(w.colours() + [("id", w.UINT, lambda x, y: 4000000000 + n)])) for n in (1, 2)), 1,
     "channel id"),
    ("whole numbers between floats", "exr exr", w.exr(whole(0)), w.exr(whole(1)), 1, None),
    ("the second part", "exr exr", w.exr(named("a", 1), named("b", 1)), w.exr(named("a", 1), named("b", 0.5)), 1, "part 2"),
    ("the third part, in one of them", "exr exr", w.exr(named("a", 1), named("b", 1)),
     w.exr(named("a", 1), named("b", 1), named("c", 1)), 1, "part 3"),
    ("the same parts", "exr exr", w.exr(named("a", 1), named("b", 0.5)), w.exr(named("a", 1), named("b", 0.5)), 0, None),
    ("names of parts", "exr exr", w.exr(named("a", 1), named("b", 1)), w.exr(named("b", 1), named("a", 1)), 1, "name of part 1"),
    ("one part and several", "exr exr", w.exr(beauty()), w.exr(named("a", 1), named("b", 1)), 1, "part 2"),
    ("a cropped data window", "exr exr", w.exr(w.Part(w.colours(value=in_screen), SCREEN)),
     w.exr(w.Part(w.colours(value=placed), INSIDE, SCREEN)), 0, None),
    ("a cropped window with depth", "exr exr",
     w.exr(w.Part(w.colours(value=in_screen) + [("Z", w.FLOAT, lambda x, y: in_screen(x, y, 0))], SCREEN)),
     w.exr(w.Part(w.colours(value=placed) + [("Z", w.FLOAT, lambda x, y: placed(x, y, 0))], INSIDE, SCREEN)), 0, None),
    ("the place in the display window", "exr exr", w.exr(w.Part(w.colours(value=placed), INSIDE, SCREEN)),
     w.exr(w.Part(w.colours(value=lambda x, y, c: w.light(x - 4, y - 2, c)), (4, 2, 11, 7), SCREEN)), 1, None),
    ("texels outside the display window", "exr exr", w.exr(w.Part(w.colours(value=in_screen), SCREEN)),
     w.exr(w.Part(w.colours(value=lambda x, y, c: in_screen(x, y, c) if x >= 0 else 0.25), (-1, 0, 19, 14), SCREEN)), 1,
     "values outside the display window"),
    ("nothing outside the display window", "exr exr", w.exr(w.Part(w.colours(value=in_screen), SCREEN)),
     w.exr(w.Part(w.colours(value=in_screen), (-2, -1, 21, 15), SCREEN)), 0, None),
    ("the display window's origin", "exr exr", w.exr(beauty()),
     w.exr(w.Part(w.colours(value=lambda x, y, c: w.light(x - 5, y, c)), (5, 0, 5 + w.WIDE - 1, w.HIGH - 1))), 1,
     "origin of the display window"),
    ("other chromaticities", "exr exr", w.exr(beauty()), w.exr(beauty(more=[chromaticities(0.7)])), 1, "primaries"),
    ("those of Rec. 709", "exr exr", w.exr(beauty()), w.exr(beauty(more=[chromaticities(0.64)])), 0, None),
    ("wide pixels", "exr exr", w.exr(beauty()), w.exr(beauty(more=[aspect(2)])), 1, "pixel aspect ratio"),
    ("a comment", "exr exr", w.exr(beauty()), w.exr(beauty(more=[w.attribute(b"comments", b"string", b"none")])), 0, None),

    ("an exposure", "hdr hdr", w.hdr(), w.hdr(lines=["EXPOSURE=2"]), 1, "EXPOSURE"),
    ("exposures that multiply to one", "hdr hdr", w.hdr(), w.hdr(lines=["EXPOSURE=2", "EXPOSURE= 0.5"]), 0, None),
    ("exposures by their product", "hdr hdr", w.hdr(lines=["EXPOSURE=4"]), w.hdr(lines=["EXPOSURE=2", "EXPOSURE=2"]), 0, None),
    ("corrected colours", "hdr hdr", w.hdr(), w.hdr(lines=["COLORCORR= 1 2 1"]), 1, "COLORCORR"),
    ("colours corrected by nothing", "hdr hdr", w.hdr(), w.hdr(lines=["COLORCORR= 1 1 1.0"]), 0, None),
    ("primaries of a monitor", "hdr hdr", w.hdr(), w.hdr(lines=["PRIMARIES= .7 .3 .2 .7 .1 .1 .33 .33"]), 1, "PRIMARIES"),
    ("a command in the head", "hdr hdr", w.hdr(), w.hdr(lines=["rpict -vp 1 2 3", "VIEW= -vtv"]), 0, None),
    ("upside down", "hdr hdr", w.hdr(), w.hdr("+Y 6 +X 8"), 1, None),
    ("upside down, and so stored", "hdr hdr", w.hdr(), w.hdr("+Y 6 +X 8", texel=lambda x, y: (x, 5 - y)), 0, None),
    ("from right to left, and so stored", "hdr hdr", w.hdr(), w.hdr("-Y 6 -X 8", texel=lambda x, y: (7 - x, y)), 0, None),
    ("by columns", "hdr hdr", w.hdr(), w.hdr("+X 8 -Y 6", texel=lambda x, y: (y, x), size=(6, 8)), 0, None),
    ("by columns from the right", "hdr hdr", w.hdr(), w.hdr("-X 8 -Y 6", texel=lambda x, y: (7 - y, x), size=(6, 8)), 0, None),
    ("by columns from below", "hdr hdr", w.hdr(), w.hdr("+X 8 +Y 6", texel=lambda x, y: (y, 5 - x), size=(6, 8)), 0, None),
    ("by columns from the right below", "hdr hdr", w.hdr(), w.hdr("-X 8 +Y 6", texel=lambda x, y: (7 - y, 5 - x), size=(6, 8)), 0, None),

    ("the same codes", "png tif", ONE, tiff(), 0, None),
    ("the same codes of 16 bits", "png tif", ONE, tiff("H", w.codes(times=257)), 0, None),
    ("the same codes, the largest byte first", "png tif", ONE, w.tiff(("H", w.codes(times=257), {}), end=">"), 0, None),
    ("the same codes of 32 bits", "tif tif", tiff("I", LONG), tiff("I", LONG), 0, None),
    ("the last bit of 32", "tif tif", tiff("I", LONG), tiff("I", [n ^ 1 if n else n for n in LONG]), 1, "values between floats"),
    ("doubles", "tif tif", doubles(0.1), doubles(0.1), 0, None),
    ("the last bits of doubles", "tif tif", doubles(0.1), doubles(0.1 + 1e-15), 1, "values between floats"),
    ("doubles that are floats", "tif tif", doubles(0), tiff("f", [n / 256 for n in w.codes()]), 0, None),
    ("halves", "tif tif", tiff("e", [n / 256 for n in w.codes()]), tiff("f", [n / 256 for n in w.codes()]), 0, None),
    ("the second page", "tif tif", *(w.tiff(("B", w.codes(), {}), ("B", w.codes(times=n), {})) for n in (0, 1)), 1, "page 2"),
    ("one page more", "tif tif", tiff(), w.tiff(("B", w.codes(), {}), ("B", w.codes(), {})), 1, "page 2"),
    ("the same pages", "tif tif", *(w.tiff(("B", w.codes(), {}), ("H", w.codes(times=n), {})) for n in (7, 7)), 0, None),
    ("another orientation", "tif tif", tiff(), tiff(t274=(3, [3])), 1, None),
    ("turned round, and so stored", "tif tif", tiff(), turned(3), 0, None),
    ("mirrored, and so stored", "png tif", ONE, turned(2), 0, None),
    ("a transfer function", "tif tif", tiff(), tiff(t301=(3, list(range(256)) * 3)), 1, "curve (TransferFunction)"),
    ("primaries of a TIFF", "tif tif", tiff(), tiff(t319=(5, [(68, 100), (32, 100), (265, 1000), (69, 100), (15, 100), (6, 100)])), 1,
     "primaries"),
    ("a profile of a TIFF", "tif tif", tiff(), tiff(t34675=(1, list(range(200)))), 1, "ICC profile"),
    ("straight and associated alpha", "tif tif", *(tiff(values=w.codes(4, alpha_png), t338=(3, [kind])) for kind in (1, 2)), 1, "alpha"),
    ("opaque alpha, either way", "tif tif", *(tiff(values=w.codes(4, lambda x, y, c: 255 if c == 3 else w.code(x, y, c)), t338=(3, [kind]))
                                              for kind in (1, 2)), 0, None),
    ("associated alpha and a PNG's", "png tif", w.png(4, value=alpha_png), tiff(values=w.codes(4, alpha_png), t338=(3, [1])), 1, "alpha"),
    ("straight alpha and a PNG's", "png tif", w.png(4, value=alpha_png), tiff(values=w.codes(4, alpha_png), t338=(3, [2])), 0, None),
    ("a sample that is no alpha", "tif tif", *(tiff(values=w.codes(4, lambda x, y, c: w.code(x, y, c) + (n if c == 3 else 0) & 255), t338=(3, [0]))
                                               for n in (0, 1)), 1, "channel channel3"),
]

# Loading OpenImageIO takes a third of a second, so only these are tried at every change; `make thorough` tries the others.
QUICK = {"a channel of depth", "whole numbers beside it", "whole numbers between floats", "the second part", "a cropped window with depth",
         "texels outside the display window", "the display window's origin", "exposures that multiply to one", "an exposure",
         "by columns from below", "the same codes of 16 bits", "the last bits of doubles", "doubles that are floats", "the second page",
         "mirrored, and so stored", "straight and associated alpha"}

# Label, ending, file, and a part of the error that refuses it.
REFUSED = [
    ("luminance and chroma", "exr", w.exr(w.Part([(name, w.HALF, lambda x, y: 0.5) for name in ("Y", "RY", "BY")])), "luminance and chroma"),
    ("a subsampled channel", "exr", w.exr(w.Part(w.colours(), sampling=2)), "channel B is subsampled"),
    ("a part of deep data", "exr", w.exr(named("a", 1), w.Part(w.colours(), name="b", kind=b"deepscanline")), "deep data"),
    ("no colours", "exr", w.exr(w.Part([("Z", w.FLOAT, lambda x, y: 1)])), "no channels R, G and B, nor Y"),
    ("doubles beyond floats", "tif", tiff("d", [1e308 if n else n for n in w.codes()]), "a value is 1e+308, and the largest float is 3.4e38"),
    ("L*a*b*", "tif", tiff(t262=(3, [8])), "L*a*b*"),
    ("a page that is cut off", "tif", w.tiff(("B", w.codes(), {}), ("B", w.codes(), {}))[:-100], "page 2 cannot be read"),
    ("a chunk that is damaged", "png", w.png(before=[gama(100000)]).replace(b"gAMA\0\1\x86\xa0", b"gAMA\0\1\x86\xa1"), "CRC error"),
]

# Label, ending, file, and the warning: both files have something that raingauge does not apply.
WARNED = [
    ("a profile", "png", w.png(before=[profile(b"one")]), "ICC profile"),
    ("a curve of television", "png", w.png(before=[(b"cICP", b"\x09\x10\0\1")]), "colours (cICP)"),
    ("primaries", "exr", w.exr(beauty(more=[chromaticities(0.7)])), "primaries"),
]


def put(folder, name, content):
    path = os.path.join(folder, name)
    with open(path, "wb") as file:
        file.write(content)
    return path


def compare(runner, a, b):
    done = runner.run(["diff", a, b, "--json"])
    pair = json.loads(done.stdout)["pairs"][0] if done.stdout.strip() else {"beside": [], "tier": done.stderr}
    return done, pair


def judge(runner, pairs, orders):
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        for label, endings, one, other, status, what in pairs:
            of_a, of_b = endings.split()
            a, b = put(tmp, "a." + of_a, one), put(tmp, "b." + of_b, other)
            for first, second in ((a, b), (b, a))[:orders]:
                done, pair = compare(runner, first, second)
                found = {told["what"] for told in pair["beside"]}
                right = done.returncode == status and (pair["tier"] == "T0") == (status == 0) and (what in found if what else status or not found)
                if not right or (done.stderr and "not applied" not in done.stderr):
                    problems.append("%s: exit status %d, tier %s, %s %s" % (label, done.returncode, pair["tier"], found, done.stderr))
    return problems


def check_pairs(runner):
    """files that look the same are equal, and no other content of them is ignored"""
    return judge(runner, [pair for pair in PAIRS if pair[1] == "png png" or pair[0] in QUICK], 1)


def check_all_pairs(runner):
    """the same for more kinds, and in both orders of files"""
    return judge(runner, PAIRS, 2)


def check_refused(runner):
    """contents that raingauge does not read are refused by name"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        for label, ending, content, words in REFUSED:
            path = put(tmp, "a." + ending, content)
            done = runner.run(["diff", path, path])
            if done.returncode != 2 or done.stdout or words not in done.stderr or done.stderr.count("\n") != 1:
                problems.append("%s: exit status %d, %s" % (label, done.returncode, done.stderr))
    return problems


def check_warned(runner):
    """contents of both files that raingauge does not apply are one warning; those of a single file are a warning, too"""
    problems = []
    with tempfile.TemporaryDirectory() as tmp:
        for label, ending, content, words in WARNED:
            a, b = put(tmp, "a." + ending, content), put(tmp, "b." + ending, content)
            done, pair = compare(runner, a, b)
            if done.returncode or pair["tier"] != "T0" or done.stderr.count("\n") != 1 or words not in done.stderr:
                problems.append("%s: exit status %d, tier %s, %s" % (label, done.returncode, pair["tier"], done.stderr))
        scene = put(tmp, "scene.png", WARNED[0][2])
        done = runner.run("render drops --size 32x32 --frame 0".split() + ["--set", "background=" + scene, "-o", tmp + "/out.png"])
        if done.returncode or "not used: ICC profile" not in done.stderr:
            problems.append("background: exit status %d, %s" % (done.returncode, done.stderr))
        text = runner.run(["diff", put(tmp, "a.exr", w.exr(depth(1))), put(tmp, "b.exr", w.exr(depth(2)))]).stdout
        if "T1 arithmetic                fails: the files differ in channel Z" not in text or "\nthe files differ in\n  channel Z " not in text:
            problems.append("text: " + text)
    return problems


CHECKS = [check_pairs, check_refused, check_warned]
THOROUGH = [check_all_pairs]
