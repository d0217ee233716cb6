#include "harness/tables/sheet/digits.h"

#include <ctype.h>
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

// The length of a name without these last words; the whole length if it ends otherwise.
static size_t length_without(const char *name, const char *words)
{
    const size_t length = strlen(name), end = strlen(words);
    return end && length > end + 1 && name[length - end - 1] == '_' &&
                   !strcmp(name + length - end, words)
               ? length - end - 1
               : length;
}

// Names end in their unit, with or without a leading 1, "m_s" for "m/s", or in its first word,
// "deg" for "deg/frame".
static size_t length_without_unit(const char *name, const char *unit)
{
    char words[32];
    size_t used = 0;
    for (const char *c = unit; *c && used + 1 < sizeof(words); c++)
        if (isalnum((unsigned char)*c))
            words[used++] = (char)tolower((unsigned char)*c);
        else if (used && words[used - 1] != '_')
            words[used++] = '_';
    while (used && words[used - 1] == '_')
        used--;
    words[used] = 0;
    const size_t whole = strlen(name);
    size_t length = length_without(name, words);
    if (length == whole && !strncmp(words, "1_", 2))
        length = length_without(name, words + 2);
    if (length == whole) {
        words[strcspn(words, "_")] = 0;
        length = length_without(name, words);
    }
    return length;
}

// The unit of a column that is not a parameter; NULL if it has none.
static const char *unit_of(const char *name, size_t *length)
{
    static const struct {
        const char *end, *unit;
    } units[] = {{"m", "m"},       {"mm", "mm"}, {"px", "px"},
                 {"per_s", "1/s"}, {"s", "s"},   {"ms", "ms"}};
    for (size_t i = 0; i < sizeof(units) / sizeof(units[0]); i++) {
        *length = length_without(name, units[i].end);
        if (name[*length])
            return units[i].unit;
    }
    return NULL;
}

void rg_digits_heading(const char *name, const char *unit, char *text, size_t size)
{
    size_t length = strlen(name);
    if (!unit)
        unit = unit_of(name, &length);
    else if (!strcmp(unit, "1") || !strcmp(unit, "file"))
        unit = NULL;
    else
        length = length_without_unit(name, unit);
    for (size_t i = 0; i < length && i + 1 < size; i++)
        text[i] = (char)(name[i] == '_' ? ' ' : name[i]);
    length = length < size ? length : size - 1;
    snprintf(text + length, size - length, "%s%s", unit ? ", " : "", unit ? unit : "");
}
