"""A Debian in a folder, in whose namespaces commands run. It needs root, and for `make` the package mmdebstrap and network."""
import os
import pathlib
import shlex
import shutil
import subprocess

PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
ID = 1000  # of a user whom no system knows
# What a container has of /dev: no GPU.
DEVICES = {"null": 3, "zero": 5, "full": 7, "random": 8, "urandom": 9}


class Way:
    """How commands run in a system: what they see of the machine, and as whom."""

    def __init__(self, folder="/", variables=None, binds=None, layer=None, is_contained=False, has_network=True, is_user=False, temporary=()):
        self.folder = folder  # where a command begins
        self.variables = {"PATH": PATH, "HOME": "/root", "LANG": "C.UTF-8", **(variables or {})}
        self.binds = binds or {}  # folders and files of this machine, by where the system has them
        self.layer = layer  # a folder that takes what commands change, so that the system stays as it is
        self.is_contained = is_contained  # as in a container: the root file system and /sys are read-only, and /dev has no GPU
        self.has_network, self.is_user = has_network, is_user
        self.temporary = temporary  # folders in memory, which all may write

    def mounts(self, root):
        """Lines of a shell that mount what the system has, within its own namespace."""
        quoted = shlex.quote(str(root))
        lines = ["set -e", f"mount --bind {quoted} {quoted}"]
        if self.layer:
            layers = ",".join((f"lowerdir={root}", f"upperdir={self.layer}/upper", f"workdir={self.layer}/work"))
            lines += [f"mkdir -p {shlex.quote(str(self.layer))}/upper {shlex.quote(str(self.layer))}/work",
                      f"mount -t overlay -o {shlex.quote(layers)} overlay {quoted}"]
        lines += [f"cd {quoted}", "mount -t proc proc proc"]
        if self.is_contained:
            lines += ["mount -t sysfs -o ro sysfs sys", "mount -t tmpfs -o mode=755 tmpfs dev", "mkdir dev/shm",
                      "mount -t tmpfs -o mode=1777 tmpfs dev/shm", "ln -s /proc/self/fd dev/fd"] + [f"mknod -m 666 dev/{name} c 1 {number}" for name, number in DEVICES.items()]
        else:
            lines += ["mount --rbind /sys sys",  # PoCL asks it for the processors
                      "mount --rbind /dev dev"]
        lines += [f"mount -t tmpfs -o mode=1777 tmpfs .{folder}" for folder in self.temporary]
        for to, source in self.binds.items():
            lines += [f"mkdir -p .{to}" if os.path.isdir(source) else f"touch .{to}", f"mount --bind {shlex.quote(str(source))} .{to}"]
        return lines + ([f"mount -o remount,bind,ro {quoted}"] if self.is_contained else [])

    def command(self, root, command):
        """A command line that runs a command in a system."""
        chroot = ["chroot"] + ([f"--userspec={ID}:{ID}", f"--groups={ID}"] if self.is_user else []) + [str(root)]
        inner = "; ".join(self.mounts(root)) + '; "$@"; exit $?'  # the shell is process 1, and reaps processes as an init does
        spaces = ["--mount", "--pid", "--fork", "--kill-child"] + ([] if self.has_network else ["--net"])
        return ["unshare"] + spaces + ["sh", "-c", inner, "sh"] + chroot + ["sh", "-c", 'cd "$0" && exec "$@"', self.folder] + list(command)


class System:
    """One Debian, by its root file system, with a log of what was done in it."""

    def __init__(self, name, folder):
        self.name, self.root, self.log = name, pathlib.Path(folder) / name, pathlib.Path(folder) / (name + ".log")

    def say(self, text):
        print(f"{self.name}: {text}", flush=True)

    def make(self, debian, packages, *more, mirror=None):
        """Makes it of a Debian's packages, with more options of mmdebstrap. Whether that went well."""
        command = ["mmdebstrap", "--variant=apt", "--include=" + ",".join(packages), *more, debian, str(self.root)]
        command += [mirror] if mirror else []
        with open(self.log, "a") as log:
            return subprocess.run(command, stdout=log, stderr=log, check=False).returncode == 0

    def unpack(self, tree):
        """Makes it of a tar archive."""
        self.root.mkdir()
        subprocess.run(["tar", "-x", "--numeric-owner", "-f", str(tree), "-C", str(self.root), "--exclude=./dev/*"], check=True)

    def run(self, command, way=Way(), **more):
        """Runs a command in the system, in namespaces of its own so that nothing stays mounted; `more` is for subprocess.run."""
        return subprocess.run(way.command(self.root, command), env=way.variables, stdin=subprocess.DEVNULL, check=False, **more)

    def within(self, command, way=Way()):
        """The same, with what it prints in the log. Whether it ended with 0."""
        with open(self.log, "a") as log:
            print("+", *command, file=log, flush=True)
            return self.run(command, way, stdout=log, stderr=log).returncode == 0


def lacks():
    """What keeps this machine from making systems; None if nothing does."""
    missing = [name for name in ("mmdebstrap", "unshare") if not shutil.which(name)]
    return "needs root" if os.geteuid() else "needs the program " + missing[0] if missing else None
