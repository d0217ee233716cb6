// The lit pane in closed cases: images of a dry pane and of a drop, the size of blur, and water
// that keeps light.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/drops/view/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

// A pane of 80 x 60 mm in a picture of 160 x 120 pixels, each half a mm.
#define DRY "columns=80 rows=60 cell_mm=1 drops_s=0 environment=sky environment_px=16 rays_px=2 "

enum { WIDTH = 160, HEIGHT = 120 };

static struct rg_device *device;

static struct drops *open_with(const char *settings, const char *background)
{
    char text[2048];
    snprintf(text, sizeof(text), "%s%s%s", settings, background ? " background=" : "",
             background ? background : "");
    return rig_open_sized(device, text, WIDTH, HEIGHT);
}

// --- what is bright ---

struct spot {
    double x, y, radius; // in texels, whose centres are whole numbers
};

static void one_spot(int x, int y, const void *user, float light[3])
{
    const struct spot *spot = user;
    light[1] = hypot(x - spot->x, y - spot->y) <= spot->radius ? 1 : 0;
}

// The place of green light in a picture, in mm from the pane's middle, and its deviation along x
// and y.
struct seen {
    double sum, x, y, deviation_x, deviation_y;
};

static struct seen look_for_green(struct drops *d, double within_mm)
{
    struct rg_picture picture = view_draw(d);
    struct seen s = {0};
    double xx = 0, yy = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double x = 0.5 * (i % WIDTH + 0.5 - WIDTH / 2);
        const double y = 0.5 * ((double)(i / WIDTH) + 0.5 - HEIGHT / 2);
        const double light = (double)view_pixel(&picture, i % WIDTH, i / WIDTH)[1];
        if (hypot(x, y) > within_mm)
            continue;
        s.sum += light;
        s.x += light * x;
        s.y += light * y;
        xx += light * x * x;
        yy += light * y * y;
    }
    rg_picture_destroy(&picture);
    assert_above(s.sum, 0);
    s.x /= s.sum;
    s.y /= s.sum;
    s.deviation_x = sqrt(xx / s.sum - s.x * s.x);
    s.deviation_y = sqrt(yy / s.sum - s.y * s.y);
    return s;
}

static void expect_near(const char *what, double found, double due, double off)
{
    if (!(fabs(found - due) <= off))
        fail_msg("%s: %.6g, not %.6g", what, found, due);
}

// --- a dry pane ---

// The background has 400 x 300 texels and is 90 degrees wide from the pane: 4000 mm at 2 m, 10 mm a
// texel.
static const double TEXEL_MM = 10, BEHIND_MM = 2000, DISTANCE_MM = 500;

#define BEHIND DRY "distance_mm=500 background_m=2 background_deg=90 "

// By similar triangles, the pane shows a point X off the axis at X D / (D + B). A lens of width A,
// focused on the pane, spreads the point into a disc of A B / D. On the pane that is A B / (D + B).
// A disc's deviation is a quarter of its diameter.
static void a_dry_pane_shows_what_lies_behind(void **state)
{
    (void)state;
    static const struct {
        struct spot spot;
        double aperture_mm, turn_deg;
    } cases[] = {{{208, 147, 1}, 0, 0},
                 {{191, 153, 1}, 20, 0},
                 {{206, 154, 1}, 8, 0},
                 {{204, 146, 1}, 0, 90}};
    const double onto_pane = DISTANCE_MM / (DISTANCE_MM + BEHIND_MM);
    for (int i = 0; i < 4; i++) {
        char path[256], text[512];
        snprintf(path, sizeof(path), "%s", in_folder("spot.exr"));
        view_write(path, 400, 300, one_spot, &cases[i].spot);
        snprintf(text, sizeof(text), BEHIND "aperture_mm=%g turn_deg=%g", cases[i].aperture_mm,
                 cases[i].turn_deg);
        struct drops *d = open_with(text, path);
        const struct seen s = look_for_green(d, 100);
        const double right = (cases[i].spot.x + 0.5 - 200) * TEXEL_MM * onto_pane;
        const double down = (cases[i].spot.y + 0.5 - 150) * TEXEL_MM * onto_pane;
        // The pane and the camera turn a quarter clockwise, and so the world turns back.
        expect_near("x", s.x, cases[i].turn_deg > 0 ? -down : right, 0.1);
        expect_near("y", s.y, cases[i].turn_deg > 0 ? right : down, 0.1);
        const double disc = cases[i].aperture_mm * BEHIND_MM / (DISTANCE_MM + BEHIND_MM) / 4;
        const double spot = TEXEL_MM * onto_pane * 0.8; // 5 texels, blurred between texels
        expect_near("width", s.deviation_x, hypot(disc, spot), 0.35);
        expect_near("height", s.deviation_y, hypot(disc, spot), 0.35);
        rig_close(d);
        assert_int_equal(remove(path), 0);
    }
}

