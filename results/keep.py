#!/usr/bin/env python3
"""Moves the tables that `raingauge table -o FROM` wrote into the repository's folder of stored tables.

    keep.py FROM TO

For each table TO gets ID.md, ID.csv and ID.json, a record with a line for each cell. The record omits values that
`raingauge table --from` derives; from it, raingauge prints the other two files byte for byte (docs/records.md). LaTeX is
not stored, since it is printed from the record, too.
"""
import json
import os
import sys

sys.dont_write_bytecode = True  # the folder stays as it is

import script

# Derived from samples and passes. Numbers beside published ones are derived from the facts of the same names.
DERIVED = ("fps", "ms", "ms_low", "ms_high", "passes_share", "noise", "disturbed")


def compact(record):
    """The text of a record: a line for each field of its head, then a line for each cell."""
    for cell in record["cells"]:
        if "measured" in cell:
            derived = {*DERIVED, *cell["facts"]}
            cell["measured"] = {name: value for name, value in cell["measured"].items() if name not in derived}
    cells = ",\n".join(json.dumps(cell, ensure_ascii=False, separators=(",", ":")) for cell in record["cells"])
    head = [json.dumps(name) + ": " + json.dumps(value, ensure_ascii=False) for name, value in record.items()
            if name not in ("cells", "shapes")]
    return "{\n" + ",\n".join(head + ['"cells": [\n' + cells + "\n]"]) + "\n}\n"


def keep(folder, table, to):
    texts = {"json": compact(script.read_record(os.path.join(folder, table + ".json")))}
    for form in ("md", "csv"):
        with open(os.path.join(folder, table + "." + form), encoding="utf-8", newline="") as file:
            texts[form] = file.read()
    for form, text in texts.items():
        script.write(os.path.join(to, table + "." + form), text)
    for form in ("md", "csv", "json", "tex"):
        os.remove(os.path.join(folder, table + "." + form))


def main():
    args = script.arguments(__doc__, "FROM", "TO")
    tables = sorted(name[:-len(".json")] for name in os.listdir(getattr(args, "from")) if name.endswith(".json"))
    os.makedirs(args.to, exist_ok=True)
    for table in tables:
        keep(getattr(args, "from"), table, args.to)


if __name__ == "__main__":
    sys.exit(script.run(main))
