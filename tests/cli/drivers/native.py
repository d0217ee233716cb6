"""Native devices: names, agreement within T2, and what turns parts of a driver's pipeline off."""
import csv
import hashlib
import json
import os
import re
import tempfile

import forms

APIS = ("gl", "vulkan")
# Small scenes of techniques whose papers used the stages below.
FLOW = ["flow", "--set", "resolution_px=96", "--set", "environment_px=64", "--set", "glow=0.5", "--set", "glow_threshold=0.3",
        "--size", "96x96", "--frame", "4"]
STREAKS = ["streaks", "--set", "city=small", "--set", "atlas=small", "--set", "shadow_map_px=256", "--size", "96x96", "--frame", "4"]
SHOWER = ["shower", "--set", "city=small", "--set", "particles=3000", "--set", "shadow_map_px=256", "--size", "96x96", "--frame", "8"]
DROPS = ["drops", "--set", "columns=96", "--set", "rows=64", "--set", "max_drops=100", "--size", "96x64", "--frame", "6"]
# Feng's way: spheres of drops are counted by the API's queries, whose answers come a frame late.
CARTOON = ["cartoon", "--set", "query=api", "--set", "answers=late", "--size", "96x96", "--frame", "60"]
RASTER = ["raster", "--size", "96x96", "--frame", "1"]
# What turns a part of llvmpipe off, and the cheapest picture that must tell.
SWITCHES = {
    "LP_PERF=no_linear": ("gl", FLOW),
    "LP_PERF=no_mipmap": ("vulkan", STREAKS),
    "LP_PERF=no_mip_linear": ("gl", DROPS),
    "LP_PERF=no_tex": ("vulkan", FLOW),
    "LP_PERF=no_depth": ("gl", FLOW),
    "LP_PERF=no_blend": ("vulkan", FLOW),
    "GALLIVM_PERF=no_aos_sampling": ("gl", SHOWER),
}
# What a scene does not use, so that its picture stays. Its textures are of floats, or are read in single levels, or it reads none, or
# draws without depth or blending.
UNUSED = {
    "shower": {"LP_PERF=no_mip_linear"},
    "streaks": {"LP_PERF=no_mip_linear"},
    "flow": {"LP_PERF=no_mip_linear", "GALLIVM_PERF=no_aos_sampling"},
    "drops": {"LP_PERF=no_depth", "LP_PERF=no_blend", "GALLIVM_PERF=no_aos_sampling"},
    "raster": set(SWITCHES) - {"LP_PERF=no_blend"},
}
# Under this switch some kernels that compute never end, as buffers are textures there.
ENDLESS = {("drops", "LP_PERF=no_tex")}


def check_names(runner):
    """`native` comes last in a name; devices that draw by their own programs have none."""
    problems = []
    for name in ("cpu:native", "cpu:reference:native", "opencl:native"):
        result = runner.run(["render", "raster", "--device", name, "-o", "/dev/null.png", "--size", "16x16"])
        line = "device '%s': has no native way, for %s draws by its own programs" % (name, name.replace(":native", ""))
        if result.returncode != 77 or line not in result.stderr:
            problems.append("%s: exit status %d, %s" % (name, result.returncode, result.stderr))
    for name, status in (("native", 2), ("gl:native:0", 2), ("cpu:native:reference", 2), ("gl:native@LP_NUM_THREADS=1", 0), ("gl:0:native", 0)):
        result = runner.run(["render", "raster", "--device", name, "-o", "/dev/null.png", "--size", "16x16"])
        if result.returncode != status:
            problems.append("%s: exit status %d, %s" % (name, result.returncode, result.stderr))
    all_words = "give none, or words of samplers+levels+setup+places+blending+passes, or unset it"
    for value, mend in (("samplers+", all_words), ("all", all_words), ("places+levels", "places are interpolated only with setup; give both")):
        result = runner.run(["render", "raster", "--device", "gl:native@RG_NATIVE=" + value, "-o", "/dev/null.png", "--size", "16x16"])
        if result.returncode != 2 or result.stderr != "raingauge: RG_NATIVE=%s: %s\n" % (value, mend):
            problems.append("%s: exit status %d, %s" % (value, result.returncode, result.stderr))
    if any(":native" in line for line in runner.run(["list", "devices"]).stdout.splitlines()):
        problems.append("native devices are among the default ones")
    return problems


