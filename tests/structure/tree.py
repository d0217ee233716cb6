"""Reads from their text what the sources of raingauge include, define and use.

A unit is a header and the source of the same name beside it (`core/scene/camera.h` and `camera.c`), or either alone. Unit A uses
unit B if A includes B's header, or names a function or an object that B defines for others. Includes alone would hide that: an
umbrella header such as `backends/gl/gl.h` declares the functions of many sources. Definitions are found by their form, which
clang-format keeps: they begin at the first column, and a function's brace stands alone. This needs no build, so that any commit
can be measured.
"""
import os
import re

ROOTS = ["backends", "core", "harness", "kernels", "shaders", "tests"]
SOURCE = re.compile(r"\.(c|h|cpp|cl|glsl|vert|frag)(\.in)?$")
C_SOURCE = re.compile(r"\.(c|cpp)(\.in)?$")
HEADER = re.compile(r"\.h(\.in)?$")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include "([^"]+)"', re.M)
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|^[ \t]*#[ \t]*include[^\n]*', re.S | re.M)
OUTER = r"^(?![^;{}()=#]*?\b(?:static|typedef|extern|using)\b)[A-Za-z_][^;{}()=#]*?\b(\w+)"
FUNCTION = re.compile(OUTER + r"\([^;{}#]*\)\n\{", re.M)
OBJECT = re.compile(OUTER + r"(?:\[[^\]\n]*\])*(?: =|;)", re.M)
TAG = re.compile(r"\b(?:struct|enum|union)\s+\w+")
WORD = re.compile(r"\b[A-Za-z_]\w*\b")
PASTED = re.compile(r"\bextern (const struct \w+) (\w+_)##")


def files(root, form):
    """Paths of all files whose names have this form, relative to `root`, in order."""
    return sorted(os.path.relpath(os.path.join(folder, name), root)
                  for top in ROOTS for folder, _, names in os.walk(os.path.join(root, top))
                  for name in names if form.search(name))


def unit_of(path):
    """The unit that a file belongs to: its path without the ending."""
    return SOURCE.sub("", path)


class Tree:
    """All sources below `root`.

    known, scripts: the paths of sources, and of Python
    text, words: of each path, without comments, strings and includes; words without the names of structs
    includes: (path, text of the include, path of the file it names or None) of each include
    headers: the files that each path includes
    """

    def __init__(self, root):
        self.root = root
        self.text, self.words, self.includes, self.headers = {}, {}, [], {}
        paths = files(root, SOURCE)
        self.known = set(paths)
        self.scripts = set(files(root, re.compile(r"\.py$")))
        for path in paths:
            with open(os.path.join(root, path), encoding="utf-8") as file:
                text = file.read()
            self.text[path] = NOISE.sub(" ", text)
            self.words[path] = set(WORD.findall(TAG.sub(" ", self.text[path])))
            named = [(path, name, self.find(path, name)) for name in INCLUDE.findall(text) if "@" not in name]
            self.includes += named
            self.headers[path] = {target for _, _, target in named if target}

    def find(self, path, name):
        """The file that an include of `path` names: from the root, made by the build, or (unrooted) next to `path`."""
        beside = os.path.normpath(os.path.join(os.path.dirname(path), name))
        return next((p for p in (name, name + ".in", beside) if p in self.known), None)

    def definitions(self):
        """The unit of each name that a source defines for others; a name that several programs of the tests define has none."""
        owner = {}
        for path, text in self.text.items():
            if C_SOURCE.search(path):
                for name in FUNCTION.findall(text) + OBJECT.findall(text):
                    owner.setdefault(name, set()).add(unit_of(path))
        return {name: units.pop() for name, units in owner.items() if len(units) == 1}

    def node_of(self, path, owner):
        """The unit of a file. A header that declares other sources' definitions is a unit by itself."""
        unit = unit_of(path)
        if not HEADER.search(path):
            return unit
        return unit if {owner[word] for word in self.words[path] & owner.keys()} <= {unit} else path

    def visible(self, path):
        """The words of all headers that a file includes, directly or indirectly: names of other units that it uses are among them."""
        seen, words, todo = set(), set(), [path]
        while todo:
            headers = self.headers[todo.pop()] - seen
            seen |= headers
            todo += headers
            for header in headers:
                words |= self.words[header]
        return words

    def uses(self):
        """The units that each unit uses, each with the word or the header that shows it."""
        owner = self.definitions()
        node = {path: self.node_of(path, owner) for path in self.text}
        used = {unit: {} for unit in node.values()}
        for path, _, target in self.includes:
            if target:
                used[node[path]].setdefault(node[target], target)
        for path in (path for path in self.text if not HEADER.search(path)):
            named = self.words[path] & self.visible(path) & owner.keys()
            for word in sorted(named | self.pasted(path, owner)):
                used[node[path]].setdefault(owner[word], word)
        return {unit: {to: why for to, why in targets.items() if to != unit} for unit, targets in used.items()}

    def pasted(self, path, owner):
        """The names that a list makes by pasting: `extern const struct rg_command rg_command_##name` stands for every command."""
        named = set()
        for kind, prefix in PASTED.findall(self.text[path]):
            made = re.compile(rf"^{kind} ({prefix}\w+)", re.M)
            named.update(*(made.findall(text) for text in self.text.values()))
        return named & owner.keys()


def circles(used):
    """Groups of units that use each other, directly or indirectly: the strongly connected components, by Tarjan's algorithm."""
    index, low, stack, found = {}, {}, [], []

    def visit(unit):
        index[unit] = low[unit] = len(index)
        stack.append(unit)
        for to in used.get(unit, ()):
            if to not in index:
                visit(to)
            if to in stack:
                low[unit] = min(low[unit], low[to])
        if low[unit] == index[unit]:
            group = stack[stack.index(unit):]
            del stack[stack.index(unit):]
            if len(group) > 1:
                found.append(sorted(group))

    for unit in sorted(used):
        if unit not in index:
            visit(unit)
    return sorted(found)
