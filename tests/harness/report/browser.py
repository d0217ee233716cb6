#!/usr/bin/python3
"""How a browser shows the page of `raingauge report`: browser.py RAINGAUGE [FOLDER].

FOLDER gets pictures of the page. The browser is Debian's chromium, without a network, and the Python is Debian's, for which
python3-selenium is made. Without either the test is skipped.
"""
import copy
import json
import pathlib
import random
import re
import sys
import tempfile
import time

sys.dont_write_bytecode = True

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select
except ImportError:
    print("1..0 # SKIP python3-selenium is not installed")
    sys.exit(0)

import made

CHROMIUM, DRIVER = pathlib.Path("/usr/bin/chromium"), pathlib.Path("/usr/bin/chromedriver")
WIDTHS = (1440, 768, 390)
VIEWS = ("overview", "claims", "tables", "gate", "ci", "changes", "checks", "devices", "pictures")
# Views of one thing.
SINGLE = ("table?id=creus-5.3", "table?id=stuppacher-1", "claim?id=creus-5.4%2F20-meters-come-as-a-good-trade-off", "gate?case=flow%2Fpane.new", "checks?pair=0+0+2")


def skip_without_browser():
    """Ends the test, as skipped, if there is no browser."""
    if not (CHROMIUM.exists() and DRIVER.exists()):
        print("1..0 # SKIP chromium or chromium-driver is not installed")
        sys.exit(0)


