#!/usr/bin/env python3
"""Computes the table of docs/spectra.md anew, and compares facts of the program with it: spectra.py RAINGAUGE ROOT."""
import math
import pathlib
import re
import subprocess
import sys
import tempfile

# The least diameter of all, the least that is kept unless set, and the largest, in mm.
LEAST, KEPT, LARGEST, PARTS = 0.1, 0.3, 6, 4000

# Diameters in mm and speeds in m/s (Gunn and Kinzer, 1949).
SPEEDS = [(0, 0), (.1, .27), (.2, .72), (.3, 1.17), (.4, 1.62), (.5, 2.06), (.6, 2.47), (.7, 2.87), (.8, 3.27), (.9, 3.67), (1, 4.03), (1.2, 4.64),
          (1.4, 5.17), (1.6, 5.65), (1.8, 6.09), (2, 6.49), (2.2, 6.9), (2.4, 7.27), (2.6, 7.57), (2.8, 7.82), (3, 8.06), (3.2, 8.26), (3.4, 8.44),
          (3.6, 8.6), (3.8, 8.72), (4, 8.83), (4.4, 8.98), (4.8, 9.07), (5, 9.09), (5.4, 9.14), (5.8, 9.17), (99, 9.17)]


def gunn_kinzer(d):
    (a, u), (b, v) = next(pair for pair in zip(SPEEDS, SPEEDS[1:]) if d <= pair[1][0])
    return u + (v - u) * (d - a) / (b - a)


def atlas(d):
    return max(9.65 - 10.3 * math.exp(-0.6 * d), 0)


def marshall_palmer(rate, d):
    return 8000 * math.exp(-4.1 * d / rate ** 0.21)


def best(rate, d):
    a = 1.30 * rate ** 0.232
    return 67 * rate ** 0.846 * 2.25 / a * (d / a) ** 1.25 * math.exp(-(d / a) ** 2.25) / (math.pi / 6 * d ** 3)


def integral(law, rate, of, least=LEAST, most=LARGEST):
    step = (most - least) / PARTS
    return sum(law(rate, d) * of(d) * step for d in (least + step * (i + 0.5) for i in range(PARTS)))


def rain(law, rate, speed, *bounds):
    return integral(law, rate, lambda d: math.pi / 6 * d ** 3 * speed(d) * 3.6e-3, *bounds)


def extinction(law, rate):
    return integral(law, rate, lambda d: math.pi / 4 * d * d, KEPT) / 1000


def row_of(rate):
    made = [rain(law, rate, speed) / rate for law in (marshall_palmer, best) for speed in (gunn_kinzer, atlas)]
    blocks = [extinction(law, rate) / (0.156 * rate ** 0.63) for law in (marshall_palmer, best)]
    return made + [blocks[0], blocks[0] / made[0], blocks[1]]


def faults_of_page(page):
    rows = [[float(cell) for cell in line.strip("|").split("|")] for line in page.splitlines() if re.match(r"\| \d+ \|", line)]
    if len(rows) != 5:
        yield "docs/spectra.md: %d rows, not 5" % len(rows)
    for row in rows:
        for shown, due in zip(row[1:], row_of(row[0]), strict=True):
            if abs(shown - due) > 0.00501:
                yield "docs/spectra.md, %g mm/h: %.2f is %.4f" % (row[0], shown, due)


def told(raingauge, settings):
    with tempfile.TemporaryDirectory() as folder:
        command = [raingauge, "render", "streaks", "--device", "cpu", "--size", "16x9", "--frame", "1", "-o", folder + "/a.png"]
        for setting in ["atlas=small", "city=small", "depth_map_px=64", "shadow_map_px=16", "far_layers=0"] + settings:
            command += ["--set", setting]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return {name: float(value) for name, value in re.findall(r"(\w+) ([\d.e+-]+)(?=,|$)", text, re.M)}


def faults_of_facts(raingauge):
    for name, law, rate in (("marshall-palmer", marshall_palmer, 1), ("best", best, 100)):
        facts = told(raingauge, ["spectrum=" + name, "normalised=off", "terminal_speed=atlas", "rain_mm_h=%d" % rate])
        for fact, due in (("extinction_per_km", extinction(law, rate)), ("rain_rate_mm_h", rain(law, rate, atlas, KEPT)),
                          ("rain_left_out_mm_h", rain(law, rate, atlas, LEAST, KEPT))):
            if abs(facts[fact] / due - 1) > 0.002:
                yield "%s, %d mm/h: %s is %g, not %g" % (name, rate, fact, facts[fact], due)


def main(raingauge, root):
    page = (pathlib.Path(root) / "docs/spectra.md").read_text()
    faults = [*faults_of_page(page), *faults_of_facts(raingauge)]
    print("\n".join(faults))
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
