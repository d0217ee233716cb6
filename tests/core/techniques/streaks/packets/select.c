// A view's selection of packets never misses one that is seen, against brute force in double
// precision.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/rigs/packets.h"
#include "tests/oracle/streaks/packets.h"
#include "tests/tools/expect.h"

enum { MAP_SIDE = 6, PARTICLES = 10000, VIEWS = 12, TRIES = 24 };

static const float texels[MAP_SIDE * MAP_SIDE] = {
    1,    0.2f, 0.3f, 0.9f, 0.4f, 0.7f, 0.5f, 1, 0.8f, 0.1f, 0,    0.6f,
    0.2f, 0.9f, 1,    1,    0.3f, 0,    0.7f, 1, 1,    0.6f, 0.2f, 0.4f,
    0,    0.1f, 0.5f, 0.8f, 1,    0.3f, 0.9f, 0, 0.6f, 0.2f, 0.7f, 1};

// A rain space with its map, and the oracle's frame of the same space.
struct scene {
    struct rg_rain_space space;
    struct oracle_frame frame;
    struct rg_density *map;
};

static struct scene make_scene(uint64_t *random, bool slanted)
{
    double fall[3] = {0, -1, 0};
    if (slanted)
        for (int i = 0; i < 3; i++)
            fall[i] = oracle_uniform(random, -1, 1);
    const struct rg_rain_space_settings settings = {.ground_m = {oracle_uniform(random, -50, 50),
                                                                 oracle_uniform(random, -50, 50),
                                                                 oracle_uniform(random, -50, 50)},
                                                    .fall = {fall[0], fall[1], fall[2]},
                                                    .width_m = oracle_uniform(random, 60, 400),
                                                    .depth_m = oracle_uniform(random, 60, 400),
                                                    .height_m = oracle_uniform(random, 50, 300)};
    struct scene scene;
    assert_true(rg_rain_space_make(&settings, &scene.space));
    double length = sqrt(fall[0] * fall[0] + fall[1] * fall[1] + fall[2] * fall[2]), origin[3];
    for (int i = 0; i < 3; i++)
        origin[i] = settings.ground_m[i] - settings.height_m * fall[i] / length;
    scene.frame = oracle_frame_at(origin, fall);
    scene.map = rig_map(MAP_SIDE, MAP_SIDE, texels);
    return scene;
}

// A view, the oracle's camera, and the height of the local space.
struct look {
    struct streaks_view view;
    struct oracle_camera camera;
    double height_m;
};

static struct look make_look(const struct scene *scene, double height_m, uint64_t *random)
{
    struct look look = {.height_m = height_m};
    double rain[3] = {oracle_uniform(random, -1.1, 1.1) * scene->space.half_x_m,
                      oracle_uniform(random, -1.1, 1.1) * scene->space.half_y_m,
                      oracle_uniform(random, 0, 1) * scene->space.height_m};
    double eye[3], target[3], up[3];
    oracle_to_world(&scene->frame, rain, eye);
    struct rg_camera camera = {
        .angle_deg = (float)oracle_uniform(random, 20, 100), .near_plane = 0.1f, .far_plane = 50};
    for (int i = 0; i < 3; i++) { // rounded to floats, as the camera has them
        eye[i] = (double)(camera.position[i] = (float)eye[i]);
        target[i] = eye[i] + oracle_uniform(random, -1, 1);
        target[i] = (double)(camera.target[i] = (float)target[i]);
        up[i] = (double)(camera.up[i] = (float)oracle_uniform(random, -1, 1));
    }
    const double aspect = oracle_uniform(random, 0.5, 2);
    look.camera = oracle_camera_at(eye, target, up, (double)camera.angle_deg, aspect, 0.1);
    look.view.across_m = oracle_uniform(random, 0, 3);
    look.view.above_m = oracle_uniform(random, 0, 4);
    look.view.below_m = oracle_uniform(random, 0, 2);
    look.view.radius_m = oracle_random(random) % 4 ? oracle_uniform(random, 5, 60) : INFINITY;
    rg_rain_point(&scene->space, eye, look.view.eye);
    assert_true(rg_rain_view_corners(&scene->space, &camera, aspect, look.view.corners));
    look.view.top_m = rg_rain_local_top(look.view.eye[2], height_m);
    look.view.run = oracle_uniform(random, 0, 1);
    look.view.whole = true;
    return look;
}

