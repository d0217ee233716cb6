#include "tests/core/techniques/cartoon/rain/rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "backends/formats.h"
#include "tests/tools/instance.h"

struct cartoon *rig_open(struct rg_device *device, const char *assignments, int width, int height)
{
    return (struct cartoon *)instance_of(device, "cartoon", "", assignments, width, height);
}

void rig_close(struct cartoon *c)
{
    rg_instance_close(&c->base);
}

void rig_step(struct cartoon *c, int steps)
{
    for (int i = 0; i < steps; i++)
        assert_true(c->base.technique->step(&c->base));
}

void *rig_words(struct cartoon *c, const char *name)
{
    return asset_words(&c->base, name);
}

void *rig_texels(struct cartoon *c, const char *name, int layer, int level)
{
    const struct rg_asset *asset = rg_asset_find(&c->base, name);
    assert_non_null(asset);
    const struct rg_image_desc *desc = &asset->image->desc;
    const size_t count = (size_t)(desc->width >> level) * (size_t)(desc->height >> level);
    void *texels = malloc(count * (size_t)rg_format_size(desc->format));
    assert_non_null(texels);
    assert_true(rg_image_read(asset->image, layer, level, texels));
    return texels;
}

uint32_t rig_tally(struct cartoon *c, int word)
{
    uint32_t value;
    assert_true(rg_buf_read(c->rain.tally->buf, word * 4, &value, sizeof(value)));
    return value;
}

struct rig_rain rig_look(struct cartoon *c)
{
    return (struct rig_rain){rig_words(c, "raindrops"),
                             rig_words(c, "sprays"),
                             rig_words(c, "living"),
                             rig_words(c, "counts"),
                             c->rain.params.drop_slots,
                             c->rain.params.spray_slots,
                             c->rain.drops};
}

void rig_free(struct rig_rain *rain)
{
    free(rain->drops);
    free(rain->sprays);
    free(rain->living);
    free(rain->counts);
}

int rig_living(struct cartoon *c)
{
    const int slots = c->rain.params.drop_slots, released = c->rain.params.released;
    uint32_t unused;
    assert_true(rg_buf_read(c->rain.before->buf, slots * 4, &unused, sizeof(unused)));
    return slots - (int)unused + (released < (int)unused ? released : (int)unused);
}

struct rainfall_vector rig_place(const cartoon_raindrop *d)
{
    return (struct rainfall_vector){(double)d->x, (double)d->y, (double)d->z};
}

struct rainfall_vector rig_velocity(const cartoon_raindrop *d)
{
    return (struct rainfall_vector){(double)d->vx, (double)d->vy, (double)d->vz};
}

struct rainfall_vector rig_next_place(const struct cartoon *c, const cartoon_raindrop *d)
{
    return rainfall_sum(rig_place(d), rig_velocity(d), 1.0 / c->settings.rain.steps_s);
}

struct rainfall_eye rig_eye(struct cartoon *c)
{
    const struct rg_camera *camera = &c->view.camera;
    double position[3], target[3];
    for (int i = 0; i < 3; i++) {
        position[i] = (double)camera->position[i];
        target[i] = (double)camera->target[i];
    }
    struct rainfall_eye eye = rainfall_eye_of(
        position, target, (double)camera->angle_deg, (double)camera->near_plane,
        (double)camera->far_plane, c->base.target->desc.width, c->base.target->desc.height);
    eye.depth = rig_texels(c, "depth_map", 0, 0);
    return eye;
}

double rig_bound_m(const struct cartoon *c, double distance_m)
{
    const double focal_px = (double)c->rain.params.focal_px;
    return fmin((double)c->rain.params.bound_m, 16 / focal_px * distance_m);
}

void rig_each_step(struct rg_device *device, const char *settings, int size_px, int from, int to,
                   void (*look)(const struct rig_change *s, void *user), void *user)
{
    struct cartoon *c = rig_open(device, settings, size_px, size_px);
    rig_step(c, from);
    for (int i = from; i < to; i++) {
        struct rig_change s = {.c = c, .was = rig_look(c), .eye_was = rig_eye(c)};
        rig_step(c, 1);
        s.is = rig_look(c);
        s.eye = rig_eye(c);
        look(&s, user);
        rig_free(&s.was);
        rig_free(&s.is);
        free((void *)s.eye_was.depth);
        free((void *)s.eye.depth);
    }
    rig_close(c);
}

bool rig_fell(const struct rig_change *s, int slot)
{
    const cartoon_raindrop *was = &s->was.drops[slot], *is = &s->is.drops[slot];
    return was->state == CARTOON_DROP && is->number == was->number &&
           (is->state == CARTOON_DROP || is->state == CARTOON_COLLISION);
}

void rig_expect_on_way(const struct rig_change *s, int slot)
{
    const struct rainfall_vector old = rig_place(&s->was.drops[slot]);
    const struct rainfall_vector now = rig_next_place(s->c, &s->was.drops[slot]);
    const struct rainfall_vector way = rainfall_sum(now, old, -1);
    const struct rainfall_vector to = rainfall_sum(rig_place(&s->is.drops[slot]), old, -1);
    const double along = rainfall_dot(to, way) / rainfall_dot(way, way);
    rig_expect("distance of a hit from its way", rainfall_length(rainfall_sum(to, way, -along)), 0,
               1e-5);
    if (!(along > 0 && along < 1 + 1e-5))
        fail_msg("a hit at %.6g of its way", along);
}

int rig_hits(struct cartoon *c)
{
    uint32_t hits = 0;
    if (c->rain.drops)
        assert_true(rg_buf_read(c->rain.hits_before->buf, c->rain.drops * 4, &hits, sizeof(hits)));
    return (int)hits;
}

double rig_half(uint16_t half)
{
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    const double size = exponent ? ldexp(1024 + fraction, exponent - 25) : ldexp(fraction, -24);
    return half & 0x8000 ? -size : size;
}

void rig_expect(const char *what, double found, double due, double within)
{
    if (!(fabs(found - due) <= within))
        fail_msg("%s: %.9g is not %.9g within %.3g", what, found, due, within);
}
