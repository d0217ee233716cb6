#define _GNU_SOURCE // nftw, FTW_ACTIONRETVAL
#include "harness/compare/bisect/stamp.h"

#include <ftw.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xxhash.h>

enum { MOST_FILES = 65536, OPEN_FOLDERS = 16 };

// Of the walk that is under way: nftw hands nothing on.
static uint64_t sum;
static int files;
static size_t root_length;

// A sum, for the order of files in a folder says nothing. A folder's own time changes with files
// that come and go, and these count themselves.
static int add(const char *path, const struct stat *found, int type, struct FTW *at)
{
    (void)at;
    if (type == FTW_D || type == FTW_NS || type == FTW_DNR)
        return FTW_CONTINUE;
    const int64_t facts[] = {(int64_t)found->st_mode, (int64_t)found->st_size,
                             (int64_t)found->st_mtim.tv_sec, (int64_t)found->st_mtim.tv_nsec};
    sum += XXH3_64bits_withSeed(facts, sizeof(facts),
                                XXH3_64bits(path + root_length, strlen(path + root_length)));
    return ++files < MOST_FILES ? FTW_CONTINUE : FTW_STOP;
}

// Of a file or folder, which a link leads to. 0: there is none.
static uint64_t stamp_of(const char *path)
{
    char real[PATH_MAX];
    if (!*path || !realpath(path, real))
        return 0;
    sum = 1;
    files = 0;
    root_length = strlen(real);
    nftw(real, add, OPEN_FOLDERS, FTW_PHYS | FTW_ACTIONRETVAL);
    return sum;
}

uint64_t rg_candidate_stamp(const char *name)
{
    static const char between[] = "@=;,:\""; // a colon: of lists, as VK_DRIVER_FILES takes
    uint64_t stamp = stamp_of(name);
    if (stamp)
        return stamp;
    for (const char *c = name; *c; c += strcspn(c, between)) {
        char piece[PATH_MAX] = "";
        c += strspn(c, between);
        const size_t length = strcspn(c, between);
        if (length < sizeof(piece))
            memcpy(piece, c, length);
        const uint64_t part = stamp_of(piece);
        stamp = part ? part + 31 * stamp : stamp;
    }
    return stamp;
}
