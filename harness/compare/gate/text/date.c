#include "harness/compare/gate/text/date.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>

static bool is_leap(int year)
{
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

static int days_in(int year, int month)
{
    static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return days[month - 1] + (month == 2 && is_leap(year));
}

static bool has_form(const char *text)
{
    static const char form[] = "0000-00-00";
    for (int i = 0; form[i]; i++)
        if (form[i] == '-' ? text[i] != '-' : !isdigit((unsigned char)text[i]))
            return false;
    return !text[sizeof(form) - 1];
}

bool rg_date_read(const char *text, int *day)
{
    if (!has_form(text))
        return false;
    const int year = atoi(text), month = atoi(text + 5), of_month = atoi(text + 8);
    if (year < 1970 || month < 1 || month > 12 || of_month < 1 || of_month > days_in(year, month))
        return false;
    *day = of_month - 1;
    for (int y = 1970; y < year; y++)
        *day += 365 + is_leap(y);
    for (int m = 1; m < month; m++)
        *day += days_in(year, m);
    return true;
}

void rg_date_write(int day, char text[RG_DATE_SIZE])
{
    int year = 1970, month = 1;
    for (; day >= 365 + is_leap(year); year++)
        day -= 365 + is_leap(year);
    for (; day >= days_in(year, month); month++)
        day -= days_in(year, month);
    snprintf(text, RG_DATE_SIZE, "%04d-%02d-%02d", year % 10000, month % 100, (day + 1) % 100);
}
