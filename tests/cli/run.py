#!/usr/bin/env python3
"""The command line as people and scripts meet it: exit codes, messages, files left behind.

    run.py SUITE RAINGAUGE KERNEL_DIR CRASHING_DRIVER        SUITE: cases | doctor

CASES is a table: a new command adds rows. Prints TAP, for meson.
"""
import collections
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile

# Variables that change what raingauge or a driver does; tests set what they mean to.
CHANGES = re.compile(r"^(RG_|LP_|OMP_|GOMP_|POCL_|VK_|MESA_|GALLIUM|GALLIVM|LIBGL_|EGL_|__EGL_|OCL_|LD_)")
NO_DRIVERS = {
    "VK_DRIVER_FILES": "/nonexistent",
    "OCL_ICD_VENDORS": "/nonexistent",
    "__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent",
}

# args: one string, split at spaces; {tmp} is an empty folder of the case's own, {data} the inputs.
# exit: the status. error: what the one line on stderr must match; None: stderr is empty.
# env: variables. limit: largest file in bytes that may be written, as on a full disk.
# made: files that must be in {tmp} afterwards, and no others.
Case = collections.namedtuple("Case", "args exit error env limit made", defaults=({}, None, ()))

UNKNOWN_DEVICE = r"device '.*': unknown; `raingauge list devices` prints the names"
RENDER = "render flow --set environment=sky --set environment_px=16 --set resolution_px=32 --size 32x32 --frame 1 "

CASES = [
    # every command
    Case("", 2, None),
    Case("--help", 0, None),
    Case("--version", 0, None),
    Case("nonsense", 2, r"command 'nonsense': unknown; `raingauge --help` lists them"),
    Case("list --nonsense", 2, r"--nonsense: unknown option; `raingauge list --help`"),
    Case("render --help", 0, None),
    Case("doctor --help", 0, None),

    # list
    Case("list techniques", 0, None),
    Case("list tables", 0, None),
    Case("list devices", 0, None),
    Case("list params flow", 0, None),
    Case("list", 2, r"list '': list techniques, tables, devices, or params TECHNIQUE"),
    Case("list nonsense", 2, r"list 'nonsense': list techniques"),
    Case("list params", 2, r"name a technique; `raingauge list techniques`"),
    Case("list params nonsense", 2, r"technique 'nonsense': unknown"),
    Case("list devices twice", 2, r"'twice' is one argument too many"),
    Case("list devices", 0, r"vulkan: .*package mesa-vulkan-drivers", {"VK_DRIVER_FILES": "/nonexistent"}),
    Case("list devices", 0, r"cpu: RG_CPU_LEVEL=v9 is no level .*; use plain, v2, v3 or v4$", {"RG_CPU_LEVEL": "v9"}),

    # render: what it is asked
    Case("render", 2, r"no technique named; `raingauge list techniques`"),
    Case("render nonsense", 2, r"technique 'nonsense': unknown; `raingauge list techniques`"),
    Case("render flow flow", 2, r"'flow' is one argument too many"),
    Case(RENDER + "--device nonsense -o {tmp}/a.png", 2, UNKNOWN_DEVICE),
    Case(RENDER + "--device cpu:nonsense -o {tmp}/a.png", 2, r"device 'cpu:nonsense': cpu has no such device"),
    Case(RENDER + "--device , -o {tmp}/a.png", 2, r"--device ,: render draws on one device"),
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
    Case(RENDER + "--exposure nan -o {tmp}/a.png", 2, r"--exposure nan: must be above 0"),
    Case(RENDER + "-o {tmp}/a.png -z", 2, r"-z: unknown option"),
    Case(RENDER + "--output", 2, r"--output: .*`raingauge render --help`"),

    # render: what it reads
    Case(RENDER + "--set environment=/nonexistent.exr -o {tmp}/a.png", 2, r"/nonexistent\.exr: .*check the name"),
    Case(RENDER + "--set environment={data}/short.ktx -o {tmp}/a.png", 2, r"short\.ktx: .*truncated"),
    Case(RENDER + "--set environment={data}/half.ktx -o {tmp}/a.png", 2, r"half\.ktx: "),
    Case(RENDER + "--set environment={data}/short.exr -o {tmp}/a.png", 2, r"short\.exr: "),
    Case(RENDER + "--set environment={data}/folder.exr -o {tmp}/a.png", 2, r"folder\.exr: "),

    # render: what it writes
    Case(RENDER + "-o {tmp}/a.png", 0, None, made=("a.png",)),
    Case(RENDER + "-o {tmp}/a.exr", 0, None, made=("a.exr",)),
    Case(RENDER + "-o {tmp}/none/a.png", 2, r"none/a\.png: its folder is not there; make it first"),
    Case(RENDER + "-o {data}/folder.exr", 2, r"folder\.exr: "),
    Case(RENDER + "-o {tmp}/a.nonsense", 2, r"a\.nonsense: "),
    Case(RENDER + "-o /dev/full/a.png", 2, r"/dev/full/a\.png: "),
    Case(RENDER + "--size 256x256 -o {tmp}/a.png", 2, r"a\.png: ", limit=64),
    Case(RENDER + "--size 256x256 -o {tmp}/a.exr", 2, r"a\.exr: ", limit=64),

    # what is absent
    Case(RENDER + "--device vulkan -o {tmp}/a.png", 77, r"install the Debian package mesa-vulkan-drivers", NO_DRIVERS),
    Case(RENDER + "--device opencl -o {tmp}/a.png", 77, r"install the Debian package pocl-opencl-icd", NO_DRIVERS),
    Case(RENDER + "--device gl -o {tmp}/a.png", 77, r"install the Debian package libegl-mesa0", NO_DRIVERS),
    Case("doctor --device vulkan", 77, r"install the Debian package mesa-vulkan-drivers", NO_DRIVERS),
    Case("doctor --device gl --json", 77, r"install the Debian package libegl-mesa0", NO_DRIVERS),

    # doctor
    Case("doctor --device nonsense", 2, UNKNOWN_DEVICE),
    Case("doctor --device cpu:7", 2, r"device 'cpu:7': cpu has no such device"),
    Case("doctor --device " + 40 * "x", 2, UNKNOWN_DEVICE),
    Case("doctor --device ,", 2, r"--device ',': names no device"),
    Case("doctor cpu", 2, r"doctor: 'cpu' is one argument too many"),
    Case("doctor --device cpu", 0, None),
]


