#include "core/scene/light_file.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"

#define FARTHEST_M     100000.0
#define STRONGEST      1e6 // of a colour, and of an intensity
#define WIDEST_DEG     80.0
#define NARROWEST_DEG  1.0
#define LEAST_EDGE_DEG 0.1 // from a cone's inner to its outer edge

#define BIT(kind) (1u << (kind))
enum {
    PLACED = BIT(SCENERY_POINT) | BIT(SCENERY_SPOT),
    TURNED = BIT(SCENERY_SPOT) | BIT(SCENERY_SUN),
    CONED = BIT(SCENERY_SPOT),
    ALL = PLACED | TURNED,
};

static const char *const kind_names[] = {
    [SCENERY_POINT] = "point", [SCENERY_SPOT] = "spot", [SCENERY_SUN] = "sun"};

// The properties of a light, and the kinds of lights that have them.
static const struct property {
    const char *name;
    unsigned kinds;
} properties[] = {
    {"type", ALL},        {"position_m", PLACED}, {"direction", TURNED},
    {"colour", ALL},      {"intensity", ALL},     {"outer_deg", CONED},
    {"inner_deg", CONED}, {"near_m", PLACED},     {"shadows", ALL},
};

// The light whose property is being read, for messages: "lights.json: light 2".
struct place {
    char text[1024];
};

static struct place place_of(const char *path, int index)
{
    struct place place;
    if (index < 0)
        snprintf(place.text, sizeof(place.text), "%s: sky", path);
    else
        snprintf(place.text, sizeof(place.text), "%s: light %d", path, index + 1);
    return place;
}

// --- values ---

static bool read_numbers(const json_t *object, const char *name, const struct place *place,
                         double low, double high, double numbers[3])
{
    const json_t *array = json_object_get(object, name);
    if (!array)
        return rg_error("%s: '%s' is missing; give three numbers, such as [1, 0.8, 0.5]",
                        place->text, name);
    if (json_array_size(array) != 3)
        return rg_error("%s: '%s' must be a list of three numbers, such as [1, 0.8, 0.5]",
                        place->text, name);
    for (size_t c = 0; c < 3; c++) {
        const json_t *number = json_array_get(array, c);
        if (!json_is_number(number))
            return rg_error("%s: '%s' must hold numbers alone, such as [1, 0.8, 0.5]", place->text,
                            name);
        numbers[c] = json_number_value(number);
        if (!(numbers[c] >= low && numbers[c] <= high))
            return rg_error("%s: '%s' holds %g; choose from %g to %g", place->text, name,
                            numbers[c], low, high);
    }
    return true;
}

// `missing` is the number for a missing property.
static bool read_number(const json_t *object, const char *name, const struct place *place,
                        double low, double high, double missing, double *number)
{
    const json_t *value = json_object_get(object, name);
    *number = value ? json_number_value(value) : missing;
    if (value && !json_is_number(value))
        return rg_error("%s: '%s' must be a number", place->text, name);
    if (!(*number >= low && *number <= high))
        return rg_error("%s: '%s' is %g; choose from %g to %g", place->text, name, *number, low,
                        high);
    return true;
}

static bool read_colour(const json_t *object, const struct place *place, float colour[3])
{
    double rgb[3], intensity;
    if (!read_numbers(object, "colour", place, 0, STRONGEST, rgb) ||
        !read_number(object, "intensity", place, 0, STRONGEST, 1, &intensity))
        return false;
    for (int c = 0; c < 3; c++)
        colour[c] = (float)(rgb[c] * intensity);
    return true;
}

static bool read_direction(const json_t *object, const struct place *place, float direction[3])
{
    double d[3];
    if (!read_numbers(object, "direction", place, -FARTHEST_M, FARTHEST_M, d))
        return false;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(length > 1e-6))
        return rg_error("%s: 'direction' is no direction; point the way that the light travels, "
                        "such as [0, -1, 0] for down",
                        place->text);
    for (int c = 0; c < 3; c++)
        direction[c] = (float)(d[c] / length);
    return true;
}

static bool read_position(const json_t *object, const struct place *place, float position_m[3])
{
    double p[3];
    if (!read_numbers(object, "position_m", place, -FARTHEST_M, FARTHEST_M, p))
        return false;
    for (int c = 0; c < 3; c++)
        position_m[c] = (float)p[c];
    return true;
}

static bool read_cone(const json_t *object, const struct place *place, struct rg_light *light)
{
    double outer, inner;
    if (!read_number(object, "outer_deg", place, NARROWEST_DEG, WIDEST_DEG, 45, &outer) ||
        !read_number(object, "inner_deg", place, 0, outer - LEAST_EDGE_DEG, 0.75 * outer, &inner))
        return false;
    light->outer_deg = (float)outer;
    light->inner_deg = (float)inner;
    return true;
}

