"""What the scripts of this folder share: their arguments, and one line and exit status 2 where a file cannot be read or written."""
import argparse
import json
import subprocess
import sys


def arguments(text, *names, checks=False):
    """What the command line has for these names, each NAME, [NAME] or [NAME...]; help is the script's own text, whose third
    line is its usage."""
    about, _, usage, rest = text.split("\n", 3)
    parser = argparse.ArgumentParser(usage=usage.strip(), description=about + "\n" + rest,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in names:
        count = "*" if name.endswith("...]") else "?" if name.startswith("[") else None
        parser.add_argument(name.strip("[.]").lower(), metavar=name.strip("[.]"), nargs=count)
    if checks:
        parser.add_argument("--check", action="store_true")
    return parser.parse_args()


def run(main):
    try:
        return main()
    except OSError as error:
        line = "%s: %s" % (error.filename, error.strerror)
    except json.JSONDecodeError as error:
        line = "a record is no JSON: %s" % error
    except subprocess.CalledProcessError as error:
        line = "%s ended with status %d" % (" ".join(error.cmd), error.returncode)
    print("%s: %s" % (sys.argv[0], line), file=sys.stderr)
    return 2
