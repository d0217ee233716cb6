// Environment maps: damaged files are refused in one line, and cube maps have no seams.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/scene/environment/blur.h"
#include "core/scene/environment/cube.h"
#include "kernels/dialect/image/cube.h"
#include "kernels/dialect/image/memory.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

static void write_file(const char *path, const void *data, size_t bytes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, bytes, file), bytes);
    assert_int_equal(fclose(file), 0);
}

// --- files ---

// A KTX 1 file as bytes: 12 of identifier, 13 words of header, the size of a face, six faces.
enum { FACE_PX = 4, IDENTIFIER = 12, WORDS = 13, FACE_BYTES = FACE_PX * FACE_PX * 4 };
enum { KTX_BYTES = IDENTIFIER + WORDS * 4 + 4 + 6 * FACE_BYTES };
enum word { ENDIANNESS, INTERNAL_FORMAT = 4, WIDTH = 6, HEIGHT, FACES = 10, KEY_VALUE_BYTES = 12 };

static void make_ktx(unsigned char *file)
{
    static const unsigned char identifier[IDENTIFIER] = {0xab, 'K',  'T',  'X',  ' ',  '1',
                                                         '1',  0xbb, '\r', '\n', 0x1a, '\n'};
    const uint32_t header[WORDS] = {0x04030201, 0x8c3b, 4, 0x1907, 0x8c3a, 0x1907, FACE_PX,
                                    FACE_PX,    0,      0, 6,      1,      0};
    const uint32_t face_bytes = FACE_BYTES, one = 15u << 6 | 15u << 17 | 15u << 27;
    memcpy(file, identifier, IDENTIFIER);
    memcpy(file + IDENTIFIER, header, sizeof(header));
    memcpy(file + IDENTIFIER + sizeof(header), &face_bytes, 4);
    for (int i = 0; i < 6 * FACE_PX * FACE_PX; i++)
        memcpy(file + IDENTIFIER + sizeof(header) + 4 + 4 * i, &one, 4);
}

static void set_word(unsigned char *file, enum word word, uint32_t value)
{
    memcpy(file + IDENTIFIER + 4 * word, &value, 4);
}

struct lines {
    int count;
    char last[1024];
};

static void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    struct lines *lines = user;
    lines->count++;
    snprintf(lines->last, sizeof(lines->last), "%s", line);
}

// The environment is refused in exactly one line, which names the file and holds `why`.
static void expect_refused(const char *path, const char *why)
{
    struct lines lines = {0};
    rg_log_listen(listen, &lines);
    struct rg_environment *environment = rg_environment_load(path, 64);
    rg_log_listen(NULL, NULL);
    assert_null(environment);
    if (lines.count != 1 || !strstr(lines.last, path) || !strstr(lines.last, why))
        fail_msg("%d lines, the last: %s", lines.count, lines.last);
}

static void expect_file_refused(const char *name, const void *data, size_t bytes, const char *why)
{
    const char *path = in_folder(name);
    write_file(path, data, bytes);
    expect_refused(path, why);
    unlink(path);
}

static void test_a_good_ktx_is_read(void **state)
{
    (void)state;
    unsigned char file[KTX_BYTES];
    make_ktx(file);
    const char *path = in_folder("good.ktx");
    write_file(path, file, sizeof(file));
    struct rg_environment *environment = rg_environment_load(path, 64);
    unlink(path);
    assert_non_null(environment);
    assert_int_equal(environment->size, FACE_PX);
    for (int face = 0; face < 6; face++)
        for (int y = -1; y <= FACE_PX; y++)
            for (int x = -1; x <= FACE_PX; x++)
                for (int c = 0; c < 3; c++)
                    assert_equals(rg_environment_texel(environment, face, x, y)[c], 1.0f);
    rg_environment_destroy(environment);
}

static void test_truncated_ktx(void **state)
{
    (void)state;
    unsigned char file[KTX_BYTES];
    make_ktx(file);
    expect_file_refused("cut.ktx", file, KTX_BYTES - 1, "truncated");
    expect_file_refused("header.ktx", file, IDENTIFIER + WORDS * 4, "truncated");
    expect_file_refused("half.ktx", file, IDENTIFIER + 10, "truncated");
    expect_file_refused("empty.ktx", file, 0, "empty");
}

