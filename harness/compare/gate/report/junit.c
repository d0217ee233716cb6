// JUnit's XML. https://docs.gitlab.com/ci/testing/unit_test_reports/
//
// It is written without a library, for the reason in docs/dependencies.md. The schema is
// tests/harness/gate/report/junit.xsd.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/report/texts.h"

enum { MOST_BYTES = 30 * 1000 * 1000 };

// The escape of a byte; NULL: written as it is. A reader drops unescaped line breaks and tabs of an
// attribute.
static const char *escape(char c, bool is_attribute)
{
    return c == '&'                    ? "&amp;"
           : c == '<'                  ? "&lt;"
           : c == '>'                  ? "&gt;"
           : c == '"'                  ? "&quot;"
           : is_attribute && c == '\n' ? "&#10;"
           : is_attribute && c == '\t' ? "&#9;"
                                       : NULL;
}

static void put(FILE *out, const char *text, size_t bytes, bool is_attribute)
{
    for (size_t i = 0; i < bytes; i++) {
        const char *escaped = escape(text[i], is_attribute);
        if (escaped)
            fputs(escaped, out);
        else
            fputc(text[i], out);
    }
}

static void put_attribute(FILE *out, const char *name, const char *text)
{
    fprintf(out, " %s=\"", name);
    put(out, text, strlen(text), true);
    fputc('"', out);
}

static double seconds_of(double seconds)
{
    return isfinite(seconds) && seconds > 0 ? seconds : 0;
}

// --- details, cut if the file would be too large ---

static size_t escaped_size(const char *text)
{
    size_t size = 0;
    for (; *text; text++) {
        const char *escaped = escape(*text, false);
        size += escaped ? strlen(escaped) : 1;
    }
    return size;
}

// Writes details up to `most` bytes, counted after escaping.
static void put_details(FILE *out, const char *details, size_t most)
{
    size_t bytes = 0, written = 0;
    for (; details[bytes]; bytes++) {
        const char *escaped = escape(details[bytes], false);
        written += escaped ? strlen(escaped) : 1;
        if (written > most)
            break;
    }
    bytes = rg_texts_fit(details, bytes);
    fputc('\n', out);
    put(out, details, bytes, false);
    if (details[bytes])
        fprintf(out, "\n... (%zu bytes more: the file would exceed %d MB)", strlen(details + bytes),
                MOST_BYTES / 1000000);
}

static size_t details_size(const struct rg_report *report, size_t most)
{
    size_t sum = 0;
    for (int i = 0; i < report->case_count; i++) {
        const size_t size = escaped_size(report->cases[i].details);
        sum += size < most ? size : most;
    }
    return sum;
}

// The most bytes that a case's details may have so that all of them fit into `room`; this cuts the
// longest first.
static size_t most_of_details(const struct rg_report *report, size_t room)
{
    size_t low = 0, high = MOST_BYTES;
    while (low < high) {
        const size_t middle = (low + high + 1) / 2;
        if (details_size(report, middle) <= room)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

// --- a case ---

// Repeats the message, for readers that show the body without the attributes.
static void put_body(FILE *out, const struct rg_report_case *told, size_t most)
{
    put(out, told->message, strlen(told->message), false);
    fprintf(out, *told->measured ? "\n%s" : "%s", told->measured);
    if (*told->details)
        put_details(out, told->details, most);
}

// GitLab shows pictures that system-out names in this form; it has no escape for a path.
static void put_attachments(FILE *out, const struct rg_report_case *told)
{
    if (!told->attachment_count)
        return;
    fprintf(out, "   <system-out>");
    for (int i = 0; i < told->attachment_count; i++) {
        const char *path = told->attachments[i];
        const bool is_safe = !strstr(path, "]]") && path[strlen(path) - 1] != ']';
        fputs(is_safe ? "[[ATTACHMENT|" : "not attached, for its name: ", out);
        put(out, path, strlen(path), false);
        fputs(is_safe ? "]]\n" : "\n", out);
    }
    fprintf(out, "</system-out>\n");
}

// A case that passes has its body in system-err: in system-out GitLab could take part of a message
// for a picture.
static void put_case(FILE *out, const struct rg_report_case *told, size_t most)
{
    const char *element = rg_ending_element(told->ending);
    const bool passes = !element;
    fprintf(out, "  <testcase");
    put_attribute(out, "name", told->name);
    put_attribute(out, "classname", told->technique);
    fprintf(out, " time=\"%.3f\">\n", seconds_of(told->seconds));
    if (passes)
        put_attachments(out, told); // the schema wants system-out first
    fprintf(out, "   <%s", passes ? "system-err" : element);
    if (!passes)
        put_attribute(out, "message", told->message);
    if (rg_ending_fails(told->ending))
        put_attribute(out, "type", rg_ending_name(told->ending));
    fputc('>', out);
    fprintf(out, "%s: ", rg_ending_name(told->ending));
    put_body(out, told, most);
    fprintf(out, "</%s>\n", passes ? "system-err" : element);
    if (!passes)
        put_attachments(out, told);
    fprintf(out, "  </testcase>\n");
}

// --- the file ---

static int count_of(const struct rg_report *report, const char *element)
{
    int count = 0;
    for (int i = 0; i < report->case_count; i++) {
        const char *of = rg_ending_element(report->cases[i].ending);
        count += of && !strcmp(of, element);
    }
    return count;
}

static void put_head(FILE *out, const struct rg_report *report, const char *element)
{
    double seconds = 0;
    for (int i = 0; i < report->case_count; i++)
        seconds += seconds_of(report->cases[i].seconds);
    fprintf(out,
            "<%s name=\"raingauge gate\" tests=\"%d\" failures=\"%d\" errors=\"%d\" "
            "skipped=\"%d\" time=\"%.3f\">\n",
            element, report->case_count, count_of(report, "failure"), count_of(report, "error"),
            count_of(report, "skipped"), seconds);
}

static void put_report(FILE *out, const struct rg_report *report, size_t most)
{
    fprintf(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    put_head(out, report, "testsuites");
    fputc(' ', out);
    put_head(out, report, "testsuite");
    fprintf(out, "  <properties><property name=\"passport\"");
    put_attribute(out, "value", report->passport ? report->passport : "");
    fprintf(out, "/></properties>\n");
    for (int i = 0; i < report->case_count; i++)
        put_case(out, &report->cases[i], most);
    fprintf(out, " </testsuite>\n</testsuites>\n");
}

// The file's size when all details are cut to nothing.
static bool size_without_details(const struct rg_report *report, size_t *size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (out)
        put_report(out, report, 0);
    const bool is_held = out && !ferror(out);
    const bool is_counted = out && fclose(out) == 0 && is_held;
    free(text);
    return is_counted || rg_harness_error("JUnit: no memory for %d cases; close other programs",
                                          report->case_count);
}

bool rg_report_junit(const struct rg_report *report, FILE *out)
{
    size_t size;
    if (!size_without_details(report, &size))
        return false;
    if (size >= MOST_BYTES)
        return rg_error("JUnit: %d cases exceed %d MB without their details; gate fewer at once",
                        report->case_count, MOST_BYTES / 1000000);
    put_report(out, report, most_of_details(report, MOST_BYTES - 1 - size));
    return true;
}
