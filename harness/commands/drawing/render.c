// raingauge render: writes one frame of a technique as an image file, or several as a clip or
// numbered image files.
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/image/clip/clip.h"
#include "core/image/files/io.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/commands/drawing/drawn.h"
#include "harness/compare/shrink/case.h"
#include "harness/console/interrupt.h"
#include "harness/devices/devices.h"
#include "harness/devices/names.h"
#include "harness/devices/frames/frame.h"
#include "harness/record/numbered.h"

struct render_options {
    struct rg_words sets;
    struct rg_size size;    // 0: not given
    int frame;              // -1: not given
    struct rg_range frames; // -1: not given
    int fps;                // 0: not given
    int timeout_s;
    char *replayed;        // a file; NULL: a technique is drawn
    char *device, *output; // a name; a file, NULL for the technique's name with .png or .webm
    double exposure;       // 0: not given
    int64_t memory_bytes;
    bool json;
};

enum { DEFAULT_FPS = 60 };

#define AT(field) offsetof(struct render_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to draw"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about = "the technique to draw; `raingauge list techniques` prints the names. Without --set, "
              "--size, --frame and --frames: the picture that shows the technique best. With one "
              "of these options: frame 60 in 512x512 pixels",
     .names = RG_NAMES_TECHNIQUE, .first = 1, .last = 1},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    RG_INCLUDE(rg_frame_option, AT(frame), NULL),
    {RG_OPTION_RANGE, "frames", .argument = "A-B",
     .about = "draws every frame from A to B, as a clip or as numbered pictures",
     .offset = AT(frames), .least = 0, .most = 1e7, .excludes = "frame"},
    RG_INCLUDE(rg_size_option, AT(size), NULL),
    {RG_OPTION_TEXT, "case", .argument = "FILE",
     .about = "replays a reproducer of `raingauge shrink`, instead of drawing a picture, and "
              "prints whether the device gives the expected bits",
     .offset = AT(replayed), .names = RG_NAMES_FILE,
     .excludes = "set frame frames size output fps exposure json"},
    RG_GROUP("Devices"),
    {RG_OPTION_TEXT, "device", .argument = "D",
     .about = "the device to use; `raingauge list devices` prints the names", .offset = AT(device),
     .initial = "cpu", .names = RG_NAMES_DEVICE},
    RG_INCLUDE(rg_timeout_option, AT(timeout_s), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "the picture file (default TECHNIQUE.png): .png, .exr, .hdr, .tif or .tiff. For "
              "several frames: a clip (default TECHNIQUE.webm), or numbered pictures, whose name "
              "has %04d for the frame's number",
     .offset = AT(output), .letter = 'o', .names = RG_NAMES_FILE},
    {RG_OPTION_INT, "fps", .argument = "N",
     .about = "frames per second of a clip (default 60, real time for steps of 1/60 s)",
     .offset = AT(fps), .least = 1, .most = 240},
    RG_INCLUDE(rg_exposure_option, AT(exposure), NULL),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static bool has_frames(const struct render_options *o)
{
    return o->frames.first >= 0;
}

// Whether the output file's kind fits the requested frames.
static bool check_output(const struct render_options *o)
{
    const char *path = o->output;
    const bool clip = path ? rg_clip_is_named(path) : has_frames(o);
    const int places = path && has_frames(o) ? rg_numbered_places(path) : 0;
    if (clip && !has_frames(o))
        return rg_error("%s: a clip holds several frames; give --frames A-B, or name a picture",
                        path);
    if (o->fps && !clip)
        return rg_error("--fps %d: a clip alone has it; name one (-o NAME.webm), or leave it out",
                        o->fps);
    if (clip && places)
        return rg_error("%s: a clip holds all frames; leave out the place of a number, or name a "
                        "picture",
                        path);
    if (has_frames(o) && !clip && places != 1)
        return rg_error("%s: has %s for the frame's number; name pictures as in rain-%%04d.png, or "
                        "a clip, as in rain.webm",
                        path, places ? "more than one place" : "no place");
    return true;
}

// Whether no picture or clip replaces a file that settings name. False, and one logged line, if one
// would.
static bool spares_files(const struct rg_drawn *drawn)
{
    char path[PATH_MAX], value[RG_PATH_SIZE];
    const struct rg_sequence *s = drawn->sequence;
    if (!s || rg_clip_is_named(drawn->path))
        return rg_files_spared_by(&drawn->subject, drawn->path);
    bool spared = true;
    for (int at = 0; spared && rg_file_own_next(&drawn->subject, &at, value);)
        for (int frame = s->first; spared && frame <= s->last; frame++)
            spared = rg_numbered_path(drawn->path, frame, path, sizeof(path)) &&
                     rg_file_spares(path, value);
    return spared;
}

// Whether the picture that shows the technique best is asked for.
static bool is_shown(const struct render_options *o)
{
    return !o->sets.count && !o->size.width && o->frame < 0 && !has_frames(o);
}

// The options with all that was not given, for a technique.
static struct render_options completed(const struct render_options *o,
                                       const struct rg_technique *technique)
{
    const struct rg_shown usual = {"", 512, 512, 60, 1.0};
    const struct rg_shown *shown = is_shown(o) ? &technique->shown : &usual;
    struct render_options all = *o;
    if (!o->size.width)
        all.size = (struct rg_size){shown->width, shown->height};
    if (o->frame < 0)
        all.frame = shown->frame;
    if (o->exposure <= 0.0)
        all.exposure = shown->exposure;
    return all;
}

