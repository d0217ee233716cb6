"""A machine's refusals are reported as such: work goes on where possible, and nobody else is blamed."""
import errno
import os
import re
import shutil
import subprocess
import tempfile

SMALL = "--size 32x32 --frame 2 --set resolution_px=64 --set environment=sky --set environment_px=16 "
# Each command reads foreign files in a cage (flow does, for its model), writes files, or needs a driver.
COMMANDS = {
    "list": "list devices",
    "render": "render flow " + SMALL + "-o OUT/a.png",
    "clip": "render flow --frames 0-2 " + SMALL.replace("--frame 2 ", "") + "-o OUT/a.webm",
    "files": "diff IN/a.tif IN/b.hdr",
    "diff": "diff flow --device cpu,gl,vulkan,opencl " + SMALL,
    "verify": "verify shower --quick --size 32x32 --device cpu",
    "gate": "gate cpu gl --pictures --cells IN/cells.txt",
    "table": "table stuppacher-2 --rows 1-1 --quick --device cpu --work paper -o OUT/table",
}
READ = ("render", "clip", "files", "diff")  # these read files in a cage
WRITTEN = ("render", "clip", "table")

EPERM, ENOSYS, EINVAL, EAGAIN = errno.EPERM, errno.ENOSYS, errno.EINVAL, errno.EAGAIN


def shell(line):
    """Runs a shell line before the command."""
    return lambda refusing: ["sh", "-c", line + '; exec "$@"', "sh"]


def within(line, *flags):
    """The same in separate namespaces."""
    return lambda refusing: ["unshare", *(flags or ["-m"])] + shell(line)(refusing)


def call(calls, error):
    return lambda refusing: [refusing, str(error), calls]


# The expected result by command: a status and a pattern for the first lines. Commands without an entry behave as usual.
CAGE = {name: (77, r"no cage \(seccomp, prctl, capset\).*RG_CAGE=off") for name in READ}
NO_PROCESS = {name: (71, r"could not be started|no process could be started") for name in COMMANDS}
NO_SOCKET = {name: (71, r"socketpair") for name in COMMANDS if name != "files"}
NO_FILES = {name: (71, r"ulimit -n\b") for name in COMMANDS}
NO_ADDRESSES = {name: (71, r"under ulimit -v 100000; allow more") for name in ("files", "diff", "gate")}
TOO_LARGE = (71, r"File too large; allow larger files \(ulimit -f\)")
NO_SIZE = {"render": TOO_LARGE, "clip": TOO_LARGE, "table": (71, r"File too large")}
REFUSALS = {
    "no memfd_create": (call("memfd_create", EPERM), {}),
    "an unknown memfd_create": (call("memfd_create", ENOSYS), {}),
    "no linkat": (call("linkat", EPERM), {}),
    "an unknown linkat": (call("linkat", ENOSYS), {}),
    "no O_TMPFILE": (call("nameless", EPERM), {}),
    "none of these three": (call("memfd_create,linkat,nameless", EPERM), {}),
    "no seccomp": (call("seccomp", EPERM), CAGE),
    "an unknown seccomp": (call("seccomp", ENOSYS), CAGE),
    "an emulator": (call("seccomp,prctl", EINVAL), CAGE),
    "no capset": (call("capset", EPERM), CAGE),
    "an emulator, RG_CAGE=off": (lambda refusing: shell("export RG_CAGE=off")(refusing) + call("seccomp,prctl", EINVAL)(refusing), {}),
    "no System V memory": (call("shmget,shmat", ENOSYS), {}),
    "an unknown clone3": (call("clone3", ENOSYS), {}),
    "an unknown close_range": (call("close_range", ENOSYS), {}),
    "an unknown statx": (call("statx", ENOSYS), {}),
    "no waitid": (call("waitid", EPERM), {}),
    "no limits": (call("prlimit64", EPERM), {}),
    "no flock": (call("flock", ENOSYS), {}),
    "no fchmod": (call("fchmod", EPERM), {}),
    "no sendfile": (call("sendfile", ENOSYS), {}),
    "no socketpair": (call("socketpair", EPERM), NO_SOCKET),
    "no processes for now": (call("clone,clone3", EAGAIN), NO_PROCESS),
    "no processes": (call("clone,clone3", EPERM), NO_PROCESS),
    "no /proc": (within("mount -t tmpfs none /proc"), {}),
    "no /proc, no memfd_create": (lambda refusing: within("mount -t tmpfs none /proc")(refusing) + call("memfd_create", EPERM)(refusing), {}),
    "kernel.shmmax": (within("echo 4096 >/proc/sys/kernel/shmmax", "-i"), {}),
    "kernel.shmmni": (within("echo 0 >/proc/sys/kernel/shmmni", "-i"), {}),
    "ulimit -f 0": (shell("ulimit -f 0"), dict(NO_SIZE, diff=(71, r"clBuildProgram.*under ulimit -f 0; allow more"))),
    "ulimit -f 1": (shell("ulimit -f 1"), dict(NO_SIZE, diff=(71, r"clBuildProgram.*under ulimit -f 1; allow more"))),
    "ulimit -n 6": (shell("ulimit -n 6"), NO_FILES),
    "ulimit -v 100000": (shell("ulimit -v 100000"), dict(NO_ADDRESSES, list=(71, r"under ulimit -v 100000; allow more"))),
    "TMPDIR that takes no files": (shell("export TMPDIR=/proc"), {}),
    "TMPDIR and cache that run no programs": (within(
        "mount -t tmpfs -o noexec none /dev/shm; export TMPDIR=/dev/shm XDG_CACHE_HOME=/dev/shm/c"),
        {"diff": (1, r"noexec; set POCL_CACHE_DIR"), "list": (1, r"noexec; set POCL_CACHE_DIR")}),
    "state that takes no files": (shell("export XDG_STATE_HOME=/proc/s"), {}),
    "a folder that takes no files": (shell("cd /proc"), {}),
}
# Words that would blame others.
BLAMES = re.compile(r"its driver (crashed|ended|did not)|is damaged|[Aa]ssimp crashed|install|the Debian package|Cannot allocate memory")
# Parts of the output that may differ: times, names from the kernel, and folders.
TOLD = re.compile(r"unnamed CPU|AMD[^\n]*?(?=  )|\d+(\.\d+)?(e[-+]\d+)? m?s\b")


