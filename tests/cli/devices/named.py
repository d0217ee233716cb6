"""The named driver is the driver that runs: a second Mesa in a folder, named rightly and in eight wrong ways."""
import glob
import hashlib
import json
import os
import re
import shutil
import tempfile

import forms
from gates import KNOT, Files
from machine import run_json

SMALL = "raster --set scene=triangles --set triangles=1000 --size 64x48 --frame 2".split()
VULKAN, GL, OPENCL = "vulkan", "gl", "opencl"


def patched(path, old, new):
    """Replaces bytes of a file by as many others."""
    with open(path, "rb") as file:
        content = file.read()
    if old not in content or len(old) != len(new):
        raise ValueError("%s does not hold %r" % (path, old))
    with open(path, "wb") as file:
        file.write(content.replace(old, new))


class Tree:
    """A folder like an unpacked Debian package of drivers, with the system's libraries under other build ids. Its manifests name
    libraries without a path, as packages of newer drivers do."""

    def __init__(self, root, drivers, same_build=False):
        self.root, self.drivers, self.files = root, drivers, {}
        self.libraries = self.folder("usr/lib/x86_64-linux-gnu")
        if VULKAN in drivers:
            self.add(VULKAN, drivers[VULKAN], same_build)
            self.icd = self.manifest("usr/share/vulkan/icd.d/lvp_icd.json", os.path.basename(drivers[VULKAN]["path"]), api_version="1.1.0")
        if GL in drivers:
            self.folder("usr/lib/x86_64-linux-gnu/dri")
            self.add(GL, drivers[GL], same_build, "dri")
            shutil.copy(self.egl_of_system(), os.path.join(self.libraries, "libEGL_mesa.so.0"))
            self.vendor = self.manifest("usr/share/glvnd/egl_vendor.d/50_mesa.json", "libEGL_mesa.so.0")
        if OPENCL in drivers:
            self.add(OPENCL, drivers[OPENCL], same_build)
            shutil.copytree(os.path.join(os.path.dirname(drivers[OPENCL]["path"]), "pocl"), os.path.join(self.libraries, "pocl"))
            shutil.copytree(os.path.join(os.path.dirname(drivers[OPENCL]["path"]), "../../share/pocl"), self.folder("usr/share") + "/pocl")
            self.write("etc/OpenCL/vendors/pocl.icd", os.path.basename(drivers[OPENCL]["path"]) + "\n")

    def folder(self, name):
        os.makedirs(os.path.join(self.root, name), exist_ok=True)
        return os.path.join(self.root, name)

    def write(self, name, text):
        self.folder(os.path.dirname(name))
        with open(os.path.join(self.root, name), "w") as file:
            file.write(text)
        return os.path.join(self.root, name)

    def manifest(self, name, library, **more):
        return self.write(name, json.dumps({"file_format_version": "1.0.0", "ICD": dict(more, library_path=library)}))

    def add(self, api, driver, same_build, below=""):
        to = os.path.join(self.libraries, below, os.path.basename(driver["path"]))
        shutil.copy(driver["path"], to)
        build = bytes.fromhex(driver["build"])
        if not same_build:
            patched(to, build, bytes([build[0] ^ 255]) + build[1:])
        self.files[api] = to

    def egl_of_system(self):
        """EGL's library for libglvnd, next to the folder of the drivers that it loads."""
        return os.path.realpath(os.path.join(os.path.dirname(os.path.dirname(self.drivers[GL]["path"])), "libEGL_mesa.so.0"))

    def with_driver(self, api):
        return "new=%s@DRIVER=%s" % (api, self.root)


def of_system(runner):
    """The libraries of the system's drivers, by API, as raingauge reports them."""
    names = [device["name"] for device in json.loads(runner.run(["list", "devices", "--json"]).stdout)["devices"]]
    asked = [api for api in (VULKAN, GL, OPENCL) if api in names]
    report = json.loads(runner.run(["diff"] + SMALL + ["--json", "--device", ",".join(["cpu"] + asked)]).stdout)
    found = {device["name"]: device["libraries"][0] for device in report["devices"]}
    return {api: found[api] for api in asked if re.search("lvp|_dri|pocl", found[api]["path"])}


def with_tree(check):
    """Runs a check with a tree of this machine's drivers."""
    def run(runner):
        with tempfile.TemporaryDirectory() as tmp:
            drivers = of_system(runner)
            return check(runner, Tree(os.path.join(os.path.realpath(tmp), "new"), drivers), drivers)
    run.__doc__ = check.__doc__
    return run


