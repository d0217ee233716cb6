// Opened streaks: open.c makes the struct, and streaks.c runs it.
#ifndef RG_CORE_TECHNIQUES_STREAKS_INSTANCE_H
#define RG_CORE_TECHNIQUES_STREAKS_INSTANCE_H

#include "core/scene/spectrum.h"
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
    STREAKS_PARTICLES, // particles in selected packets
    STREAKS_PACKETS,   // packets selected
    STREAKS_ITEMS,     // particles drawn, including padding of blocks
    STREAKS_COUNTERS
};

enum streaks_pass { STREAKS_RAIN, STREAKS_MARKS, STREAKS_STATES, STREAKS_FAR, STREAKS_PASS_COUNT };

enum { STREAKS_MAX_BUFFERS = 64 };

// The scene's depth map along the fall.
struct streaks_map {
    struct rg_image *depths;  // D32F
    struct rg_image *numbers; // RGBA8: surface numbers, of the same size; one texel if unused
};

// Particles and their packets, shared by instances with the same rain on one device.
struct streaks_rain {
    struct streaks_packets *packets;
    int buffer_count;
    struct rg_buf *particles[STREAKS_MAX_BUFFERS];
};

enum { STREAKS_SIZES = 512 };

// The sizes of drops: one class, or STREAKS_SIZES equally frequent ones.
struct streaks_sizes {
    int count;
    double drops_m3;             // drops kept, where the density map is white
    struct rg_spectrum spectrum; // of classes, and its totals
    struct rg_rainfall rainfall;
    double speeds_m_s[STREAKS_SIZES];
    double largest_m, fastest_m_s;                   // the largest radius and the highest speed
    float words[STREAKS_SIZES * STREAKS_SIZE_WORDS]; // kernels/streaks/size.h
};

struct streaks {
    struct rg_instance base;
    struct streaks_settings settings;
    struct rg_rain_space space;
    const struct streaks_rain *rain;
    struct scenery *scene;
    struct rg_layer layer; // of all that falls, and of marks
    struct streaks_textures *textures;
    struct scenery_lights *lights;
    struct scenery_overlay *overlay; // NULL: none
    struct rg_image *density;        // the density map, D32F; NULL: unused
    struct rg_camera camera;         // at frame 0
    struct streaks_map *map;         // the scene's depth map along the fall
    struct streaks_sizes sizes;
    double mean_density; // of the density map
    double drops_m3;     // at the camera's place at frame 0
    double fit_error;    // the error found by fit=on
    int first_stage;     // of enum streaks_pass, after the scene's stages
    bool rain_alone;     // draws rain only, for the search of fit=on
    // Assets whose buffers change: the current draw's particles, and lists that grow.
    struct rg_asset *particles_now, *blocks, *places;
    struct rg_fact *particles_told; // NULL: not told yet
    // of the current frame
    struct streaks_observer observer;
    struct streaks_observer outside; // the second camera, unless outside=off
    struct streaks_selection selection;
    streaks_params params;
    int64_t map_due; // the frame in which a dynamic depth map is next redrawn
    // Parameters of the current stage.
    streaks_params of_rain;
    streaks_far_params of_far;
};

bool streaks_open(struct rg_instance *instance);
void streaks_close(struct rg_instance *instance);

// Replaces the particles by those of the current settings. False, and one logged line, on failure.
bool streaks_make_particles(struct streaks *streaks);
void streaks_free_particles(struct streaks *streaks);
// The density map of the settings, which the caller destroys. NULL, and one logged line, on
// failure.
struct rg_density *streaks_density(const struct streaks *streaks);

// Makes the size classes of the settings' drops. False, and one logged line, on failure.
bool streaks_sizes_make(struct streaks *streaks);
// Whether a spectrum's classes can be distinguished; if not, one line with the numbers is logged.
bool streaks_sizes_fit(const struct streaks *streaks, const struct rg_density *density);
bool streaks_sizes_differ(const struct streaks *streaks);
// Drops of one size with the same mean and variance of coverage as all classes together.
struct streaks_equivalent {
    double radius_m, speed_m_s, drops_m3;
};
struct streaks_equivalent streaks_sizes_equivalent(const struct streaks *streaks);
// Moves the size classes to the current frame, in a local space with this top.
void streaks_sizes_turn(struct streaks *streaks, double top_m);
// Tells the rain's rate and extinction as facts, and of a spectrum what is left out.
void streaks_sizes_tell(struct streaks *streaks);
double streaks_swings_a_second(double radius_m); // of a drop

// Moves the observer to the current frame, and prepares drawing: the selection, its blocks, the
// parameters, and the depth map where it is due. False, and one logged line, on failure.
bool streaks_look(struct streaks *streaks);
// Selects the packets that an eye in the rain frame sees, in a local space with this top. If one
// draw suffices, uploads its blocks. False, and one logged line, on failure.
bool streaks_select_blocks(struct streaks *streaks, const double eye[3], double top_m);
// Uploads a draw's blocks.
bool streaks_write_blocks(struct streaks *streaks, const struct streaks_draw *draw);
// Opens the depth map; a static one is drawn by the first instance. False, and one logged line, on
// failure. streaks_map_close accepts a map that was never opened.
bool streaks_map_open(struct streaks *streaks);
void streaks_map_close(struct streaks *streaks);
// Redraws a dynamic map around the observer where it is due.
bool streaks_map_renew(struct streaks *streaks);
// Draws the layers of distant rain, farthest first.
bool streaks_draw_far(struct streaks *streaks);
// Uploads the density map as a texture, for distant rain and the view from outside. False, and one
// logged line, on failure.
bool streaks_density_open(struct streaks *streaks);
// Draws the overlay of the current frame.
bool streaks_show(struct streaks *streaks);

// --- the view from outside ---

// The viewer of the picture: the observer, or the second camera.
const struct streaks_observer *streaks_viewer(const struct streaks *streaks);
// Prepares the additional parts of the view from outside. False, and one logged line, on failure.
// streaks_outside_close accepts a view that was never opened.
bool streaks_outside_open(struct streaks *streaks);
void streaks_outside_close(struct streaks *streaks);
// 1 over the distance, in metres, of the ground from the camera whose frustum the rain space is; 0
// if it is a box.
double streaks_narrowing(const struct streaks *streaks);
// Converts a point of the rain space as a box to the world, where the space may be a frustum.
void streaks_world_point(const struct streaks *streaks, const double rain[3], double world[3]);
// Points the second camera at its target in the current frame. False, and one logged line, on
// failure.
bool streaks_outside_look(struct streaks *streaks);
// Changes the rain's parameters so that particles are drawn as marks.
void streaks_outside_marks(const struct streaks *streaks, streaks_params *params);
// Draws the map above the rain.
bool streaks_outside_map(struct streaks *streaks);

#endif