class Runner:
    def __init__(self, raingauge, kernels, crasher):
        self.raingauge, self.kernels, self.crasher = map(os.path.abspath, (raingauge, kernels, crasher))
        self.count = self.failed = 0

    def run(self, args, env={}, limit=None):
        variables = {k: v for k, v in os.environ.items() if not CHANGES.match(k)}
        variables.update(env)

        def restrict():
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        return subprocess.run([self.raingauge] + args, env=variables, preexec_fn=restrict, timeout=300,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              encoding="utf-8")

    def report(self, name, problems):
        self.count += 1
        self.failed += bool(problems)
        print("%s %d - %s" % ("not ok" if problems else "ok", self.count, name.replace("#", "")))
        for problem in problems:
            print("# " + problem.replace("\n", "\n# "), flush=True)

    def finish(self):
        print("1..%d" % self.count)
        return 1 if self.failed else 0


def write_inputs(data):
    packaged = "/usr/share/open3d-gui/resources/crossroads_skybox.ktx"
    start = open(packaged, "rb").read(4096) if os.path.exists(packaged) else b"\xabKTX 11\xbb\r\n\x1a\n" + bytes(52)
    for name, content in (("short.ktx", start[:20]), ("half.ktx", start), ("short.exr", b"\x76\x2f\x31\x01\x02")):
        with open(os.path.join(data, name), "wb") as file:
            file.write(content)
    os.mkdir(os.path.join(data, "folder.exr"))


