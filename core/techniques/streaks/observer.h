// The place and view of streaks's observer.
#ifndef RG_CORE_TECHNIQUES_STREAKS_OBSERVER_H
#define RG_CORE_TECHNIQUES_STREAKS_OBSERVER_H

#include <stdint.h>

#include "core/scene/camera.h"
#include "core/techniques/streaks/streaks.h"

struct streaks_observer {
    struct rg_camera camera; // in the world, in metres
    float world_to_clip[16];
    float rays[16]; // from (px, py, 1) to the ray through a pixel's centre, in the world
    float focal_px; // pixels per metre at a distance of one metre
};

// The view of a camera that walks as the settings say, at a frame, for a target of width x height
// pixels. False, and one logged line, where the camera cannot see or is below the ground.
bool streaks_observer_at(const struct streaks_settings *settings, const struct rg_camera *camera,
                         int width, int height, int64_t frame, struct streaks_observer *observer);

// The same for a camera that stands still at any place.
bool streaks_observer_of(const struct rg_camera *camera, int width, int height,
                         struct streaks_observer *observer);

#endif
