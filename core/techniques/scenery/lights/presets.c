// Chooses a scene's lights: the user's, or those of day or night. These have the order of the
// thesis's figure 5.7: the sun, three street lamps, a red and a green traffic light, then the
// nearest lamps, whose kinds take turns.
#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/scenery/lights/lights.h"

// Colours are those of a white matt surface that faces the light, for lamps at 1 m.
static const float sky_colours[][3] = {
    [SCENERY_DAY] = {0.30f, 0.34f, 0.40f}, [SCENERY_NIGHT] = {0.010f, 0.013f, 0.022f}};
static const float sun_colours[][3] = {
    [SCENERY_DAY] = {0.90f, 0.84f, 0.74f}, [SCENERY_NIGHT] = {0.020f, 0.026f, 0.042f}};

// A sign's light stands behind the front of its building, which casts no shadow.
#define SIGN_NEAR_M 1.05f

// A camera is exposed by night for the street under the lamps.
static const float lamp_exposures[] = {[SCENERY_DAY] = 1, [SCENERY_NIGHT] = 3};

// A lamp's light by day, and its cone.
static const struct lamp_light {
    float colour[3];
    float inner_deg, outer_deg;
} lamp_lights[] = {
    [CITY_STREET_LAMP] = {{56, 41, 22}, 45, 78},
    [CITY_HEADLIGHT] = {{46, 43, 38}, 2, 14},
    [CITY_TAIL_LIGHT] = {{2, 0.08f, 0.05f}, 30, 65},
    [CITY_SIGN] = {{21.5f, 21.5f, 21.5f}, 0, 80}, // times its tint
    [CITY_TRAFFIC_RED] = {{16, 0.8f, 0.5f}, 30, 55},
    [CITY_TRAFFIC_GREEN] = {{0.6f, 15, 6}, 30, 55},
};

enum { STREET_LAMPS_FIRST = 3, ANY_KIND = (1 << CITY_LAMP_KINDS) - 1 };

// The kinds of lamps 7 to 16: signs are many, and would otherwise take all places.
static const enum city_lamp_kind turns[] = {CITY_SIGN, CITY_TRAFFIC_RED, CITY_HEADLIGHT, CITY_SIGN,
                                            CITY_TRAFFIC_GREEN};
enum { KINDS_IN_TURN = sizeof(turns) / sizeof(turns[0]), TURNS = 10 };

static double squared_distance(const float a[3], const float b[3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        const double off = (double)a[c] - (double)b[c];
        sum += off * off;
    }
    return sum;
}

static int count_of(const struct scenery_lights_settings *s)
{
    const int usual = s->time == SCENERY_NIGHT ? SCENERY_MAX_LIGHTS : 1;
    return s->count == SCENERY_USUAL_LIGHTS ? usual : s->count;
}

// The sun is ahead of the thesis's two cameras, where drops are brightest against it.
static void add_sun(const struct scenery_lights_settings *s, struct rg_lights *lights)
{
    struct rg_light *sun = &lights->lights[lights->count++];
    *sun =
        (struct rg_light){.kind = SCENERY_SUN, .inner_deg = 30, .outer_deg = 45, .shadows = true};
    const double d[3] = {-0.05, -0.5, 0.85}, length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int c = 0; c < 3; c++)
        sun->direction[c] = (float)(d[c] / length);
    memcpy(sun->colour, sun_colours[s->time], sizeof(sun->colour));
}

// The lights chosen so far, and the lamp of each.
struct choice {
    struct rg_lights *lights;
    const struct city_lamp *lamps[SCENERY_MAX_LIGHTS];
};

static bool is_taken(const struct choice *choice, const struct city_lamp *lamp)
{
    for (int i = 0; i < choice->lights->count; i++)
        if (choice->lamps[i] == lamp)
            return true;
    return false;
}

// The nearest unused lamp of these kinds (bits), the first of equally near ones. NULL if there is
// none.
static const struct city_lamp *nearest_lamp(const struct scenery_lights_settings *s, unsigned kinds,
                                            const struct choice *choice)
{
    const struct city_lamp *nearest = NULL;
    for (int i = 0; i < s->lamp_count; i++) {
        const struct city_lamp *lamp = &s->lamps[i];
        if ((kinds >> lamp->kind & 1) && !is_taken(choice, lamp) &&
            (!nearest || squared_distance(lamp->position, s->about_m) <
                             squared_distance(nearest->position, s->about_m)))
            nearest = lamp;
    }
    return nearest;
}

static void add_lamp(const struct city_lamp *lamp, enum scenery_time time, struct choice *choice)
{
    const struct lamp_light *light = &lamp_lights[lamp->kind];
    struct rg_light *spot = &choice->lights->lights[choice->lights->count];
    choice->lamps[choice->lights->count++] = lamp;
    *spot = (struct rg_light){.kind = SCENERY_SPOT,
                              .inner_deg = light->inner_deg,
                              .outer_deg = light->outer_deg,
                              .near_m = lamp->kind == CITY_SIGN ? SIGN_NEAR_M : 0.3f,
                              .shadows = true};
    memcpy(spot->position_m, lamp->position, sizeof(spot->position_m));
    memcpy(spot->direction, lamp->direction, sizeof(spot->direction));
    for (int c = 0; c < 3; c++)
        spot->colour[c] = light->colour[c] * lamp_exposures[time];
    for (int c = 0; c < 3 && lamp->kind == CITY_SIGN; c++)
        spot->colour[c] *= lamp->tint[c];
}

static void add_lamps(const struct scenery_lights_settings *s, unsigned kinds, int most,
                      struct choice *choice)
{
    const struct city_lamp *lamp;
    for (int i = 0;
         i < most && choice->lights->count < count_of(s) && (lamp = nearest_lamp(s, kinds, choice));
         i++)
        add_lamp(lamp, s->time, choice);
}

static bool choose_preset(const struct scenery_lights_settings *s, struct rg_lights *lights)
{
    struct choice choice = {.lights = lights};
    *lights = (struct rg_lights){0};
    memcpy(lights->sky, sky_colours[s->time], sizeof(lights->sky));
    if (s->time == SCENERY_DAY && count_of(s) > 0)
        add_sun(s, lights);
    add_lamps(s, 1u << CITY_STREET_LAMP, STREET_LAMPS_FIRST, &choice);
    add_lamps(s, 1u << CITY_TRAFFIC_RED, 1, &choice);
    add_lamps(s, 1u << CITY_TRAFFIC_GREEN, 1, &choice);
    if (s->time == SCENERY_NIGHT && lights->count < count_of(s))
        add_sun(s, lights); // the moon
    for (int i = 0; i < TURNS; i++)
        add_lamps(s, 1u << turns[i % KINDS_IN_TURN], 1, &choice);
    add_lamps(s, ANY_KIND, SCENERY_MAX_LIGHTS, &choice);
    if (lights->count < s->count)
        return rg_error(
            "lights: %d asked for, but the scene has %d lamps and one light of the sky; "
            "ask for %d, or name a lights_file",
            s->count, s->lamp_count, lights->count);
    return true;
}

bool scenery_lights_choose(const struct scenery_lights_settings *s, struct rg_lights *lights)
{
    if (!s->file || !*s->file)
        return choose_preset(s, lights);
    return rg_light_file_read(s->file, lights);
}
