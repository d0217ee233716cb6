// raingauge render: one frame of a technique as an image file.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/commands/command.h"
#include "harness/devices/devices.h"
#include "harness/frames/frame.h"
#include "harness/record/facts.h"
#include "harness/record/passport.h"

static bool write_frame(struct rg_instance *instance, const char *path, double exposure)
{
    struct rg_picture picture = {0};
    bool ok = rg_frame_read_picture(instance, &picture);
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

// What was drawn (docs/records.md).
static void print_json(const struct rg_instance *instance, const void *settings, const char *path)
{
    const struct rg_image_desc *desc = &instance->target->desc;
    json_t *json =
        json_pack("{sisosssssisisIsosososo}", "format", 1, "file", rg_json_text(path), "technique",
                  instance->technique->name, "device", instance->device->info.name, "width",
                  desc->width, "height", desc->height, "frame", (json_int_t)instance->frame,
                  "settings", settings_json(instance->technique, settings), "facts",
                  rg_facts_json(instance->facts, instance->fact_count), "counters",
                  rg_counters_json(instance->counters, instance->counter_count), "passport",
                  rg_passport_json(&instance->device->info, 1));
    json_dumpf(json, stdout, JSON_INDENT(1));
    printf("\n");
    json_decref(json);
}

static void print_text(const struct rg_instance *instance, const char *path)
{
    const struct rg_device_info *info = &instance->device->info;
    char facts[RG_FACTS_TEXT];
    rg_facts_text(instance->facts, instance->fact_count, NULL, facts, sizeof(facts));
    printf("%s: %s, frame %lld, %dx%d, on %s (%s)%s%s\n", path, instance->technique->name,
           (long long)instance->frame, instance->target->desc.width, instance->target->desc.height,
           info->name, info->device, *facts ? "; " : "", facts);
}

static int render_on(struct rg_device *device, const struct rg_technique *technique,
                     const void *settings, const struct rg_options *o)
{
    const int width = o->width ? o->width : RG_FRAME_SIZE_PX;
    const int height = o->height ? o->height : RG_FRAME_SIZE_PX;
    const int frames = o->frame >= 0 ? o->frame : RG_FRAME_COUNT;
    char path[256];
    snprintf(path, sizeof(path), "%s.png", technique->name);
    const char *output = o->output ? o->output : path;
    struct rg_instance *instance = rg_frame_run(technique, settings, device, width, height, frames);
    bool ok = instance && write_frame(instance, output, o->exposure);
    if (ok && o->json)
        print_json(instance, settings, output);
    else if (ok)
        print_text(instance, output);
    if (instance)
        technique->destroy(instance);
    return ok ? RG_EXIT_PASS : RG_EXIT_USAGE;
}

static bool names_one_device(const char *names)
{
    if (!names || (strcmp(names, "all") != 0 && !strchr(names, ',')))
        return true;
    return rg_error("--device %s: render draws on one device; `raingauge diff` compares several",
                    names);
}

static int render(const struct rg_options *o)
{
    void *settings;
    if (!rg_options_at_most(o, "render", 1) || !names_one_device(o->device))
        return RG_EXIT_USAGE;
    const struct rg_technique *technique = rg_options_technique(o, &settings);
    if (!technique)
        return RG_EXIT_USAGE;
    struct rg_devices devices;
    int exit = rg_devices_open(o, "cpu", &devices);
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
    .options = RG_OPT_DEVICE | RG_OPT_FRAME | RG_OPT_SIZE | RG_OPT_SET | RG_OPT_OUTPUT |
               RG_OPT_EXPOSURE | RG_OPT_JSON,
    .run = render,
};
