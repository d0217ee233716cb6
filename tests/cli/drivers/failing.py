"""Drivers that are installed but unusable: each fails, with the reason, and is never called absent; an absent driver is no failure."""
import concurrent.futures
import json
import os
import re
import shlex
import tempfile

from runner import LATER

SMALL = "--size 16x16 --frame 1"
CELL = "raster/knot raster 64x48 2 scene=triangles triangles=1000\n"
# The command lines for one device.
COMMANDS = {
    "list": "list devices",
    "render": "render raster %s --device {api} -o {tmp}/a.png" % SMALL,
    "doctor": "doctor --device {api}",
    "diff": "diff raster %s --device cpu,{api}" % SMALL,
    "verify": "verify raster --quick %s --device {api}" % SMALL,
    "table": "table stuppacher-2 --work paper --rows 1-1 --quick --device {api}",
    "gate": "gate cpu {api} --pictures --cells {tmp}/cells.txt",
    "baseline": "baseline --pictures --cells {tmp}/cells.txt --device {api} -o {tmp}/baseline.json",
    # In git's bisect, 1 is bad and 125 skips.
    "bisect": "bisect --run '{raingauge} render raster %s --device {api} -o {tmp}/b.png'" % SMALL,
}
LIBRARIES = "/usr/lib/x86_64-linux-gnu/"
LAVAPIPE = "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json"


def manifest(library):
    return json.dumps({"file_format_version": "1.0.0", "ICD": {"library_path": library, "api_version": "1.3.0"}})


def write_drivers(folder):
    """Files of drivers that fail, each in its own way, in the forms of the three APIs."""
    def put(name, content):
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    wrong_class = bytearray(open(LIBRARIES + "libEGL.so.1", "rb").read())
    wrong_class[4] = 1  # a library of 32 bits
    libraries = {"absent": "/nonexistent.so", "empty": put("empty.so", ""), "cut": put("cut.so", bytes(wrong_class)[:40]),
                 "foreign": put("foreign.so", bytes(wrong_class)), "other": "libm.so.6"}
    for name, library in libraries.items():
        put(name + ".json", manifest(library))
        put("icd/%s.icd" % name, library + "\n")
    put("broken.json", "{ broken")
    put("void.json", "")
    put("silent.json", "{}")
    put("icd/void.icd", "")
    put("beside/vulkan/icd.d/broken.json", "{ broken")
    put("beside2/vulkan/icd.d/absent.json", manifest("/nonexistent.so"))
    put("libs/libEGL.so.1", "")
    put("dispatch/libGLdispatch.so.0", "")
    put("dri/swrast_dri.so", "")
    put("cells.txt", CELL)
    os.mkdir(os.path.join(folder, "none"))