static void test_wrong_ktx(void **state)
{
    (void)state;
    static const struct {
        enum word word;
        uint32_t value;
        const char *why;
    } cases[] = {
        {INTERNAL_FORMAT, 0x8058, "0x8058"},
        {FACES, 1, "1 faces"},
        {FACES, 0xffffffffu, "faces"},
        {WIDTH, 5, "5x4"},
        {HEIGHT, 0, "4x0"},
        {ENDIANNESS, 0x01020304, "byte order"},
        {KEY_VALUE_BYTES, 64, "truncated"},
        {KEY_VALUE_BYTES, 0xffffffffu, "damaged"},
    };
    unsigned char file[KTX_BYTES];
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        make_ktx(file);
        set_word(file, cases[i].word, cases[i].value);
        expect_file_refused("wrong.ktx", file, sizeof(file), cases[i].why);
    }
    make_ktx(file);
    set_word(file, WIDTH, 1 << 20);
    set_word(file, HEIGHT, 1 << 20);
    expect_file_refused("huge.ktx", file, sizeof(file), "1048576x1048576");
    make_ktx(file);
    file[5] = '2';
    expect_file_refused("version.ktx", file, sizeof(file), "not a KTX 1 file");
}

static void test_what_is_no_file(void **state)
{
    (void)state;
    expect_refused(in_folder("absent.ktx"), "No such file");
    expect_refused(in_folder("absent.exr"), "");
    expect_refused(folder, "");
    const char *path = in_folder("folder.ktx");
    assert_int_equal(mkdir(path, 0700), 0);
    expect_refused(path, "");
    rmdir(path);
    expect_file_refused("empty.exr", "", 0, "");
    expect_file_refused("text.hdr", "no image", 8, "");
}

static void test_a_lat_long_of_the_wrong_shape(void **state)
{
    (void)state;
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, 48, 32, 3, "test"));
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = 0.5f;
    const char *path = in_folder("wide.exr");
    assert_true(rg_picture_write(path, &picture, &(struct rg_write_options){0}));
    rg_picture_destroy(&picture);
    expect_refused(path, "48x32");
    unlink(path);
}

// --- cube maps ---

enum { SIZE = 32 };

static void test_locating_inverts_direction(void **state)
{
    (void)state;
    for (int face = 0; face < 6; face++) {
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                double d[3];
                rg_cube_direction(face, x, y, SIZE, d);
                const cube_point c =
                    cube_locate(v3_make((float)d[0] * 3, (float)d[1] * 3, (float)d[2] * 3), SIZE);
                assert_int_equal(c.face, face);
                assert_int_equal(cube_texel(c.x, SIZE), x);
                assert_int_equal(cube_texel(c.y, SIZE), y);
                assert_below(fabs((double)c.x - (x + 0.5)), 1e-5);
                assert_below(fabs((double)c.y - (y + 0.5)), 1e-5);
            }
        }
    }
}

// Axes, edges and corners of the cube each fall on a texel of a face.
static void test_seams_are_on_a_face(void **state)
{
    (void)state;
    for (int i = 0; i < 27; i++) {
        const v3 d = v3_make((float)(i % 3 - 1), (float)(i / 3 % 3 - 1), (float)(i / 9 - 1));
        if (i == 13)
            continue; // not a direction
        const cube_point c = cube_locate(d, SIZE);
        const float along[6] = {d.x, -d.x, d.y, -d.y, d.z, -d.z};
        assert_between(c.face, 0, 5);
        assert_equals(along[c.face], 1.0f);
        assert_between(cube_texel(c.x, SIZE), 0, SIZE - 1);
        assert_between(cube_texel(c.y, SIZE), 0, SIZE - 1);
    }
}

// Light that differs in every direction and changes by at most 1 a radian.
static void unit_light(const double d[3], const void *user, double light[3])
{
    (void)user;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++)
        light[i] = 2 + d[i] / length;
}

// Made as a file is read: faces alone, then borders from the neighbours.
static struct rg_environment *make_closed(void)
{
    struct rg_environment *environment = rg_environment_create(SIZE);
    rg_environment_fill(environment, unit_light, NULL);
    for (int face = 0; face < 6; face++)
        for (int y = -1; y <= SIZE; y++)
            for (int x = -1; x <= SIZE; x++)
                if (x < 0 || y < 0 || x == SIZE || y == SIZE)
                    rg_environment_texel(environment, face, x, y)[0] = -1000;
    rg_environment_close_borders(environment);
    return environment;
}

