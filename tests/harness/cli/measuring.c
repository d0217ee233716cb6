// What the commands that measure and draw ask for, by each of their options.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/scene/atlas/cache.h"
#include "core/scene/atlas/cave/cave.h"
#include "core/scene/atlas/levels.h"
#include "harness/commands/drawing/atlas/textures.h"
#include "harness/compare/shrink/case.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/devices/frames/frame.h"
#include "harness/devices/frames/sequence.h"
#include "harness/devices/frames/trace.h"
#include "harness/report/page.h"
#include "harness/tables/figures/figures.h"
#include "harness/tables/own/estimate.h"
#include "harness/tables/papers/papers.h"
#include "harness/tables/runs/compile.h"
#include "harness/tables/runs/regenerate.h"
#include "tests/harness/cli/asked.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

static void note_tables(const struct rg_table *const tables[], int count)
{
    int all = 0;
    while (rg_tables[all])
        all++;
    if (count == all)
        asked_note("all tables from %s to %s ", tables[0]->id, tables[count - 1]->id);
    for (int i = 0; i < count && count < all; i++)
        asked_note("%s ", tables[i]->id);
    if (!rg_table_find(tables[0]->id))
        asked_note("(%d rows of %dx%d after %d frames) ", tables[0]->row_count, tables[0]->width,
                   tables[0]->height, tables[0]->check_frames);
}

int rg_tables_regenerate(const struct rg_table *const tables[], int count,
                         const struct rg_devices *devices, const struct rg_regenerate_options *o)
{
    note_tables(tables, count);
    char launches[32] = "";
    if (o->launches)
        snprintf(launches, sizeof(launches), ", %d launches", o->launches);
    asked_note("rows %d-%d%s%s%s, work %s, variant %s, set %s, %g s, into %s, on %d; ",
               o->first_row, o->last_row, o->full ? ", full" : "", o->fresh ? ", fresh" : "",
               o->decides ? ", launches" : launches, asked_text(o->work), asked_text(o->variant),
               asked_text(o->set), o->budget_s, asked_text(o->folder), devices->count);
    return RG_EXIT_INCONCLUSIVE;
}

int rg_tables_compile(const struct rg_table *const tables[], int count,
                      const struct rg_devices *devices)
{
    note_tables(tables, count);
    asked_note("compiled on %d; ", devices->count);
    return RG_EXIT_INCONCLUSIVE;
}

bool rg_plan_make(const struct rg_table *table, const char *set, bool is_full, struct rg_kept *kept,
                  struct rg_plan *plan)
{
    asked_note("plan %d rows, set %s%s, on %d; ", table->row_count, asked_text(set),
               is_full ? ", full" : "", kept->devices->count);
    *plan = (struct rg_plan){.rows = table->row_count};
    return true;
}

void rg_plan_print(const struct rg_plan *plan, const struct rg_devices *devices, FILE *out)
{
    fprintf(out, "%d rows on %d\n", plan->rows, devices->count);
}

bool rg_figures_draw(const struct rg_figure_run *run)
{
    asked_note("%d figures, the last %s, %dx%d into %s on %s; ", run->count,
               run->figures[run->count - 1]->id, run->width, run->height, run->folder,
               run->device->info.name);
    return true;
}

bool rg_trace_device(struct rg_trace *trace, struct rg_device *device,
                     const struct rg_subject *subject, int frames)
{
    asked_note_subject(subject);
    asked_note(", %d frames on %s; ", frames, device->info.name);
    trace->devices++;
    return true;
}

char *rg_trace_end(struct rg_trace *trace, const struct rg_device_info *infos, int count)
{
    asked_note("trace of %s to %s; ", infos[0].name, infos[count - 1].name);
    json_decref(trace->events);
    return strdup("{}");
}

static int session; // any address stands for one

struct rg_session *rg_frame_run(struct rg_device *device, const struct rg_subject *subject,
                                int frames)
{
    asked_note_subject(subject);
    asked_note(", frame %d on %s; ", frames, device->info.name);
    return (struct rg_session *)&session;
}

