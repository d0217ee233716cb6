// The procedural city: its numbers and bounds, no holes for walkers to see through, and one city
// from one seed.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/city/city.h"
#include "tests/tools/expect.h"

static struct city *create(int seed, enum city_size size)
{
    struct city *city = city_create(&(struct city_settings){seed, size});
    assert_non_null(city);
    return city;
}

static const float *corner(const struct city_faces *f, int face, int k)
{
    return f->corners + (size_t)face * SCENERY_FACE_WORDS + 3 * (size_t)k;
}

static bool is_quad(const struct city_faces *f, int face)
{
    return memcmp(corner(f, face, 2), corner(f, face, 3), 3 * sizeof(float)) != 0;
}

static const uint32_t *surface(const struct city_faces *f, int face)
{
    return f->surfaces + (size_t)f->surface_of[face] * SCENERY_SURFACE_WORDS;
}

// A component of a surface's normal, -1 to 1.
static double normal(const struct city_faces *f, int face, int c)
{
    return ((double)(surface(f, face)[SCENERY_NORMAL] >> 10 * c & 1023) - 512) / 511;
}

static bool is_leaf(const struct city_faces *f, int face)
{
    return scenery_kind(surface(f, face)[SCENERY_LOOK]) == SCENERY_KIND_LEAVES;
}

static int count_triangles(const struct city_faces *f)
{
    int triangles = 0;
    for (int i = 0; i < f->face_count; i++)
        triangles += is_quad(f, i) ? 2 : 1;
    return triangles;
}

static void it_has_the_published_numbers(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 3; seed++) {
        struct city *city = create(seed, CITY_FULL);
        assert_int_equal(count_triangles(&city->faces), 779287);
        assert_int_equal(city->faces.triangle_count, 779287);
        assert_int_equal(city->texture_count, 149);
        assert_int_equal(llround(149e-6 * city->texture_px * city->texture_px), 58);
        city_destroy(city);
    }
}

static void the_small_city_stands_in_the_same_bounds(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 8; seed++) {
        struct city *city = create(seed, CITY_SMALL);
        assert_int_equal(count_triangles(&city->faces), CITY_SMALL_TRIANGLES);
        const float low[3] = {-200, 0, -200}, high[3] = {200, 230, 200};
        assert_memory_equal(city->faces.low, low, sizeof(low));
        assert_memory_equal(city->faces.high, high, sizeof(high));
        city_destroy(city);
    }
}

static void the_full_city_is_of_the_same_plan(void **state)
{
    (void)state;
    struct city *full = create(5, CITY_FULL), *small = create(5, CITY_SMALL);
    assert_memory_equal(full->faces.low, small->faces.low, sizeof(full->faces.low));
    assert_memory_equal(full->faces.high, small->faces.high, sizeof(full->faces.high));
    assert_int_equal(full->box_count, small->box_count);
    assert_memory_equal(full->boxes, small->boxes, (size_t)full->box_count * sizeof(*full->boxes));
    assert_int_equal(full->lamp_count, small->lamp_count);
    for (int i = 0; i < full->lamp_count; i++)
        assert_memory_equal(&full->lamps[i], &small->lamps[i], sizeof(full->lamps[i]));
    city_destroy(full);
    city_destroy(small);
}

// A face's corners turn counter-clockwise about its surface's normal and lie in one plane.
static void check_face(const struct city_faces *f, int i)
{
    double u[3], v[3], w[3], n[3], area = 0, along = 0, off = 0;
    for (int c = 0; c < 3; c++) {
        u[c] = (double)corner(f, i, 1)[c] - (double)corner(f, i, 0)[c];
        v[c] = (double)corner(f, i, 2)[c] - (double)corner(f, i, 0)[c];
        w[c] = (double)corner(f, i, 3)[c] - (double)corner(f, i, 0)[c];
    }
    for (int c = 0; c < 3; c++)
        n[c] = u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
    for (int c = 0; c < 3; c++) {
        area += n[c] * n[c];
        along += n[c] * normal(f, i, c);
        off += n[c] * w[c];
    }
    area = sqrt(area);
    // Leaves have the normals of their round crown, not their own.
    const double least = is_leaf(f, i) ? 0.4 : 0.98;
    if (!(area > 0) || !(along > least * area) || !(fabs(off) <= 2e-3 * area))
        fail_msg("face %d: area %g, along its normal %g, out of its plane %g m", i, area / 2,
                 along / area, off / area);
}