def wrong_names(tree, drivers):
    """(name, API, status, pattern of the line) of the eight wrong namings."""
    absent = os.path.join(tree.root, "absent.json")
    if VULKAN in drivers:
        broken = os.path.join(tree.folder("broken"), "libvulkan_lvp.so")
        shutil.copy(tree.files[VULKAN], broken)
        patched(broken, b"libLLVM-", b"libXXXX-")
        path = tree.manifest("broken/vulkan.json", broken, api_version="1.1.0")
        yield "vulkan@VK_DRIVER_FILES=" + tree.icd, 2, "is a bare name.*write 'vulkan@DRIVER=%s'" % tree.root
        yield "vulkan@VK_DRIVER_FILES=" + path, 1, "libXXXX-.*cannot open shared object file.*LD_LIBRARY_PATH"
        yield "vulkan@VK_DRIVER_FILES=" + absent, 77, "VK_DRIVER_FILES names .*absent.json, which is not there"
        yield "vulkan@LD_LIBRARY_PATH=" + tree.libraries, 2, "run one driver, .*write 'vulkan@DRIVER=%s'" % tree.root
    if GL in drivers:
        broken = os.path.join(tree.folder("broken"), "libEGL_mesa.so.0")
        shutil.copy(tree.egl_of_system(), broken)
        patched(broken, b"libgbm.so.1", b"libXXX.so.1")
        path = tree.manifest("broken/egl.json", broken)
        yield "gl@__EGL_VENDOR_LIBRARY_FILENAMES=" + tree.vendor, 2, "is a bare name.*write 'gl@DRIVER=%s'" % tree.root
        yield "gl@__EGL_VENDOR_LIBRARY_FILENAMES=" + path, 1, "libXXX.so.1.*cannot open shared object file.*LD_LIBRARY_PATH"
        yield "gl@__EGL_VENDOR_LIBRARY_FILENAMES=" + absent, 77, "_FILENAMES names .*absent.json, which is not there"
        yield "gl@LD_LIBRARY_PATH=" + tree.libraries, 2, "run one driver, .*write 'gl@DRIVER=%s'" % tree.root


@with_tree
def check_wrong_names(runner, tree, drivers):
    """a driver named in one of eight wrong ways is no pass of gate and diff, and one line has the remedy"""
    problems = []
    with Files(KNOT) as files:
        for name, status, said in wrong_names(tree, drivers):
            api = name.split("@")[0]
            for args in (["gate", api, name, "--pictures", "--cells", files.cells], ["diff"] + SMALL + ["--device", api + "," + name]):
                result = runner.run(args)
                lines = result.stderr.splitlines()
                if result.returncode != status or len(lines) != 1 or not re.search(said, lines[0]) or "apt" in result.stderr:
                    problems.append("%s: exit status %d, not %d, %s" % (" ".join(args), result.returncode, status, result.stderr))
    return problems


@with_tree
def check_alone(runner, tree, drivers):
    """a manifest whose library comes from another tree is refused for a single device, too"""
    problems = []
    names = [row[0] for row in wrong_names(tree, drivers) if row[1] == 2 and "LD_LIBRARY" not in row[0]]
    for name in names:
        for args in (["render"] + SMALL + ["--device", name, "-o", os.path.join(tree.root, "x.png")],
                     "table stuppacher-2 --work paper --rows 1-1 --device".split() + [name]):
            result = runner.run(args)
            if result.returncode != 2 or "is a bare name" not in result.stderr:
                problems.append("%s: exit status %d, %s" % (args, result.returncode, result.stderr))
    return problems


def above(text, build):
    """Whether a build id stands above all findings."""
    head = re.split("(?m)^(?:pass|pair|ok|\\|) ", text)[0]
    return "build id " + build in head


@with_tree
def check_prefix(runner, tree, drivers):
    """DRIVER=PREFIX runs the driver in that folder, under a short name; both drivers are named first, in text and in JSON"""
    problems = []
    with Files(KNOT) as files:
        for api, driver in drivers.items():
            junit = files.path("%s.xml" % api)
            gate = ["gate", api, tree.with_driver(api), "--pictures", "--cells", files.cells, "--require", "new", "--junit", junit]
            diff = ["diff"] + SMALL + ["--device", api + "," + tree.with_driver(api), "--require", "new," + api]
            for args in (gate, diff):
                result = runner.run(args)
                new = "%02x" % (int(driver["build"][:2], 16) ^ 255) + driver["build"][2:]
                if result.returncode or result.stderr or not above(result.stdout, driver["build"]) or not above(result.stdout, new):
                    problems.append("%s: exit status %d, %s, %s" % (args, result.returncode, result.stderr, result.stdout))
                if tree.files[api] not in result.stdout or "new (%s@DRIVER=%s)" % (api, tree.root) not in result.stdout:
                    problems.append("%s: %s" % (args, result.stdout))
            with open(junit) as file:
                told = file.read()
            if 'name="raster/knot.new"' not in told or tree.files[api] not in told or "new=" in told:
                problems.append("JUnit: " + told)
            report, status, messages = run_json(runner, " ".join(diff), {})
            problems += messages + forms.problems("diff", report)
            devices = {device["name"]: device for device in report["devices"]}
            if status or devices["new"]["full"] != "%s@DRIVER=%s" % (api, tree.root) or devices["new"]["libraries"][0]["path"] != tree.files[api]:
                problems.append("diff --json: %s" % devices)
    return problems