bool rg_frame_write(struct rg_session *of, const char *path, double exposure)
{
    assert_ptr_equal(of, &session);
    asked_note("write %s, exposure %g; ", path, exposure);
    return true;
}

struct rg_session *rg_sequence_run(const struct rg_sequence *s, struct rg_device *device)
{
    asked_note_subject(&s->subject);
    asked_note(", frames %d-%d into %s, %d a second, exposure %g on %s; ", s->first, s->last,
               s->path, s->fps, s->exposure, device->info.name);
    return (struct rg_session *)&session;
}

bool rg_session_tell(const struct rg_session *of, struct rg_account *account)
{
    (void)of;
    *account = (struct rg_account){.frame = 77,
                                   .counter_count = 1,
                                   .counters = {{"drops", 5}},
                                   .fact_count = 1,
                                   .facts = {{.name = "model", .text = "bunny\x1b"}}};
    return true;
}

void rg_session_close(struct rg_session *of)
{
    asked_note(of ? "end; " : "");
}

bool rg_case_read(const char *path, struct rg_case *found)
{
    asked_note("case %s; ", path);
    memset(found, 0, sizeof(*found));
    return true;
}

int rg_case_replay(const struct rg_case *found, const char *path, struct rg_device *device)
{
    (void)found;
    asked_note("replay %s on %s; ", path, device->info.name);
    return RG_EXIT_FAIL;
}

static bool is_cached; // the atlas, with factors of its own

double rg_now_ms(void)
{
    return 1000;
}

static struct rg_atlas *cached_atlas(void)
{
    struct rg_atlas *atlas = rg_atlas_allocate(RG_ATLAS_SMALL);
    assert_non_null(atlas);
    atlas->point_factor[0][0][0][0] = 2;
    atlas->point_factor[9][4][9][8] = 0.5f;
    atlas->env_factor[0][0] = 0.25f;
    atlas->env_factor[9][4] = 4;
    atlas->hash = 0xabc;
    return atlas;
}

struct rg_atlas *rg_atlas_cache_read(enum rg_atlas_size size, enum rg_atlas_cached *state,
                                     char why[256])
{
    asked_note("read %s; ", rg_atlas_kinds[size].name);
    *state = RG_ATLAS_ABSENT;
    *why = 0;
    return is_cached ? cached_atlas() : NULL;
}

struct rg_atlas *rg_atlas_load(enum rg_atlas_size size, const struct rg_atlas_progress *progress)
{
    (void)progress;
    asked_note("make %s; ", rg_atlas_kinds[size].name);
    return rg_error_null("stop");
}

struct rg_atlas *rg_cave_pack(const char *folder, enum rg_atlas_size size,
                              const struct rg_atlas_progress *progress)
{
    (void)progress;
    asked_note("pack %s as %s; ", folder, rg_atlas_kinds[size].name);
    return rg_error_null("stop");
}

bool rg_textures_make(const struct rg_technique *technique, const char *to,
                      struct rg_texture_rows *rows)
{
    asked_note("textures of %s into %s; ", technique->name, asked_text(to));
    *rows = (struct rg_texture_rows){2, {{"a", 8, 4}, {"b_and_more", 128, 7}}};
    return true;
}

bool rg_page_add(struct rg_page *page, const char *path)
{
    asked_note("%s %s%s; ", page->kept ? "add" : "before", path,
               page->kept && page->kept->count ? " with launches" : "");
    return true;
}

bool rg_page_write(const struct rg_page *page, const struct rg_page *before, const char *path)
{
    (void)page;
    asked_note("page %s%s; ", path, before ? " with changes" : "");
    return true;
}

char *rg_page_markdown(const struct rg_page *page)
{
    (void)page;
    return strdup("markdown");
}

char *rg_page_badge(const struct rg_page *page)
{
    (void)page;
    return strdup("badge");
}

// --- tables ---

#define USUAL "memory 0; open cpu, require -, 120 s; "
#define WHOLE "rows 0-0, work -, variant -, set -, 0 s, into -, on 2; close 2"

