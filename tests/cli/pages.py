"""The manual page and bash's completion, which the build makes from the tables of `--help`."""
import glob
import os
import pty
import re
import select
import shlex
import shutil
import subprocess
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COMMANDS = ("doctor", "list", "render", "table", "claims", "sweep", "plan", "merge", "diff", "shrink", "verify", "gate", "baseline", "bisect", "figures", "atlas", "report", "trace")
PARTS = r"\.(TH|SH|SS|TP|PP)\b"  # the macros that the page uses
ESCAPES = r"\\(f[BIR]|[-&e])"


def page(runner, name):
    return os.path.join(os.path.dirname(runner.raingauge), "commands", "pages", name)


def words(text):
    """A text without line breaks and without the marks around commands."""
    return re.sub(r"\s+", " ", text.replace("`", "")).strip()


def plain(roff):
    """The page's text as a reader sees it, without its layout."""
    return words(re.sub(ESCAPES, lambda escape: {"-": "-", "e": "\\"}.get(escape.group(1), ""), roff))


def sections(roff):
    """The part of the page about each command, as roff."""
    parts = re.split(r"^\.SS raingauge (\w+)\n", roff.split("\n.SH TECHNIQUES")[0], flags=re.M)
    return dict(zip(parts[1::2], parts[2::2]))


def check_makes_no_other_page(runner):
    """the build's program for pages ends with 2 where it is asked for no page, or for one that it does not know, and names both"""
    problems = []
    for args in ([], ["manuals"], ["manual", "completion"]):
        run = subprocess.run([page(runner, "raingauge_pages")] + args, capture_output=True, text=True, check=False)
        if (run.returncode, run.stdout, run.stderr) != (2, "", "raingauge_pages manual|completion, run by the build\n"):
            problems.append("%s: %s" % (args, run))
    return problems


def check_manual_is_roff(runner):
    """each line of the manual page is text or a known macro, with known escapes, and ends in the font it began in"""
    problems = []
    with open(page(runner, "raingauge.1")) as file:
        lines = file.read().splitlines()
    for line in lines:
        if line[:1] in (".", "'") and not re.match(PARTS, line) or "\\" in re.sub(ESCAPES, "", line):
            problems.append(line)
        fonts = re.findall(r"\\f([BIR])", line)
        if fonts[::2].count("R") or fonts[1::2].count("R") * 2 != len(fonts):
            problems.append("fonts: " + line)
    if not lines[0].startswith(".TH RAINGAUGE 1 ") or len(lines) < 200:
        problems.append("%d lines: %s" % (len(lines), lines[0]))
    return problems


def check_manual_says_what_help_says(runner):
    """the manual page has each option and argument of each command, its meaning and its default"""
    problems = []
    with open(page(runner, "raingauge.1")) as file:
        found = sections(file.read())
    for command in COMMANDS:
        text = runner.run([command, "--help"]).stdout
        options = re.findall(r"^ {2,6}(?:-\w, )?(--\w+)", text, re.M)
        entries = re.findall(r"^\.TP\n(.*)\n(.*)", found.get(command, ""), re.M)
        tags = " ".join(plain(tag) for tag, _ in entries)
        if len(options) < 2 or re.findall(r"--\w+", tags) != options:
            problems.append("%s has %s, the page %s" % (command, options, tags))
        problems += ["%s --help lacks: %s" % (command, plain(about)) for _, about in entries
                     if plain(about) not in words(text)]
    return problems


def check_manual_lists_statuses(runner):
    """the manual page has each exit status, with the meaning that docs/environment.md gives it"""
    with open(page(runner, "raingauge.1")) as file:
        entries = [(plain(tag), plain(about)) for tag, about in
                   re.findall(r"^\.TP\n(.*)\n(.*)", file.read().split(".SH EXIT STATUS")[1], re.M)]
    with open(os.path.join(ROOT, "docs", "environment.md")) as file:
        rows = re.findall(r"^\| ([\d, ]+) \| ([^|]+) \|", file.read(), re.M)
    documented = [(status, meaning) for statuses, meaning in rows for status in statuses.split(", ")]
    same = len(entries) == len(documented) > 5 and all(
        status == other and about.startswith(meaning) for (status, about), (other, meaning) in zip(entries, documented))
    return [] if same else ["the page has %s, docs/environment.md %s" % (entries, documented)]


def check_manual_renders(runner):
    """man renders the page without a warning"""
    done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", page(runner, "raingauge.1")], encoding="utf-8",
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=dict(os.environ, MANWIDTH="100"))
    text = re.sub(".\b", "", done.stdout)  # bold letters are struck twice
    problems = [done.stderr] if done.stderr or done.returncode else []
    return problems + [word for word in ("NAME", "EXAMPLES", "EXIT STATUS", "raingauge verify", "--background FILE") if word not in text]


