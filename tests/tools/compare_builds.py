#!/usr/bin/env python3
"""Runs the same commands with two builds of raingauge and compares their outputs and files byte for byte.

    compare_builds.py OLD_BINARY NEW_BINARY [--only PATTERN] [--keep FOLDER]
    compare_builds.py --list [--only PATTERN]

For changes without effect: standard output and error, exit statuses and files must be the same, except where the masks
below allow differences. Prints a line for each case, and a sum. Exits with 0 if all are the same, 1 if any differs, 2 on bad
usage. PATTERN is a regular expression that finds cases by name. With --keep, OLD's outputs are kept in FOLDER and read
from there the next time, so that only NEW runs. Some minutes a build; a cold driver's cache or streak atlas adds more.
"""
import argparse
import collections
import hashlib
import itertools
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

# --- masks: values that differ between two runs of one build, or between any two builds. All others are compared. ---

# Lines of JSON that older builds lack: they are ignored.
ADDED = (
    (r'(?m)^ *"program": "[0-9a-f]{40}",\n', "the passport names the program by its content since records can be read"),
    (r'(?ms)^ "technique": [^\n]*\n "size_px": .*?^ "note": [^\n]*\n', "a table tells what it is since results can be read"),
    (r'(?m)^   "row_number": \d+,\n', "likewise the number of a row"),
    (r'(?m)^ *"tally": (?:null|\{[^}]*\}),\n', "cells tell the exact work of a frame since devices can be asked to count"),
)

# In JSON, by the end of the path of keys: numbers, strings and booleans become "#", also in an object below the key,
# whose own keys stay. An array becomes one "#". null stays null, because a missing time must stay missing.
JSON_MASKS = {
    "passport.raingauge.commit": "the commit",
    "seconds": "a time (atlas)",
    "timer": "times (doctor)",
    "ceilings": "rates, from times (doctor)",
    "measured.fps": "from a time (table), as all below",
    "measured.ms": "a time",
    "measured.ms_low": "a time",
    "measured.ms_high": "a time",
    "measured.create_ms": "a time",
    "measured.first_frame_ms": "a time",
    "measured.api_over_wall": "a ratio of times",
    "measured.frames_a_sample": "as many as fill a sample's time",
    "measured.samples_ms": "times, and as many as fit into the time that a cell may take",
    "measured.pass_frames": "as many as fit into a time",
    "measured.passes_ms": "times",
    "measured.passes_share": "ratios of times",
    "shapes.verdict": "of the order of times",
    "shapes.same_ranking": "of the order of times",
    "shapes.pairs_in_order": "of the order of times",
    "shapes.slope": "of times",
}
# In tables as CSV, Markdown and LaTeX, by the column's name: a cell with a digit becomes "#". A cell without one, such as
# a status instead of a time, stays.
COLUMN_MASKS = {
    "fps": "from a time",
    "ms": "a time",
    "ms, 95 %": "times",
    "fps / published": "from a time",
    "x cpu:reference": "a ratio of times",
    "first frame ms": "a time",
    "API / wall clock": "a ratio of times",
    "passes, synced": "shares of a time, and in their order",
}
# In all other text: a regular expression, its replacement, the reason.
TEXT_MASKS = (
    (r"medians of \d+( to \d+)? samples", "medians of # samples", "as many as fit into a time"),
    (r"(Shape on .*?): (reproduced|trend only|same order|not reproduced)\. fps (keeps|does not keep) the published order "
     r"\(\d+ of", r"\1: # (# of", "of the order of times"),
    (r"to the power -?[\d.]+, published", "to the power #, published", "of times"),
    (r"atlas, (\w+) in [\d.]+ s;", r"atlas, \1 in # s;", "a time (atlas)"),
    (r"raingauge: the streak atlas is made, .*\n", "", "only who comes first makes the atlas; the next find it in the cache"),
)
# In TIFF files the date of writing. (The case's folder and the binary's are replaced by names, see capture. Cells of
# Markdown lose their padding, which depends on the widest number.)
TIFF_DATE = re.compile(rb"\d{4}:\d\d:\d\d \d\d:\d\d:\d\d\0")

