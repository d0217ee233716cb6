#!/usr/bin/python3
"""Questions that the page of `raingauge report` answers to each of its readers: questions.py RAINGAUGE [--list].

Whoever knows neither code nor docs should answer each within a minute. A question has the view where its answer stands, the
element, and what that says: the answer stands within three screens, on a phone within six. --list prints the questions alone,
to be put to people. The browser is that of browser.py; without it the test is skipped.
"""
import collections
import pathlib
import re
import sys
import tempfile
import time

sys.dont_write_bytecode = True

import browser
import made

Question = collections.namedtuple("Question", "asked view element says")

STRANGER = [
    Question("What does raingauge do?", "overview", ".hero .lead", r"runs the rain of published papers on graphics drivers, checks .* the same picture, and measures how fast"),
    Question("How many of the claims that papers make hold?", "overview", ".total:nth-child(1)", r"^Claims\s+\d+ of \d+ holds?\b"),
    Question("Are all devices well? Which one is not?", "overview", ".total:nth-child(2)", r"1 of 2 are well[\s\S]*Not: new\."),
    Question("Do the devices draw the same pictures?", "overview", ".total:nth-child(3)", r"[\d,]+ of [\d,]+ are (identical|as the reference's)"),
    Question("How would I make such a page?", "overview", "main > section:has(.command)", r"Make this yourself[\s\S]*make tables"),
]
RESEARCHER = [
    Question("Which claims of a paper hold, and on which device?", "claims?paper=creus", ".matrix", r"Creus 2010[\s\S]*(holds|one launch|open|does not hold)"),
    Question("By which test does this claim hold?", "claim?id=creus-5.4%2F20-meters-come-as-a-good-trade-off", ".head", r"It holds where .+\. It is about rows \d+ to \d+"),
    Question("What would decide this claim?", "claim?id=creus-5.6%2Flights-rapidly-decrease-performance", "section:has(.command)", r"What would decide it[\s\S]*raingauge (claims|table) creus-5\.6"),
    Question("By how much do rates fall along the axis, in print and here?", "table?id=creus-5.3", ".story", r"In print the first row is [\d.]+ times as fast as the last\. Here the first row is [\d.]+ times"),
    Question("What does print say of a row, and what was measured?", "table?id=creus-5.4", ".beside tbody tr:first-child", r"^5\s[\s\S]*\d x print"),
]
ENGINEER = [
    Question("What are A and B?", "gate", ".head ~ section", r"A: vulkan\s+Mesa 22[\s\S]*B: new\s+Mesa 25"),
    Question("What got slower, by how much, and how sure is that?", "gate?q=torus", ".cases tbody tr:first-child", r"raster/torus\.new[\s\S]*regressed[\s\S]*1\.071\s+1\.060 to 1\.082"),
    Question("Which pixel differs most, and what has each side there?", "gate?case=flow%2Fpane.new", ".worst", r"at x 40, y 20: A has 160, 60, 90, B has 160, 60, 200"),
    Question("Which stage differs first?", "gate?case=flow%2Fpane.new", ".case > pre", r"stage flow_blur"),
    Question("Which linear values has each side there?", "gate?case=flow%2Fpane.new", ".texels tbody tr:first-child", r"^x \d+, y \d+\s+[\d.]+\s+[\d.]+"),
]
OWNER = [
    Question("Does the gate pass?", "ci", ".head .lead", r"4 cases of 205 fail"),
    Question("What is worst?", "ci", ".cases tbody tr:first-child", r"of tomorrow[\s\S]*vanished"),
    Question("Which case ended without a decision?", "ci?ending=inconclusive", ".cases tbody tr", r"drops/pane\.new"),
    Question("Is a regression new in this run?", "ci?ending=regressed", ".last tbody tr:first-child", r"raster/torus\.new[\s\S]*regressed"),
    Question("What took longest?", "ci?ending=regressed", ".took tbody tr:first-child", r"[\d.]+ s\s+\d+ %"),
]
READERS = {"a stranger": STRANGER, "a researcher": RESEARCHER, "a driver engineer": ENGINEER, "an owner of CI": OWNER}

# Width, height, and the screens within which an answer stands.
SCREENS = ((1440, 900, 3), (390, 844, 6))
FIND = """const found = document.querySelector(arguments[0]);
return found ? [found.innerText, found.getBoundingClientRect().top + scrollY] : null"""


def problem(shown, page, question, width, most):
    shown.open(page, "#" + question.view)
    time.sleep(0.3)
    found = shown.driver.execute_script(FIND, question.element)
    if not found:
        return f"{width} pixels: {question.asked} There is no {question.element}"
    text, top = found
    if not re.search(question.says, text):
        return f"{width} pixels: {question.asked} {text[:200]}"
    return f"{width} pixels: {question.asked} It stands at {top:.0f}" if top > most else None


def check(reader, questions):
    def answers(shown, page):
        problems = []
        for width, height, screens in SCREENS:
            shown.size(width, height)
            problems += [problem(shown, page, question, width, screens * height) for question in questions]
        return [text for text in problems if text]
    answers.__doc__ = f"the page answers {len(questions)} questions of {reader}"
    return answers


def main():
    if "--list" in sys.argv:
        for reader, questions in READERS.items():
            print(f"{reader}:", *(f"  {question.asked}" for question in questions), sep="\n")
        return 0
    browser.skip_without_browser()
    raingauge = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        page = browser.make_page(raingauge, pathlib.Path(folder))
        shown = browser.Browser(raingauge)
        try:
            return made.run([check(*both) for both in READERS.items()], shown, page)
        finally:
            shown.driver.quit()


if __name__ == "__main__":
    sys.exit(main())
