#!/usr/bin/env python3
"""Makes the image for containers and tries it without Docker, and CI as copied: image.py [--in FOLDER], as root, with network.

    sizes      each variant of docs/ci/image is made, of the packages that `make deb` left, and no larger than it may be
    contained  the image as a container runs it: any user, a read-only root file system, no network, no /dev/dri. Its devices are well,
               the first picture comes within 60 s, and the first gate within 90 s
    recipes    the Containerfile's steps in a bare Debian 12
    services   docs/ci's files for GitHub and GitLab, unedited, in a clean copy of the image, and in a bare Debian 12 that installs the
               package; with a good new driver and with a broken one; and without one of the steps, which has to fail

Prints a line for each step, and ends with 1 if one failed. It takes half an hour. --in keeps images and systems, and uses those there.
"""
import argparse
import functools
import http.server
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import threading
import time

sys.dont_write_bytecode = True
import services
from system import System, Way, lacks

ROOT = pathlib.Path(__file__).resolve().parents[3]
RECIPE, GITHUB, GITLAB = ROOT / "docs/ci/image/make.py", ROOT / "docs/ci/github.yml", ROOT / "docs/ci/gitlab-ci.yml"
# What is said if a step is missing: no gate leaves anything to upload, or the upload has no address.
MISSED = {"actions/checkout@v4": "gate: is not there", "Install": "gate: is not there", "Files": "gate: is not there", "Upload": "steps.upload.outputs"}
NO_BUILD = "VK_DRIVER_FILES names old/icd.json, which is not there"
LAVAPIPE = "usr/lib/*/libvulkan_lvp.so"
# Commands of a container, with words that they print, and the seconds that they may take.
FIRST_GATE = ("raingauge gate cpu vulkan --pictures", "6 cases, 6 pass", 90)
CONTAINED = {
    "full": [("raingauge doctor", "5 of 5 devices are well", 60), ("raingauge render flow -o /tmp/flow.tif", "/tmp/flow.tif: flow", 60), FIRST_GATE],
    "small": [("raingauge doctor", "4 of 4 devices are well", 60), ("raingauge render flow -o /tmp/flow.png", "/tmp/flow.png: flow", 60), FIRST_GATE],
}


class Tried:
    """Steps and whether they passed."""

    def __init__(self):
        self.failed = 0

    def tell(self, name, is_good, about=""):
        self.failed += not is_good
        print(f"{'pass' if is_good else 'FAIL'}  {name}" + (f": {about}" if about else ""), flush=True)


# --- the image ---


def make_image(variant, folder, options):
    """Whether it could be made, as small as it may be."""
    image = folder / (variant + ".tar")
    if image.exists():
        return True
    command = [sys.executable, str(RECIPE), variant, "--debs", str(options.debs), "-o", str(image)]
    command += ["--apt=" + option for option in options.apt]
    with open(folder / (variant + "-image.log"), "w") as log:
        return subprocess.run(command, stdout=log, stderr=log, check=False).returncode == 0


def blob(tar, words):
    return tar.extractfile("blobs/" + words["digest"].replace(":", "/"))


def unpack(variant, folder):
    """A system of the image's layer, and the image's settings, as a container engine finds them in the archive."""
    system = System(variant, folder)
    with tarfile.open(folder / (variant + ".tar")) as tar:
        manifest = json.load(blob(tar, json.load(tar.extractfile("index.json"))["manifests"][0]))
        config = json.load(blob(tar, manifest["config"]))["config"]
        if not system.root.exists():
            layer = folder / (variant + "-layer.tar.gz")
            with open(layer, "wb") as file:
                shutil.copyfileobj(blob(tar, manifest["layers"][0]), file)
            system.unpack(layer)
            layer.unlink()
    return system, config


