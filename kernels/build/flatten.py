#!/usr/bin/env python3
"""Turns kernel headers into the texts that drivers compile.

flatten.py SHADERS DEPFILE COMPILER... -- FOLDER [SHELL HEADER OUTPUT]...

Runs the C preprocessor over each SHELL (a file of SHADERS), which includes the kernel's HEADER, so
that FOLDER/OUTPUT is one flat file without includes or macros. For GLSL it then gives every quotient
and root a name, behind which a program that defines RG_ROUNDED finds kernels/dialect/rounding.h and
another the driver's own, and makes every float `precise`, which forbids a driver to contract or
reorder: the two things that the dialect cannot say in C and OpenCL C alike. A text whose files are
older than OUTPUT.d, which lists them, is not made; one that has not changed is not written again, so
that the build does not make anew what depends on it. Texts NAME.native.* are those of native devices;
NAME.setup.* leave to the driver only the setup of items, NAME.samplers.* only samplers
(kernels/dialect/lang.h), NAME.pass.* only what is stored to an image. One process makes all texts,
with a helper for each processor. A kernel with a name that another language reserves is refused.
"""
import multiprocessing
import os
import re
import subprocess
import sys
import time

import quotients
import reserved

# OpenGL and Vulkan name the vertex's number differently. OpenGL reads words, and structs of words,
# from buffer textures: llvmpipe fetches these side by side, but a storage buffer lane by lane.
VERSION = """#version 450 core
#ifdef VULKAN
#define RG_VERTEX_INDEX gl_VertexIndex
#define RG_WORDS(slot, T, block, words) \\
    layout(std430, binding = slot) restrict readonly buffer block { T words[]; };
#define RG_FLOAT_OF(words, i) words[i]
#define RG_INT_OF(words, i) words[i]
#define RG_UINT_OF(words, i) words[i]
#define RG_STRUCTS(slot, T, block, words) RG_WORDS(slot, T, block, words)
#define RG_STRUCT_OF(of, words, i) words[i]
#else
#define RG_VERTEX_INDEX gl_VertexID
#define RG_WORDS(slot, T, block, words) layout(binding = slot) uniform usamplerBuffer words;
#define RG_FLOAT_OF(words, i) uintBitsToFloat(texelFetch(words, i).x)
#define RG_INT_OF(words, i) int(texelFetch(words, i).x)
#define RG_UINT_OF(words, i) texelFetch(words, i).x
#define RG_STRUCTS(slot, T, block, words) layout(binding = slot) uniform usamplerBuffer words;
#define RG_STRUCT_OF(of, words, i) of(words, i)
#endif
#define RG_ROUGH_QUOTIENT(a, b) ((a) / (b))
#define RG_ROUGH_ROOT(x) sqrt(x)
#ifdef RG_ROUNDED
#define RG_QUOTIENT(a, b) rg_rounded_quotient(a, b)
#define RG_ROOT(x) rg_rounded_root(x)
#else
#define RG_QUOTIENT(a, b) RG_ROUGH_QUOTIENT(a, b)
#define RG_ROOT(x) RG_ROUGH_ROOT(x)
#endif
"""

# Of native devices: whether the driver's samplers filter depths, which OpenGL's do, and Vulkan's where RG_USE_FILTER
# says so; and whether fragments take places that the driver interpolates (backends/vulkan/program.c).
NATIVE = """#ifdef VULKAN
layout(constant_id = 0) const bool rg_filters_depth = true;
layout(constant_id = 1) const bool rg_interpolates = true;
#else
const bool rg_filters_depth = true;
#ifdef RG_COMPUTES_PLACES
const bool rg_interpolates = false;
#else
const bool rg_interpolates = true;
#endif
#endif
"""

