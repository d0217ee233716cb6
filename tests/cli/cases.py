"""Cases: a command line, its exit status, its message, and the files it leaves. A new command adds rows."""
import collections
import os
import re
import shutil
import socket
import tempfile

from runner import NO_DRIVERS

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# args: one string, split at spaces; {tmp} is an empty folder of the case's own, {data} the inputs.
# exit: the status. error: what the one line on stderr must match; several lines: a tuple; None: stderr is empty.
# env: variables for the command. limit: largest file in bytes that may be written, as on a full disk.
# made: files that must be in {tmp} afterwards, and no others.
Case = collections.namedtuple("Case", "args exit error env limit made", defaults=({}, None, ()))

UNKNOWN_DEVICE = r"device '.*': unknown; `raingauge list devices` prints the names"
NO_CONTEXT = r"device 'gl': no OpenGL 4\.5 core: eglCreateContext failed"
NO_CACHE = {"XDG_CACHE_HOME": "/proc/none"}
OLD_GL = {"MESA_GL_VERSION_OVERRIDE": "3.3"}
NO_VULKAN, NO_OPENCL, NO_GL = (variable + "=/nonexistent names no driver: unset it, or name one$" for variable in (
    "VK_DRIVER_FILES", "OCL_ICD_VENDORS", "__EGL_VENDOR_LIBRARY_FILENAMES"))
ABSENT = tuple(r"warning: unsupported here: %s: .*%s" % pair for pair in (("gl", NO_GL), ("vulkan", NO_VULKAN), ("opencl", NO_OPENCL)))
SMALL = "--set environment_px=64 --set resolution_px=96 --size 96x96 "
TABLE = "table stuppacher-2 --rows 1-1 --work paper --device cpu "
# For what does not depend on the picture: making the street of 512 texels takes longer than the rest of TABLE.
SMALL_TABLE = TABLE + "--set environment_px=16 "
FORMATS = ("csv", "json", "md", "tex")
NEITHER_FITS = tuple(r"stuppacher-2%s: cannot be written: File too large; nothing was changed" % end for end in (r"\.md", r"-quick\.journal"))
TABLE_FILES = tuple("stuppacher-2." + format for format in FORMATS)
DIFF = "diff flow --frame 5 --device cpu,cpu:reference " + SMALL
STAGES = "verify flow --stages --device cpu " + SMALL
SMALL_STAGES = "verify raster --stages --frame 1 --size 32x32 --device cpu "
RENDER = ("render flow --set environment=sky --set environment_px=16 --set resolution_px=32 --set model=none "
          "--size 32x32 --frame 1 ")

FRAMES = RENDER.replace("--frame 1", "--frames 1-2")

PANE = "render drops --set environment=sky --set environment_px=16 --set columns=32 --set rows=32 --set max_drops=700 --size 32x32 --frame 1 "

SHOWN = ("render streaks --size 32x18 --frame 1 --set atlas=small --set city=small --set depth_map_px=64 "
         "--set shadow_map_px=16 ")
RAIN = SHOWN + "--set spectrum=off "

SHOWER = "render shower --set geometry=off --size 64x36 --frame 1 --set drop_height_m=0.5 "
FIT = RAIN + ("--set fit=on --set rain_width_m=60 --set rain_depth_m=60 --set rain_height_m=40 --set camera=free "
              "--set drops_m2_s=60 --set streak_gain=60 ")