static void test_borders_come_from_the_neighbour(void **state)
{
    (void)state;
    struct rg_environment *environment = make_closed();
    for (int face = 0; face < 6; face++) {
        for (int y = -1; y <= SIZE; y++) {
            for (int x = -1; x <= SIZE; x++) {
                double d[3], light[3];
                rg_cube_direction(face, x, y, SIZE, d);
                unit_light(d, NULL, light);
                // A border's texel is the neighbour's nearest one, at most a texel away: 2 / SIZE.
                for (int c = 0; c < 3; c++)
                    assert_below(
                        fabs((double)rg_environment_texel(environment, face, x, y)[c] - light[c]),
                        2.0 / SIZE);
            }
        }
    }
    rg_environment_destroy(environment);
}

static double red_of(uint32_t texel)
{
    return ldexp(64 + (texel & 63), (int)(texel >> 6 & 31) - 21);
}

// The outermost texels of a packed face hold the light of the cube's edge itself, so that both
// faces agree. Half a texel beside it the light differs by up to 1/PX.
static void test_packed_faces_end_on_the_edges(void **state)
{
    (void)state;
    enum { PX = 6 };
    struct rg_environment *environment = rg_environment_create(SIZE);
    rg_environment_fill(environment, unit_light, NULL);
    uint32_t(*faces)[PX * PX] = malloc(6 * sizeof(*faces));
    assert_true(rg_environment_pack(environment, PX, faces[0]));
    for (int face = 0; face < 6; face++) {
        for (int i = 0; i < PX * PX; i++) {
            // Extrapolates from the centres of a face of four texels.
            double corner[3], next[3], down[3], d[3], light[3];
            const double x = (double)(i % PX) / (PX - 1), y = (double)(i / PX) / (PX - 1);
            rg_cube_direction(face, 0, 0, 2, corner);
            rg_cube_direction(face, 1, 0, 2, next);
            rg_cube_direction(face, 0, 1, 2, down);
            for (int c = 0; c < 3; c++)
                d[c] = corner[c] + (next[c] - corner[c]) * (2 * x - 0.5) +
                       (down[c] - corner[c]) * (2 * y - 0.5);
            unit_light(d, NULL, light);
            // Red has 6 bits, dithered, and is the mean of a few texels of the map.
            if (fabs(red_of(faces[face][i]) - light[0]) > 1.0 / 32 + 0.01)
                fail_msg("face %d, texel %d: %g, not %g", face, i, red_of(faces[face][i]),
                         light[0]);
        }
    }
    free(faces);
    rg_environment_destroy(environment);
}

// Stripes of one texel have no mean but between two: a map twice as large as wanted is halved, a
// smaller one is not, and what was halved is halved on.
static void test_a_map_twice_as_large_is_halved(void **state)
{
    (void)state;
    enum { PX = 8 };
    struct rg_environment *environment = rg_environment_create(2 * PX), *halved = NULL;
    uint32_t texels[6 * PX * PX];
    for (int i = 0; i < 6 * 2 * PX * 2 * PX; i++)
        for (int c = 0; c < 3; c++)
            rg_environment_texel(environment, i / (4 * PX * PX), i % (2 * PX),
                                 i / (2 * PX) % (2 * PX))[c] = 2 * (i & 1);
    assert_true(rg_environment_halve_to(environment, PX + 1, &halved));
    assert_null(halved);
    for (int px = PX; px >= PX / 2; px /= 2) {
        assert_true(rg_environment_halve_to(environment, px, &halved));
        assert_int_equal(halved->size, px);
        assert_float_equal(rg_environment_texel(halved, 1, 2, 3)[0], 1, 0);
    }
    assert_true(rg_environment_pack(environment, PX, texels));
    for (int i = 0; i < PX * PX; i++) // the borders between faces were not set
        if (i % PX > 0 && i % PX < PX - 1 && i / PX > 0 && i / PX < PX - 1)
            assert_below(fabs(red_of(texels[i]) - 1), 1.0 / 32);
    rg_environment_destroy(halved);
    rg_environment_destroy(environment);
}

