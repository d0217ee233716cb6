// The page in short: Markdown, and a badge.
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/add.h"
#include "harness/record/ending.h"
#include "harness/report/page.h"

enum { ROOM_FOR_END = 500, MOST_TEXT = 300, WORST = 3 };

// A text that is written, with the number of parts that had no room.
struct brief {
    FILE *out;
    size_t size;
    int left_out;
};

// Adds a line if there is room for it.
static void __attribute__((format(printf, 2, 3))) put(struct brief *brief, const char *format, ...)
{
    char line[4096];
    va_list args;
    va_start(args, format);
    const int length = vsnprintf(line, sizeof(line), format, args);
    va_end(args);
    if (length < 0 || length >= (int)sizeof(line) ||
        brief->size + (size_t)length > RG_PAGE_BRIEF - ROOM_FOR_END) {
        brief->left_out++;
        return;
    }
    brief->size += (size_t)length;
    fwrite(line, 1, (size_t)length, brief->out);
}

// A field's text in one line, with the marks of Markdown and HTML escaped. An `@` is replaced,
// because it would call the user of that name.
static const char *text_of(const json_t *object, const char *field, char text[4 * MOST_TEXT])
{
    const char *from = json_string_value(json_object_get(object, field));
    size_t length = 0;
    for (int i = 0; from && from[i] && (i < MOST_TEXT || (from[i] & 0xC0) == 0x80); i++) {
        const unsigned char c = (unsigned char)from[i];
        if (c == '@')
            length += (size_t)sprintf(text + length, "(at)");
        else if (strchr("\\`*_{}[]<>()#|~&!$", c))
            length += (size_t)sprintf(text + length, "\\%c", c);
        else
            text[length++] = c < ' ' ? ' ' : (char)c;
        if (length > 4 * MOST_TEXT - 8)
            break;
    }
    text[length] = 0;
    return text;
}

// --- findings, the worst first ---

// The index of the last record of a kind; the number of records if there is none.
static size_t last_of(const struct rg_page *page, const char *kind)
{
    size_t i, last = json_array_size(page->records);
    json_t *record;
    json_array_foreach(page->records, i, record)
    {
        last = rg_page_is(record, "kind", kind) ? i : last;
    }
    return last;
}

// Calls `tell` for each element of an array in the records of a kind. Earlier gates than the last
// are left out: they are the history that the page shows.
static void each(const struct rg_page *page, const char *kind, const char *array,
                 void (*tell)(const json_t *element, void *user), void *user)
{
    const size_t last_gate = last_of(page, "gate");
    size_t i, k;
    json_t *record, *element;
    json_array_foreach(page->records, i, record)
    {
        const json_t *elements = json_object_get(json_object_get(record, "document"), array);
        if (!rg_page_is(record, "kind", kind) ||
            (rg_page_is(record, "kind", "gate") && i != last_gate))
            continue;
        json_array_foreach(elements, k, element)
        {
            tell(element, user);
        }
    }
}

struct finding {
    struct brief *brief;
    const char *wanted; // the ending that is printed now
    int count, most;
};

static void tell_case(const json_t *element, void *user)
{
    struct finding *f = user;
    char name[4 * MOST_TEXT], message[4 * MOST_TEXT];
    if (rg_page_is(element, "ending", f->wanted) && f->count < f->most) {
        f->count++;
        put(f->brief, "| %s | %s | %s |\n", f->wanted, text_of(element, "name", name),
            text_of(element, "message", message));
    }
}

static void tell_check(const json_t *element, void *user)
{
    struct finding *f = user;
    char check[4 * MOST_TEXT], detail[4 * MOST_TEXT], technique[4 * MOST_TEXT],
        device[4 * MOST_TEXT];
    if (!rg_page_is(element, "status", f->wanted) || f->count >= f->most)
        return;
    f->count++;
    put(f->brief, "| %s | %s, %s on %s | %s |\n", f->wanted,
        text_of(element, "technique", technique), text_of(element, "check", check),
        text_of(element, "device", device), text_of(element, "detail", detail));
}

