#include "core/techniques/cartoon/rain/wind.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/techniques/cartoon/rain/settings.h"
#include "kernels/cartoon/rain/params.h"
#include "kernels/dialect/rng.h"

#define GUST_TURN_DEG 40.0 // the angle by which a gust of 1 turns the wind
#define FARTHEST      1e6  // seconds and degrees; within this, cosines and quotients stay finite

// --- scripts ---

// Parses a line: a knot, or nothing if it is blank or a comment.
static bool take_line(const char *path, int line, char *text, struct cartoon_wind_script *script)
{
    struct cartoon_wind_knot knot;
    char rest;
    text[strcspn(text, "#\n")] = 0;
    if (!text[strspn(text, " \t\r")])
        return true;
    if (sscanf(text, "%lf %lf %lf %c", &knot.time_s, &knot.speed_m_s, &knot.turn_deg, &rest) != 3)
        return rg_error("%s:%d: no wind; write seconds, m/s and degrees, such as '2.5 8 90'", path,
                        line);
    if (!(fabs(knot.speed_m_s) <= CARTOON_SOUND_M_S))
        return rg_error("%s:%d: a wind of %g m/s; sound has %g, choose less", path, line,
                        knot.speed_m_s, CARTOON_SOUND_M_S);
    if (!(fabs(knot.time_s) <= FARTHEST && fabs(knot.turn_deg) <= FARTHEST))
        return rg_error("%s:%d: %g s, %g degrees; both lie within %g of 0", path, line, knot.time_s,
                        knot.turn_deg, FARTHEST);
    if (script->count && !(knot.time_s > script->knots[script->count - 1].time_s))
        return rg_error("%s:%d: %g s does not follow %g s; put lines in the order of time", path,
                        line, knot.time_s, script->knots[script->count - 1].time_s);
    if (script->count == CARTOON_WIND_KNOTS)
        return rg_error("%s:%d: one line too many; %d is the most", path, line, CARTOON_WIND_KNOTS);
    script->knots[script->count++] = knot;
    return true;
}

// Skips the rest of a line after `text`. False if that is no comment, or if the text holds a zero,
// so that the rest is unknown.
static bool skip_rest(const char *text, FILE *in)
{
    if (strchr(text, '\n'))
        return true;
    int c = fgetc(in);
    const bool ok = c == EOF || strchr(text, '#') != NULL;
    while (c != '\n' && c != EOF)
        c = fgetc(in);
    return ok;
}

bool cartoon_wind_read(const char *path, struct cartoon_wind_script *script)
{
    char text[256];
    bool ok = true;
    script->count = 0;
    if (!path[0])
        return rg_error("wind_script: wind=script reads a file; name one (docs/cartoon.md)");
    const char *why;
    FILE *in = rg_file_open_small(path, &why);
    if (!in)
        return rg_system_error(errno, "%s: %s; name a file of winds (docs/cartoon.md)", path, why);
    for (int line = 1; ok && fgets(text, sizeof(text), in); line++)
        ok =
            skip_rest(text, in)
                ? take_line(path, line, text, script)
                : rg_error("%s:%d: more than %zu bytes, or no text; write lines such as '2.5 8 90'",
                           path, line, sizeof(text) - 2);
    if (ok && ferror(in))
        ok = rg_system_error(errno, "%s: %s; name a file of winds (docs/cartoon.md)", path,
                             strerror(errno));
    else if (ok && !script->count)
        ok = rg_error("%s: no wind in it; write lines such as '2.5 8 90'", path);
    fclose(in);
    return ok;
}

static struct cartoon_wind_knot script_at(const struct cartoon_wind_script *script, double time_s)
{
    int next = 0;
    while (next < script->count && script->knots[next].time_s <= time_s)
        next++;
    if (next == 0 || next == script->count)
        return script->knots[next ? next - 1 : 0];
    const struct cartoon_wind_knot *a = &script->knots[next - 1], *b = a + 1;
    const double t = (time_s - a->time_s) / (b->time_s - a->time_s);
    return (struct cartoon_wind_knot){time_s, a->speed_m_s + (b->speed_m_s - a->speed_m_s) * t,
                                      a->turn_deg + (b->turn_deg - a->turn_deg) * t};
}

// --- chance ---

static double chance_at(uint32_t seed, int64_t knot, uint32_t stream)
{
    return 2 * (double)rg_uniform(rg_random(seed, (uint32_t)knot, 0, stream).x) - 1;
}

// Smooth noise of -1 to 1, between one random number a period.
static double noise_at(uint32_t seed, uint32_t stream, double periods)
{
    const double knot = floor(periods), t = periods - knot, smooth = t * t * (3 - 2 * t);
    const double a = chance_at(seed, (int64_t)knot, stream);
    return a + (chance_at(seed, (int64_t)knot + 1, stream) - a) * smooth;
}

void cartoon_wind_at(const struct cartoon_rain_settings *settings,
                     const struct cartoon_wind_script *script, uint32_t seed, double time_s,
                     double wind_m_s[2])
{
    struct cartoon_wind_knot wind = {time_s, settings->wind_m_s, settings->wind_turn_deg};
    if (settings->wind == CARTOON_WIND_SCRIPT)
        wind = script_at(script, time_s);
    if (settings->wind == CARTOON_WIND_RANDOM) {
        const double periods = time_s / settings->gust_s;
        wind.speed_m_s *= 1 + settings->gust * noise_at(seed, CARTOON_GUST, periods);
        wind.turn_deg += GUST_TURN_DEG * settings->gust * noise_at(seed, CARTOON_GUST_WAY, periods);
    }
    wind_m_s[0] = wind.speed_m_s * cos(wind.turn_deg * M_PI / 180);
    wind_m_s[1] = -wind.speed_m_s * sin(wind.turn_deg * M_PI / 180);
}
