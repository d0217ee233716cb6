#include "core/base/memory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/text/cgroup.h"
#include "core/base/log.h"

// Smaller requests skip the look-up of available memory, which takes tens of microseconds.
#define SMALL_BYTES ((int64_t)1 << 20)

#define LARGE_BYTES ((int64_t)1 << 26)

static const char variable[] = "RG_MEMORY_BYTES";

static struct {
    bool is_known;  // the limit has been found
    bool is_chosen; // the user chose the limit, rather than this file from free memory
    int64_t limit_bytes, taken_bytes;
} memory;

// --- the machine's memory ---

static FILE *open_in(const char *place, const char *name)
{
    char path[RG_CGROUP_PATH + 40];
    snprintf(path, sizeof(path), "%s/%s", place, name);
    return fopen(path, "r");
}

// The number in a file that holds one number; -1 if there is none.
static int64_t number_in(const char *place, const char *name)
{
    long long number = -1;
    FILE *file = open_in(place, name);
    if (file && fscanf(file, "%lld", &number) != 1)
        number = -1;
    if (file)
        fclose(file);
    return number;
}

// The number after a word at the beginning of a line; 0 if there is none.
static int64_t number_behind(const char *place, const char *name, const char *word)
{
    char line[128];
    long long number = 0;
    const size_t length = strlen(word);
    FILE *file = open_in(place, name);
    while (file && fgets(line, sizeof(line), file))
        if (!strncmp(line, word, length) && sscanf(line + length, "%lld", &number) == 1)
            break;
    if (file)
        fclose(file);
    return number;
}

// Lowers *least_bytes to what a control group still allows, if that is less.
static void take_least(const char *place, bool is_v2, void *user)
{
    int64_t *least_bytes = user;
    const int64_t most = number_in(place, is_v2 ? "memory.max" : "memory.limit_in_bytes");
    const int64_t now = number_in(place, is_v2 ? "memory.current" : "memory.usage_in_bytes");
    if (most < 0 || now < 0)
        return; // "max", or no such group
    const int64_t dropped =
        number_behind(place, "memory.stat", is_v2 ? "inactive_file " : "total_inactive_file ");
    const int64_t held = now > dropped ? now - dropped : 0;
    const int64_t left = most > held ? most - held : 1; // not 0, which means unknown
    if (left < *least_bytes)
        *least_bytes = left;
}

int64_t rg_memory_available_under(const char *root)
{
    char place[RG_CGROUP_PATH];
    snprintf(place, sizeof(place), "%s/proc", root);
    int64_t bytes = number_behind(place, "meminfo", "MemAvailable:") * 1024;
    if (bytes > 0)
        rg_cgroups_visit(root, "memory", take_least, &bytes);
    return bytes;
}

int64_t rg_memory_available(void)
{
    return rg_memory_available_under("");
}

static int64_t less_a_tenth(int64_t bytes)
{
    return bytes - bytes / 10;
}

// --- the limit ---

// The bytes that the environment variable names; 0 if it is unset or malformed, which is logged.
static int64_t chosen_bytes(void)
{
    const char *text = getenv(variable);
    char *end;
    if (!text || !*text)
        return 0;
    errno = 0;
    const long long bytes = strtoll(text, &end, 10);
    if (!errno && end != text && !*end && bytes > 0)
        return bytes;
    rg_warning("%s=%.40s: is no whole number of bytes above 0, and is ignored; write it as "
               "1000000000, or give --memory 1G",
               variable, text);
    return 0;
}

static void find_limit(void)
{
    const int64_t chosen = chosen_bytes(), available = rg_memory_available();
    memory.is_known = true;
    memory.is_chosen = chosen > 0;
    memory.limit_bytes = memory.is_chosen ? chosen
                         : available      ? less_a_tenth(available)
                                          : INT64_MAX / 2; // leaves room to add other sizes
}

void rg_memory_allow(int64_t bytes)
{
    char text[RG_MEMORY_TEXT];
    if (bytes <= 0)
        return;
    snprintf(text, sizeof(text), "%lld", (long long)bytes);
    setenv(variable, text, 1);
    find_limit();
}

int64_t rg_memory_limit(void)
{
    if (!memory.is_known)
        find_limit();
    return memory.limit_bytes;
}

static int64_t left_of_limit(void)
{
    const int64_t limit = rg_memory_limit();
    return limit > memory.taken_bytes ? limit - memory.taken_bytes : 0;
}

// Without a choice of the user, memory that other processes have taken meanwhile is also
// subtracted.
int64_t rg_memory_left(void)
{
    const int64_t left = left_of_limit();
    const int64_t available = memory.is_chosen ? 0 : less_a_tenth(rg_memory_available());
    return available && available < left ? available : left;
}

int64_t rg_memory_grant(int64_t theirs)
{
    const int64_t granted = left_of_limit() + theirs;
    return !memory.is_chosen ? 0 : granted > 0 ? granted : 1;
}

bool rg_memory_allows(int64_t bytes)
{
    return bytes <= (bytes < SMALL_BYTES ? left_of_limit() : rg_memory_left());
}

bool rg_memory_allows_piece(int64_t bytes)
{
    return bytes < LARGE_BYTES || rg_memory_allows(bytes);
}

bool rg_memory_take(int64_t bytes)
{
    if (!rg_memory_allows(bytes))
        return false;
    rg_memory_count(bytes);
    return true;
}

void rg_memory_give(int64_t bytes)
{
    rg_memory_count(-bytes);
}

void rg_memory_count(int64_t bytes)
{
    memory.taken_bytes += bytes;
}

int64_t rg_memory_taken(void)
{
    return memory.taken_bytes;
}

// --- messages ---

const char *rg_memory_text(int64_t bytes, char text[RG_MEMORY_TEXT])
{
    const double mib = (double)bytes / (1 << 20);
    if (mib < 1)
        snprintf(text, RG_MEMORY_TEXT, "%.0f KiB", mib * 1024);
    else if (mib < 1000)
        snprintf(text, RG_MEMORY_TEXT, mib < 9.95 ? "%.1f MiB" : "%.0f MiB", mib);
    else
        snprintf(text, RG_MEMORY_TEXT, "%.1f GiB", mib / 1024);
    return text;
}

bool rg_memory_refuse(const char *begin, int64_t bytes, const char *mend)
{
    char needed[RG_MEMORY_TEXT], left[RG_MEMORY_TEXT];
    rg_memory_text(bytes, needed);
    rg_memory_text(rg_memory_left(), left);
    return memory.is_chosen
               ? rg_error("%s needs %s, and %s of --memory are left; allow more, or "
                          "ask for less: %s",
                          begin, needed, left, mend)
               : rg_harness_error("%s needs %s, and %s are free; --memory allows more, %s "
                                  "needs less",
                                  begin, needed, left, mend);
}
