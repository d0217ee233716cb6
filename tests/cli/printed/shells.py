"""bisect: lines of a command and names of candidates by chance, against dash and bash.

Each line calls `judge` with some words, of which it is known what a shell makes. It is made twice: with "{}", which raingauge takes or
refuses, and with the variable that a refusal names. Whatever was taken has to hand each candidate over as it is.
"""
import random
import shlex
import subprocess

SEED = 20
SHELLS = (["dash"], ["bash"], ["bash", "--posix"])

# What stands before `judge`, and says nothing. Behind the doubtful ones nobody can tell without all of a shell's grammar whether a quote is
# one, or whether what follows is code.
SAFE = [": 'it s';", ": \"it's\";", ": \\';", ": \\\";", ": '\"';", "x=1;", "true &&", "if true; then :; fi;", "[ 1 = 1 ] &&",
        "case x in y) ;; esac;", ": $HOME;", ": \"$HOME's\";", "{ :; };", "( : );", ": a\\\n b;", ": \"a\\\nb\";", ": '\\';", ": \"\\\\\";",
        ": \"\\\"\";", ": '#';", ": \"# it's\";", "for i in 1; do :; done;", ": >/dev/null;", "\n", ": \\# \\$\\( \\`;", ": '$(' '`';"]
DOUBTFUL = ["# it's\n", ": # a \"quote\n", ": <<EOF\nit's\nEOF\n", ": <<'EOF'\n\"\nEOF\n", ": <<-EOF\n\t'\n\tEOF\n", ": `echo \"'\"`;",
            ": $(echo \"it's\");", ": \"$(echo \"a'b\")\";", ": $((1 + 2));", ": ${x:-it};", ": $\\\n(echo \"'\");",
            ": <\\\n<EOF\n'\nEOF\n", ": \"`echo \\\\\\\"`\";", ": $(: # it's\n);", "\\\n# it's\n", "eval :;", "sh -c : x;"]
# Those that shells take in unlike ways, with the shells in which they say nothing.
OF_SOME = [(": $'it\\'s';", SHELLS[1:]), (": $[1 + 2];", SHELLS[1:]), ("[[ a = a ]] &&", SHELLS[1:]), ("(( 1 )) &&", SHELLS[1:]),
           (": \"${x:-'}\";", [SHELLS[0], SHELLS[2]])]

# Words with a blank, the same with its variable, and what they come to with a candidate.
WORDS = [("{}", '"$RG_CANDIDATE"', "%s"), ('"{}"', '"${RG_CANDIDATE}"', "%s"), ("'{}'", '"$RG_CANDIDATE"', "%s"), ("a{}b", 'a"$RG_CANDIDATE"b', "a%sb"),
         ('"a{}b"', '"a$RG_CANDIDATE"b', "a%sb"), ("'A={};B=1'", "'A='\"$RG_CANDIDATE\"';B=1'", "A=%s;B=1"), ('"{}""{}"', '"$RG_CANDIDATE$RG_CANDIDATE"', "%s%s"),
         ("\"it's\"{}", "\"it's$RG_CANDIDATE\"", "it's%s"), ("'{}'\"{}\"", '"$RG_CANDIDATE""$RG_CANDIDATE"', "%s%s"), ("\"'{}'\"", "\"'$RG_CANDIDATE'\"", "'%s'"),
         ("'\"{}\"'", "'\"'\"$RG_CANDIDATE\"'\"'", '"%s"'), ("\\'{}", "\\'\"$RG_CANDIDATE\"", "'%s"), ("a\\\n{}", "a\\\n\"$RG_CANDIDATE\"", "a%s")]
PLAIN = [("x", "x", "x"), ("\\{\\}", "\\{\\}", "{}"), ("'a b'", "'a b'", "a b"), ('"$RG_CANDIDATE"', '"$RG_CANDIDATE"', "%s")]
# Words in which no blank is one word for certain.
REFUSED = [('"a {}"', '"a $RG_CANDIDATE"', "a %s"), ("'a {}'", "'a '\"$RG_CANDIDATE\"", "a %s"), ('"\\{}"', '"\\\\$RG_CANDIDATE"', "\\%s"),
           ('"\\"{}"', '"\\"$RG_CANDIDATE"', '"%s'), ('"$(printf %s {})"', '"$(printf %s "$RG_CANDIDATE")"', "%s"),
           ('"`printf %s {}`"', '"`printf %s "$RG_CANDIDATE"`"', "%s"), ('"${none:-{}}"', '"${none:-$RG_CANDIDATE}"', "%s"),
           ("$(( {} ))", '"$RG_CANDIDATE"', "%s"), ("\"$(sh -c 'printf %s {}')\"", "\"$(sh -c 'printf %s \"$RG_CANDIDATE\"')\"", "%s")]
PIECES = ["'", '"', "`", "$(exit 9)", "$HOME", "\\", "#", "<<EOF", "EOF", ";", "&&", "|", "{}", "{good}", "*", "~", "$((1))", " ", "!", "-n", "=", "(", ")",
          "é", "$'x'", "%s", "[a]", "a", "b", "$RG_GOOD", "${x:-'}", "it's", "$", "\\'", "\\\"", "`exit 9`", "# it's"]

