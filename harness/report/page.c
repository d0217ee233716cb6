#include "harness/report/page.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "harness/record/ending.h"
#include "harness/record/output.h"
#include "harness/record/passport/build_info.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/claims/json.h"

// The page before and after its data; page/embed.py makes them.
extern const char rg_page_head[], rg_page_tail[];

static json_t *or_empty(json_t *json, json_t *(*make)(void))
{
    return json ? json_incref(json) : make();
}

static json_t *claims_json(const struct rg_page *page)
{
    return page->outcomes.count ? rg_claims_json(&page->outcomes) : json_null();
}

static json_t *before_json(const struct rg_page *before)
{
    return before ? json_pack("{so so so}", "machines",
                              rg_claims_machines_json(&before->outcomes.origins), "claims",
                              claims_json(before), "records", or_empty(before->records, json_array))
                  : json_null();
}

// The endings of a gate's cases, worst first.
static json_t *endings_json(void)
{
    json_t *endings = json_array();
    for (enum rg_ending i = 0; i <= RG_ENDING_PASS; i++)
        json_array_append_new(
            endings, json_pack("{ss sb}", "name", rg_ending_name(i), "fails", rg_ending_fails(i)));
    return endings;
}

// All data of the page. NULL without memory.
static json_t *data_json(const struct rg_page *page, const struct rg_page *before)
{
    return json_pack(
        "{si ss ss si si so so so so so so so so so so}", "format", RG_FORMAT_VERSION, "version",
        rg_build_version, "commit", rg_build_commit, "pictures_left_out", page->left_out,
        "gates_left_out", page->gates_left_out, "endings", endings_json(), "rules",
        rg_claims_rules_json(), "machines", rg_claims_machines_json(&page->outcomes.origins),
        "claims", claims_json(page), "before", before_json(before), "records",
        or_empty(page->records, json_array), "pictures", or_empty(page->pictures, json_object),
        "files", or_empty(page->files, json_object), "linear", or_empty(page->linear, json_object),
        "gallery", or_empty(page->gallery, json_array));
}

// Writes JSON with escaped `<`, so that no text in it can end the element around it.
static int put(const char *buffer, size_t size, void *user)
{
    FILE *out = user;
    for (size_t i = 0; i < size; i++)
        if (buffer[i] == '<')
            fputs("\\u003c", out);
        else
            putc_unlocked(buffer[i], out);
    return ferror(out) ? -1 : 0;
}

bool rg_page_write(const struct rg_page *page, const struct rg_page *before, const char *path)
{
    char *text = NULL;
    size_t size;
    json_t *data = data_json(page, before);
    FILE *out = data ? open_memstream(&text, &size) : NULL;
    bool ok = out && fputs(rg_page_head, out) >= 0 &&
              !json_dump_callback(data, put, out, JSON_COMPACT | RG_JSON_FLAGS) &&
              fputs(rg_page_tail, out) >= 0;
    ok = out && !fclose(out) && ok;
    json_decref(data);
    ok = ok ? rg_output_write_file(path, text) : rg_page_lacks_memory(path);
    free(text);
    return ok;
}
