#include "harness/record/journal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/record/output.h"
#include "harness/record/passport.h"
#include "harness/record/rows.h"

enum { FORMAT = 1 };

struct rg_journal {
    char folder[1536], name[128], path[2048]; // no folder: there is none to be had
    bool is_in_state;                         // of the user's; else with the results
    json_t *root;                             // {"format", "key", "rows": {"0": a row, ...}}
    bool has_file, is_followed;
    bool is_broken; // it could not be written, which one logged line said
};

// --- the key ---

// Which program this is. A changed tree has the same commit before and after a change.
static json_t *program_json(void)
{
    struct stat file;
    if (stat("/proc/self/exe", &file))
        return json_null();
    return json_pack("[II]", (json_int_t)file.st_size, (json_int_t)file.st_mtime);
}

static json_t *passport_json(const struct rg_devices *devices)
{
    struct rg_device_info infos[RG_MAX_DEVICES];
    for (int d = 0; d < devices->count; d++)
        infos[d] = devices->devices[d]->info;
    return rg_passport_json(infos, devices->count);
}

static json_t *settings_json(const struct rg_table_run *run)
{
    json_t *settings = json_array();
    for (int row = run->first_row; row <= run->last_row; row++) {
        for (int v = 0; v < rg_table_variant_count(run->table); v++) {
            char *text = rg_table_assignments(run, row, v);
            json_array_append_new(settings, text ? json_string(text) : json_null());
            free(text);
        }
    }
    return settings;
}

static json_t *key_json(const struct rg_table_run *run)
{
    const struct rg_table *table = run->table;
    return json_pack("{sssss[ii]s[ii]ssss?sososo}", "table", table->id, "length",
                     run->full ? "full" : "quick", "rows", run->first_row, run->last_row, "size",
                     table->width, table->height, "technique", table->technique, "truth",
                     table->truth, "settings", settings_json(run), "program", program_json(),
                     "passport", passport_json(run->devices));
}

// --- its folder ---

// Makes those that a folder lies in. Writing into it says what could not be made.
static void make_parents(char *folder)
{
    for (char *end = strchr(folder + 1, '/'); end; end = strchr(end + 1, '/')) {
        *end = 0;
        mkdir(folder, 0777);
        *end = '/';
    }
}

// The folder for what a user's programs keep between runs, by the XDG base directories; "" where no
// variable names one. Its last part is made by who writes there.
static void find_state_folder(char *folder, size_t size)
{
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    int length = 0;
    if (state && *state == '/')
        length = snprintf(folder, size, "%s/raingauge", state);
    else if (home && *home == '/')
        length = snprintf(folder, size, "%s/.local/state/raingauge", home);
    if (length >= (int)size)
        *folder = 0;
}

// --- reading ---

// Whether a file's JSON is a journal with this key; says in one line if not.
static bool is_usable(const json_t *root, const json_t *key, const char *path)
{
    const json_t *format = json_object_get(root, "format"), *found = json_object_get(root, "key");
    if (json_integer_value(format) != FORMAT || !json_is_object(found) ||
        !json_is_object(json_object_get(root, "rows"))) {
        rg_warning("%s: is damaged; the table begins anew", path);
        return false;
    }
    if (json_equal(found, key))
        return true;
    rg_info("%s: is of another build, machine, choice of devices or of rows; the table begins anew",
            path);
    return false;
}

static json_t *read_file(const char *path, const json_t *key)
{
    if (access(path, F_OK))
        return NULL;
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, NULL);
    if (is_usable(root, key, path))
        return root;
    json_decref(root);
    return NULL;
}

struct rg_journal *rg_journal_open(const struct rg_table_run *run, const char *folder, bool fresh,
                                   bool is_followed)
{
    struct rg_journal *j = rg_alloc(1, sizeof(*j), "journal");
    if (!j)
        return NULL;
    j->is_followed = is_followed;
    j->is_in_state = !folder;
    if (!folder)
        find_state_folder(j->folder, sizeof(j->folder));
    else if (strlen(folder) < sizeof(j->folder))
        memcpy(j->folder, folder, strlen(folder) + 1);
    snprintf(j->name, sizeof(j->name), "%s-%s.journal", run->table->id,
             run->full ? "full" : "quick");
    snprintf(j->path, sizeof(j->path), "%s/%s", j->folder, j->name);
    json_t *key = key_json(run);
    j->root = fresh || !*j->folder ? NULL : read_file(j->path, key);
    j->has_file = j->root != NULL;
    if (j->root)
        json_decref(key);
    else
        j->root = json_pack("{sisoso}", "format", FORMAT, "key", key, "rows", json_object());
    return j;
}

static const char *row_name(int row, char text[16])
{
    snprintf(text, 16, "%d", row);
    return text;
}

static json_t *rows_of(const struct rg_journal *journal)
{
    return journal ? json_object_get(journal->root, "rows") : NULL;
}

bool rg_journal_has(const struct rg_journal *journal, int row)
{
    char name[16];
    return json_object_get(rows_of(journal), row_name(row, name)) != NULL;
}

bool rg_journal_take(struct rg_journal *journal, struct rg_table_run *run, int row)
{
    char name[16];
    const json_t *json = json_object_get(rows_of(journal), row_name(row, name));
    if (!json)
        return false;
    if (!run->journal)
        run->journal = json_incref(journal->root);
    if (rg_journal_row_read(json, run, row))
        return true;
    rg_warning("%s: row %d is damaged; it is measured anew", journal->path, row + 1);
    json_object_del(rows_of(journal), name);
    return false;
}

// --- writing ---

static bool has_error(const struct rg_table_run *run, int row)
{
    bool found = false;
    for (int v = 0; v < rg_table_variant_count(run->table); v++) {
        found = found || rg_table_group(run, row, v)->error_status == RG_ERROR;
        for (int d = 0; d < run->devices->count; d++)
            found = found || rg_table_cell(run, row, v, d)->status == RG_ERROR;
    }
    return found;
}

static bool write_file(struct rg_journal *j)
{
    if (!*j->folder) {
        rg_warning("%s: no folder for it, so that an interrupted run begins anew; set "
                   "XDG_STATE_HOME, or write into a folder with -o",
                   j->name);
        return false;
    }
    if (j->is_in_state)
        make_parents(j->folder);
    char *text = json_dumps(j->root, JSON_REAL_PRECISION(17) | JSON_COMPACT);
    const bool ok = text && rg_output_write(j->folder, j->name, text);
    free(text);
    return ok;
}

void rg_journal_add(struct rg_journal *j, const struct rg_table_run *run, int first, int last)
{
    char name[16];
    for (int row = first; j && row <= last; row++)
        if (!has_error(run, row))
            json_object_set_new(rows_of(j), row_name(row, name), rg_journal_row_json(run, row));
    // Nothing is lost once the last row is measured and printed.
    if (!j || j->is_broken || (last == run->last_row && !j->is_followed))
        return;
    j->is_broken = !write_file(j);
    j->has_file = !j->is_broken;
}

const char *rg_journal_path(const struct rg_journal *journal)
{
    return journal && journal->has_file ? journal->path : NULL;
}

void rg_journal_remove(struct rg_journal *journal)
{
    if (rg_journal_path(journal) && unlink(journal->path) && errno != ENOENT)
        rg_warning("%s: cannot be removed: %s", journal->path, strerror(errno));
}

void rg_journal_close(struct rg_journal *journal)
{
    if (!journal)
        return;
    json_decref(journal->root);
    free(journal);
}
