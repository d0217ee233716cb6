"""The graphs of raingauge's sources as text for Graphviz, and that of its rooms as SVG."""
import os
from html import escape

# Columns from left to right; shaders are drawn among the kernels.
COLUMNS = ["harness", "core", "backends", "kernels"]
# Pixels: the heights of a box and a floor, then widths.
BOX, FLOOR, LETTER, PAD, GAP = 26, 76, 7.3, 10, 16

HEAD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {across} {down}" font-family="monospace"
font-size="12">
<style>rect {{ fill: #eef4fa; stroke: #246 }} path {{ fill: none; stroke: #68a; marker-end: url(#tip) }}
text {{ text-anchor: middle }} #tip path {{ fill: #68a; marker-end: none }}
#page {{ fill: white; stroke: none }}</style>
<defs><marker id="tip" markerWidth="8" markerHeight="6" refX="8" refY="3" orient="auto"><path d="M0,0 L8,3 L0,6 z"/>
</marker></defs><rect id="page" width="100%" height="100%"/>"""


def gather(tree, of):
    """Includes, with each path replaced by `of` of it, and a file that shows each: {from: {to: file}}."""
    graph = {}
    for path, _, target in tree.includes:
        if target and of(path) and of(target):
            targets = graph.setdefault(of(path), {})
            graph.setdefault(of(target), {})
            if of(path) != of(target):
                targets.setdefault(of(target), path)
    return graph


def folder_graph(tree):
    """Includes between folders."""
    return gather(tree, os.path.dirname)


def room_graph(order):
    """Includes between rooms, without the tests', which may include anything."""
    return gather(order.tree, lambda path: order.room[path] if not path.startswith("tests/") else None)


def dot(graph):
    """A graph as text for Graphviz."""
    lines = [f'  "{node}";' for node in sorted(graph)]
    lines += [f'  "{node}" -> "{to}";' for node in sorted(graph) for to in sorted(graph[node])]
    return "\n".join(["digraph raingauge {", "  node [shape=box];", *lines, "}"])


def reach(graph, node):
    """All that `node` includes, directly or indirectly."""
    seen, todo = set(), [node]
    while todo:
        new = set(graph.get(todo.pop(), ())) - seen
        seen |= new
        todo += new
    return seen


def reduced(graph):
    """A graph without the includes that others already imply."""
    return {node: [to for to in targets if not any(to in reach(graph, other) for other in targets if other != to)]
            for node, targets in graph.items()}


def heights(graph):
    """The number of floors below each room."""
    found = {}

    def height(room):
        if room not in found:
            found[room] = max((height(to) + 1 for to in graph[room]), default=0)
        return found[room]

    return {room: height(room) for room in graph}


def rows(graph):
    """The rooms of each column by their height."""
    found = [{} for _ in COLUMNS]
    for room, height in sorted(heights(graph).items()):
        top = room.split("/")[0].replace("shaders", "kernels")
        found[COLUMNS.index(top)].setdefault(height, []).append(room)
    return found


def width(room):
    """The width of a room's box."""
    return len(room) * LETTER + 2 * PAD


def places(graph):
    """The place of each room's box, (left, top) by room, and the size of the whole.

    Floors of a column are shifted in turn, so that lines pass between boxes.
    """
    columns, found, left = rows(graph), {}, GAP
    top_floor = max(height for column in columns for height in column)
    for column in columns:
        across = max(sum(map(width, rooms)) + GAP * len(rooms) for rooms in column.values())
        for turn, (height, rooms) in enumerate(sorted(column.items())):
            free = across - sum(map(width, rooms)) - GAP * len(rooms)
            x = left + free / 2 + (0.5 if turn % 2 else -0.5) * min(free, 5 * GAP)
            for room in rooms:
                found[room] = (x, GAP + (top_floor - height) * FLOOR)
                x += width(room) + GAP
        left += across + 3 * GAP
    return found, left, (top_floor + 1) * FLOOR


def curve(start, end):
    """A line from below one box to the top of another."""
    bend = (end[1] - start[1]) * 0.45
    points = [start, (start[0], start[1] + bend), (end[0], end[1] - bend), end]
    moves = " ".join(f"{x:.0f},{y:.0f}" for x, y in points)
    return f'<path d="M{moves.replace(" ", " C", 1)}"/>'


def curves(graph, box):
    """The lines of a graph; those that leave or reach a box are side by side."""
    pairs = [(room, to) for room in graph for to in graph[room]]
    lines = []
    for room, to in pairs:
        out = sorted((other for other in graph[room]), key=lambda other: box[other][0])
        into = sorted((other for other in graph if to in graph[other]), key=lambda other: box[other][0])
        start = box[room][0] + width(room) * (out.index(to) + 1) / (len(out) + 1), box[room][1] + BOX
        end = box[to][0] + width(to) * (into.index(room) + 1) / (len(into) + 1), box[to][1]
        lines.append(curve(start, end))
    return lines


def svg(order):
    """The rooms, floor by floor, with the includes of each, without those that other lines imply or that go upwards."""
    upwards = {(order.room[path], order.room[target]) for path, target, _ in order.upwards()}
    graph = {room: {to for to in targets if (room, to) not in upwards} for room, targets in room_graph(order).items()}
    graph = reduced(graph)
    box, across, down = places(graph)
    boxes = [f'<rect x="{x:.0f}" y="{y:.0f}" width="{width(room):.0f}" height="{BOX}" rx="4"/>'
             f'<text x="{x + width(room) / 2:.0f}" y="{y + 17:.0f}">{escape(room)}</text>'
             for room, (x, y) in box.items()]
    return "\n".join([HEAD.format(across=round(across), down=down), *curves(graph, box), *boxes, "</svg>"])
