#include "harness/devices/names.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "harness/console/threads.h"
#include "harness/devices/workers/environment.h"

// --- short names ---

enum { MOST_SHORT = 64, SHORT_SIZE = 64 };

// The short names given to this process, because a name is read many times.
static struct {
    int count;
    struct {
        char name[SHORT_SIZE], full[RG_DEVICE_NAME_SIZE];
    } all[MOST_SHORT];
} known;

const char *rg_device_name_full(const char *name)
{
    for (int i = 0; i < known.count; i++)
        if (!strcmp(known.all[i].name, name))
            return known.all[i].full;
    return name;
}

// The length of the short name at a name's beginning; 0: none.
static size_t short_length(const char *name)
{
    const size_t length = strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "0123456789._-");
    return name[length] == '=' ? length : 0;
}

// Splits off the short name, or replaces a short name by the name that it stands for.
static bool read_short(struct rg_device_name *name)
{
    const size_t length = short_length(name->name);
    memcpy(name->full, rg_device_name_full(name->name), RG_DEVICE_NAME_SIZE);
    if (!length)
        return true;
    memmove(name->full, name->full + length + 1, strlen(name->full + length + 1) + 1);
    name->name[length] = 0;
    if (!strcmp(name->name, "all") || rg_backend_of(name->name) || length >= SHORT_SIZE ||
        !isalnum((unsigned char)*name->name))
        return rg_error("device '%.80s=%.200s': a short name begins with a letter or a digit, has "
                        "at most %d characters, and is no API's; choose another one",
                        name->name, name->full, SHORT_SIZE - 1);
    if (!*name->full || short_length(name->full) || rg_device_name_full(name->full) != name->full)
        return rg_error("device '%s=%.200s': a short name stands before the name of a device; "
                        "write it as new=vulkan@DRIVER=PREFIX",
                        name->name, name->full);
    const char *before = rg_device_name_full(name->name);
    if (before != name->name)
        return !strcmp(before, name->full) ||
               rg_error("device '%s=%.200s': '%s' is short for '%s' already; choose another one",
                        name->name, name->full, name->name, before);
    if (known.count == MOST_SHORT)
        return rg_error("device '%s=%.200s': more than %d short names", name->name, name->full,
                        MOST_SHORT);
    snprintf(known.all[known.count].name, SHORT_SIZE, "%.*s", SHORT_SIZE - 1, name->name);
    memcpy(known.all[known.count++].full, name->full, RG_DEVICE_NAME_SIZE);
    return true;
}

// --- reading ---

// The end of a name: a comma outside quotes, or the end. NULL: a quote is not closed.
static const char *find_end(const char *name)
{
    bool quoted = false;
    for (; *name && (quoted || *name != ','); name++)
        quoted = quoted != (*name == '"');
    return quoted ? NULL : name;
}

// Copies a value without quotes, up to its semicolon or the end. Returns the rest.
static const char *copy_value(const char *from, char **to)
{
    bool quoted = false;
    for (; *from && (quoted || *from != ';'); from++) {
        if (*from != '"')
            *(*to)++ = *from;
        else if (quoted && from[1] == '"')
            *(*to)++ = *from++;
        else
            quoted = !quoted;
    }
    return *from ? from + 1 : from;
}

// Copies a variable's name and its '='. NULL if there is none.
static const char *copy_key(const char *from, char **to)
{
    const size_t length = strcspn(from, "=");
    if (!length || from[length] != '=' || isdigit((unsigned char)*from))
        return NULL;
    for (size_t i = 0; i < length; i++)
        if (!isalnum((unsigned char)from[i]) && from[i] != '_')
            return NULL;
    memcpy(*to, from, length + 1);
    *to += length + 1;
    return from + length + 1;
}

// Bad thread counts of the whole process are corrected (harness/console/threads.h). Those in a
// device's name are refused: every record has the name, so it must be true.
static bool has_sound_threads(const struct rg_device_name *name)
{
    const char *given = rg_environment_find(name->environment, "OMP_NUM_THREADS");
    char *end; // end of the first number in a possible list
    const long threads = given ? strtol(given, &end, 10) : 1;
    return !given || (threads >= 1 && threads <= rg_threads_most() && (!*end || *end == ',')) ||
           rg_error("device '%s': OMP_NUM_THREADS is no number from 1 to %ld, four a processor; "
                    "write one",
                    name->name, rg_threads_most());
}

