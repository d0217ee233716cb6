// The particles of streaks on devices, against an oracle in double precision: particles DEVICE.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/device/device.h"
#include "kernels/dialect/rng.h"
#include "kernels/streaks/params.h"
#include "tests/oracle/particle.h"
#include "tests/tools/expect.h"

enum { BLOCKS = 256, PARTICLES = BLOCKS * STREAKS_BLOCK, MAP_X = 7, MAP_Y = 5, WORDS = 10 };
enum { SIZES = 4, SIZE_WORDS = 5, FIRST_BLOCK = SIZES * SIZE_WORDS };
enum { SURFACES = 20, SURFACE_WORDS = 4, NO_SURFACE = -1 };

static const char *device_name;

struct scene {
    float particles[3 * PARTICLES];
    uint32_t blocks[FIRST_BLOCK + BLOCKS * STREAKS_BLOCK_WORDS]; // after the classes of sizes
    float depths[MAP_X * MAP_Y];
    int32_t numbers[MAP_X * MAP_Y]; // of surfaces
    uint32_t surfaces[SURFACES * SURFACE_WORDS];
};

static double uniform(uint32_t item, uint32_t stream)
{
    return (double)rg_uniform(rg_random(3, item, 0, stream).x);
}

static uint32_t bits(double value)
{
    const float f = (float)value;
    uint32_t u;
    memcpy(&u, &f, sizeof(u));
    return u;
}

static float number(uint32_t u)
{
    float f;
    memcpy(&f, &u, sizeof(f));
    return f;
}

// Classes of drops: radius, speed and frequency as multiples of the settings' drop; how many drops
// one stands for; and the class's phase.
static const double classes[SIZES][SIZE_WORDS] = {{1, 1, 1, 1, 0},
                                                  {0.5, 0.75, 2.8, 3, 0.4},
                                                  {1.5, 1.125, 0.54, 0.25, 0.95},
                                                  {0.25, 0.5, 8, 40, 0.1}};

// Blocks refer to particles in another order than that of memory.
static void fill(struct scene *scene)
{
    for (uint32_t i = 0; i < PARTICLES; i++) {
        scene->particles[3 * i] = (float)(2 * uniform(i, 0) - 1);
        scene->particles[3 * i + 1] = (float)(2 * uniform(i, 1) - 1);
        scene->particles[3 * i + 2] = (float)(floor(10 * uniform(i, 2)) + uniform(i, 3));
    }
    for (int i = 0; i < FIRST_BLOCK; i++)
        scene->blocks[i] = bits(classes[i / SIZE_WORDS][i % SIZE_WORDS]);
    for (uint32_t b = 0; b < BLOCKS; b++) {
        uint32_t *block = scene->blocks + FIRST_BLOCK + b * STREAKS_BLOCK_WORDS;
        block[0] = (b * 37 % BLOCKS) * STREAKS_BLOCK;
        block[1] = rg_random(3, b, 0, 4).x | rg_random(3, b, 0, 5).x;
        block[2] = bits(0.3 * uniform(b, 6));
        block[3] = bits(0.3 * uniform(b, 7));
        block[4] = bits(uniform(b, 8));
    }
    for (uint32_t i = 0; i < MAP_X * MAP_Y; i++) {
        scene->depths[i] = i % 6 ? (float)(0.25 + 0.6 * uniform(i, 9)) : 1;
        scene->numbers[i] = i % 5 ? (int32_t)(i * 7 % SURFACES) : NO_SURFACE;
    }
    for (uint32_t i = 0; i < SURFACES * SURFACE_WORDS; i++)
        scene->surfaces[i] = rg_random(3, i, 0, 10).x;
    // The kind is the third half byte of the look.
    for (uint32_t i = 0; i < SURFACES; i++) {
        uint32_t *look = &scene->surfaces[i * SURFACE_WORDS + 3];
        *look = (*look & ~0xf00u) | (i % 10) << 8;
    }
}

static const streaks_params base = {
    .half_x = 30,
    .half_y = 20,
    .top = 20,
    .local_height = 30,
    .eye_x = 3,
    .eye_y = -2,
    .radius = 8,
    .map_x = -30,
    .map_y = -20,
    .map_per_x = 1.0f / 60,
    .map_per_y = 1.0f / 40,
    .map_height = 70,
    .ground = 70,
    .fall = 0.135f,
    .drop_radius = 0.005f,
    .behind = 0.14f,
    .sizes = SIZES,
    .materials = 1,
    .fall_speed = 8,
    .cycles_per_m = 7.5f,
    .splash_s = 0.25f,
    .drops = 1,
    .splashes = 1,
};

