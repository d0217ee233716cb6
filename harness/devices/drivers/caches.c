#define _GNU_SOURCE // nftw, O_DIRECTORY
#include "harness/devices/drivers/caches.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "core/base/files/user.h"
#include "core/base/log.h"
#include "harness/devices/workers/environment.h"
#include "harness/record/passport/variables.h"

// --- folders in use ---

// Locks held until this process ends, so that no other removes the folders.
static struct {
    int count;
    char paths[128][PATH_MAX];
} held;

static bool is_held(const char *path)
{
    for (int i = 0; i < held.count; i++)
        if (!strcmp(held.paths[i], path))
            return true;
    return false;
}

static void hold(const char *path)
{
    if (is_held(path) || held.count == 128)
        return;
    const int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0)
        return;
    flock(fd, LOCK_SH | LOCK_NB); // stays open on purpose
    futimens(fd, NULL);           // marks the time of use
    snprintf(held.paths[held.count++], PATH_MAX, "%s", path);
}

// --- old ones go ---

static int remove_entry(const char *path, const struct stat *what, int kind, struct FTW *at)
{
    (void)what;
    (void)kind;
    (void)at;
    remove(path);
    return 0;
}

// Removes a folder unless another process uses it.
static void remove_unused(const char *path)
{
    const int fd = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0)
        return;
    if (!flock(fd, LOCK_EX | LOCK_NB))
        nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
    close(fd);
}

// The least recently used folder in `parent` that is not held here, and the number of folders.
static int find_oldest(const char *parent, char oldest[PATH_MAX])
{
    DIR *all = opendir(parent);
    struct timespec least = {0, 0};
    int count = 0;
    *oldest = 0;
    for (const struct dirent *entry = NULL; all && (entry = readdir(all));) {
        char path[PATH_MAX];
        struct stat what;
        if (*entry->d_name == '.' ||
            snprintf(path, sizeof(path), "%s/%s", parent, entry->d_name) >= PATH_MAX ||
            lstat(path, &what) || !S_ISDIR(what.st_mode))
            continue;
        count++;
        const bool is_older =
            !*oldest || what.st_mtim.tv_sec < least.tv_sec ||
            (what.st_mtim.tv_sec == least.tv_sec && what.st_mtim.tv_nsec < least.tv_nsec);
        if (!is_older || is_held(path))
            continue;
        least = what.st_mtim;
        memcpy(oldest, path, strlen(path) + 1);
    }
    if (all)
        closedir(all);
    return count;
}

// Stops at a folder in use, which cannot be removed.
static void keep_last(const char *parent, int kept)
{
    char oldest[PATH_MAX];
    struct stat what;
    while (find_oldest(parent, oldest) > kept && *oldest) {
        remove_unused(oldest);
        if (!lstat(oldest, &what))
            return;
    }
}

// Makes a folder if it is missing, and holds it; a new folder evicts old ones.
static bool use(const char *parent, const char *path, int kept)
{
    const bool is_new = !mkdir(path, 0700);
    if (!is_new && errno != EEXIST)
        return rg_system_error(
            errno, "%s: cannot be made: %s; set XDG_CACHE_HOME to a folder that takes files", path,
            strerror(errno));
    hold(path);
    if (is_new)
        keep_last(parent, kept);
    return true;
}

// --- finding the folder ---

// In the user's cache, or if there is none in a private folder among temporary files.
static bool find_root(char root[PATH_MAX])
{
    char why[256], name[PATH_MAX];
    const char *temporary = getenv("TMPDIR");
    struct stat what;
    if (rg_user_path(RG_USER_CACHE, "sides/", root, PATH_MAX, why) &&
        rg_user_make_folders(root, why) && !access(root, W_OK | X_OK)) {
        root[strlen(root) - 1] = 0;
        return true;
    }
    snprintf(name, sizeof(name), "%.4000s/raingauge-%ld",
             temporary && *temporary ? temporary : "/tmp", (long)getuid());
    memcpy(root, name, PATH_MAX);
    mkdir(root, 0700);
    return (!lstat(root, &what) && S_ISDIR(what.st_mode) && what.st_uid == getuid() &&
            !access(root, W_OK | X_OK)) ||
           rg_error("%s: cannot be made, in which drivers keep code; set XDG_CACHE_HOME to a "
                    "folder that takes files",
                    root);
}