static bool sees(const struct scene *scene, const struct look *look, const struct rig_particle *p,
                 double from_s, double to_s, uint64_t *random)
{
    const double place[2] = {p->x_m, p->y_m};
    return oracle_sees_column(&look->camera, &scene->frame, place, look->view.across_m,
                              from_s - look->view.above_m, to_s + look->view.below_m, TRIES,
                              random);
}

// Whether anything that the particle may draw is seen from inside the culling prism, at any height
// of its packet or at its own. A particle that has just entered may still be a splash where it
// left.
static bool visible(const struct scene *scene, const struct look *look,
                    const struct rig_particle *p, uint64_t *random)
{
    const double top = look->view.top_m, height = look->height_m;
    if (fabs(p->x_m - look->view.eye[0]) > look->view.radius_m ||
        fabs(p->y_m - look->view.eye[1]) > look->view.radius_m)
        return false;
    if (look->view.whole)
        return sees(scene, look, p, top, top + height, random);
    const double turned = p->fall + look->view.run - RIG_RUN;
    const double s = top + height * (turned - floor(turned));
    return sees(scene, look, p, s, s, random) ||
           (s < top + look->view.above_m && sees(scene, look, p, s + height, top + height, random));
}

struct tally {
    int64_t visible, drawn[2], selected, all;
};

// Selects by rectangles or by the hull. Every particle with a visible part must be drawn.
static void check_view(const struct streaks_packets *packets, const struct scene *scene,
                       const struct look *look, const struct rig_particles *all, const bool *seen,
                       struct tally *tally)
{
    struct streaks_selection selection = {0};
    assert_true(streaks_select(packets, &look->view, &selection));
    struct rig_particles drawn = rig_read(packets, &scene->space, &selection);
    qsort(drawn.all, (size_t)drawn.count, sizeof(*drawn.all), rig_compare);
    for (int64_t i = 1; i < drawn.count; i++) // each at most once
        assert_below(rig_compare(&drawn.all[i - 1], &drawn.all[i]), 0);
    for (int64_t i = 0; i < all->count; i++)
        if (seen[i] &&
            !bsearch(&all->all[i], drawn.all, (size_t)drawn.count, sizeof(*drawn.all), rig_compare))
            fail_msg("a particle at %g, %g is seen, but not drawn (%s, %s)", all->all[i].x_m,
                     all->all[i].y_m, streaks_scheme_name(streaks_packets_info(packets)->scheme),
                     look->view.hull ? "hull" : "rectangles");
    assert_true(drawn.count == selection.particles || !look->view.whole);
    tally->drawn[look->view.hull] += drawn.count;
    tally->selected += selection.particles;
    free(drawn.all);
    streaks_selection_release(&selection);
}

static void check_views(const struct streaks_packets *packets, const struct scene *scene,
                        const struct rig_particles *all, bool whole, uint64_t *random,
                        struct tally *tally)
{
    bool *seen = calloc((size_t)all->count, sizeof(*seen));
    assert_non_null(seen);
    for (int i = 0; i < VIEWS; i++) {
        struct look look = make_look(scene, 20, random);
        look.view.whole = whole;
        for (int64_t k = 0; k < all->count; k++) {
            seen[k] = visible(scene, &look, &all->all[k], random);
            tally->visible += seen[k];
        }
        for (int hull = 0; hull < 2; hull++) {
            look.view.hull = hull;
            check_view(packets, scene, &look, all, seen, tally);
        }
        tally->all += all->count;
    }
    free(seen);
}

static void check_scheme(const struct scene *scene, enum streaks_scheme scheme, int size,
                         bool by_id, bool whole, uint64_t *random)
{
    struct streaks_packets_settings settings = rig_settings(&scene->space, scene->map, PARTICLES);
    settings.scheme = scheme;
    settings.packet_size = size;
    settings.by_id = by_id;
    struct streaks_packets *packets = rig_packets(&scene->space, scene->map, &settings);
    const struct rig_particles all = rig_read_all(packets, &scene->space, 20);
    struct tally tally = {0};
    check_views(packets, scene, &all, whole, random, &tally);
    assert_above(tally.visible, 0);
    assert_at_most(tally.drawn[1], tally.drawn[0]);
    if (scheme != STREAKS_WORLD)
        assert_below(tally.drawn[0], tally.all);
    if (!whole && (!by_id || scheme == STREAKS_GRID))
        assert_below(tally.drawn[0] + tally.drawn[1], tally.selected);
    free(all.all);
    streaks_packets_destroy(packets);
}