class Browser:
    """A page in a browser without a network."""

    def __init__(self, raingauge):
        self.raingauge = raingauge
        options = webdriver.ChromeOptions()
        options.binary_location = str(CHROMIUM)
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(str(DRIVER)), options=options)
        self.driver.execute_cdp_cmd("Network.enable", {})
        self.driver.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})

    def size(self, width, height=900):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})

    def prefer(self, scheme):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def open(self, page, place=""):
        self.driver.get("about:blank")
        self.driver.get(f"file://{page}{place}")

    def go(self, place):
        self.driver.execute_script("location.hash = arguments[0]", place)
        time.sleep(0.1)

    def ask(self, expression):
        return self.driver.execute_script("return " + expression)

    def find(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def messages(self):
        return [line["message"] for line in self.driver.get_log("browser")]

    def press(self, *keys):
        webdriver.ActionChains(self.driver).send_keys(*keys).perform()
        time.sleep(0.1)


def older_table():
    """An older table: gl took half as long, vulkan had another driver and took a tenth, and cpu failed in its first row."""
    record = json.loads((made.TABLES / "stuppacher-2.json").read_text(encoding="utf-8"))
    for device in record["passport"]["devices"]:
        device["key"] = "0" * 16 if device["name"] == "vulkan" else device["key"]
    for cell in record["cells"]:
        del cell["checksum"]
        by = {"gl": 0.5, "vulkan": 0.1}.get(cell["device"], 1)
        cell["measured"]["samples_ms"] = [by * ms for ms in cell["measured"]["samples_ms"]]
        if cell["device"] == "cpu" and cell["row_number"] == 1:
            cell.update(status="fail", detail="its image differed")
            del cell["measured"]
    return record


PASSPORT = {"raingauge": {"commit": "0123456789abcdef0123456789abcdef01234567"}, "devices": [
    {"name": "vulkan", "software": True, "driver": "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", "device": "llvmpipe (LLVM 15.0.6, 256 bits)",
     "libraries": [{"path": "/usr/lib/x86_64-linux-gnu/libvulkan_lvp.so", "build": "24e14fcfbc653ef35e1a154015265e7d2b20d61e"}]},
    {"name": "new", "software": True, "driver": "llvmpipe Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)", "device": "llvmpipe (LLVM 15.0.6, 256 bits)", "libraries": []}]}
STAGE = ("frame 1, stage flow_blur: blurred[1204] is 1065353217 (0x3f800001), not 1065353216 (0x3f800000), off by 1; 3 of 64896 words differ; other values\n"
         "the same program, other libraries; the API hands out no compiled passes")


def last_gates(names):
    """Three runs of one gate, the last with a failure that is new, one that is slower, one as before, and one that nothing decides."""
    many = [made.case(f"{('raster', 'streaks', 'flow')[i % 3]}/cell-{i}.new", "pass", 1 + i / 1e5, seconds=0.2 + i % 50 / 10) for i in range(200)]
    crash = made.case("cartoon/storm.new", "crash", message="new: the driver ended its process by signal 11", seconds=0.9)
    early = [made.case("flow/pane.new", "pass", 1.001, seconds=11.5), made.case("raster/torus.new", "pass", 1.004, seconds=8.25), made.case("drops/pane.new", "pass", 1.006, seconds=30), crash]
    last = [made.case("flow/pane.new", "differs", message="the picture differs: 1 pixel of 3072 is off by 110 codes; T2 would hold", details=STAGE, attachments=names, seconds=3.5),
            made.case("raster/torus.new", "regressed", 1.071, message="a frame takes 7.1 % longer (6.0 to 8.2 %): A 3.73 ms, B 4.00 ms", seconds=9.75),
            made.case("drops/pane.new", "inconclusive", 1.02, message="the interval allows both after the last launch that was planned", seconds=96, width=0.06), crash]
    return early + many, last + many


def odd_cases():
    """An ending that no raingauge knows, and texts that would run if they were taken for markup."""
    return [made.case("of tomorrow", "vanished"), made.case(made.HOSTILE, "crash", message=made.HOSTILE, details=made.HOSTILE, technique=made.HOSTILE)]


def make_diff(raingauge, folder):
    """Pictures of three devices: vulkan's light is gl's but for seven roundings, which no code shows, and new draws a square of its own."""
    def light(x, y, is_vulkan=False, is_new=False):
        red, green, blue = (made.linear(code) for code in (4 * x, 3 * y, 200 if is_new and 30 <= x < 35 and 10 <= y < 15 else 90))
        return red * (1 + 1e-6 if is_vulkan and y == 5 and 20 <= x < 27 else 1), green, blue
    for name, which in (("gl", {}), ("vulkan", {"is_vulkan": True}), ("new", {"is_new": True})):
        (folder / f"{name}.exr").write_bytes(made.exr(64, 48, lambda x, y, which=which: light(x, y, **which)))
    pairs = [{**made.diff(raingauge, folder, f"{a}.exr", f"{b}.exr"), "a": a, "b": b} for a, b in (("gl", "vulkan"), ("gl", "new"), ("vulkan", "new"))]
    for pair in pairs:
        pair["owed"] = "T0"
    for pair in pairs[1:]:
        pair["blame"] = {"stage": "flow_blur", "text": STAGE.split("\n", maxsplit=1)[0], "device": "new"}
    made.write(folder / "diff.json", {"format": 1, "devices": [], "failures": [], "pairs": pairs, "pictures": [{"device": name, "file": f"{name}.exr"} for name in ("gl", "vulkan", "new")]})


def make_gates(raingauge, folder, odd):
    code = lambda side, x, y: (4 * x, 3 * y, 200 if side == "b" and (x, y) == (40, 20) else 90)
    for side in "ab":
        (folder / f"flow-{side}.png").write_bytes(made.png(64, 48, lambda x, y, side=side: code(side, x, y)))
        (folder / f"flow-{side}.exr").write_bytes(made.exr(64, 48, lambda x, y, side=side: tuple(map(made.linear, code(side, x, y)))))
    made.diff(raingauge, folder, "flow-a.exr", "flow-b.exr", "-o", "flow")
    early, last = last_gates([f"flow-{kind}.png" for kind in ("a", "b", "flip", "difference")])
    made.write(folder / "gate-0.json", made.gate(*(made.case(f"case/{i}", "pass", 1 + i / 1e5) for i in range(1000 if odd else 20)), *early, passport_text="a text of several lines\nof its own"))
    made.write(folder / "gate-1.json", made.gate(*early, passport_text=json.dumps(PASSPORT)))
    made.write(folder / "gate-2.json", made.gate(*(odd_cases() if odd else []), *last, passport_text=json.dumps(PASSPORT)))
    made.write(folder / "old" / "gate.json", made.gate(*early[:150], made.case("streaks/gone.new", "pass", 1.0), passport_text=json.dumps(PASSPORT)))


def make_page(raingauge, folder, odd=False):
    """Tables, pictures, gates with all endings, and the rest; `odd` ones hold hostile texts, unknown endings and a thousand cases."""
    (folder / "old").mkdir()
    make_diff(raingauge, folder)
    make_gates(raingauge, folder, odd)
    why = made.HOSTILE if odd else "the driver ended its process by signal 11"
    made.write(folder / "verify.json", {"format": 1, "devices": [], "checks": [
        {"technique": "flow", "check": "state", "device": "gl", "status": "ok", "detail": "holds"}, {"technique": "flow", "check": "state", "device": "new", "status": "of tomorrow" if odd else "crash", "detail": why}]})
    for frame in (1, 2, 3):
        (folder / f"strip-{frame:02}.png").write_bytes(made.png(16, 9, lambda x, y, frame=frame: (x, y, 80 * frame)))
    made.write(folder / "strip.json", {"format": 1, "file": "strip-%02d.png", "technique": "drops", "device": "gl", "frame": 3, "frames": [1, 3]})
    made.write(folder / "doctor.json", {"format": 1, "passport": {}, "missing": [why] if odd else [], "warnings": [],
                                        "devices": [{"name": "gl", "status": "ok", "why": ""}, {"name": "new", "status": "crash", "why": why}]})
    made.write(folder / "baseline.json", {"format": 1, "devices": [], "baseline": [
        {"cell": "flow/pane", "device": "gl", "outcome": "ok", "launches_ms": [1, 2, 3]}, {"cell": "flow/pane", "device": "new", "outcome": "crash", "why": "it crashed"}]})
    made.write(folder / "old" / "stuppacher-2.json", older_table())
    result = made.report(raingauge, folder, made.TABLES, made.ROOT / "docs" / "pictures.md", ".", "--against", "old", "-o", "page.html")
    if result.returncode or result.stderr:
        raise SystemExit(f"raingauge report: {result.returncode}, {result.stderr}")
    return folder / "page.html"


def check_views(browser, page):
    """every view is shown at each width without a message on the console, without a request, and without a scrollbar of the whole page"""
    problems = []
    for width in WIDTHS:
        browser.size(width)
        browser.open(page)
        for view in VIEWS + ("table?id=creus-5.3", "table?id=feng-1&variant=cartoon", "table?id=creus-5.1", "claim?id=creus-5.4%2F20-meters-come-as-a-good-trade-off",
                             "gate?case=flow%2Fpane.new", "nonsense?%", "table?id=none", "claim?id=none"):
            browser.go("#" + view)
            wide, heads = browser.ask("document.documentElement.scrollWidth"), browser.find("h1")
            if wide > width or len(heads) != 1 or not heads[0].text:
                problems.append(f"{view} at {width}: {wide} wide, {len(heads)} heads")
        problems += browser.messages()
    if browser.ask("performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).length"):
        problems.append("something was asked of the network")
    return problems


def check_start(browser, page):
    """the page can be used within 2 s"""
    browser.size(1440)
    times = []
    for _ in range(3):
        browser.open(page)
        times.append(browser.ask("(t => t.loadEventEnd - t.startTime)(performance.getEntriesByType('navigation')[0])"))
    return [] if min(times) < 2000 else [times]


def check_first_screen(browser, page):
    """the first screen says what this is, what was found, and three totals"""
    browser.open(page)
    text = browser.find("main")[0].text
    totals = [head.text for head in browser.find(".total h2")]
    numbers = browser.ask("[...document.querySelectorAll('.matrix tbody tr:not(.paper)')].length")
    wanted = browser.ask("CLAIMS.length")
    problems = [] if "raingauge runs the rain of published papers" in text and f"Of {wanted} claims" in text else [text[:400]]
    return problems + ([] if totals == ["Claims", "Devices", "Pictures", "Gate"] and numbers == wanted and len(browser.find(".three img")) == 3 else [totals, numbers])


def check_links(browser, page):
    """a choice stands in the address, and the address makes the choice again"""
    browser.open(page, "#table?id=creus-5.3&variant=no_geometry&scale=first&hide=gl")
    chosen = [Select(browser.find("#choose-" + name)[0]).first_selected_option.get_attribute("value") for name in ("table", "variant", "scale")]
    problems = [] if chosen == ["creus-5.3", "no_geometry", "first"] and browser.find("#line-gl")[0].get_attribute("aria-pressed") == "false" else [chosen]
    browser.open(page, "#claims")
    browser.find("#claims-q")[0].send_keys("trade-off")
    Select(browser.find("#claims-device")[0]).select_by_value("gl")
    rows = browser.find(".matrix tbody tr:not(.paper)")
    if "q=trade-off" not in browser.driver.current_url or "device=gl" not in browser.driver.current_url or len(rows) != 1:
        problems.append((browser.driver.current_url, len(rows)))
    browser.driver.refresh()
    if len(browser.find(".matrix tbody tr:not(.paper)")) != 1:
        problems.append("the address alone shows something else")
    rows = browser.find(".matrix tbody a")
    rows[0].click()
    time.sleep(0.1)
    return problems + ([] if "claim?id=creus-5.4" in browser.driver.current_url and "trade-off" in browser.find("h1")[0].text else [browser.driver.current_url])


def check_keyboard(browser, page):
    """the keyboard does all that a pointer does: skipping, going to a view, choosing, moving the divider; the focus stays in its place"""
    browser.open(page, "#gate?gate=2&case=flow%2Fpane.new")
    problems = []
    browser.driver.execute_script("document.body.focus(); document.getElementById('skip').focus()")
    browser.press(Keys.ENTER)
    if browser.ask("document.activeElement.id") != "main":
        problems.append("skipping goes elsewhere")
    slider = browser.find("#wipe")[0]
    slider.send_keys(Keys.ARROW_RIGHT)
    if browser.ask("document.querySelector('.over').style.clipPath") != "inset(0px 0px 0px 51%)":
        problems.append(browser.ask("document.querySelector('.over').style.clipPath"))
    browser.open(page, "#claims")
    browser.find("#claims-q")[0].send_keys("lights")
    if browser.ask("document.activeElement.id") != "claims-q" or browser.find("#claims-q")[0].get_attribute("value") != "lights":
        problems.append("the focus does not stay where one types")
    reached = set()
    browser.driver.execute_script("document.getElementById('skip').focus()")
    for _ in range(14):
        browser.press(Keys.TAB)
        reached.add(browser.ask("document.activeElement.id || document.activeElement.textContent"))
    return problems + ([] if {"raingauge", "Tables", "claims-q", "claims-verdict"} <= reached else [reached])


def check_plots(browser, page):
    """a plot has a name, and a table with the number of each of its points, which are those of the table above it"""
    problems = []
    for place in ("#table?id=creus-5.4", "#table?id=stuppacher-1", "#table?id=creus-5.3&scale=first"):
        browser.open(page, place)
        points = browser.ask("document.querySelectorAll('.plot svg[role=img] .point').length")
        rows = browser.ask("document.querySelectorAll('.plot details tbody tr').length")
        label = browser.find(".plot > svg")[0].get_attribute("aria-label")
        if not points or points != rows or not label:
            problems.append((place, points, rows, label))
    browser.open(page, "#table?id=creus-5.4")
    first = browser.ask("[...document.querySelectorAll('.beside tbody tr:first-child > *')].map(c => c.firstChild.textContent)")
    if first[:4] != ["5", "70303", "60", "200"] and first[:4] != ["5", "70,303", "60", "200"]:
        problems.append(first)
    files = browser.ask("""(() => { const lines = linesOf(TABLES.find(t => t.id === 'creus-5.4'), [1, 2], 'full', 'paper'), told = {lines, axis: 'x', value: 'y', name: 'n', isLog: true};
        return [csv(plotRows(told)), pgfplots(told), svgText(document.querySelector('.plot > svg'))]; })()""")
    if not files[0].startswith("line,x,y,low,high\r\nprint,5,60,,\r\n") or "\\addplot" not in files[1] or "class=" in files[2] or "fill=" not in files[2]:
        problems.append([file[:300] for file in files])
    return problems


def check_hostile(browser, page):
    """texts of records stay texts: no part of them runs, and a reader sees them"""
    browser.open(page, "#gate")
    text = browser.find(".cases")[0].text
    problems = [] if browser.ask("window.hacked") is None and "<script>window.hacked = 1" in text else [text[:500]]
    browser.open(page, "#devices")
    return problems + ([] if browser.ask("window.hacked") is None and not browser.messages() else ["a text ran"])


def places(value, path=()):
    """The paths of all values in a document, and of the first three elements of each array."""
    inner = value.items() if isinstance(value, dict) else enumerate(value[:3]) if isinstance(value, list) else ()
    for key, part in inner:
        yield path + (key,)
        yield from places(part, path + (key,))


def changed(document, chance):
    """A record with three values changed, also to other kinds."""
    document = copy.deepcopy(document)
    for _ in range(3):
        *path, last = chance.choice([path for path in places(document) if path != ("format",)])
        inner = document
        for key in path:
            inner = inner[key]
        inner[last] = copy.deepcopy(chance.choice([None, 0, -1, 1e300, "text", [], {}, [None], [1], ["a"], {"a": 1}, True, [[]], [{}]]))
    return document


def check_broken(browser, page):
    """records with randomly changed values are shown as far as possible: no view fails, and the console stays empty"""
    documents = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in page.parent.glob("*.json")}
    documents["gate-0"]["gated"] = documents["gate-0"]["gated"][:9]
    documents["bisect"] = {"format": 1, "candidates": 3, "end": "found", "first_bad": ["a"], "judged": [{"candidate": "a", "verdict": "bad", "seconds": 1}]}
    problems = []
    for seed in range(10):
        with tempfile.TemporaryDirectory() as name:
            folder, chance = pathlib.Path(name), random.Random(seed)
            for kind, document in documents.items():
                other = changed(document, chance)
                # A field of one type marks each kind; without it, the record is none.
                mark = {"gate": "gated", "verify": "checks", "diff": "pairs", "doctor": "warnings", "baseline": "baseline", "bisect": "candidates", "strip": "file"}[kind.split("-")[0]]
                if not isinstance(other.get(mark), type(document[mark])):
                    other[mark] = document[mark]
                made.write(folder / (kind + ".json"), other)
            result = made.report(browser.raingauge, folder, ".", "--against", ".", "-o", "page.html")
            if result.returncode:
                problems.append((seed, result.stderr))
                continue
            browser.open(folder / "page.html")
            for view in VIEWS + ("gate?case=flow%2Fpane.new",):
                browser.go("#" + view)
                if "cannot be shown" in browser.find("h1")[0].text:
                    problems.append((seed, view, browser.find("main")[0].text))
            problems += [(seed, message) for message in browser.messages()]
    return problems


