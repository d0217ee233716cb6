#!/usr/bin/env python3
"""Plans, shards and merges under Debian's Slurm, with real daemons: slurm.py RAINGAUGE [--keep].

One slurmctld and two slurmds run on this host, with munge on a socket and a key of their own, all in a temporary folder. An array of four shards
runs over the two nodes, each with a pretended GPU. One node is killed in mid-shard: Slurm requeues its job, and the other node finishes it. The
merge waits for the array, and must see every cell once. It asserts on records and never on times, for both nodes share this host's processors.
Needs Debian's packages slurmctld, slurmd, slurm-client and munge, and root. Takes some two minutes.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCRIPT = ROOT / "docs" / "farm" / "slurm.sh"
PROGRAMS = ("slurmctld", "slurmd", "munged", "mungekey", "sbatch", "scontrol", "squeue", "sinfo")
TABLES = ("raster-1", "ye-1", "chin-grid", "stuppacher-2")
SHARDS, NODES = 4, ("one", "two")
LIMIT_S, BEGIN_S = 400, 30

CONF = """ClusterName=farm
SlurmctldHost={host}
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={path}/munge.socket
StateSaveLocation={path}/state
SlurmdSpoolDir={path}/spool-%n
SlurmctldPidFile={path}/slurmctld.pid
SlurmdPidFile={path}/slurmd-%n.pid
SlurmctldLogFile={path}/slurmctld.log
SlurmdLogFile={path}/slurmd-%n.log
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
GresTypes=gpu
SlurmdTimeout=10
KillWait=2
ReturnToService=0
NodeName=one NodeHostname={host} Port={ports[1]} CPUs={cpus} Gres=gpu:1
NodeName=two NodeHostname={host} Port={ports[2]} CPUs={cpus} Gres=gpu:1
PartitionName=farm Nodes=one,two Default=YES OverSubscribe=EXCLUSIVE
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def wait_for(what, condition, limit_s=LIMIT_S):
    end = time.monotonic() + limit_s
    while not condition():
        if time.monotonic() > end:
            sys.exit("slurm.py: waited %d s for %s" % (limit_s, what))
        time.sleep(0.2)


class Cluster:
    """The daemons, which end with it."""

    def __init__(self, path, raingauge):
        self.path, self.daemons = path, {}
        self.env = {**os.environ, "SLURM_CONF": str(path / "slurm.conf"), "PATH": "%s:%s" % (raingauge.parent, os.environ["PATH"]), "RG_PROBE_S": "0"}
        with open(path / "slurm.conf", "w", encoding="utf-8") as file:
            file.write(CONF.format(host=socket.gethostname(), path=path, ports=free_ports(3), cpus=os.cpu_count(), user="root"))
        with open(path / "gres.conf", "w", encoding="utf-8") as file:
            file.write("NodeName=one Name=gpu File=/dev/null\nNodeName=two Name=gpu File=/dev/zero\n")
        self.run("mungekey", "--create", "--keyfile=%s/munge.key" % path)
        self.start("munged", "--foreground", "--force", "--socket=%s/munge.socket" % path, "--key-file=%s/munge.key" % path,
                   "--pid-file=%s/munge.pid" % path, "--seed-file=%s/munge.seed" % path, "--log-file=%s/munge.log" % path)
        wait_for("munged", (path / "munge.socket").exists, BEGIN_S)
        self.start("slurmctld", "-D", "-c")
        for node in NODES:
            self.start("slurmd", "-D", "-N", node)
        wait_for("two idle nodes", lambda: self.run("sinfo", "-h", "-N", "-o", "%T", check=False).stdout.split() == ["idle", "idle"], BEGIN_S)

    def start(self, *args):
        with open(self.path / ("%s.out" % args[0]), "a", encoding="utf-8") as out:
            self.daemons[args[-1] if args[0] == "slurmd" else args[0]] = subprocess.Popen(args, env=self.env, stdout=out, stderr=out, start_new_session=True)

    def run(self, *args, check=True):
        done = subprocess.run(args, env=self.env, cwd=self.path, capture_output=True, text=True, timeout=LIMIT_S, check=False)
        if check and done.returncode:
            sys.exit("slurm.py: %s: %s%s" % (" ".join(args), done.stdout, done.stderr))
        return done

    def jobs(self):
        """Of each job that has not ended: its state, its reason and its node."""
        told = self.run("squeue", "-h", "-r", "-o", "%A %T %r %N").stdout
        return {words[0]: words[1:] for words in map(str.split, told.splitlines())}

    def kill_node(self, node):
        """All that runs on a node ends at once, as when it loses its power: the daemons first, which else would tell of the job's end."""
        daemon = self.daemons.pop(node)
        ours = {"SLURMD_NODENAME=" + node, "SLURM_CONF=" + self.env["SLURM_CONF"]}
        jobs = [pid for pid, environment in environments() if ours <= set(environment)]
        steps = {parent_of(pid) for pid in jobs} - {1, None, *jobs}  # a daemon each, above the job's script
        for pid in [daemon.pid, *steps, *jobs]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        daemon.wait()

    def stop(self):
        for node in NODES:
            if node in self.daemons:
                self.kill_node(node)
        for daemon in self.daemons.values():
            daemon.terminate()
        for daemon in self.daemons.values():
            daemon.wait(timeout=30)


