#include "harness/record/passport/origins.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/array.h"
#include "core/base/text/add.h"
#include "harness/record/named.h"

static const char *text_of(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));
    return text && *text ? text : "unknown";
}

// The parts of each device's key, by the device's name. They are made anew, for a key that was
// written may be another version's.
static json_t *parts_of_devices(const json_t *passport)
{
    json_t *all = json_object();
    const json_t *device;
    size_t i;
    json_array_foreach(json_object_get(passport, "devices"), i, device)
    {
        json_object_set_new(all, text_of(device, "name"), rg_key_parts(passport, device));
    }
    return all;
}

// --- keys, words, names ---

static void key_of(const json_t *host, const json_t *devices, char key[RG_KEY_SIZE])
{
    char *all = NULL;
    size_t size = 0;
    const char *name;
    json_t *parts;
    FILE *keys = json_object_size(devices) > 1 ? open_memstream(&all, &size) : NULL;
    rg_key_hash(host, key);
    json_object_foreach((json_t *)devices, name, parts)
    {
        rg_key_hash(parts, key);
        if (keys)
            fputs(key, keys);
    }
    if (keys && !fclose(keys))
        snprintf(key, RG_KEY_SIZE, "%016" PRIx64, (uint64_t)XXH3_64bits(all, size));
    free(all);
}

void rg_origin_key(const json_t *passport, char key[RG_KEY_SIZE])
{
    json_t *host = rg_key_parts(passport, NULL), *devices = parts_of_devices(passport);
    key_of(host, devices, key);
    json_decref(host);
    json_decref(devices);
}

void rg_origin_text(const json_t *passport, char text[RG_KEY_TEXT])
{
    json_t *host = rg_key_parts(passport, NULL);
    char name[RG_KEY_TEXT];
    rg_text_copy(name, sizeof(name), text_of(host, "cpu"));
    snprintf(text, RG_KEY_TEXT, "%.200s, %.20s cores",
             strcmp(name, "unknown") ? name : "unknown processor", text_of(host, "cores"));
    json_decref(host);
}

void rg_origin_name(int origin, char name[RG_ORIGIN_NAME])
{
    char reversed[RG_ORIGIN_NAME];
    int length = 0;
    for (int left = origin + 1; left > 0 && length < RG_ORIGIN_NAME - 1; left = (left - 1) / 26)
        reversed[length++] = (char)('A' + (left - 1) % 26);
    for (int i = 0; i < length; i++)
        name[i] = reversed[length - 1 - i];
    name[length] = 0;
}

void rg_origin_difference(const struct rg_origin *origin, const struct rg_origin *other,
                          char text[RG_KEY_TEXT])
{
    static const char *const own[] = {"api", "device", "driver"};
    char part[RG_KEY_TEXT];
    const char *name;
    json_t *parts;
    rg_key_difference(origin->host, other->host, text);
    json_object_foreach(origin->devices, name, parts)
    {
        const json_t *others = json_object_get(other->devices, name);
        for (int i = 0; others && i < 3; i++) {
            snprintf(part, sizeof(part), "%s %.200s and not %.200s", own[i], text_of(parts, own[i]),
                     text_of(others, own[i]));
            if (!json_equal(json_object_get(parts, own[i]), json_object_get(others, own[i])) &&
                !strstr(text, part))
                rg_text_add(text, RG_KEY_TEXT, "; ", "%s", part);
        }
    }
}

// --- finding them ---

static bool is_of(const struct rg_origin *origin, const json_t *host, const json_t *devices)
{
    bool same = json_equal(origin->host, host);
    const char *name;
    json_t *parts;
    json_object_foreach((json_t *)devices, name, parts)
    {
        const json_t *known = json_object_get(origin->devices, name);
        same = same && (!known || json_equal(known, parts));
    }
    return same;
}

// The index of the origin that these parts are of; -1: none.
static int find(const struct rg_origins *origins, const json_t *host, const json_t *devices)
{
    for (int64_t i = 0; i < origins->count; i++)
        if (is_of(&origins->all[i], host, devices))
            return (int)i;
    return -1;
}

static int add(struct rg_origins *origins, json_t *host, const json_t *passport)
{
    if (!rg_array_fit(&origins->all, &origins->room, origins->count + 1, sizeof(*origins->all),
                      "machines"))
        return -1;
    struct rg_origin *origin = &origins->all[origins->count];
    *origin = (struct rg_origin){.host = json_incref(host), .devices = json_object()};
    rg_origin_text(passport, origin->text);
    return (int)origins->count++;
}

int rg_origins_find(struct rg_origins *origins, const json_t *passport)
{
    json_t *host = rg_key_parts(passport, NULL), *devices = parts_of_devices(passport);
    int index = find(origins, host, devices);
    if (index < 0)
        index = add(origins, host, passport);
    if (index >= 0) {
        struct rg_origin *origin = &origins->all[index];
        json_object_update(origin->devices, devices);
        key_of(origin->host, origin->devices, origin->key);
    }
    json_decref(host);
    json_decref(devices);
    return index;
}

int rg_origins_known(const struct rg_origins *origins, const json_t *passport)
{
    json_t *host = rg_key_parts(passport, NULL), *devices = parts_of_devices(passport);
    const int index = find(origins, host, devices);
    json_decref(host);
    json_decref(devices);
    return index;
}

void rg_origins_free(struct rg_origins *origins)
{
    for (int64_t i = 0; i < origins->count; i++) {
        json_decref(origins->all[i].host);
        json_decref(origins->all[i].devices);
    }
    free(origins->all);
    *origins = (struct rg_origins){0};
}