@with_tree
def check_told(runner, tree, drivers):
    """verify and a sweep of two sides name both drivers before their findings, and a record has the name to open the device again"""
    problems = []
    if VULKAN not in drivers:
        return problems
    sides = VULKAN + "," + tree.with_driver(VULKAN)
    verify = "verify raster --stages --frame 1 --size 64x48 --set scene=triangles --set triangles=1000 --device".split() + [sides]
    table = ("sweep raster --frame 1 --size 64x48 --axis triangles=1000 --set scene=triangles --device".split() +
             [sides, "-o", tree.folder("tables")])
    for args in (verify, table):
        result = runner.run(args)
        if result.returncode or not above(result.stdout, drivers[VULKAN]["build"]) or tree.files[VULKAN] not in result.stdout:
            problems.append("%s: exit status %d, %s, %s" % (args, result.returncode, result.stderr, result.stdout))
    record = glob.glob(os.path.join(tree.root, "tables", "*.json"))[0]
    kept = runner.run(["table", "--from", record])
    if kept.stdout != result.stdout:
        problems.append("printed again it is %s" % kept.stdout)
    with open(record) as file:
        devices = {device["name"]: device for device in json.load(file)["passport"]["devices"]}
    if devices["new"]["full"] != "vulkan@DRIVER=" + tree.root:
        problems.append("%s" % devices)
    return problems


def check_one_build(runner):
    """one build in two files is a warning, and other settings of one driver are not"""
    problems = []
    drivers = {api: driver for api, driver in of_system(runner).items() if api == VULKAN}
    with tempfile.TemporaryDirectory() as tmp, Files(KNOT) as files:
        for api in drivers:
            tree = Tree(os.path.join(tmp, "copy"), drivers, same_build=True)
            result = runner.run(["gate", api, tree.with_driver(api), "--pictures", "--cells", files.cells])
            if result.returncode or not re.search("warning: devices .* run one build of a driver from two files", result.stderr):
                problems.append("exit status %d, %s" % (result.returncode, result.stderr))
            result = runner.run(["gate", api, api + "@LP_NUM_THREADS=1", "--pictures", "--cells", files.cells])
            if result.returncode or result.stderr:
                problems.append("exit status %d, %s" % (result.returncode, result.stderr))
    return problems


@with_tree
def check_refused(runner, tree, drivers):
    """a folder without a driver, or with one that cannot run here, and impossible names are refused in one line"""
    problems = []
    rows = [("vulkan@DRIVER=%s/nothing" % tree.root, 2, "is no folder"),
            ("vulkan@DRIVER=%s" % tree.folder("empty"), 77, "has no driver of vulkan"),
            ("cpu@DRIVER=%s" % tree.root, 2, "cpu has no driver"),
            ("gl=vulkan", 2, "is no API's"), ("a=cpu,a=gl", 2, "'a' is short for 'cpu' already"), ("a=cpu,a=cpu", 2, "stands there twice")]
    if VULKAN in drivers:
        rows.append(("vulkan@DRIVER=%s;VK_DRIVER_FILES=%s" % (tree.root, tree.icd), 2, "leave one of them out"))
        well = tree.manifest("listed/well.json", drivers[VULKAN]["path"], api_version="1.1.0")
        rows.append(("vulkan@VK_DRIVER_FILES=%s/absent.json:%s" % (tree.root, well), 1, "names '.*/absent.json', which cannot be read"))
        for name, change, status, said in (
                ("foreign", lambda path: patch_at(path, 18, b"\xf3\x00"), 2, "is for another processor"),
                ("needy", lambda path: patched(path, b"libLLVM-", b"libXXXX-"), 1, "libXXXX-.*unpack it into"),
                ("lacking", os.remove, 77, "names a library that is not in")):
            other = Tree(os.path.join(tree.root, name), {VULKAN: drivers[VULKAN]})
            change(other.files[VULKAN])
            rows.append(("vulkan@DRIVER=" + other.root, status, said))
    for name, status, said in rows:
        result = runner.run(["render"] + SMALL + ["-o", os.path.join(tree.root, "x.png"), "--device", name] if "," not in name
                            else ["diff"] + SMALL + ["--device", name])
        if result.returncode != status or len(result.stderr.splitlines()) != 1 or not re.search(said, result.stderr):
            problems.append("%s: exit status %d, not %d, %s" % (name, result.returncode, status, result.stderr))
    return problems