def try_contained(system, config, tried):
    """The image's commands, each in a container of its own."""
    variables = dict(line.split("=", 1) for line in config["Env"])
    way = Way("/", {**variables, "HOME": "/nonexistent"}, is_contained=True, has_network=False, is_user=True, temporary=("/tmp",))
    for command, says, most_s in CONTAINED[system.name]:
        begin = time.monotonic()
        ran = system.run(command.split(), way, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        took_s = time.monotonic() - begin
        is_good = ran.returncode == 0 and says in ran.stdout and took_s <= most_s
        tried.tell(f"{system.name}, contained, {command}", is_good, f"{took_s:.0f} s of {most_s} s" + ("" if is_good else "\n" + ran.stdout))
    tried.tell(f"{system.name}: its own command", config["Cmd"] == CONTAINED[system.name][0][0].split())
    written = system.run(["sh", "-c", "touch /written /usr/written || ! test -e /dev/dri"], way, stderr=subprocess.PIPE).returncode
    tried.tell(f"{system.name}: nothing can be written", not written and not (system.root / "written").exists())


def try_containerfile(system, folder, options, tried):
    """The Containerfile's RUN in a bare Debian, for the small variant."""
    run = re.search(r"^RUN --mount=type=bind,target=/context (.*)$", (RECIPE.parent / "Containerfile").read_text(), re.M)
    with tempfile.TemporaryDirectory(dir=folder) as temporary:
        context, there = pathlib.Path(temporary) / "context", pathlib.Path(temporary)
        shutil.copytree(RECIPE.parent, context / "docs/ci/image")
        shutil.copytree(options.debs, context / "build/deb", ignore=lambda at, names: [name for name in names if not name.endswith(".deb")])
        way = Way("/", {"VARIANT": "small"}, {"/context": context, "/etc/resolv.conf": "/etc/resolv.conf"}, layer=there / "layer")
        script = (run[1] if run else "false") + " && raingauge list devices"
        ran = system.run(["sh", "-c", script], way, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    is_good = ran.returncode == 0 and re.search("^vulkan ", ran.stdout, re.M)
    tried.tell("Containerfile", is_good, "" if is_good else ran.stdout)


# --- services ---


class Place:
    """A clean copy of a system in which a service runs its steps, as services.py needs it."""

    def __init__(self, system, project, folder):
        self.system, self.origin, self.folder = system, project, folder
        self.project, self.temporary = folder / "w/project", folder / "w/temporary"
        self.project.mkdir(parents=True)
        self.temporary.mkdir()

    def at(self, path):
        return "/__w/" + str(pathlib.Path(path).relative_to(self.folder / "w"))

    def check_out(self):
        subprocess.run(["git", "clone", "--quiet", str(self.origin), str(self.project)], check=True)

    def run(self, script, variables):
        binds = {"/__w": self.folder / "w", "/etc/resolv.conf": "/etc/resolv.conf"}
        way = Way(self.at(self.project), variables, binds, layer=self.folder / "layer")
        ran = self.system.run([*services.BASH, "-c", script], way, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return ran.returncode, ran.stdout + (f"(exit status {ran.returncode})\n" if ran.returncode else "")


def make_project(folder, driver, is_broken, debs):
    """A repository of a driver with what the examples say, and nothing more: both builds, and the package where no image has it."""
    manifest = json.dumps({"file_format_version": "1.0.0", "ICD": {"library_path": "./driver.so", "api_version": "1.1.0"}})
    for build in ("old", "new"):
        (folder / build).mkdir(parents=True)
        (folder / build / "icd.json").write_text(manifest)
        shutil.copy(driver, folder / build / "driver.so")
    if is_broken:
        (folder / "new/driver.so").write_text("no library\n")
    for deb in debs:
        shutil.copy(deb, folder)
    git = ["git", "-C", str(folder), "-c", "user.name=n", "-c", "user.email=e"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "both builds"]):
        subprocess.run(git + command, check=True)


def try_github(system, project, variables, given, is_broken, folder, tried):
    name = f"github.yml, {system.name}, {'broken' if is_broken else 'good'} driver"
    ended = services.github(GITHUB, Place(system, project, folder / "github"), variables, given)
    page = {"gate/gate.xml", "gate/drivers/page.html", "gate/baseline.xml"} <= set(ended.kept)
    told = services.URL in ended.summary and "## raingauge gate" in ended.summary and (is_broken or "llvmpipe Mesa" in ended.summary)
    is_good = ended.status == ("failure" if is_broken else "success") and page and told
    tried.tell(name, is_good, "" if is_good else f"{ended.status}, {ended.kept}\n{ended.summary}\n{ended.log}")


def try_gitlab(system, project, given, is_broken, folder, tried):
    for job in ("raingauge", "raingauge-baseline"):
        ended = services.gitlab(GITLAB, job, Place(system, project, folder / job), given)
        is_good = (ended.status == "failed") == is_broken and "gate/gate.xml" in ended.kept and services.URL in ended.summary
        is_good = is_good and (job != "raingauge" or "gate/drivers/page.html" in ended.kept)
        tried.tell(f"gitlab-ci.yml, {job}, {system.name}, {'broken' if is_broken else 'good'} driver", is_good,
                   ended.status if is_good else f"{ended.status}, {ended.kept}\n{ended.log}")


def fails_without(system, project, variables, step, folder):
    """Whether the workflow fails if it lacks a step, for this reason. No gate is timed for that."""
    # Without a checkout a bare Debian has no package to install; the image gets as far as the missing build.
    reason = NO_BUILD if variables and "checkout" in step else MISSED[step]
    try:
        ended = services.github(GITHUB, Place(system, project, folder), variables, {"BUDGET": "1s"}, without=step)
        return ended.status == "failure" and reason in ended.log
    except services.Refused as refused:
        return reason in str(refused)


class Server:
    """Serves the packages by http, on this machine alone."""

    def __init__(self, folder):
        handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(folder))
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)

    def __enter__(self):
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return f"http://127.0.0.1:{self.server.server_address[1]}/"

    def __exit__(self, *_):
        self.server.shutdown()