static struct rg_buf *upload(struct rg_device *device, const void *data, size_t size)
{
    struct rg_buf *buf = rg_buf_create_with(device, data, (int64_t)size, "scene");
    assert_non_null(buf);
    return buf;
}

static struct rg_image *map_of(struct rg_device *device, enum rg_format format, const void *texels)
{
    struct rg_image *map =
        rg_image_create(device, &(struct rg_image_desc){format, MAP_X, MAP_Y, 1, 1}, "map");
    assert_non_null(map);
    assert_true(rg_image_write(map, 0, 0, texels));
    return map;
}

static void compute(const struct scene *scene, const streaks_params *p, float *places)
{
    struct rg_device *device = rg_device_open(device_name);
    assert_non_null(device);
    struct rg_pass *pass = rg_pass_create(device, "streaks_state");
    struct rg_buf *particles = upload(device, scene->particles, sizeof(scene->particles));
    struct rg_buf *blocks = upload(device, scene->blocks, sizeof(scene->blocks));
    struct rg_buf *out = rg_buf_create(device, PARTICLES * WORDS * 4, "places");
    struct rg_image *depths = map_of(device, RG_D32F, scene->depths);
    struct rg_image *numbers = map_of(device, RG_RGBA8, scene->numbers);
    struct rg_buf *surfaces = upload(device, scene->surfaces, sizeof(scene->surfaces));
    assert_true(pass && out);
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = p,
                                                   .slots = {[1].buf = particles,
                                                             [2].buf = blocks,
                                                             [3].image = depths,
                                                             [4].buf = out,
                                                             [10].image = numbers,
                                                             [11].buf = surfaces},
                                                   .extent = {PARTICLES, 1, 1}}));
    assert_true(rg_buf_read(out, 0, places, PARTICLES * WORDS * 4));
    rg_image_destroy(numbers);
    rg_image_destroy(depths);
    rg_buf_destroy(surfaces);
    rg_buf_destroy(out);
    rg_buf_destroy(blocks);
    rg_buf_destroy(particles);
    rg_pass_destroy(pass);
    assert_true(rg_device_close(device));
}

// The surface that is hit: its s and material, and the distance of the place from the map's next
// texel.
struct hit {
    double s, margin;
    int material;
    bool is_beside; // the map
};

// By the table of docs/streaks.md.
static int material_of(const struct scene *scene, int32_t number)
{
    enum { FILM, PUDDLE, ROUGH, SMOOTH };
    static const int of_kinds[] = {ROUGH,  SMOOTH, PUDDLE, FILM,   FILM,
                                   SMOOTH, ROUGH,  SMOOTH, PUDDLE, SMOOTH};
    return number == NO_SURFACE ? FILM
                                : of_kinds[scene->surfaces[number * SURFACE_WORDS + 3] / 256 % 16];
}

static struct hit hit_at(const struct scene *scene, double x, double y)
{
    const double u = (x + 30) / 60 * MAP_X, v = (y + 20) / 40 * MAP_Y;
    struct hit hit = {70, fmin(fabs(u - round(u)), fabs(v - round(v))), 0, true};
    if (u < 0 || v < 0 || u >= MAP_X || v >= MAP_Y)
        return hit;
    const int texel = (int)v * MAP_X + (int)u;
    hit.is_beside = false;
    hit.s = 70 * (double)scene->depths[texel];
    hit.material = material_of(scene, scene->numbers[texel]);
    return hit;
}

// A hash of a particle's number decides its class, and its swing's phase in steps of 1/1024.
static uint32_t hash_of(uint32_t particle)
{
    uint32_t h = particle * 0x9e3779b9u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    return h ^ (h >> 13);
}

static double begin_of(uint32_t particle)
{
    return (double)(hash_of(particle) % 1024) / 1024;
}

static const double *class_of(uint32_t particle)
{
    return classes[hash_of(particle) / 16384 % SIZES];
}

