#!/usr/bin/env python3
"""Makes the figures of pages from the repository's stored tables.

    figures.py [--check] [TABLES [PAGE...]]

In a page the lines between `<!-- figures: TABLE[:ROW,...] ... -->` and `<!-- end of figures -->` are a table of
milliseconds a frame for the printed work: a line for each row and variant, a column for each device. ROW counts from 1;
without ROW all rows are shown. `printed` after the names adds a column with the paper's numbers. `passes: TABLE:ROW,...`
has a line for each pass and a column for each row, of whole frames on cpu. --check writes nothing, and exits 1 if a page
differs from its tables.
"""
import os
import re
import statistics
import sys

sys.dont_write_bytecode = True  # the folder stays as it is

import script

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BLOCK = re.compile(r"(<!-- (figures|passes): ([^\n]*?) -->\n)(.*?)(<!-- end of figures -->)", re.S)
MOST_TAKEN = 0.05  # of the processors, by others: RG_MOST_TAKEN
DEVICES = ["cpu", "opencl", "gl", "vulkan", "cpu:reference"]


def digits(ms):
    """Three significant digits, without an exponent."""
    return f"{ms:.3g}" if ms < 999.5 else f"{ms:.0f}"


def frame_ms(measured):
    """A cell's time, as raingauge prints it: of its undisturbed launches, or else of its samples."""
    calm = [ms for _, ms, stolen, others, _ in measured.get("launches", []) if max(stolen, others) <= MOST_TAKEN]
    return statistics.median(calm if len(calm) > 1 else measured["samples_ms"])


def line_name(table, cell):
    names = [f"{value}" if isinstance(value, str) else f"{key} {value:g}" for key, value in cell["row"].items()]
    variant = [] if cell["variant"] == "full" else [cell["variant"].replace("_", " ")]
    return ", ".join([table, *names, *variant])


def lines_of(folder, table, rows):
    """Each line's name, its printed number, and milliseconds by device; cells that were not timed have none."""
    result = script.read_record(os.path.join(folder, table + ".json"))
    lines = {}
    for cell in result["cells"]:
        if cell.get("work", "paper") != "paper" or (rows and cell["row_number"] not in rows):
            continue
        line = lines.setdefault((cell["row_number"], cell["variant"]), [line_name(table, cell), "", {}])
        if cell["published"].get("fps"):
            line[1] = digits(1000 / cell["published"]["fps"])
        measured = cell.get("measured", {})
        line[2][cell["device"]] = digits(frame_ms(measured)) if "samples_ms" in measured else cell["status"]
    missing = set(rows) - {row for row, _ in lines}
    if missing:
        raise ValueError(f"{table}: {folder} has no row {min(missing)} of it")
    return [line for _, line in sorted(lines.items(), key=lambda item: item[0][0])]


def markdown(folder, asked):
    words = asked.split()
    printed = words[-1] == "printed"
    lines = []
    for word in words[:-1] if printed else words:
        table, _, rows = word.partition(":")
        lines += lines_of(folder, table, [int(row) for row in rows.split(",")] if rows else [])
    devices = [device for device in DEVICES if any(device in line[2] for line in lines)]
    head = ["table, row"] + ["published"] * printed + devices
    out = ["", "| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"]
    for name, published, ms in lines:
        out.append("| " + " | ".join([name] + [published] * printed + [ms.get(device, "") for device in devices]) + " |")
    return "\n".join(out + ["", ""])


def passes(folder, asked):
    """Milliseconds of each pass, in their order, from the run that waits for each pass."""
    table, _, rows = asked.partition(":")
    record = script.read_record(os.path.join(folder, table + ".json"))
    cells = [cell for cell in record["cells"] if cell["device"] == "cpu" and cell["variant"] == "full" and
             cell.get("work", "paper") == "paper" and str(cell["row_number"]) in rows.split(",")]
    if len(cells) != len(rows.split(",")):
        raise ValueError(f"{table}: {folder} has not all of rows {rows} of it")
    taken = [cell["measured"]["passes_ms"] for cell in cells]
    names = list(dict.fromkeys(name for row in taken for name in row))
    out = ["", "| pass | " + " | ".join(line_name(table, cell) for cell in cells) + " |", "|---" + "|---:" * len(cells) + "|"]
    for name in names:
        out.append("| " + " | ".join([name] + [f"{row[name]:.2f}" if name in row else "" for row in taken]) + " |")
    return "\n".join(out + ["", ""])


def rewrite(folder, text):
    make = {"figures": markdown, "passes": passes}
    return BLOCK.sub(lambda block: block[1] + make[block[2]](folder, block[3]) + block[5], text)


def main():
    args = script.arguments(__doc__, "[TABLES]", "[PAGE...]", checks=True)
    folder = args.tables or os.path.join(ROOT, "results", "tables")
    ok = True
    for page in args.page or [os.path.join(ROOT, "docs", "performance.md")]:
        with open(page, encoding="utf-8") as file:
            text = file.read()
        made = rewrite(folder, text)
        if not BLOCK.search(text):
            print(f"{page}: has no figures that are made from tables", file=sys.stderr)
            ok = False
        elif made != text and args.check:
            print(f"{page}: says other figures than {folder}; run results/figures.py", file=sys.stderr)
            ok = False
        elif made != text:
            script.write(page, made)
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(script.run(main))