def check_gate(browser, page):
    """a gate's view has the verdict, the worst case first, an unknown ending, the pixel that differs, and the worst of many cases"""
    browser.open(page, "#ci")
    rows = [row.text for row in browser.find(".cases tbody tr")[:5]]
    problems = [] if "The gate fails: 5 of 206 cases fail (1 vanished, 2 crash, 1 differs, 1 regressed). 1 is inconclusive, 200 pass." in browser.find(".lead")[0].text and len(browser.find(".cases tbody tr")) == 60 else [browser.find(".lead")[0].text]
    if "vanished" not in rows[0] or "crash" not in rows[1] or "crash" not in rows[2] or "differs" not in rows[3] or "regressed" not in rows[4]:
        problems.append(rows)
    unknown = browser.ask("arrayOf(DATA.endings).map(e => e.name).filter(name => !ABOUT[name])")
    if unknown or "counts it as a failure" not in browser.find(".endings")[0].text:
        problems.append(unknown or browser.find(".endings")[0].text)
    browser.open(page, "#gate?case=flow%2Fpane.new")
    time.sleep(0.5)
    if "texel" in browser.find(".case")[0].text:
        problems.append("a pixel has two words in one view")
    worst = browser.find(".worst")[0].text
    if "at x 40, y 20: A has 160, 60, 90, B has 160, 60, 200" not in worst or "1 pixel of 3,072 differs" not in worst:
        problems.append(worst)
    browser.open(page, "#gate")
    chart = browser.ask("[...document.querySelectorAll('.plot .label')].map(label => label.textContent)")
    if chart[:3] != ["raster/torus.new", "drops/pane.new", "streaks/cell-199.new"] or len(chart) != 60 or "The worst 60 of 202 with times." not in browser.find("main")[0].text:
        problems.append(chart[:5])
    times = browser.ask("[0.05, 3.7312, 4, 9.996, 12, 128, 1234.5].map(timeDigits)")
    if times != ["0.0500", "3.73", "4.00", "10.0", "12.0", "128", "1,230"]:
        problems.append(times)
    browser.open(page, "#gate?case=flow%2Fpane.new")
    time.sleep(0.5)
    return problems + marks(browser)


