"""INT, TERM and HUP end every command within two seconds, even as a container's first process, for which the kernel has no default end."""
import concurrent.futures
import os
import random
import signal
import subprocess
import tempfile
import time

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
FLOW = "flow --set model=none --set environment=sky "
# Commands that run for longer than a test waits, with their child processes: workers, vpxenc, a shell with a gate, a
# reader of meshes.
COMMANDS = {
    "render": "render flow --size 1024x1024 --frame 100000 -o OUT/a.png",
    "pictures": "render flow --frames 0-100000 --size 64x64 -o OUT/%d.png",
    "clip": "render flow --frames 0-100000 --size 64x64 -o OUT/a.webm",
    "a long frame": "render raster --set billboards=10000000 --size 1024x1024 --frame 1000 -o OUT/a.png --device gl",
    "diff": "diff flow --device cpu,gl --frame 100000 -o OUT/heat",
    "diff of files": "diff IN/a.exr IN/b.exr -o OUT/heat",
    "verify": "verify flow --full --device cpu,gl",
    "table": "table chin-grid --quick --device cpu -o OUT/table",
    "compile": "table chin-grid stuppacher-1 ye-1 raster-1 --compile --device gl,vulkan",
    "sweep": "sweep " + FLOW + "--axis seed=1,2..9 --device cpu -o OUT/sweep",
    "gate": "gate cpu cpu:reference --junit OUT/junit.xml",
    "baseline": "baseline --device cpu -o OUT/kept.json",
    "bisect": "bisect --good a --bad b --run 'RAINGAUGE render flow --frame 100000 -o OUT/$RG_CANDIDATE.png' c",
    "atlas": "atlas --full -o OUT/atlas",
    "a mesh": "render raster --set scene=mesh --set model=IN/large.obj --frame 0 -o OUT/a.png",
    "shrink": "shrink flow --device cpu,cpu:reference --frame 1000 -o OUT/case.txt",
    "doctor": "doctor",
}
NAMESPACE = ["unshare", "-pf", "--mount-proc"]
# No command above ends by itself within this time. An end that takes two seconds or more is only printed, because a
# busy machine takes longer.
PATIENCE_S, AT_ONCE = 60, 4


def below(pid):
    """A process's descendants."""
    try:
        with open("/proc/%d/task/%d/children" % (pid, pid)) as file:
            children = [int(word) for word in file.read().split()]
    except OSError:
        return []
    return children + [grandchild for child in children for grandchild in below(child)]


