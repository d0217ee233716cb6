// Values on the command line: KEY=VALUE of each technique, and those of options of each kind. The
// first byte chooses one. A parameter that is taken is written and taken again.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/commands/cli/option.h"
#include "tests/fuzz/heard.h"

static void set_parameters(const struct rg_technique *technique, const char *text)
{
    void *settings = rg_settings_create(technique), *again = rg_settings_create(technique);
    fuzz_listen();
    const bool taken = rg_params_set_all(technique->params, settings, text);
    fuzz_judge_lines(taken, 0);
    for (int i = 0; taken && i < technique->params->count; i++) {
        const struct rg_param *param = &technique->params->rows[i];
        char value[RG_PATH_SIZE], said[RG_PATH_SIZE + 80];
        rg_params_text(param, settings, value, sizeof(value));
        snprintf(said, sizeof(said), "%s=%s", param->name, value);
        if (!rg_params_set(technique->params, again, said))
            fuzz_complain("taken, written, and refused");
    }
    free(settings);
    free(again);
}

static const char *const choices[] = {"md", "csv", "json", "tex", NULL};
static const struct rg_option kinds[] = {
    {.kind = RG_OPTION_INT, .name = "frame", .least = 0, .most = 1e6},
    {.kind = RG_OPTION_FACTOR, .name = "exposure", .most = 1000},
    {.kind = RG_OPTION_CHOICE, .name = "format", .choices = choices},
    {.kind = RG_OPTION_SIZE, .name = "size"},
    {.kind = RG_OPTION_RANGE, .name = "rows", .least = 1, .most = 256},
    {.kind = RG_OPTION_TEXT, .name = "device", .names = RG_NAMES_DEVICES},
    {.kind = RG_OPTION_TEXTS, .name = "set"},
};
enum { KINDS = sizeof(kinds) / sizeof(kinds[0]) };

union value {
    int number;
    double factor;
    struct rg_size size;
    struct rg_range range;
    char *text;
    struct rg_words words;
};

// Whether a value is within the row's bounds.
static bool is_within(const struct rg_option *row, const union value *value)
{
    switch (row->kind) {
    case RG_OPTION_INT:
        return value->number >= row->least && value->number <= row->most;
    case RG_OPTION_FACTOR:
        return value->factor > 0 && value->factor <= row->most;
    case RG_OPTION_CHOICE:
        return value->number >= 0 && choices[value->number];
    case RG_OPTION_SIZE:
        return value->size.width > 0 && value->size.height > 0;
    case RG_OPTION_RANGE:
        return value->range.first >= row->least && value->range.last >= value->range.first &&
               value->range.last <= row->most;
    default:
        return true;
    }
}

static void set_option(const struct rg_option *row, const char *text)
{
    union value value;
    memset(&value, 0, sizeof(value));
    rg_option_clear(row, &value);
    fuzz_listen();
    const bool taken = rg_option_set(row, &value, text, "render");
    fuzz_judge_lines(taken, 0);
    if (taken && !is_within(row, &value))
        fuzz_complain("a value that is out of its range");
    rg_option_free(row, &value);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    int techniques = 0;
    while (rg_techniques[techniques])
        techniques++;
    if (!size)
        return 0;
    char *text = calloc(1, size); // ends in 0
    if (!text)
        return 0;
    memcpy(text, data + 1, size - 1);
    const int which = data[0] % (techniques + KINDS);
    if (which < techniques)
        set_parameters(rg_techniques[which], text);
    else
        set_option(&kinds[which - techniques], text);
    free(text);
    return 0;
}
