"""Output through a link, or into a file, of another user in a folder for all, by the rules of fs.protected_symlinks and its kin."""
import os
import re
import tempfile

OTHER, THIRD = 12345, 23456
PICTURE = "render flow --set model=none --set environment=sky --size 32x32 --frame 1 -o %s"
GATE = "gate cpu cpu:reference --pictures --cells %s/cells.txt "
TABLE = "table stuppacher-2 --rows 1-1 --quick --device cpu --work paper -o %s"
REFUSED = r"is or goes through a link that another user has put into a folder for all"

# The folder's mode, the owners of the folder and of the link, and whether the link is followed.
RULES = [
    ("another's link in a folder for all", 0o1777, 0, OTHER, False),
    ("one's own link there", 0o1777, OTHER, 0, True),
    ("a link of the folder's owner there", 0o1777, OTHER, OTHER, True),
    ("another's link in a folder of another", 0o755, OTHER, OTHER, True),
    ("another's link in one's own folder", 0o755, 0, OTHER, True),
    ("another's link in a folder that all may clear", 0o777, 0, OTHER, True),
    ("another's link in a sticky folder of few", 0o1755, 0, OTHER, True),
    ("a third's link in another's folder for all", 0o1777, OTHER, THIRD, False),
]


def shared(folder, mode, owner):
    path = os.path.join(folder, "shared")
    os.mkdir(path)
    os.chmod(path, mode)
    os.chown(path, owner, -1)
    return path


def link(target, path, owner):
    os.symlink(target, path)
    os.chown(path, owner, -1, follow_symlinks=False)


def check_rules(runner):
    """a picture goes through a link by the kernel's rule, even if the kernel has it off"""
    problems = []
    for about, mode, folder_owner, link_owner, follows in RULES:
        for is_there in (False, True):
            with tempfile.TemporaryDirectory() as folder:
                here = shared(folder, mode, folder_owner)
                target = os.path.join(folder, "target.png")
                with open(target, "w") as file:
                    file.write("before")
                via = os.path.join(here, "a.png")
                if is_there:  # through a second link, which is one's own
                    link(target, os.path.join(here, "b.png"), link_owner)
                    os.symlink(os.path.join("shared", "b.png"), os.path.join(folder, "c.png"))
                    via = os.path.join(folder, "c.png")
                else:
                    link(os.path.join("..", "target.png"), via, link_owner)
                done = runner.run((PICTURE % via).split())
                with open(target, "rb") as file:
                    is_written = file.read() != b"before"
            if is_written != follows or done.returncode != (0 if follows else 2) or (not follows and not re.search(REFUSED, done.stderr)):
                problems.append("%s: written %s, status %d, %s" % (about, is_written, done.returncode, done.stderr))
    return problems


def outputs(folder, path):
    """Command lines that write to a path, with the variables of each; those that take a folder first."""
    gate = GATE % folder
    return [
        (TABLE % path, {}), ("sweep flow --axis resolution_px=32,64 --set model=none --size 32x32 --quick --device cpu -o %s" % path, {}),
        (gate + "-o %s" % path, {}), ("atlas cartoon -o %s" % path, {}),
        (gate + "--junit %s" % path, {}), (gate + "--bmf %s" % path, {}), (gate + "--gtest_output xml:%s" % path, {}),
        (gate + "--github", {"GITHUB_STEP_SUMMARY": path}),
        ("baseline --pictures --device cpu --cells %s/cells.txt -o %s" % (folder, path), {}),
        ("render flow --set model=none --frames 0-1 --size 64x64 -o %s.webm" % path, {}),
    ]


def check_outputs(runner):
    """no output goes through another's link in a folder for all: folders, reports, summaries, baselines, clips"""
    problems = []
    for i in range(10):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "cells.txt"), "w") as file:
                file.write("raster/torus raster 32x32 2 scene=mesh model=torus faces=300\n")
            here, target = shared(folder, 0o1777, 0), os.path.join(folder, "target")
            os.mkdir(target) if i < 4 else open(target, "w").close()
            for name in ("out", "out.webm"):
                link(target, os.path.join(here, name), OTHER)
            command, env = outputs(folder, os.path.join(here, "out"))[i]
            done = runner.run(command.split(), env)
            is_touched = bool(os.listdir(target)) if i < 4 else os.path.getsize(target) > 0
        if is_touched or done.returncode != 2 or not re.search(REFUSED, done.stderr):
            problems.append("%s: touched %s, status %d, %s" % (command, is_touched, done.returncode, done.stderr))
    return problems


def check_appended(runner):
    """another's file is not appended to there"""
    problems = []
    for owner, appends in ((OTHER, False), (0, True)):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "cells.txt"), "w") as file:
                file.write("raster/torus raster 32x32 2 scene=mesh model=torus faces=300\n")
            path = os.path.join(shared(folder, 0o1777, THIRD), "summary")
            open(path, "w").close()
            os.chown(path, owner, -1)
            done = runner.run((GATE % folder + "--github").split(), {"GITHUB_STEP_SUMMARY": path})
            is_appended = os.path.getsize(path) > 0
        if is_appended != appends or (done.returncode == 2) == appends or (not appends and "another user" not in done.stderr):
            problems.append("owner %d: appended %s, status %d, %s" % (owner, is_appended, done.returncode, done.stderr))
    return problems


def run(runner, refusing):
    del refusing
    if os.getuid():
        runner.report("links of other users # SKIP only root makes them", [])
    else:
        runner.check_all([check_rules, check_outputs, check_appended])
