#include "harness/commands/cli/shared.h"

#include "core/base/log.h"

const struct rg_option rg_timeout_option[] = {
    {RG_OPTION_INT, "timeout", .argument = "S",
     .about =
         "kills a device's worker, or a clip's encoder, that does nothing for this many seconds",
     .least = 1, .most = 86400, .initial = "120"},
    {RG_OPTION_END},
};

const struct rg_option rg_devices_option[] = {
    {RG_OPTION_TEXT, "device", .argument = "D,...|all",
     .about = "devices to use; `raingauge list devices` prints their names. "
              "gl@LP_NUM_THREADS=1;KEY=VALUE sets environment variables for the device; gl:native "
              "draws through the driver's own graphics pipeline",
     .names = RG_NAMES_DEVICES},
    {RG_OPTION_END},
};

#define AT(field) offsetof(struct rg_devices_asked, field)

const struct rg_option rg_asked_options[] = {
    {RG_OPTION_TEXT, "require", .argument = "D,...",
     .about = "fails if one of these devices or APIs is missing", .offset = AT(require),
     .names = RG_NAMES_DEVICES},
    RG_INCLUDE(rg_timeout_option, AT(timeout_s), NULL),
    {RG_OPTION_END},
};

#undef AT

const struct rg_option rg_settings_option[] = {
    {RG_OPTION_TEXTS, "set", .argument = "KEY=VALUE",
     .about = "sets a parameter; repeat the option for further ones. `raingauge list params "
              "TECHNIQUE` prints all parameters",
     .names = RG_NAMES_PARAMETER},
    {RG_OPTION_END},
};

const struct rg_option rg_size_option[] = {
    {RG_OPTION_SIZE, "size", .argument = "WxH", .about = "size of the image in pixels"},
    {RG_OPTION_END},
};

const struct rg_option rg_memory_option[] = {
    {RG_OPTION_BYTES, "memory", .argument = "SIZE",
     .about = "refuses work that needs more memory than this, such as 512M or 4G. Default: nine "
              "tenths of the free memory"},
    {RG_OPTION_END},
};

const struct rg_option rg_frame_option[] = {
    {RG_OPTION_INT, "frame", .argument = "N",
     .about = "number of frames to simulate before drawing", .least = 0, .most = 1e7},
    {RG_OPTION_END},
};

const struct rg_option rg_exposure_option[] = {
    {RG_OPTION_FACTOR, "exposure", .argument = "X",
     .about = "brightens 8-bit images by this factor", .most = 1e6},
    {RG_OPTION_END},
};

const struct rg_option rg_json_option[] = {
    {RG_OPTION_FLAG, "json", .about = "prints machine-readable JSON (docs/records.md)"},
    {RG_OPTION_END},
};

#define AT(field) offsetof(struct rg_length, field)

const struct rg_option rg_length_options[] = {
    {RG_OPTION_FLAG, "quick", .about = "does less work: few samples, steps or streaks",
     .offset = AT(quick), .excludes = "full"},
    {RG_OPTION_FLAG, "full", .about = "does all the work: many samples, steps or streaks",
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
