#include "harness/compare/shrink/case.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/place.h"
#include "core/base/text/words.h"
#include "core/base/files/lines.h"
#include "harness/compare/shrink/files.h"
#include "harness/record/output.h"

enum { TEXT_SIZE = 1 << 16 };

// --- writing ---

static void write_setting(FILE *out, const struct rg_param *param, const void *settings,
                          void *defaults)
{
    char value[RG_PATH_SIZE], initial[RG_PATH_SIZE], name[RG_FILE_NAME];
    rg_params_text(param, settings, value, sizeof(value));
    rg_params_text(param, defaults, initial, sizeof(initial));
    if (!strcmp(value, initial))
        return;
    rg_file_sent_name(param, value, name);
    if (param->kind == RG_PARAM_FILE && rg_file_is_own(value))
        fprintf(out, "file %s=%s\n", param->name, name);
    else
        fprintf(out, "set %s=%s\n", param->name, value);
}

// Writes all settings that are not at their default. A preset comes first, because it sets others.
static void write_settings(FILE *out, const struct rg_subject *subject, void *defaults)
{
    const struct rg_param_table *table = subject->technique->params;
    const struct rg_param *preset = table->preset ? rg_params_find(table, table->preset) : NULL;
    char assignment[RG_PATH_SIZE + 64];
    if (preset) {
        write_setting(out, preset, subject->settings, defaults);
        const int used = snprintf(assignment, sizeof(assignment), "%s=", preset->name);
        rg_params_text(preset, subject->settings, assignment + used,
                       sizeof(assignment) - (size_t)used);
        rg_params_set(table, defaults, assignment);
    }
    for (int i = 0; i < table->count; i++)
        if (&table->rows[i] != preset)
            write_setting(out, &table->rows[i], subject->settings, defaults);
}

// An asset that differs before the first stage has no stage.
static const char *stage_name(const char *stage)
{
    return *stage ? stage : "-";
}

static void write_text(FILE *out, const struct rg_case *c, void *defaults, const char *note)
{
    const struct rg_subject *subject = &c->run.subject;
    fprintf(out, "# A difference between two devices: raingauge render --case FILE --device D\n");
    fprintf(out, "# %s\n", note);
    fprintf(out, "technique %s\nsize %dx%d\nframes %d\n", subject->technique->name, subject->width,
            subject->height, c->run.frames);
    write_settings(out, subject, defaults);
    fprintf(out, "behind %d\nstage %s\nasset %s\nclass %s\n", c->stages_run, stage_name(c->stage),
            c->asset,
            c->fall.outcome ? rg_outcome_name(c->fall.outcome) : rg_difference_name(c->difference));
    fprintf(out, "expected %016" PRIx64 "\n", c->expected);
    if (c->fall.outcome)
        fprintf(out, "fails %s\n", c->fall.what);
    else
        fprintf(out, "found %016" PRIx64 "\n", c->found);
    fprintf(out, "truth %s\ndevice %s\n", c->truth, c->device);
}

bool rg_case_write(const struct rg_case *c, const char *note, const char *path)
{
    char *text = NULL;
    size_t size;
    void *defaults = rg_settings_create(c->run.subject.technique);
    FILE *out = defaults ? open_memstream(&text, &size) : NULL;
    if (out)
        write_text(out, c, defaults, note);
    const bool ok = out && fclose(out) == 0 && rg_files_send(&c->run.subject, path) &&
                    rg_output_write_file(path, text);
    free(text);
    free(defaults);
    return ok;
}

// --- reading ---

static bool take_number(const char *text, int least, int *number)
{
    char *end;
    const long value = strtol(text, &end, 10);
    *number = (int)value;
    return end != text && !*end && value >= least && value <= 10000000;
}

static bool take_digest(const char *text, uint64_t *digest)
{
    *digest = strtoull(text, NULL, 16);
    return strlen(text) == 16 && strspn(text, "0123456789abcdef") == 16;
}

static bool take_size(const char *text, struct rg_subject *subject)
{
    enum { DIGITS = 5 }; // keeps the numbers within an int
    int end = 0;
    return strspn(text, "0123456789x") == strlen(text) && strcspn(text, "x") <= DIGITS &&
           sscanf(text, "%dx%5d%n", &subject->width, &subject->height, &end) == 2 && !text[end] &&
           subject->width > 0 && subject->height > 0 && subject->width <= 16384 &&
           subject->height <= 16384;
}

static bool take_technique(const char *text, struct rg_case *c)
{
    struct rg_subject *subject = &c->run.subject;
    if (subject->technique || !(subject->technique = rg_technique_find(text)))
        return false;
    subject->settings = rg_settings_create(subject->technique);
    return subject->settings != NULL;
}

static bool take_text(const char *text, char *to, size_t size)
{
    return *text && (size_t)snprintf(to, size, "%s", text) < size;
}

// A kind of difference, or of failure.
static bool take_class(const char *text, struct rg_case *c)
{
    c->difference = rg_difference_find(text);
    return c->difference != RG_DIFFERENCE_NONE ||
           (rg_outcome_find(text, &c->fall.outcome) && rg_outcome_is_broken(c->fall.outcome));
}

