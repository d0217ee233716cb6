"""`meson install`: which files it installs where, and whether the installed program runs by itself."""
import filecmp
import json
import os
import subprocess
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
TETRAHEDRON = """v -1 -1 -1
v 1 1 -1
v 1 -1 1
v -1 1 1
f 1 2 3
f 1 3 4
f 1 4 2
f 2 4 3
"""
RENDER = "render flow --set environment=sky --set environment_px=16 --set resolution_px=32 --size 32x32 --frame 1 "


def install(runner, folder):
    """Installs into a folder. Returns the paths of the build's options, relative to that folder."""
    build = os.path.dirname(os.path.dirname(runner.raingauge))
    done = subprocess.run(["meson", "install", "-C", build, "--destdir", folder, "--no-rebuild", "--quiet"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
    with open(os.path.join(build, "meson-info", "intro-buildoptions.json")) as file:
        options = {option["name"]: option["value"] for option in json.load(file)}
    return options, [] if done.returncode == 0 else [done.stdout]


def files_below(folder):
    """All files of a folder and of those in it, as the folder names them."""
    return [os.path.relpath(os.path.join(path, name), folder) for path, _, names in os.walk(folder) for name in names]


def check_install(runner):
    """meson install puts program, importer, module, manual page and completion in place, and the program draws a mesh"""
    with tempfile.TemporaryDirectory() as folder:
        options, problems = install(runner, folder)
        places = {os.path.join(options[where].lstrip("/"), name) for where, name in (
            ("bindir", "raingauge"), ("libdir", "raingauge/raingauge_importer"),
            ("libdir", "raingauge/raingauge_picture_reader"), ("libdir", "raingauge/raingauge_oiio.so"),
            ("mandir", "man1/raingauge.1"), ("datadir", "bash-completion/completions/raingauge"))}
        data = {"raingauge/" + os.path.basename(source): source for source in ("results/baseline.json", "results/expectations.txt", "docs/ci/cells.txt")}
        for to, source in (("raingauge/tables", "results/tables"), ("raingauge/published", "results/published"),
                           ("doc/raingauge/examples/ci", "docs/ci")):
            data.update({os.path.join(to, name): os.path.join(source, name) for name in files_below(os.path.join(ROOT, source))})
        places |= {os.path.join(options["datadir"], name) for name in data}
        prefix = folder + options["prefix"]
        found = {os.path.relpath(os.path.join(folder, name), prefix) for name in files_below(folder)}
        if found != places:
            problems.append("installed: %s, not %s" % (sorted(found), sorted(places)))
        problems += ["%s: %s" % (name, line) for name in ("raingauge/raingauge_importer", "raingauge/raingauge_oiio.so")
                     for line in run_path(os.path.join(prefix, options["libdir"], name))]
        problems += ["%s: not the source's" % name for name, source in sorted(data.items())
                     if not filecmp.cmp(os.path.join(prefix, options["datadir"], name), os.path.join(ROOT, source), shallow=False)]
        installed = os.path.join(prefix, options["bindir"], "raingauge")
        problems += run_path(installed)
        with open(os.path.join(prefix, options["mandir"], "man1/raingauge.1")) as page:
            if os.path.join(options["prefix"], options["datadir"], "raingauge/tables").replace("-", "\\-") not in page.read():
                problems.append("the manual page does not say where tables lie")
        return problems or draw(runner, installed) or judge(runner, installed, os.path.join(prefix, options["datadir"], "raingauge/tables"))


def judge(runner, installed, tables):
    """Problems if the installed program, alone in a folder, says something else of the installed tables than the build's of the source's."""
    said = []
    for program, folder in ((runner.raingauge, os.path.join(ROOT, "results", "tables")), (installed, tables)):
        done = subprocess.run([program, "table", "--claims", "--from", folder], cwd="/", env=runner.variables({}),
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        said.append((done.returncode, done.stdout))
    return [] if said[0] == said[1] and said[0][1] else ["the installed program judges otherwise: %s" % (said,)]


def run_path(path):
    """The folders in which the loader looks for what the program needs, beside the system's; none is needed."""
    done = subprocess.run(["readelf", "-d", path], stdout=subprocess.PIPE, encoding="utf-8", check=True)
    return [line for line in done.stdout.splitlines() if "RPATH" in line or "RUNPATH" in line]


def draw(runner, installed):
    """Problems if the installed program, alone in a folder, draws another picture than the build's."""
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, "tetrahedron.obj")
        with open(model, "w") as file:
            file.write(TETRAHEDRON)
        pictures, problems = [], []
        for program in (runner.raingauge, installed):
            for name in ("a.png", "a.tif"):  # TIFF needs the module with OpenImageIO
                path = os.path.join(folder, name)
                done = subprocess.run([program] + (RENDER + "--set model=%s -o %s" % (model, path)).split(), cwd=folder,
                                      env=runner.variables({}), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
                if done.returncode or "faces 4" not in done.stdout:
                    problems.append("%s: exit status %d: %s" % (program, done.returncode, done.stdout))
                    continue
                with open(path, "rb") as file:
                    pictures.append(file.read())
        if not problems and (pictures[0] != pictures[2] or len(pictures[1]) != len(pictures[3])):
            problems.append("the installed program draws another picture")
        return problems


CHECKS = [check_install]