VULKAN = "no Vulkan driver: vkCreateInstance failed with VK_ERROR_%s: VK_DRIVER_FILES names '.*/%s', %s"
EGL = "no EGL driver: EGL lists no platforms: __EGL_VENDOR_LIBRARY_FILENAMES names '.*/%s', %s"
OPENCL = "no OpenCL platform: clGetPlatformIDs gives CL_PLATFORM_NOT_FOUND_KHR: OCL_ICD_VENDORS names '.*/%s', %s"
NO_LIBRARY = "whose library cannot be loaded: /nonexistent.so: cannot open shared object file: No such file or directory$"
TOO_SHORT = r"whose library cannot be loaded: .*\.so: file too short$"
WRONG_CLASS = r"whose library cannot be loaded: .*\.so: wrong ELF class: ELFCLASS32$"
NO_DRIVER = "whose library 'libm.so.6' is no driver: it has no function "
NO_FILE = "which cannot be read: No such file or directory$"
NO_JSON = "which is no JSON: line 1: "
NO_EGL = "no EGL display: eglInitialize failed with EGL_NOT_INITIALIZED"
# API, variables, and the expected line; each case is a failure.
FAILING = [
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/absent.json"}, VULKAN % ("INCOMPATIBLE_DRIVER", "absent.json", NO_LIBRARY)),
    ("vulkan", {"VK_ICD_FILENAMES": "{tmp}/empty.json"}, "VK_ICD_FILENAMES names '.*/empty.json', " + TOO_SHORT),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/cut.json"}, VULKAN % ("INCOMPATIBLE_DRIVER", "cut.json", TOO_SHORT)),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/foreign.json"}, VULKAN % ("INCOMPATIBLE_DRIVER", "foreign.json", WRONG_CLASS)),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/other.json"}, VULKAN % ("INCOMPATIBLE_DRIVER", "other.json", NO_DRIVER)),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/broken.json"}, VULKAN % ("OUT_OF_HOST_MEMORY", "broken.json", NO_JSON)),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/void.json"}, VULKAN % (".*", "void.json", NO_JSON)),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/silent.json"}, VULKAN % (".*", "silent.json", "which names no library as ICD.library_path$")),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/nowhere.json"}, VULKAN % ("INCOMPATIBLE_DRIVER", "nowhere.json", NO_FILE)),
    ("vulkan", {"VK_DRIVER_FILES": "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json"}, "VK_DRIVER_FILES names a driver that gives no device here: name another$"),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/absent.json:" + LAVAPIPE}, "VK_DRIVER_FILES names '.*/absent.json', " + NO_LIBRARY),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/broken.json:" + LAVAPIPE}, "VK_DRIVER_FILES names '.*/broken.json', " + NO_JSON),
    ("vulkan", {"VK_ADD_DRIVER_FILES": "{tmp}/absent.json"}, "VK_ADD_DRIVER_FILES names '.*/absent.json', " + NO_LIBRARY),
    ("vulkan", {"XDG_DATA_DIRS": "{tmp}/beside"}, "OUT_OF_HOST_MEMORY: '.*/beside/vulkan/icd.d/broken.json', " + NO_JSON),
    ("vulkan", {"XDG_DATA_DIRS": "{tmp}/beside2"}, "INCOMPATIBLE_DRIVER: '.*/beside2/vulkan/icd.d/absent.json', " + NO_LIBRARY),
    ("gl", {"__EGL_VENDOR_LIBRARY_FILENAMES": "{tmp}/absent.json"}, EGL % ("absent.json", NO_LIBRARY)),
    ("gl", {"__EGL_VENDOR_LIBRARY_FILENAMES": "{tmp}/cut.json"}, EGL % ("cut.json", TOO_SHORT)),
    ("gl", {"__EGL_VENDOR_LIBRARY_FILENAMES": "{tmp}/other.json"}, EGL % ("other.json", NO_DRIVER)),
    ("gl", {"__EGL_VENDOR_LIBRARY_FILENAMES": "{tmp}/broken.json"}, EGL % ("broken.json", NO_JSON)),
    ("gl", {"__EGL_VENDOR_LIBRARY_FILENAMES": "{tmp}/nowhere.json"}, EGL % ("nowhere.json", NO_FILE)),
    ("gl", {"__EGL_VENDOR_LIBRARY_FILENAMES": "{tmp}/absent.json:/usr/share/glvnd/egl_vendor.d/50_mesa.json"},
     "__EGL_VENDOR_LIBRARY_FILENAMES names '.*/absent.json', " + NO_LIBRARY),
    ("gl", {"LD_LIBRARY_PATH": "{tmp}/libs"}, r"no EGL: .*/libs/libEGL\.so\.1: file too short$"),
    ("gl", {"LD_LIBRARY_PATH": "{tmp}/dispatch"}, r"no EGL: .*/dispatch/libGLdispatch\.so\.0: file too short$"),
    ("gl", {"LIBGL_DRIVERS_PATH": "/nonexistent"}, NO_EGL + r": /nonexistent/swrast_dri\.so: cannot open shared object file: No such file or directory$"),
    ("gl", {"LIBGL_DRIVERS_PATH": "{tmp}/dri"}, NO_EGL + r": .*/dri/swrast_dri\.so: file too short$"),
    ("gl", {"GALLIUM_DRIVER": "zink"}, "GALLIUM_DRIVER=zink asks for a driver that fails here$|GALLIUM_DRIVER asks for the driver 'zink', and Mesa opens"),
    ("gl", {"GALLIUM_DRIVER": "softpipe"}, "no OpenGL 4.5 core: eglCreateContext failed with EGL_BAD_MATCH; GALLIUM_DRIVER=softpipe asks for"),
    ("gl", {"MESA_LOADER_DRIVER_OVERRIDE": "softpipe"}, "MESA_LOADER_DRIVER_OVERRIDE asks for the driver 'softpipe', and Mesa opens 'llvmpipe.*' instead"),
    ("opencl", {"OCL_ICD_VENDORS": "{tmp}/icd/absent.icd"}, OPENCL % ("absent.icd", NO_LIBRARY)),
    ("opencl", {"OCL_ICD_VENDORS": "{tmp}/icd/empty.icd"}, OPENCL % ("empty.icd", TOO_SHORT)),
    ("opencl", {"OCL_ICD_VENDORS": "{tmp}/icd/void.icd"}, OPENCL % ("void.icd", "which names no library in its first line$")),
    ("opencl", {"OCL_ICD_VENDORS": "{tmp}/icd"}, OPENCL % ("absent.icd", NO_LIBRARY)),
    ("opencl", {"OPENCL_VENDOR_PATH": "{tmp}/icd"}, "OPENCL_VENDOR_PATH names '.*/absent.icd', " + NO_LIBRARY),
    ("opencl", {"OCL_ICD_VENDORS": "{tmp}/nowhere.icd"}, OPENCL % ("nowhere.icd", NO_FILE)),
    ("opencl", {"OCL_ICD_VENDORS": "libno-such-driver.so.1"}, "OCL_ICD_VENDORS names 'libno-such-driver.so.1', whose library cannot be loaded: "),
    ("opencl", {"HOME": "/proc/nothing", "XDG_CACHE_HOME": None}, "PoCL cannot write to its cache: /proc/nothing: No such file or directory; set POCL_CACHE_DIR"),
    ("opencl", {"POCL_CACHE_DIR": "/proc/nothing"}, "PoCL cannot write to its cache: /proc/nothing: No such file or directory; set POCL_CACHE_DIR"),
    ("opencl", {"POCL_DEVICES": "nonsense"}, "PoCL has none that POCL_DEVICES=nonsense asks for; unset it$"),
]
# No driver is expected in these cases.
ABSENT = [
    ("vulkan", {"VK_DRIVER_FILES": "/nonexistent"}, "VK_DRIVER_FILES=/nonexistent names no driver: unset it, or name one$"),
    ("vulkan", {"VK_DRIVER_FILES": "{tmp}/none"}, "VK_DRIVER_FILES=.*/none names no driver: unset it, or name one$"),
    ("vulkan", {"XDG_DATA_DIRS": "{tmp}/none"}, "INCOMPATIBLE_DRIVER; install the Debian package mesa-vulkan-drivers, which brings one$"),
    ("gl", {"__EGL_VENDOR_LIBRARY_DIRS": "{tmp}/none"}, "__EGL_VENDOR_LIBRARY_DIRS=.*/none names no driver: unset it, or name one$"),
    ("gl", {"MESA_GL_VERSION_OVERRIDE": "3.3"}, "eglCreateContext failed with EGL_BAD_MATCH; the drivers that are installed serve no other device$"),
    ("opencl", {"OCL_ICD_VENDORS": "{tmp}/none"}, "OCL_ICD_VENDORS=.*/none names no driver: unset it, or name one$"),
    ("opencl", {"POCL_DEVICES": ""}, "CL_DEVICE_NOT_FOUND on Portable Computing Language; the drivers that are installed serve no other device$"),
]
# One driver fails, and another of the same API works.
BESIDE = [
    ("vulkan", {"XDG_DATA_DIRS": "{tmp}/beside:/usr/share"}, "a driver is left out: '.*/broken.json', " + NO_JSON),
    ("vulkan", {"XDG_DATA_DIRS": "{tmp}/beside2:/usr/share"}, "a driver is left out: '.*/absent.json', whose library cannot be loaded: /nonexistent.so: "),
    ("vulkan", {"XDG_CONFIG_HOME": "{tmp}/beside"}, "a driver is left out: '.*/broken.json', " + NO_JSON),
]