class Trial:
    """A folder of inputs, and the result of each command without refusals."""

    def __init__(self, runner, refusing, folder):
        self.runner, self.refusing, self.folder, self.plain = runner, refusing, folder, {}
        for name in ("a.tif", "b.hdr"):
            runner.run(("render flow " + SMALL + "-o " + os.path.join(folder, name)).split())
        with open(os.path.join(folder, "cells.txt"), "w") as file:
            file.write("raster/torus raster 32x32 2 scene=mesh model=torus faces=300\n")

    def run(self, name, wrapper):
        """Exit status, stdout, stderr and the names of files afterwards."""
        out = tempfile.mkdtemp(dir=self.folder)
        command = [word.replace("OUT", out).replace("IN/", self.folder + "/") for word in COMMANDS[name].split()]
        done = subprocess.run(wrapper + [self.runner.raingauge] + command, env=self.runner.variables({}), timeout=300,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        files = sorted(file for _, _, names in os.walk(out) for file in names)
        shutil.rmtree(out)
        return done.returncode, done.stdout.replace(out, "OUT"), done.stderr, files

    def problems(self, name, wrap, wanted):
        """Problems of a command under a refusal; None if it cannot be tried."""
        if name not in self.plain:
            self.plain[name] = self.run(name, [])
        status, out, err, files = self.run(name, wrap(self.refusing))
        if re.match("unshare: |sh: .*mount|mount: |sh: .*cannot create /proc/sys", err) or status == 99:
            return None
        said = "status %d, %s, %s" % (status, files, err)
        if err and BLAMES.search(err):
            return ["blames another: " + said]
        if wanted is None:
            plain = self.plain[name]
            same = status == plain[0] and files == plain[3] and TOLD.sub("", self.runner.rest_of(err)) == TOLD.sub("", self.runner.rest_of(plain[2]))
            return [] if same else ["does not go on as elsewhere: " + said]
        return [] if status == wanted[0] and re.search(wanted[1], err) else ["not %d, %s: %s" % (*wanted, said)]


def run(runner, refusing, refusals, commands):
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        trial, tried = Trial(runner, refusing, folder), 0
        for refusal in refusals:
            wrap, wanted = REFUSALS[refusal]
            problems, left_out = [], 0
            for name in commands:
                found = trial.problems(name, wrap, wanted.get(name))
                left_out += found is None
                tried += found is not None
                problems += ["%s: %s" % (name, line) for line in found or []]
            runner.report(refusal + (", of which %d could not be tried # SKIP" % left_out if left_out else ""), problems)
        print("# %d commands of %d tried" % (tried, len(refusals) * len(commands)))


def run_some(runner, refusing):
    # One refusal of each kind, for commands that take less than a second.
    run(runner, refusing, ["none of these three", "an emulator", "an emulator, RG_CAGE=off", "no waitid", "no socketpair", "no processes for now",
                           "no /proc, no memfd_create", "kernel.shmmax", "ulimit -f 0", "ulimit -f 1", "ulimit -n 6", "ulimit -v 100000",
                           "TMPDIR and cache that run no programs"], ["list", "render", "files"])


def run_all(runner, refusing):
    run(runner, refusing, list(REFUSALS), list(COMMANDS))