NAMES = ("doctor diff shrink verify gate baseline bisect trace table claims sweep plan merge figures atlas list render report").split()
COMMANDS = [
    # every command
    Case("", 2, r"no command; `raingauge --help` lists them"),
    Case("--help", 0, None),
    Case("--version", 0, None),
    Case("nonsense", 2, r"command 'nonsense': unknown; the nearest is 'render', and `raingauge --help` lists them"),
    Case("tabel", 2, r"command 'tabel': unknown; the nearest is 'table', and `raingauge --help` lists them"),
    *[Case(name + "q", 2, rf"command '{name}q': unknown; the nearest is '{name}', and") for name in NAMES],
    Case("help", 0, None),
    Case("help diff", 0, None),
    Case("help dif", 2, r"command 'dif': unknown; the nearest is 'diff', and"),
    Case("version", 0, None),
    Case("worker x", 2, r"worker 'x': raingauge starts its workers itself; `raingauge --help`"),
    Case("worker 1:0", 2, r"worker '1:0': raingauge starts its workers itself"),
    Case("list --nonsense", 2, r"--nonsense: unknown option; `raingauge list --help`"),
    Case("render --help", 0, None),
    Case("doctor --help", 0, None),

    # list
    Case("list techniques", 0, None),
    Case("list tables", 0, None),
    Case("list params flow", 0, None),
    Case("list figures", 0, None),
    Case("list", 2, r"list: name what to list: techniques, tables, figures, devices, or params TECHNIQUE"),
    Case("list device", 2, r"list 'device': unknown; the nearest is 'devices', and there are techniques, tables, figures, devices and params TECHNIQUE"),
    Case("list param", 2, r"list 'param': unknown; the nearest is 'params', and there are"),
    Case("list params", 2, r"name a technique; `raingauge list techniques`"),
    Case("list params nonsense", 2, r"technique 'nonsense': unknown"),
    Case("list devices twice", 2, r"'twice' is one argument too many"),

    # shrink
    Case("shrink --help", 0, None),
    Case("shrink flow --device cpu", 2, r"shrink takes two devices, the one in doubt first"),
    Case("shrink nonsense", 2, r"technique 'nonsense': unknown"),
    Case("render --case {tmp}/none.txt", 2, r"none\.txt: "),
    Case("render flow --case {tmp}/none.txt", 2, r"names its technique itself; leave out 'flow'"),

    # bisect; tests/cli/devices/bisecting.py has more
    Case("bisect --help", 0, None),
    Case("table raster-1 --claims --from %s/results/tables" % ROOT, 2, r"--claims: the paper claims nothing of table 'raster-1'; leave it out"),
    Case("sweep flow --axis distance_mm=-1e308,1e308..-1e308", 2, r"--axis .*: -1e308 does not come after -1e308 and 1e308"),
    Case("table raster-1 --claims", 2, r"--claims: the paper claims nothing of table 'raster-1'; leave it out"),
    Case("claims raster-1", 2, r"claims 'raster-1': the paper claims nothing of this table; "),
    Case("claims nothing", 2, r"claims 'nothing': no such table; "),
    Case("claims --budget 3x", 2, r"--budget"),
    Case("claims --device cpu", 2, r"claims: all tables take hours; name some, .* or add --budget 4m, --quick or --full$"),
    Case("table", 2, r"table: all tables take hours; name some, .* or add --budget 4m, --quick or --full$"),
    Case("table --work ours -o {tmp}/none", 2, r"table: all tables take hours; "),
    Case("claims --from %s/results/tables --device cpu" % ROOT, 2, r"--from"),
    Case("claims raster-1 --from %s/results/tables" % ROOT, 2, r"holds no table of these about which a paper claims something"),
    Case("table stuppacher-2 --kept {tmp} --from %s/results/tables" % ROOT, 2, r"--kept: is about claims; add --claims, or leave it out"),
    Case("bisect", 2, r"bisect: --run names the command that judges"),
    Case("bisect --run false", 1, r"bad \(exit status 1, 1 try\)"),

    # plan, merge and shards; tests/cli/tables/farm.py has more
    Case("plan --help", 0, None),
    Case("merge --help", 0, None),
    Case("plan", 2, r"plan: name the file to write it to, as -o plan\.json"),
    Case("plan nonsense -o {tmp}/plan.json", 2, r"table 'nonsense': unknown; the nearest is '"),
    Case("plan raster-1 --device all -o {tmp}/plan.json", 2, r"--device all: which devices there are is known only where cells are measured; name them"),
    Case("plan raster-1 --device cpu,cpu -o {tmp}/plan.json", 2, r"--device: names 'cpu' twice; name it once"),
    Case("plan raster-1 --device nonsense -o {tmp}/plan.json", 2, UNKNOWN_DEVICE),
    Case("plan raster-1 --shards 0 -o {tmp}/plan.json", 2, r"--shards 0: must be 1 to"),
    Case("plan raster-1 --from {data}/a.png -o {tmp}/plan.json", 2, r"a\.png: line 1 is no JSON"),
    Case("plan raster-1 -o {tmp}/plan.json --from %s/results/tables" % ROOT, 0, None, made=("plan.json",)),
    Case("plan raster-1 -o {tmp}/plan.json", 0, r"warning: 4 of 4 cells are in no record", made=("plan.json",)),
    Case("plan --missing", 2, r"plan --missing: name a plan and folders of records"),
    Case("plan --missing {data}/a.png {data}", 2, r"a\.png: line 1 is no JSON: .*; name a file as `raingauge plan -o` writes it"),
    Case("plan --missing --quick a b", 2, r"--missing and --quick: choose one"),
    Case("merge", 2, r"merge: name a plan and folders of records"),
    Case("merge a b", 2, r"merge: name the folder of the tables, as -o tables"),
    Case("merge a {data} -o {data}", 2, r"holds the records that are merged; name another folder"),
    Case("merge {tmp}/none {data} -o {tmp}/out", 2, r"none: cannot be read: "),
    Case("merge %s/results/tables/raster-1.json {data} -o {tmp}/out" % ROOT, 2, r"raster-1\.json: is no plan; "),
    Case("table --shard 1/2", 2, r"--shard: is of a plan; name it, as --plan plan\.json"),
    Case("table --plan a", 2, r"--plan: name the folder of its records, as -o records"),
    Case("table raster-1 --plan a -o {tmp}", 2, r"--plan: the plan names the tables; leave out 'raster-1'"),
    Case("table --plan a --quick", 2, r"--plan and --quick: choose one"),
    Case("table --plan a --device cpu", 2, r"--plan and --device: choose one"),
    Case("table --plan {tmp}/none -o {tmp}/out", 2, r"none: cannot be read: "),

    # doctor
    Case("doctor --device nonsense", 2, UNKNOWN_DEVICE),
    Case("doctor --device cpu:7", 2, r"device 'cpu:7': cpu has no such device"),
    Case("doctor --device " + 40 * "x", 2, UNKNOWN_DEVICE),
    Case("doctor --device ,", 2, r"--device ',': names no device"),
    Case("doctor --device cpu,,,", 2, r"--device 'cpu,,,': names no device beside a comma"),
    Case("doctor --device=", 2, r"--device '': is empty; write a value after it, or leave it out"),
    Case("doctor --prologue --json", 2, r"--prologue and --json: choose one"),
    Case("doctor cpu", 2, r"doctor: 'cpu' is one argument too many"),
    Case("doctor --device cpu", 0, None),

    # diff: unused arguments
    Case("diff flow --device cpu,,cpu:reference", 2, r"--device 'cpu,,cpu:reference': names no device beside a comma"),
    Case("diff flow --device ,cpu,cpu:reference", 2, r"names no device beside a comma"),
    Case("diff flow --device cpu,cpu:reference --background {data}/a.png", 2, r"--background: belongs to `diff A B`, and 1 argument is given; leave it out"),
    *[Case("diff {data}/a.png {data}/a.png " + option, 2, r"%s: belongs to `diff TECHNIQUE`, and 2 arguments are given; leave it out" % option.split()[0])
      for option in ("--require nonsense", "--timeout 5", "--set nonsense=1", "--device cpu", "--frame 5", "--size 8x8", "--mutants")],
    Case("diff {data}/a.png {data}/a.png --memory 1G --exposure 2", 0, None),
    Case("diff flow --require cpu,,", 2, r"--require 'cpu,,': names no device beside a comma"),
    Case("sweep flow --axis device=cpu,,", 2, r"--axis device 'cpu,,': names no device beside a comma"),
    Case("diff flow --device cpu@A=x;A=y,cpu", 2, r"device 'cpu@A=x;A=y': sets A twice; choose one value"),
    Case("gate cpu@A=x;A=y cpu", 2, r"device 'cpu@A=x;A=y': sets A twice; choose one value"),
    Case(RENDER.replace("--frame 1", "--frame -2147483648") + "-o {tmp}/a.png", 2, r"--frame -2147483648: must be 0 to"),
    Case(RENDER.replace("--frame 1", "--frame=") + "-o {tmp}/a.png", 2, r"--frame : invalid numeric value"),
    Case(RENDER + "--exposure= -o {tmp}/a.png", 2, r"--exposure : invalid numeric value"),
    Case(RENDER + "--device cpu,,, -o {tmp}/a.png", 2, r"--device cpu,,,: render draws on one device"),

    Case("figures creus-4.1 --device cpu,cpu:reference -o {tmp}/a", 2, r"--device cpu,cpu:reference: figures draws on one device; `raingauge diff`"),
    Case("figures creus-4.1 --device all -o {tmp}/a", 2, r"--device all: figures draws on one device"),

    # verify: stages of no frame
    Case("verify raster --stages --frame 0 --device cpu", 2, r"--frame 0: --stages compares what the stages of frames leave, at least of 1"),
    Case(SMALL_STAGES, 0, None),

    # a variable with an unusable value
    *[Case("render raster --frame 0 --size 32x32 -o {tmp}/a.png", 0, r"warning: RG_MEMORY_BYTES=%s: is no whole number of bytes above 0, and is ignored; " % text,
           {"RG_MEMORY_BYTES": text}, made=("a.png",)) for text in ("abc", "1G", "0", "-5", "99999999999999999999")],

    # empty values
    Case("diff flow --device cpu,cpu:reference --output=", 2, r"--output '': is empty"),
    Case("shrink flow --device cpu,cpu:reference --output=", 2, r"--output '': is empty"),
    Case("table --require=", 2, r"--require '': is empty"),
    Case("table --variant=", 2, r"--variant '': is empty"),
    Case("atlas --compare=", 2, r"--compare '': is empty"),
    Case("render --case=", 2, r"--case '': is empty"),
    Case("gate cpu cpu --junit=", 2, r"--junit '': is empty"),
    Case("gate cpu cpu --fails=", 2, r"--fails '': is empty"),
    Case("gate cpu cpu --margin=-1", 2, r"--margin -1: must be above 0, at most 100"),
    Case("gate cpu cpu --budget=-1s", 2, r"--budget '-1s': is no time"),
    Case("gate cpu, cpu", 2, r"names no device beside a comma"),
    Case("shrink flow --device cpu,,, --size 8x8", 2, r"names no device beside a comma"),
    Case("shrink flow --seconds=-1", 2, r"--seconds -1: must be 1 to 86400"),
    Case("sweep flow --axis seed=1,,2", 2, r"--axis seed=1,,2: write it as NAME=VALUE,VALUE"),
    Case("sweep flow --axis drops=-1", 2, r"parameter 'drops': -1 is out of range; 0 to 100000$"),

    # outputs never replace inputs
    Case("diff {data}/in-flip.png {data}/b.png -o {data}/in", 2, r"in-flip\.png: would be overwritten, and is read as '.*/in-flip\.png'; name another with -o"),
    Case("diff {data}/b.png {data}/in-difference.png -o {data}/in", 2, r"in-difference\.png: would be overwritten, and is read as"),
    Case("diff {data}/a.png {data}/b.png --background {data}/in-flip.png -o {data}/in", 2, r"in-flip\.png: would be overwritten"),
    Case("diff {data}/a.png {data}/b.png -o {data}/link", 2, r"link-flip\.png: would be overwritten, and is read as '.*/a\.png'"),
    Case(PANE.replace("render", "diff") + "--device cpu,cpu:reference --set background={data}/in-cpu-cpu_reference-flip.png -o {data}/in", 2,
         r"in-cpu-cpu_reference-flip\.png: would be overwritten"),
    Case(PANE + "--set background={data}/a.png -o {data}/a.png", 2, r"a\.png: would be overwritten, and is read as '.*/a\.png'; name another with -o"),
    Case(PANE + "--set background={data}/a.png -o {data}/link-flip.png", 2, r"link-flip\.png: would be overwritten"),
    Case(PANE.replace("--frame 1", "--frames 1-2") + "--set background={data}/in2.png -o {data}/in%d.png", 2, r"in2\.png: would be overwritten"),
    Case(PANE.replace("--frame 1", "--frames 0-1") + "--set background={data}/in2.png -o {tmp}/in%d.png", 0, None, made=("in0.png", "in1.png")),
    Case("shrink drops --device nonsense,cpu --set background={data}/a.png -o {data}/a.png", 2, r"a\.png: would be overwritten, and is read as"),
    Case("shrink drops --device nonsense,cpu --set background={data}/in.files/a.png -o {data}/in", 2,
         r"in\.files: would be overwritten, and is read from '.*/in\.files/a\.png'; name another case with -o"),

    # FIFOs and sockets: no command waits for them
    Case("gate cpu cpu --cells {data}/fifo.txt", 2, r"fifo\.txt: is not a regular file"),
    Case("gate cpu cpu --expectations {data}/fifo.txt", 2, r"fifo\.txt: is not a regular file"),
    Case("gate cpu cpu --fails {data}/socket.json", 2, r"socket\.json: is not a regular file"),
    Case("gate cpu cpu --skips /dev/zero", 2, r"/dev/zero: is not a regular file"),
    Case("gate cpu cpu --junit {data}/fifo.txt", 2, r"fifo\.txt: is not a regular file"),
    Case("gate --baseline {data}/fifo.json", 2, r"fifo\.json: cannot be read: is not a regular file"),
    Case("baseline --device cpu -o {data}/fifo.txt", 2, r"fifo\.txt: is not a regular file"),
    Case("gate cpu cpu --github", 2, r"fifo\.txt: cannot be opened: is not a regular file; \$GITHUB_STEP_SUMMARY must name a file",
         {"GITHUB_STEP_SUMMARY": "{data}/fifo.txt"}),
    Case("gate cpu cpu --pictures --junit {tmp}/a.out --bmf {tmp}/a.out", 2, r"a\.out: would be overwritten with a report, and is named as '.*a\.out' as well; name another"),
    Case("gate cpu cpu --pictures", 2, r"fifo\.txt: cannot be written: is not a regular file; \$GTEST_SHARD_STATUS_FILE names a file",
         {"GTEST_SHARD_STATUS_FILE": "{data}/fifo.txt"}),
    Case("render --case {data}/fifo.txt", 2, r"fifo\.txt: is not a regular file"),
    Case("render --case {data}/socket.json", 2, r"socket\.json: is not a regular file"),
    Case("shrink flow --device nonsense,cpu -o {data}/fifo.txt", 2, r"fifo\.txt: is not a regular file"),
    Case("shrink flow --device nonsense,cpu -o {tmp}/none/case.txt", 2, r"none/case\.txt: its folder is not there"),
    Case("table stuppacher-2 --device nonsense -o {data}/fifos", 2, r"fifos/stuppacher-2\.tex: is not a regular file"),
    Case("sweep flow --axis seed=1 --device nonsense -o {data}/fifos", 2, r"fifos/sweep-flow\.json: is not a regular file"),
    Case("diff {data}/fifo.png {data}/a.png", 2, r"fifo\.png: is not a regular file"),
    Case("diff {data}/fifo.tif {data}/a.png", 2, r"fifo\.tif: is not a regular file"),
    Case("table --from {data}/fifo.json", 2, r"fifo\.json: cannot be read: is not a regular file"),
    Case("table --from {data}/socket.json", 2, r"socket\.json: cannot be read: is not a regular file"),
    Case("atlas --from {data}/fifos -o {tmp}/out", 2, r"dcam00_point_max\.txt: is not a regular file; name the folder"),
    Case(RENDER + "--set environment={data}/fifo.ktx -o {tmp}/a.png", 2, r"fifo\.ktx: cannot be opened: is not a regular file"),
    Case(RENDER + "--set environment={data}/fifo.png -o {tmp}/a.png", 2, r"fifo\.png: is not a regular file"),
    Case(RENDER + "--set environment=/dev/zero.ktx -o {tmp}/a.png", 2, r"zero\.ktx: "),
    Case(RENDER + "--set model={data}/fifo.obj -o {tmp}/a.png", 2, r"fifo\.obj: is not a regular file"),
    Case(RAIN + "--set density_map={data}/fifo.png -o {tmp}/a.png", 2, r"fifo\.png: is not a regular file"),
    Case(RAIN + "--set lights_file={data}/fifo.json -o {tmp}/a.png", 2, r"fifo\.json: is not a regular file; name a file of at most 16 lights"),
    Case("render cartoon --size 32x32 --frame 1 --set wind=script --set wind_script={data}/fifo.txt -o {tmp}/a.png", 2,
         r"fifo\.txt: is not a regular file; name a file of winds"),

    # diff: files
    Case("diff {data}/a.png {data}/a.png", 0, None),
    Case("diff {data}/a.exr {data}/a.exr", 0, None),
    Case("diff {data}/a.png {data}/b.png", 1, None),
    Case("diff {data}/a.png {data}/b.png -o {tmp}/heat", 1, None, made=("heat-difference.png", "heat-flip.png")),
    Case("diff {data}/a.png {data}/wide.png", 2, r"wide\.png: is 48 x 32 pixels but .*a\.png is 32 x 32; compare pictures of one size"),
    Case("diff {data}/a.png {data}/none.png", 2, r"none\.png: .*check the name"),
    Case("diff {data}/none.png {data}/none.png", 2, r"none\.png: .*check the name"),
    Case("diff {data}/a.png {data}/half.png", 2, r"half\.png: "),
    Case("diff {data}/half.exr {data}/a.exr", 2, r"half\.exr: "),
    Case("diff {data}/short.exr {data}/a.exr", 2, r"short\.exr: "),
    Case("diff {data}/large.hdr {data}/large.hdr --memory 48M", 2,
         r"large\.hdr: no memory for 2048 x 1536 pixels \(36 MiB, and as much while it is read\); crop it, or allow more with --memory"),
    Case("diff {data}/folder.exr {data}/a.exr", 2, r"diff: '.*/folder\.exr' is a folder; name two pictures, and call diff once for each pair"),
    Case("diff {data}/a.exr {data}", 2, r"diff: '.*' is a folder; name two pictures"),
    Case("diff {data}", 2, r"diff: '.*' is a folder; name two pictures"),
    Case("diff {data}/a.png {data}/b.png -o {tmp}/", 1, None, made=("difference.png", "flip.png")),
    Case("diff {data}/a.nonsense {data}/a.png", 2, r"a\.nonsense: the extension .* is not a known picture's"),
    Case("diff {data}/a.png {data}/a.png --background {data}/wide.png", 2, r"the background: is 48 x 32 pixels but .*a\.png is 32 x 32"),
    Case("diff {data}/a.png {data}/b.png -o {tmp}/none/heat", 2, r"none/heat-flip\.png: its folder is not there"),
    Case("diff {data}/a.png {data}/b.png -o {tmp}/heat", 71, r"heat-flip\.png: ", limit=64),
    Case("diff {data}/a.png", 2, r"technique '.*a\.png': unknown"),
    Case("diff", 2, r"diff: name a technique, or two image files; `raingauge diff --help`"),
    Case("diff a.png b.png c.png", 2, r"diff: name a technique, or two image files"),

    # diff: devices
    Case(DIFF, 0, None),
    Case(DIFF + "-o {tmp}/heat", 0, None, made=("heat-cpu-cpu_reference-difference.png", "heat-cpu-cpu_reference-flip.png", "heat-cpu.exr", "heat-cpu_reference.exr")),
    Case(DIFF + "-o {tmp}/", 0, None, made=("cpu-cpu_reference-difference.png", "cpu-cpu_reference-flip.png", "cpu.exr", "cpu_reference.exr")),
    Case(DIFF.replace("cpu,cpu:reference", "cpu@RG_X=a/b,cpu@RG_X=a:b") + "-o {tmp}/heat", 0, None, made=tuple(
        "heat-cpu_RG_X_a_b_" + name for name in ("aa7580cd9de55393.exr", "e4ba8afe9d88ae3f-cpu_RG_X_a_b_aa7580cd9de55393-difference.png",
                                                 "e4ba8afe9d88ae3f-cpu_RG_X_a_b_aa7580cd9de55393-flip.png", "e4ba8afe9d88ae3f.exr"))),
    Case(DIFF + "-o {tmp}/none/heat", 2, r"none/heat-flip\.png: its folder is not there"),
    Case("diff nonsense", 2, r"technique 'nonsense': unknown; the nearest is '.*', and `raingauge list techniques`"),
    Case("diff flow --device cpu", 2, r"--device cpu: a comparison takes two devices"),
    Case("diff flow --features --device cpu,cpu:reference", 2, r"--device cpu,cpu:reference: --features takes a native device, such as gl:native"),
    Case("diff flow --device cpu,nonsense", 2, UNKNOWN_DEVICE),
    Case("diff flow --set drops=-1 --device cpu,cpu:reference", 2, r"parameter 'drops': -1 is out of range"),

    # figures
    Case("trace", 2, r"no technique named; "),
    Case("trace flow --count 0", 2, r"--count 0: "),
    Case("trace flow --device cpu --count 1 --size 32x32 -o {tmp}/none/trace.json", 2, r"none/trace\.json: its folder is not there; make it first"),
    Case("trace raster --device cpu --count 1 --size 32x32 -o {tmp}/trace.json", 0, None, made=("trace.json",)),
    Case("figures creus-4.41", 2, r"figure 'creus-4.41': unknown; the nearest is 'creus-4.1', and `raingauge list figures` prints them"),
    Case("figures creus-4.4 -o {tmp}/none/out", 2, r"none/out: its folder is not there; make it first"),
    Case("figures creus-4.4 --device nonsense", 2, UNKNOWN_DEVICE),
    Case("figures creus-4.1 --size 64x36 --memory 1M -o {tmp}/out", 2, r"streaks of 64x36 on cpu needs .* MiB, and 1\.0 MiB of --memory are left"),

    # report; tests/harness/report has more
    Case("report --help", 0, None),
    Case("report", 2, r"report: names no records; name files or folders, such as results/tables"),
    Case("report %s/results/tables/creus-5.4.json -o {tmp}/page.html" % ROOT, 0, None, made=("page.html",)),
    Case("report %s/results/tables/creus-5.4.json -o {tmp}/page.html" % ROOT, 71, r"page\.html: cannot be written: File too large; nothing was changed", limit=1 << 16),

    # atlas
    Case("atlas nonsense", 2, r"technique 'nonsense': unknown; the nearest is '.*', and `raingauge list techniques`"),
    Case("atlas cartoon flow", 2, r"atlas: 'flow' is one argument too many"),
    Case("atlas flow", 2, r"technique 'flow': it generates no textures; `raingauge atlas --help`"),
    Case("atlas cartoon --quick", 2, r"atlas cartoon: --from, --compare, --measured, --quick and --full are about the streak atlas; leave them out"),
    Case("atlas cartoon --from {tmp}", 2, r"atlas cartoon: --from, --compare, --measured, --quick and --full are about the streak atlas"),
    Case("atlas cartoon -o {tmp}/none/out", 2, r"none/out: its folder is not there; make it first"),
    Case("atlas --quick --full", 2, r"--quick and --full: choose one"),
    Case("atlas --device cpu", 2, r"--device: unknown option; `raingauge atlas --help`"),
    Case("atlas --from", 2, r"--from: .*`raingauge atlas --help`"),
    Case("atlas --from /nonexistent", 2, r"/nonexistent/point_light_database/txt/dcam00_point_max\.txt: No such file .*; name the folder"),
    Case("atlas --compare", 2, r"--compare: .*`raingauge atlas --help`"),
    Case("atlas --quick --compare /nonexistent", 2, r"/nonexistent: No such file or directory; name a folder with pictures of the database"),
    Case("atlas --quick --from {tmp} --compare {data}/fifo.png", 2, r"fifo\.png: Not a directory; name a folder with pictures of the database"),
    Case("atlas --quick --compare {tmp}", 2, r"no picture of the database, such as cv0_v10_h90_osc1\.png, is in it; name another folder"),
    Case("atlas cartoon --compare {tmp}", 2, r"atlas cartoon: --from, --compare, --measured, --quick and --full are about the streak atlas"),
    Case("atlas --quick --from {data}/a.png", 2, r"a\.png/point_light_database/txt/dcam00_point_max\.txt: Not a directory"),
    Case("atlas --quick -o {tmp}/none/out", 2, r"none/out: its folder is not there; make it first"),

    # verify
    Case(STAGES, 0, None),
    Case("verify nonsense", 2, r"technique 'nonsense': unknown; the nearest is '.*', and `raingauge list techniques`"),
    Case("verify flow --set drops=100001 --device cpu", 2, r"parameter 'drops': 100001 is out of range; 0 to 100000"),
    Case("verify flow --set nonsense=1 --device cpu", 2, r"parameter 'nonsense': flow has none"),
    Case("verify flow --device nonsense", 2, UNKNOWN_DEVICE),
    # A cause that affects each cell is reported once.
    Case("verify raster --quick --frame 1 --size 32x32 --device cpu --set scene=mesh --set model={tmp}/none.obj", 2, r"none\.obj: No such file or directory; check the name"),
    Case("verify flow --quick --full", 2, r"--quick and --full: choose one"),
    Case("verify flow --frame -1", 2, r"--frame -1: must be 0 to 10000000"),
]