def runs(pid):
    try:
        with open("/proc/%d/stat" % pid) as file:
            return file.read().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def heed():
    """Sets signals as in a terminal, whatever started this process."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, [])
    os.setsid()


def disregard():
    """Sets signals as a careless supervisor leaves them."""
    heed()
    signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)


class Folder:
    """Inputs for the commands."""

    def __init__(self, runner, path):
        self.runner, self.path = runner, path
        for name, frame in (("a.exr", 2), ("b.exr", 3)):
            runner.run(("render " + FLOW + "--size 2048x2048 --frame %d -o %s/%s" % (frame, path, name)).split())
        numbers = random.Random(5)
        with open(path + "/large.obj", "w") as file:
            for _ in range(200000):
                file.write("v %.6f %.6f %.6f\n" % (numbers.random(), numbers.random(), numbers.random()))
            for i in range(1, 400000):
                file.write("f %d %d %d\n" % tuple(numbers.randrange(1, 200001) for _ in range(3)))

    def args(self, command, out):
        words, quoted = [], command.split("'")
        for i, part in enumerate(quoted):
            words += [part] if i % 2 else part.split()
        return [word.replace("OUT", out).replace("IN/", self.path + "/").replace("RAINGAUGE", self.runner.raingauge) for word in words]


def end(folder, name, number, is_first=False, after_s=0.6, prepare=heed):
    """Problems after a signal that is sent this long after the start, and the time until the end; None if the command had ended before."""
    runner = folder.runner
    with tempfile.TemporaryDirectory() as out, tempfile.TemporaryDirectory() as tried:
        # The atlas is made again, which takes minutes.
        env = runner.variables({"XDG_STATE_HOME": out, "TMPDIR": tried, "XDG_CACHE_HOME": out if name == "atlas" else os.environ.get("XDG_CACHE_HOME")})
        process = subprocess.Popen(NAMESPACE * is_first + [runner.raingauge] + folder.args(COMMANDS[name], out), env=env, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8", preexec_fn=prepare)
        time.sleep(after_s)
        pid = (below(process.pid) or [process.pid])[0] if is_first else process.pid
        if process.poll() is not None:
            print("# %s had ended, %s" % (name, process.communicate()[1]))
            return [], None
        others = below(pid)
        os.kill(pid, number)
        start = time.monotonic()
        while (runs(pid) or any(map(runs, others))) and time.monotonic() - start < PATIENCE_S:
            time.sleep(0.01)
        took_s, left = time.monotonic() - start, [other for other in [pid] + others if runs(other)]
        for other in left:
            os.kill(other, signal.SIGKILL)
        messages = process.communicate(timeout=PATIENCE_S)[1]
        files = [file for _, _, files in os.walk(out) for file in files if ".tmp" in file] + os.listdir(tried)
        problems = ["%d of %d processes run on" % (len(left), 1 + len(others))] if left else []
        if process.returncode not in (128 + number, -number):
            problems.append("status %d" % process.returncode)
        if files:
            problems.append("left: %s" % files)
        return ["%s, %s: %s; %s" % (name, number.name, problem, messages) for problem in problems], took_s


def end_all(folder, trials):
    """The problems of several trials; the slowest is printed."""
    problems, slowest_s, tried = [], 0, 0
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:  # the threads mostly sleep
        ends = list(pool.map(lambda trial: end(folder, *trial), trials))
    for found, took_s in ends:
        problems += found
        tried += took_s is not None
        slowest_s = max(slowest_s, took_s or 0)
    print("# %d of %d were at work; the slowest ended within %.1f s" % (tried, len(trials), slowest_s))
    return problems + ([] if 2 * tried > len(trials) else ["only %d of %d were at work" % (tried, len(trials))])


def has_namespaces():
    return subprocess.run(NAMESPACE + ["true"], stderr=subprocess.DEVNULL, check=False).returncode == 0


def run(runner, refusing):
    del refusing
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(runner, path)
        turns = [(name, SIGNALS[i % len(SIGNALS)]) for i, name in enumerate(COMMANDS)]
        runner.report("a signal ends each command and what it has started, and leaves nothing", end_all(folder, turns))
        first = [(name, SIGNALS[(i + 1) % len(SIGNALS)], True) for i, name in enumerate(COMMANDS)]
        if has_namespaces():
            runner.report("so does one to the first process of a container", end_all(folder, first))
        else:
            runner.report("so does one to the first process of a container # SKIP no namespaces here", [])
        runner.report("and one that comes while it starts",
                      end_all(folder, [("render", SIGNALS[i % 3], False, after_s) for i, after_s in enumerate((0, 0.005, 0.01, 0.02, 0.05, 0.1))]))
        runner.report("also where whoever started it ignores or blocks them",
                      end_all(folder, [(name, number, False, 0.6, disregard) for name in ("render", "table") for number in SIGNALS]))
        runner.report("but for SIGHUP under nohup", [] if goes_on_without_a_terminal(folder) else ["it ended"])


def goes_on_without_a_terminal(folder):
    """Whether a command that ignores SIGHUP goes on after one, and ends by SIGTERM."""

    def ignore():
        heed()
        signal.signal(signal.SIGHUP, signal.SIG_IGN)

    process = subprocess.Popen([folder.runner.raingauge] + folder.args(COMMANDS["doctor"], ""), env=folder.runner.variables({}), stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=ignore)
    time.sleep(0.3)
    process.send_signal(signal.SIGHUP)
    return process.wait(timeout=300) == 0
