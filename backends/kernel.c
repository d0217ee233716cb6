#include "backends/kernel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <libdeflate.h>

#include "core/base/alloc.h"
#include "core/base/files/file.h"
#include "core/base/log.h"

const struct rg_slot_info rg_drawn_slots[RG_DRAWN_SLOTS] = {
    {"packed primitives", RG_SLOT_PRIMS, RG_SLOT_IN, 4, RG_FORMAT_NONE, NULL, RG_TEXELS},
    {"visible samples", RG_SLOT_SAMPLES, RG_SLOT_ATOMIC, 4, RG_FORMAT_NONE, "u", RG_TEXELS},
    {"depth behind", RG_SLOT_BEHIND, RG_SLOT_IMAGE, 0, RG_D32F, NULL, RG_TEXELS},
};

const struct rg_kernel *rg_kernel_find(const char *name)
{
    const struct rg_kernel *const *all;
    int count = rg_kernel_all(&all);
    for (int i = 0; i < count; i++)
        if (!strcmp(all[i]->name, name))
            return all[i];
    return NULL;
}

bool rg_kernel_samples(const struct rg_kernel *kernel)
{
    bool samples = false;
    for (int i = 0; i < kernel->slot_count; i++)
        samples = samples || kernel->slots[i].sampler != RG_TEXELS;
    return samples;
}

const struct rg_slot_info *rg_kernel_target(const struct rg_kernel *kernel)
{
    const struct rg_slot_info *slot = kernel->slots;
    while (kernel->layer && slot->kind != RG_SLOT_OUT_IMAGE)
        slot++;
    return kernel->layer ? slot : NULL;
}

int rg_kernel_index(const struct rg_kernel *kernel)
{
    const struct rg_kernel *const *all;
    const int count = rg_kernel_all(&all);
    int index = 0;
    while (index < count && all[index] != kernel)
        index++;
    return index;
}

const char *rg_kernel_override(void)
{
    const char *folder = getenv("RG_KERNEL_DIR");
    return folder && *folder ? folder : NULL;
}

static unsigned char *read_whole(FILE *file, size_t *size)
{
    if (fseek(file, 0, SEEK_END))
        return NULL;
    long end = ftell(file);
    rewind(file);
    unsigned char *bytes = end > 0 ? malloc((size_t)end) : NULL;
    *size = bytes ? fread(bytes, 1, (size_t)end, file) : 0;
    if (bytes && *size != (size_t)end) {
        free(bytes);
        return NULL;
    }
    return bytes;
}

enum {
    ROUNDS_AND_BLENDS = RG_CODE_ROUNDS | RG_CODE_BLENDS,
    SAMPLING_SETUP = RG_CODE_SETUP | RG_CODE_SAMPLERS,
    SAMPLING_PASS = RG_CODE_PASSES | RG_CODE_SAMPLERS
};

// Forms of kinds; of each kind those of more ways come first.
static const struct {
    enum rg_code_kind kind;
    unsigned ways; // all of these
    enum rg_code_kind form;
} forms[] = {
    {RG_CODE_GLSL, RG_CODE_SAMPLERS, RG_CODE_NATIVE_GLSL},
    {RG_CODE_SPIRV, RG_CODE_SAMPLERS, RG_CODE_NATIVE_SPIRV},
    {RG_CODE_SPIRV, RG_CODE_ROUNDS, RG_CODE_ROUNDED_SPIRV},
    {RG_CODE_VERTEX_GLSL, RG_CODE_PASSES, RG_CODE_PASS_VERTEX_GLSL},
    {RG_CODE_VERTEX_SPIRV, RG_CODE_PASSES, RG_CODE_PASS_VERTEX_SPIRV},
    {RG_CODE_FRAGMENT_GLSL, SAMPLING_PASS, RG_CODE_NATIVE_FRAGMENT_GLSL},
    {RG_CODE_FRAGMENT_SPIRV, SAMPLING_PASS, RG_CODE_NATIVE_FRAGMENT_SPIRV},
    {RG_CODE_FRAGMENT_GLSL, RG_CODE_PASSES, RG_CODE_PASS_FRAGMENT_GLSL},
    {RG_CODE_FRAGMENT_SPIRV, RG_CODE_PASSES, RG_CODE_PASS_FRAGMENT_SPIRV},
    {RG_CODE_VERTEX_GLSL, RG_CODE_SETUP, RG_CODE_NATIVE_VERTEX_GLSL},
    {RG_CODE_VERTEX_SPIRV, RG_CODE_SETUP, RG_CODE_NATIVE_VERTEX_SPIRV},
    {RG_CODE_VERTEX_SPIRV, RG_CODE_ROUNDS, RG_CODE_ROUNDED_VERTEX_SPIRV},
    {RG_CODE_FRAGMENT_GLSL, SAMPLING_SETUP, RG_CODE_NATIVE_FRAGMENT_GLSL},
    {RG_CODE_FRAGMENT_SPIRV, SAMPLING_SETUP, RG_CODE_NATIVE_FRAGMENT_SPIRV},
    {RG_CODE_FRAGMENT_GLSL, RG_CODE_SETUP, RG_CODE_SETUP_FRAGMENT_GLSL},
    {RG_CODE_FRAGMENT_SPIRV, RG_CODE_SETUP, RG_CODE_SETUP_FRAGMENT_SPIRV},
    {RG_CODE_FRAGMENT_GLSL, RG_CODE_SAMPLERS, RG_CODE_SAMPLERS_FRAGMENT_GLSL},
    {RG_CODE_FRAGMENT_SPIRV, RG_CODE_SAMPLERS, RG_CODE_SAMPLERS_FRAGMENT_SPIRV},
    {RG_CODE_FRAGMENT_SPIRV, ROUNDS_AND_BLENDS, RG_CODE_ROUNDED_BLENDED_FRAGMENT_SPIRV},
    {RG_CODE_FRAGMENT_SPIRV, RG_CODE_BLENDS, RG_CODE_BLENDED_FRAGMENT_SPIRV},
    {RG_CODE_FRAGMENT_SPIRV, RG_CODE_ROUNDS, RG_CODE_ROUNDED_FRAGMENT_SPIRV},
};