// Whether a line of a case can begin with this word.
static bool is_word(const char *word)
{
    return rg_has_word("technique size frames behind stage asset class fails expected found truth "
                       "device",
                       word);
}

static bool take_line(const char *word, const char *rest, struct rg_case *c)
{
    if (!strcmp(word, "technique"))
        return take_technique(rest, c);
    if (!strcmp(word, "size"))
        return take_size(rest, &c->run.subject);
    if (!strcmp(word, "frames"))
        return take_number(rest, 0, &c->run.frames);
    if (!strcmp(word, "behind"))
        return take_number(rest, 0, &c->stages_run);
    if (!strcmp(word, "stage"))
        return take_text(rest, c->stage, sizeof(c->stage));
    if (!strcmp(word, "asset"))
        return take_text(rest, c->asset, sizeof(c->asset));
    if (!strcmp(word, "class"))
        return take_class(rest, c);
    if (!strcmp(word, "fails"))
        return take_text(rest, c->fall.what, sizeof(c->fall.what));
    if (!strcmp(word, "expected"))
        return take_digest(rest, &c->expected);
    if (!strcmp(word, "found"))
        return take_digest(rest, &c->found);
    if (!strcmp(word, "truth"))
        return take_text(rest, c->truth, sizeof(c->truth));
    return !strcmp(word, "device") && take_text(rest, c->device, sizeof(c->device));
}

// The first words of lines, or the keys of settings, that were read; each may occur once. They
// point into the file's lines.
struct seen {
    int count;
    const char *words[256]; // more than there are valid words; reading ends at an invalid one
};

static bool comes_once(const char *word, struct seen *seen)
{
    const size_t length = strcspn(word, "=");
    for (int i = 0; i < seen->count; i++)
        if (length == strcspn(seen->words[i], "=") && !strncmp(word, seen->words[i], length))
            return false;
    seen->words[seen->count++] = word;
    return true;
}

// Reads a setting, "set KEY=VALUE" or "file KEY=NAME".
static bool read_setting(const char *path, int64_t number, bool is_file, const char *text,
                         struct seen *keys, struct rg_case *c)
{
    char place[RG_PATH_SIZE + 32];
    const struct rg_technique *technique = c->run.subject.technique;
    void *settings = (void *)(uintptr_t)c->run.subject.settings;
    if (!comes_once(text, keys))
        return rg_error("%s: line %lld: '%.*s' is set twice; leave one out", path,
                        (long long)number, (int)strcspn(text, "="), text);
    snprintf(place, sizeof(place), "%s: line %lld", path, (long long)number);
    rg_log_place(place);
    const bool ok = is_file ? rg_file_receive(technique, settings, text, path)
                            : rg_params_set(technique->params, settings, text);
    rg_log_place(NULL);
    return ok;
}

static bool read_line(const char *path, int64_t number, char *word, struct seen *seen,
                      struct seen *keys, struct rg_case *c)
{
    const char *rest = rg_line_cut(word);
    const bool is_file = !strcmp(word, "file");
    if (c->run.subject.technique && (is_file || !strcmp(word, "set")))
        return read_setting(path, number, is_file, rest, keys, c);
    if (!comes_once(word, seen))
        return rg_error("%s: line %lld: '%s' is there twice; leave one out", path,
                        (long long)number, word);
    if (take_line(word, rest, c))
        return true;
    return rg_error(is_word(word) ? "%s: line %lld: %.60s '%.200s' is no value of a case here; "
                                    "write one anew with `raingauge shrink`"
                                  : "%s: line %lld: '%.60s' is no line of a case here; write one "
                                    "anew with `raingauge shrink`",
                    path, (long long)number, word, rest);
}

bool rg_case_read(const char *path, struct rg_case *c)
{
    struct rg_lines lines;
    struct seen seen = {.count = 0}, keys = {.count = 0};
    *c = (struct rg_case){.run = {.frames = -1}, .stages_run = -1};
    bool ok = rg_lines_read(path, &lines);
    for (int64_t i = 0; ok && i < lines.count; i++)
        if (!rg_line_is_empty(&lines.lines[i]))
            ok = read_line(path, i + 1, rg_line_skip(lines.lines[i].text), &seen, &keys, c);
    rg_lines_free(&lines);
    if (ok && (!c->run.subject.settings || !c->run.subject.width || c->run.frames < 0 ||
               c->stages_run < 0 || !*c->stage || !*c->asset || !c->expected ||
               (!c->difference && !c->fall.outcome) || !*c->fall.what != !c->fall.outcome ||
               !*c->truth || !*c->device))
        ok = rg_error("%s: lacks its technique, size, frames, stage, what it is behind, asset, "
                      "class, expected digest or devices; write one anew with `raingauge shrink`",
                      path);
    return ok;
}

void rg_case_free(struct rg_case *c)
{
    free((void *)(uintptr_t)c->run.subject.settings);
    *c = (struct rg_case){0};
}
