"""The number of rooms in a folder: its units and folders."""
import os
import re

LIMIT = 12


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
