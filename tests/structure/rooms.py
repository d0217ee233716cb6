"""The number of rooms in a folder: its units and folders. In how many folders of the harness files have one name."""
import os
import re

import tree as sources

LIMIT = 12
# A name that stands in many folders tells too little: whoever reads it in a message or a list cannot know which file is meant.
MOST_NAMESAKES = 2


def unit(name):
    """A header, its source and the struct of its parameters are one unit, and so are a template and its products."""
    return re.sub(r"_params$|_tmpl$", "", name.split(".")[0])


def rooms(tree):
    """For each folder: its files, and the units and folders in it. Build lists are no rooms."""
    files, inside = {}, {}
    for path in tree.known | tree.scripts:
        folder, name = os.path.split(path)
        files.setdefault(folder, []).append(name)
        inside.setdefault(folder, set()).add(unit(name))
        while os.path.dirname(folder):
            folder, name = os.path.split(folder)
            inside.setdefault(folder, set()).add(name + "/")
    return {folder: (len(files.get(folder, [])), sorted(names)) for folder, names in inside.items()}


def namesakes(root):
    """{name: folders} of files of the harness, without their endings, that stand in too many folders. Every folder has a meson.build."""
    found = {}
    for path in sources.files(root, re.compile(r"^(?!meson\.build$)")):
        folder, name = os.path.split(path)
        if folder.startswith("harness"):
            found.setdefault(name.split(".")[0], set()).add(folder)
    return {name: sorted(folders) for name, folders in found.items() if len(folders) > MOST_NAMESAKES}
