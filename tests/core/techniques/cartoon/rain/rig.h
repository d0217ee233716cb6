// For tests of cartoon's rain: an instance with settings as text, the contents of its buffers, and
// its camera in the oracle's form.
#ifndef RG_TESTS_CORE_TECHNIQUES_CARTOON_RAIN_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_CARTOON_RAIN_RIG_H

#include "core/techniques/cartoon/instance.h"
#include "tests/oracle/rainfall.h"

// Opens cartoon with these "key=value key=value" over its defaults; fails the test otherwise.
struct cartoon *rig_open(struct rg_device *device, const char *assignments, int width, int height);
void rig_close(struct cartoon *c);
void rig_step(struct cartoon *c, int steps);

// All words of a buffer, or all texels of a layer of an image's level; the caller frees them.
void *rig_words(struct cartoon *c, const char *name);
void *rig_texels(struct cartoon *c, const char *name, int layer, int level);
uint32_t rig_tally(struct cartoon *c, int word);

// A snapshot of the rain; the caller frees its arrays.
struct rig_rain {
    cartoon_raindrop *drops;
    cartoon_spray *sprays;
    uint32_t *living;
    uint32_t *counts;
    int drop_slots, spray_slots;
    int listed; // drops in the living list
};
struct rig_rain rig_look(struct cartoon *c);
void rig_free(struct rig_rain *rain);
// Drops in the active list of the last step.
int rig_living(struct cartoon *c);

struct rainfall_vector rig_place(const cartoon_raindrop *d);
struct rainfall_vector rig_velocity(const cartoon_raindrop *d);
// The place of a falling drop after a step.
struct rainfall_vector rig_next_place(const struct cartoon *c, const cartoon_raindrop *d);
// The camera of this frame. Its depths are the depth map's; the caller frees them.
struct rainfall_eye rig_eye(struct cartoon *c);

// The rain and the camera before and after a step.
struct rig_change {
    struct cartoon *c;
    struct rig_rain was, is;
    struct rainfall_eye eye_was, eye;
};
// Opens cartoon on a square picture, and calls `look` for each step after the first `from`, up to
// `to`.
void rig_each_step(struct rg_device *device, const char *settings, int size_px, int from, int to,
                   void (*look)(const struct rig_change *s, void *user), void *user);
// Whether a drop fell during a whole step, and may have hit in it.
bool rig_fell(const struct rig_change *s, int slot);
// The radius of a drop's bounding sphere.
double rig_bound_m(const struct cartoon *c, double distance_m);
// Fails the test unless a drop that has hit is on its path of this step.
void rig_expect_on_way(const struct rig_change *s, int slot);

// Hits of the last step.
int rig_hits(struct cartoon *c);
// The value of a half.
double rig_half(uint16_t half);

// Fails the test unless a number is within `within` of `due`.
void rig_expect(const char *what, double found, double due, double within);

#endif
