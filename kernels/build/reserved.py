"""The words that GLSL and OpenCL C reserve beyond those of C, so that no kernel may use them as names.

A word that OpenCL C alone reserves would pass the build, and a driver would refuse it when the kernel first runs.
"""
import re

# GLSL 4.50, section 3.6, those of Vulkan's too: keywords, and what is kept for later.
GLSL = """
active asm atomic_uint attribute buffer cast centroid class coherent common discard external filter fixed flat half highp
in inout input interface invariant layout lowp mediump namespace noperspective out output partition patch precise
precision public readonly resource sample sampler samplerShadow shared smooth subpassInput subpassInputMS subroutine superp
template this uniform using varying writeonly
"""
GLSL_FAMILIES = (r"[dbiuhf]?vec[234]|d?mat[234](x[234])?|gl_\w+"
                 r"|[iu]?(sampler|image|texture)([123]D(Rect|MS)?|Cube|Buffer)(Array)?(Shadow)?")
# OpenCL C 1.2, section 6.9: qualifiers, and types that C has not.
OPENCL = """
complex constant event_t global half image1d_array_t image1d_buffer_t image1d_t image2d_array_t image2d_t image3d_t
imaginary intptr_t kernel local private ptrdiff_t quad read_only read_write sampler_t size_t uchar uintptr_t ulong ushort
write_only
"""
OPENCL_FAMILIES = r"(u?(char|short|int|long)|float|double|half|bool|quad)(2|3|4|8|16)"

# By language of a text: the other language, and what it reserves; no shell of this one needs any of these words.
FOREIGN = {
    "GLSL": ("OpenCL C", set(OPENCL.split()), re.compile(OPENCL_FAMILIES)),
    "OPENCL": ("GLSL", set(GLSL.split()), re.compile(GLSL_FAMILIES)),
}


def refusal(language, text):
    """What is wrong with the names in a text in this language, or None."""
    other, words, families = FOREIGN[language]
    found = [name for name in set(re.findall(r"[A-Za-z_]\w*", text)) if name in words or families.fullmatch(name)]
    return f"{other} reserves {', '.join(sorted(found))}: use other names (docs/dialect.md)" if found else None
