// raingauge atlas: makes the streak atlas, packs the original database, or makes a technique's
// textures; describes and exports them.
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/scene/atlas/cache.h"
#include "core/scene/atlas/cave/cave.h"
#include "core/scene/atlas/levels.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/commands/drawing/atlas/compare.h"
#include "harness/commands/drawing/atlas/export.h"
#include "harness/commands/drawing/atlas/textures.h"
#include "harness/console/clock.h"
#include "harness/console/progress.h"
#include "harness/record/named.h"
#include "harness/record/output.h"

struct atlas_options {
    struct rg_length length;
    char *from, *compare, *output; // folders
    bool measured, json;
};

#define AT(field) offsetof(struct atlas_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to make"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about =
         "a technique whose textures to make, such as cartoon; without a name, the streak atlas",
     .names = RG_NAMES_TECHNIQUE, .first = 1, .last = 1},
    RG_INCLUDE(rg_length_options, AT(length), NULL),
    {RG_OPTION_FLAG, "measured",
     .about = "draws drops that oscillate as in wind tunnels, not as in the original database",
     .offset = AT(measured), .excludes = "from"},
    {RG_OPTION_TEXT, "from", .argument = "DIR",
     .about = "packs the original streak database of this folder, instead of generating an atlas",
     .offset = AT(from), .names = RG_NAMES_FOLDER},
    {RG_OPTION_TEXT, "compare", .argument = "DIR",
     .about = "compares the atlas with the original database's pictures in this folder, and prints "
              "how similar they are",
     .offset = AT(compare), .names = RG_NAMES_FOLDER},
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "writes the textures into this folder, as EXR and PNG files", .offset = AT(output),
     .letter = 'o', .names = RG_NAMES_FOLDER},
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

// Lower bounds of the files' sizes: 14 MB of the small atlas, 89 of the full one and 0.9 of
// cartoon's textures were written.
enum { SMALL_BYTES = 4 << 20, FULL_BYTES = 40 << 20, TEXTURES_BYTES = 1 << 18 };

// Whether the files can be written; asked before tracing an atlas, which takes minutes.
static bool can_be_kept(const struct atlas_options *o, int64_t bytes)
{
    return !o->output || rg_output_can_be_written(o->output, bytes);
}

// An atlas and its origin.
struct found {
    struct rg_atlas *atlas;
    const char *from; // "cache", "made" or "database"
    double seconds;   // time that this took
    char path[RG_ATLAS_PATH_SIZE];
    bool kept;
};

static void tell(void *user, int done, int total)
{
    struct rg_progress *progress = user;
    progress->total = total;
    rg_progress_add(progress, done - progress->done);
}

// Packs the database and stores the pack in the cache. A pack that cannot be stored is an error,
// because it is made for nothing else.
static struct rg_atlas *pack(const char *folder, enum rg_atlas_size size,
                             const struct rg_atlas_progress *tells)
{
    char why[256];
    struct rg_atlas *atlas = rg_cave_pack(folder, size, tells);
    if (!atlas || rg_atlas_cache_write(atlas, why))
        return atlas;
    rg_atlas_destroy(atlas);
    return rg_error_null("the packed database cannot be kept: %s", why);
}

// Gets the atlas. False, and one logged line, on failure.
static bool find(const struct atlas_options *o, struct found *found)
{
    char why[256];
    enum rg_atlas_cached state;
    const bool quick = o->length.quick;
    const enum rg_atlas_size large = o->from ? RG_ATLAS_CAVE : RG_ATLAS_FULL;
    const enum rg_atlas_size small = o->from ? RG_ATLAS_CAVE_SMALL : RG_ATLAS_SMALL;
    const enum rg_atlas_size plain = quick ? small : large;
    const enum rg_atlas_size size = o->measured ? rg_atlas_kinds[plain].measured : plain;
    const double start_ms = rg_now_ms();
    struct rg_progress progress;
    const struct rg_atlas_progress tells = {tell, &progress};
    *found = (struct found){.from = "cache"};
    if (!o->from)
        found->atlas = rg_atlas_cache_read(size, &state, why);
    if (!found->atlas) {
        rg_progress_start(&progress, 1);
        rg_progress_label(&progress, o->from ? "packing the database" : "tracing streaks");
        found->from = o->from ? "database" : "made";
        found->atlas = o->from ? pack(o->from, size, &tells) : rg_atlas_load(size, &tells);
        rg_progress_end(&progress);
    }
    found->seconds = (rg_now_ms() - start_ms) * 1e-3;
    found->kept = rg_atlas_cache_path(size, found->path, why) && !access(found->path, R_OK);
    return found->atlas != NULL;
}

