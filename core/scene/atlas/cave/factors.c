#include "core/scene/atlas/cave/factors.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"

// Reads a file word by word. `line` is for messages.
struct reader {
    FILE *file;
    const char *path;
    struct rg_cave_why *why;
    int line;
    char word[32];
};

bool rg_cave_refuse(struct rg_cave_why *why, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(why->text, sizeof(why->text), format, args);
    va_end(args);
    return false;
}

// False at the end of the file.
static bool next_word(struct reader *r)
{
    int c = fgetc(r->file);
    for (; c != EOF && isspace(c); c = fgetc(r->file))
        r->line += c == '\n';
    size_t length = 0;
    for (; c != EOF && !isspace(c); c = fgetc(r->file))
        if (length + 1 < sizeof(r->word))
            r->word[length++] = (char)c;
    r->word[length] = 0;
    if (c == '\n')
        ungetc(c, r->file);
    return length > 0;
}

// The whole number after a prefix such as "cv"; false when the word is not of that form.
static bool take_angle(const char *word, const char *prefix, int *angle)
{
    const size_t length = strlen(prefix);
    char *end;
    if (strncmp(word, prefix, length))
        return false;
    const long number = strtol(word + length, &end, 10);
    *angle = (int)number;
    return end != word + length && !*end && labs(number) <= 360;
}

static bool take_factors(struct reader *r, float factors[RG_ATLAS_OSCILLATIONS])
{
    for (int k = 0; k < RG_ATLAS_OSCILLATIONS; k++) {
        char *end = r->word;
        const double value = next_word(r) ? strtod(r->word, &end) : 0;
        if (end == r->word || *end || !(value >= 0 && value <= 1e6))
            return rg_cave_refuse(r->why,
                                  "%s: line %d: '%s' stands where one of %d factors should; copy "
                                  "the file again",
                                  r->path, r->line, r->word, RG_ATLAS_OSCILLATIONS);
        factors[k] = (float)value;
    }
    return true;
}

static FILE *open_text(const char *path, struct rg_cave_why *why)
{
    const char *reason;
    FILE *file = rg_file_open_text(path, &reason);
    if (!file)
        rg_cave_refuse(why, "%s: %s; name the folder that holds the whole database", path, reason);
    return file;
}

static bool unknown_word(const struct reader *r)
{
    return rg_cave_refuse(r->why,
                          "%s: line %d: '%s' is no angle that the database has; copy the "
                          "file again",
                          r->path, r->line, r->word);
}

bool rg_cave_point_factors(const char *path, int view, struct rg_cave_factors *factors,
                           struct rg_cave_why *why)
{
    for (int i = 0; i < RG_ATLAS_CELLS; i++)
        factors->known[i / RG_ATLAS_PHIS][i % RG_ATLAS_PHIS] = false;
    struct reader r = {.file = open_text(path, why), .path = path, .why = why, .line = 1};
    if (!r.file)
        return false;
    bool good = true;
    int light = -1, angle = 0;
    while (good && next_word(&r)) {
        if (take_angle(r.word, "cv", &angle)) {
            good = angle == 20 * view || unknown_word(&r);
        } else if (take_angle(r.word, "v", &angle)) {
            light = (angle + 90) / 20;
            good = (angle >= -90 && angle <= 90 && (angle + 90) % 20 == 0) || unknown_word(&r);
        } else if (take_angle(r.word, "h", &angle) && light >= 0 && angle >= 10 && angle <= 170 &&
                   angle % 20 == 10) {
            const int phi = (angle - 10) / 20;
            good = take_factors(&r, factors->factor[light][phi]);
            factors->known[light][phi] = good;
        } else {
            good = unknown_word(&r);
        }
    }
    fclose(r.file);
    return good;
}

bool rg_cave_env_factors(const char *path, float factors[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS],
                         struct rg_cave_why *why)
{
    bool known[RG_ATLAS_VIEWS] = {false}, good = true;
    struct reader r = {.file = open_text(path, why), .path = path, .why = why, .line = 1};
    if (!r.file)
        return false;
    int angle = 0;
    while (good && next_word(&r)) {
        float row[RG_ATLAS_OSCILLATIONS];
        good = (take_angle(r.word, "cv", &angle) && angle >= 0 && angle <= 80 && angle % 20 == 0)
                   ? take_factors(&r, row)
                   : unknown_word(&r);
        for (int k = 0; good && k < RG_ATLAS_OSCILLATIONS; k++)
            factors[k][angle / 20] = row[k];
        if (good)
            known[angle / 20] = true;
    }
    fclose(r.file);
    for (int view = 0; good && view < RG_ATLAS_VIEWS; view++)
        good = known[view] ||
               rg_cave_refuse(why, "%s: no factors for cv%d; copy the file again", path, 20 * view);
    return good;
}
