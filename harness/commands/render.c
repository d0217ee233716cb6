// raingauge render: one frame of a technique as an image file.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/cli/command.h"
#include "harness/cli/shared.h"
#include "harness/cli/subject.h"
#include "harness/devices/devices.h"
#include "harness/frames/session.h"
#include "harness/record/named.h"
#include "harness/record/passport/passport.h"

struct render_options {
    struct rg_words sets;
    struct rg_size size;
    int frames;
    char *device, *output; // a name; a file, NULL for the technique's name with .png
    double exposure;
    bool json;
};

#define AT(field) offsetof(struct render_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to draw"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about = "its picture; `raingauge list techniques` prints them", .names = RG_NAMES_TECHNIQUE,
     .first = 1, .last = 1},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    RG_INCLUDE(rg_frame_option, AT(frames), "60"),
    RG_INCLUDE(rg_size_option, AT(size), NULL),
    RG_GROUP("Devices"),
    {RG_OPTION_TEXT, "device", .argument = "D",
     .about = "the device to use; `raingauge list devices` prints the names", .offset = AT(device),
     .initial = "cpu", .names = RG_NAMES_DEVICE},
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "the picture: .png, .exr, .hdr, .tif or .tiff; TECHNIQUE.png where none is named",
     .offset = AT(output), .letter = 'o', .names = RG_NAMES_FILE},
    RG_INCLUDE(rg_exposure_option, AT(exposure), NULL),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static bool write_frame(struct rg_session *session, const char *path, double exposure)
{
    struct rg_picture picture = {0};
    bool ok = rg_session_read_picture(session, &picture);
    if (ok) {
        rg_picture_drop_opaque_alpha(&picture);
        ok = rg_picture_write(path, &picture,
                              &(struct rg_write_options){.exposure = (float)exposure});
    }
    rg_picture_destroy(&picture);
    return ok;
}

// Every parameter with its value, as --set takes it.
static json_t *settings_json(const struct rg_technique *technique, const void *settings)
{
    json_t *json = json_object();
    for (int i = 0; i < technique->params->count; i++) {
        char value[RG_PATH_SIZE];
        rg_params_text(&technique->params->rows[i], settings, value, sizeof(value));
        json_object_set_new(json, technique->params->rows[i].name, rg_json_text(value));
    }
    return json;
}

// What was drawn, and the file that it is in.
struct drawn {
    struct rg_subject subject;
    const struct rg_device_info *on;
    const char *path;
    struct rg_account account;
};

// docs/records.md
static void print_json(const struct drawn *d)
{
    const struct rg_account *a = &d->account;
    struct rg_named facts[RG_MAX_FACTS];
    struct rg_count counters[RG_MAX_COUNTERS];
    rg_facts_copy(facts, a->facts, a->fact_count);
    rg_counters_copy(counters, a->counters, a->counter_count);
    json_t *json = json_pack(
        "{sisosssssisisIsosososo}", "format", 1, "file", rg_json_text(d->path), "technique",
        d->subject.technique->name, "device", d->on->name, "width", d->subject.width, "height",
        d->subject.height, "frame", (json_int_t)a->frame, "settings",
        settings_json(d->subject.technique, d->subject.settings), "facts",
        rg_named_json(facts, a->fact_count), "counters", rg_counts_json(counters, a->counter_count),
        "passport", rg_passport_json(d->on, 1));
    json_dumpf(json, stdout, JSON_INDENT(1));
    printf("\n");
    json_decref(json);
}

static void print_text(const struct drawn *d)
{
    struct rg_named told[RG_MAX_FACTS];
    char facts[RG_FACTS_TEXT];
    rg_facts_copy(told, d->account.facts, d->account.fact_count);
    rg_named_text(told, d->account.fact_count, NULL, facts, sizeof(facts));
    printf("%s: %s, frame %lld, %dx%d, on %s (%s)%s%s\n", d->path, d->subject.technique->name,
           (long long)d->account.frame, d->subject.width, d->subject.height, d->on->name,
           d->on->device, *facts ? "; " : "", facts);
}

static int render_on(struct rg_device *device, const struct rg_technique *technique,
                     const void *settings, const struct render_options *o)
{
    char path[256];
    snprintf(path, sizeof(path), "%s.png", technique->name);
    struct drawn drawn = {.subject = {technique, settings, o->size.width, o->size.height},
                          .on = &device->info,
                          .path = o->output ? o->output : path};
    struct rg_session *session = rg_session_run(device, &drawn.subject, o->frames);
    const bool ok = session && write_frame(session, drawn.path, o->exposure);
    const int exit = ok ? RG_EXIT_PASS : rg_exit_of_error();
    if (ok) {
        rg_session_tell(session, &drawn.account);
        (o->json ? print_json : print_text)(&drawn);
    }
    rg_session_close(session);
    return exit;
}

static bool names_one_device(const char *names)
{
    if (strcmp(names, "all") != 0 && !strchr(names, ','))
        return true;
    return rg_error("--device %s: render draws on one device; `raingauge diff` compares several",
                    names);
}

static int render(const void *values, const struct rg_words *arguments)
{
    const struct render_options *o = values;
    void *settings;
    if (!names_one_device(o->device))
        return RG_EXIT_USAGE;
    const struct rg_technique *technique = rg_subject_find(arguments, &o->sets, &settings);
    if (!technique)
        return RG_EXIT_USAGE;
    struct rg_devices devices;
    int exit = rg_devices_open(o->device, &devices);
    if (exit == RG_EXIT_PASS)
        exit = render_on(devices.devices[0], technique, settings, o);
    rg_devices_close(&devices);
    free(settings);
    return exit;
}

const struct rg_command rg_command_render = {
    .name = "render",
    .usage = "TECHNIQUE [--device D] [--frame N] [--size WxH] [--set KEY=VALUE]... [-o FILE] "
             "[--json]",
    .about = "draws one frame of a technique into an image file (PNG, EXR, HDR, TIFF)",
    .options = options,
    .options_size = sizeof(struct render_options),
    .run = render,
};
