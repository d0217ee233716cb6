// The record of a shard.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/shards/shards.h"
#include "harness/devices/names.h"
#include "harness/record/disk/document.h"
#include "harness/record/passport/build_info.h"

// --- what a gate is made of ---

bool rg_gate_digest_file(const char *path, char digest[RG_DIGEST_SIZE])
{
    char why[RG_WHY_SIZE];
    size_t size;
    char *text = rg_document_load(path, &size, "name a file that can be read", why);
    if (!text)
        return rg_error("%s", why);
    rg_digest_of(text, size, digest);
    free(text);
    return true;
}

void rg_gate_digest_known(const struct rg_known *known, char digest[RG_DIGEST_SIZE])
{
    char *all = NULL;
    size_t size = 0;
    FILE *out = known->file_count ? open_memstream(&all, &size) : NULL;
    *digest = 0;
    for (int i = 0; out && i < known->file_count; i++) {
        const struct rg_lines *lines = &known->files[i].lines;
        fprintf(out, "%d %zu\n", (int)known->files[i].form, lines->size);
        fwrite(lines->raw, 1, lines->size, out);
    }
    if (out && !fclose(out))
        rg_digest_of(all, size, digest);
    free(all);
}

// The names of each pair, and what those stand for.
static json_t *pairs_json(const struct rg_gate_pairs *pairs)
{
    json_t *json = json_array();
    for (int i = 0; i < pairs->count; i++) {
        const char *a = pairs->all[i].names[RG_SIDE_A], *b = pairs->all[i].names[RG_SIDE_B];
        json_array_append_new(json, json_pack("[o, o, o, o]", rg_json_text(a), rg_json_text(b),
                                              rg_json_text(rg_device_name_full(a)),
                                              rg_json_text(rg_device_name_full(b))));
    }
    return json;
}

// The names of all cells, with what defines each.
static void digest_cells(const struct rg_gate_cells *cells, char digest[RG_DIGEST_SIZE])
{
    char *all = NULL, one[RG_DIGEST_SIZE];
    size_t size = 0;
    FILE *out = open_memstream(&all, &size);
    *digest = 0;
    for (int64_t i = 0; out && i < cells->count; i++) {
        rg_digest_of_cell(&cells->cells[i], one);
        fprintf(out, "%s %s\n", cells->cells[i].name, one);
    }
    if (out && !fclose(out))
        rg_digest_of(all, size, digest);
    free(all);
}

// All that shards of one gate have in common.
static json_t *whole_json(const struct rg_gate_request *asked, const struct rg_gate_inputs *inputs,
                          const struct rg_gate *gate)
{
    char cells[RG_DIGEST_SIZE];
    digest_cells(asked->cells, cells);
    return json_pack("{ss ss so so so sb sb ss ss ss so sO}", "commit", rg_build_commit, "cells",
                     cells, "pairs", pairs_json(asked->pairs), "margin",
                     rg_number_json(asked->margin), "filter",
                     rg_json_text(asked->filter ? asked->filter : ""), "pictures",
                     asked->pictures_only, "strict", asked->strict, "baseline", inputs->baseline,
                     "expectations", inputs->expectations, "times", inputs->times, "require",
                     rg_json_text(asked->require ? asked->require : ""), "names", gate->names);
}

// --- times of an earlier gate ---

json_t *rg_gate_times_read(const char *path)
{
    static const char mend[] = "name what `raingauge gate --json` printed";
    char why[RG_WHY_SIZE] = "";
    size_t i;
    bool is_alone;
    json_t *document = rg_document_first(path, &is_alone, mend, why);
    json_t *cases = json_object_get(document, "gated"), *one;
    json_t *times = json_is_array(cases) ? json_object() : NULL;
    json_array_foreach(cases, i, one)
    {
        const char *name = json_string_value(json_object_get(one, "name"));
        const double seconds = json_number_value(json_object_get(one, "seconds"));
        if (times && name && seconds > 0)
            json_object_set_new(times, name, json_real(seconds));
    }
    if (!times)
        rg_error("%s%s", *why ? why : path,
                 *why ? ""
                      : ": is no record of a gate; name what "
                        "`raingauge gate --json` printed");
    json_decref(document);
    return times;
}

// --- the record ---

static json_t *result_json(const struct rg_known_result *result)
{
    return json_pack("{so so ss? ss so so sb}", "cell", rg_json_text(result->cell), "device",
                     rg_json_text(result->device), "driver", result->driver, "outcome",
                     rg_outcome_name(result->outcome), "pixels", rg_number_json(result->pixels),
                     "difference", rg_number_json(result->difference), "foreign",
                     result->is_foreign);
}

// The results of its cases. Those of devices that the gate leaves out, the first of all, are the
// same in each shard, so that the first one has them.
static json_t *results_json(const struct rg_gate_request *asked, const struct rg_gate *gate)
{
    json_t *json = json_array();
    const int64_t left = asked->left.count * asked->cells->count;
    for (int64_t i = asked->shard.number == 1 ? 0 : left; i < gate->result_count; i++)
        json_array_append_new(json, result_json(&gate->results[i]));
    return json;
}

static json_t *places_json(const struct rg_gate *gate)
{
    json_t *json = json_array();
    for (int i = 0; i < gate->told_count; i++)
        json_array_append_new(json, json_integer(gate->cases[i].place));
    return json;
}

bool rg_gate_part_write(const struct rg_gate_request *request, const struct rg_gate_inputs *inputs,
                        const struct rg_gate *gate, int beyond, const char *folder)
{
    json_t *document = rg_report_document(&gate->report);
    json_t *more = json_pack("{so so so si}", "places", places_json(gate), "results",
                             results_json(request, gate), "note",
                             rg_json_text(gate->note ? gate->note : ""), "exit", beyond);
    const bool is_made = document && more && !json_object_update(document, more);
    json_decref(more);
    if (!is_made) {
        json_decref(document);
        return rg_harness_error("%s: no memory for the record of a shard", folder);
    }
    return rg_part_write("gate", request->shard, document, whole_json(request, inputs, gate),
                         folder);
}