def check_case(runner, case, data, tmp):
    result = runner.run(case.args.format(tmp=tmp, data=data).split(), case.env, case.limit)
    lines = result.stderr.splitlines()
    problems = []
    if result.returncode != case.exit:
        problems.append("exit status %d, not %d" % (result.returncode, case.exit))
    if len(lines) != (case.error is not None):
        problems.append("%d lines on stderr" % len(lines))
    if case.error and lines and not (lines[0].startswith("raingauge: ") and re.search(case.error, lines[0])):
        problems.append("no match for " + case.error)
    if sorted(os.listdir(tmp)) != sorted(case.made):
        problems.append("left behind: %s" % os.listdir(tmp))
    return problems + ["stderr: " + line for line in lines if problems]


def run_cases(runner):
    with tempfile.TemporaryDirectory() as data:
        write_inputs(data)
        for case in CASES:
            with tempfile.TemporaryDirectory() as tmp:
                name = " ".join(["%s=%s" % item for item in case.env.items()] + [case.args])
                runner.report(name + (" (full disk)" if case.limit else ""), check_case(runner, case, data, tmp))


# --- doctor ---

def examine(runner, args, env={}):
    """A doctor's report as JSON, its exit status and its messages."""
    result = runner.run(["doctor", "--json"] + args, env)
    return json.loads(result.stdout), result.returncode, result.stderr


def by_name(report):
    return {device["name"]: device for device in report["devices"]}


def check_devices(runner):
    """Every device that `list` names is examined, and is well."""
    listed = json.loads(runner.run(["list", "devices", "--json"]).stdout)["devices"]
    report, status, errors = examine(runner, [])
    problems = []
    if report["format"] != 1 or status != 0 or errors:
        problems.append("format %s, exit status %d, stderr: %s" % (report["format"], status, errors))
    if [d["name"] for d in listed] != [d["name"] for d in report["devices"]]:
        problems.append("list and doctor name different devices")
    if [d["name"] for d in report["passport"]["devices"]] != [d["name"] for d in listed]:
        problems.append("the passport names other devices")
    for device in report["devices"]:
        if device["status"] != "ok" or any(o["different"] for o in device["operations"]):
            problems.append("%s: %s %s" % (device["name"], device["status"], device["why"]))
        if len(device["operations"]) < 40 or len(device["builtins"]) < 10 or device["timer"]["wall_ms"] <= 0:
            problems.append("%s: not examined in full" % device["name"])
    return problems


def check_passport(runner):
    """The passport says where numbers come from, and nothing that changes by itself."""
    # GOMP_SPINCOUNT: raingauge sets it where it is not set.
    variables = {"GOMP_SPINCOUNT": "8000", "LP_NUM_THREADS": "3", "RG_KERNEL_DIR": "/nonexistent"}
    passport, again = (examine(runner, ["--device", "cpu"], variables)[0]["passport"] for _ in range(2))
    problems = [] if passport == again else ["two passports of one machine differ"]
    if passport["environment"] != variables:
        problems.append("environment: %s" % passport["environment"])
    if passport["raingauge"]["kernel_dir"] != "/nonexistent":
        problems.append("kernel_dir: %s" % passport["raingauge"]["kernel_dir"])
    if not re.match(r"[0-9a-f]{40}(-dirty)?$|unknown$", passport["raingauge"]["commit"]):
        problems.append("commit: %s" % passport["raingauge"]["commit"])
    if passport["machine"]["cores_allowed"] != len(os.sched_getaffinity(0)):
        problems.append("cores_allowed: %d" % passport["machine"]["cores_allowed"])
    return problems


def check_missing(runner):
    """Where drivers are absent, the report names the packages that bring them."""
    result = runner.run(["doctor"], NO_DRIVERS)
    text = " ".join(result.stdout.split())
    problems = [package + " is not named" for package in ("libegl-mesa0", "mesa-vulkan-drivers", "pocl-opencl-icd")
                if "the Debian package " + package not in text]
    problems += ["%d columns: %s" % (len(line), line) for line in result.stdout.splitlines() if len(line) > 100]
    if result.returncode != 0 or result.stderr:
        problems.append("exit status %d, stderr: %s" % (result.returncode, result.stderr))
    return problems