// Counts the particles in each state.
static void compare(const struct scene *scene, const streaks_params *p, const float *places,
                    int counts[3])
{
    struct particle_space space = {.half_x = 30,
                                   .half_y = 20,
                                   .top = 20,
                                   .height = 30,
                                   .splash_s = 0.25,
                                   .eye_x = 3,
                                   .eye_y = -2,
                                   .radius = 8,
                                   .exact = p->exact};
    int of_class[SIZES] = {0};
    memset(counts, 0, 3 * sizeof(*counts));
    for (uint32_t i = 0; i < PARTICLES; i++) {
        const uint32_t *block =
            scene->blocks + FIRST_BLOCK + i / STREAKS_BLOCK * STREAKS_BLOCK_WORDS;
        const float *particle = scene->particles + 3 * (size_t)(block[0] + i % STREAKS_BLOCK);
        const double *class = class_of(block[0] + i % STREAKS_BLOCK);
        space.speed = 8 * class[1];
        space.streak = 0.135 * class[1] + 0.005 * class[0];
        const double x = (double)particle[0] + (double)number(block[2]);
        const double y = (double)particle[1] + (double)number(block[3]);
        const struct hit hit = hit_at(scene, x * 30, y * 20);
        struct particle_seen seen = particle_oracle(&space, x, y, fmod((double)particle[2], 1),
                                                    (double)number(block[4]) + class[4], hit.s);
        if (seen.margin_m < 1e-3 || hit.margin < 1e-4)
            continue;
        if ((p->around && hit.is_beside) || !(block[1] >> i % STREAKS_BLOCK & 1) ||
            (seen.state == PARTICLE_DROP && !p->drops) ||
            (seen.state == PARTICLE_SPLASH && !p->splashes))
            seen.state = PARTICLE_NOTHING;
        const float *place = places + WORDS * (size_t)i;
        assert_int_equal(place[5], seen.state);
        counts[seen.state]++;
        if (seen.state == PARTICLE_NOTHING)
            continue;
        assert_below(fabs((double)place[0] - seen.x), 1e-4);
        assert_below(fabs((double)place[1] - seen.y), 1e-4);
        assert_below(fabs((double)place[2] - seen.s), 1e-4);
        assert_below(fabs((double)place[3] - hit.s), 1e-4);
        assert_int_equal(place[6], hit.material);
        const double turn =
            7.5 * class[2] / class[1] * seen.s + begin_of(block[0] + i % STREAKS_BLOCK);
        assert_int_equal(place[7], floor((double)particle[2]));
        assert_below(fabs(remainder((double)place[7] - turn, 1)), 1e-3);
        assert_below(fabs((double)place[8] - 0.005 * class[0]), 1e-8);
        assert_below(fabs((double)place[9] - class[3]), 1e-5);
        of_class[(class - classes[0]) / SIZE_WORDS]++;
        assert_below(fabs((double)place[4] - (seen.state == PARTICLE_SPLASH ? seen.age_s : 0)),
                     1e-4);
    }
    // Classes are equally frequent.
    const int all = counts[PARTICLE_DROP] + counts[PARTICLE_SPLASH];
    for (int k = 0; k < SIZES; k++)
        assert_true(of_class[k] * SIZES > all / 2 && of_class[k] * SIZES < 2 * all);
}

static void check(const streaks_params *p, int least_drops, int least_splashes)
{
    static struct scene scene;
    static float places[PARTICLES * WORDS];
    int counts[3];
    fill(&scene);
    compute(&scene, p, places);
    compare(&scene, p, places, counts);
    assert_at_least(counts[PARTICLE_DROP], least_drops);
    assert_at_least(counts[PARTICLE_SPLASH], least_splashes);
    assert_above(counts[PARTICLE_NOTHING], 100);
}

static void test_states(void **state)
{
    (void)state;
    check(&base, 1000, 100);
}

static void test_culled_one_by_one(void **state)
{
    (void)state;
    streaks_params p = base;
    p.exact = 1;
    check(&p, 100, 10);
}

// A map around the observer does not cover places beside it. Nothing is drawn there, so that rain
// does not fall through roofs.
static void test_nothing_beside_the_map(void **state)
{
    (void)state;
    streaks_params p = base;
    p.around = 1;
    check(&p, 1000, 50);
}

static void test_drops_alone(void **state)
{
    (void)state;
    streaks_params p = base;
    p.splashes = 0;
    check(&p, 1000, 0);
}

static void test_splashes_alone(void **state)
{
    (void)state;
    streaks_params p = base;
    p.drops = 0;
    check(&p, 0, 100);
}

int main(int argc, char **argv)
{
    device_name = argc > 1 ? argv[1] : "cpu:reference";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_states),
        cmocka_unit_test(test_culled_one_by_one),
        cmocka_unit_test(test_nothing_beside_the_map),
        cmocka_unit_test(test_drops_alone),
        cmocka_unit_test(test_splashes_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
