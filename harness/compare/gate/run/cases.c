#include "harness/compare/gate/run/cases.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "harness/compare/gate/report/texts.h"
#include "harness/compare/text/shell.h"
#include "harness/devices/names.h"

char *rg_gate_case_name(const char *cell, const char *device)
{
    const size_t size = strlen(cell) + strlen(device) + 2;
    char *name = rg_alloc(size, 1, "gate"), *clean;
    if (!name)
        return NULL;
    snprintf(name, size, "%s.%s", cell, device);
    clean = rg_texts_clean(name, true);
    free(name);
    return clean;
}

const char *rg_gate_case_device(const struct rg_gate_case *c)
{
    return c->devices[c->device_count - 1];
}

void rg_gate_case_expect(struct rg_gate_case *c, const struct rg_gate_request *request)
{
    const struct rg_device *device = c->sides[RG_SIDE_B]->device;
    snprintf(c->driver, sizeof(c->driver), "%s", device ? device->info.driver : "");
    c->expectation = rg_known_row(request->known, c->cell->name, rg_gate_case_device(c), c->driver,
                                  request->today);
    c->is_skipped = rg_known_skips(request->known, c->expectation, request->today);
}

bool rg_gate_case_was_compared(const struct rg_gate_case *c)
{
    return c->is_compared && (c->agreement.outcome == RG_OK || c->agreement.outcome == RG_FAIL);
}

// --- endings ---

// Whether it agreed, but its timing was cut short.
static bool broke_off(const struct rg_gate_case *c)
{
    return c->agreement.outcome == RG_OK && c->is_timed && c->times.outcome != RG_OK;
}

static enum rg_ending ending_of_times(const struct rg_gate_case *c)
{
    static const enum rg_ending endings[] = {
        [RG_TWO_INCONCLUSIVE] = RG_ENDING_INCONCLUSIVE,
        [RG_TWO_PASS] = RG_ENDING_PASS,
        [RG_TWO_REGRESSED] = RG_ENDING_REGRESSED,
        [RG_TWO_IMPROVED] = RG_ENDING_IMPROVED,
    };
    if (broke_off(c))
        return rg_ending_of(c->times.outcome);
    if (!c->row.decision.units && !c->times.is_over)
        return RG_ENDING_NOTHING_MEASURED;
    return endings[c->row.decision.verdict];
}

// The case's ending without regard to expectations.
static enum rg_ending own_ending(const struct rg_gate_case *c)
{
    if (c->is_over)
        return RG_ENDING_INCONCLUSIVE;
    return c->agreement.outcome == RG_OK && c->is_timed ? ending_of_times(c)
                                                        : rg_ending_of(c->agreement.outcome);
}

// --- messages ---

static const char *why_open(const struct rg_gate_case *c)
{
    if (c->times.is_over)
        return "the time was over before it was decided";
    switch (c->row.end) {
    case RG_END_LOOKS:
        return "the interval allows both after the last launch that was planned";
    case RG_END_DISTURBED:
        return "the machine gave its time to others in most launches";
    case RG_END_UNCONFIRMED:
        return "it was found once, and not when it was measured again";
    default:
        return "nothing more could be measured";
    }
}

// Decimals of a time that has three digits: 4.00 beside 3.73.
static int decimals_of(double ms)
{
    return ms > 0 && ms < 99.95 ? 2 - (int)floor(log10(ms * 1.0005)) : 0;
}

// Writes a change with its interval, and the times of both sides. A word gives the direction, so a
// decrease has no sign; only an end of the interval on the other side has one.
static void put_change(const struct rg_gate_case *c, char *text, size_t size)
{
    const struct rg_gate_decision *d = &c->row.decision;
    const double a_ms = c->row.a_ms.median, b_ms = c->row.b_ms.median;
    const bool is_less = d->ratio < 1;
    const double sign = is_less ? -100 : 100;
    const double ends[] = {sign * (d->low - 1), sign * (d->high - 1)};
    snprintf(text, size, "a frame takes %.1f %% %s (%.1f to %.1f %%): %s %.*f ms, %s %.*f ms",
             sign * (d->ratio - 1), is_less ? "less" : "longer", ends[is_less], ends[!is_less],
             c->before ? "baseline" : "A", decimals_of(a_ms), a_ms, c->before ? "now" : "B",
             decimals_of(b_ms), b_ms);
}

