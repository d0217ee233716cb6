// For tests of overlays: small pictures to draw an overlay on, and cameras.
#ifndef RG_TESTS_CORE_TECHNIQUES_SCENERY_OVERLAY_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_SCENERY_OVERLAY_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "core/techniques/scenery/overlay.h"
#include "tests/core/techniques/rigs/scene.h"

enum { WIDTH = 160, HEIGHT = 90 };

struct picture {
    int width, height;
    struct rg_image *colour, *depth;
};

// An empty colour target, with the same depth everywhere.
struct picture picture_make(struct rg_device *device, enum rg_format format, float depth);
void picture_free(struct picture *p);
// Four floats a pixel; the caller frees them.
float *picture_read(const struct picture *p);

struct scenery_overlay *open_overlay(struct rg_device *device, struct rg_instance *instance);
void close_overlay(struct scenery_overlay *overlay, struct rg_instance *instance);

// The matrix of a camera at (0, 2, 6) that looks at the origin with an angle of 60 degrees. The far
// plane is at 50, and the near plane at 0.5 or at `near_plane`.
void overlay_look(float to_clip[16]);
void overlay_look_from(float near_plane, float to_clip[16]);

// A number from `low` to `high`, chosen by item and step.
float between(uint32_t item, uint32_t step, double low, double high);

#endif