static bool read_shadows(const json_t *object, const struct place *place, bool *shadows)
{
    const json_t *value = json_object_get(object, "shadows");
    *shadows = !value || json_is_true(value);
    return !value || json_is_boolean(value) ||
           rg_error("%s: 'shadows' must be true or false", place->text);
}

// --- a light ---

static bool check_properties(json_t *object, const struct place *place, int kind)
{
    const char *name;
    json_t *value;
    json_object_foreach(object, name, value)
    {
        const struct property *known = NULL;
        for (size_t i = 0; i < sizeof(properties) / sizeof(properties[0]); i++)
            if (!strcmp(name, properties[i].name))
                known = &properties[i];
        if (!known)
            return rg_error(
                "%s: '%.60s' is no property of a light; a light has type, position_m, "
                "direction, colour, intensity, outer_deg, inner_deg, near_m and shadows",
                place->text, name);
        if (!(known->kinds & BIT(kind)))
            return rg_error("%s: a %s has no '%s'; leave it out or choose another type",
                            place->text, kind_names[kind], name);
    }
    return true;
}

static bool read_kind(const json_t *object, const struct place *place, int *kind)
{
    const char *name = json_string_value(json_object_get(object, "type"));
    for (*kind = SCENERY_POINT; *kind <= SCENERY_SUN; ++*kind)
        if (name && !strcmp(name, kind_names[*kind]))
            return true;
    return rg_error("%s: 'type' must be \"point\", \"spot\" or \"sun\"", place->text);
}

static bool read_light(json_t *object, const struct place *place, struct rg_light *light)
{
    double near_m = 0.1;
    if (!json_is_object(object))
        return rg_error("%s is no object; write {\"type\": \"point\", ...}", place->text);
    *light = (struct rg_light){.inner_deg = 30, .outer_deg = 45};
    if (!read_kind(object, place, &light->kind) || !check_properties(object, place, light->kind) ||
        !read_colour(object, place, light->colour) || !read_shadows(object, place, &light->shadows))
        return false;
    const unsigned kind = BIT(light->kind);
    if ((kind & PLACED) && (!read_position(object, place, light->position_m) ||
                            !read_number(object, "near_m", place, 0.001, 1000, 0.1, &near_m)))
        return false;
    light->near_m = (float)near_m;
    return (!(kind & TURNED) || read_direction(object, place, light->direction)) &&
           (!(kind & CONED) || read_cone(object, place, light));
}

// --- the file ---

static bool read_sky(json_t *object, const char *path, float colour[3])
{
    const struct place place = place_of(path, -1);
    const char *name;
    json_t *value;
    json_object_foreach(object, name, value)
    {
        if (strcmp(name, "colour") != 0 && strcmp(name, "intensity") != 0)
            return rg_error("%s: '%.60s' is no property of the sky; it has colour and intensity",
                            place.text, name);
    }
    return read_colour(object, &place, colour);
}

static bool read_all(json_t *root, const char *path, struct rg_lights *lights)
{
    json_t *list = json_object_get(root, "lights"), *sky = json_object_get(root, "sky"), *value;
    const char *name;
    *lights = (struct rg_lights){0};
    json_object_foreach(root, name, value) if (value != list && value != sky) return rg_error(
        "%s: '%.60s' is no property of the file; it has lights and sky", path, name);
    if (!json_is_array(list) || !json_array_size(list))
        return rg_error("%s: no lights; write {\"lights\": [{\"type\": \"point\", ...}]}", path);
    if (json_array_size(list) > SCENERY_MAX_LIGHTS)
        return rg_error("%s: %zu lights; %d is the most", path, json_array_size(list),
                        SCENERY_MAX_LIGHTS);
    for (size_t i = 0; i < json_array_size(list); i++) {
        const struct place place = place_of(path, (int)i);
        if (!read_light(json_array_get(list, i), &place, &lights->lights[i]))
            return false;
    }
    lights->count = (int)json_array_size(list);
    return !sky || read_sky(sky, path, lights->sky);
}

bool rg_light_file_read(const char *path, struct rg_lights *lights)
{
    const char *why;
    FILE *file = rg_file_open_small(path, &why); // parsing takes some twenty times the file's size
    if (!file)
        return rg_system_error(errno, "%s: %s; name a file of at most %d lights (docs/lights.md)",
                               path, why, SCENERY_MAX_LIGHTS);
    json_error_t error;
    json_t *root = json_loadf(file, JSON_REJECT_DUPLICATES, &error);
    fclose(file);
    if (!root)
        return rg_error("%s:%d:%d: %s; write JSON as docs/lights.md shows", path, error.line,
                        error.column, error.text);
    const bool ok = read_all(root, path, lights);
    json_decref(root);
    return ok;
}
