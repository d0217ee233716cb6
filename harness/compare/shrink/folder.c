#include "harness/compare/shrink/folder.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/text/plain.h"
#include "harness/record/output.h"
#include "kernels/dialect/draw/state.h"

// kernel.txt uses Vulkan's numbers, so that run.c need not know raingauge's enums.
enum { GROUP_ITEMS = 64 }; // as in shaders/grid.glsl
enum { SAMPLED_IMAGE = 1, STORED_IMAGE = 3, UNIFORM_BLOCK = 6, STORAGE_BUFFER = 7, TARGET = 10 };
enum { COLOUR_ASPECT = 1, DEPTH_ASPECT = 2 };
enum { VIEW_OF_CUBE = 3, VIEW_OF_LAYERS = 5 };
enum { NEAREST, LINEAR };
enum { REPEATED = 0, CLAMPED = 2 };
enum { NOT_COMPARED = 0, LESS_OR_EQUAL = 3 };
enum { FACTOR_ONE = 1, FACTOR_ONE_MINUS_ALPHA = 7, CULLS_FRONT = 1, CULLS_BACK = 2 };
static const int vulkan_formats[RG_FORMAT_COUNT] = {
    [RG_RGBA8] = 37, [RG_RGBA16F] = 97,   [RG_RGBA32F] = 109, [RG_R32F] = 100,
    [RG_R16F] = 76,  [RG_RG11B10F] = 122, [RG_D32F] = 126,
};

extern const char rg_text_run_grid[], rg_text_run_draw[], rg_text_run_gl[];

struct folder {
    char path[2048];
    const struct rg_culprit *culprit;
    bool draws, by_gl; // a draw on a device of OpenGL is run by OpenGL, all else by Vulkan
    const struct rg_slot_info *texels; // of a GRID kernel, which are drawn; NULL: no such draw
    int count;
    struct rg_output_file files[RG_MAX_OUTPUT_FILES];
    char names[RG_MAX_OUTPUT_FILES][64];
    void *owned[RG_MAX_OUTPUT_FILES];
};

static void add(struct folder *f, const char *name, const void *bytes, size_t size, void *owned)
{
    const int at = f->count++;
    snprintf(f->names[at], sizeof(f->names[at]), "%s", name);
    f->files[at] = (struct rg_output_file){f->names[at], bytes, size};
    f->owned[at] = owned;
}

// --- the contents ---

static bool add_code(struct folder *f, struct rg_device *device, enum rg_code_kind kind,
                     const char *name, size_t *size)
{
    void *code = rg_digests_code(device, f->culprit->due.kernel, kind, size);
    if (code)
        add(f, name, code, *size, code);
    return code;
}

// Adds the parts of `bytes` that differ from `before`; NULL: from zero. Parts are joined if the gap
// between them is smaller than a part's header.
static bool add_parts(struct folder *f, const char *name, const unsigned char *bytes,
                      const unsigned char *before, size_t size)
{
    enum { HEAD = 8 };
    char *parts = NULL;
    size_t parts_size;
    FILE *out = open_memstream(&parts, &parts_size);
    for (size_t at = 0; out && at < size;) {
        size_t end = at;
        for (size_t i = at; i < size && i < end + HEAD; i++)
            end = bytes[i] != (before ? before[i] : 0) ? i + 1 : end;
        if (end > at) {
            const uint32_t head[2] = {(uint32_t)at, (uint32_t)(end - at)};
            fwrite(head, sizeof(head), 1, out);
            fwrite(bytes + at, 1, end - at, out);
        }
        at = end > at ? end : at + 1;
    }
    const bool ok =
        (out && fclose(out) == 0) || rg_harness_error("%s: no memory for its files", f->path);
    if (ok)
        add(f, name, parts, parts_size, parts);
    else
        free(parts);
    return ok;
}

// Adds the uniform block of binding 0: the first item and the end, four ints each, then the
// kernel's parameters, padded as in std140. A draw's state comes before its parameters.
static bool add_block(struct folder *f, size_t *size)
{
    const struct rg_dispatched *d = &f->culprit->due;
    const int at[8] = {d->origin.width,
                       d->origin.height,
                       d->origin.depth,
                       0,
                       d->origin.width + d->extent.width,
                       d->origin.height + d->extent.height,
                       d->origin.depth + d->extent.depth,
                       0};
    const int params_size = d->kernel->draw ? d->kernel->draw->call_size : d->kernel->params_size;
    *size = (sizeof(at) + (size_t)params_size + 15) / 16 * 16;
    unsigned char *block = rg_alloc(1, *size, "a kernel's parameters");
    if (!block)
        return false;
    memcpy(block, at, sizeof(at));
    memcpy(block + sizeof(at), d->params, (size_t)params_size);
    if (d->kernel->draw) { // its state begins with the items
        memcpy(block + sizeof(at), &at[0], sizeof(int));
        memcpy(block + sizeof(at) + sizeof(int), &at[4], sizeof(int));
    }
    const bool ok = add_parts(f, "00-block.before", block, NULL, *size);
    free(block);
    return ok;
}

