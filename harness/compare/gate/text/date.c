#include "harness/compare/gate/text/date.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

// Rejects an impossible day such as 02-30 by writing the result back: it gives another text.
bool rg_date_read(const char *text, int *day)
{
    static const int before[] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
    enum { LEAP_DAYS = 1969 / 4 - 1969 / 100 + 1969 / 400 }; // before 1970
    int year, month, of_month;
    char again[RG_DATE_SIZE];
    if (sscanf(text, "%4d-%2d-%2d", &year, &month, &of_month) != 3 || year < 1970 || month < 1 ||
        month > 12)
        return false;
    const int past = month > 2 ? year : year - 1; // the last year whose February is over
    *day = 365 * (year - 1970) + past / 4 - past / 100 + past / 400 - LEAP_DAYS +
           before[month - 1] + of_month - 1;
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
