"""Faults planted into units of a driver: the digests of `raingauge doctor --fixed-function` notice them, and blame their features.

A row names the features whose draws use the state that the fault edits: all of `must` have to differ from the undisturbed driver's, and no
others but those of `may`. `missed` says why a fault is not noticed, or blamed on other features too; of such rows there may be few. Names
of faults are those in gl.c and vulkan.c, which plant them. All but those of WITHIN also leave values beyond their bounds.
"""
import collections
import json
import os
import tempfile

from fixed import APIS, differing, digests, draw, plain
from misbehaving import side_by_side

Fault = collections.namedtuple("Fault", "kind api name must may missed", defaults=("", ""))
KINDS = ("coarse", "fine")
SHARE = 0.95  # of the faults that are noticed and blamed on their features alone

# Draws whose state several faults edit.
FLOORS = "mip nearest, trilinear, anisotropic"
BLENDING = "blending RGBA8, blending RGBA16F, blending RGBA32F"
# Draws that shade by colours of a mesh with corners of several w.
IN_PERSPECTIVE = "perspective interpolation, clipping, clip distance, culling, lines, geometry stage, tessellation, " \
    "layers and viewports, indexed draws, transform feedback, vertex formats, depth test, polygon offset, late depth, early depth, " \
    "stencil, dual source, write mask, multisampling, alpha to coverage, queries, blit, " + BLENDING
# Draws of the turned pane with a plain texture: coordinates reach all texels.
PANES = "nearest, linear, wrap modes, border colour"

FAULTS = [
    Fault("coarse", "gl", "magnified texels are not filtered",
          "linear, depth compare, cube seams, array layers, wrap modes, border colour, sRGB decoding, gradients", FLOORS),
    # llvmpipe's anisotropic filter takes one level, as LP_PERF=no_mip_linear also shows; others' may mix two.
    Fault("coarse", "vulkan", "levels are not mixed", "trilinear, LOD bias and clamp, gradients", "anisotropic"),
    Fault("coarse", "gl", "mirroring repeats", "wrap modes"),
    Fault("coarse", "gl", "colours are not in perspective", IN_PERSPECTIVE, "points, stores"),  # those by rounding alone
    Fault("coarse", "gl", "sRGB is not decoded", "sRGB decoding"),
    Fault("coarse", "gl", "cubes have seams", "cube seams"),
    Fault("coarse", "gl", "the layer is always 0", "array layers"),
    Fault("coarse", "vulkan", "anisotropy is 1", "anisotropic"),
    Fault("coarse", "vulkan", "LODs are not clamped", "LOD bias and clamp"),
    Fault("coarse", "vulkan", "front faces are back faces", "culling, stencil"),
    Fault("coarse", "vulkan", "the second colour is the first", "dual source"),
    Fault("coarse", "vulkan", "reversed subtraction is plain", BLENDING),
    Fault("coarse", "vulkan", "depth is clamped and not clipped", "clipping"),
    Fault("coarse", "gl", "every channel is written", "write mask"),
    Fault("coarse", "vulkan", "scissors are ignored", "scissor, layers and viewports"),
    Fault("coarse", "gl", "strips do not restart", "indexed draws"),
    # A strip's triangles may begin with the vertex that provokes.
    Fault("coarse", "gl", "the last vertex provokes", "provoking vertex", "indexed draws, transform feedback",
          "llvmpipe turns a clockwise triangle around the vertex that provokes, so that values of many other draws round otherwise"),
    Fault("coarse", "vulkan", "alpha is no coverage", "alpha to coverage"),
    Fault("coarse", "gl", "early tests are late", "early depth"),
    Fault("coarse", "gl", "samples are not counted", "queries"),
    Fault("fine", "gl", "one texel is one code off", PANES + ", gather", FLOORS + ", sRGB decoding, gradients"),
    Fault("fine", "gl", "places are 1/256 texel off", PANES + ", sRGB decoding, BC1, BC3, ETC2", FLOORS + ", LOD bias and clamp"),
    Fault("fine", "vulkan", "LOD bias is 1/16 more", FLOORS + ", LOD bias and clamp, gradients"),
    Fault("fine", "vulkan", "the least LOD is 1/16 more", "LOD bias and clamp"),
    Fault("fine", "gl", "an opaque black border is one code off", "border colour"),
    Fault("fine", "gl", "less is less or equal", "depth compare"),
    Fault("fine", "gl", "one bit of a block is another", "BC1, BC3, ETC2"),
    Fault("fine", "gl", "clip planes are 1/256 pixel off", "clip distance", "",
          "no pixel's centre lies between the two edges; from 1/32 pixel on one does"),
    Fault("fine", "gl", "tessellation levels are 1/16 off", "tessellation"),
    Fault("fine", "gl", "dFdx is one unit off in the last place", "derivatives"),
    Fault("fine", "gl", "the offset is one unit more", "polygon offset"),
    Fault("fine", "vulkan", "depth is cleared one unit off", "depth test, polygon offset, late depth, early depth, stencil, queries"),
    Fault("fine", "gl", "the fifth target is cleared one code off", BLENDING),
    Fault("fine", "vulkan", "one sample is 1/16 pixel off", "centroid interpolation, multisampling, alpha to coverage"),
    Fault("fine", "gl", "a scaled blit leaves out a row", "blit"),
    Fault("fine", "gl", "the last triangle is not caught", "transform feedback"),
    Fault("fine", "gl", "an attribute is one code off", "vertex formats"),
    Fault("fine", "vulkan", "one sample too many is counted", "queries"),
    Fault("fine", "vulkan", "lines and points are 1/256 pixel off", "lines, points"),
    Fault("fine", "gl", "stores in ten bits are one code off", "stores"),
]


