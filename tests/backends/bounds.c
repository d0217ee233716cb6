// Bounds of draws of fixed functions, without a driver: the oracles against values worked out by
// hand, and each draw's bounds against pictures that break them by one step.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "shaders/fixed/bounds/bounds.h"
#include "shaders/fixed/bounds/scene.h"
#include "tests/tools/expect.h"

static const struct rg_fixed_precision fine = {
    .subpixel_bits = 8,
    .subtexel_bits = 8,
    .mip_bits = 8,
    .has_places = true,
    .places = {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}},
};

static void assert_span(struct rg_span a, double low, double high)
{
    const double slack = 1e-5;
    if (fabs(a.low - low) > slack || fabs(a.high - high) > slack)
        fail_msg("%.9g to %.9g, and not %.9g to %.9g", a.low, a.high, low, high);
}

// --- formats ---

static void either_neighbour_of_a_value_is_allowed(void **state)
{
    (void)state;
    assert_span(rg_span_scale(rg_round_unorm(rg_span_at(0.5), 8), 255), 127, 128);
    assert_span(rg_span_scale(rg_round_unorm(rg_span_at(17 / 255.0), 8), 255), 17, 17);
    assert_span(rg_round_unorm((struct rg_span){-3, 2}, 8), 0, 1);
    assert_span(rg_span_scale(rg_round_unorm(rg_span_at(0.1), 10), 1023), 102, 103);
    assert_span(rg_span_scale(rg_round_depth(RG_FIXED_D16, rg_span_at(0.3)), 65535), 19660, 19661);
    const struct rg_span third = rg_round_colour(RG_FIXED_RGBA16F, rg_span_at(1 / 3.0));
    assert_equals(third.low, 1365 / 4096.0);
    assert_equals(third.high, 1366 / 4096.0);
    assert_span(rg_round_float(rg_span_at(-0.75), 10, -14), -0.75, -0.75);
    const struct rg_span tiny = rg_round_float(rg_span_at(ldexp(1.5, -24)), 10, -14);
    assert_true(tiny.low == ldexp(1, -24) && tiny.high == ldexp(2, -24));
    const struct rg_span tenth = rg_round_colour(RG_FIXED_RGBA32F, rg_span_at(0.1));
    assert_true((double)(float)tenth.low == tenth.low && (double)(float)tenth.high == tenth.high);
    assert_true(tenth.low < 0.1 && tenth.high > 0.1 && tenth.high - tenth.low < 1e-8);
}

// --- coverage ---

static struct rg_scene *scene; // of a plain state

static const struct rg_fixed_state plain = {0};

static int begin(void **state)
{
    (void)state;
    scene = calloc(1, sizeof(*scene));
    if (!scene)
        return -1;
    scene->state = &plain;
    scene->precision = &fine;
    scene->grid = 1 / 256.0;
    scene->sample_count = 1;
    return 0;
}

static int end(void **state)
{
    (void)state;
    free(scene);
    return 0;
}

// A corner at a pixel of the 64 x 64.
static struct rg_corner corner(double x, double y, double w, double value)
{
    return (struct rg_corner){.place = {(x / 32 - 1) * w, (y / 32 - 1) * w, 0.5 * w, w},
                              .colour = {value, value, value, value},
                              .cut = 1};
}

static struct rg_primitive triangle(struct rg_corner a, struct rg_corner b, struct rg_corner c)
{
    return (struct rg_primitive){.count = 3, .corners = {a, b, c}};
}

// Half a square of 20 pixels.
static struct rg_primitive half_square(void)
{
    return triangle(corner(10, 10, 1, 0), corner(30, 10, 1, 1), corner(10, 30, 1, 0));
}

static void places_near_an_edge_may_be_covered(void **state)
{
    (void)state;
    static const struct {
        double x, y;
        enum rg_cover cover;
    } rows[] = {
        {10.5, 10.5, RG_COVER_YES},  {12.5, 20.5, RG_COVER_YES},   {9.5, 20.5, RG_COVER_NO},
        {20, 20, RG_COVER_MAYBE},    {20.5, 20.5, RG_COVER_NO},    {19.5, 19.5, RG_COVER_YES},
        {10, 15, RG_COVER_MAYBE},    {10.003, 15, RG_COVER_MAYBE}, {10.005, 15, RG_COVER_YES},
        {9.997, 15, RG_COVER_MAYBE}, {9.995, 15, RG_COVER_NO},     {31, 10.002, RG_COVER_NO},
    };
    struct rg_primitive both[2] = {half_square(), half_square()};
    both[1].corners[1] = both[0].corners[2];
    both[1].corners[2] = both[0].corners[1];
    for (int turned = 0; turned < 2; turned++) {
        struct rg_outline outline;
        assert_true(rg_outline_of(scene, &both[turned], &outline));
        assert_int_equal(outline.facing, turned ? -1 : 1);
        for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
            assert_int_equal(rg_outline_cover(&outline, rows[i].x, rows[i].y), rows[i].cover);
    }
}