def marks(browser):
    """Problems of the rings around the pixel that differs, at x 40, y 20, in A over B and three maps, and of the map that shows it larger."""
    rings = browser.ask("[...document.querySelectorAll('.comparer .ring')].filter(r => !r.hidden).map(r => (w => [parseFloat(r.style.left) / 100 * w.width, parseFloat(r.style.top) / 100 * w.height])(r.parentNode.querySelector('img, canvas').getBoundingClientRect()))")
    lit = browser.ask("(c => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.filter((x, i) => i % 4 === 0 && x > 200).length)([...document.querySelectorAll('.comparer .wipe canvas')].pop())")
    close = all(abs(left - 4 * 40.5) < 1 and abs(top - 4 * 20.5) < 1 for left, top in rings)
    return [] if len(rings) == 4 and close and lit == 25 else [rings, lit]


def check_news(browser, page):
    """what fails is new, as before, or ran for the first time, and the choice of one finds it; runs are counted, from the first to the last; cases that took as long share the place"""
    browser.open(page, "#ci")
    line, rows = browser.find(".news")[0].text, [row.text for row in browser.find(".cases tbody tr")[:5]]
    wanted = ("first run", "first run", "as before", "new", "new")
    problems = [] if line == "Since the run before (gate-1.json): 2 failures are new, 1 is as before, 2 ran for the first time." else [line]
    problems += [row for row, news in zip(rows, wanted) if news not in row]
    browser.find(".news a")[0].click()
    time.sleep(0.1)
    if len(browser.find(".cases tbody tr")) != 2 or "news=new" not in browser.driver.current_url:
        problems.append((len(browser.find(".cases tbody tr")), browser.driver.current_url))
    last = browser.find(".last tbody tr")[1].text
    if "3 runs" not in browser.find("#runs")[0].text or not last.replace("\n", " ").startswith("raster/torus.new pass B / A 1.004 regressed B / A 1.071 3"):
        problems.append(last)
    if browser.ask("getComputedStyle(document.querySelector('.last .line')).stroke") == "none":
        problems.append("the line of the runs is not drawn")
    seconds = browser.find("#seconds")[0].text
    if "drops/pane.new took longest, 96 s or " not in seconds or "The table shows only the 2 cases chosen above, which took 13.3 s." not in seconds:
        problems.append(seconds)
    told = browser.ask("[longestText([{name: 'a', seconds: 2}, {name: 'b', seconds: 2}, {name: 'c', seconds: 1}]), allText([{name: 'a', seconds: 2}]), shareText(0.004), shareText(0.0001), shareText(0.25)]")
    if told != ["2 cases took longest, 2 s or 40 % of that each: a and b", "a took 2 s. ", "0.4 %", "< 0.1 %", "25 %"]:
        problems.append(told)
    stands = browser.ask("[['crash', 'pass'], ['inconclusive', 'pass'], ['flake', 'unsupported'], ['unsupported', 'skipped']].map(endings => standOfGate({cases: endings.map(ending => ({ending}))}))")
    return problems + ([] if stands == ["bad", "open", "good", "other"] else [stands])