def try_services(system, is_image, folder, options, tried):
    """`is_image`: raingauge is in the system; otherwise the project has the package for GitHub, and a server has it for GitLab."""
    driver = next((folder / "full").glob(LAVAPIPE))
    variables = {"RAINGAUGE_IMAGE": "raingauge"} if is_image else {}
    image = services.github_image(GITHUB, variables), services.gitlab_image(GITLAB, "raingauge", variables)
    tried.tell(f"{system.name}: the files name their image", image == (("raingauge",) * 2 if is_image else ("debian:12",) * 2), str(image))
    debs = [] if is_image else [path for path in options.debs.glob("raingauge_*.deb")]
    given = {"BUDGET": options.budget} if options.budget else {}
    for is_broken in (False, True):
        with tempfile.TemporaryDirectory(dir=folder) as temporary, Server(options.debs) as url:
            there = pathlib.Path(temporary)
            make_project(there / "origin", driver, is_broken, debs)
            try_github(system, there / "origin", variables, given, is_broken, there, tried)
            served = {"RAINGAUGE_PACKAGE": url + debs[0].name} if debs else {}
            try_gitlab(system, there / "origin", {**given, **served}, is_broken, there, tried)
            for step in [] if is_broken else [step for step in MISSED if step != "Install" or not is_image]:
                fails = fails_without(system, there / "origin", variables, step, there / step.replace("/", "-"))
                tried.tell(f"github.yml, {system.name}, fails without {step}", fails)


def bare(folder, options):
    """A Debian 12 as its container image is."""
    system = System("bare", folder)
    if not system.root.exists() and not system.make("bookworm", ["usr-is-merged"], "--hook-dir=/usr/share/mmdebstrap/hooks/merged-usr",
                                                    *("--aptopt=" + option for option in options.apt)):
        sys.exit(f"image.py: no bare Debian; {system.log} says why")
    return system


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--in", dest="folder", type=pathlib.Path, metavar="FOLDER", help="keeps images and systems there, and uses those that are there")
    parser.add_argument("--debs", type=pathlib.Path, default=ROOT / "build/deb", metavar="FOLDER", help="has the packages; default: build/deb")
    parser.add_argument("--budget", metavar="TIME", help="of a timed gate, in place of the examples' own, for a trial")
    parser.add_argument("--apt", action="append", default=[], metavar="OPTION", help="for apt, as 'Acquire::Check-Valid-Until \"false\"'")
    options = parser.parse_args()
    if lacks():
        sys.exit("image.py: " + lacks())
    folder = (options.folder or pathlib.Path(tempfile.mkdtemp(prefix="image-"))).resolve()
    folder.mkdir(exist_ok=True)
    tried = Tried()
    try:
        for variant in CONTAINED:
            is_made = make_image(variant, folder, options)
            tried.tell(f"{variant}: the image", is_made, f"{folder / variant}-image.log" if not is_made else "")
            if is_made:
                begin = time.monotonic()
                system, config = unpack(variant, folder)
                print(f"      unpacked in {time.monotonic() - begin:.0f} s")
                try_contained(system, config, tried)
        if not tried.failed:
            try_services(System("small", folder), True, folder, options, tried)
            system = bare(folder, options)
            try_containerfile(system, folder, options, tried)
            try_services(system, False, folder, options, tried)
    finally:
        if not options.folder:
            shutil.rmtree(folder, ignore_errors=True)
    return 1 if tried.failed else 0


if __name__ == "__main__":
    sys.exit(main())