// Depth from 0.5 w to behind the far plane: half of the triangle is cut off.
static void what_lies_outside_is_clipped(void **state)
{
    (void)state;
    struct rg_outline outline;
    struct rg_primitive cut = half_square();
    cut.corners[1].place[2] = 1.5;
    assert_true(rg_outline_of(scene, &cut, &outline));
    assert_int_equal(outline.count, 4);
    assert_int_equal(rg_outline_cover(&outline, 19.5, 12), RG_COVER_YES);
    assert_int_equal(rg_outline_cover(&outline, 20, 12), RG_COVER_MAYBE);
    assert_int_equal(rg_outline_cover(&outline, 20.5, 12), RG_COVER_NO);
    for (int i = 0; i < 3; i++)
        cut.corners[i].cut = -1;
    assert_false(rg_outline_of(scene, &cut, &outline));
}

// --- attributes ---

static void values_are_those_of_the_plane(void **state)
{
    (void)state;
    static const double values[] = {0, 1, 0}, depths[] = {0.25, 0.75, 0.25};
    struct rg_plane plane;
    const struct rg_primitive flat = half_square();
    assert_true(rg_plane_of(scene, &flat, scene->grid, &plane));
    // 1 / 20 a pixel, so that a step of the grid is 1 / 5120.
    assert_span(rg_plane_value(&plane, values, 15, 12, 0, true), 0.25 - 1 / 5120.0,
                0.25 + 1 / 5120.0);
    assert_span(rg_plane_value(&plane, values, 10, 12, 0, true), 0, 1 / 5120.0);
    assert_span(rg_plane_value(&plane, values, 15, 12, 0.5, true), 0.225 - 1 / 5120.0,
                0.275 + 1 / 5120.0);
    assert_span(rg_plane_affine(&plane, depths, 20, 12, 0), 0.5 - 0.5 / 5120, 0.5 + 0.5 / 5120);
    assert_span(rg_plane_step(&plane, values, 15, 12, false), 0.05 - 0.1 / 256, 0.05 + 0.1 / 256);
    assert_span(rg_plane_step(&plane, values, 15, 12, true), -0.1 / 256, 0.1 / 256);
    // From w 1 to w 3 the middle of the screen has a quarter of the far value.
    const struct rg_primitive deep =
        triangle(corner(10, 10, 1, 0), corner(30, 10, 3, 1), corner(10, 30, 1, 0));
    assert_true(rg_plane_of(scene, &deep, 1e-9, &plane));
    assert_span(rg_plane_value(&plane, values, 20, 10, 0, true), 0.25, 0.25);
    const struct rg_primitive none =
        triangle(corner(10, 10, 1, 0), corner(20, 20, 1, 1), corner(30, 30, 1, 0));
    assert_false(rg_plane_of(scene, &none, scene->grid, &plane));
}

// Depth rises by 1/40 a pixel in x: slope factor 1, and 2 units of 2^-24 for depths below 1.
static void an_offset_is_slope_and_units(void **state)
{
    (void)state;
    static const struct rg_fixed_state offset = {
        .depth = RG_FIXED_D32F, .offset_slope_16 = 16, .offset_units = 2};
    struct rg_primitive sloped = half_square();
    sloped.corners[1].place[2] = 0.75;
    sloped.corners[0].place[2] = sloped.corners[2].place[2] = 0.25;
    scene->state = &offset;
    const struct rg_span exact = rg_plane_offset(scene, &sloped, 0);
    const struct rg_span snapped = rg_plane_offset(scene, &sloped, scene->grid);
    scene->state = &plain;
    assert_span(exact, 1 / 40.0, 1 / 40.0);
    assert_true(snapped.low < exact.low && snapped.high > exact.high);
    assert_below(snapped.high - snapped.low, 1e-4);
}

// --- texels ---

// A sampler of a state whose level 0 has codes 0 and 255 alternating in x.
static void make_stripes(const struct rg_fixed_state *state)
{
    scene->state = state;
    rg_scene_texture(scene);
    for (int i = 0; i < RG_FIXED_TEXTURE_PX * RG_FIXED_TEXTURE_PX; i++)
        for (int c = 0; c < 4; c++)
            scene->texture.texels[0][0][i][c] = rg_span_at(i % 2);
}