static void check_law(bool slanted, bool whole, uint64_t seed)
{
    uint64_t random = seed;
    for (int scheme = STREAKS_WORLD; scheme <= STREAKS_GRID; scheme++)
        for (int by_id = 0; by_id < 2; by_id++) {
            struct scene scene = make_scene(&random, slanted);
            check_scheme(&scene, (enum streaks_scheme)scheme, by_id ? 30 : 200, by_id, whole,
                         &random);
            rg_density_destroy(scene.map);
        }
}

static void test_nothing_seen_is_left_out(void **state)
{
    (void)state;
    check_law(false, true, 1);
}

static void test_nothing_seen_is_left_out_in_slanted_rain(void **state)
{
    (void)state;
    check_law(true, true, 2);
}

static void test_no_block_seen_is_left_out(void **state)
{
    (void)state;
    check_law(false, false, 3);
}

static void test_no_block_seen_is_left_out_in_slanted_rain(void **state)
{
    (void)state;
    check_law(true, false, 4);
}

// Both orders draw the same particles of the same packets.
static void test_orders_select_alike(void **state)
{
    (void)state;
    uint64_t random = 3;
    struct scene scene = make_scene(&random, false);
    for (int scheme = STREAKS_KD; scheme <= STREAKS_QUAD; scheme++) {
        struct streaks_packets_settings settings = rig_settings(&scene.space, scene.map, PARTICLES);
        settings.scheme = (enum streaks_scheme)scheme;
        settings.packet_size = 100;
        struct streaks_packets *by_packet = rig_packets(&scene.space, scene.map, &settings);
        settings.by_id = true;
        struct streaks_packets *by_id = rig_packets(&scene.space, scene.map, &settings);
        struct streaks_selection a = {0}, b = {0};
        for (int i = 0; i < VIEWS; i++) {
            const struct look look = make_look(&scene, 20, &random);
            assert_true(streaks_select(by_packet, &look.view, &a));
            assert_true(streaks_select(by_id, &look.view, &b));
            assert_int_equal(a.packets, b.packets);
            assert_int_equal(a.particles, b.particles);
            assert_memory_equal(a.selected, b.selected, (size_t)a.packets * sizeof(*a.selected));
            struct rig_particles read = rig_read(by_id, &scene.space, &b);
            for (int64_t k = 1; k < read.count; k++)
                assert_above(read.all[k].slot, read.all[k - 1].slot);
            free(read.all);
        }
        streaks_selection_release(&a);
        streaks_selection_release(&b);
        streaks_packets_destroy(by_packet);
        streaks_packets_destroy(by_id);
    }
    rg_density_destroy(scene.map);
}

// The hull is as tight as possible: a packet that it selects has a point near which something is
// seen, within the margin. The test tries 4000 random points of the packet.
static void test_hull_is_tight(void **state)
{
    (void)state;
    uint64_t random = 4;
    struct scene scene = make_scene(&random, true);
    struct streaks_packets_settings settings = rig_settings(&scene.space, scene.map, PARTICLES);
    settings.scheme = STREAKS_QUAD;
    settings.packet_size = 20;
    struct streaks_packets *packets = rig_packets(&scene.space, scene.map, &settings);
    struct streaks_selection selection = {0};
    int64_t selected = 0, idle = 0;
    for (int i = 0; i < VIEWS; i++) {
        struct look look = make_look(&scene, 20, &random);
        look.view.hull = true;
        look.view.radius_m = INFINITY;
        look.view.across_m = 0.5;
        assert_true(streaks_select(packets, &look.view, &selection));
        for (int k = 0; k < selection.packets; k++) {
            double r[4];
            streaks_packets_rectangle(packets, selection.selected[k], r);
            bool seen = false;
            for (int t = 0; t < 4000 && !seen; t++) {
                const struct rig_particle at = {.x_m = oracle_uniform(&random, r[0], r[2]),
                                                .y_m = oracle_uniform(&random, r[1], r[3])};
                const double place[2] = {at.x_m, at.y_m};
                seen = oracle_sees_column(&look.camera, &scene.frame, place, 0.5,
                                          look.view.top_m - look.view.above_m,
                                          look.view.top_m + 20 + look.view.below_m, 1, &random);
            }
            selected++;
            idle += !seen;
        }
    }
    assert_above(selected, 200);
    assert_below(idle * 20, selected); // random points may miss a corner
    streaks_selection_release(&selection);
    streaks_packets_destroy(packets);
    rg_density_destroy(scene.map);
}