# --- cases ---

# commands: run one after the other in one folder, which is empty except for `inputs` (name: text). exit: the last one's
# expected exit status; any other is reported, because the case may then prove nothing.
Case = collections.namedtuple("Case", "name commands exit env inputs", defaults=(0, {}, {}))

DEVICES = ("cpu", "cpu:reference", "gl", "vulkan", "opencl")
LEVELS = ("plain", "v2", "v3")
NO_DRIVERS = {"VK_DRIVER_FILES": "/nonexistent", "OCL_ICD_VENDORS": "/nonexistent",
              "__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"}
LIGHTS = {"lights.json": """{"lights": [
  {"type": "sun", "direction": [-0.5, -0.7, -0.4], "colour": [0.9, 0.8, 0.7]},
  {"type": "spot", "position_m": [10, 20, -122], "direction": [0, -1, 0], "colour": [1, 0.7, 0.3], "intensity": 40,
   "inner_deg": 35, "outer_deg": 60},
  {"type": "point", "position_m": [6, 14, -124], "colour": [0.2, 0.4, 1], "intensity": 10}],
 "sky": {"colour": [0.3, 0.34, 0.4]}}
"""}

TOWN = "spectrum=off atlas=small city=small depth_map_px=256 shadow_map_px=128 "
# technique, name, settings, size, frames, file
RENDERS = (
    ("flow", "box", "environment_px=64 resolution_px=96", "96x96", 20, "a.png"),
    ("flow", "mirror", "move=paper panes=mirror environment=sky environment_px=64 resolution_px=128 run_on=on direction=split "
     "reach_texels=4 pane_roll_deg=20 spin_yaw_deg_s=30 reflectivity=0.7", "128x72", 30, "a.exr"),
    ("flow", "pane", "view=pane environment_px=128 resolution_px=160 drops=400 pane_rain_mm_h=500 contact_deg=75 "
     "refraction_strength=0.8 drop_radius_max_mm=6", "160x90", 25, "a.exr"),
    ("flow", "normals", "move=paper view=pane panes=mirror stage=normals resolution_px=64 capacity=3 seed=7", "64x64", 15, "a.png"),
    ("flow", "model", "model=armadillo model_faces=5000 model_sides=both model_size=0.8 drop_shadow=0.7 glow=0.4 "
     "glow_threshold=0.5 light=2 texels_a_pixel=1 resolution_px=256 environment_px=32 camera_azimuth_deg=-40 "
     "camera_elevation_deg=35 frame_mm=4", "100x100", 10, "a.exr"),
    ("raster", "billboards", "billboards=100000 wind_m_s=2 opacity=0.8", "160x90", 3, "a.png"),
    ("raster", "mesh", "scene=mesh count=on view=3 turn_deg=5", "128x96", 2, "a.exr"),
    ("raster", "inside", "scene=mesh model=torus faces=3000 inside=1 near=0.3 depth=test blend=over", "96x96", 1, "a.png"),
    ("raster", "triangles", "scene=triangles triangles=30000 cull=front format=rgba32f zoom=2 shift_px=7", "128x96", 2, "a.exr"),
    ("raster", "quads", "scene=quads quads=300 blend=add format=rgba8 share=0.7 count=on seed=5", "128x72", 4, "a.png"),
    ("streaks", "day", TOWN + "streak_gain=4 streak_opacity=3", "160x90", 5, "a.png"),
    ("streaks", "night", TOWN + "time=night lights=6 camera=second splash_materials=on streak_gain=20 streak_opacity=3 "
     "splash_gain=4 taps=4 packets=quad packet_size=3000 drops_m2_s=100 rain_width_m=200 rain_depth_m=200 select=hull",
     "160x90", 8, "a.exr"),
    ("streaks", "far", TOWN + "camera=free geometry=off far_layers=4 slant_deg=25 slant_azimuth_deg=40 packets=kd "
     "packet_size=700 drops_m2_s=200 rain_width_m=90 rain_depth_m=90 cull=exact order=id depth_map=dynamic "
     "depth_map_period=3 walk_m_s=20 taps=8 view_below=absolute streak_gain=30 streak_opacity=15", "128x72", 10, "a.exr"),
    ("streaks", "overlay", TOWN + "overlay=on lights=4 time=night local_height_m=8 culling_radius_m=12 shadows=off",
     "160x90", 4, "a.png"),
    # a mesh is as large as the city, so the camera is moved away
    ("streaks", "mesh", TOWN + "scene=bunny lights_file=lights.json limits=off packets=world blocks=all drops_m2_s=3 "
     "camera=free eye_x_m=10 eye_y_m=12 eye_z_m=-130 target_y_m=20 streak_gain=50 streak_opacity=20 splash_gain=2 "
     "environment_light=off", "128x72", 6, "a.exr"),
)