static size_t bytes_of(const struct rg_atlas *atlas)
{
    size_t bytes = 0;
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++)
        bytes += rg_atlas_image_texels(&atlas->images[part]) * sizeof(uint16_t);
    return bytes;
}

static struct rg_atlas_range point_range(const struct rg_atlas *atlas)
{
    return rg_atlas_range(&atlas->point_factor[0][0][0][0],
                          sizeof(atlas->point_factor) / sizeof(float));
}

static struct rg_atlas_range env_range(const struct rg_atlas *atlas)
{
    return rg_atlas_range(&atlas->env_factor[0][0], sizeof(atlas->env_factor) / sizeof(float));
}

static void print_text(const struct found *found)
{
    const struct rg_atlas *atlas = found->atlas;
    const struct rg_atlas_range point = point_range(atlas), env = env_range(atlas);
    const bool cached = found->from[0] == 'c';
    printf("%s atlas, %s in %.1f s; %.1f MB, checksum %016llx\n", rg_atlas_kinds[atlas->size].name,
           cached                  ? "read"
           : found->from[0] == 'm' ? "made"
                                   : "packed",
           found->seconds, (double)bytes_of(atlas) * 1e-6, (unsigned long long)atlas->hash);
    printf("%s%s\n\n", found->kept ? "kept as " : "not kept", found->kept ? found->path : "");
    printf("%-8s%8s%8s%14s%14s%14s%14s\n", "image", "layers", "levels", "level 0 px", "texels",
           "least factor", "largest");
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++) {
        const struct rg_atlas_image *image = &atlas->images[part];
        char size[32];
        snprintf(size, sizeof(size), "%dx%d", image->width, image->height);
        printf("%-8s%8d%8d%14s%14zu", rg_atlas_part_names[part], image->layers, image->levels, size,
               rg_atlas_image_texels(image));
        if (part == RG_ATLAS_SPLASH)
            printf("\n");
        else
            printf("%14.4g%14.4g\n", part == RG_ATLAS_POINT ? point.least : env.least,
                   part == RG_ATLAS_POINT ? point.largest : env.largest);
    }
}

// The JSON of docs/records.md.
static void print_json(const struct found *found)
{
    const struct rg_atlas *atlas = found->atlas;
    const struct rg_atlas_range ranges[] = {point_range(atlas), env_range(atlas)};
    char hash[32];
    snprintf(hash, sizeof(hash), "%016llx", (unsigned long long)atlas->hash);
    json_t *images = json_array();
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++) {
        const struct rg_atlas_image *image = &atlas->images[part];
        json_t *row =
            json_pack("{sssisisisisI}", "name", rg_atlas_part_names[part], "width", image->width,
                      "height", image->height, "layers", image->layers, "levels", image->levels,
                      "texels", (json_int_t)rg_atlas_image_texels(image));
        if (part < 2) {
            json_object_set_new(row, "least_factor", json_real(ranges[part].least));
            json_object_set_new(row, "largest_factor", json_real(ranges[part].largest));
        }
        json_array_append_new(images, row);
    }
    json_t *json =
        json_pack("{sisssssfsosIssso}", "format", 1, "size", rg_atlas_kinds[atlas->size].name,
                  "from", found->from, "seconds", found->seconds, "file",
                  found->kept ? rg_json_text(found->path) : json_null(), "bytes",
                  (json_int_t)bytes_of(atlas), "hash", hash, "images", images);
    json_dumpf(json, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
    printf("\n");
    json_decref(json);
}