// The form of a kind for programs of these ways; one without a form of its own is the kind itself.
static enum rg_code_kind kind_of(enum rg_code_kind kind, unsigned ways)
{
    for (size_t i = 0; i < sizeof(forms) / sizeof(forms[0]); i++)
        if (forms[i].kind == kind && (ways & forms[i].ways) == forms[i].ways)
            return forms[i].form;
    return kind;
}

// Inserts a line after the first one of GLSL, which is its version.
static bool insert(const struct rg_kernel *kernel, const char *line, struct rg_kernel_code *code)
{
    const size_t added = strlen(line);
    const unsigned char *end = code->size ? memchr(code->bytes, '\n', code->size) : NULL;
    if (!end)
        return true;
    const size_t first = (size_t)(end - code->bytes) + 1;
    unsigned char *text = rg_alloc(1, code->size + added, kernel->name);
    if (text) {
        memcpy(text, code->bytes, first);
        memcpy(text + first, line, added);
        memcpy(text + first + added, code->bytes + first, code->size - first);
    }
    free(code->bytes);
    *code = (struct rg_kernel_code){text, text ? code->size + added : 0};
    return text;
}

static bool is_glsl(enum rg_code_kind kind)
{
    return kind == RG_CODE_GLSL || kind == RG_CODE_VERTEX_GLSL || kind == RG_CODE_FRAGMENT_GLSL;
}

bool rg_embedded_code(const struct rg_embedded_code *embedded, const char *name,
                      struct rg_kernel_code *code)
{
    *code = (struct rg_kernel_code){0};
    if (!embedded->size)
        return true;
    struct libdeflate_decompressor *inflater = libdeflate_alloc_decompressor();
    unsigned char *bytes = inflater ? rg_alloc(1, embedded->size, name) : NULL;
    const bool ok =
        bytes && !libdeflate_zlib_decompress(inflater, embedded->bytes, embedded->packed_size,
                                             bytes, embedded->size, NULL);
    libdeflate_free_decompressor(inflater);
    if (ok)
        *code = (struct rg_kernel_code){bytes, embedded->size};
    else
        free(bytes);
    return ok || rg_error("kernel '%s': the code in this program is damaged; build it again", name);
}

static bool read_code(const char *folder, const struct rg_kernel *kernel, enum rg_code_kind kind,
                      struct rg_kernel_code *code)
{
#define RG_CODE_ENDING(kind, ending) ending,
    static const char *const endings[RG_CODE_COUNT] = {RG_CODE_KINDS(RG_CODE_ENDING)};
    char path[4096];
    snprintf(path, sizeof(path), "%s/%s.%s", folder, kernel->name, endings[kind]);
    const char *why;
    FILE *file = rg_file_open(path, &why);
    code->bytes = file ? read_whole(file, &code->size) : NULL;
    if (file)
        fclose(file);
    return code->bytes ||
           rg_error("%s: cannot be read; RG_KERNEL_DIR must hold every kernel, as build/kernels "
                    "does",
                    path);
}

bool rg_kernel_code(const struct rg_kernel *kernel, enum rg_code_kind kind, unsigned ways,
                    struct rg_kernel_code *code)
{
    const char *folder = rg_kernel_override();
    const enum rg_code_kind found = kind_of(kind, ways);
    if (folder ? !read_code(folder, kernel, found, code)
               : !rg_embedded_code(&kernel->code[found], kernel->name, code))
        return false;
    if ((ways & RG_CODE_SETUP) && !(ways & RG_CODE_PLACES) && kind == RG_CODE_FRAGMENT_GLSL &&
        !insert(kernel, "#define RG_COMPUTES_PLACES\n", code))
        return false;
    if ((ways & RG_CODE_BLENDS) && kind == RG_CODE_FRAGMENT_GLSL &&
        !insert(kernel, "#define RG_BLENDS\n", code))
        return false;
    return !(ways & RG_CODE_ROUNDS) || !is_glsl(kind) ||
           insert(kernel, "#define RG_ROUNDED\n", code);
}