def sets(settings):
    return "".join("--set %s " % setting for setting in settings.split())


def render_command(render, device):
    technique, _, settings, size, frames, file = render
    return "render %s %s--size %s --frame %d --device %s -o %s --json" % (
        technique, sets(settings), size, frames, device, file)


def render_cases():
    for render in RENDERS:
        inputs = LIGHTS if "lights_file" in render[2] else {}
        for device in DEVICES:
            yield Case("render %s %s %s" % (*render[:2], device), (render_command(render, device),), inputs=inputs)
        if render[1] in ("model", "triangles", "night"):
            for level in LEVELS:
                yield Case("render %s %s cpu level %s" % (*render[:2], level), (render_command(render, "cpu"),),
                           env={"RG_CPU_LEVEL": level}, inputs=inputs)


FLOW = sets("environment_px=64 resolution_px=96") + "--size 96x96 "
TINY = "render flow " + sets("environment=sky environment_px=16 resolution_px=32 model=none") + "--size 32x32 --frame 1 "
RAIN = "render streaks --size 32x18 --frame 1 " + sets(TOWN)
FIT = sets("fit=on rain_width_m=60 rain_depth_m=60 rain_height_m=40 camera=free drops_m2_s=60 streak_gain=20")

OTHERS = (
    # render: its files, its report, its errors
    Case("render formats", (TINY + "-o a.png", TINY + "-o a.exr", TINY + "-o a.hdr", TINY + "-o a.tif")),
    Case("render exposure", (TINY + "--exposure 2.5 --device cpu -o a.png",)),
    Case("render density map", (TINY + "-o map.png", "render streaks " + sets(TOWN + "density_map=map.png packets=quad "
         "drops_m2_s=30 streak_gain=8") + "--size 96x54 --frame 3 -o a.exr --json")),
    Case("render fit", (RAIN + FIT + "-o a.exr --json",)),
    Case("render defaults", ("render streaks --size 192x108 --frame 4 -o a.exr --json",)),

    # lists and helps
    *(Case("help " + command, (command + " --help",)) for command in
      ("doctor", "list", "render", "table", "diff", "verify", "atlas")),
    Case("help", ("--help",)),
    Case("version", ("--version",)),
    *(Case("list " + what, ("list " + what, "list %s --json" % what)) for what in
      ("techniques", "tables", "devices", "params flow", "params raster", "params streaks")),
    Case("list devices, no drivers", ("list devices", "list devices --json"), env=NO_DRIVERS),

    # atlas: made again, in a cache of its own
    Case("atlas", ("atlas --quick --json", "atlas --quick -o out"), env={"XDG_CACHE_HOME": "{tmp}/cache"}),

    # diff
    Case("diff flow", ("diff flow --frame 4 --json -o heat " + FLOW, "diff flow --frame 4 --device cpu,gl " + FLOW)),
    Case("diff raster", ("diff raster --frame 3 --size 96x54 --json",)),
    Case("diff streaks", ("diff streaks --frame 3 --size 96x54 --json " + sets(TOWN),)),
    Case("diff png", (TINY + "-o a.png", TINY + "--set drops=20 -o b.png", "diff a.png b.png --json -o heat"), 1),
    Case("diff exr", (TINY + "-o a.exr", TINY + "--exposure 2 --frame 9 -o b.exr", TINY + "--set drops=0 -o dry.exr",
                      "diff a.exr b.exr --background dry.exr", "diff a.exr a.exr --json")),

    # verify
    Case("verify flow", ("verify flow --frame 3 --json " + FLOW,)),
    Case("verify raster", ("verify raster --frame 2 --size 96x54 --json",)),
    # after so few steps the third pose shows no rain, which verify calls a failure; the other poses pass
    Case("verify streaks", ("verify streaks --frame 10 --size 96x54 --device cpu --json",), 1),

    # table
    Case("table forms", ("table stuppacher-2 --quick --rows 1-2 --device cpu,cpu:reference -o out",)),
    Case("table json", ("table stuppacher-1 --quick --rows 2-2 --device cpu,gl --json",)),
    Case("table csv", ("table raster-1 --quick --rows 1-1 --device cpu,opencl --format csv",)),
    Case("table textures", ("table creus-5.1 creus-5.2 --quick --device cpu --format tex",)),
    Case("table errors", ("table creus-5.6 --quick --rows 1-1 --device cpu --json",)),

    # doctor
    Case("doctor", ("doctor --json",)),

    # missing things
    *(Case("absent " + device, (TINY + "--device %s -o a.png" % device,), 77, NO_DRIVERS) for device in DEVICES[2:]),
    Case("absent original database", (RAIN + "--set atlas=cave -o a.png",), 2, {"XDG_CACHE_HOME": "/proc/none"}),
)

