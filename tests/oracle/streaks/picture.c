#include "tests/oracle/streaks/picture.h"

#include <math.h>

#include "tests/oracle/raster.h"
#include "tests/oracle/streaks/light.h"
#include "tests/oracle/vectors.h"

static const double pi = 3.14159265358979323846;
static const double cell_radii = 32 / 23.744; // half of a cell's width

// --- the billboard ---

// Lengths in radii are as seen from the eye.
struct board {
    double corner[3], across[3], along[3]; // u from left to right, v upwards
    double middle[3];
    struct oracle_point outline[4];
    int level;
    double elevation; // of the eye, in steps of 20 degrees
    double way, lacking;
    double share; // of light and opacity
};

static bool project(const struct streak_view *view, const double at[3], struct oracle_point *point)
{
    double from[3];
    add(at, view->eye, -1, from);
    const double ahead = dot(from, view->ahead);
    if (ahead < 0.05)
        return false;
    point->x = llround(256 * (view->width / 2.0 + view->focal_px * dot(from, view->right) / ahead));
    point->y =
        llround(256 * (view->height / 2.0 - view->focal_px * dot(from, view->above) / ahead));
    return true;
}

static void set_corners(struct board *board, const struct streak_view *view,
                        const struct streak_drop *drop, double half_width, double rim)
{
    double sight[3], left[3], seen_up[3], lower[3];
    add(drop->end, view->eye, -1, sight);
    cross(view->up, sight, left);
    make_unit(left);
    cross(sight, left, seen_up);
    make_unit(seen_up);
    add(drop->end, seen_up, -rim, lower);
    add(lower, left, half_width, board->corner);
    for (int i = 0; i < 3; i++) {
        board->across[i] = -2 * half_width * left[i];
        board->along[i] = view->up[i] * drop->fall_m + 2 * rim * seen_up[i];
    }
}

static bool outline(struct board *board, const struct streak_view *view)
{
    bool seen = true;
    for (int i = 0; i < 4; i++) {
        double at[3];
        add(board->corner, board->across, i == 1 || i == 2, at);
        add(at, board->along, i >= 2, at);
        seen = project(view, at, &board->outline[i]) && seen;
    }
    return seen;
}

// A streak is never drawn thinner or shorter than a pixel; it is fainter instead.
static bool make_board(struct board *board, const struct streak_view *view,
                       const struct streak_drop *drop)
{
    double to_eye[3];
    add(drop->end, view->up, drop->fall_m / 2, board->middle);
    add(view->eye, board->middle, -1, to_eye);
    const double pixel_m = -dot(to_eye, view->ahead) / view->focal_px;
    if (pixel_m <= 0)
        return false;
    make_unit(to_eye);
    const double rise = dot(to_eye, view->up), radius_m = drop->radius_m;
    const double way_m = drop->fall_m * sqrt(fmax(1 - rise * rise, 0));
    const double half_width = radius_m * cell_radii, drawn = fmax(half_width, pixel_m / 2);
    const double lacking_m = fmax((pixel_m - way_m) / 2, 0);
    const double step = floor(log2(32 / (2 * half_width / pixel_m)) + 0.5);
    board->level = (int)fmin(fmax(step, view->first_level), view->last_level);
    board->elevation = asin(rise) * 9 / pi;
    board->way = way_m / radius_m;
    board->lacking = lacking_m / radius_m;
    const double covered = 2 * radius_m / way_m;
    board->share = covered / streak_atlas_share(fmin(fabs(board->elevation), STREAK_VIEWS - 1)) *
                   (half_width / drawn) * drop->weight;
    set_corners(board, view, drop, drawn, fmax(radius_m, lacking_m));
    return outline(board, view);
}

// --- a place on it ---

struct place {
    double ray[3], at[3];
    double u, v;
    double swing, window;
};

static void ray_through(const struct streak_view *view, int x, int y, double ray[3])
{
    add(view->ahead, view->right, (x + 0.5 - view->width / 2.0) / view->focal_px, ray);
    add(ray, view->above, -(y + 0.5 - view->height / 2.0) / view->focal_px, ray);
}

// Finds where a ray from the eye meets the billboard's plane.
static void meet(const struct streak_view *view, const struct board *board, struct place *place)
{
    double normal[3], from[3], out[3], turned[3];
    cross(board->across, board->along, normal);
    add(board->corner, view->eye, -1, from);
    const double distance = dot(from, normal) / dot(place->ray, normal);
    add(view->eye, place->ray, distance, place->at);
    add(place->at, board->corner, -1, out);
    const double area = dot(normal, normal);
    cross(out, board->along, turned);
    place->u = clamped(dot(turned, normal) / area, 0, 1);
    cross(board->across, out, turned);
    place->v = clamped(dot(turned, normal) / area, 0, 1);
}

// A drop passes a place during its chord there. At the ends of the exposure only a part of the
// chord passes.
static void find_moment(const struct board *board, const struct streak_drop *drop,
                        struct place *place)
{
    const double rim = fmax(1, board->lacking), x = (2 * place->u - 1) * cell_radii,
                 at = place->v * (board->way + 2 * rim) - rim;
    const double half = fmax(sqrt(fmax(1 - x * x, 0)), fmax(board->lacking, 0.25));
    const double passes = fmin(at + half, board->way) - fmax(at - half, 0);
    place->window = fmax(passes, 0) / (2 * half);
    const double swing = drop->turn - drop->cycles * clamped(at / board->way, 0, 1);
    place->swing = swing - floor(swing);
}

