#include "harness/compare/gate/report/report.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/text/add.h"
#include "core/image/files/temporary.h"
#include "harness/compare/gate/report/texts.h"
#include "harness/console/exit.h"

static const struct {
    const char *element;
    int exit;
} endings[RG_ENDING_COUNT] = {
    [RG_ENDING_CRASH] = {"error", RG_EXIT_FAIL},
    [RG_ENDING_TIMEOUT] = {"error", RG_EXIT_FAIL},
    [RG_ENDING_ERROR] = {"error", RG_EXIT_FAIL},
    [RG_ENDING_SETUP] = {"error", RG_EXIT_FAIL},
    [RG_ENDING_LACKING] = {"error", RG_EXIT_HARNESS},
    [RG_ENDING_DIFFERS] = {"failure", RG_EXIT_FAIL},
    [RG_ENDING_UNEXPECTED_PASS] = {"failure", RG_EXIT_FAIL},
    [RG_ENDING_NOTHING_MEASURED] = {"error", RG_EXIT_NOTHING},
    [RG_ENDING_REGRESSED] = {"failure", RG_EXIT_FAIL},
    [RG_ENDING_INCONCLUSIVE] = {"skipped", RG_EXIT_INCONCLUSIVE},
    [RG_ENDING_FLAKE] = {"skipped", RG_EXIT_PASS},
    [RG_ENDING_EXPECTED_FAILURE] = {"skipped", RG_EXIT_PASS},
    [RG_ENDING_UNSUPPORTED] = {"skipped", RG_EXIT_UNSUPPORTED},
    [RG_ENDING_SKIPPED] = {"skipped", RG_EXIT_PASS},
    [RG_ENDING_IMPROVED] = {NULL, RG_EXIT_PASS},
    [RG_ENDING_PASS] = {NULL, RG_EXIT_PASS},
};

const char *rg_ending_element(enum rg_ending ending)
{
    return endings[ending].element;
}

int rg_ending_exit(enum rg_ending ending)
{
    return endings[ending].exit;
}

// --- texts owned by the report ---

// Makes the report the owner of memory. On failure it frees the memory and returns NULL.
static void *keep(struct rg_report *report, void *memory)
{
    if (memory && rg_array_fit(&report->texts, &report->text_room, report->text_count + 1,
                               sizeof(*report->texts), "texts of a report"))
        return report->texts[report->text_count++] = memory;
    free(memory);
    return NULL;
}

static const char *keep_text(struct rg_report *report, const char *text, bool is_line)
{
    return keep(report, rg_texts_clean(text ? text : "", is_line));
}

// Keeps a text as one line, cut if longer than RG_REPORT_LINE.
static const char *keep_line(struct rg_report *report, const char *text)
{
    char *line = keep(report, rg_texts_clean(text ? text : "", true));
    const size_t length = line ? strlen(line) : 0;
    if (length <= RG_REPORT_LINE)
        return line;
    enum { TAIL = 40 };
    const size_t fits = rg_texts_fit(line, RG_REPORT_LINE - TAIL);
    snprintf(line + fits, TAIL, "... (%zu bytes more)", length - fits);
    return line;
}

static const char *const *keep_lines(struct rg_report *report, const char *const *lines, int count)
{
    const char **kept = keep(report, rg_alloc((size_t)count, sizeof(*kept), "a report"));
    for (int i = 0; kept && i < count; i++)
        if (!(kept[i] = keep_line(report, lines[i])))
            return NULL;
    return kept;
}

// --- names ---

bool rg_report_has(const struct rg_report *report, const char *name)
{
    for (int i = 0; i < report->case_count; i++)
        if (!strcmp(report->cases[i].name, name))
            return true;
    return false;
}

// Makes the name unique among the cases.
static const char *keep_name(struct rg_report *report, const char *name)
{
    enum { TAIL = 32 };
    const char *clean = keep_text(report, name, true);
    char *made = clean ? keep(report, rg_alloc(strlen(clean) + TAIL, 1, "a report")) : NULL;
    if (!made)
        return NULL;
    size_t length = strlen(strcpy(made, clean));
    if (length > RG_REPORT_NAME) {
        const uint64_t hash = XXH3_64bits(name, strlen(name));
        length = rg_texts_fit(clean, RG_REPORT_NAME - TAIL);
        length += (size_t)snprintf(made + length, TAIL, "...%016" PRIx64, hash);
    }
    for (int number = 2; rg_report_has(report, made); number++)
        snprintf(made + length, TAIL, " (%d)", number);
    return made;
}