# A fragment's colour. Where RG_BLENDS is defined the program blends by itself, with what its pixel holds, and the API has the
# driver run a pixel's fragments in their order.
FRAGMENT = """#ifdef RG_BLENDS
#define RG_BLENDED_WITH(draw, c, t) rg_blended(draw, c, rg_rgba(t.x, t.y, t.z, t.w))
#ifdef VULKAN
#define RG_COLOUR(name) \\
    layout(input_attachment_index = 0, set = 1, binding = 0) uniform subpassInput name##_before; \\
    layout(location = 0) out vec4 name;
#define RG_BLENDED(draw, c, name) RG_BLENDED_WITH(draw, c, subpassLoad(name##_before))
#else
#extension GL_EXT_shader_framebuffer_fetch : require
#define RG_COLOUR(name) layout(location = 0) inout vec4 name;
#define RG_BLENDED(draw, c, name) RG_BLENDED_WITH(draw, c, name)
#endif
#else
#define RG_COLOUR(name) layout(location = 0) out vec4 name;
#define RG_BLENDED(draw, c, name) c
#endif
"""


def needs_of(depfile):
    """The files that a text was made of."""
    with open(depfile, encoding="utf-8") as file:
        return file.read().replace("\\\n", " ").split(":", 1)[1].split()


def native_parts(output):
    """What a text leaves to the driver on native devices: the setup of items, and samplers."""
    form = os.path.basename(output).split(".")[1]
    return form in ("native", "setup"), form in ("native", "samplers")


def preprocess(language, parts, header, shell, depfile, compiler):
    """The text behind the preprocessor, which also writes the files that it was made of."""
    command = compiler + [
        "-E", "-P", "-undef", "-nostdinc", "-x", "c", "-MD", "-MF", depfile,
        f"-DRG_{language}=1",
        f"-DRG_NATIVE_SETUP={int(parts[0])}",
        f"-DRG_NATIVE_SAMPLERS={int(parts[1])}",
        f'-DRG_KERNEL_HEADER="{header}"',
        shell,
    ]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def is_made(output, depfile):
    """Whether a text is there, and younger than all that it was made of and by."""
    try:
        made_ns = os.stat(depfile).st_mtime_ns
        tools = [__file__, quotients.__file__, reserved.__file__]
        return os.path.exists(output) and all(
            os.stat(path).st_mtime_ns < made_ns for path in needs_of(depfile) + tools)
    except OSError:
        return False


