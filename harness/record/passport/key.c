#include "harness/record/passport/key.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "harness/record/named.h"
#include "harness/record/passport/variables.h"

// --- parts ---

__attribute__((format(printf, 3, 4))) static void set(json_t *parts, const char *name,
                                                      const char *format, ...)
{
    char text[RG_KEY_TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof(text), format, args);
    va_end(args);
    json_object_set_new(parts, name, rg_json_text(text));
}

// Adds the CPU's name without the padding of some kernels.
static void set_cpu(json_t *parts, const char *cpu)
{
    char text[256];
    size_t length = 0;
    for (; *cpu && length + 1 < sizeof(text); cpu++)
        if (*cpu != ' ' || (length && text[length - 1] != ' '))
            text[length++] = *cpu;
    length -= length && text[length - 1] == ' ';
    set(parts, "cpu", "%.*s", (int)length, text);
}

static void set_features(json_t *parts, const json_t *features)
{
    char text[512] = "";
    size_t i, used = 0;
    const json_t *word;
    json_array_foreach(features, i, word)
    {
        if (used < sizeof(text))
            used += (size_t)snprintf(text + used, sizeof(text) - used, "%s%s", i ? " " : "",
                                     json_string_value(word));
    }
    set(parts, "features", "%s", text);
}

// The passport's variables have a fixed order, so that equal sets make equal texts.
static void set_variables(json_t *parts, const json_t *environment)
{
    char text[RG_KEY_TEXT] = "";
    size_t used = 0;
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)environment, name, value)
    {
        if (rg_variable_is_of_speed(name) && used < sizeof(text))
            used += (size_t)snprintf(text + used, sizeof(text) - used, "%s%s=%s", used ? " " : "",
                                     name, json_string_value(value));
    }
    set(parts, "variables", "%s", text);
}

json_t *rg_key_parts(const json_t *passport, const json_t *device)
{
    json_t *parts = json_object();
    const json_t *machine = json_object_get(passport, "machine");
    const json_t *build = json_object_get(passport, "raingauge");
    const double quota = json_number_value(json_object_get(machine, "quota_cpus"));
    set_cpu(parts, rg_json_text_of(machine, "cpu"));
    set_features(parts, json_object_get(machine, "features"));
    set(parts, "cores", "%lld",
        (long long)json_integer_value(json_object_get(machine, "cores_allowed")));
    if (quota > 0)
        set(parts, "quota", "%.1f CPUs", quota);
    else
        set(parts, "quota", "none");
    set(parts, "clocks", "%s", rg_json_text_of(machine, "clocks"));
    set(parts, "kernel", "%s", rg_json_text_of(machine, "kernel"));
    set(parts, "compiler", "%s, %s", rg_json_text_of(build, "compiler"),
        rg_json_text_of(build, "type"));
    set_variables(parts, json_object_get(passport, "environment"));
    for (const char *const *name = (const char *const[]){"api", "device", "driver", NULL}; *name;
         name++)
        set(parts, *name, "%s", rg_json_text_of(device, *name));
    return parts;
}

// --- texts ---

void rg_key_hash(const json_t *parts, char key[RG_KEY_SIZE])
{
    char *text = json_dumps(parts, JSON_COMPACT | JSON_SORT_KEYS);
    *key = 0;
    if (text)
        snprintf(key, RG_KEY_SIZE, "%016" PRIx64, (uint64_t)XXH3_64bits(text, strlen(text)));
    free(text);
}

bool rg_key_is(const char *text)
{
    return strlen(text) == RG_KEY_SIZE - 1 && strspn(text, "0123456789abcdef") == RG_KEY_SIZE - 1;
}

static const char *or_nothing(const char *text)
{
    return *text ? text : "unknown";
}

void rg_key_difference(const json_t *now, const json_t *then, char text[RG_KEY_TEXT])
{
    size_t used = 0;
    const char *name;
    json_t *value;
    *text = 0;
    json_object_foreach((json_t *)now, name, value)
    {
        const char *is = json_string_value(value), *was = rg_json_text_of(then, name);
        if (strcmp(is, was) && used < RG_KEY_TEXT)
            used += (size_t)snprintf(text + used, RG_KEY_TEXT - used, "%s%s %s and not %s",
                                     used ? "; " : "", name, or_nothing(is), or_nothing(was));
    }
}

static const json_t *libraries_of(const json_t *passport)
{
    return json_object_get(json_object_get(passport, "raingauge"), "libraries");
}

void rg_key_libraries(const json_t *now, const json_t *then, char text[RG_KEY_TEXT])
{
    *text = 0;
    if (libraries_of(now) && libraries_of(then))
        rg_key_difference(libraries_of(now), libraries_of(then), text);
}

void rg_key_text(const json_t *parts, char text[RG_KEY_TEXT])
{
    size_t used = 0;
    const char *name;
    json_t *value;
    *text = 0;
    json_object_foreach((json_t *)parts, name, value)
    {
        if (used < RG_KEY_TEXT)
            used += (size_t)snprintf(text + used, RG_KEY_TEXT - used, "%s%s %s", used ? "; " : "",
                                     name, or_nothing(json_string_value(value)));
    }
}
