#!/usr/bin/env python3
"""The structure of raingauge's sources: counts it, draws it, and tells what goes against it.

    graph.py [--check | --circles | --dot rooms|folders|files | --svg] [ROOT]

    (nothing)   the counts: circles, includes upwards, unrooted includes, files and rooms of the largest folders
    --check     what is wrong, a line each; exit status 1 if anything is. What `meson test structure` runs.
    --circles   each circle with what ties its units together
    --dot       the graph as text for Graphviz: of rooms, of folders or of files
    --svg       the graph of rooms as a picture, from the top to the bottom

ROOT is another checkout, such as an older commit; this one unless given. tree.py says what counts as a use, and
order.py which way includes go.
"""
import argparse
import os
import re
import sys

sys.dont_write_bytecode = True  # the sources' folder stays unchanged

import draw
from order import Order
from rooms import LIMIT, MOST_NAMESAKES, namesakes, rooms
from tree import Tree, circles, files

HERE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def circle_lines(used):
    """A line for each circle: its units or folders, and the names or headers that show how they use each other."""
    def ties(node, group):
        return f"{node} uses " + ", ".join(f"{to} ({used[node][to]})" for to in used[node] if to in group)

    return ["circle: " + "; ".join(ties(node, group) for node in group) for group in circles(used)]


def unrooted(tree):
    """Includes that do not begin at the root of the sources."""
    return [f"{path}: #include \"{name}\": not from the root of the sources"
            for path, name, target in tree.includes if target not in (name, name + ".in")]


def absent(tree):
    """Files that the builds' descriptions list but that do not exist: a build that is seldom made would rot."""
    lines = []
    for path in ["meson.build"] + files(tree.root, re.compile(r"^meson\.build$")):
        folder = os.path.dirname(path)
        with open(os.path.join(tree.root, path), encoding="utf-8") as file:
            text = re.sub(r"#[^\n]*", "", file.read())
        names = [name for inner in re.findall(r"\bfiles\(([^()]*)\)", text) for name in re.findall(r"'([^']+)'", inner)]
        names = [name for name in names if not re.match(r"\.\w", name)]  # the ending of a name that begins with a variable
        lines += [f"{path}: {name}: is not there" for name in names if not os.path.exists(os.path.join(tree.root, folder, name))]
    return lines


def wrong(tree, order):
    """All faults of the structure, a line each."""
    lines = circle_lines(tree.uses()) + circle_lines(draw.folder_graph(tree))
    lines += [f"{path} includes {target}: {why}" for path, target, why in order.upwards()]
    lines += [f"{path} uses {name}: only {folder} may" for path, name, folder in order.torn()]
    lines += order.heavy()
    lines += unrooted(tree) + order.stale() + absent(tree)
    lines += [f"{folder}: {len(names)} rooms, more than {LIMIT}: {' '.join(names)}"
              for folder, (_, names) in sorted(rooms(tree).items()) if len(names) > LIMIT]
    lines += [f"{name}: in {len(folders)} folders of the harness, more than {MOST_NAMESAKES}: {' '.join(folders)}"
              for name, folders in sorted(namesakes(tree.root).items())]
    return lines


def print_counts(tree, order):
    """The measures of the structure."""
    groups = circles(tree.uses())
    print(f"sources            {len(tree.known)}")
    print(f"includes           {len(tree.includes)}, unrooted {len(unrooted(tree))}, upwards {len(order.upwards())}")
    print(f"circles of files   {len(groups)}, of {sum(map(len, groups))} units")
    print(f"circles of folders {len(circles(draw.folder_graph(tree)))}")
    print(f"harness            {order.floors()} floors, {len(order.arrows())} arrows")
    print(f"rooms a folder, at most {LIMIT}; the largest, with their files:")
    largest = sorted(rooms(tree).items(), key=lambda row: (-len(row[1][1]), row[0]))
    for folder, (sources, names) in largest[:8]:
        print(f"  {folder:<28} {len(names):3} {sources:4}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--circles", action="store_true")
    parser.add_argument("--dot", choices=["rooms", "folders", "files"])
    parser.add_argument("--svg", action="store_true")
    parser.add_argument("root", nargs="?", default=HERE)
    args = parser.parse_args()
    tree = Tree(args.root)
    order = Order(tree)
    if args.check:
        lines = wrong(tree, order)
        print(*lines, sep="\n")
        return 1 if lines else 0
    if args.circles:
        print(*circle_lines(tree.uses()), *circle_lines(draw.folder_graph(tree)), sep="\n")
    elif args.dot:
        graphs = {"rooms": draw.room_graph(order), "folders": draw.folder_graph(tree), "files": tree.uses()}
        print(draw.dot(graphs[args.dot]))
    elif args.svg:
        print(draw.svg(order))
    else:
        print_counts(tree, order)
    return 0


if __name__ == "__main__":
    sys.exit(main())