// Whether a variable before `last` has the same name.
static bool is_set_before(const char *environment, const char *last)
{
    const size_t length = strcspn(last, "=") + 1;
    while (environment < last && strncmp(environment, last, length) != 0)
        environment += strlen(environment) + 1;
    return environment < last;
}

static bool read_environment(struct rg_device_name *name)
{
    const char *from = strchr(name->full, '@');
    char *to = name->environment;
    for (from = from ? from + 1 : ""; *from; *to++ = 0) {
        const char *const variable = to, *value = copy_key(from, &to);
        if (!value)
            return rg_error("device '%s': '%.60s' does not set a variable; write it as KEY=value, "
                            "KEY of letters, digits and _",
                            name->name, from);
        if (is_set_before(name->environment, variable))
            return rg_error("device '%s': sets %.*s twice; choose one value", name->name,
                            (int)(value - from - 1), from);
        from = copy_value(value, &to);
    }
    *to = 0;
    const bool is_told = !strchr(name->full, '@') || to > name->environment;
    return is_told ||
           rg_error("device '%s': no KEY=value follows its '@'; write one, or leave it out",
                    name->name);
}

// The faulty beginning of a list of names, "" if it is well-formed.
static const char *fault_of(const char *names, const char *end)
{
    if (!end)
        return "a double quote is not closed";
    if (!*names)
        return "names no device at all; write names with a comma between two";
    return end == names || (*end && !end[1])
               ? "names no device beside a comma; write names with a comma between two"
               : "";
}

// Reads the first name of `rest`, a part of `names`; messages quote `names` and the option in
// `given_to`.
static bool read_name(const char *given_to, const char *names, const char **rest,
                      struct rg_device_name *name)
{
    const char *end = find_end(*rest), *fault = fault_of(*rest, end);
    if (*fault)
        return rg_error("%s '%s': %s", given_to, names, fault);
    const size_t length = (size_t)(end - *rest);
    if (length >= sizeof(name->name))
        return rg_error("device '%.60s...': a name has at most %d characters", *rest,
                        RG_DEVICE_NAME_SIZE - 1);
    memset(name, 0, sizeof(*name));
    memcpy(name->name, *rest, length);
    *rest = *end ? end + 1 : end;
    return read_short(name) && read_environment(name) && has_sound_threads(name);
}

bool rg_device_name_read(const char **names, struct rg_device_name *name)
{
    return read_name("devices", *names, names, name);
}

bool rg_device_names_check(const char *given_to, const char *names)
{
    struct rg_device_name name;
    const char *rest = names;
    do
        if (!read_name(given_to, names, &rest, &name))
            return false;
    while (*rest);
    return true;
}

bool rg_device_names_one(const char *names, const char *command)
{
    struct rg_device_name name;
    const char *rest = names;
    if (!read_name("--device", names, &rest, &name))
        return false;
    return (strcmp(names, "all") != 0 && !*rest) ||
           rg_error("--device %s: %s draws on one device; `raingauge diff` compares several", names,
                    command);
}

// Writes a value in double quotes, doubling those in it; at most `size` bytes.
static size_t quote_value(const char *value, char *to, size_t size)
{
    size_t used = 0;
    for (const char *v = value; *v && used + 3 < size; v++) {
        to[used++] = *v;
        if (*v == '"')
            to[used++] = '"';
    }
    to[used] = 0;
    return used;
}

bool rg_device_name_with(const char *name, const char *key, const char *value,
                         char with[RG_DEVICE_NAME_SIZE])
{
    char quoted[2 * RG_DEVICE_NAME_SIZE];
    const char *mark = value[strcspn(value, ",;\"")] ? "\"" : "", *full = rg_device_name_full(name);
    if (*mark)
        quote_value(value, quoted, sizeof(quoted));
    const int length =
        snprintf(with, RG_DEVICE_NAME_SIZE, "%s%c%s=%s%s%s", full, strchr(full, '@') ? ';' : '@',
                 key, mark, *mark ? quoted : value, mark);
    return length < RG_DEVICE_NAME_SIZE ||
           rg_error("device '%s': with %s=%.60s... its name has more than %d characters", name, key,
                    value, RG_DEVICE_NAME_SIZE - 1);
}