def check_agreement(runner):
    """A native device owes T2, draws other bits than cpu, and Vulkan's validation stays silent."""
    names = [api + ":native" for api in APIS]
    problems = []
    for scene in (RASTER, FLOW, STREAKS, SHOWER, DROPS):
        result = runner.run(["diff", *scene, "--json", "--device", ",".join(["cpu"] + names)], {"RG_VK_VALIDATION": "1"})
        pairs = {pair["b"]: pair for pair in json.loads(result.stdout)["pairs"] if pair["a"] == "cpu"}
        tiers = [pairs[name]["tier"] if name in pairs else "none" for name in names]
        apis = {device["name"]: device["api"] for device in json.loads(result.stdout)["devices"]}  # a part of comparison keys
        if result.returncode or result.stderr or not set(tiers) <= {"T1", "T2"} or {pairs[name]["owed"] for name in names} != {"T2"} or not all(apis[name].endswith(", native") for name in names):
            problems.append("%s: exit status %d, %s, %s, %s" % (scene[0], result.returncode, tiers, apis, result.stderr))
    return problems


def check_queries(runner):
    """A native device counts by the API's queries, and its rain is that of the API's exact device within T2."""
    problems = []
    for api in APIS:
        result = runner.run(["diff", *CARTOON, "--json", "--device", "%s,%s:native" % (api, api)], {"RG_VK_VALIDATION": "1"})
        tiers = [pair["tier"] for pair in json.loads(result.stdout)["pairs"]] if result.stdout else []
        if result.returncode or result.stderr or len(tiers) != 1 or tiers[0] not in ("T1", "T2"):
            problems.append("%s: exit status %d, %s, %s" % (api, result.returncode, tiers, result.stderr))
    return problems


def check_table(runner):
    """Tables time a native device beside the exact one."""
    result = runner.run(["table", "raster-1", "--rows", "1-1", "--quick", "--format", "csv", "--device", "gl,gl:native"])
    rows = list(csv.DictReader(line for line in result.stdout.splitlines() if not line.startswith("#")))
    ok = [row for row in rows if row["device"] == "gl:native" and float(row["fps"]) > 0]
    return [] if ok and result.returncode == 0 else ["exit status %d, %s, %s" % (result.returncode, result.stdout, result.stderr)]


def digest(runner, scene, device, path):
    result = runner.run(["render", *scene, "--device", device, "-o", path])
    if result.returncode:
        return "exit status %d, %s" % (result.returncode, result.stderr)
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def changes(runner, tries):
    """Whether each switch changes a native picture, and problems, of tries: switch, API and scene."""
    changed, problems, plain = {}, [], {}
    with tempfile.TemporaryDirectory() as folder:
        path, behind = os.path.join(folder, "picture.exr"), os.path.join(folder, "behind.png")
        runner.run(["render", *FLOW, "--device", "cpu", "-o", behind])
        for switch, api, scene in tries:
            given = scene + ["--set", "background=" + behind] if scene is DROPS else scene
            if (api, scene[0]) not in plain:
                plain[api, scene[0]] = digest(runner, given, api + ":native", path)
            switched = digest(runner, given, "%s:native@%s" % (api, switch), path)
            problems += ["%s, %s, %s: %s" % (switch, api, scene[0], told) for told in (plain[api, scene[0]], switched) if told.startswith("exit")]
            changed[switch, api, scene[0]] = switched != plain[api, scene[0]]
    return changed, problems


def check_switches(runner):
    """Each switch that turns a part of llvmpipe off changes a native picture."""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    changed, problems = changes(runner, [(switch, *picture) for switch, picture in SWITCHES.items()])
    return problems + ["%s: %s does not notice on %s" % (switch, scene, api) for (switch, api, scene), is_other in changed.items() if not is_other]


def check_all_switches(runner):
    """A switch that turns a part of llvmpipe off changes the native pictures on both APIs of all scenes that use it, and no others."""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    tries = [(switch, api, scene) for scene in (SHOWER, STREAKS, FLOW, DROPS, RASTER) for api in APIS for switch in SWITCHES
             if (scene[0], switch) not in ENDLESS]
    changed, problems = changes(runner, tries)
    print("# %d pictures under a switch, %d changed" % (len(changed), sum(changed.values())))
    return problems + ["%s: %s on %s %s" % (switch, scene, api, "changes" if is_other else "does not notice")
                       for (switch, api, scene), is_other in changed.items() if is_other == (switch in UNUSED[scene])]


