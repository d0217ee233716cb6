"""Runs raingauge as a person would, and prints TAP."""
import ctypes
import datetime
import json
import os
import pty
import re
import resource
import shutil
import subprocess
import tempfile
import threading

# Variables that change what raingauge or a driver does; each test sets those that it needs. RG_MUTANT, which selects a
# fault, belongs to `make mutants`.
CHANGES = re.compile(r"^(RG_(?!MUTANT$)|LP_|OMP_|GOMP_|POCL_|VK_|MESA_|GALLIUM|GALLIVM|LIBGL_|EGL_|__EGL_|OCL_|LD_|GTEST_|SLURM_|CI_NODE_)")
NO_DRIVERS = {
    "VK_DRIVER_FILES": "/nonexistent",
    "OCL_ICD_VENDORS": "/nonexistent",
    "__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent",
}

# A date until which an expectation may hold.
LATER = (datetime.date.today() + datetime.timedelta(90)).isoformat()

# The last line of table and sweep.
CLOSING = re.compile(r"^raingauge: (?:\d+ of )?\d+ cells? measured on \d+ devices?(?:; [^;\n]*)?\n", re.M)

PR_CAPBSET_DROP, CAP_DAC_OVERRIDE = 24, 1


def obey_modes():
    """Makes processes that this one starts obey the modes of files, even for root."""
    if os.getuid() == 0 and ctypes.CDLL(None, use_errno=True).prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0):
        raise OSError(ctypes.get_errno(), "CAP_DAC_OVERRIDE cannot be dropped")


class Runner:
    def __init__(self, raingauge, kernels, crasher, misbehaver, earlier, slower):
        self.raingauge, self.kernels, self.crasher, self.misbehaver, self.earlier, self.slower = map(
            os.path.abspath, (raingauge, kernels, crasher, misbehaver, earlier, slower))
        self.count = self.failed = 0
        self.state = tempfile.TemporaryDirectory()  # files that commands keep between runs

    def variables(self, env):
        """This process's variables, without those that change what raingauge does, and with these; None removes one. Threads do not
        spin, since other tests run on the same cores."""
        variables = {k: v for k, v in os.environ.items() if not CHANGES.match(k)}
        variables["GOMP_SPINCOUNT"] = "0"
        variables["RG_LONG_S"] = "1e9"  # keeps a busy machine from adding a line, like the next
        variables["RG_PROBE_S"] = "0"
        variables["RG_FEW_SAMPLES"] = "1"  # no test of commands needs more
        variables["XDG_STATE_HOME"] = self.state.name
        variables.update(env)
        return {name: value for name, value in variables.items() if value is not None}

    def start(self, args, env={}, obeys_modes=False):
        """A command that runs beside this process; the caller waits for it."""
        return subprocess.Popen([self.raingauge] + args, env=self.variables(env), stdin=subprocess.DEVNULL,
                                preexec_fn=obey_modes if obeys_modes else None,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")

    @staticmethod
    def rest_of(messages):
        """A command's messages without the closing line of tables."""
        return CLOSING.sub("", messages)

    def run(self, args, env={}, limit=None, stdout=subprocess.PIPE, obeys_modes=False):
        """Runs a command with these variables, which can write files of up to `limit` bytes; with `obeys_modes` even root's obeys
        the modes of files. The closing line of tables is `closing`, and not in `stderr`."""

        def restrict():
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
            if obeys_modes:
                obey_modes()

        result = subprocess.run([self.raingauge] + args, env=self.variables(env), preexec_fn=restrict, timeout=300,
                                stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE,
                                encoding="utf-8")
        result.closing = "".join(CLOSING.findall(result.stderr))
        result.stderr = self.rest_of(result.stderr)
        return result

    def on_terminal(self, args, env={}):
        """A command whose stdout is a terminal."""
        ours, its = pty.openpty()
        parts = []

        def read():
            try:
                while part := os.read(ours, 65536):
                    parts.append(part)
            except OSError:  # the terminal was closed
                pass

        reader = threading.Thread(target=read)  # a terminal buffers only some kilobytes, so its writer would wait
        reader.start()
        result = self.run(args, env, stdout=its)
        os.close(its)
        reader.join()
        os.close(ours)
        result.stdout = b"".join(parts).decode("utf-8").replace("\r\n", "\n")
        return result

    def report(self, name, problems):
        self.count += 1
        self.failed += bool(problems)
        print("%s %d - %s" % ("not ok" if problems else "ok", self.count, name.replace("#", "")))
        for problem in problems:
            print("# " + problem.replace("\n", "\n# "), flush=True)

    def check_all(self, checks):
        """Runs functions that return a list of problems; their docstrings say what holds."""
        for check in checks:
            self.report(" ".join(check.__doc__.split()), check(self))  # TAP has a line a check

    def finish(self):
        print("1..%d" % self.count)
        return 1 if self.failed else 0

    def crashing_vulkan(self, folder):
        """Variables that make Vulkan's only driver one that crashes every process that asks for its devices."""
        path = os.path.join(folder, "crash.json")
        with open(path, "w") as file:
            json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": self.crasher, "api_version": "1.3.0"}}, file)
        return {"VK_DRIVER_FILES": path}

    def kernels_with(self, folder, name, right, wrong):
        """Copies the kernels into `folder`, with one piece of one file's text replaced."""
        for file in os.listdir(self.kernels):
            if file.endswith((".glsl", ".vert", ".frag", ".cl", ".spv")):
                shutil.copy(os.path.join(self.kernels, file), folder)
        path = os.path.join(folder, name)
        with open(path) as file:
            source = file.read()
        if right not in source:
            raise ValueError("%s no longer holds %s" % (name, right))
        with open(path, "w") as file:
            file.write(source.replace(right, wrong))
        return {"RG_KERNEL_DIR": folder}