static void tables_are_asked_for(void **state)
{
    (void)state;
    static const struct {
        const char *line, *seen;
    } rows[] = {
        {"table creus-5.4 --device cpu", USUAL "creus-5.4 " WHOLE},
        {"table creus-5.4 ye-1 --device cpu --full --fresh",
         USUAL "creus-5.4 ye-1 rows 0-0, full, fresh, work -, variant -, set -, 0 s, into -, on 2; "
               "close 2"},
        {"table creus-5.4 --rows 2-3 --work ours --variant no_geometry --set seed=5 --set lights=2 "
         "-o out --device gl,cpu --require vulkan --timeout 7 --memory 2K",
         "memory 2048; open gl,cpu, require vulkan, 7 s; creus-5.4 rows 2-3, work ours, variant "
         "no_geometry, set seed=5 lights=2, 0 s, into out, on 2; close 2"},
        {"table --budget 4m --device cpu",
         USUAL "all tables from chin-timing to ye-1 rows 0-0, work -, variant -, set -, "
               "240 s, into -, on 2; close 2"},
        {"table --quick --variant no_geometry --device cpu",
         USUAL "creus-5.3 creus-5.4 creus-5.5 creus-5.6 rows 0-0, work -, variant no_geometry, set "
               "-, 0 s, "
               "into -, on 2; close 2"},
        {"table feng-1 --full --launches 3",
         "memory 0; open all, require -, 120 s; feng-1 rows 0-0, full, 3 launches, work -, variant "
         "-, set -, 0 s, into -, on 2; close 2"},
        {"table feng-1 --compile", "memory 0; open all, require -, 120 s; feng-1 compiled on 2; "
                                   "close 2"},
        {"claims creus-5.3 --device cpu --fresh --budget 8h -o out",
         USUAL "creus-5.3 rows 0-0, fresh, launches, work -, variant -, set -, 28800 s, into out, "
               "on 2; close 2"},
        {"claims creus-5.3 --full --memory 3K",
         "memory 3072; open all, require -, 120 s; creus-5.3 rows 0-0, full, launches, work -, "
         "variant -, set -, 0 s, into -, on 2; close 2"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        asked_expect(rows[i].line, rows[i].seen, RG_EXIT_INCONCLUSIVE);
}

static void sweeps_are_asked_for(void **state)
{
    (void)state;
    asked_expect("sweep flow --axis drops=10,20..40 --axis view=box,pane --set seed=3 --size 64x48 "
                 "--frame 7 --full --fresh -o out",
                 USUAL "sweep-flow (8 rows of 64x48 after 7 frames) rows 0-0, full, fresh, work -, "
                       "variant -, set seed=3, 0 s, into out, on 2; close 2",
                 RG_EXIT_INCONCLUSIVE);
    asked_expect("sweep flow --axis seed=1,2 --axis device=gl,cpu:reference --require gl",
                 "memory 0; open gl,cpu:reference, require gl, 120 s; sweep-flow (2 rows of "
                 "1280x720 after 10 frames) " WHOLE,
                 RG_EXIT_INCONCLUSIVE);
    asked_expect("sweep flow --axis seed=1,2,5 --dry-run --full --set drops=4 --device gl",
                 "memory 0; open gl, require -, 120 s; plan 3 rows, set drops=4, full, on 2; close "
                 "2",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed, "3 rows on 2\n");
}

// A device that is left out, or closed badly, counts; without devices nothing is measured.
static void devices_decide_about_the_end(void **state)
{
    (void)state;
    static const char *const lines[] = {
        "table creus-5.4 --device cpu", "claims creus-5.4 --device cpu",
        "sweep flow --axis seed=1 --device cpu", "table feng-1 --compile --device cpu"};
    for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); i++) {
        asked_left_out = RG_EXIT_FAIL;
        assert_int_equal(asked_run(lines[i]), RG_EXIT_FAIL);
        asked_left_out = RG_EXIT_PASS;
        asked_closing = RG_EXIT_HARNESS;
        assert_int_equal(asked_run(lines[i]), RG_EXIT_HARNESS);
        asked_closing = RG_EXIT_PASS;
        asked_opening = RG_EXIT_UNSUPPORTED;
        asked_expect(lines[i], USUAL, RG_EXIT_UNSUPPORTED);
        asked_opening = RG_EXIT_PASS;
    }
}

