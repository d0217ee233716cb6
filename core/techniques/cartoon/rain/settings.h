// The settings of cartoon's rain, a part of the technique's.
#ifndef RG_CORE_TECHNIQUES_CARTOON_RAIN_SETTINGS_H
#define RG_CORE_TECHNIQUES_CARTOON_RAIN_SETTINGS_H

#include "core/techniques/params.h"

enum cartoon_wind_kind { CARTOON_WIND_CONSTANT, CARTOON_WIND_RANDOM, CARTOON_WIND_SCRIPT };
enum cartoon_query { CARTOON_QUERY_DISCS, CARTOON_QUERY_SPHERES, CARTOON_QUERY_API };
enum cartoon_answers { CARTOON_ANSWERS_NOW, CARTOON_ANSWERS_LATE };

// Accumulated water: the heaviest drop's volume, and the drying and spreading of water.
struct cartoon_water_settings {
    int on;
    double drop_m3, dry_s, spread_m2_s, from_m;
};

struct cartoon_rain_settings {
    int drops_s, steps_s;
    // The start and the fall of drops.
    double top_m, speed_m_s, spread_deg, gravity_m_s2;
    int drag; // CARTOON_DRAG_*
    double drag_m_s2, drag_1_m;
    // The wind.
    int wind; // enum cartoon_wind_kind
    double wind_m_s, wind_turn_deg, wind_s, gust, gust_s;
    char wind_script[RG_PATH_SIZE];
    // Collisions.
    int collide, query, answers; // CARTOON_COLLIDE_*, enum cartoon_query, enum cartoon_answers
    int least_samples;
    double bound_m, precision_m;
    // Pictures.
    double drop_m, splash_m, fade_s, splash_s;
    int cut;
};

#endif
