#include "tests/core/techniques/rigs/packets.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/tools/expect.h"

const struct rg_rain_space rig_space = {.origin_m = {0, 230, 0},
                                        .x = {1, 0, 0},
                                        .y = {0, 0, 1},
                                        .s = {0, -1, 0},
                                        .half_x_m = 200,
                                        .half_y_m = 200,
                                        .height_m = 230};

const float rig_uneven[UNEVEN_X * UNEVEN_Y] = {
    0.1f, 0.5f, 0, 0,    1,    0.2f, 0.3f, 0.9f, 0.9f, 0, 0.4f,  0.7f, 0.1f, 0,    0, 0, 0,    0,
    0,    0,    0, 0.6f, 0.2f, 0.8f, 0.1f, 0.5f, 1,    1, 0.02f, 0.3f, 0.4f, 0.2f, 1, 0, 0.25f};

const enum streaks_scheme rig_schemes[4] = {STREAKS_WORLD, STREAKS_KD, STREAKS_QUAD, STREAKS_GRID};

struct streaks_packets_settings rig_settings(const struct rg_rain_space *space,
                                             const struct rg_density *density, double particles)
{
    const double volume = 4 * space->half_x_m * space->half_y_m * 20 * rg_density_mean(density);
    return (struct streaks_packets_settings){.seed = 7,
                                             .drops_m2_s = particles / volume * 8,
                                             .fall_speed_m_s = 8,
                                             .local_height_m = 20,
                                             .packet_size = 1000,
                                             .scheme = STREAKS_WORLD,
                                             .memory_bytes = (int64_t)1 << 30,
                                             .amount = "drops_m2_s"};
}

struct streaks_packets *rig_packets(const struct rg_rain_space *space,
                                    const struct rg_density *density,
                                    const struct streaks_packets_settings *settings)
{
    struct streaks_packets *packets = streaks_packets_create(space, density, settings);
    assert_non_null(packets);
    return packets;
}

struct streaks_view rig_everywhere(const struct rg_rain_space *space, double local_height_m)
{
    struct streaks_view view = {.eye = {0, 0, space->height_m / 2},
                                .radius_m = INFINITY,
                                .top_m = space->height_m / 2 - local_height_m / 2,
                                .run = RIG_RUN,
                                .whole = true};
    for (int i = 0; i < 8; i++) {
        view.corners[i][0] = (i & 1 ? 2 : -2) * space->half_x_m;
        view.corners[i][1] = (i & 2 ? 2 : -2) * space->half_y_m;
        view.corners[i][2] = (i & 4 ? 3 : -2) * space->height_m;
    }
    return view;
}

static float as_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof(value));
    return value;
}

static void read_block(const struct streaks_packets *packets, const struct rg_rain_space *space,
                       int buffer, const uint32_t *block, struct rig_particles *to)
{
    int64_t bytes;
    const float *particles = streaks_packets_buffer(packets, buffer, &bytes);
    assert_at_most(bytes, 128 << 20);
    assert_int_equal(block[0] % STREAKS_BLOCK, 0);
    assert_at_most(12 * ((int64_t)block[0] + STREAKS_BLOCK), bytes);
    assert_int_not_equal(block[1], 0);
    const float turn = as_float(block[4]);
    assert_at_least(turn, 0);
    assert_below(turn, 1);
    for (int bit = 0; bit < STREAKS_BLOCK; bit++) {
        if (!(block[1] >> bit & 1))
            continue;
        const float *p = particles + 3 * ((int64_t)block[0] + bit);
        const double start = (double)p[2] - floor((double)p[2]), fall = start + (double)turn;
        to->all[to->count++] = (struct rig_particle){
            .slot = (int64_t)buffer * STREAKS_BUFFER_PARTICLES + block[0] + bit,
            .shift_x = as_float(block[2]),
            .shift_y = as_float(block[3]),
            .x_m = ((double)p[0] + (double)as_float(block[2])) * space->half_x_m,
            .y_m = ((double)p[1] + (double)as_float(block[3])) * space->half_y_m,
            .fall = fall - floor(fall),
            .start = start,
            .oscillation = (int)floor((double)p[2])};
    }
}

struct rig_particles rig_read(const struct streaks_packets *packets,
                              const struct rg_rain_space *space,
                              const struct streaks_selection *selection)
{
    struct rig_particles read = {
        .all = calloc((size_t)selection->block_count * STREAKS_BLOCK + 1, sizeof(*read.all))};
    assert_non_null(read.all);
    int64_t next = 0;
    for (int i = 0; i < selection->draw_count; i++) {
        const struct streaks_draw *draw = &selection->draws[i];
        assert_int_equal(draw->first_block, next);
        assert_above(draw->block_count, 0);
        assert_at_most(draw->block_count, STREAKS_DRAW_BLOCKS);
        assert_below(draw->buffer, streaks_packets_buffers(packets));
        for (int block = 0; block < draw->block_count; block++)
            read_block(packets, space, draw->buffer,
                       selection->blocks + (next + block) * STREAKS_BLOCK_WORDS, &read);
        next += draw->block_count;
    }
    assert_int_equal(next, selection->block_count);
    assert_at_most(read.count, selection->particles);
    return read;
}

struct rig_particles rig_read_all(const struct streaks_packets *packets,
                                  const struct rg_rain_space *space, double local_height_m)
{
    const struct streaks_view view = rig_everywhere(space, local_height_m);
    struct streaks_selection selection = {0};
    assert_true(streaks_select(packets, &view, &selection));
    const struct rig_particles all = rig_read(packets, space, &selection);
    assert_int_equal(all.count, streaks_packets_info(packets)->total_particles);
    streaks_selection_release(&selection);
    return all;
}

int rig_compare(const void *a, const void *b)
{
    const struct rig_particle *p = a, *q = b;
    if (p->slot != q->slot)
        return p->slot < q->slot ? -1 : 1;
    if (p->shift_x != q->shift_x)
        return p->shift_x < q->shift_x ? -1 : 1;
    return (p->shift_y > q->shift_y) - (p->shift_y < q->shift_y);
}

struct rg_density *rig_map(int width, int height, const float *texels)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, width, height, 1, "map"));
    memcpy(picture.texels, texels, (size_t)width * (size_t)height * sizeof(*texels));
    struct rg_density *density = rg_density_from_picture(&picture, "map");
    rg_picture_destroy(&picture);
    assert_non_null(density);
    return density;
}

struct rg_density *rig_uneven_map(void)
{
    return rig_map(UNEVEN_X, UNEVEN_Y, rig_uneven);
}

void rig_expect_chance(double p, const char *what)
{
    if (!(p > RIG_CHANCE))
        fail_msg("%s: by chance only in %g of all cases", what, p);
}

static int errors;

static void count_errors(enum rg_log_level level, const char *line, void *user)
{
    (void)line;
    (void)user;
    errors += level == RG_LOG_ERROR;
}

void rig_listen(void)
{
    errors = 0;
    rg_log_listen(count_errors, NULL);
}

int rig_errors(void)
{
    rg_log_listen(NULL, NULL);
    return errors;
}
