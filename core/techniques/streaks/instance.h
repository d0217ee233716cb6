// Open streaks: what open.c makes, and streaks.c runs.
#ifndef RG_CORE_TECHNIQUES_STREAKS_INSTANCE_H
#define RG_CORE_TECHNIQUES_STREAKS_INSTANCE_H

#include "core/techniques/scenery/lights/lights.h"
#include "core/techniques/scenery/overlay.h"
#include "core/techniques/scenery/scenery.h"
#include "core/techniques/streaks/observer.h"
#include "core/techniques/streaks/packets/packets.h"
#include "core/techniques/streaks/streaks.h"
#include "core/techniques/streaks/textures.h"
#include "core/techniques/technique.h"
#include "kernels/streaks/far/params.h"
#include "kernels/streaks/params.h"
#include "kernels/streaks/size.h"

enum streaks_counter {
    STREAKS_PARTICLES, // that selected packets held
    STREAKS_PACKETS,   // that were selected
    STREAKS_ITEMS,     // particles drawn, with what fills up blocks
    STREAKS_COUNTERS
};

enum streaks_pass { STREAKS_RAIN, STREAKS_MARKS, STREAKS_STATES, STREAKS_FAR, STREAKS_PASS_COUNT };

enum { STREAKS_MAX_BUFFERS = 64 };

// The scene seen along the fall.
struct streaks_map {
    struct rg_image *depths;  // D32F
    struct rg_image *numbers; // RGBA8: of surfaces, of the same size; one texel if nobody asks
};

// Particles in their packets, which instances on a device whose rain is the same share.
struct streaks_rain {
    struct streaks_packets *packets;
    int buffer_count;
    struct rg_buf *particles[STREAKS_MAX_BUFFERS];
};

enum { STREAKS_SIZES = 512 };

// The sizes of drops: one class, or STREAKS_SIZES that are equally frequent.
struct streaks_sizes {
    int count;
    double drops_m3; // that are kept, where the density map is white
    double speeds_m_s[STREAKS_SIZES];
    double largest_m, fastest_m_s;                   // radius and speed of those that are most so
    float words[STREAKS_SIZES * STREAKS_SIZE_WORDS]; // kernels/streaks/size.h
};

struct streaks {
    struct rg_instance base;
    struct streaks_settings settings;
    struct rg_rain_space space;
    const struct streaks_rain *rain;
    struct scenery *scene;
    struct streaks_textures *textures;
    struct scenery_lights *lights;
    struct scenery_overlay *overlay; // NULL: none
    struct rg_image *density;        // the density map, D32F; NULL: nobody asks
    struct rg_camera camera;         // at frame 0
    struct streaks_map *map;         // the scene seen along the fall
    struct streaks_sizes sizes;
    double mean_density; // of the density map
    double drops_m3;     // where the camera stands at frame 0
    double fit_error;    // that fit=on found
    int first_stage;     // of enum streaks_pass, behind those of the scene
    bool rain_alone;     // nothing but rain is drawn, for the search of fit=on
    // Assets whose buffers change: another buffer of particles for each draw, and lists that grow.
    struct rg_asset *particles_now, *blocks, *places;
    struct rg_fact *particles_told; // NULL: not yet
    // of the present frame
    struct streaks_observer observer;
    struct streaks_observer outside; // the second camera, with outside=space or volume
    struct streaks_selection selection;
    streaks_params params;
    int64_t map_due; // the frame in which a dynamic depth map is drawn anew
    // Of the present stage.
    streaks_params of_rain;
    streaks_far_params of_far;
};

bool streaks_open(struct rg_instance *instance);
void streaks_close(struct rg_instance *instance);

// Makes the particles of the settings as they are now, in place of those there were. False, and one
// logged line, on failure.
bool streaks_make_particles(struct streaks *streaks);
void streaks_free_particles(struct streaks *streaks);
// The density map of the settings, which the caller destroys. NULL, and one logged line, on
// failure.
struct rg_density *streaks_density(const struct streaks *streaks);

// Makes the classes of the settings' drops. False, and one logged line, on failure.
bool streaks_sizes_make(struct streaks *streaks);
// Whether the drops of a spectrum can be told apart; else one line with the numbers is logged.
bool streaks_sizes_fit(const struct streaks *streaks, const struct rg_density *density);
bool streaks_sizes_differ(const struct streaks *streaks);
// Drops of one size that cover as much of a view as those of all classes, and vary as much.
struct streaks_alike {
    double radius_m, speed_m_s, drops_m3;
};
struct streaks_alike streaks_sizes_alike(const struct streaks *streaks);
// Moves the classes to the present frame, in a local space with this top.
void streaks_sizes_turn(struct streaks *streaks, double top_m);
// Tells the rain that a spectrum's particles make, and what is left out.
void streaks_sizes_tell(struct streaks *streaks);
double streaks_swings_a_second(double radius_m); // of a drop

// Moves the observer to the present frame, and makes what it draws: the selection, its blocks, the
// parameters, the depth map where it is due. False, and one logged line, on failure.
bool streaks_look(struct streaks *streaks);
// Selects what an eye in the rain frame sees of a local space with this top. If one draw takes it
// all, its blocks go to the device. False, and one logged line, on failure.
bool streaks_select_blocks(struct streaks *streaks, const double eye[3], double top_m);
// Puts a draw's blocks on the device.
bool streaks_write_blocks(struct streaks *streaks, const struct streaks_draw *draw);
// Opens the depth map; the first instance draws a static one. False, and one logged line, on
// failure. streaks_map_close accepts what was never opened.
bool streaks_map_open(struct streaks *streaks);
void streaks_map_close(struct streaks *streaks);
// Draws a dynamic map around the observer where it is due.
bool streaks_map_renew(struct streaks *streaks);
// Draws the layers of rain far away, farthest first.
bool streaks_draw_far(struct streaks *streaks);
// The density map as a texture, for far rain and for the view from outside. False, and one logged
// line, on failure.
bool streaks_density_open(struct streaks *streaks);
// Draws the overlay of the present frame.
bool streaks_show(struct streaks *streaks);

// --- the view from outside ---

// Who sees the picture: the observer, or the second camera.
const struct streaks_observer *streaks_viewer(const struct streaks *streaks);
// Makes what the view from outside shows of its own. False, and one logged line, on failure.
// streaks_outside_close accepts what was never opened.
bool streaks_outside_open(struct streaks *streaks);
void streaks_outside_close(struct streaks *streaks);
// Points the second camera at what it looks at, in the present frame. False, and one logged line,
// on failure.
bool streaks_outside_look(struct streaks *streaks);
// What the rain's parameters are for its marks.
void streaks_outside_marks(const struct streaks *streaks, streaks_params *params);
// Draws the map that lies over the rain.
bool streaks_outside_map(struct streaks *streaks);

#endif