def patch_at(path, at, content):
    with open(path, "r+b") as file:
        file.seek(at)
        file.write(content)


# --- caches ---


def code_in(folder):
    """Files of code below a folder."""
    return [path for path in glob.glob(os.path.join(folder, "**"), recursive=True) if os.path.isfile(path) and os.path.getsize(path)]


def check_caches(runner):
    """a device with its own settings, and each side of a gate, leave the user's caches alone; a plain device uses them. Sides that differ by
    raingauge's own settings alone share their code"""
    problems = []
    drivers = of_system(runner)
    for api in drivers:
        with tempfile.TemporaryDirectory() as tmp, Files(KNOT) as files:
            user = os.path.join(tmp, "user")
            own = os.path.join(tmp, "own")
            variables = {"XDG_CACHE_HOME": tmp, "MESA_SHADER_CACHE_DIR": user, "POCL_CACHE_DIR": user}
            for name in (user, own):
                os.mkdir(name)
            render = ["render"] + SMALL + ["-o", files.path("x.png"), "--device"]
            sides = os.path.join(tmp, "raingauge", "sides")
            gate = ["gate", api, api, "--pictures", "--cells", files.cells]
            for args, grows in ((render + [api + "@TEST=1"], True), (gate, True), (render + [api + "@RG_PROGRAM=" + runner.raingauge], True), (gate[:1] + [api + "@RG_TEST=1", api + "@RG_TEST=2"] + gate[3:], False)):
                before = len(code_in(sides))
                result = runner.run(args, variables)
                if result.returncode or code_in(user) or (len(code_in(sides)) > before) != grows:
                    problems.append("%s: exit status %d, %s, %s" % (args, result.returncode, result.stderr, code_in(user)))
            variable = "POCL_CACHE_DIR" if api == OPENCL else "MESA_SHADER_CACHE_DIR"
            runner.run(render + ["%s@%s=%s" % (api, variable, own)], variables)
            runner.run(render + [api], variables)
            if not code_in(own) or not code_in(user):
                problems.append("%s: what the device's own settings say of a cache, or a plain device's, is not obeyed" % api)
    return problems


def check_kept_apart(runner):
    """in one user's cache, code that Mesa compiled under LP_PERF=no_tex never runs without it, and the reverse"""
    problems = []
    if VULKAN not in of_system(runner):
        return problems
    with tempfile.TemporaryDirectory() as tmp:
        def digest(device, cache):
            path = os.path.join(tmp, "x.png")
            os.makedirs(os.path.join(tmp, cache), exist_ok=True)
            result = runner.run("render drops --size 48x48 --frame 2 -o".split() + [path, "--device", device],
                                {"XDG_CACHE_HOME": os.path.join(tmp, cache)})
            if result.returncode:
                problems.append("%s: exit status %d, %s" % (device, result.returncode, result.stderr))
                return None
            with open(path, "rb") as file:
                return hashlib.sha256(file.read()).hexdigest()

        switched, after, again = [digest(device, "one") for device in ("vulkan@LP_PERF=no_tex", "vulkan", "vulkan@LP_PERF=no_tex")]
        plain = digest("vulkan", "other")
        if after != plain or again != switched:
            problems.append("a run took another's code: %s" % [switched, after, again, plain])
        if switched == plain:
            problems.append("LP_PERF=no_tex draws the same, and proves nothing")
    return problems


def check_bounded(runner):
    """beyond 32 folders of sides, the least recently used ones are removed"""
    problems = []
    for api in list(of_system(runner))[:1]:
        with tempfile.TemporaryDirectory() as tmp:
            sides = os.path.join(tmp, "raingauge", "sides")
            for i in range(40):
                os.makedirs(os.path.join(sides, "%016x" % i, "0", "mesa"))
                os.utime(os.path.join(sides, "%016x" % i), (1e9 + i, 1e9 + i))
            args = ["render"] + SMALL + ["-o", os.path.join(tmp, "x.png"), "--device", api + "@RG_TEST=1"]
            result = runner.run(args, {"XDG_CACHE_HOME": tmp})
            left = sorted(os.listdir(sides))
            if result.returncode or len(left) != 32 or "%016x" % 8 in left or "%016x" % 39 not in left:
                problems.append("exit status %d, %s, %d are left: %s" % (result.returncode, result.stderr, len(left), left))
    return problems


CHECKS = [check_wrong_names, check_alone, check_one_build, check_refused, check_bounded]
SIDES = [check_prefix, check_told, check_caches, check_kept_apart]
