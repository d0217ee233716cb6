#include "harness/compare/gate/expected/expected.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"

static void drop_rows(struct rg_known *expected, int64_t from)
{
    for (int64_t i = from; i < expected->count; i++)
        rg_regex_free(expected->rows[i].regex);
    expected->count = from;
}

static bool has_place(const struct rg_known *expected, const char *name)
{
    const int most = (int)(sizeof(expected->files) / sizeof(expected->files[0]));
    return expected->file_count < most ||
           rg_error("%s: more than %d files of expectations; join some", name, most);
}

// Takes ownership of the lines, whether it succeeds or not.
static bool add(struct rg_known *expected, bool are_read, struct rg_lines lines,
                enum rg_known_form form)
{
    const int64_t before = expected->count;
    expected->files[expected->file_count++] = (struct rg_known_file){form, lines};
    if (are_read &&
        (form == RG_FORM_OWN ? rg_known_read_own(expected) : rg_known_read_mesa(expected, form)))
        return true;
    drop_rows(expected, before);
    rg_lines_free(&expected->files[--expected->file_count].lines);
    return false;
}

bool rg_known_add(struct rg_known *expected, const char *path, enum rg_known_form form)
{
    struct rg_lines lines;
    if (!has_place(expected, path))
        return false;
    const bool are_read = rg_lines_read(path, &lines);
    return add(expected, are_read, lines, form);
}

bool rg_known_add_text(struct rg_known *expected, const char *name, const char *text, size_t size,
                       enum rg_known_form form)
{
    struct rg_lines lines;
    if (!has_place(expected, name))
        return false;
    const bool are_read = rg_lines_of(name, text, size, &lines);
    return add(expected, are_read, lines, form);
}

void rg_known_free(struct rg_known *expected)
{
    drop_rows(expected, 0);
    free(expected->rows);
    for (int i = 0; i < expected->file_count; i++)
        rg_lines_free(&expected->files[i].lines);
    memset(expected, 0, sizeof(*expected));
}