# What these leave is within the bounds, or of draws that have none.
WITHIN = {"anisotropy is 1", "alpha is no coverage", "LOD bias is 1/16 more", "the least LOD is 1/16 more",
          "an opaque black border is one code off", "less is less or equal", "clip planes are 1/256 pixel off",
          "tessellation levels are 1/16 off", "dFdx is one unit off in the last place", "the offset is one unit more",
          "an attribute is one code off", "one sample too many is counted", "lines and points are 1/256 pixel off"}


def split(features):
    return set(filter(None, features.split(", ")))


def before_driver(runner, folder, api):
    """Variables that put the library of an API before its driver."""
    library = os.path.join(os.path.dirname(runner.misbehaver), "libplanted_%s.so" % api)
    if api == "gl":
        return {"LD_PRELOAD": library}
    path = os.path.join(folder, "planted.json")
    with open(path, "w") as file:
        json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": library, "api_version": "1.1.0"}}, file)
    return {"VK_DRIVER_FILES": path}


def check_planted(runner):
    """of 40 faults that are planted into units of drivers, coarse or fine, at least 95 % change digests of their features alone"""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    by_api, found, judged = plain(runner), {}, {}
    with tempfile.TemporaryDirectory() as folder:
        loaded = {api: before_driver(runner, folder, api) for api in APIS}

        def plant(fault):
            # Compiled code holds the places of samples, so that none may come from a cache or go there.
            uncached = {"MESA_SHADER_CACHE_DISABLE": "true"} if "sample is" in fault.name else {}
            drawn, status, errors = draw(runner, [fault.api], {"RG_PLANTED": fault.name, **loaded[fault.api], **uncached})
            all_drawn = len(drawn[fault.api]["draws"]) == len(by_api[fault.api]["draws"])
            found[fault] = set(differing(by_api[fault.api], drawn[fault.api])) if all_drawn else set()
            judged[fault] = {row["feature"] for row in drawn[fault.api]["draws"] if row.get("bounds") == "beyond" and "known" not in row}
            return [] if all_drawn else ["%s: exit status %d, %s" % (fault.name, status, errors)]

        undisturbed = [Fault("none", api, "", "") for api in APIS]
        problems = side_by_side(plant, undisturbed + FAULTS)
    problems += ["%s without a fault: differs in %s" % (fault.api, sorted(found[fault])) for fault in undisturbed if found[fault]]
    rightly = {fault for fault in FAULTS if found[fault] and split(fault.must) <= found[fault] <= split(fault.must) | split(fault.may)}
    for fault in FAULTS:
        if (fault in rightly) == bool(fault.missed):
            problems.append("%s: changes %s" % (fault.name, sorted(found[fault])))
    if len(rightly) < SHARE * len(FAULTS):
        problems.append("%d of %d are noticed and blamed rightly" % (len(rightly), len(FAULTS)))
    problems += ["%s: no fault changes it" % feature for feature in sorted(set(digests(by_api["gl"])) - set().union(*found.values()))]
    stay = {fault.name for fault in FAULTS if not judged[fault]}
    problems += ["%s: %s bounds" % (name, "within" if name in stay else "beyond") for name in sorted(stay ^ WITHIN)]
    for kind in KINDS:
        of_kind = [fault for fault in FAULTS if fault.kind == kind]
        print("# %d %s faults: %d noticed, %d blamed on their features alone, %d beyond bounds" %
              (len(of_kind), kind, sum(bool(found[fault]) for fault in of_kind), len(rightly.intersection(of_kind)),
               sum(bool(judged[fault]) for fault in of_kind)))
    return problems


CHECKS = [check_planted]
