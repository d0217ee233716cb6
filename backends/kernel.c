#include "backends/kernel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"

const struct rg_slot_info rg_drawn_slots[RG_DRAWN_SLOTS] = {
    {"packed primitives", RG_SLOT_PRIMS, RG_SLOT_IN, 4, RG_FORMAT_NONE},
    {"visible samples", RG_SLOT_SAMPLES, RG_SLOT_ATOMIC, 4, RG_FORMAT_NONE},
    {"depth behind", RG_SLOT_BEHIND, RG_SLOT_IMAGE, 0, RG_D32F},
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

bool rg_kernel_code(const struct rg_kernel *kernel, enum rg_code_kind kind,
                    struct rg_kernel_code *code, void **owned)
{
    static const char *const extensions[RG_CODE_COUNT] = {"glsl",     "spv",  "cl",      "vert",
                                                          "vert.spv", "frag", "frag.spv"};
    *owned = NULL;
    *code = kernel->code[kind];
    const char *folder = rg_kernel_override();
    if (!folder)
        return true;
    char path[4096];
    snprintf(path, sizeof(path), "%s/%s.%s", folder, kernel->name, extensions[kind]);
    const char *why;
    FILE *file = rg_file_open(path, &why);
    unsigned char *bytes = file ? read_whole(file, &code->size) : NULL;
    if (file)
        fclose(file);
    if (!bytes)
        return rg_error(
            "%s: cannot be read; RG_KERNEL_DIR must hold every kernel, as build/kernels "
            "does",
            path);
    code->bytes = *owned = bytes;
    return true;
}