static struct rg_span look(double u)
{
    struct rg_span out[4];
    rg_texture_look(scene, rg_span_at(u / RG_FIXED_TEXTURE_PX), rg_span_at(0.25), 0, 0, out);
    return out[2];
}

static void weights_of_a_filter_are_a_step_off(void **state)
{
    (void)state;
    static const struct rg_fixed_state linear = {.texels = RG_FIXED_TEXELS_RGBA8,
                                                 .mag = RG_FIXED_LINEAR,
                                                 .min = RG_FIXED_LINEAR,
                                                 .wrap_u = RG_FIXED_BORDER,
                                                 .border = RG_FIXED_WHITE};
    const double step = 1 / 256.0, mixes = 1 / 255.0; // two, each rounded to a code
    make_stripes(&linear);
    assert_span(look(4.75), 0.25 - step - mixes, 0.25 + step + mixes);
    assert_span(look(4.5), 0, step + mixes); // at a texel's centre
    assert_span(look(31.5), 1 - step - mixes, 1);
    assert_span(look(0), 0.5 - step - mixes, 0.5 + step + mixes); // half of the border
    static const struct rg_fixed_state nearest = {.texels = RG_FIXED_TEXELS_RGBA8,
                                                  .wrap_u = RG_FIXED_MIRROR};
    make_stripes(&nearest);
    assert_span(look(5.25), 1, 1);
    assert_span(look(32.5), 1, 1); // 31 once more
    assert_span(look(-1.5), 1, 1); // 1
    struct rg_span out[4];
    rg_texture_look(scene, (struct rg_span){4.9 / 32, 5.1 / 32}, rg_span_at(0.25), 0, 0, out);
    assert_span(out[0], 0, 1);
    scene->state = &plain;
}

static void four_texels_are_gathered_or_compared(void **state)
{
    (void)state;
    static const struct rg_fixed_state shadow = {.texels = RG_FIXED_TEXELS_D32F,
                                                 .compare = RG_FIXED_LESS};
    struct rg_span out[4];
    make_stripes(&shadow);
    rg_texture_gather(scene, rg_span_at(5 / 32.0), rg_span_at(0.26), 1, out);
    for (int i = 0; i < 4; i++) // columns 4, 5, 5, 4
        assert_span(out[i], i == 1 || i == 2, i == 1 || i == 2);
    assert_span(rg_texture_compare(scene, rg_span_at(5 / 32.0), rg_span_at(0.26), rg_span_at(0.5)),
                0, 1);
    assert_span(rg_texture_compare(scene, rg_span_at(5 / 32.0), rg_span_at(0.26), rg_span_at(1)), 0,
                0);
    assert_span(rg_texture_compare(scene, rg_span_at(5 / 32.0), rg_span_at(0.26), rg_span_at(-1)),
                1, 1);
    scene->state = &plain;
}

// Level 0 is black and level 1 white.
static void levels_are_mixed_by_the_lod(void **state)
{
    (void)state;
    static const struct rg_fixed_state trilinear = {
        .texels = RG_FIXED_TEXELS_SRGB8, .mip = RG_FIXED_MIP_LINEAR, .bias_16 = 4};
    static const struct rg_fixed_state near = {
        .texels = RG_FIXED_TEXELS_SRGB8, .mip = RG_FIXED_MIP_NEAREST, .lod_most_16 = 14};
    const struct rg_span at = rg_span_at(0.26);
    struct rg_span out[4];
    make_stripes(&trilinear);
    for (int i = 0; i < RG_FIXED_TEXTURE_PX * RG_FIXED_TEXTURE_PX; i++)
        for (int level = 0; level < 2; level++)
            scene->texture.texels[0][level][i][0] = rg_span_at(level);
    rg_texture_look_lod(scene, at, at, rg_span_at(0.5), out);
    const double error = 1 / 64.0 + 1 / 256.0; // of the logarithm, and a step
    assert_span(out[0], 0.75 - error, 0.75 + error);
    scene->state = &near;
    rg_texture_look_lod(scene, at, at, rg_span_at(7), out); // held to 0.875
    assert_span(out[0], 1, 1);
    rg_texture_look_lod(scene, at, at, rg_span_at(0.5), out);
    assert_span(out[0], 0, 1);
    rg_texture_look_lod(scene, at, at, rg_span_at(0.25), out);
    assert_span(out[0], 0, 0);
    scene->state = &plain;
}