static void faces_are_flat_and_look_outwards(void **state)
{
    (void)state;
    for (int size = CITY_FULL; size <= CITY_SMALL; size++) {
        struct city *city = create(1, (enum city_size)size);
        for (int i = 0; i < city->faces.face_count; i++) {
            assert_below(city->faces.surface_of[i], (uint32_t)city->faces.surface_count);
            assert_below((surface(&city->faces, i)[SCENERY_LOOK] & 255), 149);
            assert_below(scenery_kind(surface(&city->faces, i)[SCENERY_LOOK]), SCENERY_KINDS);
            check_face(&city->faces, i);
        }
        city_destroy(city);
    }
}

// Chunks hold every face once, within their bounds.
static void check_chunks(const struct city_faces *f)
{
    int next = 0;
    for (int i = 0; i < f->chunk_count; i++) {
        const struct city_chunk *chunk = &f->chunks[i];
        assert_int_equal(chunk->first, next);
        assert_between(chunk->count, 1, CITY_CHUNK_FACES);
        next += chunk->count;
        for (int k = 0; k < 4 * chunk->count; k++) {
            const float *p = corner(f, chunk->first + k / 4, k % 4);
            for (int c = 0; c < 3; c++) {
                assert_at_least(p[c], chunk->low[c]);
                assert_at_most(p[c], chunk->high[c]);
                const double n = (double)chunk->normal[c];
                if (chunk->normal[0] != 0 || chunk->normal[1] != 0 || chunk->normal[2] != 0)
                    assert_below(fabs(normal(f, chunk->first + k / 4, c) - n), 1e-6);
            }
        }
    }
    assert_int_equal(next, f->face_count);
}

static void chunks_hold_the_faces(void **state)
{
    (void)state;
    for (int size = CITY_FULL; size <= CITY_SMALL; size++) {
        struct city *city = create(size == CITY_FULL ? 1 : 2, (enum city_size)size);
        check_chunks(&city->faces);
        city_destroy(city);
    }
}

// --- rays ---

// The side from which a ray meets a triangle: 1 the front, -1 the back, 0 neither. `distance` is in
// lengths of `way`.
static int meet(const double from[3], const double way[3], const float *a, const float *b,
                const float *c, double *distance)
{
    double u[3], v[3], s[3], p[3], q[3], det = 0, x = 0, y = 0, t = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = (double)b[i] - (double)a[i];
        v[i] = (double)c[i] - (double)a[i];
        s[i] = from[i] - (double)a[i];
    }
    for (int i = 0; i < 3; i++) {
        p[i] = way[(i + 1) % 3] * v[(i + 2) % 3] - way[(i + 2) % 3] * v[(i + 1) % 3];
        q[i] = s[(i + 1) % 3] * u[(i + 2) % 3] - s[(i + 2) % 3] * u[(i + 1) % 3];
    }
    for (int i = 0; i < 3; i++) {
        det += u[i] * p[i];
        x += s[i] * p[i];
        y += way[i] * q[i];
        t += v[i] * q[i];
    }
    if (fabs(det) < 1e-12 || x / det < 0 || y / det < 0 || (x + y) / det > 1 || t / det <= 1e-6)
        return 0;
    *distance = t / det;
    return det > 0 ? 1 : -1;
}

// Whether a ray comes within a millimetre of a chunk's bounds, which hold all its faces.
static bool comes_near(const struct city_chunk *chunk, const double from[3], const double way[3])
{
    double in = 0, out = INFINITY;
    for (int c = 0; c < 3; c++) {
        const double low = (double)chunk->low[c] - 1e-3 - from[c];
        const double high = (double)chunk->high[c] + 1e-3 - from[c];
        if (way[c] == 0 && (low > 0 || high < 0))
            return false;
        if (way[c] == 0)
            continue;
        in = fmax(in, fmin(low / way[c], high / way[c]));
        out = fmin(out, fmax(low / way[c], high / way[c]));
    }
    return in <= out;
}

