// raingauge render: one frame of a technique as an image file.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/io.h"
#include "core/log.h"
#include "harness/command.h"
#include "harness/devices.h"
#include "harness/frame.h"

static bool write_frame(struct rg_instance *instance, const char *path, double exposure)
{
    size_t size;
    void *texels = rg_frame_read(instance, &size);
    struct rg_picture picture = {0};
    bool ok = texels && rg_frame_picture(instance, texels, &picture);
    if (ok) {
        rg_picture_drop_opaque_alpha(&picture);
        ok = rg_picture_write(path, &picture,
                              &(struct rg_write_options){.exposure = (float)exposure});
    }
    rg_picture_destroy(&picture);
    free(texels);
    return ok;
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
    if (ok)
        printf("%s: %s, frame %d, %dx%d, on %s (%s)\n", output, technique->name, frames, width,
               height, device->info.name, device->info.device);
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
    .usage = "TECHNIQUE [--device D] [--frame N] [--size WxH] [--set KEY=VALUE]... [-o FILE]",
    .about = "draws one frame of a technique into an image file (PNG, EXR, HDR, TIFF)",
    .options =
        RG_OPT_DEVICE | RG_OPT_FRAME | RG_OPT_SIZE | RG_OPT_SET | RG_OPT_OUTPUT | RG_OPT_EXPOSURE,
    .run = render,
};
