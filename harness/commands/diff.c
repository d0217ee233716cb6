// raingauge diff: two files, or one frame of a technique on every pair of devices.
#include "core/base/log.h"
#include "harness/commands/command.h"
#include "harness/compare/diff/devices.h"
#include "harness/compare/diff/files.h"

static int diff(const struct rg_options *o)
{
    if (o->arg_count == 1)
        return rg_diff_devices(o);
    if (o->arg_count != 2) {
        rg_error("diff: name a technique, or two image files; `raingauge diff --help` explains");
        return RG_EXIT_USAGE;
    }
    return rg_diff_files(&(struct rg_diff_request){
        .a = o->args[0],
        .b = o->args[1],
        .background = o->background,
        .heatmap_prefix = o->output,
        .json = o->json,
        .options = {.exposure = (float)o->exposure},
    });
}

const struct rg_command rg_command_diff = {
    .name = "diff",
    .usage = "TECHNIQUE [--device A,B,...]  |  A.exr B.exr [--background FILE]",
    .about = "compares pictures: every pair of devices, or two files; heat maps with -o PREFIX",
    .options = RG_OPT_DEVICE | RG_OPT_SET | RG_OPT_SIZE | RG_OPT_FRAME | RG_OPT_OUTPUT |
               RG_OPT_JSON | RG_OPT_EXPOSURE | RG_OPT_BACKGROUND,
    .run = diff,
};