RENDERS = [
    # figures
    Case("figures stuppacher-4 ye-3 --size 64x36 -o {tmp}", 0, None, made=("figures.md", "stuppacher-4.png", "ye-3.png")),
    Case("figures creus-4.11a --size 64x36 -o {tmp}", 0, None, made=("creus-4.11a.exr", "creus-4.11a.png", "figures.md")),

    # arguments
    Case("render", 2, r"no technique named; `raingauge list techniques`"),
    Case("render nonsense", 2, r"technique 'nonsense': unknown; the nearest is '.*', and `raingauge list techniques`"),
    Case("render flow flow", 2, r"'flow' is one argument too many"),
    Case(RENDER + "--device nonsense -o {tmp}/a.png", 2, UNKNOWN_DEVICE),
    Case(RENDER + "--device cpu:nonsense -o {tmp}/a.png", 2, r"device 'cpu:nonsense': cpu has no such device"),
    Case(RENDER + "--device , -o {tmp}/a.png", 2, r"--device ',': names no device beside a comma"),
    Case(RENDER + "--device cpu,gl -o {tmp}/a.png", 2, r"--device cpu,gl: render draws on one device"),
    Case(RENDER + "--device all -o {tmp}/a.png", 2, r"--device all: render draws on one device"),
    Case(RENDER + "--set nonsense=1 -o {tmp}/a.png", 2, r"parameter 'nonsense': flow has none .*`raingauge list params flow`"),
    Case(RENDER + "--set drops -o {tmp}/a.png", 2, r"parameter 'drops': write it as KEY=VALUE"),
    Case(RENDER + "--set drops=many -o {tmp}/a.png", 2, r"parameter 'drops': "),
    Case(RENDER + "--set drops=-1 -o {tmp}/a.png", 2, r"parameter 'drops': -1 is out of range; 0 to 100000"),
    Case(RENDER + "--set drops=1e99 -o {tmp}/a.png", 2, r"parameter 'drops': "),
    Case(RENDER + "--set step_s=nan -o {tmp}/a.png", 2, r"parameter 'step_s': "),
    Case(RENDER + "--size -1x-1 -o {tmp}/a.png", 2, r"--size -1x-1: each side must be 1 to 16384 pixels"),
    Case(RENDER + "--size 0x5 -o {tmp}/a.png", 2, r"--size 0x5: each side"),
    Case(RENDER + "--size 1000000x2 -o {tmp}/a.png", 2, r"--size 1000000x2: each side"),
    Case(RENDER + "--size 99999999999999999999x2 -o {tmp}/a.png", 2, r"--size 9{20}x2: each side"),
    Case(RENDER + "--size 4294967297x1 -o {tmp}/a.png", 2, r"--size 4294967297x1: each side"),
    Case(RENDER + "--size 5 -o {tmp}/a.png", 2, r"--size 5: write it as WIDTHxHEIGHT"),
    Case(RENDER + "--frame -1 -o {tmp}/a.png", 2, r"--frame -1: must be 0 to 10000000"),
    Case(RENDER + "--frame 99999999999999999999 -o {tmp}/a.png", 2, r"--frame 9{20}: .*`raingauge render --help`"),
    Case(RENDER + "--frame x -o {tmp}/a.png", 2, r"--frame x: .*`raingauge render --help`"),
    Case(FRAMES + "--frame 1 -o {tmp}/a.webm", 2, r"--frames and --frame: choose one"),
    Case(FRAMES + "--frames 3-2 -o {tmp}/a.webm", 2, r"--frames 3-2: frames count from 0, the first not after the last"),
    Case(FRAMES + "--frames -1-2 -o {tmp}/a.webm", 2, r"--frames -1-2: frames count from 0"),
    Case(FRAMES + "--frames 1-99999999999999999999 -o {tmp}/a.webm", 2, r"--frames 1-9{20}: must be 0 to 10000000"),
    Case(FRAMES + "--frames 1-x -o {tmp}/a.webm", 2, r"--frames 1-x: write it as FIRST-LAST, as in 2-4"),
    Case(FRAMES + "--fps 0 -o {tmp}/a.webm", 2, r"--fps 0: must be 1 to 240"),
    Case(FRAMES + "--fps 30 -o {tmp}/a-%d.png", 2, r"--fps 30: a clip alone has it; name one"),
    Case(RENDER + "--fps 30 -o {tmp}/a.png", 2, r"--fps 30: a clip alone has it; name one"),
    Case(RENDER + "-o {tmp}/a.webm", 2, r"a\.webm: a clip holds several frames; give --frames A-B"),
    Case(FRAMES + "-o {tmp}/a-%d.webm", 2, r"a-%d\.webm: a clip holds all frames; leave out the place of a number"),
    Case(FRAMES + "-o {tmp}/a.png", 2, r"a\.png: has no place for the frame's number; name pictures as in rain-%04d\.png, or a clip"),
    Case(FRAMES + "-o {tmp}/%d-%d.png", 2, r"%d-%d\.png: has more than one place for the frame's number"),
    Case(FRAMES + "-o {tmp}/%d/a.png", 2, r"%d/a\.png: has no place for the frame's number"),
    Case(RENDER + "--exposure nan -o {tmp}/a.png", 2, r"--exposure nan: must be above 0"),
    Case(RENDER + "--exposure 0 -o {tmp}/a.png", 2, r"--exposure 0: must be above 0, at most 1000000"),
    Case(RENDER + "-o {tmp}/a.png -z", 2, r"-z: unknown option"),
    Case(RENDER + "--output", 2, r"--output: .*`raingauge render --help`"),

    # inputs
    Case(RENDER + "--set environment=/nonexistent.exr -o {tmp}/a.png", 2, r"/nonexistent\.exr: .*check the name"),
    Case(RENDER + "--set environment={data}/short.ktx -o {tmp}/a.png", 2, r"short\.ktx: .*truncated"),
    Case(RENDER + "--set environment={data}/half.ktx -o {tmp}/a.png", 2, r"half\.ktx: "),
    Case(RENDER + "--set environment={data}/short.exr -o {tmp}/a.png", 2, r"short\.exr: "),
    Case(RENDER + "--set environment={data}/folder.exr -o {tmp}/a.png", 2, r"folder\.exr: "),

    Case(RENDER + "--set model=nonsense -o {tmp}/a.png", 2, r"nonsense.*check the name"),
    Case(RENDER + "--set model=/nonexistent.obj -o {tmp}/a.png", 2, r"/nonexistent\.obj: .*check the name"),
    Case(RENDER + "--set model={data}/a.png -o {tmp}/a.png", 2, r"a\.png: Assimp cannot read it"),
    Case(RENDER + "--set model={data}/folder.exr -o {tmp}/a.png", 2, r"folder\.exr: "),
    Case(RENDER + "--set model=sphere --set model_faces=1 -o {tmp}/a.png", 2, r"sphere: .*1 faces; ask for more"),
    # only a box of glass holds a model; elsewhere its file is not looked for
    Case(RENDER + "--set panes=mirror --set model=nonsense -o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(RENDER + "--set view=pane --set model=nonsense -o {tmp}/a.png", 0, None, made=("a.png",)),

    # impossible rain
    Case(RAIN + "--set density_map=/nonexistent.png -o {tmp}/a.png", 2, r"/nonexistent\.png: .*check the name"),
    Case(RAIN + "--set density_map={data}/folder.exr -o {tmp}/a.png", 2, r"folder\.exr: "),
    Case(PANE + "--set background=/nonexistent.png -o {tmp}/a.png", 2, r"/nonexistent\.png: .*check the name"),
    Case(PANE + "--set background={data}/short.exr -o {tmp}/a.png", 2, r"short\.exr: "),
    Case(PANE + "--set aperture_mm=101 -o {tmp}/a.png", 2, r"parameter 'aperture_mm': 101 is out of range; 0 to 100 mm"),
    Case(PANE + "--set aperture_mm=100 --set distance_mm=100 -o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(PANE + "--set rows=0 -o {tmp}/a.png", 2, r"parameter 'rows': 0 is out of range; 16 to 8192"),
    Case(PANE + "--set columns=100000 -o {tmp}/a.png", 2, r"parameter 'columns': 100000 is out of range"),
    Case(PANE + "--set max_drops=2000 -o {tmp}/a.png", 2, r"2000 drops are more than the pane's 32 x 32 cells"),
    Case(PANE + "--set max_mass_mg=0.2 -o {tmp}/a.png", 2, r"0\.2 mg is below the least mass on cells of 0\.5 mm, .*raise it"),
    Case(RENDER + "--set relief=0.6 -o {tmp}/a.png", 2, r"relief: 0\.6 mm a unit of water is too little .*take 0\.625 or more$"),
    Case(RENDER + "--set drop_radius_max_mm=100 --set pane_mm=1 -o {tmp}/a.png", 2, r"take \d+\.\d+ or more, lower drop_radius_max_mm or raise pane_mm"),
    Case(RENDER + "--set pane_mm=10000 -o {tmp}/a.png", 2, r"pane_rain_mm_h: 31 mm/h .* pane_mm=10000 are 985112 drops a second, more than 60000; lower either"),
    Case(RENDER + "--set move=paper --set relief=0 --set pane_mm=10000 -o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(PANE + "--set residual_low=0.4 -o {tmp}/a.png", 2, r"a share of 0\.4 is above residual_high=0\.3"),
    Case(PANE + "--set rules=physical --set cell_mm=0.3 -o {tmp}/a.png", 2, r"0\.3 mm is no whole part of 0\.5 mm"),
    Case(RAIN + "--set drops_m2_s=0 -o {tmp}/a.png", 2, r"parameter 'drops_m2_s': 0 is out of range; 1e-06 to 1000000000"),
    Case(RAIN + "--set drops_m2_s=1e9 -o {tmp}/a.png", 2, r"1\.02666e\+14 particles .*lower drops_m2_s"),
    Case(RAIN + "--set packet_size=1 --set packets=kd --set rain_width_m=60 --set rain_depth_m=60 --set memory_mb=500 "
         "--set camera=free -o {tmp}/a.png", 77, r"take 556\.8 MiB, more than the 476\.8 MiB allowed"),
    Case(SHOWN + "--set spectrum=best --set packets=kd --set memory_mb=1 -o {tmp}/a.png", 77, r"lower kept_share or local_height_m"),
    Case(RAIN + "--set camera=free --set eye_y_m=-3 -o {tmp}/a.png", 2, r"its eye is 3 m below the ground; raise eye_y_m"),
    Case(RAIN + "--set culling_radius_m=5000 -o {tmp}/a.png", 2, r"5000 m is wider than the rain space .*limits=off"),
    Case(RAIN + "--set outside=frustum -o {tmp}/a.png", 2, r"outside=frustum: limits and states are those of a box; take limits=off and state=off"),
    Case(RAIN + "--set outside=frustum --set limits=off --set state=on -o {tmp}/a.png", 2, r"outside=frustum: .*state=off"),
    Case(RAIN + "--set local_height_m=500 -o {tmp}/a.png", 2, r"500 m is higher than the rain space"),
    Case(SHOWN + "--set spectrum=best --set normalised=off --set kept_share=1 --set least_diameter_mm=0.1 -o {tmp}/a.png", 77,
         r"spectrum: 2788 drops a cubic metre are 2\.336e\+09 in the local space, at most 2147483647 .*raise least_diameter_mm"),
    Case(SHOWN + "--set spectrum=best --set rain_mm_h=0 -o {tmp}/a.png", 2, r"parameter 'rain_mm_h': 0 is out of range; 0\.1 to 500 mm/h"),
    Case(SHOWER + "--set particles=0 -o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(SHOWER + "--set particles=1000000000 -o {tmp}/a.png", 2, r"parameter 'particles': 1000000000 is out of range; 0 to 100000000"),
    Case(SHOWER + "--set particles=60000 --set memory_mb=1 -o {tmp}/a.png", 77, r"60000 of them take 1 MB, more than memory_mb=1; lower particles"),
    Case(SHOWER + "--set wind_m_s=343 -o {tmp}/a.png", 2, r"parameter 'wind_m_s': 343 is out of range; 0 to 340 m/s"),
    Case(SHOWER + "--set eye_y_m=-2 -o {tmp}/a.png", 2, r"eye_y_m: the viewer is 2 m below the ground; raise it"),
    Case(SHOWER + "--set near_m=20 -o {tmp}/a.png", 2, r"at 15\.5885 m and more a drop is less than a pixel high .* lower near_m"),
    Case(SHOWER + "--set geometry=on --set scene=/nonexistent.obj -o {tmp}/a.png", 2, r"/nonexistent\.obj: .*check the name"),
    Case(FIT + "--set limits=off -o {tmp}/a.png", 2, r"fit=on: without limits there is no radius .*take limits=on"),
    Case(FIT + "--set fit_error=0 -o {tmp}/a.png", 2, r"parameter 'fit_error': 0 is out of range; 0\.001 to 1"),
    Case(FIT + "--set fit_error=0.9 -o {tmp}/a.png", 2, r"without any rain the first frame has an error of 0\.\d+; allow less"),
    Case(FIT + "--set drops=off --set splashes=off -o {tmp}/a.png", 2, r"no rain is seen in the first frame; move the camera"),
    Case(FIT + "--set packets=kd --set memory_mb=1 -o {tmp}/a.png", 77, r"more than the .* allowed"),
    Case(FIT + "--set eye_y_m=60 --set fit_error=0.001 -o {tmp}/a.png", 2, r"the largest radius and height, .* have an error of .*; allow "),
    Case(FIT + "-o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(RAIN + "--set lights=17 -o {tmp}/a.png", 2, r"parameter 'lights': 17 is out of range; -1 to 16"),
    Case(RAIN + "--set lights_file={data}/a.png -o {tmp}/a.png", 2, r"a\.png:1:0: .*docs/lights\.md"),
    Case(RAIN + "--set scene={data}/a.png -o {tmp}/a.png", 2, r"a\.png: Assimp cannot read it"),
    Case(RAIN + "--set atlas=cave -o {tmp}/a.png", 2,
         r"streaks-cave\.atlas: it is not there; `raingauge atlas --from DIR` packs the original database", NO_CACHE),
    Case(RAIN + "--set atlas=cave-small -o {tmp}/a.png", 2,
         r"streaks-cave-small\.atlas: it is not there; `raingauge atlas --quick --from DIR` packs", NO_CACHE),

    # the scene's absurd values
    Case(RENDER + "--set panes=wood -o {tmp}/a.png", 2, r"parameter 'panes': 'wood' is none of: glass mirror"),
    Case(RENDER + "--set view=room -o {tmp}/a.png", 2, r"parameter 'view': 'room' is none of: box pane"),
    Case(RENDER + "--set stage=last -o {tmp}/a.png", 2, r"parameter 'stage': 'last' is none of: height blurred normals final"),
    Case(RENDER + "--set run_on=maybe -o {tmp}/a.png", 2, r"parameter 'run_on': 'maybe' is none of: off on"),
    Case(RENDER + "--set reach_texels=5 -o {tmp}/a.png", 2, r"parameter 'reach_texels': 5 is out of range; 2 to 4"),
    Case(RENDER + "--set distance_mm=0 -o {tmp}/a.png", 2, r"parameter 'distance_mm': 0 is out of range; 1 to 1000000 mm"),
    Case(RENDER + "--set distance_mm=nan -o {tmp}/a.png", 2, r"parameter 'distance_mm': 'nan' is no number"),
    Case(RENDER + "--set camera_elevation_deg=90 -o {tmp}/a.png", 2, r"parameter 'camera_elevation_deg': 90 is out of range; -89 to 89 deg"),
    Case(RENDER + "--set spin_roll_deg_s=1e9 -o {tmp}/a.png", 2, r"parameter 'spin_roll_deg_s': 1e9 is out of range"),
    Case(RENDER + "--set glow=2 -o {tmp}/a.png", 2, r"parameter 'glow': 2 is out of range; 0 to 1"),
    Case(RENDER + "--set model_size=0 -o {tmp}/a.png", 2, r"parameter 'model_size': 0 is out of range; 0\.01 to 1"),
    # the camera inside the box, and far away
    Case(RENDER + "--set model=sphere --set distance_mm=1 -o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(RENDER + "--set model=sphere --set distance_mm=1000000 --set pane_mm=1 -o {tmp}/a.png", 0, None, made=("a.png",)),

    # outputs
    Case(RENDER + "-o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(RENDER + "-o {tmp}/a.exr", 0, None, made=("a.exr",)),
    Case(RENDER + "-o {tmp}/a.hdr", 0, None, made=("a.hdr",)),
    Case(RENDER + "-o {tmp}/a.tif", 0, None, made=("a.tif",)),
    Case(RENDER + "-o {tmp}/none/a.png", 2, r"none/a\.png: its folder is not there; make it first"),
    Case(RENDER + "-o {data}/folder.exr", 2, r"folder\.exr: "),
    Case(RENDER + "-o {tmp}/a.nonsense", 2, r"a\.nonsense: "),
    Case(RENDER + "-o /dev/full/a.png", 2, r"/dev/full/a\.png: "),
    Case(RENDER + "--size 256x256 -o {tmp}/a.png", 71, r"a\.png: ", limit=64),
    Case(RENDER + "--size 256x256 -o {tmp}/a.exr", 71, r"a\.exr: ", limit=64),

    # frames in a row
    Case(FRAMES + "-o {tmp}/a.webm", 0, None, made=("a.webm",)),
    Case(FRAMES + "--frames 3 --size 1x1 -o {tmp}/a.WebM", 0, None, made=("a.WebM",)),
    Case(FRAMES + "--frames 0-2 -o {tmp}/a%d.exr", 0, None, made=("a0.exr", "a1.exr", "a2.exr")),
    Case(FRAMES + "-o {tmp}/%03d.tif", 0, None, made=("001.tif", "002.tif")),
    Case(FRAMES + "--frames 5000000-5000001 -o {tmp}/none/a.webm", 2, r"none/a\.webm: its folder is not there; make it first"),
    Case(FRAMES + "--frames 5000000-5000001 -o {tmp}/none/%d.png", 2, r"none/5000000\.png: its folder is not there; make it first"),
    Case(FRAMES + "--frames 5000000-5000001 -o {tmp}/%d.nonsense", 2, r"5000000\.nonsense: the extension \"\.nonsense\" is not a known picture's"),
    Case(FRAMES + "--frames 5000000-5000001 -o {tmp}/a.webm", 77,
         r"a\.webm: a clip is made by vpxenc, which is not here; install the Debian package vpx-tools", {"PATH": "/nonexistent"}),
    Case(FRAMES + "-o {tmp}/a.webm", 71, r"a\.webm: cannot be written: File too large; allow larger files \(ulimit -f\)", limit=64),
    Case(FRAMES + "--set environment=/nonexistent.exr -o {tmp}/a.webm", 2, r"/nonexistent\.exr: .*check the name"),
]

TABLES = [
    # arguments
    Case("table stupacher-2", 2, r"table 'stupacher-2': unknown; the nearest is 'stuppacher-2', and `raingauge list tables` prints them"),
    Case("table --rows 0-1", 2, r"--rows 0-1: rows count from 1, the first not after the last"),
    Case("table --rows 3-2", 2, r"--rows 3-2: rows count from 1, the first not after the last"),
    Case("table stuppacher-2 --rows 9-9 --device cpu", 2, r"--rows 9-9: stuppacher-2 has rows 1-3"),
    Case("table stuppacher-2 --rows 1-4 --device cpu", 2, r"--rows 1-4: stuppacher-2 has rows 1-3"),
    Case("table --rows 99999999999999999999 --device cpu", 2, r"--rows \d+-\d+: \S+ has rows 1-\d+$"),
    Case("table stuppacher-2 nonsense --device cpu -o {tmp}", 2, r"table 'nonsense': unknown"),
    Case("table --rows abc", 2, r"--rows abc: write it as FIRST-LAST, as in 2-4"),
    Case("table --rows 1-", 2, r"--rows 1-: write it as FIRST-LAST, as in 2-4"),
    Case("table --quick --full", 2, r"--quick and --full: choose one"),
    Case("table --format nonsense", 2, r"--format nonsense: choose md, csv, json or tex"),
    Case("table stuppacher-2 --set nonsense=1 --device cpu", 2, r"parameter 'nonsense': flow has none of that name"),
    Case("table --set drops=1 --device cpu", 2, r"parameter 'drops': \w+ has none of that name"),
    Case("table stuppacher-2 --variant nonsense --device cpu", 2, r"--variant nonsense: table 'stuppacher-2' times no such thing; its first is full"),
    Case("table --variant nonsense --device cpu", 2, r"--variant nonsense: no table times such a thing"),
    Case("table stuppacher-1 --work reading --device cpu", 2, r"--work reading: table 'stuppacher-1' has no such work"),
    Case("table --set drops=1 --from {data}", 2, r"--from and --set: choose one"),
    Case("table stuppacher-2 --device nonsense --set environment={data}/stuppacher-2.md -o {data}", 2,
         r"stuppacher-2\.md: would be overwritten, and is read as '.*/stuppacher-2\.md'; name another with -o"),
    Case("table stuppacher-2 --device nonsense --set environment={data}/a.png -o {data}", 2, r"stuppacher-2\.tex: would be overwritten, and is read as '.*/a\.png'"),
    Case("table stuppacher-2 --device nonsense --set environment={data}/b.png -o {data}", 2, UNKNOWN_DEVICE),
    Case("sweep drops --axis background={data}/a.png,{data}/sweep-drops.csv --device nonsense -o {data}", 2, r"sweep-drops\.csv: would be overwritten"),
    Case("sweep drops --axis seed=1 --set background={data}/sweep-drops-quick.journal --device nonsense -o {data}", 2,
         r"sweep-drops-quick\.journal: would be overwritten"),
    Case("sweep flow", 2, r"--axis: none is of a parameter; name one, as in --axis seed=1,2\.\.5"),
    Case("sweep", 2, r"no technique named; `raingauge list techniques` prints them"),
    Case("sweep flow --axis seed", 2, r"--axis seed: write it as NAME=VALUE,VALUE or NAME=5,10\.\.40"),
    Case("sweep flow --axis seed=5..9", 2, r"--axis seed=5\.\.9: a range goes on from a number before it, as in 5,10\.\.40"),
    Case("sweep flow --axis nonsense=1", 2, r"parameter 'nonsense': flow has none of that name"),
    Case("sweep flow --axis seed=1,2..9 --axis drops=1,2..9", 2, r"--axis: 81 rows are more than 64; leave some values out"),
    Case("sweep flow --axis seed=1 --axis device=cpu --axis device=gl", 2, r"--axis device: stands twice; name all devices at once"),
    Case("sweep flow --axis seed=1 --axis device=cpu --device cpu", 2, r"--axis device: --device names devices too; leave one of the two out"),
    Case("sweep flow --axis seed=1 --axis device=nonsense", 2, UNKNOWN_DEVICE),
    Case("sweep streaks --axis splash_fade=0,0.25 --axis look=thesis --dry-run", 2, r"--axis look: stands for other parameters; name it before --axis splash_fade"),
    Case("sweep flow --axis seed=1,2 --dry-run --set environment=" + 1012 * "a", 2, r"--set: 1024 bytes in all; a table takes at most 1023"),
    Case("table stuppacher-2 --device cpu --set environment=" + 1012 * "a", 2, r"--set: 1024 bytes in all; a table takes at most 1023"),
    Case("sweep flow --axis drops=10,100 --set drops=5 --dry-run", 2, r"--axis drops: --set drops=5 would give .*; leave one of the two out"),
    Case("sweep streaks --axis splash_fade=0,0.25 --set seed=2 --set look=thesis --dry-run", 2, r"--axis splash_fade: --set look=thesis would give"),
    Case("table --budget soon", 2, r"--budget 'soon': is no time; write it as 90s, 4m or 1h"),
    Case("table --budget 0s", 2, r"--budget '0s': is no time"),
    Case("table --budget 4m --full", 2, r"--full"),
    Case("table chin-drops --device cpu --budget 0.001s", 2,
         (r"within the budget, of which 0 s are left: the first rows of each table$",
          r"--budget: a first row, of chin-drops, is done \d+ s after the start, so that nothing fits into 0.001 s; give \d+s or more, or name")),
    Case("table raster-1 --device nonsense", 2, UNKNOWN_DEVICE),
    Case("table raster-1 --device ,", 2, r"--device ',': names no device"),

    # outputs
    Case(TABLE, 0, None),
    Case(TABLE + "-o {tmp}", 0, None, made=TABLE_FILES),
    Case(SMALL_TABLE + "stuppacher-2 -o {tmp}", 0, None, made=TABLE_FILES),
    Case(SMALL_TABLE + "--fresh -o {tmp}", 0, None, made=TABLE_FILES),
    Case(SMALL_TABLE + "-o {tmp}/none/out", 2, r"none/out: its folder is not there; make it first"),
    Case(SMALL_TABLE + "-o {data}/a.png", 2, r"a\.png: cannot be written: Not a directory; name a folder"),
    Case(SMALL_TABLE + "-o /proc/out", 2, r"/proc/out: .*"),
    Case(SMALL_TABLE + "-o {tmp}", 71, NEITHER_FITS, limit=64),
    Case(SMALL_TABLE + "-o {tmp}/out", 71, NEITHER_FITS, limit=64),
]

WITH_DRIVERS = [
    Case("list devices", 0, None),
    Case("list devices", 0, r"vulkan: .*; install the Debian package mesa-vulkan-drivers, which brings one$",
         {"XDG_DATA_DIRS": "/nonexistent"}),
    Case("list devices", 0, r"cpu: RG_CPU_LEVEL=v9 is no level .*; use plain, v2, v3 or v4$", {"RG_CPU_LEVEL": "v9"}),

    # absent drivers
    Case(RENDER + "--device vulkan -o {tmp}/a.png", 77, NO_VULKAN, NO_DRIVERS),
    Case(RENDER + "--device opencl -o {tmp}/a.png", 77, NO_OPENCL, NO_DRIVERS),
    Case(RENDER + "--device gl -o {tmp}/a.png", 77, NO_GL, NO_DRIVERS),
    Case("doctor --device vulkan", 77, NO_VULKAN, NO_DRIVERS),
    Case("doctor --device gl --json", 77, NO_GL, NO_DRIVERS),
    Case("diff flow --device cpu,vulkan", 77, NO_VULKAN, NO_DRIVERS),
    Case("verify flow --device opencl", 77, NO_OPENCL, NO_DRIVERS),
    Case("table raster-1 --device gl", 77, NO_GL, NO_DRIVERS),
    Case("table stuppacher-2 --rows 1-1 --device all -o {tmp}", 0, ABSENT, NO_DRIVERS, made=TABLE_FILES),
    Case("diff flow --frame 1 " + SMALL, 0, ABSENT, NO_DRIVERS),
    Case("verify flow --stages " + SMALL, 0, ABSENT, NO_DRIVERS),

    # a folder of kernels that are FIFOs
    Case(RENDER + "--device opencl -o {tmp}/a.png", 2, r"fifos/.*\.cl: cannot be read; RG_KERNEL_DIR must hold",
         {"RG_KERNEL_DIR": "{data}/fifos"}),

    # a driver that creates no context
    Case(RENDER + "--device gl -o {tmp}/a.png", 77, NO_CONTEXT, OLD_GL),
    Case("table raster-1 --device gl", 77, NO_CONTEXT, OLD_GL),
    Case("table raster-1 --rows 1-1 --device cpu,gl", 77, NO_CONTEXT, OLD_GL),
    Case("table stuppacher-2 --rows 1-1 --device all", 0, r"warning: unsupported here: gl: no OpenGL 4\.5 core", OLD_GL),
]


def write_what_is_no_file(runner, data):
    """FIFOs without a writer, and a socket."""
    database = os.path.join(data, "fifos", "point_light_database", "txt")
    os.makedirs(database)
    for name in ("fifo.png", "fifo.tif", "fifo.json", "fifo.ktx", "fifo.obj", "fifo.txt", "fifos/stuppacher-2.tex", "fifos/sweep-flow.json",
                 os.path.join(database, "dcam00_point_max.txt")):
        os.mkfifo(os.path.join(data, name))
    for name in os.listdir(runner.kernels):
        if name.endswith(".cl"):
            os.mkfifo(os.path.join(data, "fifos", name))
    with socket.socket(socket.AF_UNIX) as bound:
        bound.bind(os.path.join(data, "socket.json"))


def write_inputs(runner, data):
    """Pictures and environments, whole and cut short."""
    for name, more in (("a.png", ""), ("b.png", "--exposure 2"), ("wide.png", "--size 48x32"), ("a.exr", "")):
        runner.run((RENDER + "-o %s/%s %s" % (data, name, more)).split())
    for whole, half in (("a.png", "half.png"), ("a.exr", "half.exr")):
        with open(os.path.join(data, whole), "rb") as source, open(os.path.join(data, half), "wb") as file:
            content = source.read()
            file.write(content[:len(content) // 2])
    os.mkdir(os.path.join(data, "in.files"))
    for name in ("in-flip.png", "in-difference.png", "in-cpu-cpu_reference-flip.png", "in2.png", "in.files/a.png",
                 "stuppacher-2.md", "sweep-drops.csv", "sweep-drops-quick.journal"):
        shutil.copy(os.path.join(data, "a.png"), os.path.join(data, name))
    for link in ("link-flip.png", "stuppacher-2.tex"):
        os.symlink(os.path.join(data, "a.png"), os.path.join(data, link))
    packaged = "/usr/share/open3d-gui/resources/crossroads_skybox.ktx"
    start = open(packaged, "rb").read(4096) if os.path.exists(packaged) else b"\xabKTX 11\xbb\r\n\x1a\n" + bytes(52)
    runs = b"\2\2\x08\0" + 4 * (16 * b"\xff\x80" + b"\x90\x80")  # a line of 2048 pixels
    large = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1536 +X 2048\n" + 1536 * runs
    for name, content in (("short.ktx", start[:20]), ("half.ktx", start), ("short.exr", b"\x76\x2f\x31\x01\x02"), ("large.hdr", large)):
        with open(os.path.join(data, name), "wb") as file:
            file.write(content)
    os.mkdir(os.path.join(data, "folder.exr"))
    write_what_is_no_file(runner, data)


def check_case(runner, case, data, tmp):
    variables = {name: value and value.format(data=data) for name, value in case.env.items()}
    result = runner.run(case.args.format(tmp=tmp, data=data).split(), variables, case.limit)
    lines = result.stderr.splitlines()
    wanted = () if case.error is None else (case.error,) if isinstance(case.error, str) else case.error
    problems = []
    if result.returncode != case.exit:
        problems.append("exit status %d, not %d" % (result.returncode, case.exit))
    if len(lines) != len(wanted):
        problems.append("%d lines on stderr" % len(lines))
    for line, pattern in zip(lines, wanted):
        if not (line.startswith("raingauge: ") and re.search(pattern, line)):
            problems.append("no match for " + pattern)
    if sorted(os.listdir(tmp)) != sorted(case.made):
        problems.append("left behind: %s" % os.listdir(tmp))
    return problems + ["stderr: " + line for line in lines if problems]


def run(runner, cases):
    with tempfile.TemporaryDirectory() as data:
        write_inputs(runner, data)
        for case in cases:
            with tempfile.TemporaryDirectory() as tmp:
                name = " ".join(["%s=%s" % item for item in case.env.items()] + [case.args])
                runner.report(name + (" (full disk)" if case.limit else ""), check_case(runner, case, data, tmp))