def complete(runner, lines, folder):
    """The words that the completion offers in the folder for each line, with the cursor at its end."""
    script = 'source "$0"; for line; do COMP_LINE=$line COMP_POINT=${#line}; _raingauge; echo "${COMPREPLY[*]}"; done'
    done = subprocess.run(["bash", "-c", script, page(runner, "raingauge")] +
                          [runner.raingauge + " " + line for line in lines], env=runner.variables({}), encoding="utf-8",
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=folder)
    return [line.split() for line in done.stdout.split("\n")[:-1]], done.stderr


def listed(runner, *what):
    return [line.split()[0] for line in runner.run(["list", *what]).stdout.splitlines()]


def of_known_files(above):
    """A folder with known files and neighbours, so that the expectations do not depend on where tests are."""
    for folder in ("cli/devices", "cli/drivers", "core"):
        os.makedirs(os.path.join(above, folder))
    for file in ("run.py", "runner.py"):
        open(os.path.join(above, "cli", file), "w").close()
    return os.path.join(above, "cli")


def check_completed_words(runner):
    """bash completes commands, options, techniques, tables, devices, parameters, their values, files and folders"""
    techniques, tables, devices = listed(runner, "techniques"), listed(runner, "tables"), listed(runner, "devices")
    flow, streaks = listed(runner, "params", "flow"), listed(runner, "params", "streaks")
    expected = {
        "": [*COMMANDS, "--help", "--version"],
        "re": ["render", "report"],
        "list ": ["techniques", "tables", "figures", "devices", "params"],
        "list params ": techniques,
        "list params flow ": [],
        "render ": techniques,
        "render --frame 3 f": ["flow"],
        "render --frame ": [],
        "render --frames ": [],
        "render --frames 0-59 f": ["flow"],
        "render flow --fr": ["--frame", "--frames"],
        "render flow ": [],
        "render flow --s": ["--set", "--size"],
        "atlas --": re.findall(r"^ +(?:-\w, )?(--\w+)", runner.run(["atlas", "--help"]).stdout, re.M),
        "atlas ": techniques,
        "render flow --set ": [name + "=" for name in flow],
        "render flow --set view=": ["box", "pane"],
        "render flow --set=view=p": ["pane"],
        "render flow --set=dire": ["direction="],
        "render flow --set drops=": [],
        "render flow --set environment=run": ["run.py", "runner.py"],
        "verify --set atl": ["atlas="],
        "verify raster streaks --set fi": [name + "=" for name in streaks if name.startswith("fi")],
        "render flow --device ": devices,
        "render flow --device cpu:": ["reference"],
        "verify --device ": ["all", *devices],
        "verify --device cpu,cpu:r": ["reference"],
        "verify --device=cpu,cp": ["cpu,cpu", "cpu,cpu:reference"],
        "verify flow r": ["raster"],
        "table ": tables,
        "table creus-5.1 stu": ["stuppacher-1", "stuppacher-2", "stuppacher-drops"],
        "figures creus-4.1": [name for name in listed(runner, "figures") if name.startswith("creus-4.1")],
        "table --format ": ["md", "csv", "json", "tex"],
        "table -o ": ["devices", "drivers"],
        "table -o ../c": ["../core", "../cli"],
        "diff run": ["run.py", "runner.py"],
        "diff fl": ["flow"],
        "diff run.py runn": ["runner.py"],
        "nonsense ": [],
        "nonsense --": [],
    }
    with tempfile.TemporaryDirectory() as above:
        found, errors = complete(runner, expected, of_known_files(above))
    problems = ["stderr: " + errors] if errors else []
    for line, offered in zip(expected, found):
        if sorted(offered) != sorted(expected[line]):
            problems.append("%r: %s, not %s" % (line, offered, expected[line]))
    if len(found) != len(expected):
        problems.append("%d of %d lines" % (len(found), len(expected)))
    return problems


def type_into_bash(runner, text, limit_s=60):
    """The text that a terminal shows while `text` is typed into an interactive bash with our completion."""
    variables = runner.variables({"PS1": "$ ", "TERM": "dumb", "HISTFILE": "", "PAGE": page(runner, "raingauge"),
                                  "PATH": os.path.dirname(runner.raingauge) + ":" + os.environ["PATH"]})
    child, terminal = pty.fork()
    if child == 0:
        os.execvpe("bash", ["bash", "--norc", "--noprofile", "-i"], variables)
    os.write(terminal, text.encode())
    shown, end = b"", time.monotonic() + limit_s
    while time.monotonic() < end and select.select([terminal], [], [], end - time.monotonic())[0]:
        try:
            shown += os.read(terminal, 4096)
        except OSError:
            break
    os.close(terminal)
    os.waitpid(child, 0)
    return shown.decode(errors="replace")