def keeps_code(command, said):
    """Whether the driver's code is in the command's own folder, as for each side of a gate, so that the cache does not matter."""
    return command == "gate" and "write to its cache" in said


def problems_of(runner, command, case, status):
    """Problems of how a command ends that asks for one device."""
    api, variables, said = case
    with tempfile.TemporaryDirectory() as folder:
        write_drivers(folder)
        env = {name: value and value.format(tmp=folder) for name, value in variables.items()}
        args = COMMANDS[command].format(api=api, tmp=folder, raingauge=runner.raingauge)
        result = runner.run(shlex.split(args), dict(env, XDG_STATE_HOME=folder))
    lines = result.stderr.splitlines()
    is_well = keeps_code(command, said)
    wanted = 0 if is_well else {"list": {77: 0}, "bisect": {77: 125}}.get(command, {}).get(status, status)
    if result.returncode != wanted or not (is_well or any(re.search(said, line) for line in lines)) or len(lines) > 3:
        return ["%s, %s: exit status %d, not %d:" % (command, variables, result.returncode, wanted)] + lines
    return []


def check_pairs(runner, asked):
    """Runs two at once, since each waits for its workers."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return [problem for problems in pool.map(lambda one: problems_of(runner, *one), asked) for problem in problems]


def every(commands):
    return [(command, case, status) for cases, status in ((FAILING, 1), (ABSENT, 77), (BESIDE, 0)) for case in cases for command in commands]


def check_ways(runner):
    """a driver that cannot be loaded, opened or found fails, with the reason, or warns beside a good one; an absent one is unsupported"""
    return check_pairs(runner, every(["render"]))


def check_commands(runner):
    """the same holds for each command, in one way for each API"""
    ways = [(FAILING[0], 1), (FAILING[24], 1), (FAILING[-1], 1), (ABSENT[0], 77)]
    return check_pairs(runner, [(command, case, status) for case, status in ways for command in COMMANDS])


def fault_problems(runner, case, ending):
    """Problems of how a gate reports one device, or how a record of doctor's does."""
    api, variables, said = case
    with tempfile.TemporaryDirectory() as folder:
        write_drivers(folder)
        env = {name: value and value.format(tmp=folder) for name, value in variables.items()}
        known = os.path.join(folder, "known.txt")
        with open(known, "w") as file:
            file.write("fail *\n  device %s\n  outcome error\n  reason it does not open\n  since 2026-01-01\n  until %s\n" % (api, LATER))
        args = ["--cells", os.path.join(folder, "cells.txt"), "--expectations", known, "--json"]
        gated = json.loads(runner.run(["gate", "cpu", api, "--pictures"] + args, env).stdout)["gated"]
        examined = json.loads(runner.run(["doctor", "--device", api, "--json"], env).stdout)["devices"] if ending == "set-up" else []
    found = [case["ending"] for case in gated if not keeps_code("gate", said)] + [device.get("fault") for device in examined]
    return [] if set(found) == {ending} else ["%s, %s: %s and not %s" % (api, variables, found, ending)]


def check_faults(runner):
    """a gate and records report all of these as a fault of the set-up, which cannot be expected; an absent driver is nobody's fault"""
    asked = [(case, "set-up") for case in FAILING] + [(case, "unsupported") for case in ABSENT]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return [problem for problems in pool.map(lambda one: fault_problems(runner, *one), asked) for problem in problems]


def check_all(runner):
    """the same holds for each command, in each way"""
    return check_pairs(runner, every(COMMANDS))


CHECKS = [check_ways, check_commands, check_faults]
THOROUGH = [check_all]
