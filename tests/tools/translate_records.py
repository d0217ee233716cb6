#!/usr/bin/env python3
"""Translates what raingauge wrote before a result could be read back (until commit f042b80) into today's schema.

    translate_records.py HEADS OUT FILE...

HEADS is a folder with a result of each table as `raingauge table --json` prints it now, such as results/tables: what
a table says of itself (its technique, truth, size, note) was not written then. FILE is a table's JSON of then, or a
journal (TABLE-LENGTH.journal). Each becomes a result in OUT under its name, which `raingauge table --from OUT` prints.

    git show f042b80:results/tables/creus-5.4.json > old/creus-5.4.json
"""
import json
import os
import sys

HEAD = ("technique", "size_px", "check_frames", "timed", "variants", "truth", "quick", "note")
NAMES = ("row", "published", "row_number")
MEASURED = ("create_ms", "first_frame_ms", "api_over_wall", "frames_a_sample", "samples_ms", "pass_frames")
LATER = ("blocks=seen",)  # assignments that no truth had then: they tell works apart, and change no image


def load_heads(folder):
    heads = {}
    for name in sorted(name for name in os.listdir(folder) if name.endswith(".json")):
        with open(os.path.join(folder, name)) as file:
            head = json.load(file)
        if head["truth"]:
            head["truth"] = " ".join(word for word in head["truth"].split() if word not in LATER)
        heads[head["table"]] = head
    return heads


def number_rows(cells):
    """Rows follow each other: a cell with another row's names begins the next."""
    number, row = 0, None
    for cell in cells:
        if cell["row"] != row:
            number, row = number + 1, cell["row"]
        cell["row_number"] = number


def translate_table(old, head):
    new = dict({"interrupted": False, "resumed_rows": 0}, **old)
    for field in HEAD:
        new[field] = head[field]
    number_rows(new["cells"])
    for cell in new["cells"]:
        cell["tally"] = None  # nobody counted
        cell.get("measured", {}).setdefault("pass_frames", 2)  # as many at least; earlier ones did not say
    new["rows"] = [1, new["cells"][-1]["row_number"]]
    return new


def measured(cell, timed):
    """A journal's cell kept what was measured beside its outcome, and pairs for objects."""
    if not timed:
        return {}
    return dict({name: cell[name] for name in MEASURED}, passes_ms=dict(cell["passes"]))


def translate_cell(cell, names, error, head):
    new = dict(names, status=cell["status"], tally=None, counters=dict(cell["counters"]), facts=dict(cell["facts"]))
    if head["truth"]:
        new["error"] = error if error["status"] == "ok" else {"status": error["status"], "detail": error["detail"]}
    if cell["status"] == "ok":
        new["measured"] = measured(cell, head["timed"])
    else:
        new["detail"] = cell["detail"]
    return new


def names_of(head, row, variant):
    """What a cell of a row and variant is called, from a result that has the row."""
    for cell in head["cells"]:
        if cell["row_number"] == row + 1 and cell["variant"] == variant:
            return {name: cell[name] for name in NAMES}
    sys.exit("no result in HEADS has row %d of %s" % (row + 1, head["table"]))


def translate_journal(old, heads):
    key = old["key"]
    head = heads[key["table"]]
    devices = [device["name"] for device in key["passport"]["devices"]]
    first, last = key["rows"]
    cells = []
    for row in sorted(map(int, old["rows"])):
        entry = old["rows"][str(row)]
        for i, cell in enumerate(entry["cells"]):
            v, d = divmod(i, len(devices))
            settings = key["settings"][(row - first) * len(head["variants"]) + v]
            names = names_of(head, row, head["variants"][v])
            names.update(device=devices[d], variant=head["variants"][v], set=settings)
            cells.append(translate_cell(cell, names, entry["errors"][v], head))
    new = {field: head[field] for field in HEAD + ("hardware",)}
    new.update(format=1, table=key["table"], length=key["length"], resumed_rows=0, rows=[first + 1, last + 1],
               interrupted=len(old["rows"]) <= last - first, passport=key["passport"], missing=[], cells=cells)
    return new


def main():
    heads, out = load_heads(sys.argv[1]), sys.argv[2]
    os.makedirs(out, exist_ok=True)
    for path in sys.argv[3:]:
        with open(path) as file:
            old = json.load(file)
        new = translate_journal(old, heads) if "key" in old else translate_table(old, heads[old["table"]])
        new["passport"]["raingauge"].setdefault("program", "unknown")
        with open(os.path.join(out, os.path.basename(path)), "w") as file:
            json.dump(new, file)


if __name__ == "__main__":
    main()