// --- pictures ---

static const struct {
    const char *line, *seen, *printed;
} frames[] = {
    {"render flow --set seed=3",
     USUAL "flow seed 3, 512x512, frame 60 on first; write flow.png, exposure 1; end; close 2",
     "flow.png: flow, frame 77, 512x512, on first (one); model bunny?\n"},
    {"render flow --size 64x48 -o a.exr --exposure 2.5 --device gl --timeout 7 --memory 1G",
     "memory 1073741824; open gl, require -, 7 s; flow seed 1, 64x48, frame 60 on first; write "
     "a.exr, exposure 2.5; end; close 2",
     "a.exr: flow, frame 77, 64x48, on first (one); model bunny?\n"},
    {"render flow --frame 0",
     USUAL "flow seed 1, 512x512, frame 0 on first; write flow.png, exposure 1; end; close 2",
     "flow.png: flow, frame 77, 512x512, on first (one); model bunny?\n"},
    {"render raster",
     USUAL "raster seed 1, 640x360, frame 0 on first; write raster.png, exposure 1; end; close "
           "2",
     "raster.png: raster, frame 77, 640x360, on first (one); model bunny?\n"
     "  as by --set scene=mesh --size 640x360 --frame 0 --exposure 1\n"},
    {"render drops --exposure 3",
     USUAL "drops seed 1, 640x384, frame 900 on first; write drops.png, exposure 3; end; close "
           "2",
     "drops.png: drops, frame 77, 640x384, on first (one); model bunny?\n"
     "  as by --set environment=street-night --set environment_px=512 --set aperture_mm=12 "
     "--set columns=500 --set rows=300 --size 640x384 --frame 900 --exposure 3\n"},
    {"render flow --frames 3-5 --size 8x4",
     USUAL "flow seed 1, 8x4, frames 3-5 into flow.webm, 60 a second, exposure 1 on first; end; "
           "close 2",
     "flow.webm: flow, frames 3-5, 60 a second, 8x4, on first (one); model bunny?\n"},
    {"render flow --frames 3-5 --fps 25 --exposure 2 -o a.webm",
     USUAL "flow seed 1, 512x512, frames 3-5 into a.webm, 25 a second, exposure 2 on first; "
           "end; close 2",
     "a.webm: flow, frames 3-5, 25 a second, 512x512, on first (one); model bunny?\n"},
    {"render flow --frames 0-1 -o a%02d.png",
     USUAL "flow seed 1, 512x512, frames 0-1 into a%02d.png, 60 a second, exposure 1 on first; "
           "end; close 2",
     "a%02d.png: flow, frames 0-1, 512x512, on first (one); model bunny?\n"},
};

static void frames_are_asked_for(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
        asked_expect(frames[i].line, frames[i].seen, RG_EXIT_PASS);
        assert_string_equal(asked_printed, frames[i].printed);
    }
    strcpy(asked_devices[0].info.device, "on\x1b[e"); // a driver's name steers no terminal
    assert_int_equal(asked_run("render raster --frame 0"), 0);
    assert_non_null(strstr(asked_printed, ", on first (on?[e); "));
    strcpy(asked_devices[0].info.device, "one");
    asked_expect("render --case a.txt --device gl --timeout 9",
                 "memory 0; case a.txt; open gl, require -, 9 s; replay a.txt on first; close 2",
                 RG_EXIT_FAIL);
}

static void expect_text(const json_t *json, const char *name, const char *due)
{
    assert_string_equal(json_string_value(json_object_get(json, name)), due);
}

static void expect_number(const json_t *json, const char *name, int due)
{
    assert_int_equal(json_integer_value(json_object_get(json, name)), due);
}