// --- light ---

static double texture(const struct streak_atlas *atlas, const struct board *board,
                      const struct streak_drop *drop, const struct place *place, int column,
                      double u)
{
    const double view = fmin(fabs(board->elevation), STREAK_VIEWS - 1);
    const int lower = (int)fmin(floor(view), STREAK_VIEWS - 2);
    const double a = streak_texture(atlas, drop->oscillation, board->level, lower, column, u,
                                    place->swing),
                 b = streak_texture(atlas, drop->oscillation, board->level, lower + 1, column, u,
                                    place->swing);
    return a * (lower + 1 - view) + b * (view - lower);
}

// The radiance for an irradiance of 1 from a light (figure 4.6). A billboard has one set of angles,
// of the light and the eye at its middle.
static double streak_radiance(const struct streak_view *view, const struct streak_atlas *atlas,
                              const struct board *board, const struct streak_drop *drop,
                              const struct place *place, const struct streak_light *light)
{
    double to_light[3], ray[3];
    add(board->middle, view->eye, -1, ray);
    streak_reach(light, board->middle, to_light);
    const struct streak_cells cells = streak_cells_of(view, board->elevation < 0, ray, to_light);
    double sum = 0;
    for (int i = 0; i < 4; i++)
        if (cells.parts[i] > 0)
            sum += cells.parts[i] * texture(atlas, board, drop, place, cells.columns[i],
                                            cells.mirrored ? 1 - place->u : place->u);
    return sum;
}

// A pixel's light and opacity; false if the streak is cut off there.
static bool shade(const struct streak_view *view, const struct streak_atlas *atlas,
                  const struct board *board, const struct streak_drop *drop, int x, int y,
                  double light[3], double *opacity)
{
    struct place place;
    double above_end[3];
    ray_through(view, x, y, place.ray);
    meet(view, board, &place);
    add(place.at, drop->end, -1, above_end);
    if (dot(above_end, view->up) < drop->cut_m)
        return false;
    find_moment(board, drop, &place);
    const double share = board->share * place.window,
                 sky = share * texture(atlas, board, drop, &place, STREAK_SKY, place.u);
    *opacity = fmin(sky * view->opacity, 1);
    for (int c = 0; c < 3; c++)
        light[c] = sky * view->gain * view->sky[c];
    for (int i = 0; i < view->light_count; i++) {
        double to_light[3];
        const double reached = streak_reach(&view->lights[i], place.at, to_light);
        const double lit = share * view->gain * reached * pi *
                           streak_radiance(view, atlas, board, drop, &place, &view->lights[i]);
        for (int c = 0; c < 3; c++)
            light[c] += lit * view->lights[i].colour[c];
    }
    return true;
}

// --- pictures ---

static int64_t least_of(const int64_t v[4])
{
    int64_t least = v[0];
    for (int i = 1; i < 4; i++)
        least = v[i] < least ? v[i] : least;
    return least;
}

// The pixels, from `first` to before `end`, that corners in 1/256 pixel may cover.
static void span(int64_t a, int64_t b, int64_t c, int64_t d, int size, int *first, int *end)
{
    const int64_t least = least_of((int64_t[]){a, b, c, d}),
                  most = -least_of((int64_t[]){-a, -b, -c, -d});
    *first = least < 0 ? 0 : least > 256 * (int64_t)size ? size : (int)(least / 256);
    *end = most < 0 ? 0 : most >= 256 * (int64_t)size ? size : (int)(most / 256) + 1;
}

// The most that a streak adds to a pixel plus hides of it.
static double change_of(const double light[3], double opacity, const double behind[3])
{
    double most = 0;
    for (int c = 0; c < 3; c++)
        most = fmax(most, light[c] + opacity * behind[c]);
    return most;
}

static void draw_drop(const struct streak_view *view, const struct streak_atlas *atlas,
                      const struct streak_drop *drop, struct streak_pixel *pixels)
{
    struct board board;
    if (!make_board(&board, view, drop))
        return;
    const struct oracle_point *p = board.outline;
    int left, right, top, bottom;
    span(p[0].x, p[1].x, p[2].x, p[3].x, view->width, &left, &right);
    span(p[0].y, p[1].y, p[2].y, p[3].y, view->height, &top, &bottom);
    double peak = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int y = top; y < bottom; y++)
            for (int x = left; x < right; x++) {
                double light[3], opacity;
                if (!oracle_covers(p, 4, x, y) ||
                    !shade(view, atlas, &board, drop, x, y, light, &opacity))
                    continue;
                struct streak_pixel *pixel = &pixels[y * view->width + x];
                if (!pass)
                    peak = fmax(peak, change_of(light, opacity, pixel->light));
                for (int c = 0; c < 3 && pass; c++)
                    pixel->light[c] = light[c] + (1 - opacity) * pixel->light[c];
                pixel->streaks += pass;
                if (pass)
                    pixel->peak = fmax(pixel->peak, peak);
            }
}

void streak_picture_draw(const struct streak_view *view, const struct streak_atlas *atlas,
                         const struct streak_drop *drops, int count, struct streak_pixel *pixels)
{
    for (int i = 0; i < count; i++)
        draw_drop(view, atlas, &drops[i], pixels);
}