def environments():
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open("/proc/%s/environ" % pid, "rb") as file:
                yield int(pid), file.read().decode("utf-8", "replace").split("\0")
        except OSError:
            pass


def parent_of(pid):
    try:
        with open("/proc/%d/stat" % pid, encoding="utf-8") as file:
            return int(file.read().rsplit(")", 1)[1].split()[1])
    except OSError:
        return None


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def end_all(cluster):
    """Waits until no job is left. A job of a node that fell is held for two minutes, unless it is released."""

    def ended():
        jobs = cluster.jobs()
        for job, (state, reason, *_) in jobs.items():
            if state == "PENDING" and reason in ("BeginTime", "Resources", "None"):
                cluster.run("scontrol", "update", "jobid=%s" % job, "StartTime=now", check=False)
        return not jobs

    wait_for("the end of all jobs", ended)


def cells_of(plan):
    return sorted(cell["id"] for group in plan["groups"] for cell in group["cells"])


def merged_cells(folder):
    """The ids of a merged run's cells, as plans have them."""
    ids = []
    for path in folder.glob("*.json"):
        table = read(path)
        for cell in table["cells"]:
            parts = [table["table"], str(cell["row_number"]), cell.get("work"), cell["variant"], cell["device"]]
            ids.append("/".join(part for part in parts if part))
    return sorted(ids)


def check(cluster, path):
    problems, records = [], path / "records"
    cluster.run("raingauge", "plan", *TABLES, "--device", "cpu", "--quick", "--shards", str(SHARDS), "-o", "plan.json")
    plan = read(path / "plan.json")
    array = cluster.run("sbatch", "--parsable", "--array=1-%d" % SHARDS, "--gres=gpu:1", str(SCRIPT)).stdout.strip()
    cluster.run("sbatch", "--dependency=afterany:" + array, "--output=merge.log", "--wrap", "raingauge merge plan.json records -o tables")
    wait_for("a record, while both nodes measure", lambda: records.exists() and any(records.iterdir()) and
             sum(state[0] == "RUNNING" for state in cluster.jobs().values()) == 2)
    lost = [job for job, (state, _, *node) in cluster.jobs().items() if state == "RUNNING" and node == ["one"]]
    before = {name: os.stat(records / name).st_mtime_ns for name in os.listdir(records)}
    cluster.kill_node("one")
    wait_for("the fall of a node to be seen", lambda: "down" in cluster.run("sinfo", "-h", "-N", "-n", "one", "-o", "%T").stdout)
    print("node one fell with job %s and %d of %d records written" % (" ".join(lost), len(before), len(plan["groups"])))
    end_all(cluster)
    told = (path / "merge.log").read_text(encoding="utf-8")
    if not re.search(r"%d cells of %d, key " % ((len(cells_of(plan)),) * 2), told):
        problems.append("merge: " + told)
    if len(os.listdir(records)) != len(plan["groups"]):
        problems.append("%d records of %d groups" % (len(os.listdir(records)), len(plan["groups"])))
    problems += ["%s was written twice" % name for name, when in before.items() if os.stat(records / name).st_mtime_ns != when]
    if merged_cells(path / "tables") != cells_of(plan):
        problems.append("merged: %s" % merged_cells(path / "tables"))
    restarts = cluster.run("scontrol", "show", "job", *lost[:1], check=False).stdout
    if len(lost) != 1 or "Restarts=1" not in restarts:
        problems.append("job %s was not requeued: %s" % (lost, restarts))
    left = cluster.run("raingauge", "plan", "--missing", "plan.json", "records")
    return problems + ["left: " + left.stdout for _ in range(bool(left.stdout))]


def main():
    lacks = [name for name in PROGRAMS if not shutil.which(name)]
    if lacks or os.geteuid():
        sys.exit("slurm.py: needs %s" % (", ".join(lacks) + ": install slurmctld, slurmd, slurm-client and munge" if lacks else "root"))
    raingauge, path = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(tempfile.mkdtemp(prefix="raingauge-slurm-"))
    cluster = None
    try:
        cluster = Cluster(path, raingauge)
        problems = check(cluster, path)
    finally:
        if cluster:
            cluster.stop()
        if "--keep" in sys.argv:
            print("all is kept in %s" % path)
        else:
            shutil.rmtree(path)
    print("\n".join(problems) or "every cell was merged once")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
