#include "harness/console/duration.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

const char *rg_duration_text(double s, char text[RG_DURATION_TEXT])
{
    if (s < 99.5)
        snprintf(text, RG_DURATION_TEXT, "%.2g s", s);
    else if (s < 99.5 * 60)
        snprintf(text, RG_DURATION_TEXT, "%.2g min", s / 60);
    else
        snprintf(text, RG_DURATION_TEXT, s < 99.5 * 3600 ? "%.2g h" : "%.0f h", s / 3600);
    return text;
}

bool rg_duration_read(const char *text, const char *option, double *s)
{
    char *end;
    const double number = strtod(text, &end);
    const double unit = !strcmp(end, "s")   ? 1
                        : !strcmp(end, "m") ? 60
                        : !strcmp(end, "h") ? 3600
                                            : 0;
    *s = number * unit;
    return (unit > 0 && number > 0 && *s < 1e6) ||
           rg_error("%s '%s': is no time; write it as 90s, 4m or 1h", option, text);
}

double rg_long_s(void)
{
    const char *given = getenv("RG_LONG_S");
    return given && strtod(given, NULL) > 0 ? strtod(given, NULL) : 30;
}