def without_features(runner, tries):
    """Problems of scenes on APIs whose native devices without features draw other bits than cpu."""
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.exr")
        for api, scene in tries:
            due, now = (digest(runner, scene, device, path) for device in ("cpu", api + ":native@RG_NATIVE=none"))
            problems += [] if now == due and not due.startswith("exit") else ["%s on %s: %s, not %s" % (scene[0], api, now, due)]
    return problems


def check_without_features(runner):
    """A native device whose driver keeps no feature draws every bit as exact devices do."""
    return without_features(runner, [("gl", FLOW), ("vulkan", SHOWER), ("vulkan", RASTER)])


def check_all_without_features(runner):
    """The same of all techniques on both APIs."""
    return without_features(runner, [(api, scene) for scene in (FLOW, STREAKS, SHOWER, DROPS, CARTOON[:3] + CARTOON[5:], RASTER) for api in APIS])


def blamed(runner, api, scene, devices):
    """The verdict, the features blamed, the stage and the pairs that diff counts, of a pair of devices."""
    result = runner.run(["diff", *scene, "--features", "--json", "--device", devices.replace("API", api)])
    document = json.loads(result.stdout) if result.stdout else {}
    told = document["pairs"][0]["features"] if document else {}
    wrong = result.stderr + "".join(forms.problems("diff", document))
    return told.get("verdict"), told.get("blamed"), told.get("blame", {}).get("stage"), len(told.get("compared", [])), wrong


def check_blamed(runner):
    """A difference is blamed on the features of the driver that make it: within T2 against cpu, and else to the bit."""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    due = {
        ("gl", "flow", "cpu,API:native@LP_PERF=no_linear"): ("alone", ["samplers"], "flow_sky", 7, ""),
        ("vulkan", "glow", "cpu,API:native@RG_NATIVE=passes"): ("alone", ["passes"], "flow_glow_bright", 2, ""),
        ("vulkan", "raster", "API:native,API:native@LP_PERF=no_blend"): ("alone", ["blending"], "raster_streaks", 7, ""),
    }
    scenes = {"raster": RASTER, "flow": FLOW, "glow": FLOW[:-1] + ["1"]}
    return ["%s: blamed %s, not %s" % (of, told, says) for of, says in due.items()
            for told in [blamed(runner, of[0], scenes[of[1]], of[2])] if told != says]


def check_all_blamed(runner):
    """Each switch is blamed on the feature that it turns off, or is said to be of what the exact way has too."""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    shared = ("LP_PERF=no_tex", "LP_PERF=no_depth")
    told = blamed(runner, "gl", FLOW, "cpu,API:native")
    problems = [] if told == ("together", ["samplers", "places", "passes"], "flow_sky", 14, "") else ["cpu and gl:native: %s" % (told,)]
    for switch, (_, scene) in SWITCHES.items():
        scene = SHOWER if scene is STREAKS else scene  # whose programs take less to compile
        due = ("shared", []) if switch in shared else ("alone", ["blending" if switch.endswith("blend") else "samplers"])
        for api in APIS:
            with tempfile.TemporaryDirectory() as folder:
                behind = os.path.join(folder, "behind.png")
                runner.run(["render", *FLOW, "--device", "cpu", "-o", behind])
                given = scene + ["--set", "background=" + behind] if scene is DROPS else scene
                told = blamed(runner, api, given, "API:native,API:native@" + switch)
            if told[:2] != due or told[4]:
                problems.append("%s on %s: %s, not %s" % (switch, api, told, due))
    return problems


def check_verified(runner):
    """Rain and its scene are within T2 in verify's poses: of shower, where it would tell that the quads' texture lies the other way;
    of streaks, where splashes are small enough for the last level of their pictures, and shops shine by night."""
    names = [api + ":native" for api in APIS]
    problems = []
    for technique, size in (("shower", "96x54"), ("streaks", "512x512")):
        result = runner.run(["verify", technique, "--quick", "--frame", "20", "--size", size, "--device", ",".join(names)])
        told = re.findall(r"(?m)^ok +%s +image +(\S+) .*but within T2$" % technique, result.stdout)
        if result.returncode != 77 and (result.returncode or not told or not set(told) <= set(names)):
            problems.append("%s: exit status %d, %s%s" % (technique, result.returncode, result.stdout, result.stderr))
    return problems


THOROUGH = [check_all_switches, check_all_without_features, check_all_blamed, check_verified]
CHECKS = [check_names, check_agreement, check_queries, check_table, check_switches, check_without_features, check_blamed]