def check_warnings(runner):
    """Thread variables that differ, and a kernel folder, are warned of."""
    report = examine(runner, ["--device", "cpu"], {"LP_NUM_THREADS": "1", "POCL_MAX_PTHREAD_COUNT": "2", "OMP_NUM_THREADS": "2",
                                                   "RG_KERNEL_DIR": "/nonexistent"})[0]
    warnings = "\n".join(report["warnings"])
    problems = []
    for expected in (r"different numbers of threads: cpu on 2 \(OMP_NUM_THREADS\), gl and vulkan on 1 \(LP_NUM_THREADS\), "
                     r"opencl on 2 \(POCL_MAX_PTHREAD_COUNT\)", r"RG_KERNEL_DIR=/nonexistent: .*cannot be read"):
        if not re.search(expected, warnings):
            problems.append("no warning matches %s in:\n%s" % (expected, warnings))
    return problems


def check_crash(runner):
    """A driver that crashes is named, and harms no other device."""
    with tempfile.TemporaryDirectory() as tmp:
        driver = os.path.join(tmp, "crash.json")
        with open(driver, "w") as file:
            json.dump({"file_format_version": "1.0.0",
                       "ICD": {"library_path": runner.crasher, "api_version": "1.3.0"}}, file)
        report, status, errors = examine(runner, ["--device", "cpu,vulkan"], {"VK_DRIVER_FILES": driver})
    devices = by_name(report)
    problems = []
    if devices["cpu"]["status"] != "ok":
        problems.append("cpu: " + devices["cpu"]["status"])
    if devices["vulkan"]["status"] != "crash" or "opening the device: its driver crashed (Aborted)" not in devices["vulkan"]["why"]:
        problems.append("vulkan: %s, %s" % (devices["vulkan"]["status"], devices["vulkan"]["why"]))
    if not any(line.startswith("vulkan: its driver crashed (Aborted)") for line in report["missing"]):
        problems.append("missing: %s" % report["missing"])
    if status != 1 or len(errors.splitlines()) != 1:
        problems.append("exit status %d, stderr: %s" % (status, errors))
    return problems


def check_wrong_arithmetic(runner):
    """One operation that is wrong on one device is found and named, and the exit status is 1."""
    right, wrong = "floatBitsToUint(a *b)", "(floatBitsToUint(a *b) ^ 1u)"
    with tempfile.TemporaryDirectory() as tmp:
        for name in os.listdir(runner.kernels):
            if name.endswith((".glsl", ".cl", ".spv")):
                shutil.copy(os.path.join(runner.kernels, name), tmp)
        path = os.path.join(tmp, "probe_ops.glsl")
        with open(path) as file:
            source = file.read()
        with open(path, "w") as file:
            file.write(source.replace(right, wrong))
        report, status, errors = examine(runner, ["--device", "gl"], {"RG_KERNEL_DIR": tmp})
        text = runner.run(["doctor", "--device", "gl"], {"RG_KERNEL_DIR": tmp}).stdout
    if right not in source:
        return ["probe_ops.glsl no longer holds " + right]
    device = by_name(report)["gl"]
    if device["status"] == "unsupported":
        return []
    different = [o for o in device["operations"] if o["different"]]
    problems = []
    if [(o["name"], o["different"], o["largest_ulps"]) for o in different] != [("multiply", 65536, 1)]:
        problems.append("different: %s" % different)
    if device["status"] != "fail" or status != 1 or "'gl': 1 of" not in errors:
        problems.append("%s, exit status %d, stderr: %s" % (device["status"], status, errors))
    if not re.search(r"FAIL multiply: 65536 of 65536 results differ from C, the largest by 1 ulp", text):
        problems.append("the text does not say so:\n" + text)
    return problems


DOCTOR = [check_devices, check_passport, check_missing, check_warnings, check_crash, check_wrong_arithmetic]


def run_doctor(runner):
    for check in DOCTOR:
        runner.report(check.__doc__, check(runner))


def main():
    runner = Runner(*sys.argv[2:5])
    {"cases": run_cases, "doctor": run_doctor}[sys.argv[1]](runner)
    return runner.finish()


if __name__ == "__main__":
    sys.exit(main())
