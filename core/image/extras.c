#include "core/image/extras.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void clean(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 127)
            *text = '?';
}

bool rg_extras_add(char **extras, bool is_applied, const char *name, const char *format, ...)
{
    char key[400], value[400];
    snprintf(key, sizeof(key), "%s", name);
    va_list args;
    va_start(args, format);
    vsnprintf(value, sizeof(value), format, args);
    va_end(args);
    clean(key);
    clean(value);
    const size_t length = *extras ? strlen(*extras) : 0;
    const size_t more = strlen(key) + strlen(value) + 4; // the mark, the tab, the newline, the 0
    char *longer = realloc(*extras, length + more);
    if (!longer)
        return false;
    snprintf(longer + length, more, "%s%s\t%s\n", is_applied ? "" : "!", key, value);
    *extras = longer;
    return true;
}

bool rg_extras_next(const char **at, struct rg_extra *extra)
{
    const char *line = *at;
    if (!line || !*line)
        return false;
    const int length = (int)strcspn(line, "\n");
    *at = line + length + (line[length] == '\n');
    extra->is_applied = *line != '!';
    extra->name = line + !extra->is_applied;
    extra->name_length = (int)strcspn(extra->name, "\t\n");
    extra->value = extra->name + extra->name_length;
    extra->value += *extra->value == '\t';
    extra->value_length = (int)(line + length - extra->value);
    return true;
}

// Finds the extra of the same name in another text; if there is none, `found` has the value "none".
static bool find(const char *extras, const struct rg_extra *like, struct rg_extra *found)
{
    while (rg_extras_next(&extras, found))
        if (found->name_length == like->name_length &&
            !memcmp(found->name, like->name, (size_t)like->name_length))
            return true;
    *found = *like;
    found->value = "none";
    found->value_length = 4;
    return false;
}

int rg_extras_compare(const char *a, const char *b, rg_extras_differ *differ, void *user)
{
    struct rg_extra one, other;
    int count = 0;
    for (const char *at = a; rg_extras_next(&at, &one);)
        if (!find(b, &one, &other) || one.value_length != other.value_length ||
            memcmp(one.value, other.value, (size_t)one.value_length) != 0) {
            differ(user, &one, &other);
            count++;
        }
    for (const char *at = b; rg_extras_next(&at, &one);)
        if (!find(a, &one, &other)) {
            differ(user, &other, &one);
            count++;
        }
    return count;
}
