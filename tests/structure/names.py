#!/usr/bin/env python3
"""Finds names of missing files and folders in pages and comments: names.py [ROOT].

Prints one line each, and exits 1 if there are any. It checks:

    pages      links; paths with a folder; between backquotes also folders and bare names, such as `rain_space.h`
    comments   paths with a folder, and bare names of sources

A path counts from the root. One without its first folders, and a bare name, must fit one file alone, or one below a folder that
the same section of the page names; in a comment, one beside it or one that the file includes. `*`, `[ch]` and words in capitals
stand for any text. Names below `build`, of system headers, of a user's files, of files that the harness writes (`"run.c"` in a
source of it) and web addresses are not checked.
"""
import fnmatch
import os
import re
import sys

HERE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SKIPPED = re.compile(r"^(\.git|__pycache__)$")
SOURCE = r"(?:c|h|cpp|cl|glsl|vert|frag|py|build)"
OURS = r"(?:c|h|cpp|cl|glsl|vert|frag|py|build|md|csv|svg|yml)"
NAME = r"[\w*.][\w.*\[\]+-]*"
PATH = re.compile(rf"(?<![\w/.:~$<-])(?:{NAME}/)+(?:{NAME}\.{OURS}(?![\w/-])(?:\.in)?)?(?![\w/])")
BARE = re.compile(rf"(?<![\w/.:~$<-])[\w*\[\]-]+\.{SOURCE}(?:\.in)?(?![\w/.-]\w)")
QUOTED = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
SYSTEM = re.compile(r"#\s*include <([^>]+)>")
INCLUDE = re.compile(r'#\s*include "([^"]+)"')
WRITTEN = re.compile(rf'(?<!include )"([\w-]+\.{SOURCE})"')
COMMENTS = {
    "c": re.compile(r"//[^\n]*|/\*.*?\*/", re.S),
    "#": re.compile(r"#[^\n]*"),
    "py": re.compile(r'#[^\n]*|""".*?"""', re.S),
}


def find_files(root):
    """All files below `root`, as paths from there."""
    found = []
    for folder, inner, names in os.walk(root):
        built = folder == root
        inner[:] = [name for name in inner if not SKIPPED.match(name) and not (built and name.startswith("build"))]
        found += [os.path.relpath(os.path.join(folder, name), root) for name in names]
    return found


class Names:
    """The files of a tree, and the pages and comments that name them."""

    def __init__(self, root):
        self.root = root
        self.files = find_files(root)
        self.folders = {os.path.dirname(path) for path in self.files}
        for folder in list(self.folders):
            while folder:
                folder = os.path.dirname(folder)
                self.folders.add(folder)
        sources = [path for path in self.files if path.endswith((".c", ".h", ".cpp"))]
        self.system = {name for path in sources for name in SYSTEM.findall(self.read(path))}
        self.system |= {name.split("/")[-1] for name in self.system}
        own = [path for path in sources if path.startswith("harness/")]
        self.written = {name for path in own for name in WRITTEN.findall(self.read(path))}

    def read(self, path):
        with open(os.path.join(self.root, path), encoding="utf-8", errors="replace") as file:
            return file.read()

    def fits(self, name):
        """The files whose paths end in this name; for a name that ends in a slash, the folders."""
        pattern = re.sub(r"(?<![A-Za-z])[A-Z][A-Z_]*(?![a-z])", "*", name.rstrip("/"))
        among = self.folders if name.endswith("/") else self.files
        return [path for path in among if fnmatch.fnmatchcase("/" + path, "*/" + pattern)]

    def is_there(self, name, near):
        """Whether a name is unambiguous, or fits a nearby file or one below a nearby folder."""
        if name.startswith(("build", "/")) or name in self.system | self.written:
            return True
        found = self.fits(name)
        if re.search(r"[*[]|(?<![A-Za-z])[A-Z][A-Z_]*(?![a-z])", name):
            return bool(found)
        if len(found) == 1 or name in found or name.rstrip("/") in found:
            return True
        return any((path + "/").startswith(place + "/") for path in found for place in near)

    def near(self, text):
        """The folders that a text names, directly or by a file in them."""
        words = [word for pair in (PATH.findall(text), QUOTED.findall(text)) for word in pair]
        places = {place for word in words for place in (word.rstrip("/"), os.path.dirname(word))}
        return places & self.folders - {""}

    def stale_in_page(self, path):
        """Names in a page that fit nothing."""
        wrong = []
        for section in re.split(r"^#+ ", self.read(path), flags=re.M):
            section = re.sub(r"https?://\S+|#include .*", " ", section)
            near = self.near(section)
            names = set(PATH.findall(section))
            for quoted in QUOTED.findall(section):
                names |= set(BARE.findall(quoted))
            wrong += [name for name in names if not self.is_there(name, near)]
            wrong += [link for link in LINK.findall(section)
                      if not os.path.exists(os.path.join(self.root, os.path.dirname(path), link))]
        return wrong

    def stale_in_comments(self, path):
        """Names in a source's comments that fit nothing."""
        is_c = re.search(r"\.(c|h|cpp|cl|glsl|vert|frag)(\.in)?$", path)
        form = COMMENTS["c" if is_c else "py" if path.endswith(".py") else "#"]
        text = "\n".join(form.findall(self.read(path)))
        text = re.sub(r"https?://\S+", " ", text)
        near = self.near(text) | {os.path.dirname(path)} | set(INCLUDE.findall(self.read(path)))
        return [name for name in set(PATH.findall(text)) | set(BARE.findall(text)) if not self.is_there(name, near)]

    def stale(self):
        """(file, name) of all names that fit nothing."""
        wrong = []
        for path in sorted(self.files):
            if path.endswith(".md") and not path.startswith("results/"):
                wrong += [(path, name) for name in self.stale_in_page(path)]
            elif re.search(r"\.(c|h|cpp|cl|glsl|vert|frag|py|in|build)$|^Makefile$", path):
                wrong += [(path, name) for name in self.stale_in_comments(path)]
        return sorted(wrong)


def main():
    wrong = Names(sys.argv[1] if len(sys.argv) > 1 else HERE).stale()
    for path, name in wrong:
        print(f"{path}: {name}: not there, or not one alone; name it from the root, or its folder in the same section")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
