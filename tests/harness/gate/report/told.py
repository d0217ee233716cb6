"""Reports for the tests of their forms: cases with hostile texts, what the texts become, and the program that writes reports."""
import dataclasses
import math
import resource
import signal
import subprocess
import sys

TELL, SCHEMA = sys.argv[1:3]
NAN = math.nan
# The endings as docs/ci.md maps them: the word, JUnit's element, gtest's word, GitHub's command.
ENDINGS = [
    ("crash", "error", "FAILED", "error"),
    ("timeout", "error", "FAILED", "error"),
    ("error", "error", "FAILED", "error"),
    ("set-up", "error", "FAILED", "error"),
    ("lacking", "error", "FAILED", "error"),
    ("differs", "failure", "FAILED", "error"),
    ("unexpected pass", "failure", "FAILED", "error"),
    ("nothing measured", "error", "FAILED", "error"),
    ("regressed", "failure", "FAILED", "error"),
    ("inconclusive", "skipped", "SKIPPED", "warning"),
    ("flake", "skipped", "SKIPPED", "warning"),
    ("expected failure", "skipped", "SKIPPED", None),
    ("unsupported", "skipped", "SKIPPED", None),
    ("skipped", "skipped", "SKIPPED", None),
    ("improved", None, "OK", None),
    ("pass", None, "OK", None),
]
WORDS = [row[0] for row in ENDINGS]
PASS = WORDS.index("pass")
HOSTILE = [
    b"quotes \" and ' and `", b"<failure message=\"x\">&amp;</failure>", b"]]>", b"<![CDATA[ x ]]>", b"a\nb\tc\rd",
    b"\x1b[31mred\x07\x08\x7f\x01", b"\xff\xfe broken \xc3", b"\xc0\xaf overlong \xed\xa0\x80 surrogate", b"\xf5\x80\x80\x80 beyond \xf4\x90\x80\x80",
    b"100% : , %0A", b"::error title=x::y", b"##[error]x", b"[  FAILED  ] x", b"[[ATTACHMENT|/etc/passwd]]", b"| a | b |", b"```\n# x\n````",
    "Ü 漢 \U0001f327 �".encode(), "\u0085\u009b31m\u2028\u202e\ufffe\uffff".encode(), b"-*?:", b"a.b.c", b"", b" ", b"\n",
]


@dataclasses.dataclass
class Case:
    name: bytes
    technique: bytes = b"streaks"
    device: bytes = b"vulkan"
    seconds: float = 1.25
    ending: int = PASS
    message: bytes = b""
    details: bytes = b""
    picture: bytes = b""
    ratio: tuple = (NAN, NAN, NAN)
    smallest_visible: float = NAN
    time_ms: tuple = (NAN, NAN, NAN)
    baseline_ms: float = NAN

    def fields(self):
        numbers = [*self.ratio, self.smallest_visible, *self.time_ms, self.baseline_ms]
        return [self.name, self.technique, self.device, b"%r" % self.seconds, b"%d" % self.ending, self.message, self.details,
                self.picture] + [repr(number).encode() for number in numbers]


def hostile():
    """Each hostile text in each place, and each ending with it."""
    return [Case(b"streaks." + text, text, text, ending=i % len(ENDINGS), message=text, details=b"one\n" + text + b"\nthree",
                 picture=b"out/" + text, ratio=(1.052, 1.031, 1.074), smallest_visible=0.02, time_ms=(4.5, 4.25, 4.75), baseline_ms=4.25)
            for i, text in enumerate(HOSTILE + HOSTILE[::-1])]


def clean(text, line=True):
    """A text as `harness/compare/gate/report/report.h` cleans it, by Python's own decoder."""
    kept, at = [], 0
    while at < len(text):
        for size in (1, 2, 3, 4):
            try:
                kept.append(text[at:at + size].decode())
                at += size
                break
            except UnicodeDecodeError:
                continue
        else:
            kept.append("\ufffd")
            at += 1
    return "".join(shown(c, line) for c in kept)


def shown(c, line):
    if not line and c in "\n\t":
        return c
    if c < " ":
        return chr(0x2400 + ord(c))
    if c == "\x7f":
        return "\u2421"
    return "\ufffd" if "\x80" <= c < "\xa0" or c in "\u2028\u2029\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\ufffe\uffff" else c


def names(cases):
    """The names of cases in a report: no two are the same."""
    made = []
    for case in cases:
        name, number = clean(case.name), 2
        while name in made:
            name, number = "%s (%d)" % (clean(case.name), number), number + 1
        made.append(name)
    return made


def fill_disk():
    """From now on, files of new processes take no byte, as on a full disk."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


def tell(form, cases, path="-", passport=b"cpu\n<passport>", status=0, is_full=False):
    """The bytes that the program prints; is_full: on a full disk."""
    fields = [passport] + [field for case in cases for field in case.fields()]
    ran = subprocess.run([TELL, form, path], input=b"".join(field + b"\0" for field in fields), capture_output=True, check=False,
                         preexec_fn=fill_disk if is_full else None)
    assert ran.returncode == status, (form, ran.returncode, ran.stderr[-2000:])
    return ran.stdout if status == 0 else ran.stderr


def run(tests):
    """Runs all functions of a module whose names begin with test_."""
    for name, test in sorted(tests.items()):
        if name.startswith("test_"):
            test()
            print("ok", name)