// --- textures of a technique ---

static void print_rows_text(const struct rg_texture_rows *rows)
{
    printf("%-24s%8s%8s\n", "texture", "side px", "levels");
    for (int i = 0; i < rows->count; i++)
        printf("%-24s%8d%8d\n", rows->items[i].name, rows->items[i].side_px, rows->items[i].levels);
}

// The JSON of docs/records.md.
static void print_rows_json(const struct rg_technique *technique,
                            const struct rg_texture_rows *rows)
{
    json_t *textures = json_array();
    for (int i = 0; i < rows->count; i++)
        json_array_append_new(textures,
                              json_pack("{sssisi}", "name", rows->items[i].name, "side_px",
                                        rows->items[i].side_px, "levels", rows->items[i].levels));
    json_t *json =
        json_pack("{sissso}", "format", 1, "technique", technique->name, "textures", textures);
    json_dumpf(json, stdout, JSON_INDENT(1));
    printf("\n");
    json_decref(json);
}

static int make_textures(const struct atlas_options *o, const char *name)
{
    struct rg_texture_rows rows;
    const struct rg_technique *technique = rg_subject_technique(name);
    if (!technique)
        return rg_exit_of_error();
    if (o->from || o->compare || o->measured || o->length.quick || o->length.full) {
        rg_error("atlas %s: --from, --compare, --measured, --quick and --full are about the streak "
                 "atlas; leave them out",
                 name);
        return rg_exit_of_error();
    }
    if (!can_be_kept(o, TEXTURES_BYTES) || !rg_textures_make(technique, o->output, &rows))
        return rg_exit_of_error();
    if (o->json)
        print_rows_json(technique, &rows);
    else
        print_rows_text(&rows);
    return RG_EXIT_PASS;
}

// Compares pictures of the database with the atlas's.
static bool compare(const struct atlas_options *o, const struct rg_atlas *atlas)
{
    struct rg_cave_comparison comparison;
    struct rg_progress progress;
    const struct rg_atlas_progress tells = {tell, &progress};
    rg_progress_start(&progress, 1);
    rg_progress_label(&progress, "comparing pictures");
    const bool good = rg_cave_compare(o->compare, atlas, &tells, &comparison);
    rg_progress_end(&progress);
    if (!good)
        return false;
    rg_cave_print(&comparison, atlas, o->compare, o->json);
    free(comparison.rows);
    return true;
}

static int atlas_command(const void *values, const struct rg_words *arguments)
{
    const struct atlas_options *o = values;
    if (arguments->count)
        return make_textures(o, arguments->items[0]);
    struct found found;
    if (!can_be_kept(o, o->length.quick ? SMALL_BYTES : FULL_BYTES) ||
        (o->compare && !rg_cave_has_pictures(o->compare)) || !find(o, &found))
        return rg_exit_of_error();
    const bool good = (!o->output || rg_atlas_export(found.atlas, o->output)) &&
                      (!o->compare || compare(o, found.atlas));
    const bool describes = good && !o->compare;
    if (describes && o->json)
        print_json(&found);
    else if (describes)
        print_text(&found);
    rg_atlas_destroy(found.atlas);
    return good ? RG_EXIT_PASS : rg_exit_of_error();
}

const struct rg_command rg_command_atlas = {
    .name = "atlas",
    .reader = RG_FOR_PAPERS,
    .usage =
        "[TECHNIQUE] [--quick|--full] [--measured] [--from DIR] [--compare DIR] [-o DIR] [--json]",
    .about = "makes, describes and exports the streak atlas or a technique's textures",
    .options = options,
    .options_size = sizeof(struct atlas_options),
    .run = atlas_command,
};
