#include <math.h>
#include <string.h>

#include "core/base/text/add.h"
#include "harness/compare/gate/expected/inside.h"
#include "harness/compare/gate/text/date.h"

// Replaces control characters, and the one that `blank` names, by ?.
static void write_pattern(FILE *out, const char *text, char blank)
{
    for (const char *c = *text ? text : "*"; *c; c++)
        fputc((unsigned char)*c < ' ' || *c == blank || *c == 127 ? '?' : *c, out);
}

void rg_known_write_head(FILE *out, enum rg_known_kind kind, const char *cell, const char *end)
{
    fprintf(out, "%s ", rg_known_kinds[kind]);
    write_pattern(out, cell, ' ');
    fputs(end, out);
}

void rg_known_write_field(FILE *out, int field, const char *value, const char *end)
{
    fprintf(out, "  %-10s ", rg_known_fields[field]);
    write_pattern(out, value, 127);
    fputs(end, out);
}

void rg_known_write_outcomes(unsigned outcomes, char *text, size_t size)
{
    *text = 0;
    for (int i = 0; i < RG_OUTCOME_COUNT; i++)
        if (outcomes & 1U << i)
            rg_text_add(text, size, " ", "%s", rg_outcome_name((enum rg_outcome)i));
}

static void write_number(FILE *out, int field, double value, const char *end)
{
    char text[64];
    snprintf(text, sizeof(text), "%.17g", value);
    if (isfinite(value))
        rg_known_write_field(out, field, text, end);
}

static void write_day(FILE *out, int field, int day, const char *end)
{
    char text[RG_DATE_SIZE];
    rg_date_write(day, text);
    rg_known_write_field(out, field, text, end);
}

void rg_known_write_new(FILE *out, const struct rg_known_result *result, int today, const char *end)
{
    rg_known_write_head(out, RG_EXPECT_FAIL, result->cell, end);
    rg_known_write_field(out, RG_FIELD_DEVICE, result->device, end);
    if (result->driver && *result->driver) // empty if the driver crashed before it told its name
        rg_known_write_field(out, RG_FIELD_DRIVER, result->driver, end);
    rg_known_write_field(out, RG_FIELD_OUTCOME, rg_outcome_name(result->outcome), end);
    if (result->outcome == RG_FAIL) {
        write_number(out, RG_FIELD_PIXELS, result->pixels, end);
        write_number(out, RG_FIELD_DIFFERENCE, result->difference, end);
    }
    rg_known_write_field(out, RG_FIELD_REASON, "not explained", end);
    write_day(out, RG_FIELD_SINCE, today, end);
    write_day(out, RG_FIELD_UNTIL, today + RG_KNOWN_LEASE_DAYS, end);
}

static bool is_writable(const char *cell)
{
    for (const char *c = cell; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 127 || *c == ',')
            return false;
    return *cell && *cell != '#';
}

void rg_known_write_mesa(FILE *out, const char *cell, unsigned outcomes, const char *end)
{
    const char *word = outcomes & (1U << RG_FAIL | 1U << RG_ERROR) ? "Fail"
                       : outcomes & 1U << RG_CRASH                 ? "Crash"
                                                                   : "Timeout";
    if (is_writable(cell))
        fprintf(out, "%s,%s%s", cell, word, end);
}