// Prints the options that draw the same picture.
static void tell_shown(const struct rg_shown *shown, double exposure)
{
    printf("  as by");
    for (const char *at = shown->settings; *at;) {
        const int length = (int)strcspn(at, " ");
        printf(" --set %.*s", length, at);
        at += length + (at[length] == ' ');
    }
    printf(" --size %dx%d --frame %d --exposure %g\n", shown->width, shown->height, shown->frame,
           exposure);
}

// Draws and writes the requested frames; returns the session, or NULL on failure.
static struct rg_session *draw(struct rg_device *device, const struct rg_drawn *drawn, int frame,
                               double exposure)
{
    const struct rg_subject *subject = &drawn->subject;
    if (!spares_files(drawn) || !rg_pictures_fit(subject->width, subject->height, 1))
        return NULL;
    if (drawn->sequence)
        return rg_sequence_run(drawn->sequence, device);
    if (!rg_picture_can_be_written(drawn->path, (int64_t)subject->width * subject->height))
        return NULL;
    const int64_t picture_bytes = rg_pictures_bytes(subject->width, subject->height, 1);
    rg_memory_take(picture_bytes); // reserves memory for the picture
    struct rg_session *session = rg_frame_run(device, subject, frame);
    rg_memory_give(picture_bytes);
    if (session && rg_frame_write(session, drawn->path, exposure))
        return session;
    rg_session_close(session);
    return NULL;
}

static int render_on(struct rg_device *device, const struct rg_technique *technique,
                     const void *settings, const struct render_options *asked)
{
    const struct render_options all = completed(asked, technique), *o = &all;
    char path[256];
    const bool several = has_frames(o);
    snprintf(path, sizeof(path), several ? "%s.webm" : "%s.png", technique->name);
    struct rg_drawn drawn = {.subject = {technique, settings, o->size.width, o->size.height},
                             .on = &device->info,
                             .path = o->output ? o->output : path};
    const struct rg_sequence sequence = {.subject = drawn.subject,
                                         .first = o->frames.first,
                                         .last = o->frames.last,
                                         .path = drawn.path,
                                         .fps = o->fps ? o->fps : DEFAULT_FPS,
                                         .exposure = o->exposure};
    drawn.sequence = several ? &sequence : NULL;
    struct rg_session *session = draw(device, &drawn, o->frame, o->exposure);
    if (!session)
        return rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal() : rg_exit_of_error();
    const bool told = rg_session_tell(session, &drawn.account);
    if (told)
        (o->json ? rg_drawn_print_json : rg_drawn_print_text)(&drawn);
    if (told && is_shown(asked) && !o->json)
        tell_shown(&technique->shown, o->exposure);
    rg_session_close(session);
    return told ? RG_EXIT_PASS : rg_exit_of_error();
}

static int replay(const struct render_options *o)
{
    struct rg_case found;
    struct rg_devices devices = {0};
    int exit = rg_case_read(o->replayed, &found) ? RG_EXIT_PASS : rg_exit_of_error();
    if (exit == RG_EXIT_PASS)
        exit = rg_devices_open_asked(
            &(struct rg_devices_asked){.names = o->device, .timeout_s = o->timeout_s}, &devices);
    if (exit == RG_EXIT_PASS)
        exit = rg_case_replay(&found, o->replayed, devices.devices[0]);
    exit = rg_devices_end(&devices, exit);
    rg_case_free(&found);
    return exit;
}

// The technique that the arguments name, and its settings, which the caller frees. NULL, and one
// logged line, on failure.
static const struct rg_technique *find_subject(const struct render_options *o,
                                               const struct rg_words *arguments, void **settings)
{
    const struct rg_technique *technique = rg_subject_find(arguments, &o->sets, settings);
    if (!technique || !is_shown(o) ||
        rg_params_set_all(technique->params, *settings, technique->shown.settings))
        return technique;
    free(*settings);
    return NULL;
}

static int render(const void *values, const struct rg_words *arguments)
{
    const struct render_options *o = values;
    void *settings;
    rg_memory_allow(o->memory_bytes);
    if (!rg_device_names_one(o->device, "render") || !check_output(o))
        return rg_exit_of_error();
    if (o->replayed && !arguments->count)
        return replay(o);
    if (o->replayed) {
        rg_error("--case %s: names its technique itself; leave out '%s'", o->replayed,
                 arguments->items[0]);
        return rg_exit_of_error();
    }
    const struct rg_technique *technique = find_subject(o, arguments, &settings);
    if (!technique)
        return rg_exit_of_error();
    struct rg_devices devices;
    int exit = rg_devices_open_asked(
        &(struct rg_devices_asked){.names = o->device, .timeout_s = o->timeout_s}, &devices);
    if (exit == RG_EXIT_PASS)
        exit = render_on(devices.devices[0], technique, settings, o);
    exit = rg_devices_end(&devices, exit);
    free(settings);
    return exit;
}

const struct rg_command rg_command_render = {
    .name = "render",
    .reader = RG_FOR_ALL,
    .usage = "TECHNIQUE [--device D] [--frame N|--frames A-B] [--size WxH] [--set KEY=VALUE]... "
             "[-o FILE] [--fps N] [--json]",
    .about = "draws a frame of a technique into a picture, or several frames into a clip",
    .options = options,
    .options_size = sizeof(struct render_options),
    .run = render,
};
