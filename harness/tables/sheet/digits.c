#include "harness/tables/sheet/digits.h"

#include <stdio.h>
#include <string.h>

void rg_digits_rate(double number, char *text, size_t size)
{
    const int decimals = number >= 99.95 ? 0 : number >= 9.995 ? 1 : number >= 0.0995 ? 2 : 3;
    snprintf(text, size, "%.*f", decimals, number);
}

void rg_digits_ratio(double number, char *text, size_t size)
{
    snprintf(text, size, "%.*f", number >= 9.95 ? 0 : number >= 0.995 ? 1 : 2, number);
}

void rg_digits_heading(const char *name, char *text, size_t size)
{
    static const struct {
        const char *end, *unit;
    } units[] = {{"_m", "m"},       {"_mm", "mm"}, {"_px", "px"},
                 {"_per_s", "1/s"}, {"_s", "s"},   {"_ms", "ms"}};
    size_t length = strlen(name);
    const char *unit = NULL;
    for (size_t i = 0; !unit && i < sizeof(units) / sizeof(units[0]); i++) {
        const size_t end = strlen(units[i].end);
        if (length > end && !strcmp(name + length - end, units[i].end)) {
            unit = units[i].unit;
            length -= end;
        }
    }
    snprintf(text, size, "%.*s%s%s", (int)length, name, unit ? ", " : "", unit ? unit : "");
    for (char *c = text; *c; c++)
        *c = *c == '_' ? ' ' : *c;
}
