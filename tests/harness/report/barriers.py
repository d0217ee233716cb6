#!/usr/bin/python3
"""Whether the page of `raingauge report` has barriers to people: barriers.py RAINGAUGE.

axe-core looks for them. npm fetches it by the lock file in `axe/`, so that the test fails without a registry; without npm or
the browser it is skipped.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True

import browser
import made

AXE = pathlib.Path(__file__).resolve().parent / "axe"
RUN = "axe.run().then(r => arguments[0](r.violations.map(v => [v.id, v.nodes.length, v.nodes[0].html.slice(0, 200)])))"


def fetch(folder):
    """The script of axe-core, which npm puts into a folder; ends the test with one line if it cannot."""
    shutil.copytree(AXE, folder / "axe")
    words = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1", "--fetch-timeout=30000"]
    found = subprocess.run(words, cwd=folder / "axe", capture_output=True, text=True, check=False)
    if found.returncode:
        why = next((line for line in found.stderr.splitlines() if " code " in line), "no reason given")
        print(f"1..1\nnot ok 1 - npm fetches axe-core: {why}; it needs npm's registry, or axe-core in npm's cache")
        sys.exit(1)
    return (folder / "axe/node_modules/axe-core/axe.min.js").read_text(encoding="utf-8")


def find(shown):
    return shown.driver.execute_async_script(RUN)


def check_finder(shown, page, axe):
    """axe-core finds a picture without a text"""
    shown.open(page)
    shown.driver.execute_script(axe)
    shown.driver.execute_script("document.getElementById('main').append(document.createElement('img'))")
    found = find(shown)
    return [] if [violation[0] for violation in found] == ["image-alt"] else [found]


def check(scheme, width):
    def barriers(shown, page, axe):
        problems = []
        shown.size(width)
        shown.prefer(scheme)
        shown.open(page)
        shown.driver.execute_script(axe)
        for view in browser.VIEWS + browser.SINGLE:
            shown.go("#" + view)
            problems += [(view, violation) for violation in find(shown)]
        return problems
    barriers.__doc__ = f"axe-core finds no barrier in any view, {scheme}, {width} pixels wide"
    return barriers


def main():
    browser.skip_without_browser()
    if not shutil.which("npm"):
        print("1..0 # SKIP npm is not installed")
        return 0
    raingauge = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        axe = fetch(folder)
        page = browser.make_page(raingauge, folder, odd=True)
        shown = browser.Browser(raingauge)
        try:
            return made.run([check_finder] + [check("light", 1440), check("dark", 390)], shown, page, axe)
        finally:
            shown.driver.quit()


if __name__ == "__main__":
    sys.exit(main())
