// Writes the report on stdin in one form, so that a script can read it back.
//
// tell FORM PATH      junit, bmf, json, text, coloured, annotations, gtest or summary; again: json
// of
//                     the cases that are read from json; PATH "-" is stdout
// tell list FILTER    prints the list of --gtest_list_tests
// tell matches        stdin: pairs of filter and name; prints 1 or 0 for each
// tell names          prints the names for gtest, one a line
//
// stdin has fields that each end in a byte 0. The first is the passport. Each case then has its
// name, technique, device, seconds, ending by number, message, details, picture, the ratio's value,
// low and high, the smallest visible change, the time's value, low and high, and the baseline's
// time.
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/compare/gate/report/report.h"

enum { FIELDS = 16, MOST_BYTES = 100 * 1000 * 1000 };

static const char *next(const char **at, const char *end)
{
    if (*at >= end)
        return NULL;
    const char *field = *at;
    *at += strlen(field) + 1;
    return field;
}

static bool add(struct rg_report *report, const char *const *f)
{
    const struct rg_report_case told = {
        .name = f[0],
        .technique = f[1],
        .devices = &f[2],
        .device_count = 1,
        .seconds = atof(f[3]),
        .ending = (enum rg_ending)atoi(f[4]),
        .message = f[5],
        .details = f[6],
        .attachments = &f[7],
        .attachment_count = *f[7] != 0,
        .ratio = {atof(f[8]), atof(f[9]), atof(f[10])},
        .smallest_visible = atof(f[11]),
        .time_ms = {atof(f[12]), atof(f[13]), atof(f[14])},
        .baseline_ms = atof(f[15]),
    };
    return rg_report_add(report, &told);
}

static bool fill(struct rg_report *report, const char *at, const char *end)
{
    const char *passport = next(&at, end);
    if (!passport || !rg_report_set_passport(report, passport))
        return false;
    for (const char *first; (first = next(&at, end));) {
        const char *fields[FIELDS] = {first};
        for (int i = 1; i < FIELDS; i++)
            if (!(fields[i] = next(&at, end)))
                return false;
        if (!add(report, fields))
            return false;
    }
    return true;
}

static bool coloured(const struct rg_report *report, FILE *out)
{
    return rg_report_text_coloured(report, out, true);
}

static bool names(const struct rg_report *report, FILE *out)
{
    char made[RG_GTEST_NAME];
    for (int i = 0; i < report->case_count; i++) {
        rg_gtest_name(report->cases[i].name, made);
        fprintf(out, "%s\n", made);
    }
    return true;
}

static bool again(const struct rg_report *report, FILE *out)
{
    json_t *document = rg_report_document(report), *found;
    struct rg_report read = {.case_count = 0};
    bool ok = document && rg_report_set_passport(&read, report->passport);
    size_t i;
    json_array_foreach(json_object_get(document, "gated"), i, found)
    {
        ok = ok && rg_report_read(&read, found);
    }
    ok = ok && rg_report_json(&read, out);
    rg_report_free(&read);
    json_decref(document);
    return ok;
}

static bool print_matches(const char *at, const char *end)
{
    for (const char *filter, *name; (filter = next(&at, end)) && (name = next(&at, end));)
        putchar(rg_gtest_matches(filter, name) ? '1' : '0');
    return true;
}

static const struct {
    const char *name;
    rg_report_writer form;
} forms[] = {
    {"junit", rg_report_junit}, {"bmf", rg_report_bmf}, {"json", rg_report_json},
    {"text", rg_report_text},   {"coloured", coloured}, {"annotations", rg_report_annotations},
    {"gtest", rg_gtest_print},  {"names", names},       {"again", again}};

static bool list(const struct rg_report *report, const char *filter)
{
    char made[RG_GTEST_NAME];
    json_t *names = json_array();
    for (int i = 0; i < report->case_count; i++) {
        rg_gtest_name(report->cases[i].name, made);
        if (rg_gtest_matches(filter, made))
            json_array_append_new(names, json_string(report->cases[i].name));
    }
    rg_gtest_list(stdout, names);
    json_decref(names);
    return true;
}

static bool tell(const struct rg_report *report, const char *form, const char *path)
{
    if (!strcmp(form, "summary"))
        return rg_report_append(report, &rg_report_forms[RG_AS_SUMMARY], path);
    if (!strcmp(form, "list"))
        return list(report, path);
    for (size_t i = 0; i < sizeof(forms) / sizeof(*forms); i++)
        if (!strcmp(forms[i].name, form))
            return strcmp(path, "-") ? rg_report_write(report, forms[i].form, path)
                                     : forms[i].form(report, stdout);
    return false;
}

int main(int argc, char **argv)
{
    char *text = malloc(MOST_BYTES);
    if (argc < 3 || !text)
        return 2;
    const size_t bytes = fread(text, 1, MOST_BYTES - 1, stdin);
    text[bytes] = 0;
    struct rg_report report = {0};
    const bool is_told = !strcmp(argv[1], "matches")
                             ? print_matches(text, text + bytes)
                             : fill(&report, text, text + bytes) && tell(&report, argv[1], argv[2]);
    rg_report_free(&report);
    free(text);
    return is_told ? 0 : 1;
}
