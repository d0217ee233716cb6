#include "backends/manifests.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <jansson.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/doing.h"
#include "core/base/files/file.h"
#include "core/base/text/add.h"

// State of a walk over an API's drivers.
struct walk {
    const struct rg_manifest_rules *rules;
    bool asks;            // drivers are asked for their devices
    const char *variable; // the variable with the path being read; NULL: none
    const char *named_by; // a variable that names a driver; NULL: none
    int drivers;          // number of drivers
    int devices;          // devices that the drivers report when asked
    bool is_named_broken;
    bool is_failing;   // the broken driver could be loaded, and fails when it is called
    char sound[4096];  // files of drivers that work, separated by ':'; "": none
    char broken[512];  // why the first broken driver fails, preferring a named one; "": none
    char foreign[512]; // the same for a driver for another kind of processor
};

static bool ends_with(const char *text, const char *ending)
{
    const size_t length = strlen(text), end = strlen(ending);
    return length >= end && !strcmp(text + length - end, ending);
}

// Notes a driver's failure. A driver for another kind of processor may be installed next to this
// machine's, and is a failure only if there is no other.
static void note(struct walk *walk, const char *path, const char *fault, bool is_failing)
{
    const bool is_foreign = !walk->variable && strstr(fault, "wrong ELF class");
    char *to = is_foreign ? walk->foreign : walk->broken;
    if (*to && (walk->is_named_broken || !walk->variable))
        return;
    walk->is_named_broken = walk->variable != NULL;
    walk->is_failing = is_failing;
    const size_t room = is_foreign ? sizeof(walk->foreign) : sizeof(walk->broken);
    if (walk->variable)
        snprintf(to, room, "%s names '%.120s', %s", walk->variable, path, fault);
    else
        snprintf(to, room, "'%.120s', %s", path, fault);
}

static void count_driver(struct walk *walk)
{
    walk->drivers++;
    if (walk->variable)
        walk->named_by = walk->variable;
}

// --- a library ---

static bool has_function(const struct rg_manifest_rules *rules, void *library)
{
    for (int i = 0; rules->functions[i]; i++)
        if (dlsym(library, rules->functions[i]))
            return true;
    return false;
}

// Tries a driver's library; `fault` says why it does not work, or is "". True if it could be loaded
// and fails when it is called.
static bool try_library(struct walk *walk, void *library, const char *name, char *fault,
                        size_t size)
{
    const struct rg_manifest_rules *rules = walk->rules;
    char why[160];
    int devices = 0;
    *fault = 0;
    if (!library)
        snprintf(fault, size, "whose library cannot be loaded: %s", dlerror());
    else if (!has_function(rules, library))
        snprintf(fault, size, "whose library '%.120s' is no driver: it has no function %s", name,
                 rules->functions[0]);
    else if (walk->asks && rules->ask)
        devices = rules->ask(library, why, sizeof(why));
    if (devices < 0)
        snprintf(fault, size, "whose driver fails: %s", why);
    else
        walk->devices += devices;
    return devices < 0;
}

static void examine_library(struct walk *walk, const char *path, const char *name)
{
    char fault[320];
    count_driver(walk);
    void *library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    const bool is_failing = try_library(walk, library, name, fault, sizeof(fault));
    if (*fault)
        note(walk, path, fault, is_failing);
    else if (strlen(walk->sound) + strlen(path) + 1 < sizeof(walk->sound))
        rg_text_add(walk->sound, sizeof(walk->sound), ":", "%s", path);
    if (library)
        dlclose(library);
}

bool rg_manifests_load(const char *name, bool *is_absent, char *why, size_t why_size)
{
    static const char absent[] = ": cannot open shared object file: No such file or directory";
    rg_doing_begin("loading", name);
    void *library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (library)
        return !dlclose(library);
    const char *error = dlerror();
    *is_absent = !strncmp(error, name, strlen(name)) && !strcmp(error + strlen(name), absent);
    snprintf(why, why_size, "%s", error);
    return false;
}

