#include "harness/commands/cli/shared.h"

#include "core/base/log.h"

const struct rg_option rg_timeout_option[] = {
    {RG_OPTION_INT, "timeout", .argument = "S",
     .about = "gives up a device, or the encoder of a clip, that does nothing for so many "
              "seconds",
     .least = 1, .most = 86400, .initial = "120"},
    {RG_OPTION_END},
};

const struct rg_option rg_devices_option[] = {
    {RG_OPTION_TEXT, "device", .argument = "D,...|all",
     .about = "devices to use; `raingauge list devices` prints their names. "
              "gl@LP_NUM_THREADS=1;KEY=VALUE is one with an environment of its own, "
              "gl:native one that draws by its driver's own pipeline",
     .names = RG_NAMES_DEVICES},
    {RG_OPTION_END},
};

#define AT(field) offsetof(struct rg_devices_asked, field)

const struct rg_option rg_asked_options[] = {
    {RG_OPTION_TEXT, "require", .argument = "D,...",
     .about = "fails unless these devices or APIs are there", .offset = AT(require),
     .names = RG_NAMES_DEVICES},
    RG_INCLUDE(rg_timeout_option, AT(timeout_s), NULL),
    {RG_OPTION_END},
};

#undef AT

const struct rg_option rg_settings_option[] = {
    {RG_OPTION_TEXTS, "set", .argument = "KEY=VALUE",
     .about = "sets a parameter; give it again for another. `raingauge list params TECHNIQUE` "
              "prints them",
     .names = RG_NAMES_PARAMETER},
    {RG_OPTION_END},
};

const struct rg_option rg_size_option[] = {
    {RG_OPTION_SIZE, "size", .argument = "WxH", .about = "size of the image in pixels"},
    {RG_OPTION_END},
};

const struct rg_option rg_memory_option[] = {
    {RG_OPTION_BYTES, "memory", .argument = "SIZE",
     .about = "refuses work that needs more memory, as 512M or 4G. Without it: nine tenths of "
              "the free memory"},
    {RG_OPTION_END},
};

const struct rg_option rg_frame_option[] = {
    {RG_OPTION_INT, "frame", .argument = "N", .about = "frames to simulate before drawing",
     .least = 0, .most = 1e7},
    {RG_OPTION_END},
};

const struct rg_option rg_exposure_option[] = {
    {RG_OPTION_FACTOR, "exposure", .argument = "X",
     .about = "brightens 8-bit images by this factor", .most = 1e6},
    {RG_OPTION_END},
};

const struct rg_option rg_json_option[] = {
    {RG_OPTION_FLAG, "json", .about = "prints JSON for programs (docs/records.md)"},
    {RG_OPTION_END},
};

#define AT(field) offsetof(struct rg_length, field)

const struct rg_option rg_length_options[] = {
    {RG_OPTION_FLAG, "quick", .about = "less work: few samples, steps or streaks",
     .offset = AT(quick), .excludes = "full"},
    {RG_OPTION_FLAG, "full", .about = "all the work: many samples, steps or streaks",
     .offset = AT(full)},
    {RG_OPTION_END},
};

bool rg_length_is_asked(const char *command, const struct rg_words *tables,
                        const struct rg_length *length, const char *budget)
{
    return tables->count || length->quick || length->full || budget ||
           rg_error("%s: all tables take hours; name some, as `raingauge list tables` prints "
                    "them, or add --budget 4m, --quick or --full",
                    command);
}