def check_jumps(browser, page):
    """a link within a view leads to its part, also a second time, and the overview is red where the gate fails"""
    problems = []
    for place, text, part in (("#overview", "Make this page yourself", "make"), ("#ci", "Where the seconds went", "seconds")):
        browser.open(page, place)
        for _ in range(2):
            browser.driver.execute_script("scrollTo(0, 0); [...document.querySelectorAll('main a')].find(a => a.textContent === arguments[0]).click()", text)
            time.sleep(1)
            top = browser.ask(f"document.querySelector('section#{part}').getBoundingClientRect().top")
            if not -2 <= top <= 600 or browser.ask("scrollY") < 200:
                problems.append((part, top))
    browser.open(page)
    colours = browser.ask("['.total .bad', '.found .bad'].map(s => getComputedStyle(document.querySelector(s)).color)")
    return problems + ([] if colours == ["rgb(179, 38, 30)"] * 2 else [colours])


def check_pictures(browser, page):
    """devices that draw other pictures stand in a matrix; two of them are shown with their linear values, of a case of a gate as well; frames are a strip"""
    browser.open(page, "#checks")
    time.sleep(0.5)
    cells = browser.ask("[...document.querySelectorAll('.devices tbody td')].map(c => c.querySelector('canvas') ? 'map' : c.querySelector('img') ? 'picture' : c.textContent)")
    problems = [] if cells == ["picture", "the same codes", "map", "the same codes", "picture", "map", "map", "map", "picture"] else [cells]
    lit = browser.ask("[...document.querySelectorAll('.devices canvas')].map(c => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((x, i) => i % 4 < 3 && x > 200))")
    browser.find(".devices a")[1].send_keys(Keys.ENTER)
    time.sleep(0.5)
    if lit != [True] * 4 or "checks?pair=0+1+2" not in browser.driver.current_url or "vulkan has" not in browser.find(".worst")[0].text:
        problems.append((lit, browser.driver.current_url, browser.find(".worst")[0].text))
    for place, values in (("#checks?pair=0+0+2", ("gl", "new")), ("#gate?case=flow%2Fpane.new", ("A", "B"))):
        browser.open(page, place)
        browser.find(".comparer details summary")[0].send_keys(Keys.ENTER)
        time.sleep(0.2)
        told = browser.ask("[...document.querySelectorAll('.texels tbody tr')].map(r => [...r.children].map(c => c.textContent))")
        middle, blue = browser.ask("document.querySelector('.grid .middle').textContent"), [float(row[-1]) for row in told[:3]]
        if len(told) % 3 or [row[1] for row in told[:3]] != [*values, f"{values[1]} − {values[0]}"] or abs(blue[1] - blue[0] - blue[2]) > 1e-3 or abs(blue[2] - made.linear(200) + made.linear(90)) > 1e-3 or (values[0] == "A") != ("than a code, 1 pixel differs" in browser.find(".comparer")[0].text) or told[0][2][:5] not in middle or len(browser.find(".grid tbody td")) != 33 * 33 or f"{values[0]} stands above {values[1]}" not in browser.find(".comparer")[0].text:
            problems.append((told, middle))
    browser.open(page, "#pictures")
    return problems + ([] if [item.text for item in browser.find(".strip li")] == ["frame 1", "frame 2", "frame 3"] else ["the strip"])


