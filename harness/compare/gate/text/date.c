#define _DEFAULT_SOURCE // timegm
#include "harness/compare/gate/text/date.h"

#include <string.h>
#include <time.h>

// Rejects an impossible day such as 02-30 by writing the result back: it gives another text.
bool rg_date_read(const char *text, int *day)
{
    struct tm tm = {0};
    char again[RG_DATE_SIZE];
    const char *end = strptime(text, "%Y-%m-%d", &tm);
    if (!end || tm.tm_year < 70 || tm.tm_year > 8099)
        return false;
    *day = (int)(timegm(&tm) / (24 * 60 * 60));
    rg_date_write(*day, again);
    return !strcmp(again, text);
}

void rg_date_write(int day, char text[RG_DATE_SIZE])
{
    const time_t seconds = (time_t)day * 24 * 60 * 60;
    struct tm tm;
    gmtime_r(&seconds, &tm);
    strftime(text, RG_DATE_SIZE, "%Y-%m-%d", &tm);
}