// Along all 12 edges, texels on both sides are as near to the light as any within a face.
static void test_light_is_smooth_across_edges(void **state)
{
    (void)state;
    enum { PX = 64 };
    struct rg_environment *environment = make_closed();
    uint32_t(*faces)[PX * PX] = malloc(6 * sizeof(*faces));
    rg_environment_pack(environment, PX, faces[0]);
    for (int edge = 0; edge < 12; edge++) {
        const int axis = edge % 3; // the edge runs along it
        for (int i = 0; i < 200; i++) {
            for (int side = 0; side < 2; side++) {
                float d[3];
                d[axis] = (float)i / 100.5f - 0.99f;
                d[(axis + 1) % 3] = (edge / 3 & 1 ? 1.0f : -1.0f) * (side ? 1.001f : 0.999f);
                d[(axis + 2) % 3] = edge / 6 ? 1.0f : -1.0f;
                const cube_point c = cube_locate(v3_make(d[0], d[1], d[2]), PX);
                const int first = 2 * (side ? (axis + 1) % 3 : (axis + 2) % 3);
                assert_int_equal(c.face & ~1, first);
                const uint32_t texel =
                    faces[c.face][cube_texel(c.y, PX) * PX + cube_texel(c.x, PX)];
                double wide[3] = {(double)d[0], (double)d[1], (double)d[2]}, light[3];
                unit_light(wide, NULL, light);
                // RG11B10F keeps 6 bits of red and green: 1/32 at 2 to 3, dithered either way.
                assert_below(fabs(red_of(texel) - light[0]), 2.0 / SIZE + 1.0 / 32);
            }
        }
    }
    free(faces);
    rg_environment_destroy(environment);
}

// --- out of focus ---

// Half of all directions is lit: those on one side of a plane.
static void half_light(const double d[3], const void *user, double light[3])
{
    const double *axis = user;
    const double along = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
    for (int i = 0; i < 3; i++)
        light[i] = along > 0 ? i + 1 : 0;
}

// The part of a unit disc that lies beyond a chord at this distance from its middle.
static double beyond_chord(double distance)
{
    const double at = fmin(fmax(distance, -1), 1);
    return (acos(at) - at * sqrt(1 - at * at)) / M_PI;
}

// Each direction sees the lit part of its disc, also over edges and corners of the cube. A disc has
// 29 to 256 samples, each between four texels: the error is up to 1 in 29, and half a texel.
static void test_a_disc_around_each_direction(void **state)
{
    (void)state;
    const double axis[3] = {0.48, 0.6, 0.64};
    for (double diameter = 0.08; diameter < 0.7; diameter *= 2) {
        struct rg_environment *sharp = rg_environment_create(96);
        assert_non_null(sharp);
        rg_environment_fill(sharp, half_light, axis);
        struct rg_environment *seen = rg_environment_blur(sharp, diameter);
        assert_non_null(seen);
        assert_between(seen->size, diameter < 0.2 ? 96 : 24, 96);
        for (int i = 0; i < 6 * seen->size * seen->size; i++) {
            const int x = i % seen->size, y = i / seen->size % seen->size;
            const int face = i / (seen->size * seen->size);
            double d[3];
            rg_cube_direction(face, x, y, seen->size, d);
            const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            const double along = (d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]) / length;
            const double due = beyond_chord(-tan(asin(along)) / tan(diameter / 2));
            const double texels = diameter * seen->size / (M_PI / 2);
            const double off = 1.0 / fmin(texels * texels, 29) + 0.6 / texels;
            const float *found = rg_environment_texel(seen, face, x, y);
            for (int c = 0; c < 3; c++)
                if (fabs((double)found[c] - due * (c + 1)) > off * (c + 1))
                    fail_msg("disc of %g, face %d, texel %d %d: %g, not %g", diameter, face, x, y,
                             (double)found[c], due * (c + 1));
        }
        rg_environment_destroy(seen);
        rg_environment_destroy(sharp);
    }
}

// --- lat-long pictures ---

// The light in the middle of a face.
static void middle_of(const struct rg_environment *environment, int face, float light[3])
{
    const int half = environment->size / 2;
    memcpy(light, rg_environment_texel(environment, face, half, half), 3 * sizeof(float));
}