// Prints the worst findings of gates and verify, at most `most`; returns their number.
static int tell_findings(const struct rg_page *page, struct brief *brief, int most)
{
    static const char *const statuses[] = {"crash", "timeout", "error", "fail"};
    struct finding f = {brief, "", 0, most};
    for (enum rg_ending i = 0; i <= RG_ENDING_PASS; i++) {
        f.wanted = rg_ending_name(i);
        if (rg_ending_fails(i))
            each(page, "gate", "gated", tell_case, &f);
    }
    for (int i = 0; i < 4; i++) {
        f.wanted = statuses[i];
        each(page, "verify", "checks", tell_check, &f);
    }
    return f.count;
}

// --- counts ---

struct counts {
    int cases, failing, checks, checks_failing;
};

static void count_case(const json_t *element, void *user)
{
    struct counts *counts = user;
    counts->cases++;
    for (enum rg_ending i = 0; i <= RG_ENDING_PASS; i++)
        counts->failing += rg_ending_fails(i) && rg_page_is(element, "ending", rg_ending_name(i));
}

static void count_check(const json_t *element, void *user)
{
    struct counts *counts = user;
    counts->checks++;
    counts->checks_failing += !rg_page_is(element, "status", "ok") &&
                              !rg_page_is(element, "status", "unsupported") &&
                              !rg_page_is(element, "status", "nothing");
}

static struct counts count(const struct rg_page *page)
{
    struct counts counts = {0};
    each(page, "gate", "gated", count_case, &counts);
    each(page, "verify", "checks", count_check, &counts);
    return counts;
}

// --- Markdown ---

// Whether verdicts are of several machines; the claims of other records name none.
static bool are_of_several(const json_t *claims)
{
    const json_t *first = NULL;
    size_t i, k;
    json_t *claim, *verdict;
    json_array_foreach(claims, i, claim)
    {
        json_array_foreach(json_object_get(claim, "verdicts"), k, verdict)
        {
            const json_t *machine = json_object_get(verdict, "machine");
            first = first ? first : machine;
            if (machine && !json_equal(machine, first))
                return true;
        }
    }
    return false;
}

// Writes the verdicts of a claim on a device (NULL: on all): "cpu: reproduced", or "cpu on A:
// reproduced" if they are of several machines.
static void write_verdicts(const json_t *claim, const char *on, bool of_several, char *line,
                           size_t size)
{
    size_t i;
    json_t *verdict;
    *line = 0;
    json_array_foreach(json_object_get(claim, "verdicts"), i, verdict)
    {
        char device[4 * MOST_TEXT], text[4 * MOST_TEXT], machine[4 * MOST_TEXT];
        if (on && !rg_page_is(verdict, "device", on))
            continue;
        text_of(verdict, "machine", machine);
        rg_text_add(line, size, ", ", "%s%s%s: %s", text_of(verdict, "device", device),
                    of_several ? " on " : "", of_several ? machine : "",
                    text_of(verdict, "verdict", text));
        if (rg_page_is(verdict, "verdict", "one launch") && of_several)
            rg_text_add(line, size, "", " %s", text_of(verdict, "figures", text));
    }
}

static void put_claim(struct brief *brief, const json_t *claim, const char *on, bool of_several)
{
    char words[4 * MOST_TEXT], part[4 * MOST_TEXT], table[4 * MOST_TEXT], line[2048];
    write_verdicts(claim, on, of_several, line, sizeof(line));
    text_of(claim, "part", part);
    put(brief, "| %s | %s%s%s | %s |\n", text_of(claim, "table", table),
        text_of(claim, "words", words), *part ? ", " : "", part, line);
}

static void put_claims(struct brief *brief, const json_t *claims)
{
    size_t i;
    json_t *claim;
    put(brief, "\n<details><summary>Claim by claim</summary>\n\n| table | claim | verdicts |\n"
               "|---|---|---|\n");
    json_array_foreach(claims, i, claim)
    {
        put_claim(brief, claim, NULL, are_of_several(claims));
    }
    fprintf(brief->out, "\n</details>\n");
}