// The nearest face along a ray: 1 its front, -1 its back, 0 none. Leaves stand loosely: their backs
// are not drawn, and a ray goes on through them.
static int first_met(const struct city_faces *f, const double from[3], const double way[3])
{
    double nearest = INFINITY, distance;
    int side = 0;
    for (int c = 0; c < f->chunk_count; c++) {
        const struct city_chunk *chunk = &f->chunks[c];
        const int halves = comes_near(chunk, from, way) ? 2 * chunk->count : 0;
        for (int k = 0; k < halves; k++) {
            const int i = chunk->first + k / 2;
            const int met = meet(from, way, corner(f, i, 0), corner(f, i, 1 + k % 2),
                                 corner(f, i, 2 + k % 2), &distance);
            const bool drawn = met > 0 || (met < 0 && !is_leaf(f, i));
            if (drawn && distance < nearest) {
                nearest = distance;
                side = met;
            }
        }
    }
    return side;
}

static double chance(uint32_t *x)
{
    *x = *x * 1664525u + 1013904223u;
    return (*x >> 8) * 0x1p-24;
}

// From the streets one sees only fronts of faces or the sky: no wall is missing or turned inwards.
static void no_wall_is_seen_from_behind(void **state)
{
    (void)state;
    for (int size = CITY_FULL; size <= CITY_SMALL; size++) {
        struct city *city = create(1, (enum city_size)size);
        const int rays = size == CITY_FULL ? 150 : 4000;
        uint32_t x = 7;
        int behind = 0, sky = 0;
        for (int i = 0; i < rays; i++) {
            // From above the avenue or the street across it, in all directions.
            const bool avenue = chance(&x) < 0.5;
            const double along = 380 * chance(&x) - 190, beside = 6 * chance(&x) - 3;
            const double from[3] = {avenue ? beside : along, 3 + 30 * chance(&x),
                                    avenue ? along : beside};
            const double way[3] = {chance(&x) - 0.5, chance(&x) - 0.5, chance(&x) - 0.5};
            const int met = first_met(&city->faces, from, way);
            behind += met < 0 ? 1 : 0;
            sky += met == 0 ? 1 : 0;
        }
        assert_int_equal(behind, 0);
        assert_between(sky, rays / 50, rays / 2);
        city_destroy(city);
    }
}

// A vertical ray anywhere meets a front: the ground at the latest.
static void the_ground_has_no_gap(void **state)
{
    (void)state;
    struct city *city = create(2, CITY_SMALL);
    uint32_t x = 3;
    for (int i = 0; i < 4000; i++) {
        const double from[3] = {399.9 * chance(&x) - 199.95, 300, 399.9 * chance(&x) - 199.95};
        assert_int_equal(first_met(&city->faces, from, (const double[3]){0, -1, 0}), 1);
    }
    city_destroy(city);
}

static void buildings_rise_towards_the_middle(void **state)
{
    (void)state;
    struct city *city = create(1, CITY_SMALL);
    double sums[2] = {0};
    int counts[2] = {0};
    for (int i = 0; i < city->box_count; i++) {
        const struct city_box *box = &city->boxes[i];
        const double x = (double)(box->low[0] + box->high[0]) / 2;
        const double z = (double)(box->low[2] + box->high[2]) / 2;
        const int outer = hypot(x, z) > 110 ? 1 : 0;
        sums[outer] += (double)box->high[1];
        counts[outer]++;
    }
    assert_above(counts[0], 20);
    assert_above(counts[1], 20);
    assert_above(sums[0] / counts[0], 2 * sums[1] / counts[1]);
    city_destroy(city);
}