def check_changes(browser, page):
    """compared with earlier records, changed verdicts, endings and statuses are shown, and changed times if they can be compared"""
    browser.open(page, "#changes")
    cells = browser.ask("changedCells().filter(c => c.change).map(c => [c.cell.device, c.change])")
    slower, status = [c for c in cells if c[1] == "slower"], [c for c in cells if c[1] == "status"]
    text = browser.find("main")[0].text
    problems = [] if slower and {c[0] for c in slower} == {"gl"} and {c[0] for c in status} == {"cpu"} and len(slower) + len(status) == len(cells) else [cells]
    if "another machine, driver or setting are not held against each other" not in text or "its image differed" in text:
        problems.append(text[:600])
    compared = browser.find(".facts")[0].text
    if not re.match(r"Then\s+old/gate\.json and old/stuppacher-2\.json, by raingauge of commits [0-9a-f]{12} and [0-9a-f]{12}\s+Now\s+\d+ files of \S*results/tables/ and the current folder, by ", compared):
        problems.append(compared)
    if browser.find("h2")[0].text != "Times" or "slower" not in browser.find("tbody tr")[0].text or "54 new cases pass" not in text or "gone: streaks/gone.new" not in text:
        problems.append(text[:600])
    return problems + ([] if browser.ask("changedEndings().find(([c]) => c.name === 'flow/pane.new')[1].ending") == "pass" else ["an ending"])