JUDGE = "judge() { for word; do printf '%s\\001' \"$word\"; done; printf '\\002'; }\nexport RG_CANDIDATE RG_GOOD\n"


def make_line(chance, number):
    """A line with blanks, the same with variables, what its words come to, whether it is to be refused, and the shells that have all of it.
    All doubts and all refused words take their turns."""
    before = chance.choices(SAFE, k=chance.randrange(4))
    words = chance.choices(WORDS, k=1 + chance.randrange(3)) + chance.choices(PLAIN, k=chance.randrange(3))
    doubts = [(text, SHELLS) for text in DOUBTFUL] + OF_SOME
    shells = SHELLS
    if number % 2:
        text, shells = doubts[number // 2 % len(doubts)]
        before.insert(chance.randrange(len(before) + 1), text)
    elif not number % 4:
        words.append(REFUSED[number // 4 % len(REFUSED)])
    chance.shuffle(words)
    behind = chance.choice(["", "", " # it's {}", "; : <<EOF\n'\nEOF\n", "; : `echo \"'\"`", " >&1", "; : \"$(echo \"'\")\""])
    refused = number % 2 or not number % 4 or "{}" in behind
    lines = ["".join(before) + " judge " + " ".join(word[form] for word in words) + behind for form in (0, 1)]
    lines[1] = lines[1].replace("# it's {}", "# it's")
    return lines, [word[2] for word in words], refused, shells


def make_name(chance):
    return "".join(chance.choices(PIECES, k=1 + chance.randrange(5))).strip() or "x"


def filled(runner, line):
    """The line as the shell gets it, and what raingauge said; None: it was refused."""
    ran = runner.run(["bisect", "--good", "good", "--bad", "bad", "--dry-run", "--run", line], env={"GIT_DIR": "/nonexistent"})
    if ran.returncode == 2 and ran.stderr.count("\n") == 1 and "write \"$RG_CANDIDATE\"" in ran.stderr and not ran.stdout:
        return None, ran.stderr
    words = shlex.split(ran.stdout)
    good = words[:5] == ["RG_CANDIDATE=good", "RG_GOOD=good", "RG_BUDGET=120s", "/bin/sh", "-c"] and words[6] == "RG_CANDIDATE=bad"
    return words[5] if good else "", ran.stderr


def speak(shell, tried):
    """What `judge` was called with: of each line, with each of its names, the calls, each a list of words. One process runs all of them."""
    script = JUDGE + "RG_GOOD=good\n"
    for line, names, _ in tried:
        script += "line=%s\nfor RG_CANDIDATE in %s; do eval \"$line\" </dev/null 2>/dev/null; printf '\\003'; done\n" % (
            shlex.quote(line), " ".join(map(shlex.quote, names)))
    ran = subprocess.run(shell + ["-s"], input=script, capture_output=True, text=True, check=False, timeout=900)
    return [[call.split("\001")[:-1] for call in run.split("\002")[:-1]] for run in ran.stdout.split("\003")[:-1]]


def check(runner, line_count, name_count):
    chance = random.Random(SEED)
    names = list({make_name(chance): None for _ in range(name_count)})
    problems, taken = [], 0
    tried = {tuple(shell): [] for shell in SHELLS}  # lines, names and the words wanted
    for number in range(line_count):
        lines, wanted, is_refused, shells = make_line(chance, number)
        for form, line in enumerate(lines):
            text, said = filled(runner, line)
            if (text is None) != bool(is_refused and form == 0) or (form == 1 and text != line):
                problems.append("%r: %r, %s" % (line, text, said))
            elif text is not None:
                taken += form == 0
                for shell in shells:
                    tried[tuple(shell)].append((text, names if is_refused or form == 0 else names[:5], wanted))
    pairs = 0
    for shell, rows in tried.items():
        heard = speak(list(shell), rows)
        due = [(text, name, [[word.replace("%s", name) for word in wanted]]) for text, its_names, wanted in rows for name in its_names]
        pairs += len(due)
        if len(heard) != len(due):
            problems.append("%s: %d of %d pairs" % (shell, len(heard), len(due)))
        problems += ["%s: %r with %r: %r" % (shell, text, name, calls) for (text, name, calls_due), calls in zip(due, heard) if calls != calls_due]
    if taken < line_count / 6 or pairs < line_count * name_count:
        problems.append("only %d lines were taken, and %d pairs tried" % (taken, pairs))
    return problems[:20]


def check_sample(runner):
    """dash and bash take each candidate for one word, whatever its name, or the line is refused: 48 lines and 30 names"""
    return check(runner, 48, 30)


def check_whole(runner):
    """dash and bash take each candidate for one word, whatever its name, or the line is refused: 1,050 lines and 100 names"""
    return check(runner, 1050, 100)


CHECKS = [check_sample]
THOROUGH = [check_whole]