// --- a file ---

static bool read_text(FILE *file, char named[PATH_MAX], char *fault, size_t size)
{
    const bool is_read = fgets(named, PATH_MAX, file) != NULL;
    named[is_read ? strcspn(named, " \t\r\n") : 0] = 0;
    if (!*named)
        snprintf(fault, size, "which names no library in its first line");
    return *named;
}

static bool read_json(FILE *file, char named[PATH_MAX], char *fault, size_t size)
{
    json_error_t error;
    json_t *root = json_loadf(file, JSON_DISABLE_EOF_CHECK, &error);
    const char *name =
        json_string_value(json_object_get(json_object_get(root, "ICD"), "library_path"));
    snprintf(named, PATH_MAX, "%s", name ? name : "");
    if (!root)
        snprintf(fault, size, "which is no JSON: line %d: %.120s", error.line, error.text);
    else if (!*named)
        snprintf(fault, size, "which names no library as ICD.library_path");
    json_decref(root);
    return *named;
}

bool rg_manifest_read_library(FILE *file, bool is_text, char named[PATH_MAX], char *fault,
                              size_t size)
{
    return is_text ? read_text(file, named, fault, size) : read_json(file, named, fault, size);
}

static void examine_file(struct walk *walk, const char *path)
{
    char fault[240], library[PATH_MAX], whole[2 * PATH_MAX];
    const char *why = NULL;
    FILE *file = rg_file_open(path, &why);
    snprintf(fault, sizeof(fault), "which cannot be read: %s", why ? why : "");
    const bool is_read =
        file && rg_manifest_read_library(file, walk->rules->is_text, library, fault, sizeof(fault));
    if (file)
        fclose(file);
    if (!is_read) {
        count_driver(walk);
        note(walk, path, fault, false);
        return;
    }
    const char *slash = strrchr(path, '/');
    const bool is_beside =
        walk->rules->beside_file && *library != '/' && strchr(library, '/') && slash;
    snprintf(whole, sizeof(whole), "%.*s%s", is_beside ? (int)(slash + 1 - path) : 0, path,
             library);
    examine_library(walk, path, whole);
}

// --- places ---

static void examine_folder(struct walk *walk, const char *folder)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, NULL, alphasort);
    char path[PATH_MAX];
    for (int i = 0; i < count; i++) {
        snprintf(path, sizeof(path), "%.*s/%s", PATH_MAX / 2, folder, entries[i]->d_name);
        if (ends_with(entries[i]->d_name, walk->rules->ending))
            examine_file(walk, path);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
}

// Examines the path in a variable. A path to nothing, unlike a driver's file name, is how users
// switch an API off ("/nonexistent"), and is no failure.
static void examine_named(struct walk *walk, const char *path)
{
    const struct rg_manifest_rules *rules = walk->rules;
    char usual[PATH_MAX];
    struct stat status;
    snprintf(usual, sizeof(usual), "%s/%s", rules->places[0].usual, path);
    if (rules->names_usual && !strchr(path, '/') && !stat(usual, &status))
        path = usual;
    const bool is_there = !stat(path, &status);
    const bool is_library = rules->names_libraries && (is_there || strstr(path, ".so"));
    if (is_there && S_ISDIR(status.st_mode))
        examine_folder(walk, path);
    else if (ends_with(path, rules->ending) || (is_there && rules->names_any))
        examine_file(walk, path);
    else if (is_library)
        examine_library(walk, path, path);
    else if (is_there)
        note(walk, path, "which the loader passes over, for its name has another ending", false);
}

static void each_path(struct walk *walk, const char *paths, const char *below,
                      void (*examine)(struct walk *walk, const char *path))
{
    char path[PATH_MAX];
    for (const char *at = paths; *at; at += strcspn(at, ":"), at += *at == ':') {
        const int length = (int)strcspn(at, ":");
        const char *home = !strncmp(at, "~/", 2) ? getenv("HOME") : "";
        const int skipped = *at == '~';
        snprintf(path, sizeof(path), "%.1024s%.*s%s", home ? home : "", length - skipped,
                 at + skipped, below);
        if (length > 0)
            examine(walk, path);
    }
}

