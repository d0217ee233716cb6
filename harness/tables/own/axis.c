#include "harness/tables/own/axis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

static bool add(struct rg_axis *axis, const char *text, const char *value, size_t length)
{
    if (axis->count == RG_TABLE_ROWS)
        return rg_error("%s %s: more than %d values", axis->word, text, RG_TABLE_ROWS);
    if (!length || length >= RG_AXIS_VALUE || memchr(value, ' ', length))
        return rg_error("%s %s: write it as NAME=VALUE,VALUE or NAME=5,10..40", axis->word, text);
    char *to = axis->values[axis->count++];
    memcpy(to, value, length);
    to[length] = 0;
    return true;
}

static bool read_number(const char *text, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return end != text && !*end && isfinite(*number);
}

// Adds the values of a range "10..40" after another value: the first number, then equal steps.
static bool add_range(struct rg_axis *axis, const char *text, const char *from, const char *dots,
                      const char *to, size_t to_length)
{
    char second[RG_AXIS_VALUE], last[RG_AXIS_VALUE];
    double before, a, b;
    snprintf(second, sizeof(second), "%.*s", (int)(dots - from), from);
    snprintf(last, sizeof(last), "%.*s", (int)to_length, to);
    if (!axis->count || !read_number(axis->values[axis->count - 1], &before) ||
        !read_number(second, &a) || !read_number(last, &b))
        return rg_error("%s %s: a range goes on from a number before it, as in 5,10..40",
                        axis->word, text);
    const double step = a - before, steps = step != 0 ? floor((b - a) / step + 1e-9) : -1;
    if (!(steps >= 0)) // also if infinite numbers made it NAN
        return rg_error("%s %s: %s does not come after %s and %s", axis->word, text, last,
                        axis->values[axis->count - 1], second);
    for (double i = 0; i <= steps; i++) {
        char value[RG_AXIS_VALUE];
        const int length = snprintf(value, sizeof(value), "%.10g", a + i * step);
        if (!add(axis, text, value, (size_t)length))
            return false;
    }
    return true;
}

// The dots of a range, which follow a number; NULL if there is none, as in a path with two dots.
static const char *range_in(const char *value, size_t length)
{
    const char *dots = strstr(value, "..");
    char first[RG_AXIS_VALUE];
    double number;
    if (!dots || dots >= value + length || dots - value >= RG_AXIS_VALUE)
        return NULL;
    snprintf(first, sizeof(first), "%.*s", (int)(dots - value), value);
    return read_number(first, &number) ? dots : NULL;
}

bool rg_axis_read(const char *word, const char *text, struct rg_axis *axis)
{
    const char *equals = strchr(text, '=');
    *axis = (struct rg_axis){.word = word};
    if (!equals || equals == text || equals - text >= RG_AXIS_NAME)
        return rg_error("%s %s: write it as NAME=VALUE,VALUE or NAME=5,10..40", axis->word, text);
    memcpy(axis->name, text, (size_t)(equals - text));
    const char *from = equals + 1;
    for (bool more = true; more;) {
        const size_t length = strcspn(from, ",");
        const char *dots = range_in(from, length);
        more = from[length] == ',';
        if (dots) {
            if (!add_range(axis, text, from, dots, dots + 2, length - (size_t)(dots + 2 - from)))
                return false;
        } else if (!add(axis, text, from, length)) {
            return false;
        }
        from += length + 1;
    }
    return true;
}
