#include "harness/console/duration.h"

#include <stdio.h>
#include <stdlib.h>

const char *rg_duration_text(double s, char text[RG_DURATION_TEXT])
{
    if (s < 99.5)
        snprintf(text, RG_DURATION_TEXT, "%.2g s", s);
    else if (s < 99.5 * 60)
        snprintf(text, RG_DURATION_TEXT, "%.0f min", s / 60);
    else
        snprintf(text, RG_DURATION_TEXT, s < 99.5 * 3600 ? "%.2g h" : "%.0f h", s / 3600);
    return text;
}

double rg_long_s(void)
{
    const char *given = getenv("RG_LONG_S");
    return given && strtod(given, NULL) > 0 ? strtod(given, NULL) : 30;
}
