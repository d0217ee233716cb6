// Texels, as samplers find, weigh and decode them.
#include "tests/backends/bounding/rig.h"

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

// Levels of which each has its number as its only value. u and v rise by 1/20 a pixel in x, which
// are 1.6 texels: the scale is 1.6 at least, 3.2 at most in OpenGL, and 4.525 in Vulkan.
static void the_scale_is_what_each_api_allows(void **state)
{
    (void)state;
    static const struct rg_fixed_state trilinear = {.fragment = RG_FIXED_FRAGMENT_TEXTURE,
                                                    .texels = RG_FIXED_TEXELS_SRGB8,
                                                    .mip = RG_FIXED_MIP_LINEAR};
    const double error = 1 / 64.0 + 1 / 256.0;
    struct rg_fixed_precision opengl = fine;
    struct rg_primitive sloped = half_square();
    struct rg_plane plane;
    sloped.corners[1].at[0] = sloped.corners[1].at[1] = 1;
    assert_true(rg_plane_of(scene, &sloped, 1e-9, &plane));
    struct rg_fragment fragment = {
        .x = 15, .y = 12, .primitive = &sloped, .plane = &plane, .is_inside = true};
    rg_plane_at(&plane, fragment.x, fragment.y, 0, &fragment.place);
    make_stripes(&trilinear);
    for (int level = 0; level < scene->texture.levels; level++)
        for (int i = 0; i < RG_FIXED_TEXTURE_PX * RG_FIXED_TEXTURE_PX; i++)
            scene->texture.texels[0][level][i][0] = rg_span_at(level);
    rg_fragment_shade(scene, &fragment);
    const struct rg_span vulkan = fragment.colours[0][0];
    opengl.is_opengl = true;
    scene->precision = &opengl;
    rg_fragment_shade(scene, &fragment);
    scene->precision = &fine;
    scene->state = &plain;
    assert_near(vulkan.low, log2(1.6) - error, 1e-4); // derivatives are rounded, too
    assert_near(vulkan.high, log2(3.2 * sqrt(2)) + error, 1e-4);
    assert_near(fragment.colours[0][0].low, log2(1.6) - error, 1e-4);
    assert_near(fragment.colours[0][0].high, log2(3.2) + error, 1e-4);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_of_a_filter_are_a_step_off),
        cmocka_unit_test(four_texels_are_gathered_or_compared),
        cmocka_unit_test(levels_are_mixed_by_the_lod),
        cmocka_unit_test(the_scale_is_what_each_api_allows),
        cmocka_unit_test(faces_of_a_cube_meet_at_their_edges),
        cmocka_unit_test(blocks_of_bc_are_decoded),
        cmocka_unit_test(blocks_of_bc_are_decoded_as_by_gpus),
        cmocka_unit_test(blocks_of_etc2_are_decoded),
    };
    return cmocka_run_group_tests_name("bounds of texels", tests, begin, end);
}
