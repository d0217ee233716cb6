// Records of a gate's and a verification's shards. A record is taken or refused in one line, and
// what is taken can be printed, without characters that control a terminal. A checksum is corrected
// first.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/shards/shards.h"
#include "harness/compare/verify/shards.h"
#include "harness/record/disk/seal.h"
#include "tests/fuzz/heard.h"

static void check_plain(const char *text)
{
    for (const unsigned char *c = (const unsigned char *)text; *c; c++)
        if ((*c < ' ' && *c != '\n') || *c == 127)
            fuzz_complain("a control character is printed");
}

// Writes the report in all forms of files and for people.
static void check_report(const struct rg_gate *gate)
{
    static const rg_report_writer writers[] = {rg_report_text, rg_report_junit, rg_report_json,
                                               rg_gtest_print};
    check_plain(gate->note);
    for (int i = 0; i < 4; i++) {
        char *text = NULL;
        size_t size;
        FILE *out = open_memstream(&text, &size);
        if (!out || !writers[i](&gate->report, out) || fclose(out))
            fuzz_complain("taken, and cannot be written");
        if (!i)
            check_plain(text);
        free(text);
    }
}

static void merge_gate(const struct rg_parts *parts)
{
    struct rg_gate gate = {.case_count = 0};
    fuzz_listen();
    const bool taken = rg_gate_merge(parts, &gate);
    if (taken)
        check_report(&gate); // a line tells of each required device that is not there
    else
        fuzz_judge_lines(false, 0);
    rg_gate_free(&gate);
}

static void merge_checks(const struct rg_parts *parts)
{
    struct rg_checks checks = {0};
    fuzz_listen();
    const bool taken = rg_checks_merge(parts, &checks);
    fuzz_judge_lines(taken, 0);
    for (int i = 0; i < checks.count; i++) {
        check_plain(checks.rows[i].technique);
        check_plain(checks.rows[i].check);
        check_plain(checks.rows[i].device);
        check_plain(checks.rows[i].detail);
    }
    json_t *document = rg_checks_document(&checks, rg_checks_merge_devices(parts));
    if (!document)
        fuzz_complain("taken, and cannot be written");
    json_decref(document);
    rg_checks_free(&checks);
}

static void read_record(const char *kind, const char *text, size_t size)
{
    struct rg_parts parts = {0};
    const char *path = fuzz_write("record.json", (const uint8_t *)text, size);
    fuzz_listen();
    const bool taken = rg_parts_read(&parts, kind, path);
    fuzz_judge_lines(taken, 1);
    if (taken && parts.count && !strcmp(kind, "gate"))
        merge_gate(&parts);
    else if (taken && parts.count)
        merge_checks(&parts);
    rg_parts_free(&parts);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    json_t *document = json_loadb((const char *)data, size, 0, NULL);
    read_record("gate", (const char *)data, size);
    if (document && json_is_object(document) && rg_seal(document)) {
        char *text = json_dumps(document, JSON_COMPACT);
        const bool is_gate = json_object_get(document, "gated");
        if (text)
            read_record(is_gate ? "gate" : "verify", text, strlen(text));
        free(text);
    }
    json_decref(document);
    return 0;
}
