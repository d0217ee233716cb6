// The wind over a scene, uniform at any time.
#ifndef RG_CORE_TECHNIQUES_CARTOON_RAIN_WIND_H
#define RG_CORE_TECHNIQUES_CARTOON_RAIN_WIND_H

#include <stdbool.h>
#include <stdint.h>

struct cartoon_rain_settings;

#define CARTOON_SOUND_M_S 340.0 // the largest wind speed

enum { CARTOON_WIND_KNOTS = 256 };

// A wind's direction and speed at a time. The direction is where it blows to, counter-clockwise
// from +x seen from above. Between two knots both are interpolated; before the first and after the
// last they are constant.
struct cartoon_wind_knot {
    double time_s, speed_m_s, turn_deg;
};
struct cartoon_wind_script {
    int count;
    struct cartoon_wind_knot knots[CARTOON_WIND_KNOTS];
};

// Reads lines of a time in seconds, a speed in m/s and a direction in degrees, in order of time; a
// # begins a comment. False, and one logged line that names file and line, on failure.
bool cartoon_wind_read(const char *path, struct cartoon_wind_script *script);

// The wind's velocity along x and z at a time. Random wind depends on seed and time only; scripted
// wind reads `script`.
void cartoon_wind_at(const struct cartoon_rain_settings *settings,
                     const struct cartoon_wind_script *script, uint32_t seed, double time_s,
                     double wind_m_s[2]);

#endif
