#include "core/techniques/streaks/fit.h"

#include <math.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"

// Sizes tried are 5 % apart; a rain space 100 km wide has 242 of them.
static const double step_factor = 1.05, least_radius_m = 1;
// The share of the allowed error for the radius. With all of it, the height could add no error and
// would be large. Errors also vary by some 3 % between heights, because each has other drops.
static const double share_of_radius = 0.9;

struct fit {
    struct streaks *s;
    double radius_m, height_m; // the sizes being tried
    double made_m;             // the height of the current particles; 0: none yet
    double error;              // error at the smallest acceptable sizes so far
    struct rg_picture dry, truth;
};

bool streaks_fit_begin(struct streaks_settings *set)
{
    if (!set->limits)
        return rg_error("fit=on: without limits there is no radius and no height to search for; "
                        "take limits=on");
    set->culling_radius_m = streaks_widest_m(set);
    set->local_height_m = set->rain_height_m;
    return true;
}

// --- pictures ---

static bool draw(struct streaks *s, struct rg_picture *picture)
{
    s->map_due = 0; // a dynamic depth map covers the radius
    return streaks_look(s) && s->base.technique->draw(&s->base) &&
           rg_frame_read_picture(&s->base, picture);
}

// Draws the background for the rain mask, with all drops out of sight; few drops suffice.
static bool draw_dry(struct fit *f)
{
    struct streaks *s = f->s;
    const struct streaks_settings set = s->settings;
    s->settings.drops = s->settings.splashes = 0;
    s->settings.culling_radius_m = least_radius_m;
    const bool ok = draw(s, &f->dry);
    s->settings = set;
    return ok;
}

// Draws the truth. The packets of the hull suffice, since the others are invisible.
static bool draw_unlimited(struct fit *f)
{
    struct streaks *s = f->s;
    const struct streaks_settings set = s->settings;
    s->settings.limits = 0;
    s->settings.select = 1;
    rg_picture_destroy(&f->truth);
    const bool ok = draw(s, &f->truth);
    s->settings = set;
    return ok;
}

// Makes particles for a height. They are other drops, so that each height needs a truth of its own.
static bool make_height(struct fit *f)
{
    if (f->made_m == f->height_m)
        return true;
    f->made_m = f->height_m;
    f->s->settings.local_height_m = f->height_m;
    return streaks_make_particles(f->s) && (f->dry.texels || draw_dry(f)) && draw_unlimited(f);
}

static bool compare(const struct fit *f, const struct rg_picture *picture, double *error)
{
    struct rg_comparison c;
    if (!rg_compare(&f->truth, "rain without limits", picture, "rain", &f->dry,
                    &(struct rg_compare_options){0}, &c))
        return false;
    *error = c.flip.mask_mean;
    rg_comparison_destroy(&c);
    return true;
}

// Computes the error at the sizes being tried.
static bool find_error(struct fit *f, double *error)
{
    struct rg_picture picture = {0};
    if (!make_height(f))
        return false;
    f->s->settings.culling_radius_m = f->radius_m;
    const bool ok = draw(f->s, &picture) && compare(f, &picture, error);
    rg_picture_destroy(&picture);
    return ok;
}

// --- sizes ---

// Rounds to centimetres, which is exact enough and reads well.
static double size_at(double least_m, double most_m, int step)
{
    double size_m = least_m;
    while (step-- > 0 && size_m < most_m)
        size_m *= step_factor;
    return fmin(rint(size_m * 100) / 100, most_m);
}

// Finds the smallest acceptable value of one size: the next step below exceeds the error. The steps
// tried do not depend on the error, so that allowing more never makes a size larger.
static bool shrink(struct fit *f, double *size_m, double least_m, double most_error)
{
    const double most_m = *size_m;
    int bad = -1, good = 0;
    while (size_at(least_m, most_m, good) < most_m)
        good++;
    while (good - bad > 1) {
        const int middle = (good + bad) / 2;
        double error;
        *size_m = size_at(least_m, most_m, middle);
        if (!find_error(f, &error))
            return false;
        if (error <= most_error)
            f->error = error;
        *(error <= most_error ? &good : &bad) = middle;
    }
    *size_m = size_at(least_m, most_m, good);
    return true;
}

// Whether the search can succeed: rain is seen, the largest sizes meet the allowed error, and a
// frame without rain exceeds it.
static bool is_possible(struct fit *f)
{
    const double allowed = f->s->settings.fit_error;
    double dry_error;
    if (!find_error(f, &f->error) || !compare(f, &f->dry, &dry_error))
        return false;
    if (dry_error == 0)
        return rg_error("fit=on: no rain is seen in the first frame; move the camera to where it "
                        "rains, or take fit=off");
    if (dry_error <= allowed)
        return rg_error("fit_error: without any rain the first frame has an error of %.4f; allow "
                        "less than that",
                        dry_error);
    return f->error <= allowed * share_of_radius ||
           rg_error("fit_error: the largest radius and height, %.4g m and %.4g m, have an error of "
                    "%.4f; allow %.4f or more",
                    f->radius_m, f->height_m, f->error, f->error / share_of_radius + 1e-4);
}

// The fastest drop must have time to be seen as a whole streak and then as a splash.
static double least_height_m(const struct streaks *s)
{
    return s->sizes.fastest_m_s * (s->settings.exposure_s + s->settings.splash_s);
}

static bool search(struct fit *f)
{
    const struct streaks_settings *set = &f->s->settings;
    return is_possible(f) &&
           shrink(f, &f->radius_m, least_radius_m, set->fit_error * share_of_radius) &&
           shrink(f, &f->height_m, least_height_m(f->s), set->fit_error);
}

// Leaves the instance as if it had been opened with the sizes found.
static bool settle(struct fit *f)
{
    struct streaks *s = f->s;
    s->settings.culling_radius_m = f->radius_m;
    s->settings.local_height_m = f->height_m;
    s->fit_error = rint(f->error * 1e6) / 1e6;
    for (int i = 0; i < STREAKS_COUNTERS; i++)
        s->base.counters[i].value = 0;
    s->map_due = 0;
    // Drawing the truth, rain without limits, grew the block buffers; the sizes found need little.
    streaks_selection_release(&s->selection);
    rg_empty(s->blocks);
    return f->made_m == f->height_m || streaks_make_particles(s);
}

bool streaks_fit(struct streaks *s)
{
    struct fit f = {
        .s = s, .radius_m = s->settings.culling_radius_m, .height_m = s->settings.local_height_m};
    s->rain_alone = true; // only rain is compared
    const bool ok = search(&f) && settle(&f);
    s->rain_alone = false;
    rg_picture_destroy(&f.dry);
    rg_picture_destroy(&f.truth);
    return ok;
}
