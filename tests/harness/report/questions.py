#!/usr/bin/python3
"""Questions that the page of `raingauge report` answers to each of its readers: questions.py RAINGAUGE [--list].

Whoever knows neither code nor docs should answer each within a minute. A question has the view where its answer stands, the
element, and what that says: the answer stands within three screens of where the view opens, on a phone within six. --list prints the questions alone,
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
    Question("How many of the claims that papers make hold?", "overview", ".total:nth-child(1)", r"^Claims\s+\d+ holds?, \d+ do(es)? not\s+of \d+ claims[\s\S]*A launch is a new process[\s\S]*Open: not measured"),
    Question("Are all devices well? Which one is not?", "overview", ".total:nth-child(2)", r"1\s+of 2 devices is well[\s\S]*Well: gl \(software on the CPU\)\. Not well: new \(crash, software on the CPU\)\. 4 others were not examined"),
    Question("Do the devices draw the same pictures?", "overview", ".total:nth-child(3)", r"[\d,]+\s+of [\d,]+ pictures that were compared are identical[\s\S]*4 differ: flow/pane\.new, gl and vulkan, gl and new, vulkan and new\."),
    Question("What differs between the pictures of two devices?", "checks", "main > section:nth-of-type(2)", r"0 of 3 pairs are identical to the last bit of linear light[\s\S]*A code is 1/255[\s\S]*identical \(T0\): [\s\S]*up to rounding \(T1\): equal up to rounding[\s\S]*the same scene \(T2\): [\s\S]*differs: [\s\S]*the same codes"),
    Question("Which stage differs first between two devices?", "checks", "main > section:nth-of-type(2)", r"between gl and new: flow_blur in frame 1: blurred\[1204\]: gl has 1065353216 \(0x3f800000\), new has 1065353217"),
    Question("Which device is a GPU, and which is software?", "devices", "main > section:last-of-type", r"cpu\s+software on the CPU[\s\S]*vulkan\s+software on the CPU"),
    Question("How would I make such a page?", "overview?to=make", "section#make", r"Make this yourself\s+The program is in the Git repository raingauge[\s\S]*make tables[\s\S]*doctor --json[\s\S]*gate vulkan"),
]
RESEARCHER = [
    Question("How many claims of a paper hold?", "claims?paper=creus", "main > .lead", r"2 of 18 claims of Creus 2010 hold on all devices; "),
    Question("What does a sign of the table of claims mean?", "claims?paper=creus", ".key", r"A launch is a new process[\s\S]*one launch fits: figures of one launch fit"),
    Question("Which claims of a paper hold, and on which device?", "claims?paper=creus", ".matrix", r"Creus 2010[\s\S]*(holds|one launch|open|does not hold)"),
    Question("By which test does this claim hold?", "claim?id=creus-5.4%2F20-meters-come-as-a-good-trade-off", ".head", r"It holds where up to row 4 \(culling radius 20 m\) the error .+ 3 times .+\. The paper gives no number for this, so the bound is our choice\.\s+It is about the rows from row 1 \(culling radius 5 m\) to row 8"),
    Question("What was found, and what would it take?", "claim?id=creus-5.4%2F20-meters-come-as-a-good-trade-off", "main > section tbody tr", r"does not hold\s+the error falls from [\d.]+ to .+ times as far, needed: 3"),
    Question("Is more needed to decide it?", "claim?id=creus-5.4%2F20-meters-come-as-a-good-trade-off", "section:has(.command)", r"What it takes\s+It is decided on every device by pictures: the error of a picture is the same in every launch, so that it needs no launches\."),
    Question("Why does the plot have one line for all devices?", "claim?id=creus-5.4%2F20-meters-come-as-a-good-trade-off", "section:has(.plot)", r"One line serves cpu, .+ and opencl: they draw the same pictures"),
    Question("What would decide this claim?", "claim?id=creus-5.6%2Flights-rapidly-decrease-performance", "section:has(.command)", r"What would decide it\s+Launches: new processes.+ after 12 on a device and the last after 96; .+ from 24 to 192\.[\s\S]*raingauge (claims|table) creus-5\.6"),
    Question("By how much do rates fall along the axis, in print and here?", "table?id=creus-5.3", ".story", r"Camera 1, local height from 5 m to 230 m: in print the first row is [\d.]+ times as fast as the last, here [\d.]+ times \(\S+\) to"),
    Question("And for the second camera?", "table?id=creus-5.3", ".story + .story", r"Camera 2, local height from 5 m to 230 m: in print"),
    Question("How many particles has print, and how many are drawn here?", "table?id=creus-5.3", ".beside tbody tr", r"430,116\s+here 401,515"),
    Question("On which machines do these rates stand?", "table?id=creus-5.4", ".machines", r"Print: .+GTX 280\. Here: .+ cores?.+\. Software on the CPU: cpu, .+ and opencl\."),
    Question("What does print say of a row, and what was measured?", "table?id=creus-5.4", ".beside tbody tr:first-child", r"^5\s[\s\S]*\d x print"),
]
ENGINEER = [
    Question("For whom is this view?", "gate", ".head", r"For driver engineers"),
    Question("What are A and B?", "gate", ".head ~ section", r"A and B[\s\S]*A: vulkan\s+llvmpipe Mesa 22.+\s+software on the CPU[\s\S]*B: new\s+llvmpipe Mesa 25[\s\S]*not recorded"),
    Question("What got slower, by how much, and how sure is that?", "gate?q=torus", ".cases tbody tr:first-child", r"raster/torus\.new[\s\S]*regressed[\s\S]*1\.071\s+1\.060 to 1\.082"),
    Question("How long does a frame take on A, and on B?", "gate?q=torus", ".cases tbody tr:first-child", r"A 3\.73 ms, B 4\.00 ms[\s\S]*\s3\.73\s+4\.00\s"),
    Question("Which cases does the chart leave out?", "gate", ".untimed", r"Of 204 cases 2 have no times, and are not in this chart: 1 crash and 1 differs"),
    Question("Which pixel differs most, and what has each side there?", "gate?case=flow%2Fpane.new", ".worst", r"at x 40, y 20: A has 160, 60, 90, B has 160, 60, 200"),
    Question("How far does a change not matter?", "gate", ".plot > .note", r"with 99 % confidence\. The grey band is the margin of 5 %"),
    Question("Which stage differs first?", "gate?case=flow%2Fpane.new", ".case > .facts", r"First stage that differs\s+flow_blur in frame 1: blurred\[1204\]: A has 1065353216 \(0x3f800000\), B has 1065353217 \(0x3f800001\), off by 1"),
    Question("What is the T2 that would hold?", "gate?case=flow%2Fpane.new", ".case", r"T2 would hold\s+T0, T1 and T2 are tiers, which say how closely two pictures agree[\s\S]*T2 in the same scene, drawn in another way"),
    Question("Which linear values has each side there?", "gate?case=flow%2Fpane.new", ".texels tbody", r"^x 40, y 20\s+A(\s+[\d.]+){3}[\s\S]*B(\s+[\d.]+){3}[\s\S]*B − A\s+0\s+0\s+0\.47"),
]
OWNER = [
    Question("Does the gate pass?", "overview", ".total:nth-child(4)", r"Gate\s+fails\s+3 of 204 cases fail"),
    Question("Which cases fail it, and does an inconclusive one?", "ci", ".head", r"The gate fails: 3 of 204 cases fail \(1 crash, 1 differs, 1 regressed\)\. 1 is inconclusive, 200 pass\."),
    Question("What does my job do if a case is inconclusive?", "ci", ".head", r"For owners of CI[\s\S]*Exit status: 1 if any case fails \(71 if raingauge itself lacked something\); 3, not 0, if none fails and one is inconclusive"),
    Question("What is worst?", "ci", ".cases tbody tr:first-child", r"cartoon/storm\.new\s+crash"),
    Question("Which case ended without a decision, and why?", "ci?ending=inconclusive", ".cases tbody tr", r"drops/pane\.new[\s\S]*the interval allows both"),
    Question("How many failures are new in this run?", "ci", ".news", r"Since the run before \(gate-1\.json\): 2 failures are new, 1 is as before"),
    Question("Is a regression new in this run?", "ci?ending=regressed", ".cases tbody tr", r"raster/torus\.new\s+regressed\s+new[\s\S]*\spass\s"),
    Question("How did it end in earlier runs?", "ci?ending=regressed", "section#runs", r"3 runs in the order of their files, from gate-0\.json to gate-2\.json[\s\S]*raster/torus\.new[\s\S]*pass[\s\S]*regressed"),
    Question("What took longest?", "ci", ".longest", r"All 204 cases took 11 min; drops/pane\.new took longest, 96 s or 15 % of that\. Where the seconds went"),
    Question("Which part of all seconds did it take?", "ci?ending=regressed", ".took tbody tr:first-child", r"9\.75 s\s+\d+ %"),
    Question("Does that table have all cases?", "ci?ending=regressed", "#seconds", r"drops/pane\.new took longest, 96 s or 15 % of that\. The table shows only the case chosen above, which took 9\.75 s\."),
    Question("What do the endings mean?", "ci?ending=regressed", ".endings", r"regressed: B is slower, by more than the margin allows"),
    Question("What changed against the earlier records?", "changes", "main > section", r"Times[\s\S]*slower"),
    Question("Which earlier records are that?", "changes", ".facts", r"Then\s+old/gate\.json and old/stuppacher-2\.json, by raingauge of commits? [0-9a-f]{12}"),
    Question("Is that the run before of the gate in CI?", "changes", "main > section:nth-of-type(3)", r"gate-2\.json is compared with old/gate\.json\. The views of the gate compare it with gate-1\.json, the run before\.[\s\S]*raster/torus\.new\s+pass\s+regressed"),
]
READERS = {"a stranger": STRANGER, "a researcher": RESEARCHER, "a driver engineer": ENGINEER, "an owner of CI": OWNER}

# Width, height, and the screens within which an answer stands.
SCREENS = ((1440, 900, 3), (390, 844, 6))
FIND = """const found = document.querySelector(arguments[0]);
return found ? [found.innerText, found.getBoundingClientRect().top + (location.hash.includes("to=") ? 0 : scrollY)] : null"""


def problem(shown, page, question, width, most):
    shown.open(page, "#" + question.view)
    for _ in range(50):
        time.sleep(0.1)
        found = shown.driver.execute_script(FIND, question.element)
        if found and re.search(question.says, found[0]):
            break # pictures are decoded a while after the view is shown
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