// Whether code may depend on a setting in a way that the driver's own key omits. Settings of
// raingauge choose what a driver is given, which that key holds; but another program may be a
// script that sets more.
static bool may_change_code(const char *setting)
{
    return strncmp(setting, "RG_", 3) != 0 || !strncmp(setting, "RG_PROGRAM=", 11);
}

// Hashes everything that a driver may read, in any order: a sum.
static uint64_t hash_settings(const char *api, const char *environment)
{
    uint64_t hash = XXH3_64bits(api, strlen(api));
    for (const char *v = environment; *v; v += strlen(v) + 1)
        hash += may_change_code(v) ? XXH3_64bits(v, strlen(v)) : 0;
    for (int i = 0; rg_variables[i].name; i++) {
        const char *name = rg_variables[i].name, *value = getenv(name);
        char text[PATH_MAX];
        if (!value || rg_environment_find(environment, name))
            continue;
        snprintf(text, sizeof(text), "%s=%s", name, value);
        hash += XXH3_64bits(text, strlen(text));
    }
    return hash;
}

static bool take_driver(struct rg_side_folder *f, uint64_t driver)
{
    char path[PATH_MAX + 32];
    f->driver = driver;
    snprintf(path, sizeof(path), "%s/%016" PRIx64, f->settings_path, driver);
    if (strlen(path) >= PATH_MAX)
        return rg_error("%s: is too long a path; set XDG_CACHE_HOME to a shorter one", path);
    memcpy(f->path, path, strlen(path) + 1);
    return use(f->settings_path, f->path, RG_SIDE_DRIVERS_KEPT);
}

static void name_note(const struct rg_side_folder *f, char note[PATH_MAX + 16])
{
    snprintf(note, PATH_MAX + 16, "%s/driver", f->settings_path);
}

static uint64_t read_note(const struct rg_side_folder *f)
{
    char path[PATH_MAX + 16];
    uint64_t driver = 0;
    name_note(f, path);
    FILE *note = fopen(path, "re");
    if (note && fscanf(note, "%16" SCNx64, &driver) != 1)
        driver = 0;
    if (note)
        fclose(note);
    return driver;
}

bool rg_side_folder_find(const char *api, const char *environment, struct rg_side_folder *f)
{
    char root[PATH_MAX], path[PATH_MAX + 32];
    f->settings = hash_settings(api, environment);
    if (!find_root(root))
        return false;
    snprintf(path, sizeof(path), "%s/%016" PRIx64, root, f->settings);
    if (strlen(path) >= PATH_MAX - 64)
        return rg_error("%s: is too long a path; set XDG_CACHE_HOME to a shorter one", path);
    memcpy(f->settings_path, path, strlen(path) + 1);
    return use(root, f->settings_path, RG_SIDES_KEPT) && take_driver(f, read_note(f));
}

bool rg_side_folder_move(struct rg_side_folder *f, uint64_t driver)
{
    char path[PATH_MAX + 16];
    if (driver == f->driver || !take_driver(f, driver))
        return false;
    name_note(f, path);
    FILE *note = fopen(path, "we");
    if (note) { // without a note, the next opening finds the driver again
        fprintf(note, "%016" PRIx64 "\n", driver);
        fclose(note);
    }
    return true;
}

bool rg_side_folder_in(const struct rg_side_folder *f, const char *name, char path[PATH_MAX])
{
    snprintf(path, PATH_MAX, "%.4000s/%.40s", f->path, name);
    return !mkdir(path, 0700) || errno == EEXIST ||
           rg_system_error(
               errno, "%s: cannot be made: %s; set XDG_CACHE_HOME to a folder that takes files",
               path, strerror(errno));
}

bool rg_side_caches_set(const struct rg_side_folder *f, struct rg_worker_variables *variables)
{
    static const char *const caches[][2] = {{"MESA_SHADER_CACHE_DIR", "mesa"},
                                            {"POCL_CACHE_DIR", "pocl"},
                                            {"__GL_SHADER_DISK_CACHE_PATH", "nvidia"},
                                            {"CUDA_CACHE_PATH", "cuda"}};
    bool ok = true;
    for (int i = 0; ok && i < 4; i++) {
        char path[PATH_MAX];
        if (variables->text && rg_environment_find(variables->text, caches[i][0]))
            continue;
        ok = rg_side_folder_in(f, caches[i][1], path) &&
             rg_variables_set(variables, caches[i][0], path);
    }
    return ok;
}