// Reports the times regardless of expectations: quarantined cases are measured to be seen.
static void put_times(const struct rg_gate_case *c, char *text, size_t size)
{
    const enum rg_ending ending = ending_of_times(c);
    const struct rg_gate_decision *d = &c->row.decision;
    if (ending == RG_ENDING_INCONCLUSIVE)
        snprintf(text, size, "%s%s", why_open(c),
                 d->is_coarse ? "; the clock is too coarse for so short a time" : "");
    else if (ending == RG_ENDING_REGRESSED || ending == RG_ENDING_IMPROVED)
        put_change(c, text, size);
    else if (broke_off(c))
        snprintf(text, size, "%s", c->times.why);
}

// Reports which code ran on both sides. It explains a verdict, and never decides one.
static void put_code(const struct rg_gate_case *c, FILE *out)
{
    const struct rg_session_code *a = &c->agreement.code[RG_SIDE_A];
    const struct rg_session_code *b = &c->agreement.code[RG_SIDE_B];
    const bool program = !strcmp(a->program, b->program), libraries = a->libraries == b->libraries,
               passes = a->passes.hash == b->passes.hash;
    const bool is_found =
        c->is_timed && c->row.decision.units && c->row.decision.verdict > RG_TWO_PASS;
    char handed[120] = "the API hands out no compiled passes";
    if (b->passes.bytes)
        snprintf(handed, sizeof(handed), "compiled passes %08x and %08x, %lld bytes",
                 (unsigned)(a->passes.hash >> 32), (unsigned)(b->passes.hash >> 32),
                 (long long)b->passes.bytes);
    const char *advice = b->passes.bytes
                             ? ": it is the same code, so look at threads, clocks and memory"
                             : ", so look at the driver's settings, threads, clocks and memory";
    fprintf(out, "%s program, %s libraries; %s%s\n", program ? "the same" : "another",
            libraries ? "the same" : "other", handed,
            is_found && program && libraries && passes ? advice : "");
}

static void put_decision(const struct rg_gate_case *c, FILE *out)
{
    const struct rg_gate_decision *d = &c->row.decision;
    const double paired[] = {0.02, 0.03, 0.05}, apart[] = {0.1, 0.15, 0.2};
    const double *changes = c->rule.is_apart ? apart : paired;
    fprintf(out,
            "%d launches%s, %d disturbed; a launch scatters by %.1f %%; shift %.4f\n"
            "a change would be found:",
            c->row.launches, d->is_grouped ? ", counted in groups, for they follow each other" : "",
            c->row.disturbed, 100 * expm1(d->spread), d->shift);
    for (int i = 0; i < 3; i++)
        fprintf(out, "%s %.0f %% with %.0f %%", i ? "," : "", 100 * changes[i],
                100 * rg_gate_power(&c->rule, d, changes[i]));
    fputc('\n', out);
}

enum { WHOLE = 2 * RG_DEVICE_NAME_SIZE + 2 };

// A device's short name with the full name that it stands for.
static const char *whole_name(const char *name, char whole[WHOLE])
{
    const char *full = rg_device_name_full(name);
    snprintf(whole, WHOLE, "%s%s%s", name, full == name ? "" : "=", full == name ? "" : full);
    return whole;
}

// Writes a `raingauge diff` command for a cell on two devices, with its mutants, quoted for a
// shell.
static void put_command(FILE *out, const struct rg_gate_cell *cell, const char *a, const char *b)
{
    char devices[2 * WHOLE], whole_a[WHOLE], whole_b[WHOLE];
    fprintf(out, "raingauge diff %s --size %dx%d --frame %d", cell->subject.technique->name,
            cell->subject.width, cell->subject.height, cell->frames);
    for (const char *word = cell->assignments; *(word += strspn(word, " "));) {
        const size_t length = strcspn(word, " ");
        fputs(" --set ", out);
        rg_shell_word(out, word, length);
        word += length;
    }
    snprintf(devices, sizeof(devices), "%s,%s", whole_name(a, whole_a), whole_name(b, whole_b));
    fputs(" --device ", out);
    rg_shell_word(out, devices, strlen(devices));
    fputs(" --mutants", out);
}

// Writes how to find out the cost of accepting a picture that differs: the mutants that would go
// unnoticed.
static void put_again(const struct rg_gate_case *c, FILE *out)
{
    const struct rg_agreement *agreement = &c->agreement;
    if (!agreement->truth || agreement->would_hold == RG_TIER_COUNT)
        return;
    fprintf(out,
            "which mutants %s would let live: ", rg_tier_name((enum rg_tier)agreement->would_hold));
    put_command(out, c->cell, agreement->truth, rg_gate_case_device(c));
    fputc('\n', out);
}

