// The wind over a scene: the same everywhere at one time.
#ifndef RG_CORE_TECHNIQUES_CARTOON_RAIN_WIND_H
#define RG_CORE_TECHNIQUES_CARTOON_RAIN_WIND_H

#include <stdbool.h>
#include <stdint.h>

struct cartoon_rain_settings;

#define CARTOON_SOUND_M_S 340.0 // no wind is faster

enum { CARTOON_WIND_KNOTS = 256 };

// Where the wind blows to, counter-clockwise seen from above from +x, and how fast, at a time.
// Between two knots both change evenly; before the first and after the last they stay.
struct cartoon_wind_knot {
    double time_s, speed_m_s, turn_deg;
};
struct cartoon_wind_script {
    int count;
    struct cartoon_wind_knot knots[CARTOON_WIND_KNOTS];
};

// Reads lines of a time in seconds, a speed in m/s and a direction in degrees, in the order of
// time; what follows a # is a comment. False, and one logged line that names file and line, on
// failure.
bool cartoon_wind_read(const char *path, struct cartoon_wind_script *script);

// The wind's velocity along x and z at a time. Random wind is a function of the seed and the time
// alone; `script` is read by scripted wind.
void cartoon_wind_at(const struct cartoon_rain_settings *settings,
                     const struct cartoon_wind_script *script, uint32_t seed, double time_s,
                     double wind_m_s[2]);

#endif