def check_machines(browser, page):
    """claims of two machines stand side by side, with a count of each and what differs; each has its own tables, and a plot in a claim"""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        result = made.report(browser.raingauge, folder, made.machines(folder / "all"), "--against", made.TABLES, "-o", "page.html")
        if result.returncode or result.stderr:
            return [result.stderr]
        browser.open(folder / "page.html", "#claims")
        cells = lambda selector: browser.ask(f"[...document.querySelectorAll('{selector}')].map(c => c.innerText.trim())")
        problems = [] if cells(".matrix thead th")[:3] == ["claim", "cpu on A", "cpu on B"] else [cells(".matrix thead th")]
        if [row.split("\t")[2:4] for row in cells(".machines tbody tr")] != [["2 of 5", "0 of 5"], ["0 of 5", "0 of 5"]]:
            problems.append(cells(".machines tbody tr"))
        if len(cells(".differing tbody tr")) != 2 or any("holds" not in row or "does not hold" not in row for row in cells(".differing tbody tr")):
            problems.append(cells(".differing tbody tr"))
        browser.go("#claim?id=creus-5.4%2Fsmall-values-achieve-faster-framerates")
        heads = cells("h2")
        if "The rows that decide, creus-5.4 on A" not in heads or "The rows that decide, creus-5.4 on B" not in heads:
            problems.append(heads)
        browser.go("#table?id=creus-5.4+on+B")
        if cells("h1") != ["creus-5.4 on B"] or "Second CPU" not in cells(".facts")[0] or not cells(".claims article"):
            problems.append(cells("h1") + cells(".facts"))
        browser.go("#overview")
        if "Hold: 2 of 5 on A and 0 of 5 on B" not in cells(".total")[0] or "2 verdicts of devices differ between 2 machines" not in cells(".found")[0]:
            problems.append(cells(".total") + cells(".found"))
        for view in ("tables", "changes", "devices"):
            browser.go("#" + view)
            problems += ["%s: %s" % (view, browser.find("main")[0].text)] * ("cannot be shown" in browser.find("h1")[0].text)
        return problems + browser.messages()


