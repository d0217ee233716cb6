"""Shared by the scripts of this folder: parsing arguments, and one line and exit status 2 where a file cannot be read or written."""
import argparse
import json
import os
import subprocess
import sys


def arguments(text, *names, checks=False):
    """The command line's arguments for these names, each NAME, [NAME] or [NAME...]; help is the script's docstring, whose third
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


def read_record(path):
    """The record that raingauge wrote of a table."""
    with open(path, encoding="utf-8") as file:
        try:
            record = json.load(file)
        except json.JSONDecodeError as error:
            raise ValueError(f"{path}:{error.lineno}:{error.colno}: {error.msg}; have raingauge write it anew") from error
    cells = record.get("cells") if isinstance(record, dict) else None
    if not isinstance(cells, list) or not all(isinstance(cell, dict) and {"row", "row_number", "device"} <= cell.keys() for cell in cells):
        raise ValueError(f"{path}: is no record of a table; leave it out of the folder")
    return record


def write(path, text):
    """Writes a file completely or not at all."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def run(main):
    try:
        return main()
    except OSError as error:
        line = "%s: %s" % (error.filename, error.strerror) if error.filename else error.strerror
    except ValueError as error:
        line = str(error)
    except subprocess.CalledProcessError as error:
        line = "%s ended with status %d" % (" ".join(error.cmd), error.returncode)
    print("%s: %s" % (sys.argv[0], line), file=sys.stderr)
    return 2