// The pane shows a direction of the environment where its ray from the camera meets the pane. All
// of it is dark except a spot, 3 degrees to the right and 2 up.
static void a_dry_pane_shows_the_environment(void **state)
{
    (void)state;
    const double degree = M_PI / 180, distance_mm = 250, right = distance_mm * tan(3 * degree);
    const double up = hypot(distance_mm, right) * tan(2 * degree);
    double sharp_mm = 0;
    for (int aperture_mm = 0; aperture_mm <= 12; aperture_mm += 12) {
        char path[256], text[512];
        const struct spot spot = {365.5, 175.5, 2}; // 2 texels a degree
        snprintf(path, sizeof(path), "%s", in_folder("around.exr"));
        view_write(path, 720, 360, one_spot, &spot);
        snprintf(text, sizeof(text),
                 DRY "distance_mm=250 environment_px=256 aperture_mm=%d environment=%s",
                 aperture_mm, path);
        struct drops *d = open_with(text, NULL);
        const struct seen s = look_for_green(d, 100);
        expect_near("x", s.x, right, 0.3);
        expect_near("y", s.y, -up, 0.3);
        // The disc's angle is 12 mm at 250 mm, on either side of the pane.
        if (aperture_mm)
            expect_near("width", s.deviation_x, hypot(aperture_mm / 4.0, sharp_mm), 0.3);
        sharp_mm = s.deviation_x;
        rig_close(d);
        assert_int_equal(remove(path), 0);
    }
}

// --- a drop ---

// A cap of a sphere, with its place, its radius of curvature and its base's radius.
struct cap {
    double x_mm, y_mm, curvature_mm, base_mm;
};

static double cap_height(double x_mm, double y_mm, const void *user)
{
    const struct cap *c = user;
    const double r2 = pow(x_mm - c->x_mm, 2) + pow(y_mm - c->y_mm, 2);
    const double below = sqrt(c->curvature_mm * c->curvature_mm - c->base_mm * c->base_mm);
    return r2 < c->base_mm * c->base_mm ? sqrt(c->curvature_mm * c->curvature_mm - r2) - below : 0;
}

// A plane-convex lens has a focal length of f = R / (n - 1). A ray from the camera passes it at p
// off its middle. Its slope is p / D before the lens and p / D - p / f after it. It meets the
// background at X = p (1 + B / D - B / f): upside down and small. The caps are flat enough for thin
// lenses; 4 % allows for the sphere's distance from a parabola.
static void a_drop_shows_it_small_and_upside_down(void **state)
{
    (void)state;
    static const double index[2] = {1.333, 1.5};
    const double texel_mm = TEXEL_MM / 2; // twice as fine as above
    const struct cap cap = {40, 30, 24, 8};
    const struct spot spot = {392, 304, 4};
    char path[256], dark[256];
    snprintf(path, sizeof(path), "%s", in_folder("spot.exr"));
    snprintf(dark, sizeof(dark), "%s", in_folder("dark.exr"));
    view_write(path, 800, 600, one_spot, &spot);
    view_write(dark, 32, 16, one_spot, &(struct spot){-9, -9, 1});
    for (int i = 0; i < 2; i++) {
        char text[1024];
        snprintf(text, sizeof(text), BEHIND "aperture_mm=0 refractive_index=%g environment=%s",
                 index[i], dark);
        struct drops *d = open_with(text, path);
        view_put_heights(d, cap_height, &cap);
        const struct seen s = look_for_green(d, 5);
        const double focal_mm = cap.curvature_mm / (index[i] - 1);
        const double larger = 1 + BEHIND_MM / DISTANCE_MM - BEHIND_MM / focal_mm;
        const double x = (spot.x + 0.5 - 400) * texel_mm, y = (spot.y + 0.5 - 300) * texel_mm;
        assert_below(larger, -10);
        expect_near("x", s.x, x / larger, 0.04 * fabs(x / larger));
        expect_near("y", s.y, y / larger, 0.04 * fabs(y / larger));
        rig_close(d);
    }
    assert_int_equal(remove(path), 0);
    assert_int_equal(remove(dark), 0);
}

// --- light is neither made nor lost ---

static void white(int x, int y, const void *user, float light[3])
{
    (void)x, (void)y, (void)user;
    for (int c = 0; c < 3; c++)
        light[c] = 1;
}

static void white_stays_white(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "", "refractive_index=2.4 contact_mm=0", "distance_mm=100 aperture_mm=100 rays_px=3",
        "smooth=off erode=off critical_mass_mg=90", "tilt_deg=10 turn_deg=33"};
    char path[256], text[1024];
    snprintf(path, sizeof(path), "%s", in_folder("white.exr"));
    view_write(path, 64, 32, white, NULL);
    for (int i = 0; i < 10; i++) {
        snprintf(text, sizeof(text),
                 "columns=160 rows=120 drops_s=300 max_drops=400 %s environment_px=16 "
                 "environment=%s",
                 settings[i / 2], path);
        struct drops *d = open_with(text, i % 2 ? path : NULL);
        rig_step(d, 40);
        struct rg_picture picture = view_draw(d);
        for (int k = 0; k < WIDTH * HEIGHT * 4; k++)
            if (fabsf(picture.texels[k] - 1) > 1 / 255.0f)
                fail_msg("%s: pixel %d is %g", settings[i / 2], k / 4, (double)picture.texels[k]);
        rg_picture_destroy(&picture);
        rig_close(d);
    }
    assert_int_equal(remove(path), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dry_pane_shows_what_lies_behind),
        cmocka_unit_test(a_dry_pane_shows_the_environment),
        cmocka_unit_test(a_drop_shows_it_small_and_upside_down),
        cmocka_unit_test(white_stays_white),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, make_folder, remove_folder);
    return rg_device_close(device) ? failed : 1;
}