def check_owed(browser, page):
    """pairs that reach what their devices owe each other are told apart from those that differ; older records say not what is owed"""
    pairs = [{"a": tier, "b": str(owed), "tier": tier, "max": 1, "differing": 1, **({"owed": owed} if owed else {})}
             for tier, owed in (("T0", "T1"), ("T1", "T1"), ("T2", "T2"), ("T1", "T0"), ("T2", "T1"), ("none", "T2"), ("T1", None))]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        made.write(folder / "diff.json", {"format": 1, "devices": [], "failures": [], "pairs": pairs})
        result = made.report(browser.raingauge, folder, "diff.json", "-o", "page.html")
        if result.returncode or result.stderr:
            return [result.stderr]
        browser.open(folder / "page.html", "#overview")
        text = " ".join(browser.find(".total")[0].text.split())
    wanted = "4 differ: T1 and T0, T2 and T1, none and T2, T1 and None. Equal up to rounding, as a GPU may be: T1 and T1. The same scene, drawn in another way: T2 and T2."
    return [] if wanted in text else [text]


def check_looks(browser, page):
    """the page is dark if the reader prefers it, and a print has all rows, whole tables and no controls"""
    browser.open(page)
    paper = lambda: browser.ask("getComputedStyle(document.documentElement).backgroundColor")
    browser.prefer("dark")
    dark = paper()
    browser.prefer("light")
    browser.open(page, "#table?id=creus-5.3")
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    browser.size(720)
    cut = browser.ask("[...document.querySelectorAll('table, svg')].filter(t => t.getBoundingClientRect().right > 721).length")
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": [{"name": "prefers-color-scheme", "value": "light"}]})
    browser.size(1440)
    printed = browser.driver.execute_cdp_cmd("Page.printToPDF", {})["data"]
    return [] if dark != paper() == "rgb(255, 255, 255)" and len(printed) > 50000 and not cut else [dark, paper(), len(printed), cut]


SHOTS = {"first": "#overview", "table": "#table?id=creus-5.3", "claim": "#claim?id=creus-5.6%2Flights-rapidly-decrease-performance", "gate": "#gate", "case": "#gate?case=flow%2Fpane.new", "ci": "#ci", "devices": "#checks?pair=0+0+2"}


def keep_pictures(browser, page, folder):
    """Pictures of views at each width, to look at."""
    for width in WIDTHS:
        for name, place in SHOTS.items():
            browser.size(width)
            browser.open(page, place)
            time.sleep(0.5)
            browser.size(width, min(browser.ask("document.documentElement.scrollHeight"), 3000))
            time.sleep(0.3)
            browser.driver.save_screenshot(str(folder / f"{name}-{width}.png"))


def main():
    skip_without_browser()
    raingauge = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        page = make_page(raingauge, pathlib.Path(folder), odd=True)
        browser = Browser(raingauge)
        try:
            failed = made.run([check_views, check_start, check_first_screen, check_links, check_keyboard, check_plots, check_hostile, check_broken, check_gate, check_news, check_jumps, check_pictures, check_changes, check_machines, check_owed, check_looks], browser, page)
            if len(sys.argv) > 2:
                with tempfile.TemporaryDirectory() as shown:
                    keep_pictures(browser, make_page(raingauge, pathlib.Path(shown)), pathlib.Path(sys.argv[2]))
        finally:
            browser.driver.quit()
    return failed


if __name__ == "__main__":
    sys.exit(main())