// JSON has all that the line has, and every setting.
static void frames_are_told_as_json(void **state)
{
    (void)state;
    int first, last;
    assert_int_equal(asked_run("render flow --json --set drops=9 --size 8x4 -o a.png"), 0);
    json_t *json = json_loads(asked_printed, 0, NULL);
    assert_non_null(json);
    expect_text(json, "file", "a.png");
    expect_text(json, "technique", "flow");
    expect_text(json, "device", "first");
    expect_number(json, "format", 1);
    expect_number(json, "width", 8);
    expect_number(json, "height", 4);
    expect_number(json, "frame", 77);
    const struct rg_technique *flow = rg_technique_find("flow");
    const json_t *settings = json_object_get(json, "settings");
    assert_int_equal(json_object_size(settings), flow->params->count);
    expect_text(settings, "drops", "9");
    expect_text(settings, "view", "box");
    expect_text(json_object_get(json, "facts"), "model", "bunny?");
    expect_number(json_object_get(json, "counters"), "drops", 5);
    const json_t *devices = json_object_get(json_object_get(json, "passport"), "devices");
    assert_int_equal(json_array_size(devices), 1);
    expect_text(json_array_get(devices, 0), "driver", "1.0");
    assert_null(json_object_get(json, "frames"));
    json_decref(json);
    static const char *const lines[] = {"render flow --json --frames 3-5 --fps 25 -o a.webm",
                                        "render flow --json --frames 3-5 -o a%d.png"};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(asked_run(lines[i]), 0);
        json = json_loads(asked_printed, 0, NULL);
        assert_int_equal(json_unpack(json, "{s[ii]}", "frames", &first, &last), 0);
        assert_true(first == 3 && last == 5);
        assert_int_equal(json_integer_value(json_object_get(json, "fps")), i ? 0 : 25);
        json_decref(json);
    }
}

static void figures_and_traces_are_asked_for(void **state)
{
    (void)state;
    asked_expect(
        "figures creus-4.3 creus-4.5 --size 8x4 --device gl --timeout 3 -o out",
        "memory 0; open gl, require -, 3 s; 2 figures, the last creus-4.5, 8x4 into out on "
        "first; close 2",
        RG_EXIT_PASS);
    assert_string_equal(asked_printed, "out/figures.md: 2 figures\n");
    char all[256];
    int count = 0;
    while (rg_figure_at(count))
        count++;
    snprintf(all, sizeof(all),
             USUAL "%d figures, the last %s, 512x512 into figures on first; "
                   "close 2",
             count, rg_figure_at(count - 1)->id);
    asked_expect("figures", all, RG_EXIT_PASS);
    asked_expect(
        "trace flow --set seed=2 --count 4 --size 8x4 --device gl --require cpu --timeout 5 "
        "-o t.json",
        "memory 0; open gl, require cpu, 5 s; flow seed 2, 8x4, 4 frames on first; flow "
        "seed 2, 8x4, 4 frames on second; trace of first to second; close 2",
        RG_EXIT_PASS);
    assert_string_equal(asked_printed, "t.json: 4 frames, and as many by pass, on 2 devices\n");
    asked_left_out = RG_EXIT_FAIL;
    assert_int_equal(asked_run("trace flow"), RG_EXIT_FAIL);
    assert_non_null(strstr(asked_seen, "512x512, 10 frames on second"));
}

// --- textures and pages ---