// "2 hold, 1 does not hold, 15 are open"
static void put_stands(struct brief *brief, const int stands[RG_STANDS])
{
    static const char *const texts[RG_STANDS][2] = {
        [RG_STAND_HOLDS] = {"holds", "hold"},
        [RG_STAND_MIXED] = {"holds on some devices only", "hold on some devices only"},
        [RG_STAND_FAILS] = {"does not hold", "do not hold"},
        [RG_STAND_FITS] = {"fits by one launch alone", "fit by one launch alone"},
        [RG_STAND_MISSES] = {"misses by one launch alone", "miss by one launch alone"},
        [RG_STAND_OPEN] = {"is open", "are open"},
    };
    const char *glue = "";
    for (int i = 0; i < RG_STANDS; i++) {
        if (!stands[i])
            continue;
        put(brief, "%s%d %s", glue, stands[i], texts[i][stands[i] > 1]);
        glue = ", ";
    }
}

// Tells how claims stand on each machine.
static void put_machines(struct brief *brief, const json_t *document)
{
    const json_t *claims = json_object_get(document, "claims");
    int stands[RG_STANDS];
    size_t i;
    json_t *machine;
    json_array_foreach(json_object_get(document, "machines"), i, machine)
    {
        char name[4 * MOST_TEXT], text[4 * MOST_TEXT];
        const char *own = json_string_value(json_object_get(machine, "name"));
        const int all = own ? rg_page_stands(claims, own, stands) : 0;
        if (!all)
            continue;
        put(brief, "- On %s (%s), of %d: ", text_of(machine, "name", name),
            text_of(machine, "text", text), all);
        put_stands(brief, stands);
        put(brief, ".\n");
    }
}

// The devices of a claim whose verdicts differ between machines, each with the first of them.
static void put_differing(struct brief *brief, const json_t *claim)
{
    const json_t *verdicts = json_object_get(claim, "verdicts");
    size_t i, k;
    json_t *verdict, *other;
    json_array_foreach(verdicts, i, verdict)
    {
        const char *device = json_string_value(json_object_get(verdict, "device"));
        bool is_first = device;
        json_array_foreach(verdicts, k, other)
        {
            is_first = is_first && (k >= i || !rg_page_is(other, "device", device));
        }
        if (is_first && rg_page_differs(claim, device))
            put_claim(brief, claim, device, true);
    }
}

// Lists the verdicts that differ between machines.
static void put_comparison(struct brief *brief, const json_t *claims)
{
    size_t i;
    json_t *claim;
    put(brief, "\n| table | claim | verdicts that differ between machines |\n|---|---|---|\n");
    json_array_foreach(claims, i, claim)
    {
        put_differing(brief, claim);
    }
}

static void put_counts(struct brief *brief, const struct counts *found, const json_t *document)
{
    int stands[RG_STANDS];
    const json_t *claims = json_object_get(document, "claims");
    const int all = rg_page_stands(claims, NULL, stands);
    if (all) {
        put(brief, "Of %d claims that papers make, ", all);
        put_stands(brief, stands);
        put(brief, ".%s\n",
            stands[RG_STAND_FITS] + stands[RG_STAND_MISSES] ? " One launch is no verdict." : "");
    }
    if (are_of_several(claims))
        put_machines(brief, document);
    if (found->cases)
        put(brief, "%d of %d cases of the gate failed.\n", found->failing, found->cases);
    if (found->checks)
        put(brief, "%d of %d checks failed.\n", found->checks_failing, found->checks);
    if (!all && !found->cases && !found->checks)
        put(brief, "The records hold no claim, no gate and no check.\n");
}