// Lamps are within the city, in the streets; street lamps are over the road. Signs' lights are
// behind their buildings' fronts.
static void lamps_stand_in_the_streets(void **state)
{
    (void)state;
    struct city *city = create(1, CITY_SMALL);
    int kinds[CITY_LAMP_KINDS] = {0};
    for (int i = 0; i < city->lamp_count; i++) {
        const struct city_lamp *lamp = &city->lamps[i];
        const float *p = lamp->position, *d = lamp->direction;
        kinds[lamp->kind]++;
        assert_above(p[1], lamp->kind < CITY_HEADLIGHT || lamp->kind == CITY_SIGN ? 2 : 0.6f);
        assert_below(p[1], 9);
        assert_below(fabsf(p[0]), 200);
        assert_below(fabsf(p[2]), 200);
        assert_below(fabsf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1), 1e-6f);
        for (int k = 0; k < city->box_count && lamp->kind != CITY_SIGN; k++) {
            const struct city_box *b = &city->boxes[k];
            assert_false(p[0] > b->low[0] && p[0] < b->high[0] && p[2] > b->low[2] &&
                         p[2] < b->high[2]);
        }
    }
    assert_above(kinds[CITY_STREET_LAMP], 50);
    assert_above(kinds[CITY_TRAFFIC_RED], 20);
    assert_above(kinds[CITY_TRAFFIC_GREEN], 20);
    assert_above(kinds[CITY_HEADLIGHT], 20);
    assert_int_equal(kinds[CITY_HEADLIGHT], kinds[CITY_TAIL_LIGHT]);
    assert_above(kinds[CITY_SIGN], 100);
    city_destroy(city);
}

// --- seeds ---

static uint32_t sum_of_texture(int seed, int texture)
{
    const struct city_settings settings = {seed, CITY_SMALL};
    struct city_painter *painter = city_painter_create(&settings);
    uint32_t texels[CITY_SMALL_TEXTURE_PX * CITY_SMALL_TEXTURE_PX], sum = 0;
    assert_non_null(painter);
    city_paint(painter, texture, texels);
    for (int i = 0; i < CITY_SMALL_TEXTURE_PX * CITY_SMALL_TEXTURE_PX; i++)
        sum = (sum ^ texels[i]) * 0x9e3779b1u;
    city_painter_destroy(painter);
    return sum;
}

static void a_seed_makes_one_city(void **state)
{
    (void)state;
    struct city *a = create(1, CITY_SMALL), *again = create(1, CITY_SMALL);
    struct city *b = create(2, CITY_SMALL);
    assert_equals(a->hash, again->hash);
    assert_differs(a->hash, b->hash);
    city_destroy(a);
    city_destroy(again);
    city_destroy(b);
    for (int texture = 0; texture < CITY_TEXTURES; texture += 37) {
        assert_int_equal(sum_of_texture(1, texture), sum_of_texture(1, texture));
        assert_int_not_equal(sum_of_texture(1, texture), sum_of_texture(2, texture));
    }
}

// Textures differ from each other, and facades have lit windows.
static void textures_are_painted(void **state)
{
    (void)state;
    const struct city_settings settings = {1, CITY_SMALL};
    struct city_painter *painter = city_painter_create(&settings);
    uint32_t texels[CITY_SMALL_TEXTURE_PX * CITY_SMALL_TEXTURE_PX];
    uint32_t sums[CITY_TEXTURES];
    int lit = 0;
    for (int i = 0; i < CITY_TEXTURES; i++) {
        sums[i] = 0;
        city_paint(painter, i, texels);
        for (int k = 0; k < CITY_SMALL_TEXTURE_PX * CITY_SMALL_TEXTURE_PX; k++) {
            sums[i] = (sums[i] ^ texels[k]) * 0x9e3779b1u;
            lit += i < 96 && texels[k] >> 24 ? 1 : 0;
        }
        for (int k = 0; k < i; k++)
            assert_int_not_equal(sums[i], sums[k]);
    }
    // About a tenth of the texels of the 96 facades are lit.
    assert_between(lit, 96 * 64 * 64 / 20, 96 * 64 * 64 / 3);
    city_painter_destroy(painter);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_has_the_published_numbers),
        cmocka_unit_test(the_small_city_stands_in_the_same_bounds),
        cmocka_unit_test(the_full_city_is_of_the_same_plan),
        cmocka_unit_test(faces_are_flat_and_look_outwards),
        cmocka_unit_test(chunks_hold_the_faces),
        cmocka_unit_test(no_wall_is_seen_from_behind),
        cmocka_unit_test(the_ground_has_no_gap),
        cmocka_unit_test(buildings_rise_towards_the_middle),
        cmocka_unit_test(lamps_stand_in_the_streets),
        cmocka_unit_test(a_seed_makes_one_city),
        cmocka_unit_test(textures_are_painted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