static bool filters_depth(const struct rg_device *device)
{
    return device->info.limits.formats[RG_D32F].uses & RG_USE_FILTER;
}

// How the device's shader reads an image: as backends/vulkan/api/sampler.c has it.
static void write_sampler(FILE *out, const struct rg_device *device,
                          const struct rg_slot_info *slot, enum rg_format format)
{
    const enum rg_sampler how =
        device->info.features & RG_FEATURE_SAMPLERS && format ? slot->sampler : RG_TEXELS;
    const bool compares = how == RG_SAMPLED_SHADOW;
    const bool filters = compares ? filters_depth(device) : how != RG_TEXELS;
    fprintf(out, "view %d filter %d wrap %d compare %d ",
            !format                  ? 0
            : how == RG_SAMPLED_CUBE ? VIEW_OF_CUBE
                                     : VIEW_OF_LAYERS,
            filters ? LINEAR : NEAREST, !format || how == RG_SAMPLED_TILED ? REPEATED : CLAMPED,
            compares ? LESS_OR_EQUAL : NOT_COMPARED);
}

static bool is_target(const struct folder *f, const struct rg_slot_info *slot)
{
    return f->draws && (f->texels ? slot->slot == f->texels->slot
                                  : slot->slot == RG_SLOT_COLOUR || slot->slot == RG_SLOT_DEPTH);
}

static void write_slot(FILE *out, const struct folder *f, const struct rg_device *device,
                       const struct rg_slot_info *slot, const struct rg_contents *c,
                       const char *before, const char *expected)
{
    const struct rg_image_desc *image = &c->desc;
    const bool written = rg_slot_is_written(slot->kind), is_image = image->levels > 0;
    fprintf(out, "slot %d type %d format %d aspect %d texel %d size %d x %d layers %d levels %d ",
            slot->slot,
            !is_image            ? STORAGE_BUFFER
            : is_target(f, slot) ? TARGET
            : written            ? STORED_IMAGE
                                 : SAMPLED_IMAGE,
            is_image ? vulkan_formats[image->format] : 0,
            !is_image                  ? 0
            : image->format == RG_D32F ? DEPTH_ASPECT
                                       : COLOUR_ASPECT,
            is_image ? rg_format_size(image->format) : 0, image->width, image->height,
            image->layers, image->levels);
    write_sampler(out, device, slot, is_image ? image->format : RG_FORMAT_NONE);
    fprintf(out, "bytes %zu %s %s # %s, ", c->size, before, expected, slot->name);
    if (is_image)
        fprintf(out, "an image of %s, ", rg_format_name(image->format));
    else
        fprintf(out, "%zu elements of %d bytes, ", c->size / (size_t)slot->element_size,
                slot->element_size);
    fprintf(out, "%s\n",
            !written                                                      ? "read"
            : slot->kind == RG_SLOT_INOUT || slot->kind == RG_SLOT_ATOMIC ? "read and written"
                                                                          : "written");
}

// Adds what fragments would count samples by: no draw here counts any, but their slots are bound.
static bool add_uncounted(struct folder *f, const struct rg_device *device, FILE *manifest)
{
    static unsigned char zeros[4];
    const struct rg_contents none[] = {{{0}, sizeof(zeros), zeros},
                                       {{RG_D32F, 1, 1, 1, 1}, sizeof(zeros), zeros}};
    const struct rg_slot_info slots[] = {
        {.name = "samples", .slot = RG_SLOT_SAMPLES, .kind = RG_SLOT_IN, .element_size = 4},
        {.name = "behind", .slot = RG_SLOT_BEHIND, .kind = RG_SLOT_IMAGE, .format = RG_D32F}};
    bool ok = true;
    for (int i = 0; ok && i < 2; i++) {
        char name[64];
        snprintf(name, sizeof(name), "%02d-%s.before", slots[i].slot, slots[i].name);
        ok = add_parts(f, name, zeros, NULL, sizeof(zeros));
        write_slot(manifest, f, device, &slots[i], &none[i], name, "-");
    }
    return ok;
}