def closing(text, start):
    """The index of the bracket that closes the one at `start`."""
    depth = 0
    for at in range(start, len(text)):
        depth += {"(": 1, "{": 1, ")": -1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at
    raise ValueError(f"a bracket is not closed: {text[start:start + 60]}")


def split_top(text, separator):
    """The parts of `text` between separators that stand in no bracket."""
    parts, depth, start = [], 0, 0
    for at, char in enumerate(text):
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(char, 0)
        if char == separator and depth == 0:
            parts.append(text[start:at])
            start = at + 1
    return parts + [text[start:]]


def make_returns_precise(text, types):
    """Each result passes through a precise local: GLSL lets no function's type be qualified."""
    function = re.compile(rf"\b({types})\s+\w+\s*\([^()]*\)\s*(?=\{{)")
    returned = re.compile(r"\breturn\b([^;]*);")
    done, at = [], 0
    while match := function.search(text, at):
        end = closing(text, match.end()) + 1
        local = rf"{{ {match.group(1)} rg_result =\1; return rg_result; }}"
        done += [text[at : match.end()], returned.sub(local, text[match.end() : end])]
        at = end
    return "".join(done) + text[at:]


class PreciseExpressions:
    """Conditions and arguments that compute pass through precise globals, one for each place:
    `precise` holds for what is assigned to a variable, and these are assigned to none."""

    scalars = {"float", "int", "uint", "bool"}
    literal = re.compile(r"\s*-?[\d.]+(e-?\d+)?[fu]?\s*")

    def __init__(self, text, types):
        self.globals = []
        header = re.compile(rf"\b(?:void|{types})\s+(\w+)\s*\(([^()]*)\)\s*\{{")
        self.headers = {match.start(1) for match in header.finditer(text)}
        self.parameters = {
            match.group(1): [p.split()[0] for p in match.group(2).split(",") if p.strip()]
            for match in header.finditer(text)
        }
        self.parameters.update(RG_QUOTIENT=["float", "float"], RG_ROOT=["float"])
        self.text = self.rewrite(text, self.headers)

    def through(self, kind, expression):
        if not re.search(r"[-+*/]|\bRG_QUOTIENT\b", expression) or self.literal.fullmatch(expression):
            return expression
        self.globals.append(f"precise {kind} rg_exact_{len(self.globals)};")
        space = expression[: len(expression) - len(expression.lstrip())]
        return f"{space}rg_exact_{len(self.globals) - 1} = ({expression.strip()})"

    def inside(self, name, text):
        """What stands in the brackets behind `name`, rewritten."""
        if name in ("if", "while"):
            return self.through("bool", self.rewrite(text))
        if name == "for":
            first, condition, step = map(self.rewrite, split_top(text, ";"))
            return f"{first};{self.through('bool', condition)};{step}"
        arguments = [self.rewrite(part) for part in split_top(text, ",")]
        kinds = self.parameters.get(name, [])
        return ",".join(
            self.through(kinds[i], part) if i < len(kinds) and kinds[i] in self.scalars else part
            for i, part in enumerate(arguments)
        )

    def rewrite(self, text, headers=frozenset()):
        done, at = [], 0
        for match in re.finditer(r"\b(\w+)\s*\(", text):
            if match.start() < at or match.start(1) in headers:
                continue
            end = closing(text, match.end() - 1)
            done += [text[at : match.end()], self.inside(match.group(1), text[match.end() : end])]
            at = end
        return "".join(done) + text[at:]


def make_precise(text):
    """All that is computed becomes `precise`: locals, results, conditions and arguments;
    those that are integers or truth values too, since they may be computed from floats."""
    structs = re.findall(r"\bstruct\s+(\w+)\s*\{", text)
    types = "|".join(["float", "int", "uint", "bool"] + [s for s in structs if s != "rg_ctx"])
    expressions = PreciseExpressions(text, types)
    local = re.compile(rf"(^|[;{{}}(]\s*)((?:{types})\s+\w+\s*[=;])", re.M)
    parts = re.split(
        r"(struct\s+\w+\s*\{[^}]*\};|buffer\s+\w+\s*\{[^}]*\}|uniform\s+\w+\s*\{[^}]*\})",
        make_returns_precise(expressions.text, types),
    )
    return "\n".join(expressions.globals + [""]) + "".join(
        part if index % 2 else local.sub(r"\1precise \2", part)
        for index, part in enumerate(parts)
    )


def words_of(name, structs, without=None):
    """The words of a struct in their order, but for those of structs `without`: how each is reached, and its type."""
    for member in filter(str.strip, structs[name].split(";") if name != without else []):
        kind, names = member.split(None, 1)
        for path in (n.strip() for n in names.split(",")):
            if kind in structs:
                yield from ((f"{path}.{inner}", k) for inner, k in words_of(kind, structs, without))
            else:
                yield path, kind


def add_struct_readers(text):
    """Puts a function before the first slot of a struct: with it OpenGL reads one, word by word."""
    structs = dict(re.findall(r"\bstruct\s+(\w+)\s*\{([^}]*)\}", text))
    read = set()

    def with_reader(slot):
        name = slot.group(1)
        if name in read:
            return slot.group(0)
        read.add(name)
        words = list(words_of(name, structs))
        reads = "".join(
            f"    v.{path} = RG_{kind.upper()}_OF(words, at + {i});\n"
            for i, (path, kind) in enumerate(words)
        )
        return (
            f"\n#ifndef VULKAN\n{name} rg_{name}_of(usamplerBuffer words, int i)\n{{\n"
            f"    int at = i * {len(words)};\n    {name} v;\n{reads}    return v;\n}}\n#endif\n"
            + slot.group(0)
        )

    return re.sub(r"\bRG_STRUCTS\(\s*\d+\s*,\s*(\w+)", with_reader, text)


def add_varyings(text):
    """Puts a record's words into flat varyings of four: GLSL lets no fragment read structs of structs. No fragment reads
    rg_planes, because the driver interpolates (kernels/dialect/draw/triangle.h)."""
    structs = dict(re.findall(r"\bstruct\s+(\w+)\s*\{([^}]*)\}", text))
    to = {"float": "floatBitsToUint(%s)", "int": "uint(%s)", "uint": "%s"}
    back = {"float": "uintBitsToFloat(%s)", "int": "int(%s)", "uint": "%s"}

    def words(name):
        sent = enumerate(words_of(name, structs, without="rg_planes"))
        return [(path, kind, f"rg_words[{i // 4}].{'xyzw'[i % 4]}") for i, (path, kind) in sent]

    def varying(name, way):
        count = (len(words(name)) + 3) // 4
        return f"layout(location = 2) flat {way} uvec4 rg_words[{count}];\n" if count else ""

    def sends(match):
        puts = "".join(f"    {at} = {to[kind] % ('v.' + path)};\n" for path, kind, at in words(match.group(1)))
        return varying(match.group(1), "out") + f"void rg_send({match.group(1)} v)\n{{\n{puts}}}\n"

    def receives(match):
        gets = "".join(f"    v.{path} = {back[kind] % at};\n" for path, kind, at in words(match.group(1)))
        return varying(match.group(1), "in") + f"{match.group(1)} rg_received()\n{{\n    {match.group(1)} v;\n{gets}    return v;\n}}\n"

    return re.sub(r"\bRG_RECEIVES\((\w+)\)", receives, re.sub(r"\bRG_SENDS\((\w+)\)", sends, text))


def write_if_changed(path, text):
    try:
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    except OSError:
        pass
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def flatten(job):
    """Writes one text; returns the files that it was made of, and what is wrong with its names."""
    shell, header, output, compiler = job
    language, depfile = "OPENCL" if shell.endswith(".cl") else "GLSL", output + ".d"
    if is_made(output, depfile):
        return needs_of(depfile), None
    started_ns = time.time_ns()
    parts = native_parts(output)
    text = preprocess(language, parts, header, shell, depfile + ".new", compiler)
    needs = needs_of(depfile + ".new")
    refusal = reserved.refusal(language, text)
    if refusal:
        return needs, f"{header}: {refusal}"
    if language == "GLSL":
        try:
            text = add_varyings(add_struct_readers(make_precise(quotients.rewrite(text))))
            prologue = (NATIVE if any(parts) else "") + (FRAGMENT if shell.endswith("draw.frag") else "")
            text = VERSION + prologue + text
        except quotients.Refused as refused:
            return needs, f"{header}: {refused}"
    write_if_changed(output, text)
    os.utime(depfile + ".new", ns=(started_ns, started_ns))
    os.replace(depfile + ".new", depfile)
    return needs, None


def main():
    split = sys.argv.index("--")
    shaders, depfile, *compiler = sys.argv[1:split]
    folder, *jobs = sys.argv[split + 1 :]
    jobs = [
        (os.path.join(shaders, shell), header, os.path.join(folder, output), compiler)
        for shell, header, output in zip(jobs[::3], jobs[1::3], jobs[2::3])
    ]
    with multiprocessing.Pool() as pool:
        done = pool.map(flatten, jobs, chunksize=4)
    refusals = sorted({refusal for _, refusal in done if refusal})
    if refusals:
        sys.exit("\n".join(refusals))
    needs = sorted(set().union(*(needs for needs, _ in done)))
    with open(depfile, "w", encoding="utf-8") as file:
        file.write(f"{jobs[0][2]}: {' '.join(needs)}\n")


if __name__ == "__main__":
    main()