static struct rg_span face(int face_, double x, double y, double z, bool in_v)
{
    const struct rg_span direction[] = {rg_span_at(x), rg_span_at(y), rg_span_at(z)};
    struct rg_span u = {-1, -1}, v = {-1, -1};
    rg_cube_place(direction, face_, &u, &v);
    return in_v ? v : u;
}

static void faces_of_a_cube_meet_at_their_edges(void **state)
{
    (void)state;
    static const struct rg_fixed_state cube = {.texels = RG_FIXED_TEXELS_RGBA8,
                                               .texture = RG_FIXED_CUBE};
    const struct rg_texture *texture = &scene->texture;
    assert_span(face(0, 2, 1, -1, false), 0.75, 0.75); // s is -z, t is -y
    assert_span(face(0, 2, 1, -1, true), 0.25, 0.25);
    assert_span(face(3, 0.5, -2, 1, true), 0.25, 0.25); // t is -z
    assert_span(face(4, 2, 1, -1, false), -1, -1);      // another face
    assert_span(face(2, 1, 1, 0, false), 1, 1);         // an edge is of both faces
    assert_span(face(0, 1, 1, 0, true), 0, 0);
    scene->state = &cube;
    rg_scene_texture(scene);
    scene->state = &plain;
    assert_ptr_equal(rg_cube_texel(texture, 1, 3, 4), texture->texels[1][0][4 * 32 + 3]);
    assert_ptr_equal(rg_cube_texel(texture, 0, 32, 7), texture->texels[5][0][7 * 32]);
    assert_ptr_equal(rg_cube_texel(texture, 0, -1, 7), texture->texels[4][0][7 * 32 + 31]);
    assert_ptr_equal(rg_cube_texel(texture, 1, 32, 7), texture->texels[4][0][7 * 32]);
    assert_ptr_equal(rg_cube_texel(texture, 2, 9, 32), texture->texels[4][0][9]);
    assert_ptr_equal(rg_cube_texel(texture, 2, 9, -1), texture->texels[5][0][31 - 9]);
    // Where x, y and -z meet.
    const double a = texture->texels[0][0][31][0].low, b = texture->texels[5][0][0][0].low,
                 c = texture->texels[2][0][31][0].low;
    assert_span(rg_cube_texel(texture, 0, 32, -1)[0], fmin(fmin(a, b), c), fmax(fmax(a, b), c));
}

// --- compressed texels ---

static void decode(enum rg_fixed_texels texels, const uint8_t *block, int x, int y,
                   struct rg_span out[4])
{
    static uint8_t blocks[64 * 16];
    static struct rg_span all[RG_FIXED_TEXTURE_PX * RG_FIXED_TEXTURE_PX][4];
    memcpy(blocks, block, texels == RG_FIXED_TEXELS_BC3 ? 16 : 8);
    rg_decode_blocks(texels, blocks, all);
    memcpy(out, all[y * RG_FIXED_TEXTURE_PX + x], 4 * sizeof(*out));
}

