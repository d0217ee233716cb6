// Reduces the user's own files.
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/text/mark.h"
#include "harness/compare/shrink/files.h"
#include "harness/compare/shrink/search.h"

// A file's entries: its lines, or the elements of one array of a JSON object.
struct entries {
    json_t *root;       // NULL: lines
    const char *key;    // name of the array
    const char **lines; // start of each line, and end of the last
    int count;
    bool *kept;
};

static bool write_entries(const struct entries *e, const char *path)
{
    json_t *root = e->root ? json_copy(e->root) : NULL, *array = json_array();
    FILE *out = fopen(path, "w");
    bool ok = out && (!e->root || root);
    for (int i = 0; ok && i < e->count; i++)
        if (e->kept[i] && e->root)
            ok = json_array_append(
                     array, json_array_get(json_object_get(e->root, e->key), (size_t)i)) == 0;
        else if (e->kept[i])
            ok = fwrite(e->lines[i], 1, (size_t)(e->lines[i + 1] - e->lines[i]), out) ==
                 (size_t)(e->lines[i + 1] - e->lines[i]);
    if (ok && root)
        ok = json_object_set(root, e->key, array) == 0 &&
             json_dumpf(root, out, JSON_INDENT(1)) == 0 && fputc('\n', out) != EOF;
    json_decref(array);
    json_decref(root);
    return (!out || fclose(out) == 0) && ok;
}

// Tries the best run with only the kept entries; true if it still has the difference.
static bool try_without(struct rg_search *s, const struct rg_param *param, const struct entries *e,
                        const char *ending)
{
    char path[RG_PATH_SIZE];
    if (snprintf(path, sizeof(path), "%s/%d-%s%s", s->asked->folder, s->files++, param->name,
                 ending) >= (int)sizeof(path) ||
        !write_entries(e, path))
        return false;
    const bool keeps = rg_search_value(s, param, path, s->blame.first.weight);
    if (!keeps)
        remove(path);
    return keeps;
}

// Leaves out halves, then quarters, and at last single entries, starting at the end.
static void leave_out(struct rg_search *s, const struct rg_param *param, struct entries *e,
                      const char *ending)
{
    bool *before = rg_alloc((size_t)e->count, sizeof(*before), "entries");
    for (int part = e->count / 2 > 1 ? e->count / 2 : 1; before && part >= 1; part /= 2)
        for (int end = e->count; end > 0; end -= part) {
            const int first = end > part ? end - part : 0;
            bool any = false;
            memcpy(before, e->kept, (size_t)e->count * sizeof(*before));
            for (int i = first; i < end; i++) {
                any = any || e->kept[i];
                e->kept[i] = false;
            }
            if (!any || !try_without(s, param, e, ending))
                memcpy(e->kept, before, (size_t)e->count * sizeof(*before));
        }
    free(before);
}

static void shrink_entries(struct rg_search *s, const struct rg_param *param, struct entries *e,
                           const char *ending)
{
    e->kept = rg_alloc((size_t)e->count + 1, sizeof(*e->kept), "entries");
    for (int i = 0; e->kept && i < e->count; i++)
        e->kept[i] = true;
    if (e->kept && e->count)
        leave_out(s, param, e, ending);
    free(e->kept);
}

// Reduces the first array of an object, such as its lights.
static void shrink_array(struct rg_search *s, const struct rg_param *param, json_t *root)
{
    const char *key;
    json_t *value;
    json_object_foreach(root, key, value) if (json_is_array(value))
    {
        struct entries e = {.root = root, .key = key, .count = (int)json_array_size(value)};
        shrink_entries(s, param, &e, ".json");
        return;
    }
}

static void shrink_lines(struct rg_search *s, const struct rg_param *param, char *text,
                         const char *ending)
{
    struct entries e = {0};
    for (const char *c = text; *c; c++)
        e.count += *c == '\n' || !c[1];
    e.lines = rg_alloc((size_t)e.count + 1, sizeof(*e.lines), "lines");
    int at = 0;
    for (char *c = text; e.lines && *c; at++) {
        e.lines[at] = c;
        c += strcspn(c, "\n");
        c += *c == '\n';
        e.lines[at + 1] = c;
    }
    if (e.lines)
        shrink_entries(s, param, &e, ending);
    free(e.lines);
}

void rg_search_entries(struct rg_search *s, const struct rg_param *param)
{
    char path[RG_PATH_SIZE], ending[16];
    size_t size;
    rg_params_text(param, s->best.subject.settings, path, sizeof(path));
    rg_file_ending(path, ending, sizeof(ending));
    char *bytes = rg_file_is_own(path) ? rg_file_load(path, &size) : NULL;
    const size_t mark = bytes ? rg_mark_bytes(bytes, size) : 0;
    json_t *root = bytes ? json_loadb(bytes + mark, size - mark, 0, NULL) : NULL;
    if (json_is_object(root))
        shrink_array(s, param, root);
    else if (bytes && strlen(bytes) == size) // it is text
        shrink_lines(s, param, bytes, ending);
    json_decref(root);
    free(bytes);
}