# refused input: one line and exit status 2
REFUSALS = (
    "", "nonsense", "list", "list nonsense", "list params nonsense", "list devices twice", "render", "render flow flow",
    TINY + "--device nonsense -o a.png", TINY + "--device cpu:nonsense -o a.png", TINY + "--device cpu,gl -o a.png",
    TINY + "--set nonsense=1 -o a.png", TINY + "--set drops=-1 -o a.png", TINY + "--set panes=wood -o a.png",
    TINY + "--size 0x5 -o a.png", TINY + "--frame x -o a.png", TINY + "--exposure nan -o a.png", TINY + "-o a.png -z",
    TINY + "-o none/a.png", TINY + "-o a.nonsense", TINY + "--set model=nonsense -o a.png",
    TINY + "--set environment=/nonexistent.exr -o a.png", TINY + "--set model=sphere --set model_faces=1 -o a.png",
    RAIN + "--set drops_m2_s=1e9 -o a.png", RAIN + "--set culling_radius_m=5000 -o a.png",
    RAIN + "--set lights=17 -o a.png", RAIN + "--set lights_file=/nonexistent.json -o a.png",
    RAIN + FIT + "--set limits=off -o a.png", "table nonsense", "table --rows 3-2", "table stuppacher-2 --rows 9-9 --device cpu",
    "table --format nonsense", "table --set drops=1", "diff flow --device cpu", "diff none.png none.png",
    "verify flow --quick --full", "verify flow --frame -1", "atlas --from /nonexistent", "doctor cpu",
)


def all_cases():
    cases = list(render_cases()) + list(OTHERS)
    for command in REFUSALS:
        short = command.replace(TINY, "flow ").replace(RAIN, "rain ").replace(FIT, "fit ").replace(" -o a.png", "")
        cases.append(Case("refusal: " + (short or "no command"), (command,), 2))
    return cases


# --- running ---

