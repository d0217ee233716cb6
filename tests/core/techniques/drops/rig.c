#include "tests/core/techniques/drops/rig.h"

#include "tests/tools/instance.h"

struct drops *rig_open_sized(struct rg_device *device, const char *assignments, int width,
                             int height)
{
    return (struct drops *)instance_of(device, "drops", "trail=hemispheres", assignments, width,
                                       height);
}

struct drops *rig_open(struct rg_device *device, const char *assignments)
{
    return (struct drops *)instance_of(device, "drops", "view=height trail=hemispheres",
                                       assignments, 32, 32);
}

void rig_close(struct drops *d)
{
    rg_instance_close(&d->base);
}

void rig_step(struct drops *d, int steps)
{
    for (int i = 0; i < steps; i++)
        assert_true(d->base.technique->step(&d->base));
}

void *rig_words(struct drops *d, const char *name)
{
    return asset_words(&d->base, name);
}

uint32_t rig_tally(struct drops *d, int word)
{
    uint32_t value;
    assert_true(rg_buf_read(d->tally->buf, word * 4, &value, sizeof(value)));
    return value;
}

drops_drop *rig_drops(struct drops *d, int *count)
{
    *count = (int)rig_tally(d, DROPS_COUNT);
    return rig_words(d, "drops");
}

void rig_put(struct drops *d, const drops_drop *all, int count, uint32_t first_id)
{
    uint32_t tally[DROPS_TALLY] = {
        [DROPS_COUNT] = (uint32_t)count, [DROPS_NEXT_ID] = (uint32_t)count + first_id};
    for (int i = 0; i < count; i++) {
        drops_drop drop = all[i];
        drop.id = (uint32_t)i + first_id;
        drop.is_new = DROPS_LANDED_NOW;
        tally[DROPS_SOURCED] += drop.mass;
        assert_true(rg_buf_write(d->drops->buf, i * (int64_t)sizeof(drop), &drop, sizeof(drop)));
    }
    assert_true(rg_buf_write(d->tally->buf, 0, tally, sizeof(tally)));
    const int tiles = d->params.tile_columns * d->params.tile_rows;
    for (int i = 0; i < tiles; i++)
        assert_true(rg_buf_write(d->tiles->buf, i * 4, &(uint32_t){DROPS_AWAKE}, 4));
}