// The picture's middle is at -z, its right half towards +x, its top towards +y.
static void test_a_lat_long_lies_as_it_should(void **state)
{
    (void)state;
    enum { WIDE = 64, HIGH = 32 };
    static const float due[6][3] = {{1, -1, -1}, {0, -1, -1}, {-1, 1, -1},
                                    {-1, 0, -1}, {-1, -1, 0}, {-1, -1, 1}}; // -1: either
    struct rg_picture picture;
    const char *path = in_folder("around.exr");
    assert_true(rg_picture_create(&picture, WIDE, HIGH, 3, "around"));
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++) {
            float *texel = picture.texels + ((size_t)y * WIDE + (size_t)x) * 3;
            texel[0] = x >= WIDE / 2;
            texel[1] = y < HIGH / 2;
            texel[2] = x >= WIDE / 4 && x < WIDE * 3 / 4;
        }
    assert_true(rg_picture_write(path, &picture, &(struct rg_write_options){0}));
    rg_picture_destroy(&picture);
    struct rg_environment *environment = rg_environment_load(path, 64);
    assert_non_null(environment);
    for (int face = 0; face < 6; face++) {
        float light[3];
        middle_of(environment, face, light);
        for (int c = 0; c < 3; c++)
            assert_true(due[face][c] < 0 || light[c] == due[face][c]);
    }
    rg_environment_destroy(environment);
    assert_int_equal(unlink(path), 0);
}

// The picture wraps around at its sides, and its rows lie evenly about the horizon.
static void test_a_lat_long_is_read_between_texels(void **state)
{
    (void)state;
    enum { WIDE = 32, HIGH = 16 };
    struct rg_picture picture;
    const char *path = in_folder("even.exr");
    assert_true(rg_picture_create(&picture, WIDE, HIGH, 3, "even"));
    for (int i = 0; i < WIDE * HIGH; i++) {
        picture.texels[3 * i] = ((float)(i % WIDE) + 0.5f) / WIDE;
        picture.texels[3 * i + 1] = ((float)(i / WIDE) + 0.5f) / HIGH;
        picture.texels[3 * i + 2] = 0;
    }
    assert_true(rg_picture_write(path, &picture, &(struct rg_write_options){.full_float = true}));
    rg_picture_destroy(&picture);
    struct rg_environment *environment = rg_environment_load(path, 64);
    assert_non_null(environment);
    const int half = environment->size / 2;
    // The picture's sides meet at +z: a texel beside that edge mixes both columns.
    for (int x = half - 1; x <= half; x++) {
        const float red = rg_environment_texel(environment, 4, x, half)[0];
        assert_above(red, 0.05f);
        assert_below(red, 0.95f);
    }
    for (int face = 4; face < 6; face++) {
        const float above = rg_environment_texel(environment, face, half, half - 1)[1];
        const float below = rg_environment_texel(environment, face, half, half)[1];
        assert_below(above, below);
        assert_below(fabsf(above + below - 1), 1e-3f);
    }
    rg_environment_destroy(environment);
    assert_int_equal(unlink(path), 0);
}

// --- packing ---

// Light between two codes is dithered to one or the other, so that the mean is right. Half a code
// is 0.004 here.
static void test_packing_is_right_on_average(void **state)
{
    (void)state;
    enum { PX = 64 };
    static uint32_t words[6 * PX * PX];
    const double light = 0.5 + 0.5 / 128;
    struct rg_environment *environment = rg_environment_create(16);
    assert_non_null(environment);
    for (int i = 0; i < 6 * 18 * 18 * 3; i++)
        environment->light[i] = (float)light;
    assert_true(rg_environment_pack(environment, PX, words));
    double sums[3] = {0};
    for (int i = 0; i < 6 * PX * PX; i++) {
        const rgba c = rg_load_RG11B10F(words, i);
        sums[0] += (double)c.r;
        sums[1] += (double)c.g;
        sums[2] += (double)c.b;
    }
    for (int c = 0; c < 3; c++)
        assert_below(fabs(sums[c] / (6 * PX * PX) - light), 5e-4);
    rg_environment_destroy(environment);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_good_ktx_is_read),
        cmocka_unit_test(test_truncated_ktx),
        cmocka_unit_test(test_wrong_ktx),
        cmocka_unit_test(test_what_is_no_file),
        cmocka_unit_test(test_a_lat_long_of_the_wrong_shape),
        cmocka_unit_test(test_locating_inverts_direction),
        cmocka_unit_test(test_seams_are_on_a_face),
        cmocka_unit_test(test_borders_come_from_the_neighbour),
        cmocka_unit_test(test_packed_faces_end_on_the_edges),
        cmocka_unit_test(test_a_map_twice_as_large_is_halved),
        cmocka_unit_test(test_light_is_smooth_across_edges),
        cmocka_unit_test(test_a_disc_around_each_direction),
        cmocka_unit_test(test_a_lat_long_lies_as_it_should),
        cmocka_unit_test(test_a_lat_long_is_read_between_texels),
        cmocka_unit_test(test_packing_is_right_on_average),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