// --- a report ---

static const char *keep_measured(struct rg_report *report, const struct rg_report_case *found)
{
    enum { MEASURED = 160 };
    const struct rg_bounded *ratio = &found->ratio;
    char text[MEASURED] = "";
    if (isfinite(ratio->value))
        rg_text_add(text, MEASURED, "", "ratio %.4g", ratio->value);
    if (*text && isfinite(ratio->low) && isfinite(ratio->high))
        rg_text_add(text, MEASURED, " ", "(%.4g to %.4g)", ratio->low, ratio->high);
    if (*text && isfinite(found->smallest_visible))
        rg_text_add(text, MEASURED, ", ", "would have seen %.3g %%", 100 * found->smallest_visible);
    return keep_text(report, text, true);
}

bool rg_report_add(struct rg_report *report, const struct rg_report_case *found)
{
    struct rg_report_case added = *found;
    added.name = keep_name(report, found->name ? found->name : "");
    added.technique = keep_line(report, found->technique);
    added.message = keep_line(report, found->message);
    added.details = keep_text(report, found->details, false);
    added.measured = keep_measured(report, found);
    added.devices = keep_lines(report, found->devices, found->device_count);
    added.attachments = keep_lines(report, found->attachments, found->attachment_count);
    if (!added.name || !added.technique || !added.message || !added.details || !added.measured ||
        !added.devices || !added.attachments ||
        !rg_array_fit(&report->cases, &report->case_room, report->case_count + 1,
                      sizeof(*report->cases), "cases of a report") ||
        !rg_array_fit(&report->order, &report->order_room, report->case_count + 1,
                      sizeof(*report->order), "cases of a report"))
        return false;
    int place = report->case_count;
    for (; place && report->cases[report->order[place - 1]].ending > added.ending; place--)
        report->order[place] = report->order[place - 1];
    report->order[place] = report->case_count;
    report->cases[report->case_count++] = added;
    report->idle_count += !added.is_compared && (added.ending == RG_ENDING_FLAKE ||
                                                 added.ending == RG_ENDING_EXPECTED_FAILURE);
    return true;
}

bool rg_report_set_passport(struct rg_report *report, const char *passport)
{
    return (report->passport = keep_text(report, passport, false)) != NULL;
}

bool rg_report_set_drivers(struct rg_report *report, const char *drivers)
{
    return (report->drivers = keep_text(report, drivers, false)) != NULL;
}

void rg_report_free(struct rg_report *report)
{
    for (int i = 0; i < report->text_count; i++)
        free(report->texts[i]);
    free(report->texts);
    free(report->cases);
    free(report->order);
    *report = (struct rg_report){0};
}

int rg_report_count(const struct rg_report *report, enum rg_ending ending)
{
    int count = 0;
    for (int i = 0; i < report->case_count; i++)
        count += report->cases[i].ending == ending;
    return count;
}

bool rg_report_write(const struct rg_report *report, rg_report_writer form, const char *path)
{
    struct rg_temporary temporary;
    struct rg_why why;
    if (!rg_temporary_make(path, &temporary, &why))
        return rg_why_tell(&why, path);
    FILE *out = fopen(temporary.path, "w");
    const bool is_made = out && form(report, out);
    bool is_written = out && !ferror(out);
    is_written = out && fclose(out) == 0 && is_written;
    if (!is_written)
        rg_system_error(errno, "%s: cannot be written: %s; what was there is unchanged", path,
                        strerror(errno));
    const bool is_whole = is_made && is_written;
    return rg_temporary_end(&temporary, is_whole, &why) ? is_whole
                                                        : is_whole && rg_why_tell(&why, path);
}

void rg_report_summary(const struct rg_report *report, char text[RG_REPORT_SUMMARY])
{
    snprintf(text, RG_REPORT_SUMMARY, "%d case%s", report->case_count,
             report->case_count == 1 ? "" : "s");
    for (int i = 0; i < RG_ENDING_COUNT; i++) {
        const int count = rg_report_count(report, (enum rg_ending)i);
        if (count)
            rg_text_add(text, RG_REPORT_SUMMARY, ", ", "%d %s", count,
                        rg_ending_name((enum rg_ending)i));
    }
    if (report->idle_count)
        rg_text_add(text, RG_REPORT_SUMMARY, "; ", "%d of them compared nothing",
                    report->idle_count);
}