static bool add_slots(struct folder *f, const struct rg_device *device, FILE *manifest)
{
    const struct rg_dispatched *d = &f->culprit->due;
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = rg_dispatched_slots(d, slots);
    bool ok = !d->kernel->draw || add_uncounted(f, device, manifest);
    for (int i = 0; ok && i < count; i++) {
        const struct rg_slot_info *slot = &slots[i];
        const struct rg_contents *before = &d->before[slot->slot], *after = &d->after[slot->slot];
        char name[64], expected[64] = "-";
        snprintf(name, sizeof(name), "%02d-%.40s.before", slot->slot, slot->name);
        ok = add_parts(f, name, before->bytes, NULL, before->size);
        if (rg_slot_is_written(slot->kind)) {
            snprintf(expected, sizeof(expected), "%02d-%.40s.expected", slot->slot, slot->name);
            ok = ok && add_parts(f, expected, after->bytes, before->bytes, after->size);
        }
        write_slot(manifest, f, device, slot, before, name, expected);
    }
    return ok;
}

// Says what is drawn, in Vulkan's numbers.
static void write_draw(const struct rg_dispatched *d, FILE *out)
{
    const rg_draw_state *state = (const rg_draw_state *)(const void *)d->params;
    fprintf(
        out,
        "# blend: the target's VkBlendFactor, 0 if none; the source's is 1. depth: 1 it is tested, "
        "2 and\n# written. cull: VkCullModeFlagBits. points: 1 a point is drawn for each item, 0 a "
        "triangle.\n"
        "draw first %d items %d blend %d depth %d cull %d scissor %d %d %d %d target %d x %d "
        "layer %d level %d points 1\n",
        d->origin.width, d->extent.width,
        state->blend == RG_BLEND_OFF    ? 0
        : state->blend == RG_BLEND_OVER ? FACTOR_ONE_MINUS_ALPHA
                                        : FACTOR_ONE,
        d->has_depth ? state->depth_mode : 0,
        state->cull == RG_CULL_NONE   ? 0
        : state->cull == RG_CULL_BACK ? CULLS_BACK
                                      : CULLS_FRONT,
        state->x0, state->y0, state->x1 - state->x0, state->y1 - state->y0, state->width,
        state->height, d->layer, d->level);
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

// Says that one triangle is drawn over the items' texels. A native device's run of them has one
// layer (core/device/grid.c).
static void write_texels(const struct rg_dispatched *d, const struct rg_slot_info *texels,
                         FILE *out)
{
    const struct rg_image_desc *image = &d->before[texels->slot].desc;
    const struct rg_extent *from = &d->origin;
    fprintf(out,
            "# A triangle is drawn over the target, and the scissor has the items' texels.\n"
            "draw first 0 items 3 blend 0 depth 0 cull 0 scissor %d %d %d %d target %d x %d layer "
            "%d level 0 points 0\n",
            from->width, from->height, smaller(d->extent.width, image->width - from->width),
            smaller(d->extent.height, image->height - from->height), image->width, image->height,
            d->kernel->layer(d->params, from->depth));
}

static void write_run(const struct folder *f, FILE *out)
{
    const struct rg_dispatched *d = &f->culprit->due;
    if (f->texels)
        write_texels(d, f->texels, out);
    else if (d->kernel->draw)
        write_draw(d, out);
    else
        fprintf(out, "# groups: of %d items along x.\ngroups %d %d %d\n", GROUP_ITEMS,
                (d->extent.width + GROUP_ITEMS - 1) / GROUP_ITEMS, d->extent.height,
                d->extent.depth);
}

static bool write_manifest(struct folder *f, const struct rg_device *device, FILE *out,
                           size_t block_size)
{
    const struct rg_dispatched *d = &f->culprit->due;
    fprintf(out,
            "# One run of the %s %s, of %lld items of %lld: from (%d, %d, %d) on,\n"
            "# %d x %d x %d. README says how to run it.\n",
            f->draws ? "draw" : "compute shader", d->kernel->name, (long long)f->culprit->items,
            (long long)f->culprit->of_items, d->origin.width, d->origin.height, d->origin.depth,
            d->extent.width, d->extent.height, d->extent.depth);
    write_run(f, out);
    fprintf(
        out,
        "# constants: what specialization constants 0 and 1 are.\n"
        "constants %d %d\n"
        "# slot: the binding, of set 0. type: 1 sampled image, 3 stored image, 6 uniform block,\n"
        "# 7 storage buffer (VkDescriptorType), 10 a target of the draw, which is not bound. "
        "format: "
        "VkFormat;\n# aspect: VkImageAspectFlagBits; texel: its "
        "bytes. An image has all layers of level 0, then of level 1,\n# rows without padding. "
        "view, "
        "filter, wrap, compare: as VkImageViewType, VkFilter,\n# VkSamplerAddressMode, and "
        "VkCompareOp or 0.\n"
        "# Last the files: what it holds before, and what is expected after the run. Each has "
        "parts of it:\n"
        "# where the part begins and how many bytes it has, of 4 bytes each, and these bytes. What "
        "no part\n"
        "# has is 0 before the run, and after it as it was before.\n",
        filters_depth(device), (device->info.features & RG_FEATURE_PLACES) != 0);
    fprintf(out,
            "slot 0 type %d format 0 aspect 0 texel 0 size 0 x 0 layers 0 levels 0 "
            "view 0 filter 0 wrap 0 compare 0 bytes %zu 00-block.before - # the first item and the "
            "end, 4 ints each, then the parameters\n",
            UNIFORM_BLOCK, block_size);
    return add_slots(f, device, out);
}

static const char *command_of(bool draws, bool by_gl)
{
    return draws && by_gl ? "cc run.c -lEGL -lGL -o run && ./run"
                          : "cc run.c -lvulkan -o run && ./run";
}

// Says what the files of code are.
static const char *texts_of(const struct folder *f)
{
    if (f->by_gl)
        return "kernel.vert, kernel.frag and kernel.geom, if there is one, are the stages.\n";
    if (f->draws)
        return "kernel.vert, kernel.frag and kernel.geom, if there is one, are the stages' texts, "
               "of which\n\n"
               "    glslc --target-env=vulkan1.2 -O kernel.vert -o kernel.vert.spv\n\n"
               "and the same of the others make the code.\n";
    return "kernel.comp is the shader's text, of which\n\n"
           "    glslc -fshader-stage=compute --target-env=vulkan1.2 -O kernel.comp -o "
           "kernel.spv\n\n"
           "makes kernel.spv. kernel.cl is the same kernel in OpenCL C, which has its slots and "
           "parameters as arguments.\n";
}

static void write_readme(const struct folder *f, FILE *out, const char *note,
                         const struct rg_device_info *device, const struct rg_device_info *truth)
{
    char names[2][RG_DEVICE_NAME_SIZE];
    snprintf(names[0], sizeof(names[0]), "%s", device->name);
    snprintf(names[1], sizeof(names[1]), "%s", truth->name);
    rg_plain(names[0]);
    rg_plain(names[1]);
    fprintf(out,
            "The %s %s leaves other bits on %s\n(%s, %s, %s)\nthan on %s, which is "
            "held for the "
            "truth. raingauge found it as\n\n    %s\n\n",
            f->draws ? "draw" : "compute shader", f->culprit->due.kernel->name, names[0],
            device->device, device->driver, device->api, names[1], note);
    fprintf(
        out,
        "Nothing of raingauge is needed to run it, but a C compiler and %s with its headers:\n\n"
        "    %s [--device N]\n\n"
        "Devices count from 0, as %s lists them. Exit status: 0 it leaves what is\n"
        "expected, 1 it does not, and the first byte that differs is printed, 2 something "
        "failed,\n"
        "77 there is no such device.\n\n"
        "kernel.txt says what is bound where, in Vulkan's numbers; %s",
        f->by_gl ? "libglvnd" : "the Vulkan loader", command_of(f->draws, f->by_gl),
        f->by_gl ? "eglQueryDevicesEXT" : "`vulkaninfo --summary`", texts_of(f));
}

// --- writing ---

static bool add_codes(struct folder *f, struct rg_device *device)
{
    static const struct {
        enum rg_code_kind kind;
        const char *name;
        bool is_of_draw, is_of_vulkan, is_of_items;
    } codes[] = {
        {RG_CODE_SPIRV, "kernel.spv", false, false, false},
        {RG_CODE_GLSL, "kernel.comp", false, false, false},
        {RG_CODE_OPENCL, "kernel.cl", false, false, false},
        {RG_CODE_VERTEX_SPIRV, "kernel.vert.spv", true, true, false},
        {RG_CODE_VERTEX_GLSL, "kernel.vert", true, false, false},
        {RG_CODE_NATIVE_GEOMETRY_SPIRV, "kernel.geom.spv", true, true, true},
        {RG_CODE_NATIVE_GEOMETRY_GLSL, "kernel.geom", true, false, true},
        {RG_CODE_FRAGMENT_SPIRV, "kernel.frag.spv", true, true, false},
        {RG_CODE_FRAGMENT_GLSL, "kernel.frag", true, false, false},
    };
    bool ok = true;
    size_t size;
    for (size_t i = 0; ok && i < sizeof(codes) / sizeof(codes[0]); i++)
        ok = codes[i].is_of_draw != f->draws || (codes[i].is_of_vulkan && f->by_gl) ||
             (codes[i].is_of_items && f->texels) ||
             add_code(f, device, codes[i].kind, codes[i].name, &size);
    return ok;
}

static bool fill(struct folder *f, const char *note, struct rg_device *device,
                 const struct rg_device *truth)
{
    size_t size, block_size;
    char *texts[2] = {NULL, NULL};
    if (!add_codes(f, device) || !add_block(f, &block_size))
        return false;
    bool ok = true;
    for (int i = 0; ok && i < 2; i++) {
        FILE *out = open_memstream(&texts[i], &size);
        if (out && i == 0)
            ok = write_manifest(f, device, out, block_size);
        else if (out)
            write_readme(f, out, note, &device->info, &truth->info);
        ok = ((out && fclose(out) == 0) ||
              rg_harness_error("%s: no memory for its texts", f->path)) &&
             ok;
        if (texts[i])
            add(f, i == 0 ? "kernel.txt" : "README", texts[i], 0, texts[i]);
    }
    add(f, "run.c",
        f->by_gl   ? rg_text_run_gl
        : f->draws ? rg_text_run_draw
                   : rg_text_run_grid,
        0, NULL);
    return ok;
}

// Whether a file name is one that such a folder may contain.
static bool is_known(const char *name)
{
    static const char *const all[] = {"kernel.spv",      "kernel.comp",     "kernel.cl",
                                      "kernel.txt",      "README",          "run.c",
                                      "kernel.vert.spv", "kernel.vert",     "kernel.geom.spv",
                                      "kernel.geom",     "kernel.frag.spv", "kernel.frag"};
    const char *point = strrchr(name, '.');
    for (size_t i = 0; i < sizeof(all) / sizeof(*all); i++)
        if (!strcmp(name, all[i]))
            return true;
    return isdigit((unsigned char)name[0]) && isdigit((unsigned char)name[1]) && name[2] == '-' &&
           point && (!strcmp(point, ".before") || !strcmp(point, ".expected"));
}

// Removes files of an earlier case, and the folder if it is empty then.
static void remove_stale(const struct folder *f)
{
    char path[sizeof(f->path) + 256];
    DIR *folder = opendir(f->path);
    for (struct dirent *entry = NULL; folder && (entry = readdir(folder));) {
        bool stays = !is_known(entry->d_name);
        for (int i = 0; i < f->count; i++)
            stays = stays || !strcmp(entry->d_name, f->names[i]);
        snprintf(path, sizeof(path), "%s/%s", f->path, entry->d_name);
        if (!stays)
            unlink(path);
    }
    if (folder)
        closedir(folder);
    if (!f->count)
        rmdir(f->path);
}

static struct folder *open_folder(const char *path, const struct rg_culprit *culprit)
{
    struct folder *f = rg_alloc(1, sizeof(*f), "a kernel's folder");
    if (!f)
        return NULL;
    f->culprit = culprit;
    if (snprintf(f->path, sizeof(f->path), "%s.kernel", path) < (int)sizeof(f->path))
        return f;
    free(f);
    return rg_error_null("%.80s...: its name is too long", path);
}

// Whether a device's drivers take the stages as texts. A worker's backend is known by its name.
static bool takes_glsl(const struct rg_device *device)
{
    return rg_backend_of(device->backend->name)->takes_glsl;
}

const char *rg_kernel_folder_command(const struct rg_culprit *culprit,
                                     const struct rg_device *device)
{
    const bool draws = rg_is_drawn(device, culprit->due.kernel);
    return command_of(draws, draws && takes_glsl(device));
}

bool rg_kernel_folder_write(const char *path, const struct rg_culprit *culprit, const char *note,
                            struct rg_device *device, const struct rg_device *truth)
{
    struct folder *f = open_folder(path, culprit);
    if (f) {
        const struct rg_kernel *kernel = culprit->due.kernel;
        f->draws = rg_is_drawn(device, kernel);
        f->texels = f->draws ? rg_kernel_target(kernel) : NULL;
        f->by_gl = f->draws && takes_glsl(device);
    }
    const bool ok =
        f && fill(f, note, device, truth) && rg_output_write_set(f->path, f->files, f->count);
    if (ok)
        remove_stale(f);
    for (int i = 0; f && i < f->count; i++)
        free(f->owned[i]);
    free(f);
    return ok;
}

void rg_kernel_folder_remove(const char *path)
{
    struct folder *f = open_folder(path, NULL);
    if (f)
        remove_stale(f);
    free(f);
}
