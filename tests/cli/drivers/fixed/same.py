"""No false alarm: whatever a setting leaves alone is the same in every launch."""
import collections
import itertools
import os
import tempfile

import native
from fixed import APIS, digests, draw

LAUNCHES = 300
BITS, THREADS = (128, 256), (1, 2)
SETTINGS = tuple(itertools.product(APIS, BITS, THREADS))
SCENES = (native.FLOW, native.RASTER, native.SHOWER, native.STREAKS)


def device(folder, setting, way=""):
    """A device of these bits and threads, whose driver keeps compiled code in a folder of its own: the first launch compiles all."""
    api, bits, threads = setting
    cache = os.path.join(folder, "%s-%d-%d" % setting)
    os.makedirs(cache, exist_ok=True)
    return "%s%s@LP_NATIVE_VECTOR_WIDTH=%d;LP_NUM_THREADS=%d;MESA_SHADER_CACHE_DIR=%s" % (api, way, bits, threads, cache)


def apart(found):
    """A line for each thing of an API that has more than one digest, with the settings of each but the most frequent one."""
    lines = []
    for (api, name), by_digest in sorted(found.items()):
        rare = sorted(by_digest.values(), key=len)[:-1]
        lines += ["%s, %s: another digest in %s" % (api, name, dict(collections.Counter(settings))) for settings in rare]
    return lines


def check_launches(runner):
    """in 300 launches with one thread and two, of 128 bits and 256, no digest of a fixed function is another"""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    problems, found, drawn = [], collections.defaultdict(lambda: collections.defaultdict(list)), 0
    with tempfile.TemporaryDirectory() as folder:
        for launch in range(LAUNCHES):
            setting = SETTINGS[launch % len(SETTINGS)]
            rows, status, errors = draw(runner, [device(folder, setting)])
            [row] = rows.values()
            problems += ["launch %d, %s: exit status %d, %s" % (launch, setting, status, errors)] if status or errors else []
            for feature, digest in digests(row).items():
                found[setting[0], feature][digest].append(setting[1:])
                drawn += 1
    print("# %d launches, %d draws" % (LAUNCHES, drawn))
    return problems + apart(found)


def check_native(runner):
    """native pictures are the same with one thread and two, of 128 bits and 256"""
    if "llvmpipe" not in runner.run(["list", "devices"]).stdout:
        return []
    found = collections.defaultdict(lambda: collections.defaultdict(list))
    with tempfile.TemporaryDirectory() as folder:
        for setting, scene, launch in itertools.product(SETTINGS, SCENES, range(2)):
            digest = native.digest(runner, scene, device(folder, setting, ":native"), os.path.join(folder, "picture.exr"))
            found[setting[0], scene[0]][digest].append(setting[1:])
    told = [(api, name, digest) for (api, name), all_digests in found.items() for digest in all_digests if digest.startswith("exit")]
    print("# %d pictures" % (2 * len(SETTINGS) * len(SCENES)))
    return ["%s, %s: %s" % problem for problem in told] + apart(found)


THOROUGH = [check_launches, check_native]