# Variables that change the behaviour of raingauge or drivers; cases set those that they need.
CHANGES = re.compile(r"^(RG_|LP_|OMP_|GOMP_|POCL_|VK_|MESA_|GALLIUM|GALLIVM|LIBGL_|EGL_|__EGL_|OCL_|LD_)")
LIMIT_S = 600
TEXT_FORMS = (".txt", ".json", ".csv", ".md", ".tex", ".status")


def form_of(command):
    """The format of a command's output, as a file's ending."""
    named = re.search(r"--format (\w+)", command)
    if "--json" in command:
        return "json"
    return named.group(1) if named else "md" if command.startswith("table") else "txt"


def variables(case, tmp):
    kept = {name: value for name, value in os.environ.items() if not CHANGES.match(name)}
    kept.update({"LC_ALL": "C", "XDG_STATE_HOME": tmp + "/state"})
    kept.update({name: value.replace("{tmp}", tmp) for name, value in case.env.items()})
    return kept


def files_below(folder):
    """The contents of the folder's files, by path."""
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = file.read()
    return found


def capture(binary, case):
    """Everything that the case prints and writes, by name; None if it takes too long. The two folders are replaced by names."""
    outputs = {"commands.txt": describe(case).encode()}
    with tempfile.TemporaryDirectory(prefix="compare_builds.") as tmp:
        here = os.path.join(tmp, "here")
        os.mkdir(here)
        for name, text in case.inputs.items():
            with open(os.path.join(here, name), "w", encoding="utf-8") as file:
                file.write(text)
        for k, command in enumerate(case.commands, 1):
            try:
                done = subprocess.run([binary] + command.split(), env=variables(case, tmp), cwd=here, check=False,
                                      stdin=subprocess.DEVNULL, capture_output=True, timeout=LIMIT_S)
            except subprocess.TimeoutExpired:
                return None
            outputs["%d.stdout.%s" % (k, form_of(command))] = done.stdout
            outputs["%d.stderr.txt" % k] = done.stderr
            outputs["%d.status" % k] = b"%d\n" % done.returncode
        outputs.update(("files/" + name, content) for name, content in files_below(here).items())
        for name in outputs:
            if name.endswith(TEXT_FORMS):
                outputs[name] = outputs[name].replace(tmp.encode(), b"{tmp}").replace(
                    os.path.dirname(binary).encode(), b"{binary}")
    return outputs


def describe(case):
    lines = ["%s=%s" % item for item in sorted(case.env.items())]
    lines += ["%s: %s" % item for item in sorted(case.inputs.items())]
    return "\n".join(lines + ["raingauge " + command for command in case.commands]) + "\n"


# --- keeping ---

def folder_of(keep, case):
    return os.path.join(keep, re.sub(r"[^\w.-]+", "_", case.name))