// A camera outside the rain, or that looks away from it, selects nothing. STREAKS_WORLD is drawn
// anyway.
static void test_looking_away(void **state)
{
    (void)state;
    struct rg_density *map = rig_map(MAP_SIDE, MAP_SIDE, texels);
    struct streaks_view view = rig_everywhere(&rig_space, 20);
    for (int i = 0; i < 8; i++)
        view.corners[i][0] += 2000;
    for (int scheme = STREAKS_WORLD; scheme <= STREAKS_GRID; scheme++)
        for (int hull = 0; hull < 2; hull++) {
            struct streaks_packets_settings settings = rig_settings(&rig_space, map, PARTICLES);
            settings.scheme = (enum streaks_scheme)scheme;
            struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
            struct streaks_selection selection = {0};
            view.hull = hull;
            assert_true(streaks_select(packets, &view, &selection));
            assert_int_equal(selection.particles, scheme == STREAKS_WORLD ? PARTICLES : 0);
            assert_int_equal(selection.draw_count, scheme == STREAKS_WORLD);
            streaks_selection_release(&selection);
            streaks_packets_destroy(packets);
        }
    rg_density_destroy(map);
}

// A slab that the frustum does not meet: the hull excludes it, and rectangles do not.
static void test_hull_knows_the_local_space(void **state)
{
    (void)state;
    struct rg_density *map = rig_map(MAP_SIDE, MAP_SIDE, texels);
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, PARTICLES);
    settings.scheme = STREAKS_GRID;
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    struct streaks_selection selection = {0};
    struct streaks_view view = rig_everywhere(&rig_space, 20);
    view.top_m = 1000;
    view.hull = true;
    assert_true(streaks_select(packets, &view, &selection));
    assert_int_equal(selection.packets, 0);
    view.hull = false;
    assert_true(streaks_select(packets, &view, &selection));
    assert_above(selection.packets, 0);
    streaks_selection_release(&selection);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

static bool lists(const struct streaks_selection *all, const uint32_t *block)
{
    for (int64_t i = 0; i < all->block_count; i++)
        if (!memcmp(all->blocks + i * STREAKS_BLOCK_WORDS, block, 4 * STREAKS_BLOCK_WORDS))
            return true;
    return false;
}

// How many blocks are kept if one in `sparse` is; each must be one of all blocks.
static int64_t count_kept(const struct streaks_packets *packets, int sparse)
{
    struct streaks_view view = rig_everywhere(&rig_space, 20);
    struct streaks_selection all = {0}, kept = {0};
    view.whole = true;
    assert_true(streaks_select(packets, &view, &all));
    view.sparse = sparse;
    assert_true(streaks_select(packets, &view, &kept));
    assert_int_equal(kept.packets, all.packets);
    assert_int_equal(kept.particles, all.particles);
    for (int64_t i = 0; i < kept.block_count; i++)
        assert_true(lists(&all, kept.blocks + i * STREAKS_BLOCK_WORDS));
    struct rig_particles drawn = rig_read(packets, &rig_space, &kept);
    free(drawn.all);
    const int64_t count = kept.block_count;
    streaks_selection_release(&all);
    streaks_selection_release(&kept);
    return count;
}