// Which of the six atlases: small or full, packed or made, of drops as they were measured or not.
static void atlases_are_asked_for(void **state)
{
    (void)state;
    static const struct {
        const char *line, *seen;
    } rows[] = {{"atlas", "read full; make full; "},
                {"atlas --full", "read full; make full; "},
                {"atlas --quick", "read small; make small; "},
                {"atlas --measured", "read measured; make measured; "},
                {"atlas --measured --quick", "read measured-small; make measured-small; "},
                {"atlas --from here", "pack here as cave; "},
                {"atlas --from here --quick", "pack here as cave-small; "}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        asked_expect(rows[i].line, rows[i].seen, RG_EXIT_USAGE);
    asked_expect("atlas cartoon -o out", "textures of cartoon into out; ", RG_EXIT_PASS);
    assert_string_equal(asked_printed, "texture                  side px  levels\n"
                                       "a                              8       4\n"
                                       "b_and_more                   128       7\n");
    asked_expect("atlas cartoon --json", "textures of cartoon into -; ", RG_EXIT_PASS);
    json_t *json = json_loads(asked_printed, 0, NULL);
    json_t *due = json_pack("{si ss s[{ss si si} {ss si si}]}", "format", 1, "technique", "cartoon",
                            "textures", "name", "a", "side_px", 8, "levels", 4, "name",
                            "b_and_more", "side_px", 128, "levels", 7);
    assert_true(json_equal(json, due));
    json_decref(json);
    json_decref(due);
}

// An atlas is told with the sizes of its images and the ends of its factors.
static void atlases_are_told(void **state)
{
    (void)state;
    is_cached = true;
    setenv("XDG_CACHE_HOME", "/nonexistent", 1);
    asked_expect("atlas --quick", "read small; ", RG_EXIT_PASS);
    assert_int_equal(strncmp(asked_printed, "small atlas, read in 0.0 s; ", 28), 0);
    char head[512];
    snprintf(head, sizeof(head), "%-8s%8s%8s%14s%14s%14s%14s\n%-8s%8d%8d%14s", "image", "layers",
             "levels", "level 0 px", "texels", "least factor", "largest", "point", 10, 10,
             "720x901");
    assert_non_null(strstr(asked_printed, " MB, checksum 0000000000000abc\nnot kept\n\nimage "));
    assert_non_null(strstr(asked_printed, head));
    assert_non_null(strstr(asked_printed, "           0.5             2\nenv  "));
    assert_non_null(strstr(asked_printed, "          0.25             4\nsplash  "));
    asked_expect("atlas --quick --json", "read small; ", RG_EXIT_PASS);
    is_cached = false;
    json_t *json = json_loads(asked_printed, 0, NULL);
    const json_t *images = json_object_get(json, "images");
    json_int_t texels = 0;
    for (size_t i = 0; i < 3; i++)
        texels += json_integer_value(json_object_get(json_array_get(images, i), "texels"));
    assert_int_equal(json_array_size(images), 3);
    assert_int_equal(json_integer_value(json_object_get(json, "bytes")), 2 * texels);
    expect_text(json, "size", "small");
    expect_text(json, "from", "cache");
    expect_text(json, "hash", "0000000000000abc");
    assert_true(json_is_null(json_object_get(json, "file")));
    const json_t *env = json_array_get(images, 1);
    expect_text(env, "name", "env");
    assert_equals(json_number_value(json_object_get(env, "least_factor")), 0.25);
    assert_equals(json_number_value(json_object_get(env, "largest_factor")), 4);
    assert_null(json_object_get(json_array_get(images, 2), "least_factor"));
    expect_number(json_array_get(images, 2), "layers", 84);
    assert_below(json_integer_value(json_object_get(json_array_get(images, 2), "levels")), 12);
    json_decref(json);
}

static void pages_are_asked_for(void **state)
{
    (void)state;
    asked_expect("report a b.json", "memory 0; add a; add b.json; page report.html; ",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed, "report.html: 0 records; open it in a browser\n");
    asked_expect("report a --against c -o p.html --memory 1K",
                 "memory 1024; add a; before c; page p.html with changes; ", RG_EXIT_PASS);
    asked_expect("report a --format md", "memory 0; add a; ", RG_EXIT_PASS);
    assert_string_equal(asked_printed, "markdown");
    asked_expect("report a --format badge", "memory 0; add a; ", RG_EXIT_PASS);
    assert_string_equal(asked_printed, "badge");
    asked_expect("report a --format md -o a.md", "memory 0; add a; ", RG_EXIT_PASS);
    assert_string_equal(asked_printed, "");
    char text[16] = "";
    FILE *file = fopen("a.md", "r");
    assert_non_null(file);
    assert_non_null(fgets(text, sizeof(text), file));
    fclose(file);
    assert_string_equal(text, "markdown");
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, asked_setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(tables_are_asked_for),         ASKED(sweeps_are_asked_for),
        ASKED(devices_decide_about_the_end), ASKED(frames_are_asked_for),
        ASKED(frames_are_told_as_json),      ASKED(figures_and_traces_are_asked_for),
        ASKED(atlases_are_asked_for),        ASKED(atlases_are_told),
        ASKED(pages_are_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