// NULL without memory.
static char *make_details(const struct rg_gate_case *c)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    if (c->is_timed && c->row.decision.units)
        put_decision(c, out);
    else if (*c->agreement.details)
        fprintf(out, "%s\n", c->agreement.details);
    put_again(c, out);
    if (c->agreement.has_code)
        put_code(c, out);
    if (fclose(out) || !size)
        return text;
    text[size - 1] = 0; // the last line needs no end
    return text;
}

static void put_message(const struct rg_gate_case *c, const char *word, char *text, size_t size)
{
    char own[RG_AGREEMENT_TEXT + 360], times[300] = "";
    const char *device = c->agreement.device, *said = c->agreement.message;
    if (c->agreement.outcome == RG_OK && c->is_timed)
        put_times(c, times, sizeof(times));
    snprintf(own, sizeof(own), "%s%s%s%s%s", device ? device : "", device ? ": " : "", said,
             *said && *times ? "; " : "", times);
    snprintf(text, size, "%s%s%s", word, *word && *own ? ": " : "", own);
}

static void put_measures(const struct rg_gate_case *c, struct rg_report_case *told)
{
    const struct rg_gate_decision *d = &c->row.decision;
    if (!c->is_timed || !d->units)
        return;
    told->ratio =
        (struct rg_bounded){d->ratio, d->low > 0 ? d->low : NAN, isfinite(d->high) ? d->high : NAN};
    told->smallest_visible = isfinite(d->smallest) ? d->smallest : NAN;
    told->time_ms = (struct rg_bounded){c->row.b_ms.median, c->row.b_ms.low, c->row.b_ms.high};
    told->baseline_ms = c->row.a_ms.median;
}

// Whether the failure is not of the case's driver, but of the other side, the truth, or raingauge
// itself because of its input.
static bool is_foreign(const struct rg_gate_case *c)
{
    const char *device = c->agreement.device, *own = rg_gate_case_device(c);
    if (broke_off(c))
        return c->times.is_ours || c->times.side != RG_SIDE_B;
    if (c->agreement.is_ours || !device)
        return c->agreement.is_ours;
    // Both sides may have the same name; their pointers differ.
    return c->before ? strcmp(device, own) != 0 : device != own;
}

bool rg_gate_case_tell(const struct rg_gate_case *c, const struct rg_gate_request *request,
                       struct rg_report *report, struct rg_known_result *result)
{
    char message[RG_AGREEMENT_TEXT + 400], paths[RG_GATE_PICTURES][PATH_MAX];
    const char *pictures[RG_GATE_PICTURES];
    *result =
        (struct rg_known_result){.cell = c->cell->name,
                                 .device = rg_gate_case_device(c),
                                 .driver = c->driver,
                                 .outcome = broke_off(c) ? c->times.outcome : c->agreement.outcome,
                                 .pixels = c->agreement.pixels,
                                 .difference = c->agreement.difference,
                                 .is_foreign = is_foreign(c)};
    const struct rg_judged judged =
        rg_known_judge(request->known, c->expectation, result, own_ending(c), request->today);
    put_message(c, rg_judged_word(&judged), message, sizeof(message));
    char *details = make_details(c);
    struct rg_report_case told = {.name = c->name,
                                  .technique = c->cell->subject.technique->name,
                                  .devices = c->devices,
                                  .device_count = c->device_count,
                                  .seconds = c->seconds,
                                  .ending = judged.ending,
                                  .is_compared = rg_gate_case_was_compared(c),
                                  .is_over = c->is_over,
                                  .message = message,
                                  .details = details,
                                  .attachments = pictures,
                                  .attachment_count =
                                      c->agreement.has_pictures ? RG_GATE_PICTURES : 0,
                                  RG_UNMEASURED};
    for (int i = 0; i < RG_GATE_PICTURES && c->agreement.has_pictures; i++) {
        rg_gate_picture_path(request->pictures, c->name, i, paths[i]);
        pictures[i] = paths[i];
    }
    put_measures(c, &told);
    const bool ok = details ? rg_report_add(report, &told)
                            : rg_harness_error("gate: no memory for what a case tells");
    free(details);
    return ok;
}