// A sparse rain lists one block in `sparse`, for large packets and for packets with fewer blocks
// than that.
static void test_sparse_rain_is_one_block_in_so_many(void **state)
{
    (void)state;
    static const int sizes[] = {100, 4000}, sparse[] = {3, 16};
    struct rg_density *map = rig_map(MAP_SIDE, MAP_SIDE, texels);
    for (int k = 0; k < 2 * 4 * 2; k++) {
        struct streaks_packets_settings settings = rig_settings(&rig_space, map, 40000);
        settings.scheme = rig_schemes[k / 4];
        settings.by_id = k / 2 % 2;
        settings.packet_size = sizes[k % 2];
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        const double all = (double)count_kept(packets, 1);
        for (int i = 0; i < 2; i++)
            assert_below(fabs((double)count_kept(packets, sparse[i]) * sparse[i] / all - 1), 0.1);
        streaks_packets_destroy(packets);
    }
    rg_density_destroy(map);
}

static void test_wrong_views(void **state)
{
    (void)state;
    struct rg_density *map = rig_map(MAP_SIDE, MAP_SIDE, texels);
    const struct streaks_packets_settings settings = rig_settings(&rig_space, map, PARTICLES);
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    struct streaks_selection selection = {0};
    struct streaks_view wrong[6];
    for (int i = 0; i < 6; i++)
        wrong[i] = rig_everywhere(&rig_space, 20);
    wrong[0].eye[1] = NAN;
    wrong[1].corners[3][2] = INFINITY;
    wrong[2].radius_m = -1;
    wrong[3].radius_m = NAN;
    wrong[4].run = NAN;
    wrong[5].across_m = -0.1;
    for (int i = 0; i < 6; i++) {
        rig_listen();
        assert_false(streaks_select(packets, &wrong[i], &selection));
        assert_int_equal(rig_errors(), 1);
        assert_int_equal(selection.draw_count, 0);
    }
    streaks_selection_release(&selection);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

// More particles than one buffer holds: each is drawn once, from its own buffer.
static void test_packets_across_buffers(void **state)
{
    (void)state;
    const float constant[1] = {1};
    const int64_t count = STREAKS_BUFFER_PARTICLES + 1000;
    struct rg_density *map = rig_map(1, 1, constant);
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, (double)count);
    for (int by_id = 0; by_id < 2; by_id++) {
        settings.by_id = by_id;
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        assert_int_equal(streaks_packets_buffers(packets), 2);
        int64_t bytes;
        streaks_packets_buffer(packets, 0, &bytes);
        assert_int_equal(bytes, 12LL * STREAKS_BUFFER_PARTICLES);
        streaks_packets_buffer(packets, 1, &bytes);
        assert_int_equal(bytes, 12 * 1024);
        const struct streaks_view view = rig_everywhere(&rig_space, 20);
        struct streaks_selection selection = {0};
        assert_true(streaks_select(packets, &view, &selection));
        assert_int_equal(selection.draw_count, 2);
        assert_int_equal(selection.draws[0].block_count, STREAKS_BUFFER_PARTICLES / STREAKS_BLOCK);
        assert_int_equal(selection.draws[1].block_count, 32);
        int64_t sum = 0;
        for (int i = 0; i < 2; i++)
            for (int64_t b = 0; b < selection.draws[i].block_count; b++) {
                const uint32_t *block =
                    selection.blocks + (selection.draws[i].first_block + b) * STREAKS_BLOCK_WORDS;
                assert_int_equal(block[0], b * STREAKS_BLOCK);
                sum += __builtin_popcount(block[1]);
            }
        assert_int_equal(sum, count);
        streaks_selection_release(&selection);
        streaks_packets_destroy(packets);
    }
    rg_density_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_seen_is_left_out),
        cmocka_unit_test(test_nothing_seen_is_left_out_in_slanted_rain),
        cmocka_unit_test(test_no_block_seen_is_left_out),
        cmocka_unit_test(test_no_block_seen_is_left_out_in_slanted_rain),
        cmocka_unit_test(test_orders_select_alike),
        cmocka_unit_test(test_hull_is_tight),
        cmocka_unit_test(test_looking_away),
        cmocka_unit_test(test_hull_knows_the_local_space),
        cmocka_unit_test(test_sparse_rain_is_one_block_in_so_many),
        cmocka_unit_test(test_wrong_views),
        cmocka_unit_test(test_packets_across_buffers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
