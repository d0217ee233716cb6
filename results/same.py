#!/usr/bin/env python3
"""Tells whether newly measured tables have the stored tables' counts and errors: only times may differ.

    same.py FROM TO

FROM holds records written by `raingauge table -o FROM`, of all rows or of some, and TO the stored ones. Everything in a cell
of FROM is compared except times: its settings, its outcome, its counts, and its picture's error, where the table has errors;
records say nothing else about pictures. Prints a line for each table; the exit status is 1 where one differs or has a cell
that TO lacks.
"""
import json
import os
import sys

sys.dont_write_bytecode = True  # the folder stays as it is

import script

TIMES = ("measured", "checksum")


def cells_of(path):
    """Cells by their identification, without their times."""
    cells = {}
    for cell in script.read_record(path)["cells"]:
        name = ", ".join(["row %d" % cell["row_number"], *(cell[key] for key in ("variant", "work", "device") if key in cell)])
        cells[name] = {key: value for key, value in cell.items() if key not in TIMES}
    return cells


def values_of(cell):
    """A cell's values by their full names."""
    values = {}
    for key, value in cell.items():
        values.update({f"{key}.{name}": one for name, one in value.items()} if isinstance(value, dict) else {key: value})
    return values


def first_difference(cells, kept):
    for name, cell in cells.items():
        if name not in kept:
            return f"{name}: is not kept"
        now, then = values_of(cell), values_of(kept[name])
        for key in sorted(now.keys() | then.keys()):
            if now.get(key) != then.get(key):
                return f"{name}: {key} is {json.dumps(now.get(key))}, and {json.dumps(then.get(key))} was kept"
    return ""


def main():
    args = script.arguments(__doc__, "FROM", "TO")
    folder, differ = getattr(args, "from"), False
    names = sorted(name for name in os.listdir(folder) if name.endswith(".json"))
    if not names:
        raise ValueError(f"{folder}: holds no record of a table; name a folder that raingauge table -o wrote")
    for name in names:
        cells = cells_of(os.path.join(folder, name))
        if not cells:
            raise ValueError(f"{os.path.join(folder, name)}: holds no cell, so that nothing is compared; measure the table anew")
        difference = first_difference(cells, cells_of(os.path.join(args.to, name)))
        print(f"{name[:-len('.json')]}: {difference or f'{len(cells)} cells count the same'}")
        differ |= bool(difference)
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(script.run(main))
