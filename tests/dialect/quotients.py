#!/usr/bin/env python3
"""The build finds each quotient of floats in GLSL, and nothing else: quotients.py FOLDER, that of kernels/build/quotients.py.

Each case is an expression of a function and what becomes of it. What the build cannot tell the type of is refused.
"""
import sys

sys.path.insert(0, sys.argv[1])
import quotients

TEXT = """struct v3 {{ float x; float y; float z; }};
struct item {{ v3 at; int count; uint bits; }};
v3 v3_make(float x, float y, float z) {{ v3 v; v.x = x; v.y = y; v.z = z; return v; }}
int count_of(item it) {{ return it.count; }}
float other(int a, int b) {{ int c = a; return float(c); }}
float tried(float a, float b, int i, uint u, item it)
{{
    float c = a + b;
    int k = i;
    {};
}}
"""
CASES = {
    "c = a / b": "c = RG_QUOTIENT(a, b)",
    "c = 1.0f / RG_ROOT(a * a + b * b)": "c = RG_QUOTIENT(1.0f, RG_ROOT(a * a + b * b))",
    "c = a * b / c * 2.0f": "c = RG_QUOTIENT(a * b, c) * 2.0f",
    "c = a / b / c": "c = RG_QUOTIENT(RG_QUOTIENT(a, b), c)",
    "c = a - b / c + a": "c = a - RG_QUOTIENT(b, c) + a",
    "c = -a / -b": "c = -RG_QUOTIENT(a, -b)",
    "c = (a / b) / (b / a + 1e-12f)": "c = RG_QUOTIENT((RG_QUOTIENT(a, b)), (RG_QUOTIENT(b, a) + 1e-12f))",
    "c = a / it.at.x": "c = RG_QUOTIENT(a, it.at.x)",
    "c = it.at.y / v3_make(a, b, c / a).x": "c = RG_QUOTIENT(it.at.y, v3_make(a, b, RG_QUOTIENT(c, a)).x)",
    "c = a / (i > 0 ? b : c)": "c = RG_QUOTIENT(a, (i > 0 ? b : c))",
    "c = a > b / c ? a : b": "c = a > RG_QUOTIENT(b, c) ? a : b",
    "c = float(i / 4) / float(k)": "c = RG_QUOTIENT(float(i / 4), float(k))",
    "c = other(i / k, 3) / 255.0f": "c = RG_QUOTIENT(other(i / k, 3), 255.0f)",
    "if (a / b > 1.0f) return a / c": "if (RG_QUOTIENT(a, b) > 1.0f) return RG_QUOTIENT(a, c)",
    # not quotients of floats, or only of literals
    "k = i / 4": "k = i / 4",
    "k = i * k / count_of(it)": "k = i * k / count_of(it)",
    "k = int(u / 3u) + i / it.count": "k = int(u / 3u) + i / it.count",
    "u = it.bits / (u + 1u)": "u = it.bits / (u + 1u)",
    "c = a * (1.0f / 3.0f)": "c = a * (1.0f / 3.0f)",
    "c = 23.744f": "c = 23.744f",
}
REFUSED = ["c = a / unheard", "c = a / it.at", "c = a / unheard(b)", "c /= a"]


def main():
    failed = 0
    for expression, expected in CASES.items():
        got = quotients.rewrite(TEXT.format(expression))
        if got != TEXT.format(expected):
            failed += 1
            print(f"`{expression}`: {got.splitlines()[-2].strip()}, not `{expected}`", file=sys.stderr)
    for expression in REFUSED:
        try:
            quotients.rewrite(TEXT.format(expression))
        except quotients.Refused:
            continue
        failed += 1
        print(f"`{expression}`: not refused", file=sys.stderr)
    sys.exit(1 if failed else 0)


main()