def keep_is_of(keep, binary):
    """Makes the folder, or checks that its outputs are this binary's, since another's would be compared unnoticed."""
    with open(binary, "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest() + "\n"
    path = os.path.join(keep, "binary.sha256")
    os.makedirs(keep, exist_ok=True)
    if not os.path.exists(path):
        with open(path, "w", encoding="ascii") as file:
            file.write(digest)
    with open(path, encoding="ascii") as file:
        return file.read() == digest


def read_kept(keep, case):
    """OLD's stored outputs, if the case has not changed since."""
    outputs = files_below(folder_of(keep, case))
    return outputs if outputs.get("commands.txt") == describe(case).encode() else None


def write_kept(keep, case, outputs):
    """Writes under another name and renames, so that an incomplete folder of an interrupted run is never read."""
    whole = folder_of(keep, case)
    part = whole + ".part"
    shutil.rmtree(part, ignore_errors=True)
    for name, content in outputs.items():
        path = os.path.join(part, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content)
    shutil.rmtree(whole, ignore_errors=True)
    os.rename(part, whole)


def capture_old(binary, case, keep):
    outputs = read_kept(keep, case) if keep else None
    if outputs is None:
        outputs = capture(binary, case)
        if keep and outputs is not None:
            write_kept(keep, case, outputs)
    return outputs


# --- masking ---

JSON_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\],:]|[^\s{}\[\],:"]+|\s+|"')


def is_masked(path):
    dotted = ".%s." % ".".join(filter(None, path))
    return any(".%s." % mask in dotted for mask in JSON_MASKS)


def mask_json(text):
    for line, _ in ADDED:
        text = re.sub(line, "", text)
    return mask_tokens(text)


def mask_tokens(text):
    """Masks token by token, so that spaces and unmasked digits stay as printed."""
    out, brackets, path, key, expects_key = [], [], [], "", False
    for token in JSON_TOKEN.findall(text):
        if brackets[-1:] == ["["] and is_masked(path) and token != "]":
            out += ["#"] if out[-1] == "[" and not token.isspace() else []
        elif token in ("{", "["):
            out.append(token)
            brackets.append(token)
            path.append(key)
            key, expects_key = "", token == "{"
        elif token in ("}", "]") and brackets:
            out.append(token)
            brackets.pop()
            key, expects_key = path.pop(), False
        elif token in (",", ":") or token.isspace():
            out.append(token)
            expects_key = expects_key or token == "," and brackets[-1:] == ["{"]
        elif expects_key:
            out.append(token)
            key, expects_key = token.strip('"'), False
        else:
            out.append("#" if is_masked(path + [key]) and token != "null" else token)
    return "".join(out)


def mask_text(text):
    for found, instead, _ in TEXT_MASKS:
        text = re.sub(found, instead, text)
    return text


def mask_cells(header, cells):
    """Masks a row by its header; returns it unchanged if it has another number of columns."""
    if len(header) != len(cells):
        return cells
    return ["#" if name in COLUMN_MASKS and re.search(r"\d", cell) else cell for name, cell in zip(header, cells)]


def mask_table(text, split, join, name_of):
    """Masks each table, lines that `split` into cells, by its first line, up to an empty line; other lines are text."""
    out, header = [], None
    for line in text.split("\n"):
        cells = split(line)
        if cells is None:
            header = header if line else None
            out.append(mask_text(line))
        elif header is None:
            header = [name_of(cell) for cell in cells]
            out.append(join(cells))
        else:
            out.append(join(mask_cells(header, cells)))
    return "\n".join(out)


def split_csv(line):
    """Splits at commas outside quotes, which are followed by an even number of quotes."""
    return re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', line) if line else None


def split_md(line):
    """Splits and removes the padding: spaces, or dashes under the header."""
    if not line.startswith("|"):
        return None
    return [re.sub("-+", "-", cell) if set(cell) <= set("-:") else cell.strip() for cell in line.split("|")]


def split_tex(line):
    return line[:-len(r" \\")].split(" & ") if line.endswith(r" \\") else None


MASKS = {
    ".json": mask_json,
    ".csv": lambda text: mask_table(text, split_csv, ",".join, lambda cell: cell.strip('"')),
    ".md": lambda text: mask_table(text, split_md, "|".join, str),
    ".tex": lambda text: mask_table(text, split_tex, " & ".join, lambda cell: cell.replace("\\", "")),
    ".txt": mask_text,
}


def masked(name, content):
    form = os.path.splitext(name)[1]
    if form in MASKS:
        text = content.decode("utf-8", "surrogateescape")
        return MASKS[form](text).encode("utf-8", "surrogateescape")
    return TIFF_DATE.sub(b"#", content) if form == ".tif" else content


# --- comparing ---

def first_unlike(old, new):
    return next((k for k, (a, b) in enumerate(zip(old, new)) if a != b), min(len(old), len(new)))


def show_lines(*pair):
    """Shortens two lines (None: after the last one) to the text around their first difference."""
    start = max(first_unlike(*(line or b"" for line in pair)) - 60, 0)
    for line in pair:
        text = (line or b"").decode("utf-8", "replace").strip() if start == 0 else line[start:].decode("utf-8", "replace")
        yield "(end)" if line is None else "'%s%s%s'" % ("..." * (start > 0), text[:120], "..." * (len(text) > 120))


def first_difference(name, old, new):
    """The place of the first difference between two contents: a line of text, or a byte of anything else."""
    if name.endswith(TEXT_FORMS):
        pairs = enumerate(itertools.zip_longest(old.split(b"\n"), new.split(b"\n")), 1)
        line, pair = next((k, pair) for k, pair in pairs if pair[0] != pair[1])
        return "%s, line %d: old %s, new %s" % (name, line, *show_lines(*pair))
    place = first_unlike(old, new)
    return "%s, byte %d of %d and %d: old %s, new %s" % (
        name, place, len(old), len(new), old[place:place + 8].hex() or "(end)", new[place:place + 8].hex() or "(end)")


def compare(old, new):
    """The first difference between two builds' outputs, or None."""
    if old is None or new is None:
        return "%s ran past %d s" % ("old" if old is None else "new", LIMIT_S)
    for name in sorted(set(old) | set(new), key=lambda name: ("stderr" not in name, name)):  # messages tell most
        if name not in old or name not in new:
            return "%s: only %s has it" % (name, "old" if name in old else "new")
        contents = [masked(name, outputs[name]) for outputs in (old, new)]
        if contents[0] != contents[1]:
            return first_difference(name, *contents)
    return None


def run_case(case, options):
    """Runs the case, prints its line, and returns whether both builds did the same."""
    start = time.monotonic()
    old = capture_old(options.old, case, options.keep)
    difference = compare(old, capture(options.new, case))
    line = "%s %6.1f s  %s" % ("DIFFERS" if difference else "same   ", time.monotonic() - start, case.name)
    if difference:
        line += ": " + difference
    status = int(old["%d.status" % len(case.commands)]) if old else case.exit
    if status != case.exit:
        line += " (old exits with %d, not %d: this may prove nothing)" % (status, case.exit)
    print(line, flush=True)
    return not difference


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("old", nargs="?", metavar="OLD_BINARY")
    parser.add_argument("new", nargs="?", metavar="NEW_BINARY")
    parser.add_argument("--only", metavar="PATTERN", default="", help="cases whose names this regular expression finds")
    parser.add_argument("--keep", metavar="FOLDER", help="keeps OLD's outputs, and reads those that are kept")
    parser.add_argument("--list", action="store_true", help="prints the cases and their commands, and runs none")
    options = parser.parse_args()
    try:
        options.cases = [case for case in all_cases() if re.search(options.only, case.name)]
    except re.error as error:
        parser.error("--only %s: %s" % (options.only, error))
    if not options.cases:
        parser.error("--only %s: finds no case; --list prints them" % options.only)
    if options.list:
        return options
    for name in ("old", "new"):
        path = getattr(options, name)
        if not path:
            parser.error("%s_BINARY: is missing; name the old and the new raingauge" % name.upper())
        if not (os.path.isfile(path) and os.access(path, os.X_OK)):
            parser.error("%s: is no program; name a built raingauge" % path)
        setattr(options, name, os.path.abspath(path))
    try:
        if options.keep and not keep_is_of(options.keep, options.old):
            parser.error("--keep %s: is of another binary than %s; name another folder" % (options.keep, options.old))
    except OSError as error:
        parser.error("--keep %s: %s; name a folder that can be written" % (options.keep, error.strerror))
    return options


def main():
    options = parse()
    if options.list:
        for case in options.cases:
            print(case.name + "\n  " + describe(case).rstrip().replace("\n", "\n  "))
        return 0
    start = time.monotonic()
    same = sum(run_case(case, options) for case in options.cases)
    differ = len(options.cases) - same
    print("%d cases: %d the same, %d differ; %.0f s" % (len(options.cases), same, differ, time.monotonic() - start))
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