static const char *value_of(const char *variable)
{
    const char *value = variable ? getenv(variable) : NULL;
    return value && *value ? value : NULL;
}

// The first variable of a list that is set; NULL: none.
static const char *first_set(const char *const *variables)
{
    while (*variables && !value_of(*variables))
        variables++;
    return *variables;
}

void rg_manifests_begin(const struct rg_manifest_rules *rules)
{
    char what[120];
    const char *variable = first_set(rules->instead);
    if (!variable)
        variable = first_set(rules->beside);
    if (!variable)
        return;
    snprintf(what, sizeof(what), "%s=%s", variable, getenv(variable));
    rg_doing_begin("loading drivers of", what);
}

// Examines all places. Returns the variable that replaces the usual ones; NULL if none is set.
static const char *examine_all(struct walk *walk)
{
    const struct rg_manifest_rules *rules = walk->rules;
    const char *instead = first_set(rules->instead);
    for (int i = 0; rules->beside[i]; i++) {
        walk->variable = rules->beside[i];
        if (value_of(walk->variable))
            each_path(walk, value_of(walk->variable), "", examine_named);
    }
    walk->variable = instead;
    if (instead)
        each_path(walk, value_of(instead), "", examine_named);
    for (const struct rg_manifest_place *p = rules->places; !instead && (p->variable || p->usual);
         p++) {
        const char *value = value_of(p->variable);
        each_path(walk, value ? value : p->usual, rules->below, examine_folder);
    }
    return instead;
}

bool rg_manifests_sound(const struct rg_manifest_rules *rules, char *paths, size_t size)
{
    struct walk walk = {.rules = rules};
    const bool is_named = examine_all(&walk) || walk.named_by;
    snprintf(paths, size, "%s", walk.sound);
    return !is_named && *walk.broken && *paths;
}

// --- judging ---

static enum rg_list_end end_of(const struct walk *walk)
{
    return walk->is_failing ? RG_LIST_FAILED : RG_LIST_BROKEN;
}

static int judge_none(const struct walk *walk, const char *instead, enum rg_manifest_state state,
                      char *why, size_t why_size)
{
    const char *broken = *walk->broken ? walk->broken : walk->foreign;
    if (*broken) {
        rg_text_add(why, why_size, "", ": %s", broken);
        return end_of(walk);
    }
    if (walk->named_by) {
        rg_text_add(why, why_size, "",
                    "; %s names a driver that gives no device here: name another", walk->named_by);
        return RG_LIST_BROKEN;
    }
    if (state == RG_MANIFEST_BROKEN)
        return RG_LIST_BROKEN;
    if (state == RG_MANIFEST_FAILED || (state == RG_MANIFEST_UNCLEAR && walk->devices))
        return RG_LIST_FAILED;
    if (instead)
        rg_text_add(why, why_size, "", "; %s=%.100s names no driver: unset it, or name one",
                    instead, getenv(instead));
    else if (walk->drivers)
        rg_text_add(why, why_size, "", "; the drivers that are installed serve no other device");
    else
        rg_text_add(why, why_size, "", "; install the Debian package %s, which brings one",
                    walk->rules->package);
    return 0;
}

int rg_manifests_judge(const struct rg_manifest_rules *rules, int count,
                       enum rg_manifest_state state, char *why, size_t why_size)
{
    struct walk walk = {.rules = rules, .asks = count <= 0};
    const char *instead = examine_all(&walk);
    if (count <= 0)
        return judge_none(&walk, instead, state, why, why_size);
    snprintf(why, why_size, "%s", walk.broken);
    return walk.is_named_broken ? end_of(&walk) : count;
}