static void blocks_of_bc_are_decoded(void **state)
{
    (void)state;
    struct rg_span out[4];
    const double code = 1 / 255.0, mixed = code + 0.03; // of colours that are 1 apart
    // Red 31 and blue 31, with indices 0 to 3 in the first row and 3 in the second.
    const uint8_t four[] = {0x00, 0xf8, 0x1f, 0x00, 0xe4, 0xff, 0, 0};
    decode(RG_FIXED_TEXELS_BC1, four, 0, 0, out);
    assert_span(out[0], 1 - code, 1);
    assert_span(out[2], 0, code);
    decode(RG_FIXED_TEXELS_BC1, four, 2, 0, out); // a third of the second
    assert_span(out[0], 2 / 3.0 - mixed, 2 / 3.0 + mixed);
    assert_span(out[2], 1 / 3.0 - mixed, 1 / 3.0 + mixed);
    decode(RG_FIXED_TEXELS_BC1, four, 0, 1, out);
    assert_span(out[0], 1 / 3.0 - mixed, 1 / 3.0 + mixed);
    assert_span(out[3], 1, 1);
    const uint8_t three[] = {0x1f, 0x00, 0x00, 0xf8, 0xe4, 0, 0, 0};
    decode(RG_FIXED_TEXELS_BC1, three, 2, 0, out);
    assert_span(out[0], 0.5 - mixed, 0.5 + mixed);
    decode(RG_FIXED_TEXELS_BC1, three, 3, 0, out);
    assert_span(out[3], 0, 0);
    // Alphas 210 and 0, of which index 2 is 180; then 0 and 200 with a step of 40, and 255.
    const uint8_t alpha[] = {210, 0, 2, 0, 0, 0, 0, 0, 0x1f, 0x00, 0x00, 0xf8, 0xff, 0, 0, 0};
    decode(RG_FIXED_TEXELS_BC3, alpha, 0, 0, out);
    assert_span(out[3], 179 / 255.0, 181 / 255.0);
    assert_span(out[0], 2 / 3.0 - mixed, 2 / 3.0 + mixed); // always of four
    const uint8_t few[] = {0, 200, 3 | 7 << 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    decode(RG_FIXED_TEXELS_BC3, few, 0, 0, out);
    assert_span(out[3], 79 / 255.0, 81 / 255.0);
    decode(RG_FIXED_TEXELS_BC3, few, 1, 0, out);
    assert_span(out[3], 1, 1);
}

// As GPUs of NVIDIA and of AMD mix green, by the decoders of Rich Geldreich's rgbcx.
static void blocks_of_bc_are_decoded_as_by_gpus(void **state)
{
    (void)state;
    for (int i = 0; i < 64 * 64; i++) {
        const int g = i / 64, h = i % 64, first = g << 2 | g >> 4, second = h << 2 | h >> 4;
        const int a = 31 << 11 | g << 5, b = h << 5, apart = second - first;
        const uint8_t block[] = {a & 255, a >> 8, b & 255, b >> 8, 0xe4, 0, 0, 0};
        const int mixed[] = {(256 * first + apart / 4 + 128 + apart * 80) / 256,
                             (43 * first + 21 * second + 32) >> 6};
        struct rg_span out[4];
        decode(RG_FIXED_TEXELS_BC1, block, 2, 0, out);
        for (int k = 0; k < 2; k++) {
            assert_at_least(mixed[k], floor(out[1].low * 255));
            assert_at_most(mixed[k], ceil(out[1].high * 255));
        }
    }
}

static void assert_etc2(const uint8_t block[8], int x, int y, int r, int g, int b)
{
    struct rg_span out[4];
    const int due[] = {r, g, b, 255};
    decode(RG_FIXED_TEXELS_ETC2, block, x, y, out);
    for (int c = 0; c < 4; c++)
        assert_span(rg_span_scale(out[c], 255), due[c], due[c]);
}

static void blocks_of_etc2_are_decoded(void **state)
{
    (void)state;
    // Two colours side by side; the first texel is of index 3.
    assert_etc2((const uint8_t[]){0x12, 0x34, 0x56, 0, 0, 1, 0, 1}, 0, 0, 9, 43, 77);
    assert_etc2((const uint8_t[]){0x12, 0x34, 0x56, 0, 0, 1, 0, 1}, 3, 0, 36, 70, 104);
    // Differences 1, -1 and 0, one above the other, with tables 0 and 1.
    const uint8_t above[] = {0x41, 0x47, 0x40, 0x07, 0, 0, 0, 0};
    assert_etc2(above, 0, 0, 68, 68, 68);
    assert_etc2(above, 0, 3, 79, 62, 71);
    // T: red runs over. Colours 1, 2, 3 and 4, 5, 6; distance 6.
    const uint8_t t[] = {0x05, 0x23, 0x45, 0x63, 0, 0, 0, 1};
    assert_etc2(t, 1, 0, 17, 34, 51);
    assert_etc2(t, 0, 0, 74, 91, 108);
    // Planar: blue runs over; all three colours are the origin's.
    const uint8_t planar[] = {0, 0, 0x04, 0x02, 0, 0, 0, 0};
    assert_etc2(planar, 0, 0, 0, 0, 0);
    assert_etc2(planar, 3, 3, 0, 0, 0);
}

// --- tests and blending ---

static struct rg_sample clear_sample(void)
{
    struct rg_sample sample = {.depth = {0.5, 0.5}, .stencil = {1}};
    for (int c = 0; c < 4; c++)
        sample.colours[0][c] = rg_span_at(51 / 255.0);
    return sample;
}

static enum rg_cover merge(const struct rg_fixed_state *state, double depth, enum rg_cover cover,
                           struct rg_sample *sample)
{
    struct rg_fragment fragment = {.depth = rg_span_at(depth), .stays = RG_COVER_YES};
    for (int c = 0; c < 4; c++)
        fragment.colours[0][c] = fragment.second[c] = rg_span_at(102 / 255.0);
    scene->state = state;
    const enum rg_cover passes = rg_sample_merge(scene, &fragment, 1, cover, sample);
    scene->state = &plain;
    return passes;
}

static void fragments_are_tested(void **state)
{
    (void)state;
    static const struct rg_fixed_state tested = {.depth = RG_FIXED_D32F_S8,
                                                 .depth_test = RG_FIXED_LESS,
                                                 .stencil_front = RG_FIXED_DECREMENT};
    struct rg_sample sample = clear_sample();
    assert_int_equal(merge(&tested, 0.5, RG_COVER_YES, &sample), RG_COVER_NO);
    assert_span(sample.colours[0][0], 0.2, 0.2);
    assert_int_equal(merge(&tested, 0.25, RG_COVER_MAYBE, &sample), RG_COVER_MAYBE);
    assert_span(sample.depth, 0.25, 0.5);
    assert_span(sample.colours[0][0], 0.2, 0.4);
    assert_true(sample.stencil[0] == 1 && sample.stencil[3] == (uint64_t)1 << 63);
    assert_int_equal(merge(&tested, 0.375, RG_COVER_YES, &sample), RG_COVER_MAYBE);
    assert_int_equal(merge(&tested, 0.125, RG_COVER_YES, &sample), RG_COVER_YES);
    assert_span(sample.depth, 0.125, 0.125);
    assert_span(sample.colours[0][3], 0.4, 0.4);
    assert_true(sample.stencil[0] == 0 && sample.stencil[3] == (uint64_t)7 << 61);
}

// 0.4 x 0.4 + 0.2 x 0.6 are 40.8 and 30.6 codes, each of which may be rounded.
static void blending_rounds_as_finely_as_the_target(void **state)
{
    (void)state;
    static const struct rg_fixed_state codes = {.blend = RG_FIXED_BLEND_OVER};
    static const struct rg_fixed_state floats = {.blend = RG_FIXED_BLEND_SRC1_COLOUR,
                                                 .format = RG_FIXED_RGBA32F};
    static const struct rg_fixed_state masked = {.write_off = 5};
    struct rg_sample sample = clear_sample();
    merge(&codes, 0, RG_COVER_YES, &sample);
    assert_span(rg_span_scale(sample.colours[0][1], 255), 70, 72);
    sample = clear_sample();
    merge(&floats, 0, RG_COVER_YES, &sample);
    assert_span(sample.colours[0][1], 0.28, 0.28);
    sample = clear_sample();
    merge(&masked, 0, RG_COVER_YES, &sample);
    assert_span(sample.colours[0][0], 0.2, 0.2);
    assert_span(sample.colours[0][1], 0.4, 0.4);
}

// --- all draws ---

static void every_draw_has_its_sections_or_none(void **state)
{
    (void)state;
    int none = 0;
    for (int i = 0; i < rg_fixed_count(); i++)
        none += !rg_fixed_sections(rg_fixed_draws[i].feature);
    assert_int_equal(none, 2);
    assert_null(rg_fixed_sections("anisotropic"));
    assert_non_null(rg_fixed_sections("linear"));
}

static void faults_are_known_of_one_driver_up_to_a_number(void **state)
{
    (void)state;
    const char *draw = "centroid interpolation", *mesa = "llvmpipe (LLVM 15.0.6, 256 bits)";
    const struct rg_fixed_beyond few = {6, "colour 0", 0, 0, 0, 0, 0, 0, 0};
    const struct rg_fixed_beyond more = {7, "colour 0", 0, 0, 0, 0, 0, 0, 0};
    const struct rg_fixed_beyond none = {0, "colour 0", 0, 0, 0, 0, 0, 0, 0};
    const struct rg_fixed_beyond size = {1, "bytes", 0, 0, 0, 0, 0, 0, 0};
    assert_non_null(rg_fixed_known_fault(draw, mesa, &few));
    assert_null(rg_fixed_known_fault(draw, mesa, &more));
    assert_null(rg_fixed_known_fault(draw, mesa, &none));
    assert_null(rg_fixed_known_fault(draw, mesa, &size));
    assert_null(rg_fixed_known_fault(draw, "another", &few));
    assert_null(rg_fixed_known_fault("linear", mesa, &few));
}

// Bits of a non-negative value in a small float.
static uint32_t pack(double value, int mantissa_bits)
{
    int exponent;
    const double fraction = frexp(value, &exponent); // 0.5 to 1
    if (value == 0 || exponent - 1 < -14)
        return (uint32_t)ldexp(value, 14 + mantissa_bits);
    return (uint32_t)(exponent + 14) << mantissa_bits |
           (uint32_t)(ldexp(fraction, mantissa_bits + 1) - ldexp(1, mantissa_bits));
}

static size_t put(const struct rg_fixed_bounds_part *part, int i, double value, uint8_t *at)
{
    const int c = i % part->channels;
    const float real = (float)value;
    uint16_t word = (uint16_t)(part->numbers == RG_FIXED_HALVES
                                   ? pack(fabs(value), 10) | (value < 0 ? 0x8000 : 0)
                                   : value);
    uint32_t two = 0;
    const uint64_t four = part->numbers == RG_FIXED_COUNTS_64 ? (uint64_t)value : 0;
    switch (part->numbers) {
    case RG_FIXED_CODES_8:
        at[i] = (uint8_t)value;
        return (size_t)i + 1;
    case RG_FIXED_CODES_16:
    case RG_FIXED_HALVES:
        memcpy(at + (ptrdiff_t)2 * i, &word, 2);
        return 2 * ((size_t)i + 1);
    case RG_FIXED_FLOATS:
        memcpy(at + (ptrdiff_t)4 * i, &real, 4);
        return 4 * ((size_t)i + 1);
    case RG_FIXED_COUNTS_32:
        two = (uint32_t)value;
        memcpy(at + (ptrdiff_t)4 * i, &two, 4);
        return 4 * ((size_t)i + 1);
    case RG_FIXED_COUNTS_64:
        memcpy(at + (ptrdiff_t)8 * i, &four, 8);
        return 8 * ((size_t)i + 1);
    default:
        break;
    }
    uint8_t *texel = at + (ptrdiff_t)4 * (i / part->channels);
    const bool is_tens = part->numbers == RG_FIXED_TENS;
    const int shift = (is_tens ? 10 : 11) * c, bits = is_tens ? (c < 3 ? 10 : 2) : c < 2 ? 11 : 10;
    const uint32_t mask = ((1u << bits) - 1) << shift;
    memcpy(&two, texel, 4);
    two = (two & ~mask) | (is_tens ? (uint32_t)value : pack(value, c < 2 ? 6 : 5)) << shift;
    memcpy(texel, &two, 4);
    return 4 * ((size_t)(i / part->channels) + 1);
}

static int values_of(const struct rg_fixed_bounds_part *part)
{
    return part->layers * part->width * part->height * part->channels;
}

// A value one step beyond an interval.
static double beyond(const struct rg_fixed_bounds_part *part, int i)
{
    const struct rg_span a = part->values[i];
    const bool is_real = part->numbers == RG_FIXED_HALVES || part->numbers == RG_FIXED_FLOATS ||
                         part->numbers == RG_FIXED_ELEVENS;
    const int mantissa = part->numbers == RG_FIXED_FLOATS   ? 23
                         : part->numbers == RG_FIXED_HALVES ? 10
                         : i % part->channels < 2           ? 6
                                                            : 5;
    int exponent;
    frexp(a.high, &exponent);
    if (is_real)
        return a.high + ldexp(1, (exponent < -13 ? -13 : exponent) - 1 - mantissa + (a.high < 0));
    return a.low > 0 ? a.low - 1 : a.high + 1;
}

// A picture of the least values is within; with any part's value a step beyond, it is not.
static void each_draw_notices_one_step_beyond(void **state)
{
    (void)state;
    static uint8_t bytes[RG_FIXED_PICTURE_BYTES];
    int bounded = 0;
    for (int d = 0; d < rg_fixed_count(); d++) {
        if (!rg_fixed_sections(rg_fixed_draws[d].feature))
            continue;
        struct rg_fixed_bounds *bounds = rg_fixed_bounds_make(&rg_fixed_draws[d].state, &fine);
        struct rg_fixed_beyond told;
        size_t size = 0, starts[RG_FIXED_BOUNDS_PARTS];
        assert_non_null(bounds);
        memset(bytes, 0, sizeof(bytes));
        for (int p = 0; p < bounds->count; p++) {
            const struct rg_fixed_bounds_part *part = &bounds->parts[p];
            size_t used = 0;
            starts[p] = size;
            for (int i = 0; i < values_of(part); i++)
                used = put(part, i, part->values[i].low, bytes + size);
            size += used;
        }
        if (!rg_fixed_bounds_hold(bounds, bytes, size, &told)) {
            char text[RG_FIXED_BEYOND_TEXT];
            rg_fixed_beyond_tell(&told, text);
            fail_msg("%s: %s", rg_fixed_draws[d].feature, text);
        }
        assert_false(rg_fixed_bounds_hold(bounds, bytes, size - 1, &told));
        for (int p = 0; p < bounds->count; p++) {
            const struct rg_fixed_bounds_part *part = &bounds->parts[p];
            int i = values_of(part) * 5 / 9;
            while (part->numbers == RG_FIXED_CODES_8 && part->values[i].low == 0 &&
                   part->values[i].high == 255)
                i++;
            put(part, i, beyond(part, i), bytes + starts[p]);
            assert_false(rg_fixed_bounds_hold(bounds, bytes, size, &told));
            const int pixel = i / part->channels;
            assert_int_equal(told.count, 1);
            assert_string_equal(told.part, part->name);
            assert_int_equal(told.channel, i % part->channels);
            assert_int_equal((told.layer * part->height + told.y) * part->width + told.x, pixel);
            put(part, i, part->values[i].low, bytes + starts[p]);
        }
        rg_fixed_bounds_free(bounds);
        bounded++;
    }
    assert_int_equal(bounded, rg_fixed_count() - 2);
}

// Of a draw's first part, at least so many percent of the intervals are at most this wide.
static void bounds_are_narrow(void **state)
{
    (void)state;
    static const struct {
        const char *feature;
        double width;
        int percent;
    } rows[] = {{"nearest", 0, 70},
                {"linear", 5, 75},
                {"LOD bias and clamp", 6, 35},
                {"gather", 1, 98},
                {"BC1", 3, 75},
                {"ETC2", 0, 70},
                {"provoking vertex", 1, 98},
                {"cube seams", 5, 70},
                {"clipping", 1, 98},
                {"culling", 1, 95},
                {"points", 1, 95},
                {"scissor", 1, 98},
                {"vertex formats", 0.001, 98},
                {"depth test", 1, 94},
                {"blending RGBA16F", 0.01, 95},
                {"write mask", 1, 98},
                {"multisampling", 8, 70},
                {"blit", 3, 95},
                {"derivatives", 0.1, 90}};
    for (size_t r = 0; r < sizeof(rows) / sizeof(rows[0]); r++) {
        int d = 0, narrow = 0;
        while (strcmp(rg_fixed_draws[d].feature, rows[r].feature) != 0)
            d++;
        struct rg_fixed_bounds *bounds = rg_fixed_bounds_make(&rg_fixed_draws[d].state, &fine);
        assert_non_null(bounds);
        const struct rg_fixed_bounds_part *part = &bounds->parts[0];
        for (int i = 0; i < values_of(part); i++)
            narrow += part->values[i].high - part->values[i].low <= rows[r].width;
        if (narrow * 100 < rows[r].percent * values_of(part))
            fail_msg("%s: %d of %d are narrow", rows[r].feature, narrow, values_of(part));
        rg_fixed_bounds_free(bounds);
    }
}

static void what_is_beyond_is_told_in_one_line(void **state)
{
    (void)state;
    struct rg_fixed_beyond told = {3, "colour 0", 1, 2, 4, 3, 17, 20, 24};
    char text[RG_FIXED_BEYOND_TEXT];
    rg_fixed_beyond_tell(&told, text);
    assert_string_equal(
        text, "colour 0 at x 2, y 4, layer 1, channel 3 is 17, not from 20 to 24, and 2 more");
    told.count = 1;
    rg_fixed_beyond_tell(&told, text);
    assert_string_equal(text, "colour 0 at x 2, y 4, layer 1, channel 3 is 17, not from 20 to 24");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(either_neighbour_of_a_value_is_allowed),
        cmocka_unit_test(places_near_an_edge_may_be_covered),
        cmocka_unit_test(what_lies_outside_is_clipped),
        cmocka_unit_test(values_are_those_of_the_plane),
        cmocka_unit_test(an_offset_is_slope_and_units),
        cmocka_unit_test(weights_of_a_filter_are_a_step_off),
        cmocka_unit_test(four_texels_are_gathered_or_compared),
        cmocka_unit_test(levels_are_mixed_by_the_lod),
        cmocka_unit_test(faces_of_a_cube_meet_at_their_edges),
        cmocka_unit_test(blocks_of_bc_are_decoded),
        cmocka_unit_test(blocks_of_bc_are_decoded_as_by_gpus),
        cmocka_unit_test(blocks_of_etc2_are_decoded),
        cmocka_unit_test(fragments_are_tested),
        cmocka_unit_test(blending_rounds_as_finely_as_the_target),
        cmocka_unit_test(every_draw_has_its_sections_or_none),
        cmocka_unit_test(faults_are_known_of_one_driver_up_to_a_number),
        cmocka_unit_test(each_draw_notices_one_step_beyond),
        cmocka_unit_test(bounds_are_narrow),
        cmocka_unit_test(what_is_beyond_is_told_in_one_line),
    };
    return cmocka_run_group_tests_name("bounds of fixed functions", tests, begin, end);
}
