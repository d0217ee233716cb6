// The background and surroundings of the pane, blurred as by a lens focused on the pane. A distant
// point becomes a disc with the aperture's angle as seen from the pane.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/image/disc.h"
#include "core/image/files/io.h"
#include "core/techniques/drops/instance.h"
#include "core/techniques/scenery/environment.h"
#include "kernels/dialect/image/format.h"
#include "kernels/dialect/math.h"

enum { LARGEST_PX = 4096, WIDE_TEXELS = 24, CHANNELS = 4, LEAST_LEVEL_PX = 4 };

// The angle that the lens takes in, as seen from the pane, which no C library rounds in its own
// way.
static double angle_of(double aperture_mm, double distance_mm)
{
    return 2 * (double)rg_atan2((float)aperture_mm / 2, (float)distance_mm);
}

static void add_environment(struct rg_instance *instance, const struct drops_settings *s)
{
    int levels = 1;
    while (s->environment_px >> levels >= LEAST_LEVEL_PX)
        levels++;
    scenery_add_environment(instance,
                            &(struct scenery_around){s->environment, s->environment_px, levels,
                                                     angle_of(s->aperture_mm, s->distance_mm)});
}

// --- the background ---

// Packs a texel for upload; clamps light to finite values of at least 0.
static void pack_texel(const struct rg_picture *p, const float *texel, uint16_t *halves)
{
    for (int c = 0; c < 3; c++) {
        const float light = texel[p->channels < 3 ? 0 : c];
        halves[c] = (uint16_t)rg_pack_half(light > 0 ? light : 0);
    }
    halves[3] = (uint16_t)rg_pack_half(1);
}

static bool write_level(const struct rg_picture *p, struct rg_image *image, int level)
{
    const int64_t texels = (int64_t)p->width * p->height;
    uint16_t *halves = rg_alloc((size_t)texels, CHANNELS * sizeof(*halves), "background");
    for (int64_t i = 0; halves && i < texels; i++)
        pack_texel(p, p->texels + i * p->channels, halves + i * CHANNELS);
    const bool ok = halves && rg_image_write(image, 0, level, halves);
    free(halves);
    return ok;
}

static int levels_of(const struct rg_picture *p)
{
    int levels = 1;
    while ((p->width > p->height ? p->width : p->height) >> levels)
        levels++;
    return levels;
}

// Uploads a picture with all its levels; it is halved on the way.
static struct rg_image *upload(struct rg_picture *p, struct rg_device *device)
{
    const struct rg_image_desc desc = {RG_RGBA16F, p->width, p->height, 1, levels_of(p)};
    struct rg_image *image = rg_image_create(device, &desc, "background");
    bool ok = image;
    for (int level = 0; ok && level < desc.levels; level++)
        ok = (!level || rg_picture_halve(p)) && write_level(p, image, level);
    if (ok)
        return image;
    rg_image_destroy(image);
    return NULL;
}

// The diameter in texels of the disc that a background's point becomes.
static double disc_px(const struct drops_settings *s, const struct rg_picture *p)
{
    const double wide = 2 * tan(s->background_deg * M_PI / 360); // at distance 1
    return s->aperture_mm / s->distance_mm * p->width / wide;
}

// Blurs the background, first halving a large one, which needs fewer texels then.
static bool defocus(const struct drops_settings *s, struct rg_picture *p)
{
    while (p->width > LARGEST_PX || p->height > LARGEST_PX ||
           (disc_px(s, p) > WIDE_TEXELS && p->width > 1 && p->height > 1))
        if (!rg_picture_halve(p))
            return false;
    return disc_px(s, p) <= 1 || rg_picture_blur(p, disc_px(s, p));
}

static struct rg_image *load_background(const struct drops_settings *s, struct rg_device *device)
{
    struct rg_picture picture;
    if (!rg_picture_read(s->background, &picture))
        return NULL;
    struct rg_image *image = defocus(s, &picture) ? upload(&picture, device) : NULL;
    rg_picture_destroy(&picture);
    return image;
}

void drops_add_outside(struct drops *d)
{
    struct rg_instance *instance = &d->base;
    const struct drops_settings *s = &d->settings;
    add_environment(instance, s);
    d->background = s->background[0] ? rg_give_image(instance, "background",
                                                     load_background(s, instance->device))
                                     : rg_add_image(instance, "background", RG_RGBA16F, 1, 1);
}
