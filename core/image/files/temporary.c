#define _GNU_SOURCE // O_TMPFILE
#include "core/image/files/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/files/file.h"
#include "core/base/program.h"

enum { MAX_NAMES = 100 };

// --- the target ---

// Sets `mode` to the existing file's mode, including its type, or to 0 if there is none.
static bool find_target(const char *path, char target[PATH_MAX], mode_t *mode, struct rg_why *why)
{
    struct stat st;
    const char *refused;
    *mode = 0;
    if (strlen(path) >= PATH_MAX)
        return rg_why_set(why, "the path is too long; choose a shorter one");
    if (!rg_file_follow(path, target, &refused))
        return rg_why_set(why, "%s; name another file", refused);
    if (lstat(target, &st) && !lstat(path, &st) && S_ISLNK(st.st_mode))
        return rg_why_set(why, "is a link to nothing; remove it, or name another file");
    if (lstat(target, &st))
        return errno == ENOENT || errno == ENOTDIR || errno == EACCES ||
               rg_why_system(why, errno, "cannot be written: %s; choose another name",
                             strerror(errno));
    if (!S_ISREG(st.st_mode))
        return rg_why_set(why, S_ISDIR(st.st_mode) ? "is a folder; name a file in it"
                                                   : "is not a regular file; name another");
    *mode = st.st_mode;
    return !access(target, W_OK) ||
           rg_why_system(why, errno,
                         "cannot be written: %s; name another file, or make it writable",
                         strerror(errno));
}

// Makes a name in the target's folder, short enough to fit wherever the target's name does.
static void name_beside(const char *target, int attempt, char *name, size_t size)
{
    const char *slash = strrchr(target, '/');
    snprintf(name, size, "%.*s.raingauge-%ld-%d.tmp", slash ? (int)(slash - target) + 1 : 0, target,
             (long)getpid(), attempt);
}

// --- named temporaries, removed on a signal ---

// Temporary files that have a name. NULL: a free place.
static _Atomic(const struct rg_temporary *) named[MAX_NAMES];
static pid_t owner; // a forked process leaves its parent's files alone

static void remove_named(void)
{
    for (int i = 0; i < MAX_NAMES && getpid() == owner; i++) {
        const struct rg_temporary *t = atomic_load(&named[i]);
        if (t)
            unlink(t->path);
    }
}

static void remember(const struct rg_temporary *t)
{
    owner = getpid();
    for (int i = 0; i < MAX_NAMES; i++) {
        const struct rg_temporary *none = NULL;
        if (atomic_compare_exchange_strong(&named[i], &none, t))
            break;
    }
    rg_program_before_end(remove_named);
}

static void forget(const struct rg_temporary *t)
{
    for (int i = 0; i < MAX_NAMES; i++) {
        const struct rg_temporary *it = t;
        atomic_compare_exchange_strong(&named[i], &it, NULL);
    }
}

// --- making ---

// Until chmod, a temporary file that replaces another is 0600, so that nobody else can read it.
static mode_t first_mode(const struct rg_temporary *t)
{
    return t->mode ? S_IRUSR | S_IWUSR : 0666;
}

static int open_nameless(struct rg_temporary *t)
{
    char folder[PATH_MAX];
    const char *slash = strrchr(t->target, '/');
    snprintf(folder, sizeof(folder), "%.*s", slash ? (int)(slash - t->target) + 1 : 1,
             slash ? t->target : ".");
    t->fd = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, first_mode(t));
    if (t->fd < 0)
        return errno;
    snprintf(t->path, sizeof(t->path), "/proc/self/fd/%d", t->fd);
    if (!access(t->path, W_OK))
        return 0;
    close(t->fd);
    return EOPNOTSUPP; // without /proc it has no path to write it by
}

static int open_named(struct rg_temporary *t)
{
    t->is_named = true;
    t->fd = -1;
    for (int attempt = 0; t->fd < 0 && attempt < MAX_NAMES; attempt++) {
        name_beside(t->target, attempt, t->path, sizeof(t->path));
        t->fd = open(t->path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, first_mode(t));
        if (t->fd < 0 && errno != EEXIST)
            break;
    }
    if (t->fd < 0)
        return errno;
    remember(t);
    return 0;
}

bool rg_temporary_make(const char *path, struct rg_temporary *temporary, struct rg_why *why)
{
    temporary->is_named = false;
    if (!find_target(path, temporary->target, &temporary->mode, why))
        return false;
    int error = open_nameless(temporary);
    if (error) // some file systems lack nameless files, and some containers refuse them
        error = open_named(temporary);
    if (error == ENOTDIR)
        return rg_why_set(why, "cannot be written: %s; name a folder", strerror(error));
    if (error == ENOENT)
        return rg_why_set(why, "its folder is not there; make it first");
    if (error == EEXIST)
        return rg_why_set(why, "temporary files of this name are in the way; remove them");
    return !error || rg_why_system(why, error, "cannot be written: %s; choose another folder",
                                   strerror(error));
}

// --- moving into place ---

static bool give_mode(const struct rg_temporary *t)
{
    if (t->mode) // fails if a file system has no modes, which does no harm
        fchmod(t->fd, t->mode & 0777);
    return true;
}

// Copies a nameless file to a named one if the system cannot name it (linkat); the copy then
// becomes `t`.
static bool copy_to_name(struct rg_temporary *t)
{
    const int from = t->fd;
    int error = open_named(t);
    if (!error && !rg_file_copy(from, t->fd))
        error = errno;
    close(from);
    errno = error;
    return !error && give_mode(t);
}

// linkat cannot replace a file, so that only an existing target needs a named temporary for a
// moment.
static bool put_in_place(struct rg_temporary *t)
{
    give_mode(t);
    if (!t->is_named && !linkat(AT_FDCWD, t->path, AT_FDCWD, t->target, AT_SYMLINK_FOLLOW))
        return true;
    const bool is_refused = !t->is_named && errno != EEXIST;
    if (t->is_named || is_refused)
        return (t->is_named || copy_to_name(t)) && !rename(t->path, t->target);
    char name[PATH_MAX];
    for (int attempt = 0; errno == EEXIST && attempt < MAX_NAMES; attempt++) {
        name_beside(t->target, attempt, name, sizeof(name));
        if (linkat(AT_FDCWD, t->path, AT_FDCWD, name, AT_SYMLINK_FOLLOW))
            continue;
        if (!rename(name, t->target))
            return true;
        const int error = errno;
        unlink(name);
        errno = error;
    }
    return false;
}

bool rg_temporary_end(struct rg_temporary *temporary, bool written, struct rg_why *why)
{
    const bool placed = written && put_in_place(temporary);
    if (written && !placed)
        rg_why_system(why, errno, "cannot be put in place: %s", strerror(errno));
    if (!placed && temporary->is_named)
        unlink(temporary->path);
    if (temporary->is_named)
        forget(temporary);
    close(temporary->fd);
    return placed;
}

bool rg_temporary_try(const char *path, struct rg_why *why)
{
    struct rg_temporary temporary;
    if (!rg_temporary_make(path, &temporary, why))
        return false;
    rg_temporary_end(&temporary, false, why);
    return true;
}
