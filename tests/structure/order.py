"""The direction of includes: the rooms of raingauge from top to bottom, and the rooms that some of them may not use. How many
floors and arrows the harness may have at most.

A room is a folder with all below it, except rooms of their own. T stands for any technique: a folder of core/techniques that is
not listed. B stands for any backend: a folder of backends.
"""
import os
import re

# From top to bottom: a file includes only files of its own room and of floors below. Rooms on one floor know nothing of
# each other.
FLOORS = [
    "tests",
    "tests/oracle tests/kernels",
    "tests/tools",
    "harness/commands",
    "harness/report",
    "harness/tables harness/compare",
    "harness/devices",
    "harness/record harness/console harness/judge",
    "core/techniques/T",
    "core/techniques/scenery",
    "core/techniques",
    "core/techniques/stages",
    "core/scene",
    "core/image",
    "backends/B kernels/build",
    "core/device",
    "backends/asked",
    "backends",
    "shaders/fixed",
    "core/base",
    "shaders",
    "kernels/T kernels/packing kernels/probe kernels/scan",
    "kernels/scenery",
    "kernels/dialect",
]

# These rooms may include nothing else, each for a reason.
FENCES = {
    # An oracle proves kernels, so it shares nothing with them, and uses only assertions.
    "tests/oracle": "tests/tools",
    "tests/kernels": "kernels/T kernels/scenery kernels/dialect",
    # A technique knows its own kernels, and never another technique.
    "core/techniques/T": "core/techniques/scenery core/techniques core/scene core/image core/device core/base "
                         "kernels/T kernels/dialect",
    # Any technique can draw a scene, so a scene knows none.
    "core/scene": "core/image core/device core/base kernels/scenery kernels/dialect",
    "core/image": "core/base",
    # A backend runs any kernel, so it knows none.
    "backends/B": "backends shaders/fixed core/base kernels/dialect",
    "core/base": "",
    # A verdict follows from numbers alone, whoever measured them.
    "harness/judge": "core/base kernels/dialect",
}


# The most floors of the harness, and the most arrows: pairs of its rooms of which the first includes the second. A new arrow is
# a decision, since whoever changes the one room has to know the other. Often a value can be passed instead, or a file moved.
MOST_FLOORS, MOST_ARROWS = 5, 18

# Names that only one folder of the harness may use; rooms above it call its functions instead.
SEAMS = {
    # An instance lives in another process, so commands use sessions.
    "harness/devices/frames": "rg_instance rg_instance_open rg_instance_close rg_frame_read rg_frame_picture "
                              "rg_frame_read_picture",
}


class Order:
    """The rooms of a tree: the room of each file, and the includes that violate FLOORS or FENCES."""

    def __init__(self, tree):
        self.tree = tree
        self.floor = {room: i for i, rooms in enumerate(FLOORS) for room in rooms.split()}
        folders = {os.path.dirname(path) for path in tree.known}
        self.techniques = {folder.split("/")[2] for folder in folders
                           if re.match("core/techniques/[^/]+$", folder) and folder not in self.floor}
        self.room = {path: self.find_room(path) for path in tree.known}

    def find_room(self, path):
        """The room of a file as FLOORS calls it, or None."""
        folder = os.path.dirname(path)
        while folder:
            parent, name = os.path.split(folder)
            if folder in self.floor:
                return folder
            if parent in ("core/techniques", "kernels") and name in self.techniques:
                return parent + "/T"
            if parent == "backends":
                return "backends/B"
            folder = parent
        return None

    @staticmethod
    def name(path):
        """The technique or backend of a path, for which T or B stands."""
        return path.split("/")[2 if path.startswith("core/") else 1]

    def why_not(self, path, target):
        """Why `path` must not include `target`, or None."""
        room, below = self.room[path], self.room[target]
        if room[-2:] == below[-2:] in ("/T", "/B") and self.name(path) != self.name(target):
            return f"a {'technique' if room.endswith('T') else 'backend'} knows nothing of another"
        if room == below:
            return None
        if self.floor[below] == self.floor[room]:
            return f"{room} and {below} know nothing of each other"
        if self.floor[below] < self.floor[room]:
            return f"{below} stands above {room}"
        if room in FENCES and below not in FENCES[room].split():
            return f"{room} includes nothing of {below}"
        return None

    def upwards(self):
        """(file, header, why) of each include against the order."""
        wrong = [(path, target, self.why_not(path, target))
                 for path, _, target in self.tree.includes if target and self.room[path] and self.room[target]]
        return [row for row in wrong if row[2]]

    @staticmethod
    def floors():
        """The number of floors on which the harness has rooms."""
        return sum(any(room.split("/")[0] == "harness" for room in rooms.split()) for rooms in FLOORS)

    def arrows(self):
        """{(room, other): (file, header)} of the rooms of the harness that include others, with an include that shows each."""
        found = {}
        for path, _, target in self.tree.includes:
            if target and path.startswith("harness/") and target.startswith("harness/") and self.room[path] != self.room[target]:
                found.setdefault((self.room[path], self.room[target]), (path, target))
        return found

    def heavy(self):
        """What makes the harness hard to grasp: too many floors, or too many arrows between its rooms."""
        floors, arrows = self.floors(), self.arrows()
        wrong = [f"the harness has {floors} floors, more than {MOST_FLOORS}"] if floors > MOST_FLOORS else []
        if len(arrows) > MOST_ARROWS:
            wrong.append(f"the harness has {len(arrows)} arrows between its rooms, more than {MOST_ARROWS}:")
            wrong += [f"    {room} -> {other}: {path} includes {target}" for (room, other), (path, target) in sorted(arrows.items())]
        return wrong

    def torn(self):
        """(file, name, folder) of each name that a file of the harness uses although it belongs to another folder."""
        return [(path, name, folder) for folder, names in SEAMS.items() for path in sorted(self.tree.known)
                if path.startswith("harness/") and not path.startswith(folder + "/")
                for name in names.split() if re.search(rf"\b{name}\b", self.tree.text[path])]

    def stale(self):
        """Missing folders that FLOORS and FENCES name, and files in no room of FLOORS."""
        used = {(self.room[path], self.room[target]) for path, _, target in self.tree.includes if target}
        wrong = [f"{path}: in no room of FLOORS" for path, room in sorted(self.room.items()) if not room]
        wrong += [f"FLOORS: {room}: no such room" for room in self.floor if room not in self.room.values()]
        return wrong + [f"FENCES: {room}: includes nothing of {below}" for room, inner in FENCES.items()
                        for below in inner.split() if (room, below) not in used]