def check_typed_lines(runner):
    """a Tab in a terminal completes the word, with "=" and ":" in it"""
    typed = {"verify --device cpu,cpu:r": "verify --device cpu,cpu:reference",
             "render flow --set=dire\tsp": "render flow --set=direction=split",
             "list params st": "list params streaks"}
    lines = ["bind 'set enable-bracketed-paste off'; source $PAGE\n"]
    # The line is completed, and printed instead of run: Ctrl-A goes to its beginning.
    lines += ["raingauge %s\t\001echo + \n" % line for line in typed]
    shown = type_into_bash(runner, "".join(lines) + "exit\n").replace("\r", "").splitlines()
    printed = [line.strip() for line in shown if line.startswith("+ ")]
    wanted = ["+ raingauge " + line for line in typed.values()]
    return [] if printed == wanted else shown


def check_version(runner):
    """--version names the version that CITATION.cff has, and the commit, which records hold too"""
    with open(os.path.join(ROOT, "CITATION.cff"), encoding="utf-8") as file:
        version = re.search(r"^version: (\S+)$", file.read(), re.M)[1]
    printed = runner.run(["--version"]).stdout
    wanted = r"raingauge %s, commit ([0-9a-f]{7,40}(-dirty)?|unknown)\n" % re.escape(version)
    return [] if re.fullmatch(wanted, printed) else [printed]


# Whom each command is for, in the order of the help.
READERS = {"Drivers: correct, and as fast as before": ("doctor", "diff", "shrink", "verify", "gate", "baseline", "bisect", "trace"),
           "Papers: their tables, claims and figures": ("table", "claims", "sweep", "plan", "merge", "figures", "atlas"),
           "Pictures, names and pages": ("list", "render", "report")}


def check_usage(runner):
    """--help, help and -h print each command once, under its readers, with what its own help begins with"""
    printed = runner.run(["--help"]).stdout
    sections = re.findall(r"(?m)^([A-Z][^\n]*)\n((?:  \w+ .*\n)+)", printed)
    problems = [] if printed.startswith("raingauge COMMAND [OPTION]...\n") and printed.endswith(" prints a command's options.\n") else [printed]
    found = {title: sorted(line.split()[0] for line in lines.splitlines()) for title, lines in sections}
    if found != {title: sorted(names) for title, names in READERS.items()} or [title for title, _ in sections] != list(READERS):
        problems.append("groups: %s" % found)
    for line in "".join(lines for _, lines in sections).splitlines():
        name, about = line.split(None, 1)
        if runner.run([name, "--help"]).stdout.splitlines()[1] != about:
            problems.append(line)
    return problems + [word for word in ("help", "-h") if runner.run([word]).stdout != printed]


PLACEHOLDER = r"[A-Z]+(-[A-Z]+)*|.*(\.\.\.|[\[\]{}<>$*]).*|\S*=[A-Z]+"


def commands_of(text):
    """The command lines of raingauge in a page's code, as words, without what a shell does to their input and output."""
    text = re.sub(r"\\\n\s*", " ", text)
    fenced = "\n".join(re.findall(r"^```\w*\n(.*?)^```$", text, re.M | re.S))
    code = (re.findall(r"`([^`\n]+)`", text) + re.findall(r"^(?:    |\$ )(?:\$ )?(.*raingauge .*)$", text, re.M) +
            re.findall(r"^(raingauge .*)$", fenced, re.M))
    for line in code:
        for part in re.split(r"\s(?:\||&&|;|>|2>)\s?", line):
            found = re.match(r"(?:(?:time|nice|\w+=\S+) )*(?:\S*/)?raingauge (.+)", part.strip())
            if found:
                try:
                    yield shlex.split(found[1], comments=True)
                except ValueError:
                    yield [found[1]]


def check_documented_commands(runner):
    """every command line of README and docs is one that the program takes"""
    problems, tried = [], 0
    pages = [os.path.join(ROOT, "README.md"), *sorted(glob.glob(os.path.join(ROOT, "docs", "*.md")))]
    for path in pages:
        with open(path, encoding="utf-8") as file:
            commands = [words for words in commands_of(file.read()) if not any(re.fullmatch(PLACEHOLDER, word) for word in words)]
        for words in commands:
            asked = words if words[0] in ("help", "--version", "--help") else [*words, "--help"]
            done = runner.run(asked)
            tried += 1
            if done.returncode or done.stderr:
                problems.append("%s: raingauge %s: %s" % (os.path.basename(path), " ".join(words), done.stderr))
    return problems if tried > 100 else ["only %d commands" % tried]


CHECKS = [check_version, check_usage, check_documented_commands, check_makes_no_other_page, check_manual_is_roff, check_manual_says_what_help_says, check_manual_lists_statuses, check_completed_words,
          check_typed_lines]
if shutil.which("man"):
    CHECKS.append(check_manual_renders)