static void put_all(const struct rg_page *page, struct brief *brief, const json_t *document)
{
    const struct counts found = count(page);
    const json_t *claims = json_object_get(document, "claims");
    const int failures = found.failing + found.checks_failing;
    put(brief, "## raingauge\n\n");
    put_counts(brief, &found, document);
    if (failures) {
        put(brief, "\n| found | where | why |\n|---|---|---|\n");
        tell_findings(page, brief, WORST);
    }
    if (failures > WORST) {
        put(brief, "\n<details><summary>All that fail</summary>\n\n| found | where | why |\n"
                   "|---|---|---|\n");
        tell_findings(page, brief, failures);
        fprintf(brief->out, "\n</details>\n");
    }
    if (are_of_several(claims))
        put_comparison(brief, claims);
    if (claims)
        put_claims(brief, claims);
    if (brief->left_out)
        fprintf(brief->out, "\n%d lines had no room here; the page has them all.\n",
                brief->left_out);
}

char *rg_page_markdown(const struct rg_page *page)
{
    char *text = NULL;
    size_t size;
    json_t *document = rg_page_claims(page);
    struct brief brief = {.out = open_memstream(&text, &size)};
    if (brief.out)
        put_all(page, &brief, document);
    json_decref(document);
    if (brief.out && !fclose(brief.out) && text)
        return text;
    free(text);
    return rg_harness_error_null("report: no memory for Markdown; name fewer records");
}

// --- the badge ---

// The key of the paper that all claims are about; "raingauge" if there are several papers.
static void title_of(const json_t *claims, char title[48])
{
    size_t i;
    json_t *claim;
    snprintf(title, 48, "raingauge");
    json_array_foreach(claims, i, claim)
    {
        const char *paper = json_string_value(json_object_get(claim, "paper"));
        if (!paper || (i && strcmp(title, paper) != 0)) {
            snprintf(title, 48, "raingauge");
            return;
        }
        snprintf(title, 48, "%.40s", paper);
    }
}

// The texts need no escaping for XML: this program makes one, and the other is a key of its own.
static char *draw(const char *left, const char *right, const char *colour)
{
    enum { CHARACTER_PX = 7, EDGE_PX = 12 };
    const int a = (int)strlen(left) * CHARACTER_PX + EDGE_PX,
              b = (int)strlen(right) * CHARACTER_PX + EDGE_PX;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fprintf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"20\" role=\"img\" "
        "aria-label=\"%s: %s\">\n<title>%s: %s</title>\n"
        "<rect width=\"%d\" height=\"20\" rx=\"3\" fill=\"#444\"/>\n"
        "<path d=\"M%d 0h%da3 3 0 0 1 3 3v14a3 3 0 0 1-3 3H%dz\" fill=\"%s\"/>\n"
        "<g fill=\"#fff\" text-anchor=\"middle\" font-family=\"Verdana,DejaVu Sans,sans-serif\" "
        "font-size=\"11\">\n<text x=\"%d\" y=\"14\">%s</text>\n<text x=\"%d\" y=\"14\">%s"
        "</text>\n</g>\n</svg>\n",
        a + b, left, right, left, right, a + b, a, b - 3, a, colour, a / 2, left, a + b / 2, right);
    return fclose(out) ? NULL : text;
}

char *rg_page_badge(const struct rg_page *page)
{
    int stands[RG_STANDS];
    char title[48], said[64] = "nothing measured";
    json_t *document = rg_page_claims(page);
    const json_t *claims = json_object_get(document, "claims");
    const int all = rg_page_stands(claims, NULL, stands);
    const struct counts found = count(page);
    const int failures = found.failing + found.checks_failing;
    title_of(found.cases + found.checks ? NULL : claims, title);
    if (found.cases + found.checks)
        snprintf(said, sizeof(said), "%d of %d fail", failures, found.cases + found.checks);
    else if (all)
        snprintf(said, sizeof(said), "%d of %d %s", stands[RG_STAND_HOLDS], all,
                 all == 1 ? "claim holds" : "claims hold");
    json_decref(document);
    char *text = draw(title, said,
                      failures                                               ? "#b3261e"
                      : stands[RG_STAND_HOLDS] || found.cases + found.checks ? "#17733a"
                                                                             : "#666");
    return text ? text : rg_harness_error_null("report: no memory for a badge; name fewer records");
}
